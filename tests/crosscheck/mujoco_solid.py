"""A convex body on the ground in MuJoCo, with stiff contacts."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from seisblock import ConvexBody, Motion

GRAVITY = 9.80665


def solid_model(body: ConvexBody, mu: float, timestep: float) -> Any:
    """Return the model of a body: critically damped contacts as stiff as the step allows, elliptic cones."""
    vertices, inertia = body.points - np.array(body.centre), np.array(body.inertia)
    tensor = " ".join(f"{inertia[i, j]:.12g}" for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))
    height = -float(vertices[:, 2].min())
    return mujoco.MjModel.from_xml_string(f"""
<mujoco>
  <option timestep="{timestep}" cone="elliptic" impratio="10" gravity="0 0 {-GRAVITY}" integrator="implicitfast"/>
  <default><geom solref="{2.0 * timestep} 1" solimp="0.99 0.999 0.0001" friction="{mu} 0 0" condim="3"/></default>
  <asset><mesh name="hull" vertex="{" ".join(f"{x:.12g}" for x in vertices.ravel())}" inertia="convex"/></asset>
  <worldbody>
    <geom type="plane" size="5 5 1"/>
    <body name="body" pos="0 0 {height}">
      <freejoint/><inertial pos="0 0 0" mass="{body.mass}" fullinertia="{tensor}"/><geom type="mesh" mesh="hull"/>
    </body>
  </worldbody>
</mujoco>""")


def falls(body: ConvexBody, motion: Motion, mu: float, *, timestep: float = 5e-4, settle_s: float = 1.0, tilt: float = 1.0) -> bool:
    """Return whether a body tilts by more than `tilt`, rad, under a motion and `settle_s` after it."""
    model = solid_model(body, mu, timestep)
    data = mujoco.MjData(model)
    times = np.arange(0.0, (motion.acceleration.shape[1] - 1) * motion.dt + settle_s, timestep)
    sampled = np.arange(motion.acceleration.shape[1]) * motion.dt
    rows = np.array([np.interp(times, sampled, row, right=0.0) for row in motion.acceleration])
    limit = np.cos(tilt)
    for k in range(times.size):
        model.opt.gravity[:] = -rows[0, k], -rows[1, k], -GRAVITY - rows[2, k]
        mujoco.mj_step(model, data)
        _, _, _, _, x, y, _ = data.qpos
        if 1.0 - 2.0 * (x * x + y * y) < limit:
            return True
    return False
