"""Histories of all solvers are called alike: one name is one quantity, in one unit, with one sign."""

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.two_layer import load_contact, load_two_layer
from seisblock.models.jump import solve_jump
from seisblock.models.respond import solve_respond
from seisblock.models.rock import solve_rock
from seisblock.models.slide import solve_slide
from seisblock.models.stack import solve_stack
from seisblock.models.uplift import solve_uplift
from seisblock.records import Motion

T = np.arange(400) * 0.005
PUSH = np.where(T < 1.0, 5.0 * np.sin(np.pi * T) ** 2, 0.0)
MOTION = Motion.from_arrays(PUSH, 0.005)
"""The ground goes to +x first, so that every body leans and lags to -x."""

RESPONSES = {
    "slide": lambda motion: solve_slide(0.2, motion),
    "rock": lambda motion: solve_rock(Block(0.24, 0.8), motion),
    "jump": lambda motion: solve_jump(load_two_layer("chozusha"), motion, contact=load_contact("chozusha")),
    "uplift": lambda motion: solve_uplift(SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707), motion),
    "stack": lambda motion: solve_stack(load_pile("lantern"), motion, stop_at_fall=True),
    "respond": lambda motion: solve_respond(Block(0.24, 0.8), motion, mu=0.5),
}

UNITS = {
    "rotation": "rad",
    "rotation_across": "rad",
    "angular_velocity": "rad/s",
    "displacement": "m",
    "displacement_across": "m",
    "displacement_up": "m",
    "velocity": "m/s",
    "acceleration": "m/s^2",
    "height": "m",
    "ground_acceleration": "m/s^2",
    "vertical_acceleration": "m/s^2",
    "ground_velocity": "m/s",
}
MAPPING = {
    "slide": {"lower_limit", "upper_limit"},
    "uplift": {f"{quantity}_{corner}" for quantity in ("uplift", "contact_force") for corner in (1, 2, 3, 4)},
    "respond": {"lift", "slip_velocity", "slip_path"},
}
"""What only one model knows."""


@pytest.fixture(scope="module", params=RESPONSES)
def response(request):
    """The answer of each solver to the same push."""
    return RESPONSES[request.param](MOTION)


def test_channels_of_one_name_have_one_quantity_and_unit(response):
    """Channels of one quantity have one name in all solvers; those of a pile begin with the stone."""
    if response.model == "stack":
        kinds = {channel.name.removeprefix(f"{name}_") for channel in response.channels for name in response.body.names}
        kinds = {kind for kind in kinds if "_" not in kind}
        assert kinds == {"tilt", "slip", "x", "y", "z", "qw", "qx", "qy", "qz"}
        return
    common = {channel.name: channel.unit for channel in response.channels if channel.name not in MAPPING.get(response.model, ())}
    assert common.items() <= UNITS.items()
    assert "rotation" in common or response.model == "slide"
    assert "displacement" in common or response.model == "rock"


def test_channels_of_one_name_have_one_sign(response):
    """Pushed to +x, the ground leaves every body behind: it leans to -x and is displaced to -x; mirrored, both signs change."""
    back = RESPONSES[response.model](Motion.from_arrays(-PUSH, 0.005))
    for name in {"rotation", "displacement"} & {channel.name for channel in response.channels}:
        values, mirrored = response[name], back[name]
        moved = np.flatnonzero(np.abs(values) > 1e-3 * np.abs(values).max())
        if name == "displacement" and response.model == "jump":
            # while it rocks its centre moves; it is displaced by the jump that follows, whichever way
            assert np.sign(values[moved[0]]) == -np.sign(mirrored[moved[0]])
            continue
        assert values[moved[0]] < 0.0 < mirrored[np.flatnonzero(np.abs(mirrored) > 1e-3 * np.abs(mirrored).max())[0]], name
    if "angular_velocity" in {channel.name for channel in response.channels}:
        pushed = np.flatnonzero(response["rotation"])[:5]
        assert (response["angular_velocity"][pushed] <= 0.0).all()


def test_histories_cannot_be_changed_by_accident(response):
    """Time and channels are read-only float64 arrays without gaps in memory."""
    for values in (response.time, *(channel.values for channel in response.channels)):
        assert not values.flags.writeable
        assert values.flags.c_contiguous
        assert values.dtype == np.float64
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 1.0
