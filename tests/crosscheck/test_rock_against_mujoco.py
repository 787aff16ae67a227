"""Free rocking agrees with MuJoCo, a general engine of rigid bodies in contact, within 1 %."""

import math

import mujoco
import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.models.rock.solve import solve_rock
from seisblock.records import Motion

SCENE = """
<mujoco>
  <option timestep="5e-5" gravity="0 0 -9.80665" cone="elliptic" impratio="50" integrator="implicitfast"/>
  <default><geom friction="2 0 0" solref="4e-4 1" solimp="0.99 0.999 1e-4"/></default>
  <worldbody>
    <geom type="plane" size="20 20 1"/>
    <body name="block" pos="{x} 0 {z}" euler="0 {lean} 0">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint name="lean" type="hinge" axis="0 1 0"/>
      <geom type="box" size="{b} {d} {h}" density="2650"/>
    </body>
  </worldbody>
  <compiler angle="radian"/>
</mujoco>
"""


def upright_time(block, theta):
    """Return the time at which MuJoCo's block, released at a lean, stands upright."""
    b, h = block.width / 2, block.height / 2
    x = b - b * math.cos(theta) + h * math.sin(theta)
    z = b * math.sin(theta) + h * math.cos(theta)
    model = mujoco.MjModel.from_xml_string(SCENE.format(x=x, z=z, lean=theta, b=b, h=h, d=b))
    data = mujoco.MjData(model)
    lean, before = theta, theta
    while lean > 0.0:
        mujoco.mj_step(model, data)
        before, lean = lean, theta + data.qpos[2]
    return data.time - model.opt.timestep * lean / (lean - before)


@pytest.mark.parametrize(("width", "height", "share"), [(0.3, 1.0, 0.3), (0.3, 1.0, 0.8), (0.24, 1.2, 0.5), (1.0, 2.5, 0.5)])
def test_rock_quarter_period_equals_mujoco(width, height, share):
    """The time from release to the first impact, from a share of alpha."""
    block = Block(width, height)
    theta = share * block.slenderness
    response = solve_rock(block, Motion.from_arrays(np.zeros(400), 0.01), initial=(theta, 0.0))
    assert response.events[0].name == "impact"
    assert upright_time(block, theta) == pytest.approx(response.events[0].time_s, rel=0.01)
