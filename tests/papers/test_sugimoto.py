"""Sugimoto et al. (2017): every case reads as the program claims."""

import pytest

from seisblock.validation.sugimoto import CASES


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_case(case):
    """Each case holds or differs as its status states, within its tolerance."""
    result = case.run()
    assert result.verdict == case.status, f"{case.where}: expected {result.expected}, computed {result.computed}"
