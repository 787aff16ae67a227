"""One step with rigid contacts: find contacts, resolve impacts, solve the impulses, update sleeping bodies.

Positions are known at the step, velocities half a step before (leapfrog, :mod:`seisblock.models.stack.step`). Impulses act at the
positions of the step, which conserves energy. The contact condition is imposed on the velocity half a step later, with the rotation of
the body included, so that a stone pivoting about a point leaves it there to third order in the step. A remaining gap is closed in the
next step and does not accumulate ([Moreau1988]_).
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.constraint_assembly import (
    BODY_IDS,
    CONTACT_COUNT,
    EXTRAPOLATION,
    FREE_FALL_SPEED,
    FROM_JOINT,
    FULL_STEP,
    HAD_IMPACT,
    KICK_TIME,
    LAST_STEP,
    PRESS_TIME,
    SWEEP_COUNT,
    mean_force,
)
from seisblock.models.stack.constraint_row import ARM_A, ARM_B, GAP, GYROSCOPIC, IMPACT_IMPULSE, IMPULSE, PRIOR_IMPULSE, apply_impulses
from seisblock.models.stack.frames import INVERSE, F, L, R, T, V
from seisblock.models.stack.friction import SLIP_THRESHOLD, max_turn_time, record_slip, set_friction_cones, sliding_velocity, solve_friction
from seisblock.models.stack.narrow_phase import find_contacts
from seisblock.models.stack.pgs import TOLERANCE, UNCONVERGED_RATIO, impulse_work, solve_contacts, sweep_impact
from seisblock.models.stack.sleeping import can_support, put_to_sleep, wake
from seisblock.models.stack.spring_contact import CACHED_FORCE, CACHED_SLIDING, PREVIOUS_FORCE
from seisblock.models.stack.time_of_impact import (
    add_restitution_rows,
    begin_impacts,
    detect_impacts,
    distribute_joint_impulse,
    load_until_impact,
    make_impact_plastic,
    next_impact_time,
    set_gap_rates,
    store_impact,
)
from seisblock.models.stack.velocity_bounds import max_roll_time, set_velocity_bounds

_t = types()

MAX_IMPACTS = 16
"""Largest number of successive impacts at one instant, each caused by the one before."""

EXTRAPOLATION_RATIO = 0.9
"""Extrapolation factor of the warm start after a full step; below 1, so that self-equilibrated contact forces decay."""


@kernel(_t.void(_t.int64, MATRIX, MATRIX, MEMORY), inline=True)
def _update_inertia(n, bodies, inertias, memory):
    """Write the inverse inertia of the bodies in the ground's axes, their velocities, and the gyroscopic change of their spins."""
    for i in range(n):
        b, v, j = bodies[i], memory.body_velocities[i], memory.inverses[i]
        for p in range(3):
            r0, r1, r2 = b[R + 3 * p], b[R + 3 * p + 1], b[R + 3 * p + 2]
            # R J^-1 R^T: the inverse inertia is constant in the body's axes only
            c = INVERSE
            s0 = r0 * inertias[i, c] + r1 * inertias[i, c + 3] + r2 * inertias[i, c + 6]
            s1 = r0 * inertias[i, c + 1] + r1 * inertias[i, c + 4] + r2 * inertias[i, c + 7]
            s2 = r0 * inertias[i, c + 2] + r1 * inertias[i, c + 5] + r2 * inertias[i, c + 8]
            for q in range(3):
                j[3 * p + q] = s0 * b[R + 3 * q] + s1 * b[R + 3 * q + 1] + s2 * b[R + 3 * q + 2]
        v[0], v[1], v[2] = b[V], b[V + 1], b[V + 2]
        for p in range(3):
            v[3 + p] = j[3 * p] * b[L] + j[3 * p + 1] * b[L + 1] + j[3 * p + 2] * b[L + 2]
        # constant angular momentum: w' = -J^-1 (w x L), with J^-1 in the ground's axes
        g0, g1, g2 = v[4] * b[L + 2] - v[5] * b[L + 1], v[5] * b[L] - v[3] * b[L + 2], v[3] * b[L + 1] - v[4] * b[L]
        for p in range(3):
            v[GYROSCOPIC + p] = -(j[3 * p] * g0 + j[3 * p + 1] * g1 + j[3 * p + 2] * g2)


