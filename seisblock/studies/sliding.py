"""Parameter studies of sliding ([Fujino1978]_ figs. 7, 9, 10, 15, 16): slip against friction, friction ratio, slope and vertical motion."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase, holds_at_rest, sliding_base
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_CELLS, check_limit
from seisblock.core.typing import Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.dynamics import integrate_many
from seisblock.models.slide.final_slip import slip_at_rest
from seisblock.models.slide.model import BACKWARD, FLIGHT, FOOT, FORWARD, LEVEL, SLIDE, SLIP, STICK, UNDEFINED, parameters
from seisblock.models.slide.solve import motion_gains, raise_lift_off
from seisblock.records._validation import Gain, validate_motion, vertical_gain
from seisblock.records.motion import Motion
from seisblock.studies.parallel import cpu_count, map_threads

SLIDING_MODES = [FORWARD, BACKWARD, LEVEL + FORWARD, LEVEL + BACKWARD]

CHUNK_SIZE = 4_000_000
"""Samples times runs per thread between two progress reports."""


@dataclass(frozen=True, repr=False)
class SlidePoint(DisplayMixin):
    """One run of a study: its parameters and its slip.

    Parameters
    ----------
    component : str
    mu, mu_kinetic, kappa, slope_deg, vertical : float, 1
    holds_at_rest : bool
        True if static friction holds without shaking; otherwise there is no run, and the following fields are None.
    slips : bool
    slip_start_s, max_slip_m, max_slip_time_s, residual_slip_m, final_slip_m, slip_count, fell_off_slope, lifted_off, slides_at_end
        As in :class:`seisblock.models.slide.solve.SlideOutcome`.
    beta : float or None, 1
        Maximum slip over that of the horizontal motion alone, in a study of given factors on the vertical motion; else None, as where the
        latter is zero.
    """

    component: str
    mu: float
    mu_kinetic: float
    kappa: float
    slope_deg: float
    vertical: float
    holds_at_rest: bool
    slips: bool | None = None
    slip_start_s: float | None = None
    max_slip_m: float | None = None
    max_slip_time_s: float | None = None
    residual_slip_m: float | None = None
    final_slip_m: float | None = None
    slip_count: int | None = None
    fell_off_slope: bool | None = None
    lifted_off: bool | None = None
    slides_at_end: bool | None = None
    beta: float | None = None


def slide_study(
    mu: float | Sequence[float],
    motions: Motion | Iterable[Motion],
    *,
    mu_kinetic: float | Sequence[float] | None = None,
    kappa: float | Sequence[float] | None = None,
    vertical: Gain | Sequence[float] | None = None,
    slope_deg: float | Sequence[float] = 0.0,
    slope_length: float | None = None,
    one_way: bool = False,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
    workers: int | None = None,
) -> list[SlidePoint]:
    """Return the slip for every combination of parameters, on all cores ([Fujino1978]_ figs. 7, 9, 10, 15, 16).

    Parameters
    ----------
    mu, mu_kinetic, kappa, slope_deg, vertical : float or sequence, 1
        As in :func:`seisblock.bodies.sliding_base.sliding_base`, and the factor on the vertical ground motion; all combinations. A
        combination in which static friction does not hold at rest, or kinetic exceeds static friction, is listed without a run. A
        `vertical` of None applies the vertical motion where there is one, without the runs of the horizontal motion alone for beta.
    motions : Motion or several
    slope_length, one_way, gravity
        Common to all runs.
    progress : callable or None
        Called with the number of finished runs and the total.
    workers : int or None
        Threads; None: one per core.

    Returns
    -------
    list of SlidePoint
        Ordered by motion, then mu, friction ratio, slope, vertical scale; the last varies fastest.

    Raises
    ------
    ParameterError
        If a value lies outside its range.

    Examples
    --------
    >>> from seisblock.studies import slide_study
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> [round(point.max_slip_m, 2) for point in slide_study([0.1, 0.2], pulse)]
    [0.82, 0.44]
    """
    is_iterable = isinstance(motions, Iterable) and not isinstance(motions, (str, np.ndarray))
    motion_list: list[Motion] = list(motions) if is_iterable else [motions]  # type: ignore[arg-type, list-item]
    for motion in motion_list:
        validate_motion(motion)
    if mu_kinetic is not None and kappa is not None:
        raise ParameterError("give the kinetic friction coefficient or kappa, its ratio to the static one, not both")
    checks.gravity(gravity)
    scales = None if vertical is None else tuple(float(value) for value in _values(vertical))
    combination_count = len(scales or (1.0,)) * math.prod(len(_values(values)) for values in (mu, mu_kinetic, kappa, slope_deg))
    check_limit(N_("combinations"), len(motion_list) * combination_count, MAX_CELLS)
    for motion, scale in itertools.product(motion_list, scales or ()):
        motion_gains(motion, scale)
    bases = [
        _base(m, d, k, slope, slope_length, one_way)
        for m, d, k, slope in itertools.product(_values(mu), _values(mu_kinetic), _values(kappa), _values(slope_deg))
    ]
    if not any(isinstance(base, SlidingBase) for base in bases) or (slope_length is not None and not any(_values(slope_deg))):
        # no run is possible, or the slope length has no effect: the first combination raises the error
        sliding_base(
            _values(mu)[0],
            mu_kinetic=_values(mu_kinetic)[0],
            kappa=_values(kappa)[0],
            slope_deg=_values(slope_deg)[0],
            slope_length=slope_length,
            one_way=one_way,
        )
    # beta is relative to the horizontal motion alone, so scale 0 is added to given scales
    has_beta = scales is not None and any(scales)
    motion_scales = [(vertical_gain(motion, None),) if scales is None else scales for motion in motion_list]
    run_scales = [tuple(dict.fromkeys((*own, 0.0))) if has_beta else own for own in motion_scales]
    solved_bases = [base for base in bases if isinstance(base, SlidingBase)]
    rows = [[(base, scale) for base in solved_bases for scale in own] for own in run_scales]
    computed_points = _run_all(motion_list, rows, gravity, progress, workers or cpu_count())
    points = []
    for motion, own, runs in zip(motion_list, motion_scales, run_scales, strict=True):
        for base in bases:
            if isinstance(base, SlidingBase):
                by_scale = {scale: next(computed_points) for scale in runs}
                points += [_with_beta(by_scale[scale], by_scale[0.0]) if has_beta else by_scale[scale] for scale in own]
            else:
                points += [SlidePoint(motion.name, **base, vertical=scale, holds_at_rest=False) for scale in own]
    return points


def worst_directions(points: Sequence[SlidePoint]) -> list[SlidePoint]:
    """Return the point of the direction with the largest slip for each combination of parameters, in the order of the study."""
    worst: dict[tuple[float, ...], SlidePoint] = {}
    for point in points:
        key = (point.mu, point.mu_kinetic, point.slope_deg, point.vertical)
        if key not in worst or (point.max_slip_m or 0.0) > (worst[key].max_slip_m or 0.0):
            worst[key] = point
    return list(worst.values())


def _values(parameter: float | Sequence[float] | None) -> tuple[Any, ...]:
    """Return one or several values as a tuple without duplicates; None is one value."""
    if parameter is None or isinstance(parameter, (int, float)):
        return (parameter,)
    values = tuple(dict.fromkeys(float(value) for value in parameter))
    if not values:
        raise ParameterError("a parameter of a study requires at least one value")
    return values


def _base(
    mu: float, mu_kinetic: float | None, kappa: float | None, slope_deg: float, slope_length: float | None, one_way: bool
) -> SlidingBase | dict[str, Any]:
    """Return a base, or the parameters of an impossible one: too steep, or with more kinetic than static friction."""
    level = sliding_base(mu, kappa=kappa)
    kinetic = level.kinetic if mu_kinetic is None else mu_kinetic
    if kinetic > mu or not holds_at_rest(mu, slope_deg):
        return {"mu": mu, "mu_kinetic": kinetic, "kappa": kinetic / mu, "slope_deg": slope_deg}
    return SlidingBase(mu, kinetic, slope_deg, slope_length if slope_deg else None, one_way)


def _run_all(
    motions: Sequence[Motion],
    rows: Sequence[Sequence[tuple[SlidingBase, float]]],
    gravity: float,
    progress: Progress | None,
    workers: int,
) -> Iterator[SlidePoint]:
    """Yield the points of the rows of each motion, motion by motion, row by row; computed in threads."""
    jobs = []
    for motion, motion_rows in zip(motions, rows, strict=True):
        share = max(1, min(CHUNK_SIZE // motion.samples, math.ceil(len(motion_rows) / workers)))
        jobs += [(motion, motion_rows[first : first + share]) for first in range(0, len(motion_rows), share)]
    total = sum(map(len, rows))
    points: list[SlidePoint] = []
    for batch in map_threads(lambda job: _points(*job, gravity), jobs, workers=workers):
        points += batch
        if progress is not None:
            progress(len(points), total)
    return iter(points)


def _points(motion: Motion, rows: Sequence[tuple[SlidingBase, float]], gravity: float) -> list[SlidePoint]:
    """Return the points of some rows for one motion."""
    p = [parameters(base, gravity) for base, _ in rows]
    gains = [motion_gains(motion, scale) for _, scale in rows]
    runs = integrate_many(SLIDE, motion, p, np.zeros(4), STICK, gains=gains)
    for row in np.flatnonzero(runs.final_mode == UNDEFINED)[:1]:
        raise_lift_off(motion, float(runs.end_time[row]))
    mode_entries = runs.transition_counts.sum(axis=1) - runs.transition_counts[:, FOOT]
    numbers = zip(
        rows,
        p,
        runs.final.tolist(),
        runs.final_mode.tolist(),
        runs.extrema[:, 0].tolist(),
        runs.first_event_time.tolist(),
        mode_entries[:, SLIDING_MODES].sum(axis=1).tolist(),
        (runs.transition_counts[:, :, LEVEL:].sum(axis=(1, 2)) > 0).tolist(),
        (runs.transition_counts[:, :, [FLIGHT, LEVEL + FLIGHT]].sum(axis=(1, 2)) > 0).tolist(),
        strict=True,
    )
    points = []
    for (base, scale), row, final, mode, (highest, highest_time, lowest, lowest_time), first, slips, fell, flew in numbers:
        # extrema of both signs; the larger one is the maximum slip
        slip, peak_time = (highest, highest_time) if highest >= -lowest else (-lowest, lowest_time)
        rest = slip_at_rest(final, mode, row)
        slipped = first == first  # not NaN
        points.append(
            SlidePoint(
                motion.name,
                base.mu,
                float(f"{base.kinetic:.15g}"),
                base.kappa,
                base.slope_deg,
                scale,
                holds_at_rest=True,
                slips=slipped,
                slip_start_s=motion.start_s + first if slipped else None,
                max_slip_m=slip,
                max_slip_time_s=motion.start_s + peak_time,
                residual_slip_m=final[SLIP],
                final_slip_m=rest if math.isfinite(rest) else None,
                slip_count=slips,
                fell_off_slope=fell,
                lifted_off=flew,
                slides_at_end=mode % LEVEL != STICK,
            )
        )
    return points


def _with_beta(point: SlidePoint, horizontal_point: SlidePoint) -> SlidePoint:
    """Return a point with the ratio of its maximum slip to that of the horizontal motion alone."""
    if not horizontal_point.max_slip_m or point.max_slip_m is None:
        return point
    return replace(point, beta=point.max_slip_m / horizontal_point.max_slip_m)
