"""What an animation shows, before anyone decides how to draw it: a scene, and curves against time below it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from seisblock.core.i18n import gettext
from seisblock.core.results import Phase
from seisblock.core.typing import FloatArray
from seisblock.records import Motion
from seisblock.report.animation.scene2d import Scene2D
from seisblock.report.animation.scene3d import Scene3D
from seisblock.report.directions import phase_label as called
from seisblock.report.units_display import acceleration_unit

GROUND, RESPONSE = "#737373", "#c0392b"
"""Colours of the ground's motion and of what answers it."""


@dataclass(frozen=True, eq=False)
class Line:
    """One curve: times and values, (n,), its colour, its name where there are several, and its dashes, points on and off."""

    time: FloatArray
    values: FloatArray
    colour: str = RESPONSE
    name: str = ""
    dashes: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False)
class Strip:
    """Curves against time under the scene, with their thresholds."""

    label: str
    lines: tuple[Line, ...]
    levels: tuple[float, ...] = ()

    def range_over(self, first: float, last: float) -> tuple[float, float]:
        """Return the least and the largest value between two times, zero among them."""
        low = high = 0.0
        for line in self.lines:
            inside = line.values[(line.time >= first) & (line.time <= last)]
            low, high = float(np.fmin.reduce(inside, initial=low)), float(np.fmax.reduce(inside, initial=high))
        return low, high


@dataclass(frozen=True, eq=False)
class Animation:
    """One animation.

    Parameters
    ----------
    title : str
        What is seen, and what becomes of it.
    time : (n,) array, s
        Times of the pictures, from the record's first sample, evenly spaced.
    scene : Plane or Space
    strips : tuple of Strip
    heading : str
        Which record this is, as above every figure.
    note : str
        What one must know to read the scene.
    direction : str
        Which direction of the record +x is.
    phases, colours : sequence, mapping
        Stretches of time and the colours of those to be shaded.
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
        """The strips that show something: what did not happen has no panel."""
        span = float(self.time[0]), float(self.time[-1])
        return tuple(strip for strip in self.strips if any(strip.range_over(*span)))

    @cached_property
    def visible_phases(self) -> tuple[Phase, ...]:
        """The phases in the time shown that last long enough to be seen: dying hops come by the thousand."""
        first, last = float(self.time[0]), float(self.time[-1])
        shortest = (last - first) / 1500
        return tuple(p for p in self.phases if p.duration_s >= shortest and p.end_s >= first and p.start_s <= last)

    def called(self, name: str) -> str:
        """Return what a phase is called, in the direction of this motion."""
        return called(name, self.direction)

    def phase_at(self, time: float) -> str:
        """Return what the phase seen at a time is called, empty outside all."""
        return next((self.called(phase.name) for phase in reversed(self.visible_phases) if phase.start_s <= time <= phase.end_s), "")


BuildAnimation = Callable[[FloatArray], Animation]
"""Makes the film for the times of its pictures."""


def animation_title(body: str, outcome: str) -> str:
    """Return what a film is about, told: the body, and what becomes of it."""
    return gettext("{name}: {what}", name=gettext(body), what=gettext(outcome))


def ground_strip(motion: Motion, levels: tuple[float, ...] = (), *, gal: bool) -> Strip:
    """Return the ground's acceleration with its thresholds, m/s^2, in the unit wanted."""
    unit, name = acceleration_unit(gal=gal)
    line = Line(motion.time, motion.horizontal / unit, GROUND)
    return Strip(gettext("a ({unit})", unit=name), (line,), tuple(level / unit for level in levels))


def sample_at(times: FloatArray, time: FloatArray, values: FloatArray) -> FloatArray:
    """Return a channel at the times of the pictures; where an event stands twice, either side."""
    return np.interp(times, time, values)


def motion_interval(phases: Sequence[Phase], moving: Mapping[str, str], first: float, last: float) -> tuple[float, float]:
    """Return the stretch of time that holds all movement, with a margin; all of it when nothing moves, at most 20 s then."""
    motion_phases = [phase for phase in phases if phase.name in moving]
    if not motion_phases:
        return first, min(last, first + 20.0)
    start, end = motion_phases[0].start_s, motion_phases[-1].end_s
    margin = 0.1 * (end - start) + 0.3
    return max(first, start - margin), min(last, end + 2 * margin)
