"""Sugimoto et al. (2017): every case reads as the program claims."""

import pytest

from seisblock.validation.sugimoto import CASES


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_case(case):
    """What is said to hold holds within the print, what is said to differ still does."""
    result = case.run()
    assert result.verdict == case.status, f"{case.where}: expected {result.expected}, computed {result.computed}"
