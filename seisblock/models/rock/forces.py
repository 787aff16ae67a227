"""Contact forces of a rocking block: friction demand and loss of contact, the limits of the pure rocking model.

Forces are evaluated at every row of a trajectory, then inside the intervals next to the extreme rows. There the tilt is interpolated by the
quintic Hermite polynomial of angle, angular velocity and angular acceleration, with an error below 1e-9 of the tilt at 100 Hz.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.block import LEFT, RIGHT
from seisblock.core.typing import FloatArray, IntArray
from seisblock.dynamics import Path, Trajectory
from seisblock.models.rock.model import BEYOND_LEFT, REST, TO_LEFT
from seisblock.models.rock.params import RockParams
from seisblock.records import Motion

INNER_POINTS = np.linspace(0.0, 1.0, 9)
"""Evaluation points between two rows, as fractions of the interval, both ends included."""

MAX_ROWS = 200
"""Largest number of refined rows of each kind: largest friction demand, smallest normal force."""


@dataclass(frozen=True)
class FrictionDemand:
    """Friction coefficient required for pure rocking, and loss of contact.

    Parameters
    ----------
    friction : float
        Largest abs(H/N); infinite if contact is lost.
    friction_s : float or None
        Time of the largest demand.
    contact_lost_s : float or None
        First time with N <= 0.
    """

    friction: float
    friction_s: float | None
    contact_lost_s: float | None


@dataclass(frozen=True, eq=False)
class _TrajectoryRows:
    """Rows of a trajectory, (n,) each: row number, time, state, ground motion, mode, and block properties of the mode's corner."""

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

    def select(self, index: IntArray | tuple[IntArray, None]) -> _TrajectoryRows:
        """Return a selection of rows."""
        arrays: dict[str, Any] = {key: values[index] for key, values in vars(self).items() if isinstance(values, np.ndarray)}
        return replace(self, **arrays)

    def select_extremes(self) -> _TrajectoryRows:
        """Return the rows nearest to slip and to loss of contact with their neighbours, the first rocking row, and both ends."""
        # short runs are evaluated completely; the selection only bounds the memory of long records
        if self.time.size <= MAX_ROWS:
            return self
        ratio, normal = self.ratio()
        rows = np.concatenate([_extreme_rows(ratio, normal), [np.argmax(ratio)], np.flatnonzero(self.mode != REST)[:1]])
        neighbours = np.unique(np.clip(np.concatenate([rows - 1, rows, rows + 1, [0, self.time.size - 1]]), 0, self.time.size - 1))
        return self.select(neighbours)

    def ratio(self) -> tuple[FloatArray, FloatArray]:
        """Return abs(H/N), infinite where contact is lost, and N/m."""
        horizontal, normal = self.forces(self.theta, self.omega, self.push, self.weight)
        with np.errstate(divide="ignore"):
            # contact lost counts as an infinite demand, so that one maximum finds both limits of the model
            return np.where(normal > 0.0, np.abs(horizontal) / np.maximum(normal, 1e-300), math.inf), normal

    def angular_acceleration(self, theta: FloatArray, push: FloatArray, weight: FloatArray) -> FloatArray:
        """Return the angular acceleration at the given tilts and ground accelerations, rad/s^2."""
        psi = self.lean - theta
        return -self.lever * (weight * (psi if self.linear else np.sin(psi)) + push * (1.0 if self.linear else np.cos(psi)))

    def forces(self, theta: FloatArray, omega: FloatArray, push: FloatArray, weight: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return H/m and N/m at the given states; psi = s alpha - theta is the angle of R to the vertical (derived here)."""
        psi = self.lean - theta
        sine, cosine = np.sin(psi), np.cos(psi)
        alpha = -self.lever * (weight * (psi if self.linear else sine) + push * (1.0 if self.linear else cosine))
        horizontal = push + self.radius * (alpha * cosine + omega**2 * sine)
        normal = weight + self.radius * (alpha * sine - omega**2 * cosine)
        # at rest the base carries the load anywhere between the corners: H = a and N = g + a_v
        at_rest = self.mode == REST
        return np.where(at_rest, push, horizontal), np.where(at_rest, weight, normal)


def friction_demand(params: RockParams, motion: Motion, trajectory: Trajectory, *, until_s: float) -> FrictionDemand:
    """Return the largest friction demand and the loss of contact before `until_s` (s after sample 0), impacts excluded.

    The centre of gravity moves relative to the ground as a point at distance R from the corner in contact (derived here): with
    psi = s alpha - theta, H/m = a + R (theta'' cos(psi) + theta'^2 sin(psi)), N/m = g + a_v + R (theta'' sin(psi) - theta'^2 cos(psi)).
    """
    pieces = list(_row_chunks(params, motion, trajectory, until_s))
    rows = pieces[0] if len(pieces) == 1 else _concatenate(pieces)
    if rows.time.size == 0:
        return FrictionDemand(0.0, None, None)
    ratio, normal = rows.ratio()
    best = int(np.argmax(ratio))
    # without rocking the samples are exact: demand is a ratio of linear functions, extreme at a sample
    if not (rows.mode != REST).any():
        return FrictionDemand(float(ratio[best]), float(rows.time[best]), float(rows.time[best]) if ratio[best] == math.inf else None)
    extremes = _extreme_rows(ratio, normal)
    is_near = np.zeros(rows.time.size, dtype=bool)
    # the peak may lie on either side of an extreme row: both adjacent intervals are refined
    is_near[extremes] = is_near[extremes - 1] = True
    # refine only between rows of one mode, of positive length, that are neighbours in the full trajectory
    starts = np.flatnonzero(is_near[:-1])
    starts = starts[
        (rows.mode[starts] == rows.mode[starts + 1])
        & (rows.time[starts] < rows.time[starts + 1])
        & (rows.number[starts] + 1 == rows.number[starts + 1])
    ]
    times, horizontal, normal = _inner_forces(rows, starts)
    lost_contact = np.flatnonzero((normal <= 0.0).ravel())
    # contact lost at a row, for example just after an impact, precedes what the interpolation finds
    first = float(rows.time[np.isinf(ratio)].min()) if np.isinf(ratio).any() else math.inf
    if lost_contact.size:
        row, column = divmod(int(lost_contact[0]), INNER_POINTS.size)
        time = times[row, column]
        if column > 0:
            # zero of N by linear interpolation
            high, low = normal[row, column - 1], normal[row, column]
            time -= (time - times[row, column - 1]) * low / (low - high)
        first = min(first, float(time))
    if first < math.inf:
        return FrictionDemand(math.inf, first, first)
    inner_ratio = np.abs(horizontal) / normal
    if inner_ratio.size == 0 or inner_ratio.max() <= ratio[best]:
        return FrictionDemand(float(ratio[best]), float(rows.time[best]), None)
    row, column = divmod(int(np.argmax(inner_ratio)), INNER_POINTS.size)
    return _refine_peak(inner_ratio[row], times[row], column)


def _extreme_rows(ratio: FloatArray, normal: FloatArray) -> IntArray:
    """Return the rows of the largest friction demand and those of the smallest normal force."""
    count = min(MAX_ROWS, ratio.size)
    return np.concatenate([np.argpartition(-ratio, count - 1)[:count], np.argpartition(normal, count - 1)[:count]])


def _row_chunks(params: RockParams, motion: Motion, trajectory: Trajectory, until_s: float) -> Iterator[_TrajectoryRows]:
    """Yield the rows before `until_s`, one chunk per path; with several paths only extreme rows, which bounds the memory."""
    chunk: _TrajectoryRows | None = None
    first = count = 0
    for path in trajectory.iter_paths():
        if chunk is not None:
            yield chunk.select_extremes()
        first, (chunk, size) = count, _rows_until(params, motion, path, until_s, count)
        count += size
    if chunk is not None:
        yield chunk if first == 0 else chunk.select_extremes()


def _concatenate(pieces: Sequence[_TrajectoryRows]) -> _TrajectoryRows:
    """Return consecutive chunks of rows as one."""
    names = [key for key, values in vars(pieces[0]).items() if isinstance(values, np.ndarray)]
    arrays: dict[str, Any] = {key: np.concatenate([getattr(piece, key) for piece in pieces]) for key in names}
    return replace(pieces[0], **arrays)


def _rows_until(params: RockParams, motion: Motion, path: Path, until_s: float, offset: int) -> tuple[_TrajectoryRows, int]:
    """Return the relevant rows of a path before `until_s`, numbered from `offset`, and the total number of rows of the path."""
    size = path.modes.size
    if math.isfinite(until_s):
        size = int(np.searchsorted(path.dt * np.arange(path.first, path.first + size), until_s, side="right"))
    span = slice(path.first, path.first + size)
    weight = np.full(size, params.gravity)
    if params.vertical != 0.0:
        weight += motion.vertical[span] * params.vertical
    samples = _relevant_samples(motion.horizontal[span], weight, path.modes[:size])
    time, states, modes = path.table(samples)
    push = path.interpolate(motion.horizontal, samples)
    weight = np.full(time.size, params.gravity)
    if params.vertical != 0.0:
        weight += path.interpolate(motion.vertical, samples) * params.vertical
    n = int(np.searchsorted(time, until_s, side="right")) if math.isfinite(until_s) else time.size
    leans_left = (modes[:n] == TO_LEFT) | (modes[:n] == BEYOND_LEFT)
    rows = _TrajectoryRows(
        offset + path.row_indices(samples)[:n],
        time[:n],
        states[:n, 0],
        states[:n, 1],
        push[:n],
        weight[:n],
        modes[:n],
        lean=np.where(leans_left, -params.alphas[LEFT], params.alphas[RIGHT]),
        lever=np.where(leans_left, params.levers[LEFT], params.levers[RIGHT]),
        radius=np.where(leans_left, params.radii[LEFT], params.radii[RIGHT]),
        linear=params.linear,
    )
    return rows, path.modes.size + 2 * len(path.events)


def _relevant_samples(push: FloatArray, weight: FloatArray, modes: IntArray) -> IntArray:
    """Return the samples to evaluate: all samples in motion, and of those at rest the one with the largest friction demand."""
    moving = modes != REST
    # where the weight vanishes the ratio loses its meaning: all rows are kept
    if moving.all() or not (weight > 0.0).all():
        return np.arange(modes.size)
    resting = np.flatnonzero(~moving)
    peak = resting[np.argmax(np.abs(push[resting]) / weight[resting])]
    moving[peak] = True
    return np.flatnonzero(moving)


def _inner_forces(rows: _TrajectoryRows, starts: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return times, H/m and N/m at the inner points of k intervals, (k, 9) each."""
    first, last = rows.select((starts, None)), rows.select((starts + 1, None))
    step = last.time - first.time
    u = INNER_POINTS[None, :]
    start, end = (
        (row.theta, row.omega * step, row.angular_acceleration(row.theta, row.push, row.weight) * step**2) for row in (first, last)
    )
    theta, omega = _quintic(start, end, u)
    # the record is piecewise linear; only the tilt needs the higher order
    push = first.push * (1 - u) + last.push * u
    weight = first.weight * (1 - u) + last.weight * u
    return first.time + u * step, *first.forces(theta, omega / step, push, weight)


def _quintic(
    first: tuple[FloatArray, FloatArray, FloatArray], last: tuple[FloatArray, FloatArray, FloatArray], u: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return value and derivative at `u` of the quintic Hermite polynomial with (value, first, second derivative) at 0 and 1."""
    y0, v0, a0 = first
    y1, v1, a1 = last
    # remainders of value, slope and curvature after the quadratic start, in units of the interval
    rise = y1 - y0 - v0 - a0 / 2
    speed = v1 - v0 - a0
    bend = a1 - a0
    c3 = 10 * rise - 4 * speed + bend / 2
    c4 = -15 * rise + 7 * speed - bend
    c5 = 6 * rise - 3 * speed + bend / 2
    value = y0 + u * (v0 + u * (a0 / 2 + u * (c3 + u * (c4 + u * c5))))
    slope = v0 + u * (a0 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))
    return value, slope


def _refine_peak(ratio: FloatArray, times: FloatArray, column: int) -> FrictionDemand:
    """Return the maximum of the parabola through the largest value and its neighbours."""
    best, time = float(ratio[column]), float(times[column])
    if 0 < column < ratio.size - 1:
        left_value, peak_value, right_value = ratio[column - 1 : column + 2]
        bend = left_value - 2 * peak_value + right_value
        if bend < 0.0:
            offset = 0.5 * (left_value - right_value) / bend
            best = float(peak_value - 0.125 * (left_value - right_value) ** 2 / bend)
            time += offset * float(times[1] - times[0])
    return FrictionDemand(best, time, None)
