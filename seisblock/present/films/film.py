"""What an animation shows, before anyone decides how to draw it: shapes on a shaking ground, paths, and curves below."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from seisblock.measures import ground_history
from seisblock.records import Motion
from seisblock.results import Phase
from seisblock.typing import FloatArray
from seisblock.words import tell

Box = tuple[float, float, float, float]
"""Left, right, bottom, top, m."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A rigid polygon of a body: (k, 2) corners, m, in the body's own frame, and its colour."""

    corners: FloatArray
    colour: str = "#d9d3c7"


@dataclass(frozen=True, eq=False)
class Body:
    """What moves: pieces, and where their common origin is relative to the ground.

    Parameters
    ----------
    pieces : tuple of Piece
    x, z : (n,) arrays, m
    turn : (n,) array, rad
        Positive when the body leans to +x.
    """

    pieces: tuple[Piece, ...]
    x: FloatArray
    z: FloatArray
    turn: FloatArray

    def placed(self, corners: FloatArray, index: int) -> FloatArray:
        """Return corners where they are in picture `index`, (k, 2), m relative to the ground."""
        return turned(corners, float(self.turn[index])) + np.array([self.x[index], self.z[index]])

    def path(self, corner: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the path of one point of the body relative to the ground, x and z, (n,), m."""
        cosine, sine = np.cos(self.turn), np.sin(self.turn)
        return self.x + corner[0] * cosine + corner[1] * sine, self.z + corner[1] * cosine - corner[0] * sine


@dataclass(frozen=True, eq=False)
class Trail:
    """The path of a point relative to the ground, drawn behind it: x and z, (n,), m."""

    name: str
    x: FloatArray
    z: FloatArray
    colour: str = "#c0392b"


@dataclass(frozen=True, eq=False)
class Strip:
    """A curve against time under the scene, with its thresholds."""

    label: str
    time: FloatArray
    values: FloatArray
    levels: tuple[float, ...] = ()
    colour: str = "#c0392b"


@dataclass(frozen=True, eq=False)
class Film:
    """One animation.

    Parameters
    ----------
    title : str
    time : (n,) array, s
        Times of the pictures, from the record's first sample, evenly spaced.
    shift : (n,) array, m
        Displacement of the ground.
    bodies, trails, strips : tuples
    floors : tuple of (k, 2) arrays, m
        Polygons that move with the ground.
    phases, colours : sequence, mapping
        Stretches of time and the colours of those to be shaded.
    close : Box or None
        Window, relative to the ground, that is shown enlarged.
    """

    title: str
    time: FloatArray
    shift: FloatArray
    bodies: tuple[Body, ...]
    floors: tuple[FloatArray, ...]
    trails: tuple[Trail, ...] = ()
    strips: tuple[Strip, ...] = ()
    phases: tuple[Phase, ...] = ()
    colours: Mapping[str, str] = field(default_factory=dict)
    close: Box | None = None

    @property
    def extent(self) -> Box:
        """Box that holds every body in every picture and a strip of floor, in a frame that does not move."""
        reach = [
            (np.min(x + self.shift), np.max(x + self.shift), np.min(z), np.max(z))
            for body in self.bodies
            for piece in body.pieces
            for x, z in (body.path(corner) for corner in piece.corners)
        ]
        left, right, bottom, top = (function([r[i] for r in reach]) for i, function in enumerate((min, max, min, max)))
        margin = 0.12 * max(right - left, top - bottom)
        return float(left - margin), float(right + margin), float(bottom - margin), float(top + margin)

    @cached_property
    def seen(self) -> tuple[Phase, ...]:
        """The phases in the time shown that last long enough to be seen: dying hops come by the thousand."""
        first, last = float(self.time[0]), float(self.time[-1])
        shortest = (last - first) / 1500
        return tuple(p for p in self.phases if p.duration_s >= shortest and p.end_s >= first and p.start_s <= last)

    def phase_at(self, time: float) -> str:
        """Return the name of the phase seen at a time, empty outside all."""
        return next((phase.name for phase in reversed(self.seen) if phase.start_s <= time <= phase.end_s), "")


Build = Callable[[FloatArray], Film]
"""Makes the film for the times of its pictures."""


def titled(motion: str, body: str, what: str) -> str:
    """Return what a film is about, told: the direction of the record, the body, and what becomes of it."""
    return f"{motion}  " + tell("{name}: {what}", name=tell(body), what=tell(what))


def turned(points: FloatArray, angle: float) -> FloatArray:
    """Turn points about the origin, positive to +x (clockwise), (k, 2)."""
    cosine, sine = np.cos(angle), np.sin(angle)
    x, z = points.T
    return np.column_stack([x * cosine + z * sine, z * cosine - x * sine])


def rectangle(left: float, right: float, bottom: float, top: float) -> FloatArray:
    """Return the corners of a rectangle, counter-clockwise from the lower left, (4, 2), m."""
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top]])


def ground_shift(motion: Motion, times: FloatArray) -> FloatArray:
    """Return the displacement of the ground at some times, on the baseline of PGD, (n,), m."""
    moved = ground_history(motion.horizontal, motion.dt).displacement
    return np.interp(times, motion.time, moved)


def at(times: FloatArray, time: FloatArray, values: FloatArray) -> FloatArray:
    """Return a channel at the times of the pictures; where an event stands twice, either side."""
    return np.interp(times, time, values)


def stretch(phases: Sequence[Phase], moving: Mapping[str, str], first: float, last: float) -> tuple[float, float]:
    """Return the stretch of time that holds all movement, with a margin; all of it when nothing moves, at most 20 s then."""
    told = [phase for phase in phases if phase.name in moving]
    if not told:
        return first, min(last, first + 20.0)
    start, end = told[0].start_s, told[-1].end_s
    margin = 0.1 * (end - start) + 0.3
    return max(first, start - margin), min(last, end + 2 * margin)
