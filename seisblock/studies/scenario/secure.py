"""Measures that make an object safe: least width, largest height, ballast, friction, inset of feet, and restraint."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.friction import SURFACES
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.registry import SolverBody
from seisblock.core.typing import BoolArray, FloatArray, Progress
from seisblock.records._validation import Gain, vertical_gain
from seisblock.records.motion import Motion
from seisblock.records.record import Record
from seisblock.studies.intervals import clopper_pearson
from seisblock.studies.sampling import ParameterVariation, sample_gains
from seisblock.studies.scenario.assess import versions_for
from seisblock.studies.scenario.hazard import RecordFrequencies
from seisblock.studies.scenario.motions import motion_pairs
from seisblock.studies.scenario.runs import VERSIONS, Pairs, case_params, draw_cases, other_side, run_cases


@dataclass(frozen=True)
class RestraintDemand:
    """Largest actions on a horizontal restraint during a motion, per mass of the object.

    Parameters
    ----------
    moment : float, m^2/s^2
        Moment about the edge of the base that prevents uplift, over the mass.
    force : float, m/s^2
        Horizontal force that prevents uplift and sliding, over the mass.
    foot_slides : bool
        Whether no force at this height alone holds the object at some instant: its foot slides away and requires a stop of its own.
    foot_force : float, m/s^2
        Horizontal force on such a stop, over the mass; the restraint then prevents uplift alone.
    """

    moment: float
    force: float
    foot_slides: bool
    foot_force: float


@dataclass(frozen=True, eq=False)
class CaseDemands:
    """Actions on a restraint in many runs, the larger ones of both horizontals; arrays (records, cases), see :class:`RestraintDemand`.

    Parameters
    ----------
    moment : m^2/s^2
    force, foot_force : m/s^2
    foot_slides : bool
    """

    moment: FloatArray
    force: FloatArray
    foot_slides: BoolArray
    foot_force: FloatArray


def restraint_demand(
    block: Block, motion: Motion, *, height_m: float, mu: float, gravity: float, vertical: Gain | None = None
) -> RestraintDemand:
    """Return the largest actions on the restraint of a rigid object that stays in place.

    While the object moves with the floor its inertia force m a acts at the centre of gravity. Moments about the edge of its base
    give F z = m (abs(a) h - (g + a_v) b), horizontal forces F >= m (abs(a) - mu (g + a_v)); both are taken at each sample, between which
    the motion is linear, and not below 0. Friction at the base takes the rest, m (abs(a) - F), as long as it can, and the reaction of the
    floor lies within the base as long as F z <= m (abs(a) h + (g + a_v) b). Beside a stop at the foot the restraint bears the first of both
    forces alone, and the stop abs(m abs(a) - F) - m mu (g + a_v). Derived here; quasi-static: the restraint is stiff and has no slack.

    Parameters
    ----------
    block : Block
    motion : Motion
    height_m : float, m
        Height of the restraint above the floor.
    mu : float
        Static friction.
    gravity : float, m/s^2
    vertical : bool, float or None
        As in ``respond``.

    Examples
    --------
    >>> motion = Motion.from_arrays([0.0, 5.0, 0.0], 0.01)
    >>> demand = restraint_demand(Block(0.4, 1.2), motion, height_m=1.2, mu=0.3, gravity=10.0)
    >>> round(demand.moment, 12), demand.force, demand.foot_slides, round(demand.foot_force, 12)
    (1.0, 2.0, False, 1.166666666667)
    >>> restraint_demand(Block(0.4, 1.2), motion, height_m=0.1, mu=0.3, gravity=10.0).foot_slides
    True
    """
    weight = gravity + vertical_gain(motion, vertical) * motion.vertical
    return _demand(block.arms, block.centre, mu, motion.horizontal, weight, height_m)


def case_demands(body: SolverBody, pairs: Pairs, draws: FloatArray, *, height_m: float, variation: ParameterVariation) -> CaseDemands:
    """Return the actions on the restraint in all runs, per mass of the object.

    Parameters
    ----------
    body : SolverBody
        With a block.
    pairs, draws, variation
        As in :func:`~seisblock.studies.scenario.runs.run_cases`.
    height_m : float, m
    """
    options = body.options
    _, rows = case_params(body, pairs, draws, variation)
    shape = draws.shape[:2]
    result = CaseDemands(np.zeros(shape), np.zeros(shape), np.zeros(shape, bool), np.zeros(shape))
    for r, motions in enumerate(pairs):
        for c, motion in enumerate(motions):
            gains = sample_gains(motion, variation, draws[r], options.vertical)
            for k, (gain, column) in enumerate(zip(gains, rows[:, r, :, c].T.tolist(), strict=True)):
                right, left, centre, _, mu, *_ = column
                along = gain[0] * motion.horizontal + gain[1] * motion.transverse
                demand = _demand((right, left), centre, mu, along, options.gravity + gain[2] * motion.vertical, height_m)
                for field in fields(CaseDemands):
                    values = getattr(result, field.name)
                    values[r, k] = max(values[r, k], getattr(demand, field.name))
    return result


def _demand(arms: Sequence[float], centre: float, mu: float, a: FloatArray, weight: FloatArray, height_m: float) -> RestraintDemand:
    right, left = arms
    size = np.abs(a)
    # a ground that accelerates to +x pushes the object to -x, about its left edge
    near_arm, far_arm = np.where(a > 0.0, left, right), np.where(a > 0.0, right, left)
    moment = np.maximum(size * centre - weight * near_arm, 0.0)
    force = np.maximum(np.maximum(moment / height_m, size - mu * weight), 0.0)
    largest = np.minimum(size + mu * weight, (size * centre + weight * far_arm) / height_m)
    # below the centre of gravity the restraint may take more than the inertia force: the foot then slides to the other side
    foot_force = np.maximum(np.abs(size - moment / height_m) - mu * weight, 0.0)
    return RestraintDemand(float(moment.max()), float(force.max()), bool((force > largest).any()), float(foot_force.max()))


WIDTH, HEIGHT, BASE_MASS, FRICTION, INSET, RESTRAINT = "width", "height", "base_mass", "friction", "inset", "restraint"
MEASURES = (WIDTH, HEIGHT, BASE_MASS, FRICTION, INSET, RESTRAINT)

COARSE = 16
"""Values of the first search."""

QUICK_RUNS, FULL_RUNS = 40, 320
"""Smallest number of runs of a value in the first search, and near the target."""

RESOLUTION = 0.015
"""Relative width of the interval at which the bisection of a measure ends."""

INSET_RESOLUTION = 0.002
"""The same of the inset, a share of the width."""

RANGES = {WIDTH: (0.4, 4.0), HEIGHT: (2.0, 0.1), BASE_MASS: (0.0, 20.0), FRICTION: (1.0, 0.02), INSET: (0.45, 0.0)}
"""First and last value of each search, towards the safe side: factors on width and height, added over own mass, friction, share of the
width."""


@dataclass(frozen=True, repr=False)
class Measure(DisplayMixin):
    """One measure that makes an object safe.

    Parameters
    ----------
    measure : str
        ``width``: least width of the base; ``height``: largest height; ``base_mass``: mass added at floor level; ``friction``: largest
        friction, at which the object slides instead of rocking; ``inset``: largest distance of its feet from each side;
        ``restraint``: horizontal force at ``height_m``.
    value : float or None
        None where the measure does not reach the target.
    unit : str
        ``m``, ``kg``, ``1`` or ``N``; a mass or a force of an object of unknown mass is a multiple of its mass or weight, ``1``.
    overturning_probability : float or None, 1
        With this value; of a restraint the share of the runs in which the force is exceeded.
    displacement_m : float or None
        95 % quantile of the residual displacement with this value.
    moment : float or None
        Of a restraint: moment about the edge of the base, N m, or over the weight, m.
    height_m : float or None
        Of a restraint: height of its force.
    foot_slip_probability : float or None, 1
        Of a restraint: share of the runs in which no force at this height alone holds the object, since its foot slides away.
    foot_force : float or None
        Of a restraint: force on a stop at the foot, in the unit of the value, where the foot may slide.
    materials : tuple of str
        Pairs of surfaces with a friction up to the value.
    curve : tuple of (float, float)
        Values and probabilities of the search.
    reason : str or None
        Reason why a measure does not reach the target.
    """

    measure: str
    value: float | None
    unit: str
    overturning_probability: float | None
    displacement_m: float | None = None
    moment: float | None = None
    height_m: float | None = None
    foot_slip_probability: float | None = None
    foot_force: float | None = None
    materials: tuple[str, ...] = ()
    curve: tuple[tuple[float, float], ...] = ()
    reason: str | None = None


@dataclass(frozen=True, repr=False)
class Security(DisplayMixin):
    """Measures that make an object safe in a scenario.

    Parameters
    ----------
    body : str
    target_probability : float, 1
    overturning_probability : float, 1
        Without a measure.
    runs : int
        Of each value near the target.
    measures : tuple of Measure
    years : float or None
        Period of the probabilities under a hazard; None in a scenario.
    stone_count : int
        Stones of a pile, taken as one rigid block; 1 for a single body.
    """

    body: str
    target_probability: float
    overturning_probability: float
    runs: int
    measures: tuple[Measure, ...]
    years: float | None = None
    stone_count: int = 1


def unresolved_target(result: Security) -> float | None:
    """Return the probability that runs without an overturning leave possible (95 %), if the target of a scenario lies below it.

    Parameters
    ----------
    result : Security
    """
    limit = clopper_pearson(0, result.runs, confidence=0.90)[1]
    return limit if result.years is None and result.target_probability < limit else None


def with_base_mass(block: Block, ratio: float) -> Block:
    """Return a block with a plate as wide as its base and without height at floor level, of `ratio` times its mass.

    Examples
    --------
    >>> heavy = with_base_mass(Block(0.4, 1.2, mass=50.0), 1.0)
    >>> heavy.total_mass, heavy.centre
    (100.0, 0.3)
    """
    mass, centre = block.total_mass, block.centre
    new_centre = centre / (1.0 + ratio)
    # parallel axes of the block and of the plate, both about the common centre of gravity
    block_inertia = mass * (block.gyration_squared + (centre - new_centre) ** 2)
    plate = ratio * mass * (block.width**2 / 12.0 + new_centre**2)
    offset = block.centroid_offset / (1.0 + ratio)
    along = mass * (block.centroid_offset - offset) ** 2 + ratio * mass * offset**2
    return replace(
        block, mass=mass * (1.0 + ratio), centroid_height=new_centre, centroid_offset=offset, centroid_inertia=block_inertia + plate + along
    )


def changed_body(body: SolverBody, measure: str, value: float) -> SolverBody:
    """Return an object with a measure.

    Parameters
    ----------
    body : SolverBody
        With a block.
    measure : str
        ``width`` (factor), ``height`` (factor), ``base_mass`` (ratio), ``friction`` or ``inset`` (share of the width).
    value : float
    """
    block: Block = body.body
    if measure == FRICTION:
        kinetic = body.options.mu_kinetic
        scaled = None if kinetic is None or body.options.mu == 0.0 else kinetic * value / body.options.mu
        options = replace(body.options, mu=value, mu_kinetic=scaled)
        return replace(body, body=block.without_ranges("mu"), options=options)
    if measure == WIDTH:
        ranges = block.ranges
        if ranges is not None and ranges.inset_m is not None:
            low, high = ranges.inset_m
            ranges = replace(ranges, inset_m=(low * value, high * value))
        width = block.width * value
        depth = None if block.depth is None else max(block.depth, width)
        changed = replace(
            block, width=width, depth=depth, inset=block.inset * value, centroid_offset=block.centroid_offset * value, ranges=ranges
        )
    elif measure == HEIGHT:
        centre = None if block.centroid_height is None else block.centroid_height * value
        inertia = block.centroid_inertia
        if inertia is not None:
            inertia *= (block.width**2 + (value * block.height) ** 2) / (block.width**2 + block.height**2)
        changed = replace(block, height=block.height * value, centroid_height=centre, centroid_inertia=inertia)
    elif measure == BASE_MASS:
        changed = with_base_mass(block, value)
    else:
        changed = replace(block.without_ranges("inset_m"), inset=value * block.width)
    return replace(body, body=changed)


def find_measures(
    body: SolverBody,
    records: Sequence[Record],
    target: float,
    *,
    frequencies: RecordFrequencies | None = None,
    restraint_height_m: float | None = None,
    is_scaled: bool = True,
    has_mass: bool = False,
    seed: int = 0,
    progress: Progress | None = None,
) -> Security:
    """Return the measures that reduce the overturning probability of an object to a target.

    The first value of a coarse search from which on all values are safe is refined by bisection to 1.5 %, each value with runs of its own
    under the same versions.

    Parameters
    ----------
    body : SolverBody
        Of the solver ``respond``, see :func:`~seisblock.studies.scenario.assess.scenario_bodies`.
    records : sequence of Record
    target : float, 1
        Largest overturning probability.
    frequencies : RecordFrequencies or None
        Annual frequency of each record, see :func:`~seisblock.studies.scenario.hazard.hazard_suite`; None: all have the same share.
    restraint_height_m : float or None, m
        Height of the restraint; default: the height of the object.
    is_scaled, seed, progress
        As in :func:`~seisblock.studies.scenario.assess.assess_scenario`.
    has_mass : bool
        Whether the mass of the block is known; else masses and forces are multiples.

    Raises
    ------
    BodyError
        If the object is not a block.
    ParameterError
        If a number is out of range.
    """
    checks.in_interval("the target probability", target, "(0, 1)")
    height = None if restraint_height_m is None else checks.positive("the height of the restraint", restraint_height_m, "m")
    if not isinstance(body.body, Block):
        raise BodyError("{name}: measures require a block with a width and a height; give the sizes of the object", name=body.name)
    if body.body.depth is not None and body.body.depth < body.body.width:
        # the width is the side that is changed: the shorter one
        body = replace(body, body=other_side(body.body))
    pairs = motion_pairs(records)
    search = _Search(body, pairs, VERSIONS if is_scaled else ParameterVariation(), seed, frequencies)
    names = MEASURES[:-1]
    coarse = {name: (np.linspace(*RANGES[name], COARSE) if name == INSET else _spaced(*RANGES[name])).tolist() for name in names}
    # few runs of all values find the transition, all runs of the values around it decide
    answers = search.evaluate([(name, value) for name in names for value in coarse[name]], quick=True, progress=progress)
    first_safe = {name: _first_safe([answers[name, value][0] for value in coarse[name]], target) for name in names}
    full = _refine(search, coarse, first_safe, target, progress)
    measures = []
    for name in names:
        rows = sorted(
            ((value, *answer) for (key, value), answer in (answers | full).items() if key == name),
            reverse=RANGES[name][0] > RANGES[name][1],
        )
        decided = {value for key, value in full if key == name}
        measures.append(_measure(body, name, rows, decided, target, has_mass=has_mass))
    own_probability, height = search.own_probability(), body.body.height if height is None else height
    if own_probability <= target:
        # the object itself meets the target, although other and more runs may require a little more
        own = {WIDTH: (min, body.body.width), HEIGHT: (max, body.body.height), BASE_MASS: (min, 0.0)}
        for index, measure in enumerate(measures):
            nearer, value = own.get(measure.measure, (max, measure.value))
            if measure.value not in (None, value) and nearer(measure.value, value) == value:
                measures[index] = replace(measure, value=value, overturning_probability=own_probability)
        unit, curve = "N" if has_mass else "1", ((0.0, own_probability),)
        restraint = Measure(RESTRAINT, 0.0, unit, own_probability, 0.0, moment=0.0, height_m=height, curve=curve)
    else:
        restraint = _restraint(search, target, height, has_mass=has_mass)
    years = None if frequencies is None else frequencies.years
    return Security(body.name, target, own_probability, search.runs, (*measures, restraint), years, body.body.stone_count)


def _refine(
    search: _Search, coarse: dict[str, list[float]], first_safe: dict[str, int | None], target: float, progress: Progress | None
) -> dict[tuple[str, float], tuple[float, float]]:
    """Return the results with all runs of the values that bracket the target, bisected until each bracket is narrow."""
    full: dict[tuple[str, float], tuple[float, float]] = {}
    # index of the last value that is not safe: -1 if the search begins safe, one below the last if it ends unsafe
    last_unsafe = {name: len(values) - 2 if (first := first_safe[name]) is None else first - 1 for name, values in coarse.items()}
    pending: list[tuple[str, float]] = []
    while True:
        for name, values in coarse.items():
            index = last_unsafe[name]
            pending += [(name, values[i]) for i in (index, index + 1) if i >= 0]
        pending = [item for item in dict.fromkeys(pending) if item not in full]
        if not pending:
            break
        full |= search.evaluate(pending, progress=progress)
        for name, values in coarse.items():
            index = last_unsafe[name]
            # all runs may disagree with the few of the first search: the bracket moves by one value
            if index + 1 < len(values) - 1 and full[name, values[index + 1]][0] > target:
                last_unsafe[name] = index + 1
            elif index >= 0 and full[name, values[index]][0] <= target:
                last_unsafe[name] = index - 1
        pending = []
    brackets = {
        name: (values[index], values[index + 1])
        for name, values in coarse.items()
        if (index := last_unsafe[name]) >= 0 and full[name, values[index + 1]][0] <= target
    }
    while brackets:
        middles = {name: _middle(name, *bracket) for name, bracket in brackets.items()}
        full |= search.evaluate(list(middles.items()), progress=progress)
        for name, middle in middles.items():
            unsafe, safe = brackets[name]
            unsafe, safe = (unsafe, middle) if full[name, middle][0] <= target else (middle, safe)
            brackets[name] = unsafe, safe
        brackets = {name: bracket for name, bracket in brackets.items() if not _is_narrow(name, *bracket)}
    return full


def _middle(name: str, unsafe: float, safe: float) -> float:
    """Return the middle of a bracket: of the logarithms where both ends are positive."""
    return 0.5 * (unsafe + safe) if name == INSET or min(unsafe, safe) <= 0.0 else math.sqrt(unsafe * safe)


def _is_narrow(name: str, unsafe: float, safe: float) -> bool:
    if name == INSET:
        return abs(unsafe - safe) <= INSET_RESOLUTION
    return abs(unsafe - safe) <= RESOLUTION * max(unsafe, safe)


class _Search:
    """Probabilities of an object with measures, under the same versions for all measures."""

    def __init__(
        self, body: SolverBody, pairs: Pairs, variation: ParameterVariation, seed: int, frequencies: RecordFrequencies | None
    ) -> None:
        self.body, self.pairs, self.variation = body, pairs, variation
        self.weights = frequencies or RecordFrequencies(np.full(len(pairs), 1.0 / len(pairs)), None)
        versions = max(versions_for(len(pairs)), math.ceil(FULL_RUNS / (2 * len(pairs))))
        self.draws = draw_cases(len(pairs), checks.seed(seed), versions=versions)
        self.runs = 2 * versions * len(pairs)

    def evaluate(
        self, items: Sequence[tuple[str, float]], *, quick: bool = False, progress: Progress | None = None
    ) -> dict[tuple[str, float], tuple[float, float]]:
        """Return for each measure and value the overturning probability and the 95 % displacement, m."""
        bodies = [replace(changed_body(self.body, name, value), name=str(i)) for i, (name, value) in enumerate(items)]
        cases = max(2, 2 * (QUICK_RUNS // (2 * len(self.pairs)))) if quick else self.draws.shape[1]
        return self._evaluate(items, bodies, self.draws[:, :cases], progress)

    def own_probability(self) -> float:
        """Return the overturning probability without a measure, of the samples of ``assess_scenario``."""
        draws = self.draws[:, : 2 * versions_for(len(self.pairs))]
        return self._evaluate([("", 0.0)], [self.body], draws, None)["", 0.0][0]

    def _evaluate(
        self, items: Sequence[tuple[str, float]], bodies: Sequence[SolverBody], draws: FloatArray, progress: Progress | None
    ) -> dict[tuple[str, float], tuple[float, float]]:
        results = run_cases(bodies, self.pairs, draws, variation=self.variation, progress=progress)
        answer = {}
        for index, item in enumerate(items):
            # a run that was stopped counts as a fall, on the safe side
            fell = (results.fell[index] | results.gave_up[index]).any(axis=2)
            shift = results.shift_m[index].max(axis=2)[~fell]
            answer[item] = self.weights.probability(fell.mean(axis=1)), float(np.quantile(shift, 0.95)) if shift.size else math.nan
        return answer


def _spaced(first: float, last: float) -> FloatArray:
    """Return the values of a search: even in the logarithm, or in that of 1 + value from 0."""
    if first == 0.0:
        return np.concatenate([[0.0], np.geomspace(0.05, last, COARSE - 1)])
    return np.geomspace(first, last, COARSE)


def _first_safe(shares: Sequence[float], target: float) -> int | None:
    """Return the index from which on all values are safe; None if the last one is not."""
    first = None
    for index in reversed(range(len(shares))):
        if shares[index] > target:
            break
        first = index
    return first


def _measure(
    body: SolverBody, name: str, rows: Sequence[tuple[float, float, float]], decided: set[float], target: float, *, has_mass: bool
) -> Measure:
    """Return a measure from the values of its search, towards the safe side; those with all runs decide."""
    block: Block = body.body
    size, unit = {
        WIDTH: (block.width, "m"),
        HEIGHT: (block.height, "m"),
        BASE_MASS: (block.total_mass, "kg") if has_mass else (1.0, "1"),
        FRICTION: (1.0, "1"),
        INSET: (block.width, "m"),
    }[name]
    curve = tuple((value * size, share) for value, share, _ in rows)
    rows = [row for row in rows if row[0] in decided]
    first = _first_safe([share for _, share, _ in rows], target)
    if first is None:
        return with_reason(Measure(name, None, unit, None, curve=curve))
    value, share, shift = rows[first]
    materials = tuple(pair for pair, item in SURFACES.items() if item.mu <= value) if name == FRICTION else ()
    return Measure(name, value * size, unit, share, None if math.isnan(shift) else shift, materials=materials, curve=curve)


def _restraint(search: _Search, target: float, height_m: float, *, has_mass: bool) -> Measure:
    """Return the force of a restraint that is exceeded with the target probability over the runs."""
    body, weights = search.body, search.weights
    demands = case_demands(body, search.pairs, search.draws, height_m=height_m, variation=search.variation)
    block: Block = body.body
    factor, unit = (block.total_mass, "N") if has_mass else (1.0 / body.options.gravity, "1")

    def exceedance(values: FloatArray) -> list[tuple[float, float]]:
        return [(level, weights.probability((values > level).mean(axis=1))) for level in np.unique(values).tolist()]

    def smallest(curve: Sequence[tuple[float, float]]) -> tuple[float, float]:
        """Return the smallest of the computed demands that is exceeded with at most the target probability."""
        return next(item for item in curve if item[1] <= target)

    forces = exceedance(demands.force)
    force, share = smallest(forces)
    slips = weights.probability(demands.foot_slides.mean(axis=1))
    return Measure(
        RESTRAINT,
        force * factor,
        unit,
        share,
        0.0,
        moment=smallest(exceedance(demands.moment))[0] * factor,
        height_m=height_m,
        foot_slip_probability=slips,
        foot_force=smallest(exceedance(demands.foot_force))[0] * factor if slips > 0.0 else None,
        curve=tuple((level * factor, exceeded) for level, exceeded in forces),
    )


def with_reason(measure: Measure) -> Measure:
    """Return a measure that does not reach the target, with the reason: its probability at the end of the search."""
    (value, share), name = measure.curve[-1], measure.measure
    if name == BASE_MASS:
        reason = lazy_gettext("target not reached: still {share:.0f} % with the greatest ballast searched", share=100.0 * share)
    elif name == INSET:
        reason = lazy_gettext("target not reached: still {share:.0f} % with feet at the very edge", share=100.0 * share)
    elif name == FRICTION:
        reason = lazy_gettext("target not reached: still {share:.0f} % at {value:.2g}", share=100.0 * share, value=value)
    else:
        reason = lazy_gettext("target not reached: still {share:.0f} % at {value:.0f} cm", share=100.0 * share, value=100.0 * value)
    return replace(measure, reason=reason)
