"""Side view: rigid polygons on a ground moving along x, and the paths of points."""

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
    """A rigid polygon of a body: corners (k, 2), m, in the frame of the body, and colour."""

    corners: FloatArray
    colour: str = "#d9d3c7"


@dataclass(frozen=True, eq=False)
class Body:
    """A moving body: polygons, and the position of their common origin relative to the ground.

    Parameters
    ----------
    pieces : tuple of Piece
    x, z : (n,) arrays, m
    turn : (n,) array, rad
        Positive for a tilt to +x.
    """

    pieces: tuple[Piece, ...]
    x: FloatArray
    z: FloatArray
    turn: FloatArray

    def corners_at(self, corners: FloatArray, index: int) -> FloatArray:
        """Return corners in frame `index`, (k, 2), m relative to the ground."""
        return rotate(corners, float(self.turn[index])) + np.array([self.x[index], self.z[index]])

    def path(self, corner: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the path of a point of the body relative to the ground, x and z, (n,), m."""
        cosine, sine = np.cos(self.turn), np.sin(self.turn)
        return self.x + corner[0] * cosine + corner[1] * sine, self.z + corner[1] * cosine - corner[0] * sine


@dataclass(frozen=True, eq=False)
class Trail:
    """Path of a point relative to the ground, drawn up to the current time: time (m,), s, x and z (m,), m."""

    name: str
    time: FloatArray
    x: FloatArray
    z: FloatArray
    colour: str = "#c0392b"

    def until(self, end_time: float) -> tuple[FloatArray, FloatArray]:
        """Return the path up to a time, x and z, ending at the interpolated position."""
        past = self.time <= end_time
        end = (np.interp(end_time, self.time, values) for values in (self.x, self.z))
        x, z = (np.append(values[past], last) for values, last in zip((self.x, self.z), end, strict=True))
        return x, z


@dataclass(frozen=True, eq=False)
class Scene2D:
    """Side view of bodies on the ground.

    Parameters
    ----------
    shift : (n,) array, m
        Displacement of the ground.
    bodies, trails : tuples
    floors : tuple of (k, 2) arrays, m
        Polygons that move with the ground.
    close : Box or None
        Close-up window relative to the ground.
    """

    shift: FloatArray
    bodies: tuple[Body, ...]
    floors: tuple[FloatArray, ...]
    trails: tuple[Trail, ...] = ()
    close: Box | None = None

    @property
    def extent(self) -> Box:
        """Bounding box of the ground and of all bodies in all frames with a margin, in a fixed frame."""
        bounds = [
            (np.min(x + self.shift), np.max(x + self.shift), np.min(z), np.max(z))
            for body in self.bodies
            for piece in body.pieces
            for x, z in (body.path(corner) for corner in piece.corners)
        ]
        left, right, bottom, top = (function([r[i] for r in bounds]) for i, function in enumerate((min, max, min, max)))
        if self.floors:
            bottom = min(bottom, self.floors[0][:, 1].max())
        margin = 0.12 * max(right - left, top - bottom)
        return float(left - margin), float(right + margin), float(bottom - margin), float(top + margin)


def rotate(points: FloatArray, angle: float) -> FloatArray:
    """Rotate points (k, 2) about the origin, positive to +x (clockwise)."""
    cosine, sine = np.cos(angle), np.sin(angle)
    x, z = points.T
    return np.column_stack([x * cosine + z * sine, z * cosine - x * sine])


def rectangle(left: float, right: float, bottom: float, top: float) -> FloatArray:
    """Return the corners of a rectangle, counter-clockwise from the lower left, (4, 2), m."""
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top]])


def ground_shift(motion: Motion, times: FloatArray) -> FloatArray:
    """Return the ground displacement at given times, with the baseline correction of PGD, (n,), m."""
    displacement = ground_history(motion.horizontal, motion.dt).displacement
    return np.interp(times, motion.time, displacement)
