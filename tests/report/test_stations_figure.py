"""The map of an earthquake's stations: each where it is, in the colour of what happened, to scale."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from seisblock.bodies.factory import load_block
from seisblock.records.site import great_circle_km
from seisblock.report.figures.label_placement import overlap_area
from seisblock.report.figures.stations import figure
from seisblock.studies.map.station_response import StationBody, StationCemetery, StationResult
from seisblock.studies.map.stations import Stations
from seisblock.studies.map.surveyed_places import SurveyComparison, SurveyedPlace
from tests.report.long_record import AOYAMA, stations


def test_station_points_equal_results():
    """Longitudes, latitudes and rates of all that have a place, the worst drawn last; the epicentre is the star."""
    found, subject = stations(StationCemetery(AOYAMA))
    axis = figure(found, subject).axes[0]
    points, star, *_ = axis.collections
    drawn = {(*place, value) for place, value in zip(points.get_offsets().data.tolist(), points.get_array().tolist(), strict=True)}
    assert drawn == {(answer.longitude, answer.latitude, answer.effect.rate) for answer in found.mapped}
    assert points.get_array()[-1] == 1.0
    assert star.get_offsets().data.tolist() == [[139.0, 35.0]]


def test_scale_bar_length_equals_its_label():
    """Its ends lie so many kilometres apart on the map, and a degree is as wide as at that latitude."""
    found, _ = stations()
    made = figure(found, None)
    made.draw_without_rendering()
    axis = made.axes[0]
    (bar,) = axis.lines
    told = float(next(text.get_text() for text in axis.texts if text.get_text().endswith(" km")).split()[0])
    (left, right), (bottom, top) = axis.get_xlim(), axis.get_ylim()
    ends = [left + share * (right - left) for share in bar.get_xdata()]
    middle = 0.5 * (bottom + top)
    assert great_circle_km((middle, ends[0]), (middle, ends[1])) == pytest.approx(told, rel=0.01)
    box = axis.get_window_extent()
    across, along = (right - left) * np.cos(np.radians(middle)) / box.width, (top - bottom) / box.height
    assert across == pytest.approx(along, rel=1e-6)


def across_the_date_line(found):
    """Return the stations moved east until half of them have longitudes below zero, as files tell them, and one lies nowhere on Earth."""
    moved = [
        answer if answer.longitude is None else replace(answer, longitude=(answer.longitude + 41.0 + 180.0) % 360.0 - 180.0)
        for answer in found.answers
    ]
    lost = replace(moved[0], station="LOST", latitude=99.9)
    return Stations((*moved, lost), replace(found.earthquake, longitude_deg=180.0), found.origin_told)


def test_map_across_date_line_keeps_distances():
    """The same distances as 41 degrees further west, longitudes told from -180 to 180; what is not on the Earth is on no map."""
    found, _ = stations()
    there = across_the_date_line(found)
    assert any(answer.longitude < 0.0 for answer in there.mapped) and len(there.mapped) == len(found.mapped)
    axes = [figure(each, None).axes[0] for each in (found, there)]
    widths = [axis.get_xlim()[1] - axis.get_xlim()[0] for axis in axes]
    assert widths[1] == pytest.approx(widths[0])
    here, moved = (axis.collections[0].get_offsets().data for axis in axes)
    np.testing.assert_allclose(np.diff(moved, axis=0), np.diff(here, axis=0), atol=1e-9)
    axes[1].figure.draw_without_rendering()
    assert all(abs(float(label.get_text().replace("\N{MINUS SIGN}", "-"))) <= 180.0 for label in axes[1].get_xticklabels())


def test_map_without_body_is_coloured_by_shaking():
    """In gal, or m/s^2, up to the largest."""
    found, _ = stations()
    for gal, unit in ((True, 0.01), (False, 1.0)):
        made = figure(found, None, gal=gal)
        assert max(made.axes[0].collections[0].get_array()) == pytest.approx(8.0 / unit)
        assert made.axes[1].get_ylabel() == ("PGA (gal)" if gal else "PGA (m/s²)")


@pytest.mark.parametrize(("west", "south"), [(0.0, 0.02), (0.02, 0.0), (-0.02, -0.01), (0.0, 0.0)])
def test_worst_station_is_labelled_near_epicentre(west, south):
    """The answer names it first; surveyed places have theirs, and no name stands on another."""
    found, subject = stations(StationCemetery(AOYAMA))
    worst = replace(found.answers[0], latitude=35.0 - south, longitude=139.0 - west)
    near = Stations((worst, *found.answers[1:]), found.earthquake, found.origin_told)
    places = [SurveyedPlace(name, 35.01 + north, 139.0 + 0.2 * east, 80, 52) for name, north, east in (("北", 0.1, 0), ("East", 0.0, 1))]
    made = figure(near, subject, surveys=[SurveyComparison(place, SimpleNamespace(), (), None, None) for place in places])
    made.draw_without_rendering()
    named = {text.get_text(): text.get_window_extent() for text in made.axes[0].texts if text.get_text()}
    assert {"X000", "北", "East"} <= set(named)
    boxes = [box.extents for name, box in named.items() if name != "N"]
    assert not [1 for i, one in enumerate(boxes) for other in boxes[:i] if overlap_area(tuple(one), tuple(other)) > 0.0]


def test_nominal_overturning_has_thick_outline():
    """A station at which no version falls, and the body itself does, is told from one at which it stands; the label says how."""
    subject = StationBody(load_block("gravestone"), {"mu": 0.6}, runs=20)
    found, _ = stations()
    effects = [StationResult(0.0, happened=fell, overturned=fell, probability=0.0) for fell in (True, False)]
    two = [replace(answer, effect=effect) for answer, effect in zip(found.answers, effects, strict=False)]
    made = figure(Stations(tuple(two), None, ""), subject)
    stands, falls = made.axes[0].collections[0].get_linewidths()  # the worst on top
    assert falls > 2.0 * stands and made.axes[1].get_ylabel() == "overturning probability (1); thick rim: nominal body overturned"
    asleep = figure(Stations((two[1],), None, ""), subject)
    assert asleep.axes[1].get_ylabel() == "overturning probability (1)"


@pytest.mark.parametrize(("corner", "expected"), [((0, 0), 0.68), ((1, 0), 0.03)])
def test_scale_bar_covers_no_station(corner, expected):
    """It stands in a corner that is free: a station in the southwest, or in the southeast, stays in sight, with its name."""
    found, subject = stations(StationCemetery(AOYAMA))
    kept = [(139.0, 35.0), (139.36, 35.3)] if corner == (0, 0) else [(139.36, 35.0), (139.0, 35.3)]
    answers = [replace(found.answers[0], station=f"S{i}", longitude=east, latitude=north) for i, (east, north) in enumerate(kept)]
    axis = figure(Stations(tuple(answers), None, ""), subject).axes[0]
    (bar,) = [line for line in axis.lines if line.get_transform() == axis.transAxes]
    assert min(bar.get_xdata()) == pytest.approx(expected + 0.02)
