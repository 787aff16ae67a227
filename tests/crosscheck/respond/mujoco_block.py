"""The block of a case in MuJoCo: a box on a plane that moves in one vertical plane, shaken by turning its gravity."""

from __future__ import annotations

import math

import numpy as np

from tests.crosscheck.respond.cases import Case

SCENE = """
<mujoco>
  <option timestep="{step}" gravity="0 0 -9.80665" cone="elliptic" impratio="100" integrator="implicitfast"
    iterations="50" tolerance="1e-12"/>
  <default><geom friction="{mu} 0 0" solref="{soft} 1" solimp="0.99 0.9999 1e-4"/></default>
  <worldbody>
    <geom type="plane" size="50 50 1"/>
    <body pos="0 0 {h}">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>
      <inertial pos="0 0 0" mass="1" diaginertia="{k2} {k2} {k2}"/>
      <geom type="box" size="{half} {half} {h}" pos="{offset} 0 0"/>
    </body>
  </worldbody>
</mujoco>
"""


def respond(case: Case, step: float = 1e-4, settle: float = 5.0) -> np.ndarray:
    """Return x and theta after every step of a block that stands still at first, (n, 2)."""
    import mujoco

    body = case.body
    right, left = body.arms
    model = mujoco.MjModel.from_xml_string(
        SCENE.format(step=step, soft=4 * step, mu=body.mu, h=body.h, k2=body.k2, half=(right + left) / 2, offset=(right - left) / 2)
    )
    data = mujoco.MjData(model)
    samples = case.dt * np.arange(len(case.along))
    times = np.arange(0.0, samples[-1] + settle, step) + step / 2
    along, up = (np.interp(times, samples, row, right=0.0) for row in (case.along, case.up))
    path = np.zeros((times.size, 2))
    for i in range(times.size):
        model.opt.gravity[0], model.opt.gravity[2] = -along[i], -body.gravity - up[i]
        mujoco.mj_step(model, data)
        path[i] = data.qpos[0], data.qpos[2]
        if abs(path[i, 1]) > math.pi / 2:
            return path[: i + 1]
    return path
