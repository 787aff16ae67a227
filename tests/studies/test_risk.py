"""Annual frequency at a site: against quadrature, the closed form and usual tables."""

import dataclasses
import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.stats import norm

from seisblock.core.errors import HazardError, ParameterError, UnitError
from seisblock.fragility import Hazard, HazardCurve, find_risk, read_hazard
from seisblock.samples import sample_path
from seisblock.studies.fragility.io import check_measure, fragility_from_median, read_fragility
from seisblock.studies.fragility.lognormal import Lognormal
from tests import make_hazard

LEVELS = np.geomspace(0.05, 3.0, 9)
BENT = HazardCurve(LEVELS, 0.02 * (LEVELS / 0.05) ** -1.1 * np.exp(-LEVELS / 0.6))


def site(*curves):
    """Return a hazard in PGV."""
    return Hazard("pgv", "m/s", curves or (BENT,))


def quadrature(fragility, curve, low, high):
    """Return the integral of the fragility over the hazard between two intensities, with a slope taken from two rates beside each other."""

    def integrand(u):
        step = 1e-6
        fall = (float(curve.rate(math.exp(u - step))) - float(curve.rate(math.exp(u + step)))) / (2 * step)
        return norm.cdf((u - math.log(fragility.median)) / fragility.beta) * fall

    return quad(integrand, math.log(low), math.log(high), epsabs=0.0, epsrel=1e-9, limit=200)[0]


@given(
    median=st.floats(0.01, 20.0),
    beta=st.floats(0.05, 1.2),
    power=st.floats(0.3, 6.0),
    rate=st.floats(1e-6, 10.0),
)
def test_rate_of_power_law_has_closed_form(median, beta, power, rate):
    """rate(median) exp(k² beta²/2), wherever the levels of the table lie."""
    levels = np.array([0.03, 0.1, 0.11, 1.0, 4.0])
    risk = find_risk(Lognormal(median, beta), site(HazardCurve(levels, rate * levels**-power)))
    assert risk.annual_rate == pytest.approx(rate * median**-power * math.exp(0.5 * (power * beta) ** 2), rel=1e-9)


def test_contributions_equal_quadrature():
    """Between two levels what quadrature finds there; the shares have the sum one, and the chance in 50 years follows."""
    fragility = Lognormal(0.6, 0.45)
    risk = find_risk(fragility, site())
    for level in risk.disaggregation[1:-1]:
        assert level.annual_rate == pytest.approx(quadrature(fragility, BENT, level.im_from, level.im_to), rel=1e-6)
    assert risk.disaggregation[0].annual_rate == pytest.approx(quadrature(fragility, BENT, 1e-4, LEVELS[0]), rel=1e-6)
    assert risk.disaggregation[-1].annual_rate == pytest.approx(quadrature(fragility, BENT, LEVELS[-1], 1e4), rel=1e-6)
    assert sum(item.share for item in risk.disaggregation) == pytest.approx(1.0)
    assert risk.return_period_years == pytest.approx(1.0 / risk.annual_rate)
    assert risk.probability.value == pytest.approx(1.0 - (1.0 - risk.annual_rate / 1e4) ** (50.0 * 1e4), rel=1e-4)


def test_rate_of_step_fragility_is_hazard_at_median():
    """With beta to zero it happens whenever the median is exceeded."""
    assert find_risk(Lognormal(0.7, 1e-4), site()).annual_rate == pytest.approx(float(BENT.rate(0.7)), rel=1e-5)


def test_rate_far_above_table_is_finite_and_positive():
    """A fragility 40 standard deviations above the table neither overflows nor turns negative."""
    risk = find_risk(Lognormal(1e4, 0.1), site())
    assert 0.0 < risk.annual_rate < 1e-20 and risk.beyond_levels_share > 0.999
    assert all(level.annual_rate >= 0.0 for level in risk.disaggregation)
    assert "far from all levels" in risk.notes[0]


