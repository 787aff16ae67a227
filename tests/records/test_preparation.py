"""One frozen list of steps does to a record what the command line's options do (P6)."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

import seisblock
from seisblock.cli import main
from seisblock.core.errors import ComponentError, ParameterError, RecordError
from seisblock.records import Component, Preparation, Record, process

RNG = np.random.default_rng(3)
RECORD = Record(tuple(Component(code, RNG.normal(0.3, 1.0, 2000)) for code in ("NS", "EW", "UD")), 0.01)


def same(first, second):
    """Assert that two records hold the same samples and tell the same story."""
    assert first.codes == second.codes and first.history == second.history and first.offset_s == second.offset_s
    for a, b in zip(first.components, second.components, strict=True):
        np.testing.assert_array_equal(a.acceleration, b.acceleration)


def test_preparation_steps_run_in_documented_order():
    """Mean, high-pass, factor, target, window: as if each verb were called by itself."""
    prepared = Preparation(True, 0.2, 1.5, 4.0, ("NS", "37"), (5.0, 15.0)).apply(RECORD)
    by_hand = process.scale(process.highpass(process.demean(RECORD), 0.2), 1.5)
    same(prepared, process.crop(process.scale_to_pga(by_hand, 4.0, ("NS", "37")), 5.0, 15.0))
    assert max(np.abs(process.select_component(prepared, name).acceleration).max() for name in ("NS", "37")) <= 4.0
    assert len(prepared.history) == 5


def test_empty_preparation_changes_nothing():
    """Numbers round-trip; the record itself stays as it is in any case."""
    before = RECORD.component("EW").acceleration.copy()
    assert Preparation().apply(RECORD) is RECORD
    Preparation(demean=True, scale=2.0).apply(RECORD)
    np.testing.assert_array_equal(RECORD.component("EW").acceleration, before)


@pytest.mark.parametrize(
    ("settings", "carries", "removed"), [(None, True, True), (None, False, False), (False, True, False), (True, False, True)]
)
def test_preparation_removes_mean_of_count_offset(settings, carries, removed):
    """Unless it is asked for, or refused."""
    record = Record(RECORD.components, RECORD.dt, metadata={"carries_offset": carries})
    mean = Preparation(demean=settings).apply(record).component("NS").acceleration.mean()
    assert bool(abs(mean) < 1e-12) is removed


def test_preparation_is_a_value_and_scales_largest_horizontal():
    """It is a value: equal to its twin, hashable, and the same for all records."""
    preparation = Preparation(target_pga=3.0, window=(None, 10.0))
    assert preparation == Preparation(target_pga=3.0, window=(None, 10.0)) and len({preparation, Preparation()}) == 2
    for size in (1.0, 7.0):
        record = process.scale(RECORD, size)
        prepared = preparation.apply(record)
        full = process.scale_to_pga(record, 3.0)
        assert max(np.abs(c.acceleration).max() for c in full.horizontals) == pytest.approx(3.0, rel=1e-15)
        same(prepared, process.crop(full, None, 10.0))


@pytest.mark.parametrize(
    ("settings", "error", "says"),
    [
        ({"scale": float("nan")}, ParameterError, "the scale factor must be a finite number"),
        ({"highpass_hz": 0.0}, ParameterError, "the high-pass corner must be positive"),
        ({"target_pga": -1.0}, ParameterError, "the target PGA must be positive, found -1 m/s"),
        ({"target_pga": 1.0, "components": "XX"}, ComponentError, "no component 'XX'"),
        ({"window": (30.0, 40.0)}, RecordError, "outside the record"),
        ({"highpass_hz": 80.0}, ParameterError, "half the sampling rate"),
    ],
)
def test_preparation_rejects_invalid_steps(settings, error, says):
    """Numbers when it is made, the rest when a record goes through."""
    with pytest.raises(error, match=says):
        Preparation(**settings).apply(RECORD)


def test_command_line_equals_preparation():
    """Options of the command line and one call of the library prepare the same record."""
    options = ["--demean", "--highpass", "0.2", "--target-pga", "500", "--component", "EW", "--window", "20:40"]
    entry = json.loads(CliRunner().invoke(main, ["measure", "synthetic_knet.EW", *options, "--json", "--quiet"]).stdout)["results"][0]
    preparation = Preparation(demean=True, highpass_hz=0.2, target_pga=5.0, components=("EW",), window=(20.0, 40.0))
    result = seisblock.measure(preparation.apply(seisblock.read("synthetic_knet.EW")), ["EW"]).components[0]
    assert entry["pga_m_s2"] == result.pga_m_s2 and entry["pgv_m_s"] == result.pgv_m_s


def test_scale_factor_has_four_digits_in_text_and_ten_in_documents():
    """2.012 for a reader; the document keeps what reproduces the motion."""
    line = ["measure", "hanmer_springs_2016", "--component", "280", "--target-pga", "520"]
    answer = CliRunner().invoke(main, line)
    assert "scaled by 2.012: PGA of 280" in answer.stdout and "HSES: scaled by 2.012: PGA" in answer.stderr
    history = json.loads(CliRunner().invoke(main, [*line, "--json"]).stdout)["record"]["history"]
    assert history == ["scaled by 2.012072435: PGA of 280 258.44 -> 520 gal"]
