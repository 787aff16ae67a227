"""Station, earthquake and instrument in the headers of every format, as their text states them."""

import json
from pathlib import Path

import pytest

from seisblock.readers import read_all
from tests.fuzz.formats import FORMATS
from tests.readers.format_trials import BINARY

HEADERS = Path(__file__).parent / "data" / "headers.json"
"""Entries of each format's file, as its text states them."""


def header(record):
    """Return station, start, components and metadata of a record, without what is computed from its samples."""
    metadata = {key: value for key, value in record.metadata.items() if key not in ("offset_gal", "bundle")}
    components = {component.code: component.azimuth_deg for component in record.components}
    return json.loads(
        json.dumps(
            {"format": record.format, "station": record.station, "start": record.start, "components": components, **metadata}, default=str
        )
    )


@pytest.mark.parametrize("kind", [kind for kind in FORMATS if kind not in (*BINARY, "slist", "tspair")])
def test_header_entries_are_those_of_the_text(kind, tmp_path):
    """Names, coordinates, heights, depths, magnitudes, times in UTC and directions."""
    path = tmp_path / "record"
    path.write_bytes(FORMATS[kind].data)
    (record,) = read_all(str(path), **FORMATS[kind].options)
    assert header(record) == json.loads(HEADERS.read_text("utf-8"))[kind]


@pytest.mark.parametrize(
    ("title", "event", "station", "azimuth"),
    [
        ("Imperial Valley-06, 10/15/1979, El Centro Array #4, 230", "Imperial Valley-06, 10/15/1979", "El Centro Array #4", 230.0),
        ("Loma Prieta, 10/18/1989, Gilroy, Gavilan Coll., UP", "Loma Prieta, 10/18/1989", "Gilroy, Gavilan Coll.", None),
        ("Somewhere, Station, 45", "Somewhere", "Station", 45.0),
        ("a remark, without direction", "a remark, without direction", "", None),
    ],
)
def test_at2_title_has_event_station_and_direction(title, event, station, azimuth, tmp_path):
    """A station may contain commas; the direction stands last."""
    path = tmp_path / "record.AT2"
    path.write_text(f"PEER\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  3, DT= .0100 SEC\n.1 .2 .1\n")
    (record,) = read_all(str(path))
    assert (record.metadata["event"], record.station, record.components[0].azimuth_deg) == (event, station, azimuth)
