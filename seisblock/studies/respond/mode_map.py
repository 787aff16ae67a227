"""Maps of what happens: one record, and rectangular blocks of all frictions and all slendernesses, or all sizes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import to_block_array
from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.limits import check_limit
from seisblock.core.typing import ArrayLike, FloatArray, IntArray, Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.criteria.initiation import friction_to_rock, peak_loading_ratio
from seisblock.models.respond.batch import MODE_COLUMNS, RespondBatchResult, no_answer, respond_many
from seisblock.models.respond.describe import FLIGHT, OVERTURNED, REST, ROCK, SLIDE, SLIDE_ROCK
from seisblock.models.respond.params import RespondBatchParams
from seisblock.records import Motion
from seisblock.records._validation import Gain, validate_motion, vertical_gain

NO_ANSWER = N_("no answer")
"""Body whose run was given up."""

MODES_BY_SEVERITY = (REST, SLIDE, ROCK, SLIDE_ROCK, FLIGHT, OVERTURNED, NO_ANSWER)
"""Modes from the mildest to the worst, of which the worst visible one stands for a body; at the end, bodies without an answer."""

VISIBLE_SLIP_M = 5e-4
"""Slip of a rocking body, or rise of one that flies, that one could see, m."""

CHUNK_SIZE = 200
"""Cells between two reports of progress."""


@dataclass(frozen=True, eq=False)
class ModeMap:
    """Which mode governs over a grid of bodies (rows) and frictions (columns).

    Parameters
    ----------
    size_m : (n,) array, m
        2R, the diagonal of each row's block as drawn.
    b_over_h : (n,) array, 1
        Half of its base, less what is worn, over the height of its centre of gravity.
    mu : (k,) array, 1
    governing : (n, k) array of int
        The worst mode, an index into ``GOVERNING``: overturned; flight, where one lasted as long as a rise of half a millimetre takes;
        slide-rock, where it rocked and slid half a millimetre in all; rock; slide; rest, where nothing moved at all; no answer, where the
        run was given up: then lean and displacements are those of that instant.
    max_rotation_ratio : (n, k) array
        Largest lean over alpha.
    slip_path_m, final_displacement_m : (n, k) arrays, m
        Length slid, and where it ends, signed.
    loading, loading_time_s : float, 1 and s
        Largest abs(a)/(g + a_y) of the motion, and when: a block rests if neither mu nor b/h is below it.
    friction_to_rock : (n,) array, 1
        Friction that a corner needs if that comes as a jump, NaN where the block would not rock.
    """

    size_m: FloatArray
    b_over_h: FloatArray
    mu: FloatArray
    governing: IntArray
    max_rotation_ratio: FloatArray
    slip_path_m: FloatArray
    final_displacement_m: FloatArray
    loading: float
    loading_time_s: float
    friction_to_rock: FloatArray

    def share(self, mode: str) -> float:
        """Return the share of the cells in which a mode governs."""
        return float(np.mean(self.governing == MODES_BY_SEVERITY.index(mode)))


def mode_map(
    frictions: ArrayLike,
    sizes: ArrayLike,
    slendernesses: ArrayLike,
    motion: Motion,
    *,
    inset: EdgeWear = SHARP_EDGES,
    restitution: float = 0.0,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
    settle_s: float = 60.0,
    progress: Progress | None = None,
) -> ModeMap:
    """Return which mode governs the motion of rectangular blocks under a record, with the limits of initiation ([Shenton1996]_).

    Parameters
    ----------
    frictions : (k,) array, 1
        Static and kinetic friction, 0 or more.
    sizes, slendernesses : (n,) and (1,), (1,) and (n,), or (n,) and (n,) arrays, m and rad
        Diagonals 2R and alpha = atan(B/H) of the blocks as drawn.
    motion : Motion
    inset : Inset
        How far the edges are worn, per side.
    restitution : float
        Poisson's, in [0, 1).
    vertical : bool, float or None
        Whether the vertical component acts, or a factor on it; None: where the record has one.
    gravity : float, m/s^2
    settle_s : float, s
        How long bodies are followed after the record.
    progress : callable
        Told the number of runs done and the number in all.

    Raises
    ------
    ParameterError
        If a number is out of its range, or there are no or too many cells.

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> found = mode_map([0.2, 0.6], [1.0], [0.2], pulse)
    >>> found.share("slide"), found.share("overturned")
    (0.5, 0.5)
    """
    mu = np.array([checks.non_negative(N_("the friction coefficient mu"), value) for value in np.atleast_1d(frictions)])
    blocks = _blocks(sizes, slendernesses, inset)
    validate_motion(motion)
    cells = len(blocks) * mu.size
    if not cells:
        raise ParameterError("a map needs at least one cell")
    check_limit(N_("cells"), cells, "SEISBLOCK_CELLS")
    kinds, friction_by_cell = np.arange(cells) // mu.size, np.tile(mu, len(blocks))
    settings = RespondBatchParams(
        to_block_array(blocks)[kinds], friction_by_cell, friction_by_cell, np.full(cells, restitution), np.ones(cells), False, gravity, 0.0
    )
    alphas = settings.blocks.slendernesses.min(axis=1)
    up = vertical_gain(motion, vertical)
    ratio, time = peak_loading_ratio(motion, vertical=vertical, gravity=gravity)
    visible_flight_s = math.sqrt(8.0 * VISIBLE_SLIP_M / gravity)
    table, gave_up = np.empty((cells, 4)), 0
    for first in range(0, cells, CHUNK_SIZE):
        part = slice(first, min(first + CHUNK_SIZE, cells))
        result = respond_many(settings[part], motion, gains=(1.0, 0.0, up), settle_s=settle_s)
        gave_up += int(result.gave_up.sum())
        lean = result.max_rotation_rad / alphas[part]
        table[part] = np.column_stack([_worst_mode(result, visible_flight_s), lean, result.slip_path_m, result.final_displacement_m])
        if progress is not None:
            progress(part.stop, cells)
    if gave_up == cells:
        raise no_answer(cells, cells, int(result.impacts.min()))
    worst, lean, path, end = table.T.reshape(4, len(blocks), mu.size)
    required_friction = [None if math.isinf(ratio) else friction_to_rock(block, ratio) for block in blocks]
    return ModeMap(
        np.array([math.hypot(block.width, block.height) for block in blocks]),
        np.array([min(block.arms) / block.centre for block in blocks]),
        mu,
        worst.astype(np.int64),
        lean,
        path,
        end,
        ratio,
        time,
        np.array([math.nan if friction is None else friction for friction in required_friction]),
    )


def _blocks(sizes: ArrayLike, slendernesses: ArrayLike, inset: EdgeWear) -> list[Block]:
    """Return one block per row."""
    diagonals, alphas = (np.atleast_1d(checks.float_array("sizes and slendernesses", values)) for values in (sizes, slendernesses))
    for value in diagonals:
        checks.positive(N_("each size 2R"), float(value), "m")
    for value in alphas:
        checks.in_interval(N_("each slenderness alpha"), float(value), f"(0, {math.pi / 2:.4g})", "rad")
    if diagonals.size != alphas.size and 1 not in (diagonals.size, alphas.size):
        raise ParameterError("a map has rows of many sizes or of many slendernesses, not of both: give one size, or one slenderness")
    pairs = np.broadcast(diagonals, alphas)
    return [Block(d * math.sin(a), d * math.cos(a)).with_wear(inset) for d, a in ((float(d), float(a)) for d, a in pairs)]


def _worst_mode(result: RespondBatchResult, visible_flight_s: float) -> IntArray:
    """Return the worst mode of each run that one could see, as an index into ``GOVERNING``."""
    _, slid, rocked, skidded, flew = (result.time_in_mode_s[:, i] > 0.0 for i in range(len(MODE_COLUMNS)))
    rotated = rocked | skidded | flew
    return np.select(
        [
            result.gave_up,
            result.overturned,
            result.longest_flight_s >= visible_flight_s,
            rotated & (result.slip_path_m >= VISIBLE_SLIP_M),
            rotated,
            slid,
        ],
        [MODES_BY_SEVERITY.index(mode) for mode in (NO_ANSWER, OVERTURNED, FLIGHT, SLIDE_ROCK, ROCK, SLIDE)],
        MODES_BY_SEVERITY.index(REST),
    )
