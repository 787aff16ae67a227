"""Floor motion by a linear oscillator, checked against scipy, closed forms and a building."""

import json
import math

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.linalg import eigh
from scipy.signal import StateSpace, lsim

import seisblock
from seisblock.cli import COMMANDS, main
from seisblock.core.errors import ParameterError
from seisblock.measures import response_spectrum
from seisblock.records import Component, Preparation, Record, motion_of, process
from seisblock.records.floor import RINGDOWN_RATIO, Storey, floor_motion, parse_storey
from seisblock.references import papers

RNG = np.random.default_rng(7)
SHAKING = Record(
    tuple(Component(code, np.concatenate((row := RNG.normal(0.0, 2.0, 800), 0.3 * row))) for code in ("NS", "EW", "UD")), 0.02, "SYN"
)


def absolute_by_scipy(ground, dt, omega, damping):
    """Return the absolute acceleration of an oscillator by scipy's linear systems, which join samples with straight lines, too."""
    system = StateSpace([[0, 1], [-(omega**2), -2 * damping * omega]], [[0], [-1]], [[-(omega**2), -2 * damping * omega]], [[0]])
    return lsim(system, ground, np.arange(ground.size) * dt, X0=[0, 0])[1]


@pytest.mark.parametrize("storey", [Storey(0.6), Storey(2.0, 0.02), Storey(0.5, 0.2, 1.0), Storey(1.1, 0.05, 0.3)])
def test_floor_motion_equals_scipy(storey):
    """At every sample, the free swing after the record included; the vertical component is that of the ground."""
    floor = floor_motion(SHAKING, storey)
    extra = floor.samples - SHAKING.samples
    for component in SHAKING.horizontals:
        ground = np.append(component.acceleration, np.zeros(extra))
        absolute = absolute_by_scipy(ground, SHAKING.dt, storey.omega, storey.damping)
        expected = ground + storey.share * (absolute - ground)
        np.testing.assert_allclose(floor.component(component.code).acceleration, expected, rtol=0, atol=1e-10 * np.abs(expected).max())
    up = floor.component("UD").acceleration
    np.testing.assert_array_equal(up, np.append(SHAKING.component("UD").acceleration, np.zeros(extra)))


