"""A horizontal that was recorded is found by its name and by its azimuth, whatever else the record holds."""

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.core.errors import ComponentError
from seisblock.records import Component, Record, motion_of
from seisblock.records.motion import azimuth_name, requested_azimuth
from seisblock.records.process import select_component
from seisblock.studies.azimuths import make_azimuth_sweep

FIRST, SECOND = np.array([1.0, -2.0, 3.0]), np.array([0.5, 0.25, -4.0])


def record(*components):
    return Record(tuple(Component(code, row, azimuth_deg=azimuth) for code, row, azimuth in components), 0.01)


@pytest.mark.parametrize("azimuth", ["340", "340.0", "-20"])
def test_single_horizontal_answers_its_own_azimuth(azimuth):
    motion = motion_of(record(("340", FIRST, 340.0)), azimuth)
    assert motion.horizontal.tolist() == FIRST.tolist()
    assert not motion.transverse.any()


@pytest.mark.parametrize("azimuth", ["700", "-361", "1e300"])
def test_azimuth_beyond_full_turn_is_rejected(azimuth):
    """It is a slip of the hand, or no direction at all: the sine of 1e300 degrees is what rounding leaves of it."""
    pair = record(("NS", FIRST, 0.0), ("EW", SECOND, 90.0))
    for take in (motion_of, select_component):
        with pytest.raises(ComponentError, match=r"the azimuth must lie in \[-360, 360\]"):
            take(pair, azimuth)
    assert motion_of(record(("700", FIRST, None)), "700").horizontal.tolist() == FIRST.tolist()


def test_named_horizontal_is_found_by_azimuth():
    assert motion_of(record(("NS", FIRST, 0.0)), "360").horizontal.tolist() == FIRST.tolist()


def test_numeric_name_selects_component_without_azimuth():
    pair = record(("1", FIRST, None), ("2", SECOND, None))
    assert motion_of(pair, "2").horizontal.tolist() == SECOND.tolist()
    assert motion_of(pair, "1").horizontal.tolist() == FIRST.tolist()


def test_recorded_azimuth_has_transverse_component():
    motion = motion_of(record(("340", FIRST, 340.0), ("250", SECOND, 250.0)), "340")
    assert motion.horizontal.tolist() == FIRST.tolist()
    assert motion.transverse.tolist() == SECOND.tolist()


def test_opposite_azimuth_of_single_horizontal_is_negative():
    assert motion_of(record(("340", FIRST, 340.0)), "160").horizontal.tolist() == (-FIRST).tolist()


def test_other_azimuth_requires_two_horizontals():
    with pytest.raises(ComponentError, match="requires two horizontal components of known azimuth"):
        motion_of(record(("340", FIRST, 340.0)), "341")


def test_code_of_component_precedes_the_azimuth_of_that_number():
    """Component 90 recorded towards 100 is that component, and 90.0 the azimuth; a sweep names the azimuth."""
    pair = record(("0", FIRST, 10.0), ("90", SECOND, 100.0))
    component, azimuth = motion_of(pair, "90"), motion_of(pair, "90.0")
    assert component.horizontal.tolist() == SECOND.tolist() == select_component(pair, "90").acceleration.tolist()
    assert component.azimuth_deg == 100.0 and requested_azimuth(component) is None
    assert azimuth.azimuth_deg == requested_azimuth(azimuth) == 90.0
    np.testing.assert_allclose(azimuth.horizontal, np.cos(np.radians(10.0)) * SECOND + np.sin(np.radians(10.0)) * FIRST)
    sweep = make_azimuth_sweep(Block(0.2, 0.6), pair, step_deg=90.0)
    np.testing.assert_allclose(sweep.motion.horizontal, motion_of(pair, "0.0").horizontal)
    assert azimuth_name(pair, 90.0) == "90.0" and azimuth_name(pair, 10.0) == "10"
