"""Warnings of values in another unit reach callers outside the package, as the command line rejects or flags them."""

import subprocess
import sys
import warnings
from dataclasses import replace

import numpy as np
import pytest

import seisblock as sb
from seisblock.core.units import MAX_UNITLESS_LENGTH

SINE = np.sin(0.1 * np.arange(400))
STRONG = sb.Record((sb.records.Component("NS", 400.0 * SINE), sb.records.Component("UD", SINE)), 0.01)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: sb.Block(width=45, height=180), r"block: width = 45 m, height = 180 m \(above 20 m\); lengths are in m, 45 cm = 0.45 m"),
        (lambda: sb.Block(0.45, 1.8, depth=45, name="shelf"), r"shelf: depth = 45 m \(above 20 m\)"),
        (lambda: sb.TwoLayerBlock(24, 24, 30, 10, 50.0, 20.0), r"width = 24 m, depth = 24 m, upper_height = 30 m \(above 20 m\)"),
        (lambda: sb.SpringBlock.from_frequency(60, 60, 180, frequency_vertical=10.0, beta=0.7), r"width = 60 m, depth = 60 m"),
        (lambda: sb.SpringBlock(60, 60, 180, 100.0, (1e5, 1e5, 1e5)), r"width = 60 m, depth = 60 m, height = 180 m \(above 20 m\)"),
        (lambda: sb.PileStone("sao", 0.3, 0.3, 80), r"sao: height = 80 m \(above 20 m\)"),
        (lambda: sb.Motion.from_arrays(400.0 * SINE, 0.01), r"peak acceleration 400 m/s\^2 exceeds 5 g; check the unit"),
        (lambda: sb.Motion.from_arrays(SINE, 0.01, vertical=-60.0 * SINE), r"peak acceleration 60 m/s\^2"),
        (lambda: sb.Motion.from_arrays(SINE, 100), r"sampling interval 100 s exceeds 0.1 s; check the unit"),
        (lambda: sb.motion_of(STRONG, "NS"), r"peak acceleration 400 m/s\^2"),
        (lambda: sb.motion_of(sb.records.scale(STRONG, 0.5), "NS"), r"peak acceleration 200 m/s\^2"),
        (lambda: sb.motion_of(sb.Record((sb.records.Component("NS", SINE),), 10.0), "NS"), r"sampling interval 10 s"),
    ],
)
def test_suspicious_unit_warns_at_callers_line(call, says):
    """One warning of one sentence at the line of the caller; the result is still returned."""
    with pytest.warns(UserWarning, match=says) as text:
        assert call() is not None
    assert [entry.filename for entry in text] == [__file__]


def call_without_warnings(call):
    """Return what a call gives, which may not warn."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return call()


def test_common_values_do_not_warn():
    """Values up to 20 m, 5 g and 0.1 s give no warning."""
    call_without_warnings(lambda: sb.Block(MAX_UNITLESS_LENGTH, MAX_UNITLESS_LENGTH))
    call_without_warnings(lambda: sb.Motion.from_arrays(50.0 * SINE / SINE.max(), 0.1))
    call_without_warnings(lambda: sb.motion_of(sb.read("synthetic_jma.csv"), "EW"))


def test_internal_calls_do_not_warn(tmp_path):
    """Derived sizes, samples, scaled motions and records with that flag give no warning."""
    house = call_without_warnings(lambda: sb.bodies.from_slenderness(0.3, 0.4))
    assert house.height > MAX_UNITLESS_LENGTH
    motion = call_without_warnings(lambda: sb.motion_of(sb.records.crop(sb.read("synthetic_jma.csv"), 24.0, 26.0), "EW"))
    call_without_warnings(lambda: sb.uncertainty.perturb(house, motion, 2))
    call_without_warnings(lambda: replace(house, mass=1e6).with_wear(0.1))
    call_without_warnings(lambda: sb.studies.mode_map([0.3], [100.0], [0.2], motion))
    path = tmp_path / "gal.csv"
    path.write_text("time,NS (m/s2)\n" + "".join(f"{0.01 * i:.2f},{400.0 * a:.6f}\n" for i, a in enumerate(SINE)))
    record = sb.read(path)
    assert [doubt.kind for doubt in record.doubts] == ["size"]
    call_without_warnings(lambda: sb.motion_of(record, "NS"))


def test_command_line_warns_once(tmp_path):
    """A record of 40 g gives one warning; sizes with units give none."""
    path = tmp_path / "gal.csv"
    path.write_text("time,NS (m/s2)\n" + "".join(f"{0.01 * i:.2f},{400.0 * a:.6f}\n" for i, a in enumerate(SINE)))
    command = [sys.executable, "-m", "seisblock", "rock", str(path), "--width", "45m", "--height", "180m"]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    assert ran.stderr.count("exceeds 5 g") == 1
    assert "UserWarning" not in ran.stderr


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: sb.Motion.from_arrays(np.zeros((3, 100)), 0.01), r"the horizontal acceleration must have shape \(n,\), found \(3, 100\)"),
        (lambda: sb.Motion.from_arrays(np.zeros((100, 1)), 0.01), r"must have shape \(n,\), found \(100, 1\): give one component"),
        (lambda: sb.Motion.from_arrays(3.0, 0.01), r"found \(\)"),
        (lambda: sb.Motion.from_arrays(SINE, 0.01, vertical=np.zeros((1, 400))), r"the vertical acceleration must have shape \(n,\)"),
        (lambda: sb.measures.response_spectrum(np.zeros((3, 100)), 0.01), r"the accelerations must have shape \(n,\), found \(3, 100\)"),
        (lambda: sb.measures.response_spectrum([], 0.01), "a motion needs at least 2 samples, found 0"),
    ],
)
def test_wrong_array_shape_is_rejected_with_both_shapes(call, says):
    """The shape expected and the one found, in a sentence of ours."""
    with pytest.raises(sb.errors.ParameterError, match=says):
        call()
