"""The map of an earthquake's stations: each where it is, in the colour of what happened, to scale."""

import numpy as np
import pytest

from seisblock.present.figures.stations import figure
from seisblock.records.site import great_circle_km
from seisblock.studies.stations.effects import StandingStones
from tests.present.long_record import AOYAMA, stations


def test_points_are_the_stations():
    """Longitudes, latitudes and rates of all that have a place, the worst drawn last; the epicentre is the star."""
    found, subject = stations(StandingStones(AOYAMA))
    axis = figure(found, subject).axes[0]
    points, star, *_ = axis.collections
    drawn = {(*place, value) for place, value in zip(points.get_offsets().data.tolist(), points.get_array().tolist(), strict=True)}
    assert drawn == {(answer.longitude, answer.latitude, answer.effect.rate) for answer in found.mapped}
    assert points.get_array()[-1] == 1.0
    assert star.get_offsets().data.tolist() == [[139.0, 35.0]]


def test_the_scale_bar_is_as_long_as_it_says():
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


def test_without_a_subject_the_colours_are_the_shaking():
    """In gal, or m/s^2, up to the largest."""
    found, _ = stations()
    for gal, unit in ((True, 0.01), (False, 1.0)):
        made = figure(found, None, gal=gal)
        assert max(made.axes[0].collections[0].get_array()) == pytest.approx(8.0 / unit)
        assert made.axes[1].get_ylabel() == ("PGA (gal)" if gal else "PGA (m/s²)")
