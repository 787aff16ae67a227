"""How a pile is told: what became of each stone."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.pile.stone import GROUND
from seisblock.present.text.tables import record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.stack.outcome import StackOutcome, StoneFate

NOTICEABLE_TILT, NOTICEABLE_SLIP = 2e-3, 2e-4
"""What shows in a figure, rad and m."""


Stacks = Sequence[Response[StackOutcome]]


def tables(responses: Stacks) -> Iterator[Any]:
    """Yield the record, a row per stone, and a sentence per run."""
    seen: set[int] = set()
    for response in responses:
        record = response.motion.record
        if record is not None and id(record) not in seen:
            seen.add(id(record))
            yield record_line(record)
        columns = ["stone", "state", "fell at (s)", "max tilt (deg)", "slip (mm)", "turn (deg)"]
        title = f"+x = {response.motion.name}: {response.body.name}"
        yield table(title, columns, (_row(stone) for stone in reversed(response.outcome.stones)))
        yield Text(sentence(response))
        yield Text()


def _row(stone: StoneFate) -> list[str]:
    """Return what became of one stone."""
    return [
        stone.name,
        stone.state,
        seconds(stone.fell_at_s),
        f"{math.degrees(stone.max_tilt_rad):.2f}",
        f"{stone.residual_slip_m * 1e3:.1f}",
        f"{math.degrees(stone.residual_turn_rad):.2f}",
    ]


def _onto(stone: StoneFate) -> str:
    """Return in words where a fallen stone came to lie."""
    if stone.fell_onto is None:
        return "and is still in the air"
    return f"onto {'the ground' if stone.fell_onto == GROUND else stone.fell_onto}"


def towards(degrees: float) -> str:
    """Return a direction in the plane as the nearest of +x, +x+y, +y ..."""
    names = ("+x", "+x+y", "+y", "-x+y", "-x", "-x-y", "-y", "+x-y")
    return names[round(degrees / 45.0) % 8]


def sentence(response: Response[StackOutcome]) -> str:
    """Return what happened in words, and whether the books balance."""
    outcome = response.outcome
    if outcome.overturned_any and outcome.time_s is not None:
        falls = sorted((stone for stone in outcome.stones if stone.state == "fallen"), key=lambda stone: stone.fell_at_s or 0.0)
        told = " ".join(f"{stone.name} fell to {towards(stone.fell_towards_deg or 0.0)}, {_onto(stone)}." for stone in falls)
    else:
        moved = [stone.name for stone in outcome.stones if stone.state != "standing"]
        told = "Every stone stands" + (f"; moved: {', '.join(moved)}." if moved else " where it was.")
    return (
        f"{told} The shaking did {outcome.ground_work_j:.0f} J of work, friction and dashpots took {outcome.lost_j:.0f} J; "
        f"energy created by the steps: {outcome.created_j:.2g} J."
    )
