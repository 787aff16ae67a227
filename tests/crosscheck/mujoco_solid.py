"""A convex body on the ground in MuJoCo, with stiff contacts."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from seisblock import ConvexBody, Motion

GRAVITY = 9.80665

CHECK_EVERY = 20
"""Steps between two looks at the state: 10 ms, in which no body tilts far beyond 1 rad and comes back."""

ENERGY_MARGIN = 0.9
"""Part of the energy of overturning below which a body on ground at rest counts as standing: contacts only dissipate."""


def solid_model(body: ConvexBody, mu: float, timestep: float) -> Any:
    """Return the model of a body: critically damped contacts as stiff as the step allows, elliptic cones."""
    vertices, inertia = body.points - np.array(body.centre), np.array(body.inertia)
    tensor = " ".join(f"{inertia[i, j]:.12g}" for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))
    height = -float(vertices[:, 2].min())
    return mujoco.MjModel.from_xml_string(f"""
<mujoco>
  <option timestep="{timestep}" cone="elliptic" impratio="10" gravity="0 0 {-GRAVITY}" integrator="implicitfast">
    <flag energy="enable"/>
  </option>
  <default><geom solref="{2.0 * timestep} 1" solimp="0.99 0.999 0.0001" friction="{mu} 0 0" condim="3"/></default>
  <asset><mesh name="hull" vertex="{" ".join(f"{x:.12g}" for x in vertices.ravel())}" inertia="convex"/></asset>
  <worldbody>
    <geom type="plane" size="5 5 1"/>
    <body name="body" pos="0 0 {height}">
      <freejoint/><inertial pos="0 0 0" mass="{body.mass}" fullinertia="{tensor}"/><geom type="mesh" mesh="hull"/>
    </body>
  </worldbody>
</mujoco>""")


def overturning_barrier(body: ConvexBody) -> tuple[float, float]:
    """Return the least energy that lifts a body at rest over an edge of its base, J, and its tilt there, rad."""
    polygon, height = body.support_polygon - np.array(body.centre[:2]), body.centre[2] - body.points[:, 2].min()
    along = np.roll(polygon, -1, axis=0) - polygon
    distances = np.abs(along[:, 0] * polygon[:, 1] - along[:, 1] * polygon[:, 0]) / np.hypot(*along.T)
    nearest = float(distances.min())
    return body.mass * GRAVITY * (np.hypot(nearest, height) - height), np.arctan2(nearest, height)


def falls(body: ConvexBody, motion: Motion, mu: float, *, timestep: float = 5e-4, settle_s: float = 1.0, tilt: float = 1.0) -> bool:
    """Return whether a body tilts by more than `tilt`, rad, under a motion and `settle_s` after it.

    After the last sample that is not zero the run ends as soon as the body is tilted by less than at
    the barrier and has not the energy to pass it.
    """
    model = solid_model(body, mu, timestep)
    data = mujoco.MjData(model)
    times = np.arange(0.0, (motion.acceleration.shape[1] - 1) * motion.dt + settle_s, timestep)
    sampled = np.arange(motion.acceleration.shape[1]) * motion.dt
    rows = np.array([np.interp(times, sampled, row, right=0.0) for row in motion.acceleration])
    gravity = np.column_stack([-rows[0], -rows[1], -GRAVITY - rows[2]])
    shaken = int(np.flatnonzero(rows.any(axis=0)).max(initial=0)) + 1
    limit, (barrier, tilt_at_barrier) = np.cos(tilt), overturning_barrier(body)
    rest = body.mass * GRAVITY * data.qpos[2]
    for k in range(times.size):
        model.opt.gravity[:] = gravity[k]
        mujoco.mj_step(model, data)
        if k % CHECK_EVERY == 0 or k == times.size - 1:
            _, _, height, _, x, y, _ = data.qpos
            upright = 1.0 - 2.0 * (x * x + y * y)
            if upright < limit:
                return True
            energy = body.mass * GRAVITY * height - rest + data.energy[1]
            if k > shaken and upright > np.cos(tilt_at_barrier) and energy < ENERGY_MARGIN * barrier:
                return False
    return False
