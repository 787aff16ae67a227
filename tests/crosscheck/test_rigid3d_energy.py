"""Energy and penetration in random runs in three dimensions; the script of :mod:`tests.crosscheck.rigid3d_energy` makes 10 000."""

from __future__ import annotations

import pytest

from tests.crosscheck.rigid3d_energy import unsound


@pytest.mark.slow
def test_rigid3d_creates_no_energy_in_300_random_runs():
    assert list(unsound(0, 300)) == []
