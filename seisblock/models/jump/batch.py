"""Batch solver of the jump: many two-layer blocks, or one block at many scale factors, under one motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, TypeVar

import numpy as np

from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.dynamics import Instants, integrate_many
from seisblock.models.jump import modes as flying
from seisblock.models.jump import rocking
from seisblock.models.jump.chain import Chain, ChainOutcome
from seisblock.models.jump.flight import FLIGHT_MODEL
from seisblock.models.jump.free_response import continue_batch_after_record
from seisblock.models.jump.impact import launch_velocities, spin_ratio
from seisblock.models.jump.solve import check_options
from seisblock.records import Motion
from seisblock.records._validation import validate_motion

OUTCOMES = tuple(ChainOutcome)[:-1]
"""Outcomes of a block or a chain, indexed by `outcome_code` of :class:`JumpBatchResult`."""

NO_ROCKING, IMPACT, JUMP, OVERTURNS, OVERTURNS_LANDED, ROCKS, FLIES, MOVES = range(len(OUTCOMES))


@dataclass(frozen=True, eq=False)
class ChainTable:
    """Chains of many runs in chronological order; arrays of shape (n,), one entry per chain.

    Parameters
    ----------
    row, outcome_code : int
        Row of the run, and index into ``OUTCOMES``.
    onset_s, landing_s : s
        After the motion's first sample; NaN without a landing.
    friction_needed : 1
        Largest friction coefficient required by a landing; NaN without a landing.
    energy_before_j, energy_after_j : J
        Kinetic energy before and after the landing with the largest ratio of the two.
    """

    row: IntArray
    outcome_code: IntArray
    onset_s: FloatArray
    landing_s: FloatArray
    friction_needed: FloatArray
    energy_before_j: FloatArray
    energy_after_j: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class JumpBatchResult(DisplayMixin):
    """Results of m runs; arrays of shape (m,).

    Parameters
    ----------
    outcome_code : int
        Index into ``OUTCOMES``, see `outcome` of :class:`~seisblock.models.jump.solve.JumpOutcome`.
    jammed : bool
        True where a landed foot jammed: no result.
    total_displacement_m, final_displacement_m : m
        Sum over the chains, and residual displacement of the centroid; signed.
    friction_needed_at_landing : 1
        Largest friction coefficient required by a landing; NaN without a landing.
    rocking_threshold_m_s2, spin_ratio : m/s^2, 1
    chains : ChainTable
    gave_up : bool
        Abandoned runs without a result: their other entries refer to the preceding chains.
    """

    outcome_code: IntArray
    jammed: BoolArray
    total_displacement_m: FloatArray
    final_displacement_m: FloatArray
    friction_needed_at_landing: FloatArray
    rocking_threshold_m_s2: FloatArray
    spin_ratio: FloatArray
    chains: ChainTable
    gave_up: BoolArray

    @property
    def outcomes(self) -> list[str]:
        """Outcome texts of the rows."""
        return [OUTCOMES[code] for code in self.outcome_code.tolist()]

    def row_dict(self, row: int) -> dict[str, Any]:
        """Return the scalars of one run by their field names in the outcome; None for missing values."""
        friction = float(self.friction_needed_at_landing[row])
        return {
            "outcome": OUTCOMES[self.outcome_code[row]],
            "total_displacement_m": float(self.total_displacement_m[row]),
            "final_displacement_m": float(self.final_displacement_m[row]),
            "friction_needed_at_landing": None if np.isnan(friction) else friction,
            "rocking_threshold_m_s2": float(self.rocking_threshold_m_s2[row]),
            "spin_ratio": float(self.spin_ratio[row]),
        }

    def row_chains(self, row: int, start_s: float) -> tuple[Chain, ...]:
        """Return the chains of one run, with the fields of the table; times count from `start_s` at the first sample, s."""
        result = []
        for n in np.flatnonzero(self.chains.row == row).tolist():
            friction = float(self.chains.friction_needed[n])
            has_landed = not np.isnan(friction)
            chain = Chain(
                OUTCOMES[self.chains.outcome_code[n]],
                direction="",
                rocking_start_s=float(start_s + self.chains.onset_s[n]),
                landing_s=float(start_s + self.chains.landing_s[n]) if has_landed else None,
                friction_needed_at_landing=friction if has_landed else None,
                landing_energy_j=(float(self.chains.energy_before_j[n]), float(self.chains.energy_after_j[n])) if has_landed else None,
            )
            result.append(chain)
        return tuple(result)


def concatenate_chains(tables: Sequence[ChainTable]) -> ChainTable:
    """Return several tables of chains as one."""
    if not tables:
        return ChainTable(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64), *(np.empty(0) for _ in range(5)))
    return ChainTable(*(np.concatenate([getattr(table, field.name) for table in tables]) for field in fields(ChainTable)))


Item = TypeVar("Item")


def jump_many(
    blocks: Sequence[TwoLayerBlock],
    motion: Motion,
    *,
    contacts: Sequence[Contact],
    factors: ArrayLike = 1.0,
    drop: ArrayLike = 0.0,
    spin: str = "momentum",
    direction: str = "both",
    landing: str = "paper",
    first: bool = False,
    gravity: float = STANDARD_GRAVITY,
) -> JumpBatchResult:
    """Solve many two-layer blocks under one motion, bit by bit as single runs ([Sugimoto2017]_).

    An abandoned run is marked in `gave_up` of the result.

    Parameters
    ----------
    blocks, contacts : sequences of TwoLayerBlock and of Contact
        One per row, or a single one for all.
    motion : Motion
        Only the horizontal row acts.
    factors : float or (m,) array
        Scale factors on the motion.
    drop : float or (m,) array, m
        Height of the supporting level above the ground.
    spin, direction, landing, first, gravity
        See :func:`~seisblock.models.jump.solve.solve_jump`.

    Returns
    -------
    JumpBatchResult

    Raises
    ------
    ParameterError
        If an option is outside its range, or the numbers of rows differ.

    Examples
    --------
    >>> from seisblock.models import jump_many
    >>> import numpy as np
    >>> from seisblock.bodies.two_layer import load_contact, load_two_layer
    >>> pulse = Motion.from_arrays(np.concatenate([6.0 * np.sin(np.pi * np.linspace(0, 1, 101)), np.zeros(200)]), 0.01)
    >>> result = jump_many([load_two_layer("chozusha")], pulse, contacts=[load_contact("chozusha")], factors=[0.5, 1.0])
    >>> result.outcomes
    ['did not rock', 'jumped']
    """
    validate_motion(motion)
    factor, drops = np.atleast_1d(checks.float_array("`factors`", factors)), np.atleast_1d(checks.float_array("`drop`", drop))
    check_options(drops.min(initial=0.0), direction, landing, gravity)
    for item, kind in [*((block, TwoLayerBlock) for block in blocks), *((contact, Contact) for contact in contacts)]:
        checks.instance(item, kind)
    counts = {len(blocks), len(contacts), factor.size, drops.size}
    runs = max(counts)
    if not counts <= {1, runs} or 0 in counts:
        raise ParameterError(
            "`blocks`, `contacts`, `factors` and `drop` must have length 1 or one common length, found {counts}", counts=sorted(counts)
        )
    return _run_chains(
        _RowParameters.from_bodies(blocks, contacts, spin, direction, landing, gravity, motion.dt, runs), motion, factor, drops, first
    )


@dataclass(frozen=True, eq=False)
class _RowParameters:
    """Parameters of m runs, one per row: sizes, onset thresholds, rocking and flight parameters, ratios at the impact."""

    sizes: flying.Sizes
    onset: FloatArray
    rocking: FloatArray
    flight: FloatArray
    ratio: FloatArray
    restitution_x: FloatArray
    restitution_y: FloatArray

    @classmethod
    def from_bodies(
        cls,
        blocks: Sequence[TwoLayerBlock],
        contacts: Sequence[Contact],
        spin: str,
        direction: str,
        landing: str,
        gravity: float,
        dt: float,
        runs: int,
    ) -> _RowParameters:
        """Return the rows of `runs` runs; a single block or contact applies to all."""
        count = max(len(blocks), len(contacts))
        pairs = list(zip(_repeat(blocks, count), _repeat(contacts, count), strict=True))

        def rows(values: Sequence[ArrayLike]) -> FloatArray:
            array = np.array(values, dtype=np.float64)
            return np.repeat(array, runs, axis=0) if len(array) == 1 else array

        sizes = ([getattr(block, field.name) for block, _ in pairs] for field in fields(flying.Sizes))
        return cls(
            flying.Sizes(*map(rows, sizes)),
            # the direction restricts onsets only; rocking itself reads no threshold
            rows([rocking.rocking_parameters(block, gravity, direction) for block, _ in pairs]),
            rows([rocking.rocking_parameters(block, gravity, "both") for block, _ in pairs]),
            rows([flying.flight_parameters(block, gravity, contact.mu, contact.kinetic, 0.0, dt, landing) for block, contact in pairs]),
            rows([spin_ratio(block, spin, contact.restitution_x, contact.restitution_y) for block, contact in pairs]),
            rows([contact.restitution_x for _, contact in pairs]),
            rows([contact.restitution_y for _, contact in pairs]),
        )

    def select_sizes(self, index: IntArray) -> flying.Sizes:
        """Return the sizes of the rows `index`."""
        return flying.Sizes(*(getattr(self.sizes, field.name)[index] for field in fields(flying.Sizes)))


def _repeat(items: Sequence[Item], count: int) -> list[Item]:
    """Return `count` items, a single item repeated."""
    return list(items) * (count if len(items) == 1 else 1)


def _run_chains(rows: _RowParameters, motion: Motion, factor: FloatArray, drops: FloatArray, first: bool) -> JumpBatchResult:
    """Solve all rows chain by chain until no row has a further onset of rocking."""
    runs = len(rows.ratio)
    factor, floor_drop = (np.array(np.broadcast_to(value, runs)) for value in (factor, drops))
    instants = Instants(np.zeros(runs, dtype=np.int64), np.zeros(runs))
    codes, jammed, has_jumped = np.zeros(runs, dtype=np.int64), np.zeros(runs, dtype=np.bool_), np.zeros(runs, dtype=np.bool_)
    total, displacement, friction = np.zeros(runs), np.zeros(runs), np.full(runs, np.nan)
    gave_up = np.zeros(runs, dtype=np.bool_)
    tables: list[ChainTable] = []
    active_rows = np.arange(runs)
    while active_rows.size:
        starts = Instants(instants.sample[active_rows], instants.tau[active_rows])
        gains = factor[active_rows, None] * [1.0, 0.0, 0.0]
        search = integrate_many(
            rocking.ROCKING_MODEL,
            motion,
            rows.onset[active_rows],
            np.zeros(2),
            rocking.REST,
            gains=gains,
            start=starts,
            allow_failures=True,
        )
        gave_up[active_rows[search.failed]] = True
        has_onset = ~search.failed & (search.final_mode != rocking.REST)
        active_rows, onset = active_rows[has_onset], Instants(search.end.sample[has_onset], search.end.tau[has_onset])
        if not active_rows.size:
            break
        # a backward chain is the forward chain of the mirrored motion
        sign = np.where(search.final_mode[has_onset] == rocking.ROSE_FORWARD, 1.0, -1.0)
        step = _run_chain(rows, motion, active_rows, floor_drop[active_rows], sign, sign[:, None] * gains[has_onset], onset)
        gave_up[active_rows[step.gave_up]] = True
        tables.append(step.chains)
        codes[active_rows], jammed[active_rows] = step.chains.outcome_code, step.jammed
        has_jumped[active_rows] |= step.chains.outcome_code == JUMP
        # a chain without a jump ends where it began
        total[active_rows] += np.where(np.isin(step.chains.outcome_code, (JUMP, OVERTURNS_LANDED)), step.displacement, 0.0)
        displacement[active_rows] += step.displacement
        friction[active_rows] = np.fmax(friction[active_rows], step.chains.friction_needed)
        # after a landing the block stands on the ground: no further drop
        floor_drop[active_rows] = np.where(np.isnan(step.chains.friction_needed), floor_drop[active_rows], 0.0)
        instants.sample[active_rows], instants.tau[active_rows] = step.end
        continues = (
            np.isin(step.chains.outcome_code, (IMPACT, JUMP)) & ~step.jammed & ~step.gave_up & (step.end.sample < motion.samples - 1)
        )
        active_rows = active_rows[continues & (not first)]
    # a last chain without a jump does not undo an earlier jump, as in the single run
    codes[(codes == IMPACT) & has_jumped] = JUMP
    threshold = rows.rocking[:, rocking.THRESHOLD_FORWARD]
    return JumpBatchResult(codes, jammed, total, displacement, friction, threshold, rows.ratio, concatenate_chains(tables), gave_up)


@dataclass(frozen=True, eq=False)
class _ChainStep:
    """One chain of each active row: chain table, displacement of the centroid, m, end instants, jammed and abandoned rows."""

    chains: ChainTable
    jammed: BoolArray
    displacement: FloatArray
    end: Instants
    gave_up: BoolArray


def _run_chain(
    rows: _RowParameters,
    motion: Motion,
    active_rows: IntArray,
    floor_drop: FloatArray,
    sign: FloatArray,
    gains: FloatArray,
    onset: Instants,
) -> _ChainStep:
    """Solve one chain of the active rows from its onset, each in the frame of its forward direction."""
    sizes = rows.select_sizes(active_rows)
    p = rows.rocking[active_rows]
    rocking_run = continue_batch_after_record(rocking.ROCKING_MODEL, motion, p, np.zeros(2), rocking.ROCK, gains=gains, start=onset)
    gave_up = rocking_run.failed.copy()
    omega, ratio, lift = rocking_run.final[:, rocking.OMEGA], rows.ratio[active_rows], rows.restitution_y[active_rows]
    horizontal, vertical, spin = launch_velocities(omega, ratio, rows.restitution_x[active_rows], lift, sizes.centroid_height, sizes.width)
    has_impact = rocking_run.final_mode == rocking.IMPACT
    codes = np.select([has_impact, rocking_run.final_mode == rocking.OVERTURNED], [IMPACT, OVERTURNS], ROCKS)
    lean = sizes.slenderness - rocking_run.final[:, rocking.THETA]
    displacement, end = sizes.radius * np.sin(lean) - sizes.width / 2, rocking_run.end
    jammed, landing_time = np.zeros(active_rows.size, dtype=np.bool_), np.full(active_rows.size, np.nan)
    friction, energy_before, energy_after = (np.full(active_rows.size, np.nan) for _ in range(3))
    # both lower corners leave the support only if e_y > |theta'_2/theta'_1| (eq. (8b))
    jump_rows = np.flatnonzero(has_impact & ~gave_up & (omega < 0.0) & (lift > abs(ratio)))
    if jump_rows.size:
        p = rows.flight[active_rows[jump_rows]]
        p[:, flying.DROP] = floor_drop[jump_rows]
        start = np.zeros((jump_rows.size, len(FLIGHT_MODEL.states)))
        start[:, flying.OMEGA], start[:, flying.VX], start[:, flying.VY] = spin[jump_rows], horizontal[jump_rows], vertical[jump_rows]
        launch_instants = Instants(rocking_run.end.sample[jump_rows], rocking_run.end.tau[jump_rows])
        flight_run = continue_batch_after_record(
            FLIGHT_MODEL, motion, p, start, flying.FLIGHT, gains=gains[jump_rows], start=launch_instants
        )
        gave_up[jump_rows] = flight_run.failed
        side, final_mode = flight_run.final[:, flying.SIDE], flight_run.final_mode
        # a terminal mode has no corner: take the corner of the last landing
        mode = np.where(final_mode < 0, 1 + (side > 0.0), final_mode)
        displacement[jump_rows] = flying.centroid(rows.select_sizes(active_rows[jump_rows]), floor_drop[jump_rows], mode, flight_run.final)[
            0
        ]
        codes[jump_rows] = np.select(
            [final_mode == flying.END, final_mode == flying.OVERTURNED, final_mode == flying.FLIGHT], [JUMP, OVERTURNS_LANDED, FLIES], MOVES
        )
        jammed[jump_rows] = final_mode == flying.JAMMED
        end.sample[jump_rows], end.tau[jump_rows] = flight_run.end
        has_landed = side != 0.0
        landing_time[jump_rows] = flight_run.first_event_time
        for target, state in (
            (friction, flying.FRICTION_NEEDED),
            (energy_before, flying.ENERGY_BEFORE),
            (energy_after, flying.ENERGY_AFTER),
        ):
            target[jump_rows] = np.where(has_landed, flight_run.final[:, state], np.nan)
    onset_time = onset.sample * motion.dt + onset.tau
    return _ChainStep(
        ChainTable(active_rows, codes, onset_time, landing_time, friction, energy_before, energy_after),
        jammed,
        sign * displacement,
        end,
        gave_up,
    )