def test_branches_are_reweighted_by_survival():
    """The mean of the branches; P(standing) = exp(-T rate) weighs them anew (Bayes)."""
    half = dataclasses.replace(BENT, rates=np.asarray(BENT.rates) / 2, name="half", weight=0.3)
    full = dataclasses.replace(BENT, name="whole", weight=0.7)
    single = find_risk(Lognormal(0.4, 0.3), site()).annual_rate
    risk = find_risk(Lognormal(0.4, 0.3), site(full, half), stood_years=2000.0)
    assert risk.annual_rate == pytest.approx(0.85 * single)
    likelihood = np.exp(-2000.0 * single * np.array([1.0, 0.5]))
    after = likelihood * [0.7, 0.3] / (likelihood @ [0.7, 0.3])
    assert [branch.standing for branch in risk.branches] == pytest.approx(likelihood)
    assert [branch.weight_after for branch in risk.branches] == pytest.approx(after)
    assert risk.annual_rate_after == pytest.approx(after @ [single, single / 2])


def test_branches_with_different_levels_are_merged():
    """Stretches of the union of the levels; the sum is that of each alone."""
    second = HazardCurve([0.02, 0.9, 5.0], [0.1, 1e-3, 1e-6], "other", 0.5)
    result = find_risk(Lognormal(0.5, 0.5), site(dataclasses.replace(BENT, weight=0.5), second))
    risk = [find_risk(Lognormal(0.5, 0.5), site(dataclasses.replace(curve, weight=1.0))).annual_rate for curve in (BENT, second)]
    assert result.annual_rate == pytest.approx(np.mean(risk), rel=1e-12)
    assert len(result.disaggregation) == np.union1d(LEVELS, second.levels).size + 1


TABLES = {
    "pgv_m_s,annual_rate\n0.2,0.01\n0.6,0.001\n": ("pgv", [0.2, 0.6], [0.01, 0.001]),
    "PGV (cm/s);Rate\n60;0.001\n20;0.01\n": ("pgv", [0.2, 0.6], [0.01, 0.001]),
    "pga_g,annual_poe\n0.1,0.5\n0.4,0.01\n": ("pga", [0.980665, 3.92266], [math.log(2.0), -math.log(0.99)]),
    "SA(0.5 s) [gal],POE_in_50_years\n100,0.5\n400,0.1\n800,0\n": ("sa=0.5", [1.0, 4.0], [math.log(2.0) / 50, -math.log(0.9) / 50]),
    "sa_0.5_m_s2,年超過頻度\n1,0.5\n4,0.1\n": ("sa=0.5", [1.0, 4.0], [0.5, 0.1]),
    "pgv_kine,30年超過確率\n20,1\n40,0.5\n60,0.25\n": ("pgv", [0.4, 0.6], [math.log(2.0) / 30, math.log(4 / 3) / 30]),
    "p*pgv,rate\n0.2,0.01\n0.6,0.001\n": ("p*pgv", [0.2, 0.6], [0.01, 0.001]),
}


@pytest.mark.parametrize("text", TABLES)
def test_hazard_table_accepts_headings_units_and_order(text, tmp_path):
    """Units in headings, rates or probabilities, Japanese headings, any order; certain and impossible levels are omitted with a note."""
    (tmp_path / "h.csv").write_text("# from somewhere\n" + text, encoding="utf-8")
    hazard = read_hazard(tmp_path / "h.csv")
    im, levels, rates = TABLES[text]
    assert hazard.im == im
    assert np.asarray(hazard.branches[0].levels) == pytest.approx(levels)
    assert np.asarray(hazard.branches[0].rates) == pytest.approx(rates)
    assert bool(hazard.notes) == (text.count("\n") > 3)


