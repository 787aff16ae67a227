"""Factors on a candidate record that reproduce an observed displacement.

Displacements are not monotone in amplitude, and those of a jumping block are discontinuous: a scan finds every change of sign,
bisection the factor, and a factor at which the displacement is discontinuous across the observed value is marked. A crossing and
its return between two steps of the scan can be missed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.typing import BoolArray, FloatArray, Progress
from seisblock.dynamics import integrate_many
from seisblock.models.jump.batch import jump_many
from seisblock.models.jump.options import JumpOptions
from seisblock.models.jump.solve import solve_jump
from seisblock.models.slide.model import SLIDE, SLIP, STICK, UNDEFINED, parameters
from seisblock.models.slide.options import SlideOptions
from seisblock.models.slide.solve import raise_lift_off, solve_slide
from seisblock.records import Motion
from seisblock.records._validation import validate_inputs, validate_motion
from seisblock.studies.parallel import map_batches, map_threads

MAX_FACTOR = 3.0
"""Default largest factor."""

STEPS = 300
"""Default number of steps of the scan."""

FACTOR_TOLERANCE = 1e-10
"""Tolerance of a factor."""

DISCONTINUITY_TOLERANCE = 1e-3
"""Relative misfit at the crossing above which the displacement is discontinuous there."""


@dataclass(frozen=True)
class ScaleFactor:
    """A factor that gives the observed displacement.

    Parameters
    ----------
    scale : float
        Factor on the record.
    pga_m_s2 : float
        PGA of the scaled component.
    displacement_m : float
        Absolute displacement at this factor.
    leaps : bool
        True if the displacement is discontinuous across the observed value: no factor gives exactly that.
    """

    scale: float
    pga_m_s2: float
    displacement_m: float
    leaps: bool


@dataclass(frozen=True, repr=False)
class ScaleFactors(DisplayMixin):
    """All factors up to a limit; the fields are the keys of one result in the document of ``infer``.

    Parameters
    ----------
    component : str
    observed_m : float
    pga_m_s2 : float
        PGA of the unscaled component.
    scale_factors : tuple of ScaleFactor
        In rising order; empty if the object never moves so far.
    displacement_at_1_m : float
        Under the unscaled record.
    largest_displacement_m, largest_at_scale : float
        Largest displacement of the scan, and its factor.
    limit : float
        Largest factor of the scan.
    curve : two tuples of float
        Factors of the scan, and the displacement at each, m.
    """

    component: str
    observed_m: float
    pga_m_s2: float
    scale_factors: tuple[ScaleFactor, ...]
    displacement_at_1_m: float
    largest_displacement_m: float
    largest_at_scale: float
    limit: float
    curve: tuple[tuple[float, ...], tuple[float, ...]]


def scale_factors(
    displacement: Callable[[float], float],
    observed: float,
    motion: Motion,
    *,
    limit: float = MAX_FACTOR,
    steps: int = STEPS,
    progress: Progress | None = None,
) -> ScaleFactors:
    """Return every factor on a motion at which an object is displaced by the observed length.

    Parameters
    ----------
    displacement : callable
        From a factor to the absolute displacement, m; zero at factor zero.
    observed : float, m
        Positive.
    motion : Motion
        For its name and its peak.
    limit : float
        Largest factor, positive.
    steps : int
        Steps of the scan, at least 1.
    progress : callable
        Called with the number of finished runs and the total.

    Returns
    -------
    ScaleFactors

    Raises
    ------
    ParameterError
        If the observed displacement or the limit is not positive.

    Examples
    --------
    >>> from seisblock.survey import scale_factors
    >>> motion = Motion.from_arrays([0.0, 2.0, 0.0], 0.1)
    >>> result = scale_factors(lambda s: s * (2.0 - s) if s < 2.0 else 0.0, 0.75, motion)
    >>> [round(f.scale, 6) for f in result.scale_factors]
    [0.5, 1.5]
    """
    checks.function("the displacement", displacement)
    validate_motion(motion)
    checks.positive("the observed displacement", observed, "m")
    checks.positive("the largest factor", limit)
    checks.integer("the number of steps", steps, minimum=1)
    check_limit(N_("factors"), steps, MAX_RUNS)
    grid = [limit * i / steps for i in range(steps + 1)]
    # the scan starts at factor 0 without displacement, so that its first step can bracket a factor too
    values = [0.0, *_evaluate(displacement, grid[1:], progress)]
    peak = float(np.abs(motion.horizontal).max())
    below = np.array(values) < observed
    # a sign change brackets a factor; a step may bracket a discontinuity as well
    brackets = np.flatnonzero(below[:-1] != below[1:])
    crossing_factors = _bisect(displacement, observed, np.array(grid)[brackets], np.array(grid)[brackets + 1], below[brackets + 1])
    factors = [
        ScaleFactor(factor, factor * peak, crossing, abs(crossing - observed) > DISCONTINUITY_TOLERANCE * observed)
        for factor, crossing in zip(crossing_factors, _evaluate(displacement, crossing_factors), strict=True)
    ]
    top = int(np.argmax(values))
    curve = tuple(grid), tuple(values)
    return ScaleFactors(motion.name, observed, peak, tuple(factors), displacement(1.0), values[top], grid[top], limit, curve)


@dataclass(frozen=True)
class DisplacementFunction:
    """Displacement of an object, m, against the factor on a motion, for one factor or a batch.

    Parameters
    ----------
    vectorized : callable
        From factors, (m,), to displacements, (m,), m.
    """

    vectorized: Callable[[FloatArray], FloatArray]

    def __call__(self, factor: float) -> float:
        """Return the displacement at one factor, m."""
        return float(self.vectorized(np.array([factor]))[0])


def _evaluate(displacement: Callable[[float], float], factors: Sequence[float], progress: Progress | None = None) -> list[float]:
    """Return the displacement at each factor, on all cores."""
    if not isinstance(displacement, DisplacementFunction):
        return list(map_threads(displacement, factors, progress=progress))
    rows = np.array(factors)
    parts = map_batches(lambda part: displacement.vectorized(rows[part]), rows.size, progress=progress)
    return [float(value) for part in parts for value in part]


def _bisect(displacement: Callable[[float], float], observed: float, low: FloatArray, high: FloatArray, below: BoolArray) -> list[float]:
    """Return the factor in each bracket at which the displacement crosses the observed one; `below`: smaller at the upper end."""
    while (is_open := high - low > FACTOR_TOLERANCE * np.maximum(high, 1.0)).any():
        middle = 0.5 * (low + high)[is_open]
        to_high = (np.array(_evaluate(displacement, middle.tolist())) < observed) == below[is_open]
        rows = np.flatnonzero(is_open)
        high[rows[to_high]], low[rows[~to_high]] = middle[to_high], middle[~to_high]
    # the end on the side of the larger displacement, so that the observed one is reached
    return np.where(below, low, high).tolist()


def scale_motion(motion: Motion, factor: float) -> Motion:
    """Return a motion multiplied by a factor, without its record."""
    return Motion(motion.acceleration * factor, motion.dt, motion.name, motion.start_s)


def jump_displacement(block: TwoLayerBlock, motion: Motion, options: JumpOptions, *, flight_only: bool = False) -> Callable[[float], float]:
    """Return the displacement of a two-layer block, m, against the factor on a motion ([Sugimoto2017]_ table 1).

    The sum of all chains, or the first one with the option `first`; a chain in which the block overturns counts as none.

    Parameters
    ----------
    block, motion, options
        As in :func:`seisblock.models.jump.solve.solve_jump`.
    flight_only : bool
        Count the jump alone, not the rocking-sliding after it.

    Returns
    -------
    function of float
        From the factor to the displacement, m.

    Examples
    --------
    >>> from seisblock.survey import jump_displacement
    >>> import numpy as np
    >>> from seisblock.bodies.two_layer import load_contact, load_two_layer
    >>> pulse = Motion.from_arrays(np.concatenate([6.0 * np.sin(np.linspace(0.0, np.pi, 101)), np.zeros(200)]), 0.01)
    >>> displacement = jump_displacement(load_two_layer("chozusha"), pulse, JumpOptions(contact=load_contact("chozusha")))
    >>> displacement(0.1), displacement(1.0) > 0.01
    (0.0, True)
    """
    validate_inputs(block, TwoLayerBlock, motion)

    def single(factor: float, key: str = "total_displacement_m") -> float:
        response = solve_jump(block, scale_motion(motion, factor), **options.keywords())
        return abs(sum((getattr(chain, key) or 0.0 for chain in response.outcome.chains), 0.0))

    if flight_only:
        return partial(single, key="jump_displacement_m")
    # Windows and tenons have no vectorized solver
    if options.windows or options.tenon:
        return single
    rows = {key: value for key, value in options.keywords().items() if key not in ("windows", "contact", "tenon")}

    def vectorized(factors: FloatArray) -> FloatArray:
        result = jump_many([block], motion, contacts=[options.contact], factors=factors, **rows)
        for factor in factors[result.jammed][:1]:
            single(factor)  # raises the error of the single run, with time and cause
        return np.abs(result.total_displacement_m)

    return DisplacementFunction(vectorized)


def slide_displacement(
    base: SlidingBase | float, motion: Motion, options: SlideOptions = SlideOptions(), *, largest: bool = False
) -> Callable[[float], float]:
    """Return the displacement of an object on a level base, m, against the factor on a motion ([Fujino1978]_).

    Parameters
    ----------
    base, motion, options
        As in :func:`seisblock.models.slide.solve.solve_slide`.
    largest : bool
        True for the maximum slip, not the residual one.

    Returns
    -------
    function of float
        From the factor to the displacement, m.

    Raises
    ------
    ParameterError
        If a coefficient lies outside its range.
    ComponentError
        If the vertical motion is required and the record has none.

    Examples
    --------
    >>> from seisblock.survey import slide_displacement
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> displacement = slide_displacement(0.2, pulse)
    >>> round(displacement(1.0), 2), displacement(0.1)
    (0.44, 0.0)
    """
    start = solve_slide(base, motion, **options.keywords())  # validates base, motion and options
    p, up = parameters(start.body, start.options.gravity), start.options.vertical

    def vectorized(factors: FloatArray) -> FloatArray:
        rows = np.tile(np.asarray(p, dtype=np.float64), (factors.size, 1))
        # the factor scales the vertical component as well
        result = integrate_many(SLIDE, motion, rows, np.zeros(4), STICK, gains=factors[:, None] * [1.0, 0.0, up])
        # lift-off leaves a run without a result: refused as in a single run
        for row in np.flatnonzero(result.final_mode == UNDEFINED)[:1]:
            raise_lift_off(motion, float(result.end_time[row]))
        highest, _, lowest, _ = result.extrema[:, SLIP].T
        return np.maximum(highest, -lowest) if largest else np.abs(result.final[:, SLIP])

    return DisplacementFunction(vectorized)
