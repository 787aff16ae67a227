"""Studies of each solver beyond single runs: samples, assessment, azimuth sweeps and end states of many runs.

The studies of a solver stand in the module of its name. One without a module is solved run by run, with the limit states of its outcome.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

from seisblock.core.errors import ParameterError
from seisblock.core.options import SolverOptions
from seisblock.core.registry import SolverBody, get_solver, solver_names
from seisblock.records import Record


@dataclass(frozen=True, kw_only=True)
class SolverStudies:
    """Studies that a solver supports.

    Parameters
    ----------
    sample : callable or None
        ``sample(sampling)``: results of the samples of one object in one direction.
    assess : callable or None
        ``assess(body, motion, options, samples, *, moved_m)``: assessment in one direction from these samples.
    end_states : callable or None
        End states of many runs of one body; None without limit states.
    limits : tuple of str
        Limit states of a fragility.
    samples_in_rows : bool
        Whether samples are solved in rows: many of them in a batch, on a map and in `end_states`.
    directions : callable or None
        ``directions(body, record, options, *, step_deg)``: results in all azimuths of a record, the worst first.
    worst_azimuth : callable or None
        ``worst_azimuth(solver_body, record, runs, seed)``: worst direction of a body under a record.
    single_direction_options : tuple of str
        Options that an azimuth sweep does not support.
    """

    sample: Callable[[Any], Any] | None = None
    assess: Callable[..., Any] | None = None
    end_states: Callable[..., Any] | None = None
    limits: tuple[str, ...] = ()
    samples_in_rows: bool = False
    directions: Callable[..., Sequence[Any]] | None = None
    worst_azimuth: Callable[[SolverBody, Record, int, int], Any] | None = None
    single_direction_options: tuple[str, ...] = ()


@cache
def solver_studies(name: str) -> SolverStudies:
    """Return the studies that a solver supports.

    Raises
    ------
    ParameterError
        If there is no solver of that name.
    """
    solver = get_solver(name)
    studies = SolverStudies()
    if Path(__file__).with_name(f"{name}.py").exists():
        studies = importlib.import_module(f"seisblock.studies.solvers.{name}").STUDIES
    if studies.end_states is None and solver.damage_states:
        # by name, since the studies import this registry
        end_states = pkgutil.resolve_name("seisblock.studies.fragility.runners:single_end_states")
        return replace(studies, end_states=partial(end_states, solver=solver), limits=tuple(solver.damage_states))
    return studies


def require_default(options: SolverOptions, *names: str) -> None:
    """Raise ParameterError for options of single runs, which many runs do not take, unless they have their default."""
    defaults = {field.name: field.default for field in fields(options)}
    given = [f"`{name}`" for name in names if getattr(options, name) != defaults[name]]
    if given:
        raise ParameterError("samples and fragilities have no option {names}: omit it", names=given)


def solvers_with(study: str) -> list[str]:
    """Return the names of the solvers that support a study: a field of :class:`SolverStudies`."""
    return [name for name in solver_names() if getattr(solver_studies(name), study)]
