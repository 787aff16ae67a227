"""Runs of many objects under the records of a scenario, both horizontals and both orientations of each object."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import BlockArray
from seisblock.bodies.factory import block_for_motion
from seisblock.core.registry import SolverBody
from seisblock.core.typing import BoolArray, FloatArray, Progress
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.params import RespondBatchParams
from seisblock.records.motion import Motion
from seisblock.studies.sampling import STONES, ParameterVariation, sample_gains, sample_respond_params

VERSIONS = ParameterVariation(amplitude=0.0, azimuth_deg=0.0)
"""Variation of the objects alone: the shaking has the intensity of the scenario and varies from record to record."""

Pairs = Sequence[tuple[Motion, Motion]]
"""The two horizontal motions of each record."""


@dataclass(frozen=True, eq=False)
class CaseResults:
    """End states of objects; arrays (objects, records, cases, sides): sides are the width and the depth.

    In cases with an even number the width lies along the first horizontal, in the others along the second.

    Parameters
    ----------
    fell, gave_up : bool
    shift_m : m
        Residual displacement, absolute.
    end_s : s
        Time of rest, of overturning, or at which a run was stopped, from the first sample of the record.
    """

    fell: BoolArray
    gave_up: BoolArray
    shift_m: FloatArray
    end_s: FloatArray


def draw_cases(records: int, seed: int, *, versions: int = 1) -> FloatArray:
    """Return the draws of the objects, (records, 2 versions, 8) in [-1, 1]; the same for all objects.

    Cases with an even number are in the first orientation, the others in the second.
    """
    # Latin hypercube in each version: every parameter is spread evenly over the records, so that fewer runs suffice
    count, parts = 2 * records, []
    for rng in np.random.default_rng(seed).spawn(versions):
        order = np.array([rng.permutation(count) for _ in range(STONES)]).T
        parts.append((-1.0 + 2.0 * (order + rng.uniform(size=(count, STONES))) / count).reshape(records, 2, STONES))
    return np.concatenate(parts, axis=1)


def other_side(block: Block) -> Block:
    """Return a block seen along its depth: width and depth exchanged, homogeneous and centred in that direction."""
    if block.depth is None or block.depth == block.width:
        return block
    inset = min(block.inset, 0.45 * block.depth)
    return replace(
        block,
        width=block.depth,
        depth=block.width,
        mass=block.total_mass,
        centroid_offset=0.0,
        centroid_inertia=None,
        inset=inset,
    )


def run_cases(
    bodies: Sequence[SolverBody],
    pairs: Pairs,
    draws: FloatArray,
    *,
    variation: ParameterVariation = VERSIONS,
    progress: Progress | None = None,
) -> CaseResults:
    """Return the end states of objects under all records.

    Parameters
    ----------
    bodies : sequence of SolverBody
        Of the solver ``respond``: a block, or a scan, whose sides follow from its azimuth.
    pairs : sequence of (Motion, Motion)
    draws : (records, cases, 8) array
        See :func:`draw_cases`.
    variation : ParameterVariation
        Of objects and shaking.
    progress : callable
        Called with the number of finished motions and their total.
    """
    cases = draws.shape[1]
    shape = (len(bodies), len(pairs), cases, 2)
    fell, gave_up, shift, end = np.zeros(shape, bool), np.zeros(shape, bool), np.zeros(shape), np.zeros(shape)
    groups: dict[tuple[object, ...], list[int]] = {}
    for index, body in enumerate(bodies):
        options: RespondOptions = body.options
        common = (options.rocking_restitution is not None, options.gravity, options.tenon, options.settle_s, options.vertical)
        groups.setdefault(common, []).append(index)
    rows = [case_params(body, pairs, draws, variation) for body in bodies]
    total = 2 * len(pairs) * len(groups)
    for count, (members, (r, c)) in enumerate(itertools.product(groups.values(), itertools.product(range(len(pairs)), range(2))), start=1):
        first: RespondOptions = bodies[members[0]].options
        motion = pairs[r][c]
        stacked = np.stack([rows[m][1][:, r, :, c] for m in members], axis=1).reshape(8, -1)
        params = replace(
            rows[members[0]][0],
            blocks=BlockArray(*stacked[:4]),
            mu=stacked[4],
            mu_kinetic=stacked[5],
            restitution=stacked[6],
            rocking=stacked[7],
        )
        gains = np.tile(sample_gains(motion, variation, draws[r], first.vertical), (len(members), 1))
        results = respond_many(params, motion, gains=gains, settle_s=first.settle_s)
        for values, target in (
            (results.overturned, fell),
            (results.gave_up, gave_up),
            (np.abs(results.final_displacement_m), shift),
            (motion.start_s + results.end_s, end),
        ):
            by_case = values.reshape(len(members), cases)
            for k in range(2):
                # the width lies along motion c in the cases of orientation c, the depth in the others
                target[members, r, k::2, 0 if k == c else 1] = by_case[:, k::2]
        if progress is not None:
            progress(count, total)
    return CaseResults(fell, gave_up, shift, end)


def case_params(body: SolverBody, pairs: Pairs, draws: FloatArray, variation: ParameterVariation) -> tuple[RespondBatchParams, FloatArray]:
    """Return a template and the parameter rows of a body, (8, records, cases, motions)."""
    count, cases = draws.shape[:2]
    result = np.empty((8, count, cases, 2))
    if isinstance(body.body, Block):
        flat = draws.reshape(-1, draws.shape[-1])
        sides = [sample_respond_params(block, variation, flat, body.options) for block in (body.body, other_side(body.body))]
        width, depth = (_columns(side).reshape(8, count, cases) for side in sides)
        for k, c in itertools.product(range(2), range(2)):
            result[:, :, k::2, c] = (width if k == c else depth)[:, :, k::2]
        return sides[0], result
    template = None
    for r, c in itertools.product(range(count), range(2)):
        template = sample_respond_params(block_for_motion(body.body, pairs[r][c]), variation, draws[r], body.options)
        result[:, r, :, c] = _columns(template)
    assert template is not None
    return template, result


def _columns(params: RespondBatchParams) -> FloatArray:
    return np.array([*params.blocks.columns, params.mu, params.mu_kinetic, params.restitution, params.rocking])
