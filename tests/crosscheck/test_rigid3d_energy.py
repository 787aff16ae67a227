"""Energy and penetration in random runs in three dimensions; the script of :mod:`tests.crosscheck.rigid3d_energy` makes 10 000."""

from __future__ import annotations

import pytest

from tests.crosscheck.rigid3d_energy import random_run, unsound


@pytest.mark.slow
def test_rigid3d_creates_no_energy_in_300_random_runs():
    assert list(unsound(0, 300)) == []


@pytest.mark.parametrize("seed", [4368, 5088])
def test_rigid3d_ends_steps_above_the_ground_where_contacts_cease_to_stick(seed):
    """Friction of 2 and of 1000: the height at the end of a step jumps with its length (penetration of 2e-7 and 5e-6 of the size)."""
    assert random_run(seed).is_sound
