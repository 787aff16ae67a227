"""The posterior sample of a fit: few runs, the same posterior."""

import numpy as np
import pytest

import seisblock.studies.fit.simulate as simulate
from seisblock.studies import fit_block
from seisblock.studies.fit.block_family import BlockFamily
from seisblock.studies.fit.dataset import make_experiment
from seisblock.studies.fit.likelihood import log_likelihood, make_lapse_rate
from seisblock.studies.fit.posterior_summary import quantiles
from seisblock.studies.fit.priors import make_priors
from seisblock.studies.fit.simulate import outcome_shares
from tests.studies.fit.conftest import KNOWN, TRUTH

BOUNDS = {"alpha": (0.22, 0.29)}
PLACES = 75


def test_fit_equals_posterior_on_fine_grid(experiment):
    """Slenderness from weights of 75 values with 64 samples each under every pulse: the same median and interval."""
    family = BlockFamily(make_priors(["alpha"], BOUNDS, scatter=0.05, block=TRUTH), TRUTH, None, 0.0, 0.05, None, 9.80665)
    places = (np.arange(PLACES)[:, None] + 0.5) / PLACES
    data, lapse = make_experiment(experiment), make_lapse_rate(0.02)
    shares = outcome_shares(data, family, places, np.full(len(data.shakings), 64), (1,))
    logs = log_likelihood(shares, *data.outcome_counts(), lapse)[0]
    low, middle, high = quantiles(family.values(places)["alpha"], np.exp(logs - logs.max()), np.array([0.05, 0.5, 0.95]))
    fits = [fit_block(experiment, free=["alpha"], bounds=BOUNDS, **{**KNOWN, "runs": 8}, seed=seed)["alpha"] for seed in range(4)]
    assert np.mean([fit.median for fit in fits]) == pytest.approx(middle, abs=0.06 * (high - low))
    assert np.mean([fit.interval for fit in fits], axis=0) == pytest.approx((low, high), abs=0.06 * (high - low))


def test_fit_spends_runs_where_blocks_disagree(experiment, monkeypatch):
    """Two parameters from forty outcomes in at most 220 000 runs (427 000 without copies of likely blocks)."""
    counts = []
    solve = simulate.rock_verdicts

    def counted(params, motion, gains, **options):
        counts.append(len(gains))
        return solve(params, motion, gains, **options)

    monkeypatch.setattr(simulate, "rock_verdicts", counted)
    fit = fit_block(experiment, free=["alpha", "p"])
    assert fit.effective_blocks >= 200
    assert sum(counts) < 220_000