@kernel(_t.void(MEMORY))
def _store_forces(memory):
    """Store contact forces and slip states in the slots for the warm start of the next step."""
    # the threshold grows with the step, like the velocities that a step leaves undecided
    press_time, threshold = memory.step_info[PRESS_TIME], SLIP_THRESHOLD * memory.step_info[FREE_FALL_SPEED]
    for i in range(int(memory.step_info[CONTACT_COUNT])):
        ids, row = memory.contact_ids[i], memory.constraint_rows[i]
        a, b = ids[BODY_IDS], ids[BODY_IDS + 1]
        slot = memory.joint_slots[ids[3], ids[4], ids[5]] if ids[2] == FROM_JOINT else memory.corner_slots[ids[3], ids[4], ids[5]]
        for k in range(3):
            slot[PREVIOUS_FORCE + k] = slot[CACHED_FORCE + k]
            # an impact resets the force history: the load may have moved to other points
            slot[CACHED_FORCE + k] = mean_force(
                row[IMPULSE + k], press_time, 0.0 if memory.step_info[HAD_IMPACT] > 0.0 else slot[CACHED_FORCE + k], memory
            )
        slot[CACHED_SLIDING] = 0.0
        # an open contact without an impulse neither slides nor touches
        if row[IMPULSE] == 0.0 and row[IMPULSE + 1] == 0.0 and row[IMPULSE + 2] == 0.0 and row[GAP] > 0.0:
            continue
        u0, u1, u2 = sliding_velocity(ids[0], ids[1], row, memory)
        slot[CACHED_SLIDING] = 1.0 if u0 * u0 + u1 * u1 + u2 * u2 > threshold**2 else 0.0
        if row[IMPULSE] == 0.0 and row[IMPULSE + 1] == 0.0 and row[IMPULSE + 2] == 0.0:
            continue
        # marked for the time of the last contact of each pair, from which the outcome tells what a stone fell onto
        memory.contact_matrix[a, b] = 1.0
        memory.contact_matrix[b, a] = 1.0


@kernel(_t.void(_t.int64, MATRIX, _t.boolean, MEMORY))
def _apply_forces(count, bodies, has_impact, memory):
    """Add the impulses to the bodies as mean forces over the step."""
    dt = memory.step_info[KICK_TIME]
    for i in range(count):
        row, a, b = memory.constraint_rows[i], memory.contact_ids[i, BODY_IDS], memory.contact_ids[i, BODY_IDS + 1]
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        if has_impact:
            p0, p1, p2 = p0 + row[PRIOR_IMPULSE], p1 + row[PRIOR_IMPULSE + 1], p2 + row[PRIOR_IMPULSE + 2]
        first, second = bodies[a], bodies[b]
        # forces, not impulses: the kick multiplies by the same time
        p0, p1, p2 = p0 / dt, p1 / dt, p2 / dt
        x, y, z = row[ARM_A], row[ARM_A + 1], row[ARM_A + 2]
        r, s, t = row[ARM_B], row[ARM_B + 1], row[ARM_B + 2]
        first[F] += p0
        first[F + 1] += p1
        first[F + 2] += p2
        first[T] += y * p2 - z * p1
        first[T + 1] += z * p0 - x * p2
        first[T + 2] += x * p1 - y * p0
        second[F] -= p0
        second[F + 1] -= p1
        second[F + 2] -= p2
        second[T] -= s * p2 - t * p1
        second[T + 1] -= t * p0 - r * p2
        second[T + 2] -= r * p1 - s * p0


@kernel(_t.void(_t.int64, _t.int64, _t.float64, _t.float64, _t.float64, _t.float64, LAYOUT, MEMORY), inline=True)
def _advance_velocities(count, n, time, a0, a1, a2, pile, memory):
    """Advance the velocities over a time in the accelerated frame, with the forces stored in the rows."""
    for i in range(n):
        memory.body_velocities[i, 0] -= time * a0
        memory.body_velocities[i, 1] -= time * a1
        memory.body_velocities[i, 2] -= time * a2
    apply_impulses(count, memory.contact_ids, memory.constraint_rows, n, pile.inertias, time, memory.body_velocities)


@kernel(_t.void(_t.int64, _t.int64, _t.float64, LAYOUT, MEMORY))
def _solve_impacts(count, n, time_before, pile, memory):
    """Resolve the impacts at the start of a step; the impulse until then and the impact impulses become the prior impulse.

    An impact with a given restitution and friction may create energy; it is then plastic. A contact so close that an impact drives it to
    strike at the same instant strikes in the next pass.
    """
    contact_rows, tolerance = memory.constraint_rows, TOLERANCE * memory.step_info[FREE_FALL_SPEED]
    load_until_impact(count, time_before, memory)
    solve_contacts(count, n, tolerance, pile, memory)
    begin_impacts(count, memory)
    for _ in range(MAX_IMPACTS):
        # one impact may drive other contacts together at the same instant
        if not detect_impacts(count, False, memory):
            break
        rows = add_restitution_rows(count, n, pile, memory)
        sweep_impact(rows, n, pile, memory)
        solve_contacts(rows, n, tolerance, pile, memory)
        # plastic impulses cannot create energy: only the rows added for a restitution are tested
        if (
            rows > count
            and impulse_work(
                rows, memory.contact_ids, contact_rows, n, pile.inertias, UNCONVERGED_RATIO * tolerance, memory.body_velocities
            )
            > 0.0
        ):
            make_impact_plastic(count, rows, n, pile, memory)
            solve_contacts(count, n, tolerance, pile, memory)
        else:
            distribute_joint_impulse(count, rows, memory)
        store_impact(count, rows, memory)
    # the impact has changed the slip of every closed contact
    record_slip(count, True, memory)
    for i in range(count):
        for k in range(3):
            # the load just before the impact is the first guess of the load after it
            contact_rows[i, IMPULSE + k] = mean_force(contact_rows[i, PRIOR_IMPULSE + k], time_before, 0.0, memory)
            contact_rows[i, PRIOR_IMPULSE + k] += contact_rows[i, IMPACT_IMPULSE + k]


