"""Content of an animation, independent of its format: a scene, and curves against time below."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from seisblock.core.i18n import gettext
from seisblock.core.results import Phase
from seisblock.core.typing import FloatArray
from seisblock.output.animation.scene2d import Scene2D
from seisblock.output.animation.scene3d import Scene3D
from seisblock.output.directions import phase_label
from seisblock.output.units_display import acceleration_unit
from seisblock.records import Motion

GROUND, RESPONSE = "#737373", "#c0392b"
"""Colours of ground motion and response."""


@dataclass(frozen=True, eq=False)
class Line:
    """A curve: times and values, (n,), colour, name for the legend, and dash pattern (points on, off)."""

    time: FloatArray
    values: FloatArray
    colour: str = RESPONSE
    name: str = ""
    dashes: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False)
class Strip:
    """Panel of curves against time below the scene, with threshold lines."""

    label: str
    lines: tuple[Line, ...]
    levels: tuple[float, ...] = ()

    def range_over(self, first: float, last: float) -> tuple[float, float]:
        """Return the smallest and the largest value between two times, zero included."""
        low = high = 0.0
        for line in self.lines:
            inside = line.values[(line.time >= first) & (line.time <= last)]
            low, high = float(np.fmin.reduce(inside, initial=low)), float(np.fmax.reduce(inside, initial=high))
        return low, high


@dataclass(frozen=True, eq=False)
class Animation:
    """Content of an animation.

    Parameters
    ----------
    title : str
        Body, and its overturning probability where samples were solved: the title does not give away the end.
    time : (n,) array, s
        Times of the frames from the first sample of the record, evenly spaced.
    scene : Scene2D or Scene3D
    strips : tuple of Strip
    heading : str
        Record, as in the title of every figure.
    note : str
        Explanation of the scene.
    direction : str
        Component or azimuth that is +x.
    phases, colours : sequence, mapping
        Phases of the response, and the colours of those to be shaded.
    """

    title: str
    time: FloatArray
    scene: Scene2D | Scene3D
    strips: tuple[Strip, ...] = ()
    heading: str = ""
    note: str = ""
    direction: str = ""
    phases: Sequence[Phase] = ()
    colours: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def panels(self) -> tuple[Strip, ...]:
        """Strips with a nonzero curve in the time shown; the others get no panel."""
        span = float(self.time[0]), float(self.time[-1])
        return tuple(strip for strip in self.strips if any(strip.range_over(*span)))

    @cached_property
    def visible_phases(self) -> tuple[Phase, ...]:
        """Phases in the time shown that are long enough to be visible; decaying impacts produce thousands of shorter ones."""
        first, last = float(self.time[0]), float(self.time[-1])
        shortest = (last - first) / 1500
        return tuple(p for p in self.phases if p.duration_s >= shortest and p.end_s >= first and p.start_s <= last)

    def phase_label(self, name: str) -> str:
        """Return the display name of a phase in the direction of this motion."""
        return phase_label(name, self.direction)

    def phase_at(self, time: float) -> str:
        """Return the display name of the visible phase at a time, empty if none."""
        return next((self.phase_label(phase.name) for phase in reversed(self.visible_phases) if phase.start_s <= time <= phase.end_s), "")


BuildAnimation = Callable[[FloatArray], Animation]
"""Function from the times of the frames, s, to the animation."""


def ground_strip(motion: Motion, levels: tuple[float, ...] = (), *, gal: bool) -> Strip:
    """Return the strip of ground acceleration with thresholds, m/s^2, in the display unit."""
    unit, name = acceleration_unit(gal=gal)
    line = Line(motion.time, motion.horizontal / unit, GROUND)
    return Strip(gettext("a ({unit})", unit=name), (line,), tuple(level / unit for level in levels))


def sample_at(times: FloatArray, time: FloatArray, values: FloatArray) -> FloatArray:
    """Interpolate a channel at the times of the frames; at an event, which has two rows, either side is taken."""
    return np.interp(times, time, values)


def motion_interval(phases: Sequence[Phase], moving: Mapping[str, str], first: float, last: float) -> tuple[float, float]:
    """Return the interval that contains all phases of motion, with a margin; without motion the first 20 s."""
    motion_phases = [phase for phase in phases if phase.name in moving]
    if not motion_phases:
        return first, min(last, first + 20.0)
    start, end = motion_phases[0].start_s, motion_phases[-1].end_s
    margin = 0.1 * (end - start) + 0.3
    return max(first, start - margin), min(last, end + 2 * margin)
