"""A pile of boxes in MuJoCo, shaken by turning its gravity: another solver, other contacts, other people."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from seisblock.bodies.pile.pile import Pile
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records import Motion

FALLEN = math.cos(math.radians(60.0))


def model_of(body: Pile, timestep: float, time_constant: float = 0.004):
    """Return the MuJoCo model of a pile whose stones stand free on each other; friction is that of the pile."""
    import mujoco

    friction = f'friction="{body.mu} 0 0" solref="{max(time_constant, 2 * timestep)} 1" solimp="0.99 0.999 0.0001" condim="3"'
    bodies = []
    for stone, centre in zip(body.stones, body.centres(), strict=True):
        half = " ".join(str(0.5 * side) for side in stone.size)
        place = " ".join(str(c) for c in centre)
        bodies.append(
            f'<body name="{stone.name}" pos="{place}"><freejoint/>'
            f'<geom type="box" size="{half}" density="{stone.density}" {friction}/></body>'
        )
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{timestep}" cone="elliptic" impratio="10" iterations="100" tolerance="1e-10"/>'
        f'<worldbody><geom type="plane" size="50 50 1" {friction}/>{"".join(bodies)}</worldbody></mujoco>'
    )


def simulate(body: Pile, motion: Motion, timestep: float, time_constant: float = 0.004) -> Iterator:
    """Yield MuJoCo's state at each sample of a motion."""
    import mujoco

    model = model_of(body, timestep, time_constant)
    data = mujoco.MjData(model)
    steps = round(motion.dt / timestep)
    time = timestep * np.arange((motion.samples - 1) * steps)
    pull = -np.array([np.interp(time, motion.time, row) for row in motion.acceleration]).T
    pull[:, 2] -= STANDARD_GRAVITY
    for index, gravity in enumerate(pull):
        model.opt.gravity[:] = gravity
        mujoco.mj_step(model, data)
        if index % steps == 0:
            yield data


def any_stone_falls(body: Pile, motion: Motion, timestep: float = 5e-4) -> bool:
    """Return whether any stone leans beyond 60 degrees under a motion."""
    return any(data.xmat[1:, 8].min() < FALLEN for data in simulate(body, motion, timestep))


def first_falls(body: Pile, motion: Motion, timestep: float = 1e-4, time_constant: float = 5e-4) -> tuple[list[str], float]:
    """Return the stones that lean beyond 60 degrees first, and how far the centre of the last one has come from its place, m.

    With steps this fine and contacts this stiff, halving the step changes displacements by 1 or 2 %.
    """
    place, away = np.array(body.centres())[-1], 0.0
    for data in simulate(body, motion, timestep, time_constant):
        away = max(away, float(np.linalg.norm(data.xpos[-1] - place)))
        fallen = [name for name, up in zip(body.names, data.xmat[1:, 8], strict=True) if up < FALLEN]
        if fallen:
            return fallen, away
    return [], away