@kernel(_t.float64(MATRIX, _t.float64, _t.float64, _t.float64, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def _solve_contacts(bodies, a0, a1, a2, time_left, refresh_bounds, pile, memory):
    """Solve the contacts of all bodies that are awake and add their forces; return the length of the step, s."""
    n, step_info, rows = bodies.shape[0] - 1, memory.step_info, memory.constraint_rows
    half_last_step = 0.5 * step_info[LAST_STEP]
    _update_inertia(n, bodies, pile.inertias, memory)
    count = find_contacts(bodies, time_left, refresh_bounds, pile, memory)
    record_slip(count, False, memory)
    # contact conditions belong to the middle of the coming step
    # the velocities are half a step behind: advance them to the step, with the extrapolated forces
    set_gap_rates(count, memory)
    _advance_velocities(count, n, half_last_step, a0, a1, a2, pile, memory)
    has_impact = detect_impacts(count, True, memory)
    if has_impact:
        _solve_impacts(count, n, half_last_step, pile, memory)
        # gap rates and bounds after the impacts
        detect_impacts(count, False, memory)
    _advance_velocities(count, n, 0.5 * time_left, a0, a1, a2, pile, memory)
    # after an impact the slip was recorded at the step, else half a step before
    duration, time_before = (0.5 * time_left, 0.0) if has_impact else (half_last_step + 0.5 * time_left, half_last_step)
    max_step = min(max_roll_time(count, time_left, memory), max_turn_time(count, duration, time_before, time_left, memory))
    step = next_impact_time(count, 0.5 * time_left, max_step, memory)
    # an impact or a rim ends the step early: take back the surplus of the advance
    if step < time_left:
        _advance_velocities(count, n, 0.5 * (step - time_left), a0, a1, a2, pile, memory)
    step_info[KICK_TIME] = half_last_step + 0.5 * step
    # after an impact the resting forces act over the second half only
    press_time = 0.5 * step if has_impact else step_info[KICK_TIME]
    for i in range(count):
        # the rows held forces so far, the solver needs impulses
        for j in range(IMPULSE, IMPULSE + 3):
            rows[i, j] *= press_time
    set_velocity_bounds(count, step, memory)
    set_friction_cones(count, memory)
    step_info[SWEEP_COUNT] = solve_friction(count, n, has_impact, pile, memory)
    _apply_forces(count, bodies, has_impact, memory)
    step_info[HAD_IMPACT] = 1.0 if has_impact else 0.0
    step_info[CONTACT_COUNT] = count
    step_info[PRESS_TIME] = press_time
    return step


@kernel(_t.float64(MATRIX, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def step_contacts(bodies, a0, a1, a2, full_step, time_left, refresh_bounds, pile, memory):
    """Add the forces of rigid contacts over a step, in a frame accelerated by (a0, a1, a2) with gravity; return its length, s.

    The step ends where a contact strikes (time of impact). The next step then begins with the impact.

    Parameters
    ----------
    full_step, time_left : float, s
        A full step, and the remainder of it.
    refresh_bounds : bool
        Whether the broad phase updates its bounding boxes.
    """
    n, step_info = bodies.shape[0] - 1, memory.step_info
    step_info[FULL_STEP] = full_step
    step_info[FREE_FALL_SPEED] = full_step * (a0 * a0 + a1 * a1 + a2 * a2) ** 0.5
    # forces can be extrapolated only between steps of full length and without an impact
    step_info[EXTRAPOLATION] = (
        EXTRAPOLATION_RATIO
        if step_info[HAD_IMPACT] == 0.0 and step_info[KICK_TIME] == full_step and 0.5 * (step_info[LAST_STEP] + time_left) == full_step
        else 0.0
    )
    # solve with the sleeping bodies as ground; if a support cannot carry its load, wake all and solve again
    # a stone asleep carries what lies on it without being solved; only this test shows whether it can
    while True:
        step = _solve_contacts(bodies, a0, a1, a2, time_left, refresh_bounds, pile, memory)
        if can_support(n, bodies, a0, a1, a2, pile, memory):
            break
        wake(n, bodies, memory)
        step_info[EXTRAPOLATION], refresh_bounds = 0.0, False
    _store_forces(memory)
    put_to_sleep(int(step_info[CONTACT_COUNT]), n, pile, memory)
    return step
