"""Contact forces of a rocking block: when pure rocking is the wrong model, because it would slip or leave the ground.

Forces are computed at every row of a trajectory, then between the rows that come nearest to the extreme. There the lean is the quintic that
has its angle, angular velocity and angular acceleration at both ends, which is closer than 1e-9 of the lean at 100 Hz.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.block import LEFT, RIGHT
from seisblock.dynamics import Path, Trajectory
from seisblock.records import Motion
from seisblock.solvers.rock.model import BEYOND_LEFT, REST, TO_LEFT
from seisblock.solvers.rock.rocker import Rocker
from seisblock.typing import FloatArray, IntArray

INNER = np.linspace(0.0, 1.0, 9)
"""Where forces are looked at between two rows, as shares of the interval; both ends are among them."""

LOOKED_AT = 200
"""Between so many rows at most, those of the largest demand and those of the least normal force."""


@dataclass(frozen=True)
class Demand:
    """What the ground must do for the block to rock and nothing else.

    Parameters
    ----------
    friction : float
        Largest abs(H/N); infinite when contact is lost.
    friction_s : float or None
        When.
    contact_lost_s : float or None
        First time at which N <= 0.
    """

    friction: float
    friction_s: float | None
    contact_lost_s: float | None


@dataclass(frozen=True, eq=False)
class _Rows:
    """Rows of a trajectory, by their numbers, with the ground motion, and the block as a table by mode."""

    number: IntArray
    time: FloatArray
    theta: FloatArray
    omega: FloatArray
    push: FloatArray
    weight: FloatArray
    mode: IntArray
    lean: FloatArray
    lever: FloatArray
    radius: FloatArray
    linear: bool

    def pick(self, index: IntArray | tuple[IntArray, None]) -> _Rows:
        """Return some of the rows."""
        arrays: dict[str, Any] = {key: values[index] for key, values in vars(self).items() if isinstance(values, np.ndarray)}
        return replace(self, **arrays)

    def extremes(self) -> _Rows:
        """Return the rows that come nearest to slipping and to leaving the ground, with their neighbours, and where rocking shows."""
        if self.time.size <= LOOKED_AT:
            return self
        ratio, normal = self.ratio()
        chosen = np.concatenate([_chosen(ratio, normal), [np.argmax(ratio)], np.flatnonzero(self.mode != REST)[:1]])
        near = np.unique(np.clip(np.concatenate([chosen - 1, chosen, chosen + 1, [0, self.time.size - 1]]), 0, self.time.size - 1))
        return self.pick(near)

    def ratio(self) -> tuple[FloatArray, FloatArray]:
        """Return abs(H/N), infinite where contact is lost, and N/m."""
        along, normal = self.forces(self.theta, self.omega, self.push, self.weight)
        with np.errstate(divide="ignore"):
            return np.where(normal > 0.0, np.abs(along) / np.maximum(normal, 1e-300), math.inf), normal

    def angular(self, theta: FloatArray, push: FloatArray, weight: FloatArray) -> FloatArray:
        """Return the angular acceleration at other leans and ground accelerations, rad/s^2."""
        psi = self.lean - theta
        return -self.lever * (weight * (psi if self.linear else np.sin(psi)) + push * (1.0 if self.linear else np.cos(psi)))

    def forces(self, theta: FloatArray, omega: FloatArray, push: FloatArray, weight: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return H/m and N/m at other states: psi = s alpha - theta turns R into the horizontal and the vertical (derived here)."""
        psi = self.lean - theta
        sine, cosine = np.sin(psi), np.cos(psi)
        alpha = -self.lever * (weight * (psi if self.linear else sine) + push * (1.0 if self.linear else cosine))
        along = push + self.radius * (alpha * cosine + omega**2 * sine)
        normal = weight + self.radius * (alpha * sine - omega**2 * cosine)
        at_rest = self.mode == REST
        return np.where(at_rest, push, along), np.where(at_rest, weight, normal)


def demand(block: Rocker, motion: Motion, trajectory: Trajectory, *, until_s: float) -> Demand:
    """Return the largest friction demand, and the loss of contact, before `until_s` (s after sample 0); impacts excepted.

    The block's acceleration relative to the ground is that of a point at R from the corner in contact (derived here): with
    psi = s alpha - theta, H/m = a + R (theta'' cos(psi) + theta'^2 sin(psi)), N/m = g + a_v + R (theta'' sin(psi) - theta'^2 cos(psi)).
    """
    pieces = list(_pieces(block, motion, trajectory, until_s))
    rows = pieces[0] if len(pieces) == 1 else _joined(pieces)
    if rows.time.size == 0:
        return Demand(0.0, None, None)
    ratio, normal = rows.ratio()
    best = int(np.argmax(ratio))
    if not (rows.mode != REST).any():
        return Demand(float(ratio[best]), float(rows.time[best]), float(rows.time[best]) if ratio[best] == math.inf else None)
    chosen = _chosen(ratio, normal)
    near = np.zeros(rows.time.size, dtype=bool)
    near[chosen] = near[chosen - 1] = True
    at = np.flatnonzero(near[:-1])
    at = at[(rows.mode[at] == rows.mode[at + 1]) & (rows.time[at] < rows.time[at + 1]) & (rows.number[at] + 1 == rows.number[at + 1])]
    moments, along, normal = _between(rows, at)
    lost = np.flatnonzero((normal <= 0.0).ravel())
    first = float(rows.time[np.isinf(ratio)].min()) if np.isinf(ratio).any() else math.inf
    if lost.size:
        row, column = divmod(int(lost[0]), INNER.size)
        moment = moments[row, column]
        if column > 0:
            high, low = normal[row, column - 1], normal[row, column]
            moment -= (moment - moments[row, column - 1]) * low / (low - high)
        first = min(first, float(moment))
    if first < math.inf:
        return Demand(math.inf, first, first)
    inside = np.abs(along) / normal
    if inside.size == 0 or inside.max() <= ratio[best]:
        return Demand(float(ratio[best]), float(rows.time[best]), None)
    row, column = divmod(int(np.argmax(inside)), INNER.size)
    return _polished(inside[row], moments[row], column)


