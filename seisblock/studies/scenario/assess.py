"""Objects of a scenario: probabilities to move and to fall, class and advice, worst first."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.factory import block_for_motion, table_friction
from seisblock.bodies.table import BodySpec, pile_notes, resolve_kinds
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.registry import SolverBody, get_solver
from seisblock.core.typing import IntArray, Progress
from seisblock.records.record import Record
from seisblock.studies.assessment import LIKELY, MAY, MOVES, STAYS, classify
from seisblock.studies.batch.task import RejectedBody, build_solver_bodies
from seisblock.studies.intervals import clopper_pearson, clustered_interval
from seisblock.studies.sampling import MOVED_M, ParameterVariation
from seisblock.studies.scenario.motions import motion_pairs
from seisblock.studies.scenario.runs import VERSIONS, CaseResults, Pairs, draw_cases, run_cases

CLASSES = (LIKELY, MAY, MOVES, STAYS)
"""Classes of an object, worst first."""

MIN_RUNS = 160
"""Smallest number of runs of an object."""

WIDTH, DEPTH, EITHER = "width", "depth", "either"
"""Side along which an object falls; either one where the base is square or its depth is unknown."""

SHIFT_QUANTILE = 0.95
"""Share of the residual displacements of standing objects that :attr:`ObjectRisk.displacement_m` covers."""

UNKNOWN_FRICTION, UNKNOWN_FRICTION_RANGE = 0.4, (0.2, 0.7)
"""Friction of an object for which none is given, and its range: those of the bundled bookcase."""

MAX_GAP_M = 0.3
"""Displacement above which a free gap is no advice."""

MAT_FRICTION = 1.0
"""Friction of a non-slip mat (rubber on concrete, [Urone2022]_ table 5.1): more slender objects rock on it."""


@dataclass(frozen=True, repr=False)
class ObjectRisk(DisplayMixin):
    """Result of one object in a scenario.

    Parameters
    ----------
    body : str
    overturning_probability, moved_probability : float or None, 1
        Shares of the runs in which the object falls under either horizontal, and in which it falls or ends more than 1 cm from its place.
        None without a result.
    interval : (float, float) or None, 1
        95 % interval of the overturning probability over the records: the model error is not included.
    runs : int
        Records times orientations, without those stopped.
    class_name : str or None
        ``likely overturns`` (probability from 0.5), ``may overturn`` (from 0.05), ``moves`` (moved probability from 0.05), ``stays``.
    falls_along : str or None
        Side along which it falls in most cases, ``width`` or ``depth``; ``either`` for a square base or an unknown depth.
    fall_reach_m : float or None
        Distance from its side that it covers when it lies: its height.
    displacement_m : float or None
        95 % quantile of the residual displacement of the runs in which it stands.
    advice : tuple of str
    failure : str or None
        Reason for an object without a result.
    stopped : tuple of str
        One sentence per motion under which runs were stopped without a result: record, component, number, time of the first.
    """

    body: str
    overturning_probability: float | None = None
    moved_probability: float | None = None
    interval: tuple[float, float] | None = None
    runs: int = 0
    class_name: str | None = None
    falls_along: str | None = None
    fall_reach_m: float | None = None
    displacement_m: float | None = None
    advice: tuple[str, ...] = ()
    failure: str | None = None
    stopped: tuple[str, ...] = ()


def scenario_bodies(
    specs: Sequence[BodySpec], options: Mapping[str, Any] | None = None
) -> tuple[tuple[SolverBody | RejectedBody, ...], tuple[Message, ...]]:
    """Return the objects of a table for the solver ``respond``, and notes on what was assumed.

    A bundled name in the column ``kind`` stands for that body; beside sizes it gives the friction of the kind, and an unknown word has no
    effect. Without any friction it is drawn from 0.2 to 0.7, median 0.4. A name that was used before gets a number.
    """
    given_options = {key: value for key, value in (options or {}).items() if value is not None}
    if "mu" in given_options:
        checks.non_negative("the friction coefficient mu", given_options["mu"])
    specs, notes = resolve_kinds(specs)
    specs = _with_distinct_names(specs)
    notes += pile_notes(specs)
    bodies = build_solver_bodies(get_solver("respond"), specs, {"mu": UNKNOWN_FRICTION, **given_options})
    if "mu" in given_options:
        if not any(map(is_friction_unknown, specs)):
            notes.append(lazy_gettext("`mu` has no effect: every object has its own friction coefficient"))
        return bodies, tuple(notes)
    result: list[SolverBody | RejectedBody] = []
    assumed = 0
    for spec, body in zip(specs, bodies, strict=True):
        if isinstance(body, SolverBody) and isinstance(body.body, Block) and is_friction_unknown(spec):
            body = replace(body, body=body.body.with_friction_range(UNKNOWN_FRICTION_RANGE))
            assumed += 1
        result.append(body)
    if not assumed:
        return bodies, tuple(notes)
    low, high = UNKNOWN_FRICTION_RANGE
    note = lazy_gettext(
        "no friction coefficient for {count} of {all} objects: {low:g} to {high:g} assumed, median {middle:g}",
        count=assumed,
        all=len(bodies),
        low=low,
        high=high,
        middle=UNKNOWN_FRICTION,
    )
    return tuple(result), (*notes, note)


def is_friction_unknown(spec: BodySpec) -> bool:
    """Return whether neither the values of a body nor its file give a friction coefficient."""
    if "mu" in spec.parameters or "surface" in spec.parameters:
        return False
    return spec.description is None or table_friction(spec.description, spec.source)[0] is None


def _with_distinct_names(specs: Sequence[BodySpec]) -> list[BodySpec]:
    """Return bodies whose repeated names have a number."""
    names: set[str] = set()
    result = []
    for spec in specs:
        name, number = spec.name, 1
        while name in names:
            number += 1
            name = f"{spec.name} ({number})"
        names.add(name)
        result.append(replace(spec, name=name))
    return result


def assess_scenario(
    bodies: Sequence[SolverBody | RejectedBody],
    records: Sequence[Record],
    *,
    is_scaled: bool = True,
    seed: int = 0,
    progress: Progress | None = None,
) -> list[ObjectRisk]:
    """Return the results of objects under the records of a scenario, worst first.

    Each record shakes each object twice, with its width along one horizontal and along the other; width, height, edges, friction and
    restitution vary from run to run around their values.

    Parameters
    ----------
    bodies : sequence of SolverBody or RejectedBody
        See :func:`scenario_bodies`.
    records : sequence of Record
    is_scaled : bool
        True for records scaled to an intensity; else amplitude and azimuth vary as well, as in ``respond``.
    seed : int
    progress : callable
        Called with the number of finished motions and their total.

    Raises
    ------
    ParameterError
        If there are no records.
    """
    if not records:
        raise ParameterError("a scenario requires at least one record")
    pairs = motion_pairs(records)
    accepted = [body for body in bodies if isinstance(body, SolverBody)]
    draws = draw_cases(len(records), checks.seed(seed), versions=versions_for(len(records)))
    results = run_cases(accepted, pairs, draws, variation=VERSIONS if is_scaled else ParameterVariation(), progress=progress)
    answers = [ObjectRisk(body.name, failure=body.reason) for body in bodies if isinstance(body, RejectedBody)]
    for index, body in enumerate(accepted):
        # a run stands for both horizontals: if one was stopped, whether the object falls is unknown
        complete = ~results.gave_up[index].any(axis=2)
        stopped = _stopped_runs(results, index, pairs)
        counts = (results.fell[index].any(axis=2) & complete).sum(axis=1)
        runs = complete.sum(axis=1)
        if not runs.sum():
            text = lazy_gettext("all runs were stopped: use a smaller `restitution`")
            answers.append(ObjectRisk(body.name, failure=text, stopped=stopped))
            continue
        fell = results.fell[index].any(axis=2)[complete]
        # the larger displacement of the two directions
        shift = results.shift_m[index].max(axis=2)[complete]
        by_side = results.fell[index][complete].sum(axis=0)
        overturning, moved = float(fell.mean()), float((fell | (shift > MOVED_M)).mean())
        block = body.body if isinstance(body.body, Block) else block_for_motion(body.body, pairs[0][0])
        standing = shift[~fell]
        answer = ObjectRisk(
            body.name,
            overturning,
            moved,
            overturning_interval(counts, runs),
            int(runs.sum()),
            classify(overturning, moved),
            _side_of_falls(body.body, by_side) if fell.any() else None,
            block.height if fell.any() else None,
            float(np.quantile(standing, SHIFT_QUANTILE)) if standing.size else None,
            stopped=stopped,
        )
        answers.append(_with_advice(answer, block, body))
    order = {name: rank for rank, name in enumerate(CLASSES)}
    # objects without a result come last
    return sorted(
        answers,
        key=lambda a: (
            a.class_name is None,
            order.get(a.class_name or "", 0),
            -(a.overturning_probability or 0.0),
            -(a.moved_probability or 0.0),
        ),
    )


def _side_of_falls(body: object, falls: IntArray) -> str:
    """Return the side along which an object falls more often."""
    if isinstance(body, Block) and body.depth in (None, body.width):
        return EITHER
    return WIDTH if falls[0] >= falls[1] else DEPTH


def _stopped_runs(results: CaseResults, index: int, pairs: Pairs) -> tuple[str, ...]:
    """Return a sentence for each motion under which runs of an object were stopped without a result."""
    sentences = []
    for row, pair in enumerate(pairs):
        for motion_index, motion in enumerate(pair):
            # in cases with an even number the width lies along the first horizontal, in the others along the second
            case = np.arange(results.gave_up.shape[2])
            side = (case + motion_index) % 2
            stopped = results.gave_up[index, row, case, side]
            if stopped.any():
                text = lazy_gettext(
                    "no result in {count} of {all} runs under {record} {component} (stopped, first at {time:.2f} s)",
                    count=int(stopped.sum()),
                    all=int(stopped.size),
                    record=(motion.record.source if motion.record is not None else "") or lazy_gettext("record"),
                    component=motion.name,
                    time=float(results.end_s[index, row, case, side][stopped].min()),
                )
                sentences.append(text)
    return tuple(sentences)


def versions_for(records: int) -> int:
    """Return the number of versions of an object per record and orientation that give at least :data:`MIN_RUNS` runs, at least two."""
    return max(2, math.ceil(MIN_RUNS / (2 * records)))


def overturning_interval(counts: IntArray, runs: IntArray) -> tuple[float, float]:
    """Return the interval of an overturning probability from the falls and runs of each record.

    A single record is the scenario itself: the interval then covers the sampling of the versions.
    """
    if len(runs) == 1:
        return clopper_pearson(int(counts[0]), int(runs[0]))
    return clustered_interval(counts.tolist(), runs.tolist())


def _with_advice(risk: ObjectRisk, block: Block, body: SolverBody) -> ObjectRisk:
    """Return a result with advice in plain words."""
    advice: list[Message] = []
    slenderness = min(block.arms) / block.centre
    if risk.class_name in (LIKELY, MAY):
        advice.append(lazy_gettext("Fasten it to wall or floor near the top, or widen the base or lower the centre of gravity."))
        advice.append(lazy_gettext("Keep people, exits and fragile objects {distance:.1f} m away until then.", distance=risk.fall_reach_m))
    # friction above the slenderness: the object rocks before it slides
    elif risk.class_name == MOVES and body.options.mu > slenderness:
        advice.append(lazy_gettext("It rocks: check the margin at a stronger scenario, and leave a gap to its neighbours."))
    # stouter than the friction of the mat: it cannot rock even there
    elif risk.class_name == MOVES and slenderness > MAT_FRICTION:
        advice.append(lazy_gettext("It slides: a non-slip mat holds it, on which it cannot rock."))
    elif risk.class_name == MOVES and (risk.displacement_m or 0.0) > MAX_GAP_M:
        advice.append(lazy_gettext("It slides by up to {shift:.1f} m: hold its foot with a stop or a bracket.", shift=risk.displacement_m))
    elif risk.class_name == MOVES:
        advice.append(
            lazy_gettext(
                "It slides: leave {gap:.0f} cm free on every side; no non-slip mat, on which it would rock instead.",
                gap=max(np.ceil(100.0 * (risk.displacement_m or 0.0)), 1.0),
            )
        )
    elif block.stone_count == 1:
        advice.append(lazy_gettext("No measure required in this scenario."))
    if block.stone_count > 1:
        text = N_(
            "The {count} stones were taken as one rigid block: upper ones may fall earlier, seisblock stack computes them one by one."
        )
        advice.append(lazy_gettext(text, count=block.stone_count))
    return replace(risk, advice=tuple(advice))
