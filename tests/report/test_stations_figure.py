"""The map of an earthquake's stations: each where it is, in the colour of what happened, to scale."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from seisblock.bodies.factory import load_block
from seisblock.models.respond.options import RespondOptions
from seisblock.records import Preparation
from seisblock.records.site import great_circle_km
from seisblock.report.figures.stations import figure, map_title, overlap_area
from seisblock.studies.assessment import Assessment, classify
from seisblock.studies.map.station_response import StationBody, StationCemetery, StationResult
from seisblock.studies.map.stations import Stations
from seisblock.studies.map.surveyed_places import SurveyComparison, SurveyedPlace
from tests.report.long_record import AOYAMA, stations


def test_station_points_equal_results():
    """Longitudes, latitudes and rates of all that have a place, the worst drawn last; the epicentre is the star."""
    result, subject = stations(StationCemetery(AOYAMA))
    axis = figure(result, subject).axes[0]
    points, star, *_ = axis.collections
    mapping = {(*place, value) for place, value in zip(points.get_offsets().data.tolist(), points.get_array().tolist(), strict=True)}
    assert mapping == {(answer.longitude, answer.latitude, answer.effect.rate) for answer in result.mapped}
    assert points.get_array()[-1] == 1.0
    assert star.get_offsets().data.tolist() == [[139.0, 35.0]]


def test_scale_bar_length_equals_its_label():
    """Its ends lie so many kilometres apart on the map, and a degree is as wide as at that latitude."""
    result, _ = stations()
    fig = figure(result, None)
    fig.draw_without_rendering()
    axis = fig.axes[0]
    (bar,) = axis.lines
    labels = float(next(text.get_text() for text in axis.texts if text.get_text().endswith(" km")).split()[0])
    (left, right), (bottom, top) = axis.get_xlim(), axis.get_ylim()
    ends = [left + share * (right - left) for share in bar.get_xdata()]
    middle = 0.5 * (bottom + top)
    assert great_circle_km((middle, ends[0]), (middle, ends[1])) == pytest.approx(labels, rel=0.01)
    box = axis.get_window_extent()
    across, along = (right - left) * np.cos(np.radians(middle)) / box.width, (top - bottom) / box.height
    assert across == pytest.approx(along, rel=1e-6)


def across_the_date_line(result):
    """Return the stations shifted east so that half of the longitudes are negative, and one is not on Earth."""
    moved = [
        answer if answer.longitude is None else replace(answer, longitude=(answer.longitude + 41.0 + 180.0) % 360.0 - 180.0)
        for answer in result.answers
    ]
    missing = replace(moved[0], station="LOST", latitude=99.9)
    return Stations((*moved, missing), replace(result.earthquake, longitude_deg=180.0), result.origin_told)


def test_map_across_date_line_keeps_distances():
    """Distances equal those 41 degrees further west with longitudes from -180 to 180; impossible positions are on no map."""
    result, _ = stations()
    second = across_the_date_line(result)
    assert any(answer.longitude < 0.0 for answer in second.mapped) and len(second.mapped) == len(result.mapped)
    axes = [figure(item, None).axes[0] for item in (result, second)]
    widths = [axis.get_xlim()[1] - axis.get_xlim()[0] for axis in axes]
    assert widths[1] == pytest.approx(widths[0])
    first, moved = (axis.collections[0].get_offsets().data for axis in axes)
    np.testing.assert_allclose(np.diff(moved, axis=0), np.diff(first, axis=0), atol=1e-9)
    axes[1].figure.draw_without_rendering()
    assert all(abs(float(label.get_text().replace("\N{MINUS SIGN}", "-"))) <= 180.0 for label in axes[1].get_xticklabels())


def test_map_without_body_is_coloured_by_shaking():
    """In gal, or m/s^2, up to the largest."""
    result, _ = stations()
    for gal, unit in ((True, 0.01), (False, 1.0)):
        fig = figure(result, None, gal=gal)
        assert max(fig.axes[0].collections[0].get_array()) == pytest.approx(8.0 / unit)
        assert fig.axes[1].get_ylabel() == ("PGA (gal)" if gal else "PGA (m/s²)")


@pytest.mark.parametrize(("west", "south"), [(0.0, 0.02), (0.02, 0.0), (-0.02, -0.01), (0.0, 0.0)])
def test_worst_station_is_labelled_near_epicentre(west, south):
    """The answer names it first; surveyed places have theirs, and no name stands on another."""
    result, subject = stations(StationCemetery(AOYAMA))
    worst = replace(result.answers[0], latitude=35.0 - south, longitude=139.0 - west)
    nearby = Stations((worst, *result.answers[1:]), result.earthquake, result.origin_told)
    places = [SurveyedPlace(name, 35.01 + north, 139.0 + 0.2 * east, 80, 52) for name, north, east in (("北", 0.1, 0), ("East", 0.0, 1))]
    fig = figure(nearby, subject, surveys=[SurveyComparison(place, SimpleNamespace(), (), None, None) for place in places])
    fig.draw_without_rendering()
    labels = {text.get_text(): text.get_window_extent() for text in fig.axes[0].texts if text.get_text()}
    assert {"X000", "北", "East"} <= set(labels)
    boxes = [box.extents for name, box in labels.items() if name != "N"]
    assert not [1 for i, first in enumerate(boxes) for second in boxes[:i] if overlap_area(tuple(first), tuple(second)) > 0.0]


def test_likely_overturning_has_thick_outline():
    """A station at which the body likely overturns has a thick rim, which the label of the scale explains."""
    subject = StationBody(load_block("gravestone"), RespondOptions(mu=0.6), runs=20)
    result, _ = stations()
    effects = [
        StationResult(0.0, probability=p, assessment=Assessment(p, (0.0, 1.0), 20, p, (), None, None, None, "NS", classify(p, p)))
        for p in (0.5, 0.45)
    ]
    two = [replace(answer, effect=effect) for answer, effect in zip(result.answers, effects, strict=False)]
    fig = figure(Stations(tuple(two), None, ""), subject)
    stands, falls = fig.axes[0].collections[0].get_linewidths()  # the worst on top
    assert falls > 2.0 * stands and fig.axes[1].get_ylabel() == "probability of overturning; thick rim: likely overturns"
    asleep = figure(Stations((two[1],), None, ""), subject)
    assert asleep.axes[1].get_ylabel() == "probability of overturning"


@pytest.mark.parametrize(("corner", "expected"), [((0, 0), 0.68), ((1, 0), 0.03)])
def test_scale_bar_covers_no_station(corner, expected):
    """It stands in a corner that is free: a station in the southwest, or in the southeast, stays in sight, with its name."""
    result, subject = stations(StationCemetery(AOYAMA))
    remaining = [(139.0, 35.0), (139.36, 35.3)] if corner == (0, 0) else [(139.36, 35.0), (139.0, 35.3)]
    answers = [replace(result.answers[0], station=f"S{i}", longitude=east, latitude=north) for i, (east, north) in enumerate(remaining)]
    axis = figure(Stations(tuple(answers), None, ""), subject).axes[0]
    (bar,) = [line for line in axis.lines if line.get_transform() == axis.transAxes]
    assert min(bar.get_xdata()) == pytest.approx(expected + 0.02)


def test_scaled_records_are_marked_on_map():
    """The title of a figure of scaled records states the scaling."""
    records, subject = stations(StationCemetery(AOYAMA))
    scaled = replace(records, preparation=Preparation(scale=4.0))
    assert map_title(scaled, subject).endswith("records scaled by 4") and "scaled" not in map_title(records, subject)
