"""[Furukawa2009]_ section 3 by our own distinct elements: what holds holds, what differs still does."""

import numpy as np
import pytest

from seisblock.measures import ground_history
from seisblock.validation.furukawa_pile import CASES, LEVELS, kobe_like


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_case(case):
    """Thresholds of the pile and the shaking table read as the program claims."""
    result = case.run()
    assert result.verdict == case.status, f"{case.where}: expected {result.expected}, computed {result.computed}"


@pytest.mark.parametrize("level", LEVELS)
def test_motions_have_the_peaks_of_table_4(level):
    """The motions of table 5 have its PGA, and its PGV within 2 %."""
    motion = kobe_like(level, 0)
    pga, pgv = LEVELS[level]
    assert np.abs(motion.acceleration).max(axis=1) == pytest.approx(pga)
    result = [np.abs(ground_history(row, motion.dt).velocity).max() for row in motion.acceleration]
    assert result == pytest.approx(pgv, rel=0.02)