def test_floor_motion_is_extended_until_it_decays():
    """The last swing is a thousandth of the peak, and no sooner: a quarter of the added samples less would cut off more."""
    storey = Storey(1.0, 0.03)
    floor = floor_motion(SHAKING, storey)
    for component in floor.horizontals:
        a = np.abs(component.acceleration)
        period = round(storey.period_s / floor.dt)
        assert a[-period:].max() < 1.4 * RINGDOWN_RATIO * a.max()
    extra = floor.samples - SHAKING.samples
    assert extra * floor.dt > 5.0
    later = [np.abs(c.acceleration[-extra // 4 - period :][:period]).max() / np.abs(c.acceleration).max() for c in floor.horizontals]
    assert max(later) > RINGDOWN_RATIO


def test_floor_motion_at_rest_is_not_extended():
    """A record that ends with a long silence keeps its samples."""
    pulse = np.zeros(6000)
    pulse[100:150] = 1.0
    assert floor_motion(Record((Component("NS", pulse),), 0.01), Storey(0.5)).samples == 6000


@pytest.mark.parametrize("damping", [0.02, 0.05, 0.3])
def test_floor_motion_at_resonance_has_closed_form(damping):
    """Steady shaking at the natural period: sqrt(1 + 4 zeta^2)/(2 zeta) times the ground, on the oscillator itself."""
    t = np.arange(round(40 / damping / 3)) * 0.01
    shaken = Record((Component("NS", np.sin(2 * np.pi * np.arange(0, t[-1] * 10 + 20, 0.005))),), 0.005)
    floor = floor_motion(shaken, Storey(1.0, damping)).component("NS").acceleration[: shaken.samples]
    assert np.abs(floor[-400:]).max() == pytest.approx(math.sqrt(1 + 4 * damping**2) / (2 * damping), rel=2e-4)


def test_peak_floor_motion_equals_spectral_acceleration():
    """Without a height the floor motion equals the response spectrum at its period and damping, within a thousandth."""
    for period, damping in ((0.6, 0.05), (1.5, 0.02)):
        floor = floor_motion(SHAKING, Storey(period, damping))
        for c in SHAKING.horizontals:
            expected = response_spectrum(c.acceleration, SHAKING.dt, [period], damping=damping).sa_m_s2[0]
            peak = np.abs(floor.component(c.code).acceleration).max()
            assert expected * (1 - 2e-3) <= peak <= expected * (1 + 1e-9)


def test_floor_motion_equals_first_mode_of_200_masses():
    """Even masses, and springs for which the first mode is a straight line, by scipy's eigenvectors: its share of the ground's motion."""
    count, omega, damping = 200, 2 * np.pi / 0.9, 0.05
    level = np.arange(1, count + 1)
    # each holds the masses above it in a mode that grows by one a storey
    springs = omega**2 * np.cumsum(level[::-1])[::-1].astype(float)
    stiffness = np.diag(springs + np.append(springs[1:], 0.0)) - np.diag(springs[1:], 1) - np.diag(springs[1:], -1)
    squares, shapes = eigh(stiffness, subset_by_index=[0, 0])
    assert math.sqrt(squares[0]) == pytest.approx(omega, rel=1e-9)
    mode = shapes[:, 0]
    selection = mode * mode.sum() / (mode @ mode)
    ground = SHAKING.component("NS").acceleration
    absolute = absolute_by_scipy(ground, SHAKING.dt, omega, damping)
    for height in (0.25, 0.8, 1.0):
        expected = ground + selection[round(height * count) - 1] * (absolute - ground)
        # a building of n storeys takes up 3 n/(2 n + 1), one whose mass is spread over its height 3/2
        spread = height * 2 * count / (2 * count + 1)
        result = floor_motion(SHAKING, Storey(0.9, damping, spread)).component("NS").acceleration[: ground.size]
        np.testing.assert_allclose(result, expected, rtol=0, atol=1e-8 * np.abs(expected).max())


def test_floor_at_two_thirds_height_is_the_oscillator():
    """There the mode has the participation one."""
    first, second = (floor_motion(SHAKING, Storey(0.7, height=h)).component("EW").acceleration for h in (None, 2 / 3))
    np.testing.assert_allclose(first, second, rtol=0, atol=1e-12 * np.abs(first).max())


def test_floor_motion_resamples_coarse_record():
    """Twenty to a period, on the straight lines of the ground: those at the record's own times are the exact ones."""
    storey = Storey(0.11, 0.04)
    floor = floor_motion(SHAKING, storey)
    assert floor.dt == pytest.approx(0.005) and storey.period_s / floor.dt >= 20
    ground = SHAKING.component("NS").acceleration
    expected = absolute_by_scipy(ground, SHAKING.dt, storey.omega, storey.damping)
    result = floor.component("NS").acceleration[::4][: ground.size]
    np.testing.assert_allclose(result, expected, rtol=0, atol=1e-10 * np.abs(expected).max())
    assert "4 sub-intervals per sample" in floor.history[-1]


def test_floor_motion_and_rotation_commute():
    """All directions swing alike, so that turning and swinging change places."""
    floor = floor_motion(SHAKING, Storey(0.6))
    along = motion_of(floor, "37").horizontal
    rotated = Record((process.component_at_azimuth(SHAKING, 37.0),), SHAKING.dt)
    before = floor_motion(rotated, Storey(0.6)).components[0].acceleration
    n = min(along.size, before.size)
    np.testing.assert_allclose(along[:n], before[:n], rtol=0, atol=1e-10 * np.abs(along).max())


def test_floor_motion_follows_scaling_and_precedes_crop():
    """A target PGA is the ground's; the window is cut out of a storey that swings already."""
    storey = Storey(0.6, height=0.9)
    prepared = Preparation(highpass_hz=0.2, target_pga=4.0, window=(5.0, 40.0), floor=storey).apply(SHAKING)
    by_hand = process.crop(floor_motion(process.scale_to_pga(process.highpass(SHAKING, 0.2), 4.0), storey), 5.0, 40.0)
    assert prepared.history == by_hand.history and len(prepared.history) == 4
    for first, second in zip(prepared.components, by_hand.components, strict=True):
        np.testing.assert_array_equal(first.acceleration, second.acceleration)
    assert abs(prepared.component("NS").acceleration[0]) > 0.05
    assert prepared.samples > process.crop(SHAKING, 5.0, None).samples


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "invalid floor '': expected the period T in s"),
        ("zeta=0.05", "invalid floor"),
        ("T=0.6,T=0.7", "invalid floor"),
        ("T=0.6,h=1", "invalid floor"),
        ("T=x", "invalid floor"),
        ("T=0", "the period of the building must be positive"),
        ("T=nan", "the period of the building must be positive"),
        ("T=1,zeta=0", r"the damping ratio of the building must lie in \(0, 1\), found 0"),
        ("T=1,height=1.2", r"the height ratio of the floor must lie in \(0, 1\], found 1.2"),
    ],
)
def test_floor_motion_rejects_invalid_floor(text, says):
    """One sentence, with an example."""
    with pytest.raises(ParameterError, match=says):
        parse_storey(text)