def _chosen(ratio: FloatArray, normal: FloatArray) -> IntArray:
    """Return the rows of the largest demand and those of the least normal force."""
    near = min(LOOKED_AT, ratio.size)
    return np.concatenate([np.argpartition(-ratio, near - 1)[:near], np.argpartition(normal, near - 1)[:near]])


def _pieces(block: Rocker, motion: Motion, trajectory: Trajectory, until_s: float) -> Iterator[_Rows]:
    """Yield the rows up to a time; of a path in several pieces those that may matter, so that no more than a piece is held."""
    held: _Rows | None = None
    first = count = 0
    for path in trajectory.walk():
        if held is not None:
            yield held.extremes()
        first, (held, size) = count, _rows(block, motion, path, until_s, count)
        count += size
    if held is not None:
        yield held if first == 0 else held.extremes()


def _joined(pieces: Sequence[_Rows]) -> _Rows:
    """Return the rows of some pieces that follow each other."""
    names = [key for key, values in vars(pieces[0]).items() if isinstance(values, np.ndarray)]
    arrays: dict[str, Any] = {key: np.concatenate([getattr(piece, key) for piece in pieces]) for key in names}
    return replace(pieces[0], **arrays)


def _rows(block: Rocker, motion: Motion, path: Path, until_s: float, before: int) -> tuple[_Rows, int]:
    """Return the rows of a path up to a time, after so many, that may matter, with what the forces need; and how many there are in all."""
    size = path.modes.size
    if math.isfinite(until_s):
        size = int(np.searchsorted(path.dt * np.arange(path.first, path.first + size), until_s, side="right"))
    span = slice(path.first, path.first + size)
    weight = np.full(size, block.gravity)
    if block.vertical != 0.0:
        weight += motion.vertical[span] * block.vertical
    chosen = _telling(motion.horizontal[span], weight, path.modes[:size])
    time, states, modes = path.table(chosen)
    push = path.sampled(motion.horizontal, chosen)
    weight = np.full(time.size, block.gravity)
    if block.vertical != 0.0:
        weight += path.sampled(motion.vertical, chosen) * block.vertical
    n = int(np.searchsorted(time, until_s, side="right")) if math.isfinite(until_s) else time.size
    left = (modes[:n] == TO_LEFT) | (modes[:n] == BEYOND_LEFT)
    rows = _Rows(
        before + path.numbers(chosen)[:n],
        time[:n],
        states[:n, 0],
        states[:n, 1],
        push[:n],
        weight[:n],
        modes[:n],
        lean=np.where(left, -block.alphas[LEFT], block.alphas[RIGHT]),
        lever=np.where(left, block.levers[LEFT], block.levers[RIGHT]),
        radius=np.where(left, block.radii[LEFT], block.radii[RIGHT]),
        linear=block.linear,
    )
    return rows, path.modes.size + 2 * len(path.changes)


def _telling(push: FloatArray, weight: FloatArray, modes: IntArray) -> IntArray:
    """Return which samples have to be looked at: of those at rest, where forces are extreme, the one of the largest demand."""
    moving = modes != REST
    if moving.all() or not (weight > 0.0).all():
        return np.arange(modes.size)
    resting = np.flatnonzero(~moving)
    most = resting[np.argmax(np.abs(push[resting]) / weight[resting])]
    moving[most] = True
    return np.flatnonzero(moving)


def _between(rows: _Rows, at: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return times, H/m and N/m at the inner points of some intervals, (k, 9) each."""
    first, last = rows.pick((at, None)), rows.pick((at + 1, None))
    step = last.time - first.time
    u = INNER[None, :]
    start, end = ((row.theta, row.omega * step, row.angular(row.theta, row.push, row.weight) * step**2) for row in (first, last))
    theta, omega = _quintic(start, end, u)
    push = first.push * (1 - u) + last.push * u
    weight = first.weight * (1 - u) + last.weight * u
    return first.time + u * step, *first.forces(theta, omega / step, push, weight)


def _quintic(
    first: tuple[FloatArray, FloatArray, FloatArray], last: tuple[FloatArray, FloatArray, FloatArray], u: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return value and derivative at `u` of the quintic with value, first and second derivative given at 0 and 1."""
    y0, v0, a0 = first
    y1, v1, a1 = last
    rise = y1 - y0 - v0 - a0 / 2
    speed = v1 - v0 - a0
    bend = a1 - a0
    c3 = 10 * rise - 4 * speed + bend / 2
    c4 = -15 * rise + 7 * speed - bend
    c5 = 6 * rise - 3 * speed + bend / 2
    value = y0 + u * (v0 + u * (a0 / 2 + u * (c3 + u * (c4 + u * c5))))
    slope = v0 + u * (a0 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))
    return value, slope


def _polished(ratio: FloatArray, moments: FloatArray, column: int) -> Demand:
    """Return the maximum of a curve from its largest value and the parabola through its neighbours."""
    best, when = float(ratio[column]), float(moments[column])
    if 0 < column < ratio.size - 1:
        before, here, after = ratio[column - 1 : column + 2]
        bend = before - 2 * here + after
        if bend < 0.0:
            offset = 0.5 * (before - after) / bend
            best = float(here - 0.125 * (before - after) ** 2 / bend)
            when += offset * float(moments[1] - moments[0])
    return Demand(best, when, None)
