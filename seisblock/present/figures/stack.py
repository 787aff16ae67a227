"""A pile in pictures: tilt and slip of each stone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.figures.curves import curve
from seisblock.present.figures.heading import heading_of, names_of
from seisblock.present.figures.histories import columns_of, strong_stretch
from seisblock.present.scales import Unit, acceleration_unit, length_unit
from seisblock.present.text.falls import told_falls
from seisblock.present.text.stack import NOTICEABLE_SLIP, NOTICEABLE_TILT, Stacks
from seisblock.present.wrap import wrapped
from seisblock.results import Response
from seisblock.solvers.stack.outcome import StackOutcome
from seisblock.typing import FloatArray
from seisblock.words import tell

SHADES = ("#c0392b", "#1f5a8c", "#7d7d7d", "#b8860b", "#4f7f4f", "#7a4f8c", "#111111")
DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1, 2)), (0, (1, 1)), (0, (8, 2, 2, 2)))
"""Colours and dashes of the stones from above downwards, by :func:`style_of`; the dashes tell them apart in grey."""

LINE = 84
"""Longest line of what fell, columns: as wide as a panel of two beside each other."""

FALLING = 0.2
"""How long before its fall a stone no longer slides but turns away, s."""

FALLEN = 2.0
"""How long after its fall a film follows a stone, s: a drum that lies may roll until the record ends."""


def figure(responses: Stacks, *, gal: bool = True) -> Figure:
    """Return the figure: per run the ground acceleration, and tilts and slips of the stones against time."""
    motions = [response.motion for response in responses]
    stretches = [stretch(response, margin=1.0, after=0.0) for response in responses]  # no curve goes on when its stone has fallen
    made = canvas.titled(heading_of(motions), width=3.5 + 4.5 * len(responses), height=6.6)
    far = length_unit((largest(response, "slip") for response in responses), gal=gal)
    for panels, name, response in zip(columns_of(made, motions, stretches, 3), names_of(motions), responses, strict=True):
        _column(panels, name, response, far, gal=gal)
    return made


def _column(panels: Sequence[Any], called: str, response: Response[StackOutcome], far: Unit, *, gal: bool) -> None:
    """Draw one run's three panels."""
    motion = response.motion
    unit, unit_name = acceleration_unit(gal=gal)
    rows = ((tell("up"), 2, canvas.SECOND), (tell("across"), 1, "0.7"), (tell("along {name}", name=motion.name or "x"), 0, "0.2"))
    for name, row, colour in rows:
        values = motion.acceleration[row]
        acts = row == 0 or (row == 1 and response.options["across"]) or (row == 2 and response.options["vertical"])
        if acts and values.any():
            curve(panels[0], motion.time, values / unit, color=colour, linewidth=0.7, label=name)
    for index, name in enumerate(reversed(response.body.names)):
        colour, dashes = style_of(index)
        style: dict[str, Any] = {"color": colour, "linestyle": dashes, "label": tell(name)}
        curve(panels[1], response.time, np.degrees(tilt_of(response, name)), **style)
        curve(panels[2], response.time, slip_of(response, name) / far.size, **style)
    for panel, quantity, factor in ((panels[1], "tilt", math.degrees(1.0)), (panels[2], "slip", 1.0 / far.size)):
        top = factor * largest(response, quantity)
        panel.set_ylim(-0.05 * top, 1.1 * top)
        for event in response.events:
            panel.axvline(event.time_s, color="0.3", linewidth=0.8, linestyle=(0, (2, 2)))
    if response.events:  # above the panel, where it hides neither a curve nor when a stone falls
        fate = "\n".join(wrapped(told_falls(response), LINE))
        panels[1].set_title(fate, fontsize=7, loc="left", linespacing=1.4, parse_math=False)
    canvas.legend(panels[0])
    canvas.legend(panels[2])  # between the two whose curves it names
    canvas.panel_title(panels[0], f"+x = {called}: {tell(response.body.name)}")
    labels = tell("a ({unit})", unit=unit_name), tell("tilt θ (deg)"), tell("slip s ({unit})", unit=far.name)
    for panel, text in zip(panels, labels, strict=True):
        canvas.label(panel, y=text)


def style_of(index: int) -> tuple[str, Any]:
    """Return colour and dashes of a stone, counted from above: seven of the one and six of the other, so that no two of 42 share both."""
    return SHADES[index % len(SHADES)], DASHES[index % len(DASHES)]


def tilt_of(response: Response[StackOutcome], name: str) -> FloatArray:
    """Return the tilt of a stone against time, (n,), rad; nothing from its fall on."""
    return _until_it_falls(response, name, "tilt", 0.0)


def slip_of(response: Response[StackOutcome], name: str) -> FloatArray:
    """Return the slip of a stone against time, (n,), m; nothing from where it turns away to fall."""
    return _until_it_falls(response, name, "slip", FALLING)


def _until_it_falls(response: Response[StackOutcome], name: str, quantity: str, before: float) -> FloatArray:
    """Return a quantity of a stone against time, (n,), and nothing from so long before its fall on, s."""
    fell = next(stone.fell_at_s for stone in response.outcome.stones if stone.name == name)
    values = response[f"{name}_{quantity}"]
    return values if fell is None else np.where(response.time <= fell - before, values, np.nan)


def largest(response: Response[StackOutcome], quantity: str) -> float:
    """Return the largest tilt or slip of the stones that stand, and of the others until they fell."""
    top = 1e-3
    for stone in response.outcome.stones:
        before = response.time <= (np.inf if stone.fell_at_s is None else stone.fell_at_s - (FALLING if quantity == "slip" else 0.0))
        top = max(top, float(response[f"{stone.name}_{quantity}"][before].max(initial=0.0)))
    return top


def stretch(response: Response[StackOutcome], *, margin: float, after: float = FALLEN) -> tuple[float, float]:
    """Return when the stones move noticeably, each until so long `after` its fall, with a margin, s; if none does, the strong part."""
    time, moving = response.time, np.zeros(response.time.size, dtype=bool)
    for stone in response.outcome.stones:
        followed = time <= (np.inf if stone.fell_at_s is None else stone.fell_at_s + after)
        for quantity, least in (("tilt", NOTICEABLE_TILT), ("slip", NOTICEABLE_SLIP)):
            values = response[f"{stone.name}_{quantity}"]
            moving |= (np.abs(np.gradient(values)) > 0.1 * least) & (np.abs(values - values[0]) > least) & followed
    if not moving.any():
        return strong_stretch(response.motion)
    first, last = time[moving][[0, -1]]
    return max(float(first) - margin, float(time[0])), min(float(last) + margin, float(time[-1]))
