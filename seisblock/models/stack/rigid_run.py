"""Time integration of a pile with rigid contacts: fixed steps, subdivided at impacts."""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.core.status import NOT_FINITE, PAUSED
from seisblock.dynamics.array_types import READ_ONLY_MATRIX
from seisblock.models.stack.broad_phase import BROAD_PHASE_INTERVAL
from seisblock.models.stack.buffers import FIRST_SAMPLE, HAS_FALLEN, LAYOUT, MEMORY, OUTPUT, SAMPLE, SETTINGS, STATE, STEP
from seisblock.models.stack.constraint_assembly import CONTACT_COUNT, LAST_STEP, SWEEP_COUNT
from seisblock.models.stack.frames import MASS, F
from seisblock.models.stack.pgs import MAX_SWEEPS
from seisblock.models.stack.recorder import (
    IMPULSE,
    INITIAL_ENERGY,
    SOLVED,
    UNCONVERGED,
    WORK,
    detect_falls,
    finish_sample,
    inertial_work,
    interpolate_ground,
    potential_energy_change,
    record_sample,
    steps_to_take,
    update_energy_ledger,
)
from seisblock.models.stack.rigid_step import step_contacts
from seisblock.models.stack.step import drift, kick, mechanical_energy

_t = types()


@kernel(_t.boolean(READ_ONLY_MATRIX, _t.int64, _t.boolean, _t.float64, SETTINGS, LAYOUT, MEMORY, STATE, OUTPUT), inline=True)
def _advance(motion, k, refresh_bounds, total_mass, settings, pile, memory, state, output):
    """Take one step, subdivided at impacts; return whether the energy is finite.

    The energy is taken from the new velocities at the middle of the part: gravity then does the work that it adds to the velocities.
    """
    counters, bodies = state
    inertias, ledger, g, s = pile.inertias, output.energy_ledger, settings.gravity, counters[SAMPLE]
    n = bodies.shape[0] - 1
    full_step = settings.dt / settings.steps
    time_left = full_step
    while time_left > 0.0:
        # a sub-step takes the ground acceleration at its own start, as the leapfrog of full steps does
        fraction = (k + (full_step - time_left) / full_step) / settings.steps
        a0, a1, a2 = interpolate_ground(motion, s - counters[FIRST_SAMPLE], fraction)
        step = step_contacts(bodies, a0, a1, a2 + g, full_step, time_left, refresh_bounds and time_left == full_step, pile, memory)
        if memory.step_info[CONTACT_COUNT] > 0.0:
            ledger[SOLVED] += 1.0
            ledger[UNCONVERGED] += 1.0 if memory.step_info[SWEEP_COUNT] >= MAX_SWEEPS else 0.0
        # leapfrog: velocities go from the middle of the last step to the middle of this one
        kick_time = 0.5 * (memory.step_info[LAST_STEP] + step)
        memory.step_info[LAST_STEP] = step
        # balance of momentum with the ground's reaction: what is left over is an error of the contacts
        ledger[IMPULSE] -= kick_time * (bodies[n, F] + total_mass * a0)
        ledger[IMPULSE + 1] -= kick_time * (bodies[n, F + 1] + total_mass * a1)
        ledger[IMPULSE + 2] -= kick_time * (bodies[n, F + 2] + total_mass * (a2 + g))
        # trapezoidal rule: half of the work at the old velocities, half at the new ones
        ledger[WORK] -= inertial_work(n, bodies, inertias, a0, a1, a2, 0.5 * kick_time)
        kick(n, bodies, inertias, a0, a1, a2 + g, kick_time)
        ledger[WORK] -= inertial_work(n, bodies, inertias, a0, a1, a2, 0.5 * kick_time)
        # energies are compared once per sample: velocities and positions must belong to one instant
        if k == 0 and time_left == full_step:
            energy = mechanical_energy(n, bodies, inertias, g) + potential_energy_change(n, bodies, inertias, g, 0.5 * step)
            if s == 0:
                ledger[INITIAL_ENERGY] = energy
            update_energy_ledger(ledger, energy - ledger[INITIAL_ENERGY])
            if not math.isfinite(energy):
                return False
            record_sample(s, n, s == settings.last, settings, memory, state, output)
        if s == settings.last:
            return True
        drift(n, bodies, inertias, step)
        # exact zero at the end of the step, without round-off of the difference
        time_left = time_left - step if step < time_left else 0.0
        if detect_falls(n, bodies, (s + fraction) * settings.dt, output.fall_states) and settings.stop_at_fall:
            counters[HAS_FALLEN] = 1
            update_energy_ledger(
                ledger,
                mechanical_energy(n, bodies, inertias, g)
                - potential_energy_change(n, bodies, inertias, g, 0.5 * step)
                - ledger[INITIAL_ENERGY],
            )
    return True


@kernel(_t.int64(READ_ONLY_MATRIX, SETTINGS, LAYOUT, MEMORY, STATE, OUTPUT))
def run_rigid(motion, settings, pile, memory, state, output):
    """Integrate a pile with rigid contacts through a motion ([Jean1999]_) from its state; return a status.

    Parameters
    ----------
    motion : (3, k) array, m/s^2
        Ground acceleration along, across, up, from the sample `FIRST_SAMPLE` of the state; the loop pauses at its end.
    settings, pile, memory, state, output : named tuples
        See :mod:`seisblock.models.stack.buffers`.
    """
    counters, bodies = state
    bounds_interval = max(int(BROAD_PHASE_INTERVAL / (settings.dt / settings.steps)), 1)
    total_mass = 0.0
    for i in range(bodies.shape[0] - 1):
        total_mass += pile.inertias[i, MASS]
    while True:
        steps = steps_to_take(motion, settings, state)
        if steps == 0:
            return PAUSED
        for _ in range(steps):
            k = counters[STEP]
            if not _advance(motion, k, k % bounds_interval == 0, total_mass, settings, pile, memory, state, output):
                return NOT_FINITE
            counters[STEP] = k + 1
        status = finish_sample(settings, state)
        if status != PAUSED:
            return status
