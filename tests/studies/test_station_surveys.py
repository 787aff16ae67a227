"""Surveyed cemeteries between stations: estimates, neighbours, residuals, and pairs that cannot both be right."""

from __future__ import annotations

import pytest

from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.core.errors import BodyError
from seisblock.records.site import great_circle_km
from seisblock.studies.map.stations import StationReport, Stations
from seisblock.studies.map.surveyed_places import SurveyedPlace, compare_surveys, contradictions, read_surveys
from seisblock.studies.survey.estimate import estimate_shaking
from seisblock.studies.survey.likelihood import counted_survey

AOYAMA = read_cemetery("aoyama.csv")


def station(code, north, east, intensity):
    """Return a station that measured an intensity."""
    return StationReport(f"{code}.NS", code, latitude=north, longitude=east, pga_m_s2=1.0, jma_intensity=intensity)


NEAREST = (("A", 35.0, 139.0, 6.0), ("B", 35.1, 139.0, 5.0), ("C", 35.0, 139.2, 4.0), ("D", 36.0, 139.0, 1.0))
AROUND = Stations((*(station(*item) for item in NEAREST), StationReport("e.csv", pga_m_s2=9.0, jma_intensity=7.0)), None)
"""Four stations, and one that is nowhere."""


def test_survey_is_compared_with_three_nearest_stations():
    """The estimate is that of `infer`; the stations' intensities are weighted by the inverse of their distance."""
    (answer,) = compare_surveys([SurveyedPlace("temple", 35.02, 139.0, 100, 35)], AROUND, AOYAMA)
    assert answer.estimate == estimate_shaking(counted_survey(AOYAMA, 35, 100))
    assert [neighbour.station for neighbour in answer.neighbours] == ["A", "B", "C"]
    distant = [great_circle_km((35.02, 139.0), place) for place in ((35.0, 139.0), (35.1, 139.0), (35.0, 139.2))]
    assert [neighbour.distance_km for neighbour in answer.neighbours] == pytest.approx(distant)
    weights = [1 / distance for distance in distant]
    expected = (6.0 * weights[0] + 5.0 * weights[1] + 4.0 * weights[2]) / sum(weights)
    assert answer.expected_intensity == pytest.approx(expected)
    assert answer.residual == pytest.approx(answer.estimate.jma_intensity - expected)


def test_survey_without_falls_has_bound_and_no_residual():
    """So it is without any station with an intensity, and where all are further away than shaking is alike."""
    (none,) = compare_surveys([SurveyedPlace("temple", 35.0, 139.0, 40, 0)], AROUND, AOYAMA)
    assert none.residual is None and none.expected_intensity is not None
    (single,) = compare_surveys([SurveyedPlace("temple", 35.0, 139.0, 40, 20)], Stations((), None), AOYAMA)
    (distant,) = compare_surveys([SurveyedPlace("temple", -20.0, -179.9, 40, 20)], AROUND, AOYAMA)
    for answer in (single, distant):
        assert (answer.neighbours, answer.expected_intensity, answer.residual) == ((), None, None)


def test_contradicting_pairs_are_named():
    """Places and stations within ten kilometres with disjoint intervals are flagged; others are not."""
    values = (("fell", 35.0, 139.01, 99), ("stands", 35.01, 139.0, 1), ("far", 35.5, 139.0, 99))
    places = [SurveyedPlace(name, north, east, 100, fallen) for name, north, east, fallen in values]
    answers = compare_surveys(places, Stations((station("A", 35.0, 139.0, 6.7),), None), AOYAMA)
    (low, _), (_, high) = (answer.estimate.jma_intensity_interval for answer in answers[:2])
    assert 6.7 > low > high
    values = contradictions(answers)
    assert [text.split(" (")[0] for text in values] == ["stands and station A", "fell and stands"]
    agreeing = compare_surveys(places[:1], Stations((station("A", 35.0, 139.0, float(low)),), None), AOYAMA)
    assert contradictions(agreeing) == []


def test_one_sided_intervals_end_at_the_scale():
    """The intensity lies between 0 and a bound if no stone fell, between a bound and 7.5 if all did."""
    places = [SurveyedPlace("stands", 35.01, 139.0, 100, 0), SurveyedPlace("fell", 35.0, 139.0, 100, 100)]
    answers = compare_surveys(places, Stations((), None), AOYAMA)
    assert [None in answer.estimate.jma_intensity_interval for answer in answers] == [True, True]
    (text,) = contradictions(answers)
    assert "JMA intensity 0.0 to 5.6 and 6.5 to 7.5" in text


def test_survey_list_accepts_both_languages(tmp_path):
    """Names of columns, their order, other columns and Shift-JIS are as people write them."""
    path = tmp_path / "調査.csv"
    path.write_bytes("場所,転倒,墓石,緯度,経度,備考\n光明寺,60,80,37.30,138.90,x\n\n".encode("cp932"))
    assert read_surveys(path) == (SurveyedPlace("光明寺", 37.30, 138.90, 80, 60),)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("place,latitude,longitude,stones\nA,35,139,10\n", "missing: .*fallen"),
        ("place,latitude,longitude,stones,fallen\n", "list of surveys is empty"),
        ("place,latitude,longitude,stones,fallen\nA,35,139,10,x\n", "line 2: expected degrees and whole numbers"),
        ("place,latitude,longitude,stones,fallen\nA,95,139,10,1\n", "line 2: A: 95.0, 139.0 is not a valid position"),
        ("place,latitude,longitude,stones,fallen\nA,35,139,10,11\n", "line 2: 11 of 10 stones overturned is impossible"),
        ("place,latitude,longitude,stones,fallen\nA,nan,139,10,1\n", "not a valid position"),
    ],
)
def test_survey_list_rejects_invalid_rows(text, says, tmp_path):
    """A column, a row, a number or a place that is missing or impossible is named with its line."""
    path = tmp_path / "surveys.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(BodyError, match=says):
        read_surveys(path)
    with pytest.raises(BodyError, match=r"cannot read .*gone.csv: No such file"):
        read_surveys(tmp_path / "gone.csv")
