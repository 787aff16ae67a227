"""The page of an earthquake's stations holds all that its script draws, needs no network, and obeys no name."""

import json
import re
from dataclasses import replace

import pytest

from seisblock.core.i18n import use_locale
from seisblock.records import Preparation
from seisblock.records.site import great_circle_km
from seisblock.report.html.map import map_page
from seisblock.studies.map.station_response import StationCemetery
from tests.report.long_record import AOYAMA, stations
from tests.report.test_stations_figure import across_the_date_line


def data_of(page):
    """Return what the page's script draws."""
    return json.loads(re.search(r'<script type="application/json" id="stations">(.*?)</script>', page, re.S)[1])


def test_map_page_places_stations_at_true_distances():
    """Kilometres from the middle, as far from the epicentre as on the sphere, north above; a row for each that has an answer."""
    result, subject = stations(StationCemetery(AOYAMA))
    page = map_page(result, subject)
    text = data_of(page)
    assert [point["name"] for point in text["points"]] == [answer.label for answer in result.mapped]
    for point, answer in zip(text["points"], result.mapped, strict=True):
        away = sum((first - second) ** 2 for first, second in zip(point["at"], text["epicentre"], strict=True)) ** 0.5
        assert away == pytest.approx(great_circle_km((answer.latitude, answer.longitude), (35.0, 139.0)), rel=0.01, abs=0.01)
    highest = min(text["points"], key=lambda point: point["at"][1])
    assert highest["name"] == max(result.mapped, key=lambda answer: answer.latitude).label
    assert page.count("<tr>") == 1 + 13
    assert "b.csv: cut short" in page and "a.csv" in page


def test_map_page_crosses_date_line():
    """Stations on both sides of it lie as far apart on the page as 41 degrees further west."""
    result, subject = stations()
    first, counterpart = (data_of(map_page(item, subject)) for item in (result, across_the_date_line(result)))
    for single, second in zip(
        [*first["points"], {"at": first["epicentre"]}], [*counterpart["points"], {"at": counterpart["epicentre"]}], strict=True
    ):
        assert second["at"] == pytest.approx(single["at"], abs=0.002)


def test_map_page_marks_scaled_records():
    """A page of scaled records states the scaling before the map."""
    records, subject = stations(StationCemetery(AOYAMA))
    scaled = map_page(replace(records, preparation=Preparation(target_pga=4.0)), subject)
    assert '<p class="processed">each record scaled to a PGA of 400 gal</p>' in scaled.replace("\xa0", " ")
    assert 'class="processed"' not in map_page(records, subject)


def test_distant_epicentre_is_left_off_map_page():
    """The stations fill the page as without one; one near by is on it."""
    result, subject = stations(StationCemetery(AOYAMA))
    distant = replace(result, earthquake=replace(result.earthquake, latitude_deg=-30.0, longitude_deg=-70.0))
    for item, beside in ((result, 1), (distant, 0)):
        page = data_of(map_page(item, subject))
        assert len(page["framed"]) == len(result.mapped) + beside and page["epicentre"]


def test_map_page_loads_nothing():
    """No address but the name of SVG's vocabulary; nothing is loaded."""
    page = map_page(*stations())
    assert set(re.findall(r"https?://[^\s\"'<)]+", page)) <= {"http://www.w3.org/2000/svg"}
    assert not re.search(r"<(?:link|img|iframe)\b|\bsrc=|@import|fetch\(|XMLHttpRequest", page)


def test_map_page_escapes_station_names():
    """A station's name from a file is neither a tag nor the end of the data."""
    result, _ = stations()
    evil = replace(result.answers[0], name="</script><script>alert(1)</script>", failure="<b>no</b>")
    page = map_page(replace(result, answers=(evil, *result.answers[1:])), None)
    assert "<script>alert" not in page and "<b>no</b>" not in page
    assert data_of(page)["points"][0]["name"].endswith("</script><script>alert(1)</script>")


def test_map_page_in_japanese_without_places_is_a_table():
    """In Japanese its own words are; without a place there is a table and no map."""
    result, subject = stations(StationCemetery(AOYAMA))
    with use_locale("ja"):
        page = map_page(result, subject)
    assert "観測点一覧（影響の大きい順）" in page and "Stations, largest response first" not in page and 'lang="ja"' in page
    nowhere = map_page(replace(result, answers=result.answers[-2:]), subject)
    assert 'id="map"' not in nowhere and "<table>" in nowhere
