"""Analytic motions: closed forms of peaks, velocity, displacement and time above a threshold; names as records; errors in a sentence."""

import json
import math

import numpy as np
import pytest
from click.testing import CliRunner

import seisblock
from seisblock.cli import main
from seisblock.core.errors import ParameterError, SeisblockError
from seisblock.measures import measure
from seisblock.measures.shaking import shaking_of
from seisblock.readers import read, read_all
from seisblock.records import motion_of
from seisblock.records.analytic import half_sine_motion, pulse_motion, rectangle_motion, sine_motion
from seisblock.studies.batch.run import run_batch
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.scenario.motions import _peaks


@pytest.mark.parametrize("frequency,duration", ((1.5, 10.0), (0.318, 20.0), (0.05, 33.0), (7.3, 1.234)))
def test_sine_has_closed_form_peaks(frequency, duration):
    """PGV = A/w and PGD = A/w^2 for any duration, so that the equivalent frequency is that of the sine."""
    record = sine_motion(3.0, frequency, duration)
    (result,) = measure(record).components
    omega = 2.0 * math.pi * frequency
    assert result.pga_m_s2 == pytest.approx(3.0, rel=1e-12)
    assert result.pgv_m_s == pytest.approx(3.0 / omega, rel=5e-5)
    assert result.pgd_m == pytest.approx(3.0 / omega**2, rel=5e-5)
    assert result.equivalent_frequency_hz.pga_pgv == pytest.approx(frequency, rel=5e-5)
    assert record.duration_s == pytest.approx(duration, abs=record.dt)
    assert record.dt <= min(1.0 / (400.0 * frequency), 0.01) * (1.0 + 1e-12)
    np.testing.assert_allclose(record.components[0].acceleration, 3.0 * np.sin(omega * record.time), atol=1e-9)


@pytest.mark.parametrize("make,periods", ((pulse_motion, 1.0), (half_sine_motion, 0.5)))
def test_pulses_have_closed_form_peaks(make, periods):
    record = make(3.0, 1.5)
    (result,) = measure(record).components
    assert record.duration_s == pytest.approx(periods / 1.5, rel=1e-12)
    assert (result.pga_m_s2, result.pgv_m_s) == pytest.approx((3.0, 3.0 / (3.0 * math.pi)), rel=5e-5)


def test_rectangle_is_constant_with_half_of_its_velocity_change_as_pgv():
    record = rectangle_motion(3.0, 0.5)
    (result,) = measure(record).components
    assert (result.pga_m_s2, result.pgv_m_s) == pytest.approx((3.0, 0.75), rel=1e-9)
    assert set(record.components[0].acceleration.tolist()) == {3.0}
    assert record.duration_s == pytest.approx(0.5, rel=1e-12)


@pytest.mark.parametrize("share", (0.2, 0.654, 0.95))
def test_time_of_sine_above_threshold(share):
    """(2/pi) acos(s) of the duration, less what the chords between 400 samples per period cut off (derived here)."""
    motion = motion_of(sine_motion(3.0, 1.5, 10.0), "X")
    shaking = shaking_of(motion, (3.0 * share, 3.0 * share))
    chord = share * (2.0 * math.pi / 400) ** 2 / 8.0 / (math.sqrt(1.0 - share**2) * math.acos(share))
    assert shaking.time_above_threshold_s == pytest.approx(10.0 * 2.0 / math.pi * math.acos(share), rel=chord)
    one_sided = shaking_of(motion, (math.inf, 3.0 * share))
    assert one_sided.time_above_threshold_s == pytest.approx(0.5 * shaking.time_above_threshold_s, rel=1e-9)


@pytest.mark.parametrize(
    "name,make",
    (
        ("sine:300gal@1.5Hz,10s", lambda: sine_motion(3.0, 1.5, 10.0)),
        ("SINE: 3 m/s2 @ 1.5 Hz, 10 s", lambda: sine_motion(3.0, 1.5, 10.0)),
        ("sine:60cm@0.318Hz,20s", lambda: sine_motion(0.6 * (2.0 * math.pi * 0.318) ** 2, 0.318, 20.0)),
        ("sine:30kine@2Hz,1s", lambda: sine_motion(0.3 * 4.0 * math.pi, 2.0, 1.0)),
        ("pulse:300gal@1.5Hz", lambda: pulse_motion(3.0, 1.5)),
        ("halfsine:0.3g@1.5Hz,dt=0.001", lambda: half_sine_motion(0.3 * 9.80665, 1.5, dt=0.001)),
        ("rectangle:300gal@0.5s,dt=1ms", lambda: rectangle_motion(3.0, 0.5, dt=0.001)),
    ),
)
def test_name_stands_for_the_function(name, make):
    record, expected = read(name), make()
    assert (record.format, record.source, record.dt) == ("analytic", name, pytest.approx(expected.dt))
    np.testing.assert_allclose(record.components[0].acceleration, expected.components[0].acceleration, rtol=1e-12, atol=1e-12)


def test_names_stand_among_files_in_their_order():
    records = read_all(["pulse:1m/s2@1Hz", "synthetic_jma.csv", "sine:100gal@1Hz,2s"])
    assert [record.format for record in records] == ["analytic", "JMA-CSV", "analytic"]


