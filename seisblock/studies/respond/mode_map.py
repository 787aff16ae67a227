"""Maps of the governing mode: one record, rectangular blocks over friction and slenderness, or friction and size."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import to_block_array
from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_CELLS, check_limit
from seisblock.core.typing import ArrayLike, FloatArray, IntArray, Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.criteria.initiation import Mode, friction_to_rock, peak_loading_ratio
from seisblock.models.respond.batch import MODE_COLUMNS, RespondBatchResult, no_answer, respond_many
from seisblock.models.respond.params import RespondBatchParams
from seisblock.records import Motion
from seisblock.records._validation import Gain, validate_motion, vertical_gain

NO_ANSWER = N_("no answer")
"""Label of a body whose run was stopped without a result."""

MODES_BY_SEVERITY = (Mode.REST, Mode.SLIDE, Mode.ROCK, Mode.SLIDE_ROCK, Mode.FLIGHT, Mode.OVERTURNED, NO_ANSWER)
"""Modes from the mildest to the worst; the worst visible one stands for a body. Last: bodies without a result."""

VISIBLE_SLIP_M = 5e-4
"""Smallest visible slip of a rocking body, and smallest visible rise in flight, m."""

CHUNK_SIZE = 200
"""Cells between two progress reports."""


@dataclass(frozen=True, eq=False, repr=False)
class ModeMap(DisplayMixin):
    """Governing mode over a grid of bodies (rows) and friction coefficients (columns).

    Parameters
    ----------
    size_m : (n,) array, m
        2R, the diagonal of each row's block with sharp edges.
    b_over_h : (n,) array, 1
        Half of the worn base over the height of the centre of gravity.
    mu : (k,) array, 1
    governing : (n, k) array of int
        Worst mode, an index into ``MODES_BY_SEVERITY``: overturned; flight, if one lasts at least as long as a rise of half a
        millimetre takes; slide-rock, for a rocking body with a slip path of at least half a millimetre; rock; slide; rest; no
        result, for a stopped run: tilt and displacements are then those of that instant.
    max_rotation_ratio : (n, k) array
        Peak tilt over alpha.
    slip_path_m, final_displacement_m : (n, k) arrays, m
        Length of the slip path, and residual displacement, signed.
    loading, loading_time_s : float, 1 and s
        Largest abs(a)/(g + a_y) of the motion, and its time: a block rests if both mu and b/h exceed it.
    friction_to_rock : (n,) array, 1
        Friction coefficient required to rock if that loading is applied as a step, NaN for a block that would not rock.
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
        """Return the share of the cells governed by a mode."""
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
    """Return the governing mode of rectangular blocks under a record, with the limits of initiation ([Shenton1996]_).

    Parameters
    ----------
    frictions : (k,) array, 1
        Static and kinetic friction, 0 or more.
    sizes, slendernesses : (n,) and (1,), (1,) and (n,), or (n,) and (n,) arrays, m and rad
        Diagonals 2R and alpha = atan(B/H) of the blocks with sharp edges.
    motion : Motion
    inset : EdgeWear
        Edge wear, per side.
    restitution : float
        Poisson's, in [0, 1).
    vertical : bool, float or None
        True or a factor to apply the vertical component; None: if the record has one.
    gravity : float, m/s^2
    settle_s : float, s
        Time integrated after the record.
    progress : callable
        Called with the number of finished runs and the total.

    Returns
    -------
    ModeMap

    Raises
    ------
    ParameterError
        If a number is out of its range, or there are no or too many cells.

    Examples
    --------
    >>> from seisblock.studies import mode_map
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> result = mode_map([0.2, 0.6], [1.0], [0.2], pulse)
    >>> result.share("slide"), result.share("overturned")
    (0.5, 0.5)
    """
    mu = np.array([checks.non_negative(N_("the friction coefficient mu"), value) for value in np.atleast_1d(frictions)])
    blocks = _blocks(sizes, slendernesses, inset)
    validate_motion(motion)
    # cells row by row: block index varies slowest
    cells = len(blocks) * mu.size
    if not cells:
        raise ParameterError("a mode map requires at least one cell: give at least one friction, size and slenderness")
    check_limit(N_("cells"), cells, MAX_CELLS)
    kinds, friction_by_cell = np.arange(cells) // mu.size, np.tile(mu, len(blocks))
    settings = RespondBatchParams(
        to_block_array(blocks)[kinds], friction_by_cell, friction_by_cell, np.full(cells, restitution), np.ones(cells), False, gravity, 0.0
    )
    # Shenton's initiation limits use the same vertical motion as the runs
    up = vertical_gain(motion, vertical)
    ratio, time = peak_loading_ratio(motion, vertical=vertical, gravity=gravity)
    # free flight to a height h and back takes sqrt(8 h/g)
    visible_flight_s = math.sqrt(8.0 * VISIBLE_SLIP_M / gravity)
    table, gave_up = np.empty((cells, 4)), 0
    for first in range(0, cells, CHUNK_SIZE):
        part = slice(first, min(first + CHUNK_SIZE, cells))
        result = respond_many(settings[part], motion, gains=(1.0, 0.0, up), settle_s=settle_s)
        gave_up += int(result.gave_up.sum())
        table[part] = np.column_stack(
            [_worst_mode(result, visible_flight_s), result.max_rotation_ratio, result.slip_path_m, result.final_displacement_m]
        )
        if progress is not None:
            progress(part.stop, cells)
    if gave_up == cells:
        raise no_answer(cells, cells, int(result.impacts.min()))
    worst, lean, path, end = table.T.reshape(4, len(blocks), mu.size)
    # an infinite loading ratio means that the ground falls away: no friction is defined
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
    diagonals, alphas = (np.atleast_1d(checks.float_array("sizes and slendernesses", values)) for values in (sizes, slendernesses))
    for value in diagonals:
        checks.positive(N_("size 2R"), float(value), "m")
    for value in alphas:
        checks.in_interval(N_("slenderness alpha"), float(value), f"(0, {math.pi / 2:.4g})", "rad")
    if diagonals.size != alphas.size and 1 not in (diagonals.size, alphas.size):
        raise ParameterError("`sizes` and `slendernesses` must have the same length, or one of them a single value")
    pairs = np.broadcast(diagonals, alphas)
    return [Block(d * math.sin(a), d * math.cos(a)).with_wear(inset) for d, a in ((float(d), float(a)) for d, a in pairs)]


def _worst_mode(result: RespondBatchResult, visible_flight_s: float) -> IntArray:
    """Return the worst visible mode of each run, an index into ``MODES_BY_SEVERITY``."""
    _, slid, rocked, skidded, flew = (result.time_in_mode_s[:, i] > 0.0 for i in range(len(MODE_COLUMNS)))
    rotated = rocked | skidded | flew
    # np.select takes the first condition that holds: from the worst to the mildest
    return np.select(
        [
            result.gave_up,
            result.overturned,
            result.longest_flight_s >= visible_flight_s,
            rotated & (result.slip_path_m >= VISIBLE_SLIP_M),
            rotated,
            slid,
        ],
        [MODES_BY_SEVERITY.index(mode) for mode in (NO_ANSWER, Mode.OVERTURNED, Mode.FLIGHT, Mode.SLIDE_ROCK, Mode.ROCK, Mode.SLIDE)],
        MODES_BY_SEVERITY.index(Mode.REST),
    )