INVALID = {
    "pgv_m_s,annual_rate\n0.2,0.01\n": "at least two levels",
    "pgv_m_s,annual_rate\n": "the table is empty",
    "pgv_m_s,annual_rate\n0.2,0.01\n0.6,0.02\n": "must not increase with intensity: this one rises from 0.2 to 0.6",
    "pgv_m_s,annual_rate\n0.2,0.01\n0.6,0.01\n": "does not decrease at its end",
    "pgv_m_s,annual_rate\n0.2,0.01\n0.2,0.001\n": "0.2 is duplicated",
    "pga_g,annual_rate\n0.1,0.01\n0.2,0.02\n": "this one rises from 0.1 to 0.2",
    "pga_gal,annual_rate\n100,0.01\n100,0.001\n": "100 is duplicated",
    "pgv,annual_rate\n0.2,0.01\n0.6,0.001\n": "'pgv' has no unit",
    "pgv_furlong,annual_rate\n0.2,0.01\n0.6,0.001\n": "unknown unit 'furlong'",
    "pgv_g,annual_rate\n0.2,0.01\n0.6,0.001\n": "unknown unit 'g'",
    "depth,annual_rate\n0.2,0.01\n": "one column of levels",
    "pgv_m_s,pga_g,annual_rate\n0.2,1,0.01\n": "one column of levels",
    "pgv_m_s,x\n0.2,0.01\n": "one of the columns annual_rate",
    "pgv_m_s,annual_rate\n0.2,-0.01\n0.6,0.001\n": "line 2: the annual frequency must be zero or more",
    "pgv_m_s,annual_poe\n0.2,1.5\n0.6,0.001\n": "line 2: the exceedance probability must lie in",
    "pgv_m_s,annual_rate\n0.2,nan\n0.6,0.001\n": "line 2",
    "pgv_m_s,annual_rate\n0.2,often\n0.6,0.001\n": "line 2: rate must be a number",
    "pgv_m_s,annual_rate\n0,0.1\n0.6,0.001\n": "line 2: the level must be positive",
    "branch,weight,pgv_m_s,annual_rate\na,0.5,0.2,0.01\na,0.5,0.6,0.001\n": "must sum to 1; found 0.5",
    "branch,pgv_m_s,annual_rate\na,0.2,0.01\na,0.6,0.001\nb,0.2,0.01\nb,0.6,0.001\n": "branch 'a' has no weight",
    "branch,weight,pgv_m_s,annual_rate\na,0.5,0.2,0.01\na,0.6,0.6,0.001\n": "several weights",
    "branch,weight,pgv_m_s,annual_rate\na,1,0.2,0.01\na,1,0.6,0.02\n": "branch 'a': the frequencies of a hazard curve must not increase",
}


@pytest.mark.parametrize("text", INVALID)
def test_hazard_table_rejects_invalid_values(text, tmp_path):
    """Invalid values are rejected with their line."""
    (tmp_path / "h.csv").write_text(text, encoding="utf-8")
    with pytest.raises(HazardError) as caught:
        read_hazard(tmp_path / "h.csv")
    assert INVALID[text] in str(caught.value) and str(caught.value).startswith("h.csv: ")


def test_hazard_table_with_several_measures_requires_choice(tmp_path):
    """A table of two measures lists them; with one selected the other is named as ignored."""
    (tmp_path / "h.csv").write_text("pgv_m_s,pga_g,annual_rate\n0.2,0.1,0.01\n0.6,0.4,0.001\n", encoding="utf-8")
    hazard = read_hazard(tmp_path / "h.csv", im="pga")
    assert hazard.im == "pga" and "pgv_m_s" in str(hazard.notes[0])


@pytest.mark.parametrize(("heading", "im"), [("rotd50(0.5)_g", "rotd50:0.5"), ("RotD100 0.5s (gal)", "rotd100:0.5"), ("cav_m_s", "cav")])
def test_hazard_of_record_measures_is_read(heading, im, tmp_path):
    """Both spectra of all directions, and CAV."""
    (tmp_path / "h.csv").write_text(f"{heading},annual_rate\n0.1,0.01\n0.4,0.001\n", encoding="utf-8")
    assert read_hazard(tmp_path / "h.csv").im == read_hazard(tmp_path / "h.csv", im=im).im == im


def test_other_definition_of_direction_is_noted(tmp_path):
    """Sa of one component against RotD50 of the same period; another period is refused, the same measure preferred."""
    (tmp_path / "h.csv").write_text("sa(0.5)_g,annual_rate\n0.1,0.01\n0.4,0.001\n", encoding="utf-8")
    hazard = read_hazard(tmp_path / "h.csv", im="rotd50:0.5")
    assert hazard.im == "sa=0.5" and "another definition of the horizontal motion" in str(hazard.notes[0])
    curves = read_fragility(write_fragility(tmp_path, im="rotd50:0.5", unit="m/s^2"))
    assert check_measure(curves, hazard) == curves
    assert read_hazard(tmp_path / "h.csv", im="sa:0.5").notes == ()
    with pytest.raises(HazardError, match=r"levels are of sa=0\.5, but rotd50:1 is required"):
        read_hazard(tmp_path / "h.csv", im="rotd50:1")
    (tmp_path / "h.csv").write_text("sa(0.5)_g,rotd50(0.5)_g,annual_rate\n0.1,0.2,0.01\n0.4,0.5,0.001\n", encoding="utf-8")
    assert read_hazard(tmp_path / "h.csv", im="rotd50:0.5").im == "rotd50:0.5"


