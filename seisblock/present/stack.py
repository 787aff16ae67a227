"""How a pile is told: what became of each stone, and its figure."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from rich.text import Text

from seisblock.bodies.gravestone import GROUND
from seisblock.present.tables import record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.stack_outcome import StackOutcome, StoneFate

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NOTICEABLE_TILT, NOTICEABLE_SLIP = 2e-3, 2e-4
"""What shows in a figure, rad and m."""

Stacks = Sequence[Response[StackOutcome]]

SHADES = ("#c0392b", "#1f5a8c", "#7d7d7d", "#b8860b", "#4f7f4f", "#7a4f8c", "#111111")
DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1, 2)), (0, (1, 1)), (0, (8, 2, 2, 2)), "-")
"""Colours and dashes of the stones from above downwards; the dashes tell them apart in grey."""


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


def figure(responses: Stacks) -> Figure:
    """Return the figure: per run the ground acceleration, and tilts and slips of the stones against time."""
    from seisblock.present import canvas

    columns = len(responses)
    made, axes = canvas.new_figure(3, columns=columns, width=3.5 + 4.5 * columns, sharex="col")
    for index, response in enumerate(responses):
        _column([axes[row * columns + index] for row in range(3)], response)
    return made


def _column(panels: Sequence[Any], response: Response[StackOutcome]) -> None:
    """Draw one run's three panels."""
    import numpy as np

    from seisblock.present import canvas

    motion = response.motion
    rows = (("up", 2, "0.75"), ("across", 1, "0.6"), (motion.name or "along", 0, canvas.INPUT))
    for name, row, grey in rows:
        values = motion.acceleration[row]
        acts = row == 0 or (row == 1 and response.options["across"]) or (row == 2 and response.options["vertical"])
        if acts and values.any():
            canvas.curve(panels[0], motion.time, values, color=grey, label=name)
    for index, name in enumerate(reversed(response.body.names)):
        style = {"color": SHADES[index % len(SHADES)], "linestyle": DASHES[index % len(DASHES)], "label": name}
        canvas.curve(panels[1], response.time, np.degrees(response[f"{name}_tilt"]), **style)
        canvas.curve(panels[2], response.time, response[f"{name}_slip"] * 1e3, **style)
    for panel, quantity, factor in ((panels[1], "tilt", math.degrees(1.0)), (panels[2], "slip", 1e3)):
        top = factor * _largest(response, quantity)
        panel.set_ylim(-0.05 * top, 1.1 * top)
        for event in response.events:
            panel.axvline(event.time_s, color="0.3", linewidth=0.8, linestyle=(0, (2, 2)))
    panels[2].set_xlim(*stretch(response, margin=1.0))
    if response.events:
        falls = ", ".join(f"{event.name.removesuffix(' falls')} {event.time_s:.2f} s" for event in response.events)
        panels[1].text(0.01, 0.95, f"falls: {falls}", transform=panels[1].transAxes, fontsize=7, va="top")
    canvas.legend(panels[0])
    canvas.legend(panels[1])
    panels[0].set_title(f"+x = {motion.name}: {response.body.name}", fontsize=9, loc="left")
    for panel, text in zip(panels, ("ground acceleration (m/s²)", "tilt θ (deg)", "slip s (mm)"), strict=True):
        canvas.label(panel, y=text)
    canvas.label(panels[2], x="t (s)")


def _largest(response: Response[StackOutcome], quantity: str) -> float:
    """Return the largest tilt or slip of the stones that stand, and of the others until they fell."""
    import numpy as np

    top = 1e-3
    for stone in response.outcome.stones:
        before = response.time <= (np.inf if stone.fell_at_s is None else stone.fell_at_s - (0.2 if quantity == "slip" else 0.0))
        top = max(top, float(response[f"{stone.name}_{quantity}"][before].max(initial=0.0)))
    return top


def stretch(response: Response[StackOutcome], *, margin: float) -> tuple[float, float]:
    """Return when the stones move noticeably, with a margin, s; the whole record if they never do."""
    import numpy as np

    time, moving = response.time, np.zeros(response.time.size, dtype=bool)
    for name in response.body.names:
        for quantity, least in (("tilt", NOTICEABLE_TILT), ("slip", NOTICEABLE_SLIP)):
            values = response[f"{name}_{quantity}"]
            moving |= (np.abs(np.gradient(values)) > 0.1 * least) & (np.abs(values - values[0]) > least)
    if not moving.any():
        return float(time[0]), float(time[-1])
    first, last = time[moving][[0, -1]]
    return max(float(first) - margin, float(time[0])), min(float(last) + margin, float(time[-1]))
