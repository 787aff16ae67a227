"""Scale factor from a residual twist: the interval holds the factor of a simulated observation."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.stats import foldnorm

from seisblock import Block, Motion, motion_of, read
from seisblock.cli import main
from seisblock.core.errors import ParameterError
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.studies.sampling import ParameterVariation, draw_samples, rigid3d_outcomes
from seisblock.studies.survey.twist import MIN_TWIST_ERROR_DEG, TWIST_ERROR, _likelihood, infer_twist, pooled_pga

BODY, OPTIONS = Block(0.24, 0.72, 0.3), Rigid3dOptions(mu=0.5, settle_s=5.0)


@pytest.fixture(scope="module")
def motion():
    """Six seconds of the bundled record, all components."""
    full = motion_of(read("synthetic_jma.csv"), "NS")
    part = slice(int(21.0 / full.dt), int(28.0 / full.dt))
    return Motion(full.acceleration[:, part], full.dt, "NS", 0.0, full.record)


@pytest.mark.slow
def test_infer_twist_covers_the_factors_of_simulated_observations(motion):
    """Objects and factors drawn as assumed, of those that stand and twist: about nine in ten intervals hold the factor."""
    scales = np.exp(np.random.default_rng(8).uniform(np.log(0.35), np.log(0.7), 60))
    outcomes = rigid3d_outcomes(BODY, motion, OPTIONS, draw_samples(60, 99), ParameterVariation(amplitude=0.0), scales=scales)
    hits = []
    for scale, outcome in zip(scales, outcomes, strict=True):
        if outcome.overturned or not 0.8 < abs(outcome.twist_deg) < 6.0:
            continue
        estimate = infer_twist(BODY, motion, OPTIONS, outcome.twist_deg, runs=200, limit=1.0)
        if estimate.scale is None:
            continue
        peak = np.abs(motion.acceleration[:2]).max()
        assert estimate.pga_m_s2.median == pytest.approx(estimate.scale.median * peak, rel=0.02)
        hits.append(estimate.scale.low <= scale <= estimate.scale.high)
        if len(hits) == 6:
            break
    assert len(hits) >= 4
    assert sum(hits) >= len(hits) - 1


def test_infer_twist_has_no_interval_for_a_twist_out_of_reach(motion):
    estimate = infer_twist(BODY, motion, OPTIONS, 150.0, runs=30, limit=0.5)
    assert estimate.scale is None and estimate.pga_m_s2 is None
    assert estimate.largest_twist_deg < 90.0
    assert pooled_pga([estimate]) is None
    with pytest.raises(ParameterError, match="observed twist"):
        infer_twist(BODY, motion, OPTIONS, 200.0)


def test_pooled_pga_spans_the_records(motion):
    strong = Motion(2.0 * motion.acceleration, motion.dt, "NS")
    estimates = [infer_twist(BODY, rows, OPTIONS, 1.0, runs=100, limit=1.2) for rows in (motion, strong)]
    pooled = pooled_pga(estimates)
    assert min(e.pga_m_s2.low for e in estimates) <= pooled.low <= pooled.median <= pooled.high
    # twice the record at half the factor
    assert estimates[1].pga_m_s2.median == pytest.approx(estimates[0].pga_m_s2.median, rel=0.2)


def test_infer_twist_command_gives_factor_and_pga(tmp_path):
    arguments = ["infer", "--twist", "1", "--width", "24cm", "--height", "60cm", "--mu", "0.5", "--window", "21:28", "--runs", "200"]
    result = CliRunner().invoke(main, [*arguments, "--json", "--csv", str(tmp_path / "runs.csv")])
    assert result.exit_code == 0, result.output
    answer = json.loads(result.stdout)
    first = answer["results"][0]
    assert answer["parameters"]["object"] == "twist" and answer["station_pga_m_s2"] is None
    assert first["scale"]["low"] < first["scale"]["median"] < first["scale"]["high"]
    assert len((tmp_path / "runs.csv").read_text(encoding="utf-8").splitlines()) == 201
    refused = CliRunner().invoke(main, ["infer", "--twist", "1", "--slid", "2cm", "--mu", "0.5"])
    assert refused.exit_code == 2 and "exactly one" in refused.output
    refused = CliRunner().invoke(main, ["infer", "--twist", "1", "--mu", "0.5"])
    assert refused.exit_code == 3 and "--width" in refused.output


@pytest.mark.parametrize(("observed", "error"), [(0.1, MIN_TWIST_ERROR_DEG), (20.0, 20.0 * TWIST_ERROR)])
def test_likelihood_of_a_twist_is_folded_normal(observed, error):
    """The error grows with the reading above its smallest value; a reading without its sense sums both."""
    for twist in (0.0, 0.3 * observed, observed, observed + 2.0 * error):
        density = foldnorm.pdf(observed, twist / error, scale=error)
        assert _likelihood(twist, observed) == pytest.approx(math.sqrt(2.0 * math.pi) * error * density, rel=1e-9)
