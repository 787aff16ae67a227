"""Bodies of a batch side by side through one motion, where a solver follows rows that tell all that its answers do."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from seisblock.errors import SeisblockError
from seisblock.records import Motion
from seisblock.records.given import vertical_gain
from seisblock.solvers.jump.many import jump_many
from seisblock.solvers.jump.tale import warnings_of
from seisblock.solvers.uplift.many import uplift_many
from seisblock.solvers.uplift.outcome import warnings as uplift_warnings

if TYPE_CHECKING:
    from seisblock.studies.batch.models import Placed

Answer: TypeAlias = "tuple[Mapping[str, Any], Sequence[str]]"
"""The scalars of an outcome, and what is to be known before believing them."""


def answers_together(solver: str, bodies: Sequence[Placed], motion: Motion) -> dict[str, Answer]:
    """Return the answers of those bodies that a solver can follow side by side, by their names; the others are followed alone.

    Parameters
    ----------
    solver : str
    bodies : sequence of Placed
    motion : Motion
    """
    if solver not in TOGETHER:
        return {}
    follow, of_a_row = TOGETHER[solver]
    alike: dict[str, list[Placed]] = {}
    for body in bodies:
        alike.setdefault(repr({key: value for key, value in body.options.items() if key not in of_a_row}), []).append(body)
    found: dict[str, Answer] = {}
    for some in alike.values():
        shared = {key: value for key, value in some[0].options.items() if key not in of_a_row}
        try:
            found |= follow(some, motion, **shared)
        except (SeisblockError, TypeError):
            continue  # one after another they say which of them it is, and why
    return found


def _uplifts(bodies: Sequence[Placed], motion: Motion, **shared: Any) -> dict[str, Answer]:
    """Follow blocks on springs; a run that was given up is followed alone, which tells why."""
    gains = [(1.0, 1.0, vertical_gain(motion, body.options.get("vertical"))) for body in bodies]
    fates = uplift_many([body.body for body in bodies], motion, gains=gains, **shared)
    return {
        body.name: (fates.told(row, motion.start_s), uplift_warnings(motion, fates, row))
        for row, body in enumerate(bodies)
        if not fates.gave_up[row]
    }


def _jumps(bodies: Sequence[Placed], motion: Motion, **shared: Any) -> dict[str, Answer]:
    """Follow two-layer blocks; where a foot jams, or a run was given up, there is no answer."""
    contacts, drop = [body.options["contact"] for body in bodies], [body.options.get("drop", 0.0) for body in bodies]
    fates = jump_many([body.body for body in bodies], motion, contacts=contacts, drop=drop, **shared)
    return {
        body.name: (
            {**fates.told(row), "landing": shared.get("landing", "paper")},
            warnings_of(motion, fates.chains_of(row, motion.start_s), contact.mu),
        )
        for row, (body, contact) in enumerate(zip(bodies, contacts, strict=True))
        if not (fates.jammed[row] or fates.gave_up[row])
    }


TOGETHER: dict[str, tuple[Callable[..., dict[str, Answer]], tuple[str, ...]]] = {
    "uplift": (_uplifts, ("vertical",)),
    "jump": (_jumps, ("contact", "drop")),
}
"""What follows them, and which options may differ from row to row."""
