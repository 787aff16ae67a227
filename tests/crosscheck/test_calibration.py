"""Calibration of the overturning probability: stones drawn and solved by other models overturn as often as computed.

A small version of :mod:`tests.crosscheck.calibration`, whose tables stand on docs/trust.md.
"""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.studies.sampling import ParameterVariation
from tests.crosscheck.calibration import Case, bins, planar_cases, scores, spatial_cases

SHORT = ("el_centro", "corralitos", "synthetic_M6.5_R20_003")
"""Two real records and a synthetic one with the least to integrate."""


@pytest.mark.slow
def test_probability_of_rock_equals_share_of_pendulums_that_overturn():
    """Neither bias nor over- or underconfidence beyond three standard deviations; a restitution 10 % off gives four."""
    cases = planar_cases(13, names=SHORT)
    assert len(cases) == 78 and sum(0.1 < case.probability < 0.9 for case in cases) >= 25
    assert np.abs(scores(cases)).max() < 3.0


@pytest.mark.slow
def test_probability_of_object_equals_share_that_overturns_in_three_dimensions():
    """Square gravestones under three components beside the full response under either horizontal.

    The restitution does not vary: losses beyond a plastic impact, which planar samples contain, have no counterpart in three dimensions.
    """
    cases = spatial_cases(22, names=SHORT, variation=ParameterVariation(restitution=0.0))
    assert len(cases) >= 64 and sum(0.1 < case.probability < 0.9 for case in cases) >= 20
    assert np.abs(scores(cases)).max() < 3.0


def test_scores_grow_with_bias_and_overconfidence():
    """Of 400 cases: calibrated, shifted by 0.1, and probabilities pushed to the ends."""
    rng = np.random.default_rng(1)
    truth = rng.uniform(0.05, 0.95, 400)
    fell = rng.uniform(size=400) < truth
    calibrated, shifted, pushed = (
        scores([Case("", float(p), bool(f)) for p, f in zip(np.clip(values, 0.01, 0.99), fell, strict=True)])
        for values in (truth, truth - 0.1, 0.5 + 1.8 * (truth - 0.5))
    )
    assert np.abs(calibrated).max() < 2.0
    assert shifted[0] > 3.0 and pushed[1] < -3.0
    assert [part.count for part in bins([Case("", p, True) for p in (0.0, 0.19, 0.2, 1.0)])] == [2, 1, 1]
