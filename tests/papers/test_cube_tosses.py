"""Real tosses of a cube in three dimensions ([PfrommerHalmPosa2020]_)."""

import numpy as np
import pytest

from seisblock.validation.cube_tosses import CASES, ENGINE_DISTANCE, ENGINE_SHARE, FILE, results


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_case(case):
    """Each case holds, or differs by the amount that its note explains."""
    result = case.run()
    assert result.verdict == case.status, f"{case.where}: expected {result.expected}, computed {result.computed}"


def test_tosses_end_no_worse_than_with_stiff_contacts():
    """On the right face as often as in the reference engine, and as near to the measured place."""
    rows = results()
    assert len(rows) == 57
    assert rows[:, 0].mean() >= ENGINE_SHARE
    assert np.median(rows[:, 1]) <= ENGINE_DISTANCE


def test_data_keep_their_licence():
    head = FILE.read_text(encoding="utf-8").split("toss,")[0]
    assert "BSD 3-Clause License" in head and "Redistributions of source code must retain" in head
