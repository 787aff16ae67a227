"""Place, time and earthquake of a record in tables, documents and pages (P4)."""

import json
from datetime import UTC, datetime

import pytest
from click.testing import CliRunner
from obspy.geodetics import gps2dist_azimuth

from seisblock.cli import main
from seisblock.output.figures.heading import heading
from seisblock.output.text.record_info import record_info
from seisblock.readers import read
from seisblock.records import Component, Record
from seisblock.records.site import Earthquake, Site, epicentral_distance_km, format_local_time, get_earthquake, get_site, great_circle_km

JMA = """SITE CODE=  47772大阪市中央区,32.7417,130.8083,12,7.3,42476.0593171296,2.1,3.4
LAT.=   34.6819
LON.=  135.5183
SAMPLING RATE= 100Hz
UNIT  = gal(cm/s/s)
INITIAL TIME = 2016 04 16 01 25 00
NS,EW,UD
"""


@pytest.fixture
def jma(tmp_path):
    """Return a file of JMA's layout with everything its first line can hold."""
    path = tmp_path / "地震.csv"
    path.write_bytes((JMA + "".join(f"{i % 7}.5,{-i % 5}.25,{i % 3}.125\n" for i in range(400))).encode("cp932"))
    return path


def test_site_has_station_and_earthquake(jma):
    """Station with its name and place, and the earthquake; JST is the network's clock."""
    record = read(jma)
    assert get_site(record) == Site("47772", "大阪市中央区", 34.6819, 135.5183)
    result = get_earthquake(record)
    assert (result.latitude_deg, result.longitude_deg, result.depth_km, result.magnitude) == (32.7417, 130.8083, 12.0, 7.3)
    assert format_local_time(record, result.origin_time) == "2016-04-16 01:25:25 JST"
    assert format_local_time(record, record.start) == "2016-04-16 01:25:00 JST"


def test_unknown_site_values_are_none():
    """An array has no place, no time and no earthquake; zeros for all of it are none either."""
    bare = Record((Component("NS", [0.0, 1.0]),), 0.01)
    assert (get_site(bare), get_earthquake(bare), format_local_time(bare, bare.start)) == (Site(), None, "")
    zeros = {"magnitude": 0.0, "event_latitude_deg": 0.0, "event_longitude_deg": 0.0, "event_depth_km": 0.0}
    assert get_earthquake(Record((Component("NS", [0.0, 1.0]),), 0.01, metadata=zeros)) is None
    second = Record((Component("NS", [0.0, 1.0]),), 0.01, start=datetime(2020, 1, 2, 3, 4, 5, tzinfo=UTC))
    assert format_local_time(second, second.start) == "2020-01-02 03:04:05 UTC"
    assert get_earthquake(Record((Component("NS", [0.0, 1.0]),), 0.01, metadata={"magnitude": 6.1})) == Earthquake(magnitude=6.1)


def test_tables_and_documents_state_site(jma):
    """P4: name, local time, magnitude, depth and epicentre stand above the table and in the document."""
    result = CliRunner().invoke(main, ["slide", str(jma), "--mu", "0.4"])
    assert "47772 大阪市中央区  2016-04-16 01:25:00 JST" in result.stdout
    assert "earthquake of magnitude 7.3, depth 12 km, 32.7417 N 130.808 E" in " ".join(result.stdout.split())
    entry = json.loads(CliRunner().invoke(main, ["slide", str(jma), "--mu", "0.4", "--json"]).stdout)["record"]
    assert entry["station_name"] == "大阪市中央区" and entry["latitude_deg"] == 34.6819 and entry["longitude_deg"] == 135.5183
    assert entry["start"] == "2016-04-15T16:25:00+00:00" and entry["local_start"] == "2016-04-16 01:25:00 JST"
    assert entry["epicentral_distance_km"] == pytest.approx(486.1, abs=0.1) and "epicentral distance 486 km" in " ".join(
        result.stdout.split()
    )
    assert "station at 34.6819 N 135.518 E" in result.stdout
    assert entry["earthquake"]["magnitude"] == 7.3 and entry["earthquake"]["origin_time"].startswith("2016-04-15T16:25:2")


def test_site_of_real_record_appears_in_every_output(tmp_path):
    """Station, hemispheres, name of the earthquake and the file's own distance: in tables, documents, figures and reports."""
    text = " ".join(CliRunner().invoke(main, ["measure", "--json", "--window", "45:60"]).stdout.split())
    entry = json.loads(text)["record"]
    assert (entry["station"], entry["station_name"]) == ("HSES", "Hanmer Springs Emergency Centre")
    assert entry["earthquake"]["name"] == "5 km south-west of Waiau"
    assert (entry["epicentral_distance_km"], entry["latitude_deg"]) == (25.0, -42.52333)
    output = " ".join(CliRunner().invoke(main, ["measure", "--window", "45:60"]).stdout.split())
    assert "station at 42.5233 S 172.831 E" in output
    assert "earthquake of magnitude 7.82, 5 km south-west of Waiau, depth 15 km, 42.6925 S 173.022 E, epicentral distance 25 km" in output
    record = read("hanmer_springs_2016")
    assert "M 7.8, 25 km" in heading(record)
    assert record_info(record)[0] == "station at 42.5233 S 172.831 E"


def test_epicentral_distance_is_near_geodesic():
    """Within the flattening of the Earth of the geodesic; zeros for a place are no place."""
    for first, second in (((35.681, 139.767), (34.702, 135.496)), ((0.0, 179.5), (0.0, -179.5)), ((-42.523, 172.831), (-42.693, 173.022))):
        assert great_circle_km(first, second) == pytest.approx(gps2dist_azimuth(*first, *second)[0] / 1000.0, rel=0.005)
    nowhere = Record(
        (Component("NS", [0.0, 1.0]),), 0.01, metadata={"station_latitude_deg": 0.0, "station_longitude_deg": 0.0, "magnitude": 6.0}
    )
    assert get_site(nowhere).latitude_deg is None
    assert epicentral_distance_km(nowhere) is None
