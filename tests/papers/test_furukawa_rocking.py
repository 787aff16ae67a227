"""[Furukawa2009]_ fig. 6 against one rigid rocking block."""

import pytest

from seisblock.validation.furukawa_rocking import CASES, HEIGHTS, WIDTH


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_cases(case):
    """Every statement has the verdict it claims."""
    assert case.run().verdict == case.status


def test_stones_of_table_1():
    """29 stones, H/B from 1.25 to 6.5."""
    assert len(HEIGHTS) == 29
    assert HEIGHTS[0] / WIDTH == pytest.approx(1.25)
    assert HEIGHTS[-1] / WIDTH == pytest.approx(6.5)
