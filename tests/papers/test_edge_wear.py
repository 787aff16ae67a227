"""Evidence on the edge wear of gravestones: every candidate prior against every set of evidence."""

import numpy as np
import pytest

from seisblock.bodies.edge_wear import DEFAULT_WEAR, WORN_RANGE
from seisblock.validation.edge_wear import (
    CANDIDATES,
    CASES,
    CHOSEN,
    candidate_stones,
    rate_intensities,
    shakings,
    tottori_bias,
    tottori_rms,
)


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_case(case):
    """The misfits that the page on trust prints."""
    result = case.run()
    assert result.verdict == case.status, f"{case.quantity}: expected {result.expected}, computed {result.computed}"


@pytest.mark.slow
def test_chosen_prior_is_unbiased_under_either_horizontal():
    """Under both horizontals the prior has the smallest bias, and a smaller rms than sharp edges and than a tenth."""
    biases = {candidate.key: abs(tottori_bias(candidate.key, both=True)) for candidate in CANDIDATES}
    assert min(biases, key=biases.get) == CHOSEN
    assert tottori_rms(CHOSEN, both=True) < min(tottori_rms("sharp", both=True), tottori_rms("tenth", both=True))
    # one horizontal alone favours a tenth: the choice depends on what is counted
    assert min(CANDIDATES, key=lambda candidate: tottori_rms(candidate.key, both=False)).key == "tenth"


@pytest.mark.slow
def test_more_wear_overturns_at_lower_intensity():
    """The intensities of the rule fall from sharp edges to a tenth, at 40 and at 90 %."""
    sharp, half, tenth = (rate_intensities(key) for key in ("sharp", "half", "tenth"))
    assert np.all(sharp > half) and np.all(half > tenth)


def test_candidate_stones_have_their_wear():
    """The prior is even over its range, with its median as default; records cover the frequencies of the fit."""
    shares = np.array([stone.inset.share for stone in candidate_stones("prior").stones])
    assert np.median(shares) == pytest.approx(DEFAULT_WEAR.share)
    assert (shares.min(), shares.max()) == pytest.approx(WORN_RANGE, abs=6e-4)
    assert abs(np.corrcoef(shares, candidate_stones("prior").ratios)[0, 1]) < 0.2
    frequencies = [shaking.frequency for shaking in shakings()]
    assert min(frequencies) < 0.9 and max(frequencies) > 2.0