@pytest.mark.parametrize(
    "name,words",
    (
        ("sine:300@1.5Hz,10s", "'300' has no unit"),
        ("sine:300gal@1.5,10s", "'1.5' has no unit"),
        ("sine:300gal@1.5Hz", "incomplete analytic motion 'sine:300gal@1.5Hz': write, for example, sine:300gal@1.5Hz,10s"),
        ("pulse:300gal", "incomplete analytic motion"),
        ("sine:-3gal@1Hz,3s", "must be positive"),
        ("sine:3gal@-1Hz,3s", "must be positive"),
        ("sine:3gal@1Hz,0s", "must be positive"),
        ("sine:3gal@1000000Hz,1000000s", "exceed the limit"),
        ("sine:3gal@1Hz,3s,dt=0.2", "too long for an analytic motion"),
        ("sine:3gal@1Hz,3s,step=0.2", "the only key is dt="),
        ("rectangle:3cm@1s", "unknown unit"),
    ),
)
def test_errors_are_one_sentence(name, words):
    with pytest.raises(SeisblockError) as caught:
        read(name)
    assert words in str(caught.value)
    assert isinstance(caught.value, ParameterError) or "unit" in words
    result = CliRunner().invoke(main, ["slide", "--mu", "0.2", name])
    assert result.exit_code == 3
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize(
    "line",
    (
        "measure sine:300gal@1.5Hz,10s",
        "slide sine:60cm@0.318Hz,20s --mu 0.2",
        "rock pulse:300gal@1.5Hz --width 24cm --height 1m",
        "respond halfsine:300gal@1.5Hz --width 24cm --height 1m --mu 0.5 --runs 0",
        "jump rectangle:600gal@0.5s",
        "criteria pulse:300gal@1.5Hz --width 24cm --height 1m",
        "uplift sine:300gal@1.5Hz,2s --width 1.2 --height 3 --frequency-vertical 8",
    ),
)
def test_commands_take_analytic_motions(line):
    result = CliRunner().invoke(main, [*line.split(), "--json"])
    assert result.exit_code == 0, result.stderr
    document = json.loads(result.stdout)
    assert document["record"]["format"] == "analytic"
    table = CliRunner().invoke(main, line.split())
    assert "analytic motion" in table.stdout


@pytest.mark.parametrize(
    ("words", "option"), [("--units g", "--units"), ("--dt 0.01", "--dt"), ("--format KNET", "--format"), ("--station A", "--station")]
)
def test_reading_options_beside_an_analytic_motion_are_refused(words, option):
    """Its name has unit and interval: an option of reading would be ignored; a component that it does not have is an error, too."""
    refused = CliRunner().invoke(main, ["slide", "sine:300gal@1.5Hz,2s", "--mu", "0.2", *words.split()])
    assert (refused.exit_code, option in refused.stderr.splitlines()[-1]) == (3, True)
    with pytest.raises(ParameterError):
        read_all(["synthetic_jma.csv", "sine:300gal@1.5Hz,2s"], units="gal")
    assert CliRunner().invoke(main, ["slide", "sine:300gal@1.5Hz,2s", "--mu", "0.2", "--component", "NS"]).exit_code == 3


def test_displacement_amplitude_returns_as_displacement():
    document = json.loads(CliRunner().invoke(main, ["measure", "sine:60cm@0.318Hz,20s", "--json"]).stdout)
    assert document["results"][0]["pgd_m"] == pytest.approx(0.6, rel=5e-5)
    assert document["parameters"]["velocity_highpass_hz"] is None


def test_scaled_analytic_motion_keeps_its_frequency():
    line = "slide sine:300gal@1.5Hz,10s --mu 0.2 --target-pga 600 --json"
    (result,) = json.loads(CliRunner().invoke(main, line.split()).stdout)["results"]
    assert result["shaking"]["pga_m_s2"] == pytest.approx(6.0)
    assert result["shaking"]["equivalent_frequency_hz"] == pytest.approx(1.5, rel=5e-5)


def test_studies_measure_analytic_motions_without_a_filter():
    """Intensity measure PGV and the peaks of a scenario are A/(2 pi f) of a pulse, not that of a high-passed one."""
    record = read("pulse:400gal@1.0Hz")
    exact = pytest.approx(4.0 / (2.0 * math.pi), rel=5e-5)
    assert intensity_measure("pgv").of(motion_of(record, "X")) == exact
    assert _peaks(record) == (pytest.approx(4.0), exact)


def test_map_refuses_analytic_motions():
    """A motion without a place belongs to no station."""
    refused = CliRunner().invoke(main, ["map", "pulse:400gal@1.0Hz"])
    assert (refused.exit_code, "analytic motion without a place" in refused.stderr) == (3, True)


def test_batch_takes_analytic_motions():
    table = run_batch(["sine:3m/s2@1.5Hz,2s", "pulse:300gal@1Hz"], {"box": 0.2}, "slide")
    assert table["pgv_m_s"] == pytest.approx([1.0 / math.pi, 1.5 / math.pi], rel=5e-5)
    assert table["threshold_m_s2"] == pytest.approx([0.2 * 9.80665] * 2)
    assert table["failure"] == [None, None]


def test_public_functions():
    assert seisblock.sine_motion is sine_motion
    assert seisblock.half_sine_motion(1.0, 1.0).samples == 201
