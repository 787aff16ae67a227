"""A horizontal that was recorded is found by its name and by its azimuth, whatever else the record holds."""

import numpy as np
import pytest

from seisblock.core.errors import ComponentError
from seisblock.records import Component, Record, motion_of
from seisblock.records.process import select_component

ONE, OTHER = np.array([1.0, -2.0, 3.0]), np.array([0.5, 0.25, -4.0])


def record(*components):
    return Record(tuple(Component(code, row, azimuth_deg=azimuth) for code, row, azimuth in components), 0.01)


@pytest.mark.parametrize("asked", ["340", "340.0", "-20"])
def test_one_horizontal_is_enough_for_its_own_azimuth(asked):
    motion = motion_of(record(("340", ONE, 340.0)), asked)
    assert motion.horizontal.tolist() == ONE.tolist()
    assert not motion.transverse.any()


@pytest.mark.parametrize("asked", ["700", "-361", "1e300"])
def test_an_azimuth_beyond_a_turn_is_none(asked):
    """It is a slip of the hand, or no direction at all: the sine of 1e300 degrees is what rounding leaves of it."""
    both = record(("NS", ONE, 0.0), ("EW", OTHER, 90.0))
    for take in (motion_of, select_component):
        with pytest.raises(ComponentError, match=r"the azimuth must lie in \[-360, 360\]"):
            take(both, asked)
    assert motion_of(record(("700", ONE, None)), "700").horizontal.tolist() == ONE.tolist()


def test_a_horizontal_of_another_name_is_found_by_its_azimuth():
    assert motion_of(record(("NS", ONE, 0.0)), "360").horizontal.tolist() == ONE.tolist()


def test_a_name_that_is_a_number_names_what_has_no_direction():
    both = record(("1", ONE, None), ("2", OTHER, None))
    assert motion_of(both, "2").horizontal.tolist() == OTHER.tolist()
    assert motion_of(both, "1").horizontal.tolist() == ONE.tolist()


def test_a_recorded_azimuth_has_its_neighbour_across():
    motion = motion_of(record(("340", ONE, 340.0), ("250", OTHER, 250.0)), "340")
    assert motion.horizontal.tolist() == ONE.tolist()
    assert motion.transverse.tolist() == OTHER.tolist()


def test_the_opposite_of_one_horizontal_is_its_negative():
    assert motion_of(record(("340", ONE, 340.0)), "160").horizontal.tolist() == (-ONE).tolist()


def test_another_azimuth_still_needs_two():
    with pytest.raises(ComponentError, match="requires two horizontal components of known azimuth"):
        motion_of(record(("340", ONE, 340.0)), "341")
