"""A scene seen from the side: rigid polygons on a ground that shakes along x, and the paths of some of their points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import FloatArray
from seisblock.measures import ground_history
from seisblock.records import Motion

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

    def corners_at(self, corners: FloatArray, index: int) -> FloatArray:
        """Return corners where they are in picture `index`, (k, 2), m relative to the ground."""
        return rotate(corners, float(self.turn[index])) + np.array([self.x[index], self.z[index]])

    def path(self, corner: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the path of one point of the body relative to the ground, x and z, (n,), m."""
        cosine, sine = np.cos(self.turn), np.sin(self.turn)
        return self.x + corner[0] * cosine + corner[1] * sine, self.z + corner[1] * cosine - corner[0] * sine


@dataclass(frozen=True, eq=False)
class Trail:
    """The path of a point relative to the ground, drawn behind it as far as it has come, on times of its own: s, x and z, (m,), m."""

    name: str
    time: FloatArray
    x: FloatArray
    z: FloatArray
    colour: str = "#c0392b"

    def until(self, end_time: float) -> tuple[FloatArray, FloatArray]:
        """Return the path up to a time, x and z, where the point then is being its end."""
        past = self.time <= end_time
        end = (np.interp(end_time, self.time, values) for values in (self.x, self.z))
        x, z = (np.append(values[past], last) for values, last in zip((self.x, self.z), end, strict=True))
        return x, z


@dataclass(frozen=True, eq=False)
class Scene2D:
    """The scene.

    Parameters
    ----------
    shift : (n,) array, m
        Displacement of the ground.
    bodies, trails : tuples
    floors : tuple of (k, 2) arrays, m
        Polygons that move with the ground.
    close : Box or None
        Window, relative to the ground, that is shown enlarged.
    """

    shift: FloatArray
    bodies: tuple[Body, ...]
    floors: tuple[FloatArray, ...]
    trails: tuple[Trail, ...] = ()
    close: Box | None = None

    @property
    def extent(self) -> Box:
        """Box that holds every body in every picture and a strip of floor, in a frame that does not move."""
        bounds = [
            (np.min(x + self.shift), np.max(x + self.shift), np.min(z), np.max(z))
            for body in self.bodies
            for piece in body.pieces
            for x, z in (body.path(corner) for corner in piece.corners)
        ]
        left, right, bottom, top = (function([r[i] for r in bounds]) for i, function in enumerate((min, max, min, max)))
        margin = 0.12 * max(right - left, top - bottom)
        return float(left - margin), float(right + margin), float(bottom - margin), float(top + margin)


def rotate(points: FloatArray, angle: float) -> FloatArray:
    """Turn points about the origin, positive to +x (clockwise), (k, 2)."""
    cosine, sine = np.cos(angle), np.sin(angle)
    x, z = points.T
    return np.column_stack([x * cosine + z * sine, z * cosine - x * sine])


def rectangle(left: float, right: float, bottom: float, top: float) -> FloatArray:
    """Return the corners of a rectangle, counter-clockwise from the lower left, (4, 2), m."""
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top]])


def ground_shift(motion: Motion, times: FloatArray) -> FloatArray:
    """Return the displacement of the ground at some times, on the baseline of PGD, (n,), m."""
    displacement = ground_history(motion.horizontal, motion.dt).displacement
    return np.interp(times, motion.time, displacement)
