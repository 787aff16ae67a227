"""Time integration of a pile on contact springs with fixed steps.

The step divides the sampling interval; the acceleration is linear between samples. The loop pauses after a number of steps so that Python
may be interrupted, and continues from there; the result does not depend on the pauses.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.core.status import NOT_FINITE, PAUSED
from seisblock.dynamics.array_types import READ_ONLY_MATRIX
from seisblock.models.stack.broad_phase import BROAD_PHASE_INTERVAL
from seisblock.models.stack.buffers import FIRST_SAMPLE, HAS_FALLEN, LAYOUT, MEMORY, OUTPUT, SAMPLE, SETTINGS, STATE, STEP
from seisblock.models.stack.frames import MASS, F
from seisblock.models.stack.recorder import (
    IMPULSE,
    INITIAL_ENERGY,
    WORK,
    detect_falls,
    finish_sample,
    inertial_work,
    interpolate_ground,
    record_sample,
    steps_to_take,
    update_energy_ledger,
)
from seisblock.models.stack.step import add_all_forces, drift, kick, mechanical_energy

_t = types()


@kernel(_t.boolean(READ_ONLY_MATRIX, _t.int64, _t.boolean, _t.float64, SETTINGS, LAYOUT, MEMORY, STATE, OUTPUT))
def _advance(motion, k, refresh_bounds, total_mass, settings, pile, memory, state, output):
    """Take one step; return whether the energy is finite."""
    counters, bodies = state
    inertias, ledger, g, s, last = pile.inertias, output.energy_ledger, settings.gravity, counters[SAMPLE], settings.last
    n = bodies.shape[0] - 1
    dt = settings.dt / settings.steps
    fraction = k / settings.steps
    a0, a1, a2 = interpolate_ground(motion, s - counters[FIRST_SAMPLE], fraction)
    spring_energy = add_all_forces(bodies, dt, refresh_bounds, pile, memory)
    ledger[IMPULSE] -= dt * (bodies[n, F] + total_mass * a0)
    ledger[IMPULSE + 1] -= dt * (bodies[n, F + 1] + total_mass * a1)
    ledger[IMPULSE + 2] -= dt * (bodies[n, F + 2] + total_mass * (a2 + g))
    work = inertial_work(n, bodies, inertias, a0, a1, a2, 0.5 * dt)
    if k == 0:
        kick(n, bodies, inertias, a0, a1, a2 + g, 0.5 * dt)
        energy = mechanical_energy(n, bodies, inertias, g) + spring_energy
        if s == 0:
            ledger[INITIAL_ENERGY] = energy
        # the energy is that at the step itself, half a kick before the full one: book half of the work, then take it back
        ledger[WORK] -= work
        update_energy_ledger(ledger, energy - ledger[INITIAL_ENERGY])
        ledger[WORK] += work
        if not math.isfinite(energy):
            return False
        kick(n, bodies, inertias, a0, a1, a2 + g, 0.5 * dt)
    else:
        kick(n, bodies, inertias, a0, a1, a2 + g, dt)
    ledger[WORK] -= work + inertial_work(n, bodies, inertias, a0, a1, a2, 0.5 * dt)
    if k == 0:
        record_sample(s, n, s == last, settings, memory, state, output)
    if s < last:
        drift(n, bodies, inertias, dt)
    if detect_falls(n, bodies, (s + fraction) * settings.dt, output.fall_states) and settings.stop_at_fall:
        counters[HAS_FALLEN] = 1
    return True


@kernel(_t.int64(READ_ONLY_MATRIX, SETTINGS, LAYOUT, MEMORY, STATE, OUTPUT))
def run_springs(motion, settings, pile, memory, state, output):
    """Integrate a pile on contact springs through a motion ([Furukawa2009]_) from its state; return a status.

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
