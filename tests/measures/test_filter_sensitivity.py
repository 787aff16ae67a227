"""Change of PGV and f with the usual filters is reported where it is relevant."""

import json
import math

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.measures import filter_range, ground_history, measure, peak_velocity
from seisblock.readers import read
from seisblock.records import Component, Record
from seisblock.records.filters import causal_highpass_samples, highpass_samples
from seisblock.records.process import crop

DT = 0.01


def pgv(wave, **options):
    return peak_velocity(ground_history(wave, DT, **options), DT)


def burst(f0, cycles=8.0, length=200.0):
    """Return a Gaussian burst of f0 Hz in the middle of a record."""
    t = np.arange(0, length, DT) - length / 2
    return 3.0 * np.cos(2 * math.pi * f0 * t) * np.exp(-((t * f0 / cycles) ** 2))


def test_short_period_motion_is_insensitive_to_filter():
    """A burst of 2 Hz is far from every corner: nothing to tell."""
    wave = burst(2.0)
    assert filter_range(wave, DT, np.abs(wave).max(), pgv(wave)) is None


def test_long_period_motion_is_sensitive_to_filter():
    """A burst of 0.1 Hz keeps half its velocity at 0.1 Hz without delay and 0.71 forwards only; f moves the other way."""
    wave = burst(0.1, cycles=3.0, length=400.0)
    result = filter_range(wave, DT, np.abs(wave).max(), pgv(wave))
    rows = [f(wave, DT, hz) for f in (highpass_samples, causal_highpass_samples) for hz in (0.05, 0.1)]
    expected = sorted(pgv(row, highpass_hz=None) for row in rows)
    assert result.pgv_m_s == pytest.approx((expected[0], expected[-1]), rel=1e-12)
    assert expected[0] / expected[-1] == pytest.approx(0.5, abs=0.06)
    top = np.abs(wave).max()
    assert result.pga_pgv_hz == pytest.approx((top / (2 * math.pi * expected[-1]), top / (2 * math.pi * expected[0])), rel=1e-12)


def test_filter_sensitivity_of_zero_motion_is_none():
    """Zero, and a constant that is all offset, have no PGV, no frequency and no range."""
    assert filter_range(np.zeros(1000), DT, 0.0, 0.0) is None
    still = measure(Record((Component("NS", np.full(6000, 0.5)),), DT))
    assert [(m.pgv_m_s, m.equivalent_frequency_hz.pga_pgv, m.usual_highpass) for m in still.components] == [(0.0, None, None)]


def test_measure_reports_filter_sensitivity(monkeypatch):
    """EW of the sample: 183 to 237 kine, 0.65 to 0.84 Hz, in the table and in the document with units in the keys."""
    monkeypatch.setenv("COLUMNS", "200")
    assert (
        "EW: PGV 183-237 kine, f 0.648-0.836 Hz for the usual high-pass filters"
        in CliRunner().invoke(main, ["measure", "synthetic_jma"]).stdout
    )
    output = json.loads(CliRunner().invoke(main, ["measure", "synthetic_jma", "--json", "--component", "EW"]).stdout)["results"][0][
        "usual_highpass"
    ]
    assert output["highpass_hz"] == [0.05, 0.1]
    assert output["pgv_m_s"] == pytest.approx([1.83, 2.37], abs=0.01)
    assert output["pga_pgv_hz"] == pytest.approx([0.648, 0.836], abs=0.001)


def test_overturn_rate_reports_filter_sensitivity(monkeypatch):
    """El Centro: a third of Aoyama's stones with one filter, a fifth with another; a frequency that is given does not move.

    Runs of the record itself, the default, use neither PGV nor frequency.
    """
    monkeypatch.setenv("COLUMNS", "200")
    simulated = ["overturn-rate", "--cemetery", "aoyama.csv", "elcentro_1940_ns.csv"]
    words = [*simulated, "--criterion", "furukawa"]
    assert "zero-phase or causal); rate 0.21 to 0.32" in CliRunner().invoke(main, words).stdout
    result = json.loads(CliRunner().invoke(main, [*words, "--json"]).stdout)["results"][0]
    assert result["rate_range"] == [0.21, 0.32]
    assert result["usual_highpass"]["pga_pgv_hz"] == pytest.approx([1.42, 1.68], abs=0.01)
    entry = json.loads(CliRunner().invoke(main, [*words, "--frequency", "1.5", "--json"]).stdout)["results"][0]
    assert (entry["usual_highpass"], entry["rate_range"]) == (None, None)
    runs = json.loads(CliRunner().invoke(main, [*simulated, "--json"]).stdout)["results"][0]
    assert (runs["usual_highpass"], runs["rate_range"]) == (None, None)


def test_record_shorter_than_corner_period_warns():
    """A record of five seconds cannot hold a corner period of twenty: the warning states the basis of the PGV."""
    record = read("elcentro_1940_ns.csv")
    assert any("shorter than the corner period" in text for text in measure(crop(record, 1.0, 6.0)).warnings)
    assert not any("shorter than the corner period" in text for text in measure(record).warnings)
