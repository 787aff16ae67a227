"""Many two-layer blocks, or one under many factors, side by side through one motion: chain after chain, with no Python for each row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TypeVar

import numpy as np

from seisblock import checks
from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.dynamics import Instants, follow_many
from seisblock.errors import ParameterError
from seisblock.records import Motion
from seisblock.records.given import check_motion
from seisblock.solvers.jump import modes as flying
from seisblock.solvers.jump import rocking
from seisblock.solvers.jump.fates import FELL, FELL_LANDED, FLIES, IMPACT, JUMP, MOVES, ROCKS, Chains, JumpFates, joined
from seisblock.solvers.jump.flight import FLYING
from seisblock.solvers.jump.impact import spin_ratio, thrown
from seisblock.solvers.jump.solve import check_options
from seisblock.solvers.jump.still import follow_many_on
from seisblock.typing import ArrayLike, BoolArray, FloatArray, IntArray
from seisblock.units import STANDARD_GRAVITY

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
) -> JumpFates:
    """Return the fates of many two-layer blocks under one motion; bit by bit those of single runs ([Sugimoto2017]_).

    A run that has to be given up is marked in the fates.

    Parameters
    ----------
    blocks, contacts : sequences of TwoLayerBlock and of Contact
        One per row, or a single one for all.
    motion : Motion
        Only its horizontal row acts.
    factors : float or (m,) array
        On the motion.
    drop : float or (m,) array, m
        Height of the floor above the ground.
    spin, direction, landing, first, gravity
        As of :func:`~seisblock.solvers.jump.solve.solve_jump`.

    Raises
    ------
    ParameterError
        If an option is outside its range, or the numbers of rows differ.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.bodies.two_layer import load_contact, load_two_layer
    >>> pulse = Motion.from_arrays(np.concatenate([6.0 * np.sin(np.pi * np.linspace(0, 1, 101)), np.zeros(200)]), 0.01)
    >>> found = jump_many([load_two_layer("chozusha")], pulse, contacts=[load_contact("chozusha")], factors=[0.5, 1.0])
    >>> found.outcomes
    ['did not rock', 'jumped']
    """
    check_motion(motion)
    factor, floor = np.atleast_1d(checks.numbers("the factors", factors)), np.atleast_1d(checks.numbers("the drop", drop))
    check_options(floor.min(initial=0.0), direction, landing, gravity)
    for each, kind in [*((block, TwoLayerBlock) for block in blocks), *((contact, Contact) for contact in contacts)]:
        checks.instance(each, kind)
    counts = {len(blocks), len(contacts), factor.size, floor.size}
    runs = max(counts)
    if not counts <= {1, runs} or 0 in counts:
        raise ParameterError("blocks, contacts, factors and drops must be one each, or one for all; found {counts}", counts=sorted(counts))
    return _follow(_Rows.gathered(blocks, contacts, spin, direction, landing, gravity, motion.dt, runs), motion, factor, floor, first)


@dataclass(frozen=True, eq=False)
class _Rows:
    """What many runs are of, a row each: sizes, thresholds of the onset, parameters of rocking and flight, and ratios at the impact."""

    sizes: flying.Sizes
    onset: FloatArray
    rocking: FloatArray
    flight: FloatArray
    ratio: FloatArray
    restitution_x: FloatArray
    restitution_y: FloatArray

    @classmethod
    def gathered(
        cls,
        blocks: Sequence[TwoLayerBlock],
        contacts: Sequence[Contact],
        spin: str,
        direction: str,
        landing: str,
        gravity: float,
        dt: float,
        runs: int,
    ) -> _Rows:
        """Gather the rows of blocks and contacts, of which a single one is that of all."""
        several = max(len(blocks), len(contacts))
        pairs = list(zip(_each(blocks, several), _each(contacts, several), strict=True))

        def rows(values: Sequence[ArrayLike]) -> FloatArray:
            found = np.array(values, dtype=np.float64)
            return np.repeat(found, runs, axis=0) if len(found) == 1 else found

        sizes = ([getattr(block, field.name) for block, _ in pairs] for field in fields(flying.Sizes))
        return cls(
            flying.Sizes(*map(rows, sizes)),
            rows([rocking.rocking_parameters(block, gravity, direction) for block, _ in pairs]),
            rows([rocking.rocking_parameters(block, gravity, "both") for block, _ in pairs]),
            rows([flying.flight_parameters(block, gravity, on.mu, on.kinetic, 0.0, dt, landing) for block, on in pairs]),
            rows([spin_ratio(block, spin, on.restitution_x, on.restitution_y) for block, on in pairs]),
            rows([on.restitution_x for _, on in pairs]),
            rows([on.restitution_y for _, on in pairs]),
        )

    def of_sizes(self, chosen: IntArray) -> flying.Sizes:
        """Return the sizes of some rows."""
        return flying.Sizes(*(getattr(self.sizes, field.name)[chosen] for field in fields(flying.Sizes)))


def _each(given: Sequence[Item], several: int) -> list[Item]:
    """Return one for each row."""
    return list(given) * (several if len(given) == 1 else 1)


def _follow(rows: _Rows, motion: Motion, factor: FloatArray, floor: FloatArray, first: bool) -> JumpFates:
    """Follow all rows from chain to chain, as long as one of them has another."""
    runs = len(rows.ratio)
    factor, left = (np.array(np.broadcast_to(each, runs)) for each in (factor, floor))
    now = Instants(np.zeros(runs, dtype=np.int64), np.zeros(runs))
    fate, jammed, has_jumped = np.zeros(runs, dtype=np.int64), np.zeros(runs, dtype=np.bool_), np.zeros(runs, dtype=np.bool_)
    total, moved, needed = np.zeros(runs), np.zeros(runs), np.full(runs, np.nan)
    gave_up = np.zeros(runs, dtype=np.bool_)
    found: list[Chains] = []
    going = np.arange(runs)
    while going.size:
        here = Instants(now.sample[going], now.tau[going])
        along = factor[going, None] * [1.0, 0.0, 0.0]
        rose = follow_many(
            rocking.ROCKING, motion, rows.onset[going], np.zeros(2), rocking.REST, gains=along, start=here, allow_failures=True
        )
        gave_up[going[rose.failed]] = True
        up = ~rose.failed & (rose.final_mode != rocking.REST)
        going, onset = going[up], Instants(rose.end.sample[up], rose.end.tau[up])
        if not going.size:
            break
        sign = np.where(rose.final_mode[up] == rocking.ROSE_FORWARD, 1.0, -1.0)
        some = _chain(rows, motion, going, left[going], sign, sign[:, None] * along[up], onset)
        gave_up[going[some.gave_up]] = True
        found.append(some.chains)
        fate[going], jammed[going] = some.chains.fate, some.jammed
        has_jumped[going] |= some.chains.fate == JUMP
        total[going] += np.where(np.isin(some.chains.fate, (JUMP, FELL_LANDED)), some.moved, 0.0)
        moved[going] += some.moved
        needed[going] = np.fmax(needed[going], some.chains.needed)
        left[going] = np.where(np.isnan(some.chains.needed), left[going], 0.0)
        now.sample[going], now.tau[going] = some.end
        on = np.isin(some.chains.fate, (IMPACT, JUMP)) & ~some.jammed & ~some.gave_up & (some.end.sample < motion.samples - 1)
        going = going[on & (not first)]
    fate[(fate == IMPACT) & has_jumped] = JUMP
    threshold = rows.rocking[:, rocking.THRESHOLD_FORWARD]
    return JumpFates(fate, jammed, total, moved, needed, threshold, rows.ratio, joined(found), gave_up)


@dataclass(frozen=True, eq=False)
class _Chain:
    """One chain of each of some rows: what becomes of it, how far it moves the centroid, m, where it ends, and whether it was given up."""

    chains: Chains
    jammed: BoolArray
    moved: FloatArray
    end: Instants
    gave_up: BoolArray


def _chain(rows: _Rows, motion: Motion, going: IntArray, left: FloatArray, sign: FloatArray, gains: FloatArray, onset: Instants) -> _Chain:
    """Follow one chain of some rows from its onset, each in the frame in which it goes forward."""
    sizes = rows.of_sizes(going)
    p = rows.rocking[going]
    rocked = follow_many_on(rocking.ROCKING, motion, p, np.zeros(2), rocking.ROCK, gains=gains, start=onset)
    gave_up = rocked.failed.copy()
    omega, ratio, lift = rocked.final[:, rocking.OMEGA], rows.ratio[going], rows.restitution_y[going]
    along, up, spin = thrown(omega, ratio, rows.restitution_x[going], lift, sizes.centroid_height, sizes.width)
    hit = rocked.final_mode == rocking.IMPACT
    fate = np.select([hit, rocked.final_mode == rocking.OVERTURNED], [IMPACT, FELL], ROCKS)
    lean = sizes.slenderness - rocked.final[:, rocking.THETA]
    moved, end = sizes.radius * np.sin(lean) - sizes.width / 2, rocked.end
    jammed, touched = np.zeros(going.size, dtype=np.bool_), np.full(going.size, np.nan)
    needed, before, after = (np.full(going.size, np.nan) for _ in range(3))
    jumps = np.flatnonzero(hit & ~gave_up & (omega < 0.0) & (lift > abs(ratio)))
    if jumps.size:
        p = rows.flight[going[jumps]]
        p[:, flying.DROP] = left[jumps]
        start = np.zeros((jumps.size, len(FLYING.states)))
        start[:, flying.OMEGA], start[:, flying.VX], start[:, flying.VY] = spin[jumps], along[jumps], up[jumps]
        since = Instants(rocked.end.sample[jumps], rocked.end.tau[jumps])
        flown = follow_many_on(FLYING, motion, p, start, flying.FLIGHT, gains=gains[jumps], start=since)
        gave_up[jumps] = flown.failed
        side, last = flown.final[:, flying.SIDE], flown.final_mode
        # the end names no corner: it is that which landed last
        mode = np.where(last < 0, 1 + (side > 0.0), last)
        moved[jumps] = flying.centroid(rows.of_sizes(going[jumps]), left[jumps], mode, flown.final)[0]
        fate[jumps] = np.select([last == flying.END, last == flying.OVERTURNED, last == flying.FLIGHT], [JUMP, FELL_LANDED, FLIES], MOVES)
        jammed[jumps] = last == flying.JAMMED
        end.sample[jumps], end.tau[jumps] = flown.end
        landed = side != 0.0
        touched[jumps] = flown.first_change
        for kept, state in ((needed, flying.NEEDED), (before, flying.BEFORE), (after, flying.AFTER)):
            kept[jumps] = np.where(landed, flown.final[:, state], np.nan)
    begun = onset.sample * motion.dt + onset.tau
    return _Chain(Chains(going, fate, begun, touched, needed, before, after), jammed, sign * moved, end, gave_up)