@pytest.mark.parametrize("storey", [Storey(5.0, 1e-9), Storey(1e-9)])
def test_floor_motion_rejects_too_many_samples(storey):
    """More samples than may be kept, after the record or between its own."""
    with pytest.raises(ParameterError, match=r"samples of floor motion need \d+ MiB, more than the limit of 1024 MiB"):
        floor_motion(SHAKING, storey)


def test_floor_option_exists_beside_highpass():
    """The option stands where the high-pass stands, and nowhere else."""
    options = {name: {opt for p in main.get_command(None, name).params for opt in p.opts} for name in COMMANDS}
    assert {name for name in COMMANDS if "--floor" in options[name]} == {name for name in COMMANDS if "--highpass" in options[name]}


def test_command_line_reports_floor_motion():
    """The history of the document and the first lines name the floor; numbers equal those of the library."""
    result = CliRunner().invoke(main, ["measure", "elcentro_1940_ns.csv", "--floor", "T=0.6,zeta=0.03,height=0.8", "--json"])
    output = json.loads(result.stdout)
    floor = Preparation(floor=Storey(0.6, 0.03, 0.8)).apply(seisblock.read("elcentro_1940_ns.csv"))
    assert output["record"]["history"] == list(floor.history)
    assert output["record"]["history"][-1].startswith("floor motion T 0.6 s, damping 0.03, height ratio 0.8 (absolute acceleration")
    assert output["results"][0]["pga_m_s2"] == np.abs(floor.horizontals[0].acceleration).max()
    assert "floor motion T 0.6 s" in result.stderr
    assert set(papers("storey")) <= set(output["citations"])


@pytest.mark.parametrize(
    "words",
    [
        ("respond", "elcentro_1940_ns.csv", "--block", "gravestone"),
        (
            "fragility",
            "elcentro_1940_ns.csv",
            "synthetic_jma.csv",
            "--block",
            "gravestone",
            "--solver",
            "rock",
            "--steps",
            "12",
            "--bootstrap",
            "2",
            "--no-vertical",
        ),
        ("batch", "elcentro_1940_ns.csv", "--bodies", "gravestone", "--solver", "rock", "--out", "out.csv"),
    ],
    ids=lambda words: words[0],
)
def test_floor_motion_results_cite_its_papers(words, tmp_path, monkeypatch):
    """Results on a floor cite the papers of floor motion; results on the ground do not."""
    monkeypatch.chdir(tmp_path)
    for extra, second in (((), False), (("--floor", "T=0.6"), True)):
        cited = json.loads(CliRunner().invoke(main, [*words, "--json", "--quiet", *extra]).stdout)["citations"]
        assert ("Chopra2012" in cited) is second
        (tmp_path / "out.csv").unlink(missing_ok=True)
