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
def test_single_horizontal_answers_its_own_azimuth(asked):
    motion = motion_of(record(("340", ONE, 340.0)), asked)
    assert motion.horizontal.tolist() == ONE.tolist()
    assert not motion.transverse.any()


@pytest.mark.parametrize("asked", ["700", "-361", "1e300"])
def test_azimuth_beyond_full_turn_is_rejected(asked):
    """It is a slip of the hand, or no direction at all: the sine of 1e300 degrees is what rounding leaves of it."""
    both = record(("NS", ONE, 0.0), ("EW", OTHER, 90.0))
    for take in (motion_of, select_component):
        with pytest.raises(ComponentError, match=r"the azimuth must lie in \[-360, 360\]"):
            take(both, asked)
    assert motion_of(record(("700", ONE, None)), "700").horizontal.tolist() == ONE.tolist()


def test_named_horizontal_is_found_by_azimuth():
    assert motion_of(record(("NS", ONE, 0.0)), "360").horizontal.tolist() == ONE.tolist()


def test_numeric_name_selects_component_without_azimuth():
    both = record(("1", ONE, None), ("2", OTHER, None))
    assert motion_of(both, "2").horizontal.tolist() == OTHER.tolist()
    assert motion_of(both, "1").horizontal.tolist() == ONE.tolist()


def test_recorded_azimuth_has_transverse_component():
    motion = motion_of(record(("340", ONE, 340.0), ("250", OTHER, 250.0)), "340")
    assert motion.horizontal.tolist() == ONE.tolist()
    assert motion.transverse.tolist() == OTHER.tolist()


def test_opposite_azimuth_of_single_horizontal_is_negative():
    assert motion_of(record(("340", ONE, 340.0)), "160").horizontal.tolist() == (-ONE).tolist()


def test_other_azimuth_requires_two_horizontals():
    with pytest.raises(ComponentError, match="requires two horizontal components of known azimuth"):
        motion_of(record(("340", ONE, 340.0)), "341")
