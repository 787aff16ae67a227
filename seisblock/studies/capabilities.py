"""Studies of each solver beyond single runs: probabilities, azimuth sweeps and end states of many runs.

A solver that is not listed here has what its registration tells: its limit states are those of its outcome, run by run.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from seisblock.core.registry import SolverBody, get_solver, solver_names
from seisblock.records import Motion, Record
from seisblock.studies.batch.directions import Worst, worst_respond, worst_rock, worst_slide
from seisblock.studies.batch.probability import PROBABILITY_COLUMNS, probability_columns
from seisblock.studies.fragility.damage_states import LEAN, OVERTURN, ROCK, SLIP
from seisblock.studies.fragility.runners import Runner, respond_end_states, rock_end_states, single_end_states, slide_end_states


@dataclass(frozen=True)
class Capabilities:
    """Studies that a solver supports.

    Parameters
    ----------
    end_states : callable or None
        End states of many runs of one body; None without limit states.
    limits : tuple of str
        Limit states of a fragility.
    samples_in_rows : bool
        Whether `end_states` takes samples of the body.
    probability : callable or None
        ``probability(solver_body, motion, runs, seed)``: the probability columns of a batch.
    probability_columns : mapping of str to type
    worst_azimuth : callable or None
        ``worst_azimuth(solver_body, record, runs, seed)``: worst direction of a body under a record.
    single_direction_options : tuple of str
        Options that an azimuth sweep does not support.
    """

    end_states: Runner | None
    limits: tuple[str, ...]
    samples_in_rows: bool = False
    probability: Callable[[SolverBody, Motion, int, int], dict[str, Any]] | None = None
    probability_columns: Mapping[str, type] = field(default_factory=dict)
    worst_azimuth: Callable[[SolverBody, Record, int, int], Worst] | None = None
    single_direction_options: tuple[str, ...] = ()


_CAPABILITIES = {
    "respond": Capabilities(
        respond_end_states,
        (ROCK, LEAN, SLIP, OVERTURN),
        True,
        partial(probability_columns, solver="respond"),
        PROBABILITY_COLUMNS,
        worst_respond,
        ("initial", "further_points", "sensitivity"),
    ),
    "rock": Capabilities(
        rock_end_states,
        (ROCK, LEAN, OVERTURN),
        True,
        partial(probability_columns, solver="rock"),
        PROBABILITY_COLUMNS,
        worst_rock,
        ("initial",),
    ),
    "slide": Capabilities(slide_end_states, (SLIP,), worst_azimuth=worst_slide),
}


def capabilities(name: str) -> Capabilities:
    """Return the studies that a solver supports.

    Raises
    ------
    ParameterError
        If there is no solver of that name.
    """
    if name in _CAPABILITIES:
        return _CAPABILITIES[name]
    solver = get_solver(name)
    return Capabilities(partial(single_end_states, solver=solver) if solver.damage_states else None, tuple(solver.damage_states))


def fragility_solvers() -> list[str]:
    """Return the names of the solvers with limit states."""
    return [name for name in solver_names() if capabilities(name).limits]


def directional_solvers() -> list[str]:
    """Return the names of the solvers with an azimuth sweep."""
    return [name for name in solver_names() if capabilities(name).worst_azimuth is not None]