def test_hazard_rejects_folders_and_binary_files(tmp_path):
    """A folder, bytes, nothing."""
    (tmp_path / "b.csv").write_bytes(b"\0\1\2")
    for name in (".", "gone.csv", "b.csv"):
        with pytest.raises(HazardError, match=r"b\.csv|gone|cannot read"):
            read_hazard(tmp_path / name)


def test_median_without_unit_is_rejected_with_table_in_gal(tmp_path):
    """A number that could be gal, g or m/s² is refused; with its unit, or where all is SI, it is taken."""
    (tmp_path / "h.csv").write_text("pga_gal,annual_rate\n100,0.01\n400,0.001\n", encoding="utf-8")
    gal = read_hazard(tmp_path / "h.csv")
    with pytest.raises(UnitError, match="has no unit, and the hazard is not in SI"):
        fragility_from_median(gal, "300", 0.4)
    assert fragility_from_median(gal, "300gal", 0.4).curve == Lognormal(3.0, 0.4)
    assert fragility_from_median(gal, "0.5 g", 0.4).curve.median == pytest.approx(4.903325)
    assert fragility_from_median(site(), "0.6", 0.4).curve == fragility_from_median(site(), "60 kine", 0.4).curve
    with pytest.raises(UnitError, match="unknown unit 'gal'"):
        fragility_from_median(site(), "0.6gal", 0.4)
    with pytest.raises(ParameterError, match="median of a fragility must be positive"):
        fragility_from_median(site(), "-0.6", 0.4)


def write_fragility(tmp_path, **changed):
    """Write a document as `seisblock fragility --json` does, in so far as it is read."""
    entry = {"body": "stone", "limit": "overturn", "im": "pgv", "unit": "m/s", "median": 0.5, "beta": 0.3} | changed
    (tmp_path / "f.json").write_text(json.dumps({"schema": "seisblock/fragility/1", "results": [entry]}), encoding="utf-8")
    return tmp_path / "f.json"


def test_fragility_document_round_trips(tmp_path):
    """Body, limit state and curve are stated; a curve in another measure than the hazard is rejected."""
    (curves,) = read_fragility(write_fragility(tmp_path))
    assert (curves.body, curves.limit, curves.curve) == ("stone", "overturn", Lognormal(0.5, 0.3))
    assert check_measure((curves,), site()) == (curves,)
    with pytest.raises(ParameterError, match=r"the fragility is in sa=0\.5 and the hazard in pgv"):
        check_measure(read_fragility(write_fragility(tmp_path, im="sa=0.5", unit="m/s^2")), site())


@pytest.mark.parametrize(
    "damage",
    [{"median": "0.5"}, {"beta": -1.0}, {"unit": "cm/s"}, {"im": "pgx"}, {"median": None}],
    ids=str,
)
def test_damaged_fragility_document_is_rejected(damage, tmp_path):
    """Other types, other units, no curve."""
    with pytest.raises(ParameterError, match=r"f\.json (is a damaged fragility document|contains no fragility curve)"):
        read_fragility(write_fragility(tmp_path, **damage))


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"schema": "seisblock/rock/1"}', "[" * 100_000, "\0"], ids=len)
def test_foreign_fragility_document_is_rejected(text, tmp_path):
    """Empty, another command's, nested without end."""
    (tmp_path / "f.json").write_text(text, encoding="utf-8")
    with pytest.raises(ParameterError, match=r"f\.json is not a (JSON|fragility) document"):
        read_fragility(tmp_path / "f.json")


def test_bundled_hazard_equals_script_output():
    """The bundled hazard is marked as synthetic."""
    assert make_hazard.make().encode() == sample_path(make_hazard.NAME).read_bytes()
    assert "SYNTHETIC" in make_hazard.HEADER
