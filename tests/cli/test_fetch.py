"""Downloads from a data centre on the loopback address, whose answers are synthetic."""

import json
import os
import tarfile

import numpy as np
import obspy
import pytest
from click.testing import CliRunner

from seisblock import read
from seisblock.cli import main
from seisblock.core.errors import InputError
from seisblock.readers import fdsn, read_all
from seisblock.records.site import epicentral_distance_km, get_earthquake
from tests.readers import data_center as data_center_module
from tests.readers.data_center import EVENT_ID, data_center, event

TIME = "2024-01-01T07:10:20"


@pytest.fixture
def center(monkeypatch):
    """Return a data centre; pauses between repetitions are omitted."""
    monkeypatch.setattr(fdsn, "FIRST_PAUSE_S", 0.0)
    with data_center() as server:
        yield server


@pytest.fixture
def fetch(center):
    """Return a function that runs the command."""

    def run(*words, **kwargs):
        line = ["fetch", *map(str, words)]
        centers = [] if "--data-center" in line else ["--data-center", center.url]
        return CliRunner().invoke(main, [*line, *centers, *([] if "--time" in line else ["--event-center", center.url])], **kwargs)

    return run


def test_fetch_event_writes_a_folder_that_every_record_takes(fetch, center, tmp_path):
    """Stations within 100 km of the epicentre, the first complete sensor of each; the earthquake is that of the QuakeML beside them."""
    folder = tmp_path / "syn"
    answer = fetch(EVENT_ID, "-o", folder)
    assert answer.exit_code == 0, answer.stderr
    assert "2 of 2 stations" in " ".join(answer.stdout.split()) and answer.stdout.index("XX.NEAR.00.HN") < answer.stdout.index(
        "XX.MID.00.HN"
    )
    names = {path.name for path in folder.iterdir()}
    assert names == {"event.xml", "fetch.json", "XX.NEAR.xml", "XX.NEAR.00.HN.mseed", "XX.MID.xml", "XX.MID.00.HN.mseed"}
    assert json.loads((folder / "fetch.json").read_text())["event"] == EVENT_ID
    record = read(folder, station="NEAR")
    assert (record.codes, record.location) == (("NS", "EW", "UD"), "00")
    assert get_earthquake(record).magnitude == 6.1
    assert epicentral_distance_km(record) == pytest.approx(9.1, abs=0.1)
    assert [r.station for r in read_all([folder], station="all")] == ["MID", "NEAR"]
    for line, code in (
        ("measure FOLDER --station near --quiet", 0),
        ("measure FOLDER", 3),
        ("measure FOLDER --station X", 3),
    ):
        answer = CliRunner().invoke(main, line.replace("FOLDER", str(folder)).split())
        assert answer.exit_code == code, answer.stderr
    assert "no station 'X'" in answer.stderr
    answer = CliRunner().invoke(main, ["map", str(folder), "--json"])
    assert [row["station"] for row in json.loads(answer.stdout)["results"]] == ["MID", "NEAR"]
    assert center.requests == {"event": 1, "station": 3, "dataselect": 2}


def test_fetch_resumes_where_it_was_interrupted(fetch, center, tmp_path):
    """Complete stations and the event are not asked for again; another request in the same folder is refused."""
    center.faults["dataselect:MID"] = [503] * 9
    answer = fetch(EVENT_ID, "-o", tmp_path / "a", "--retries", "2")
    assert answer.exit_code == 0
    assert "1 of 2 stations failed: run the same command again to resume" in answer.stderr
    assert "returned no waveforms of XX.MID.00.HN (Service temporarily unavailable HTTP Status code: 503)" in " ".join(
        answer.stdout.split()
    )
    assert center.requests["dataselect"] == 1 + 3
    center.faults.clear()
    center.requests.clear()
    answer = fetch(EVENT_ID, "-o", tmp_path / "a")
    assert answer.exit_code == 0 and "2 of 2 stations have a record" in " ".join(answer.stdout.split()) and "present" in answer.stdout
    assert center.requests == {"station": 2, "dataselect": 1}
    answer = fetch(EVENT_ID, "-o", tmp_path / "a", "--duration", "60")
    assert answer.exit_code == 3 and "records of another request (fetch.json): choose another folder" in answer.stderr


def test_fetch_json_lists_each_station_with_status_and_peak(fetch, center, tmp_path):
    """New, present on the second run, without data; nothing but the document on stdout."""
    center.empty = {"MID"}
    for status in ("new", "present"):
        answer = fetch(EVENT_ID, "-o", tmp_path / "a", "--json")
        document = json.loads(answer.stdout)
        assert document["schema"] == "seisblock/fetch/1" and document["parameters"]["event"] == EVENT_ID
        near, mid = document["results"]
        assert (near["station"], near["location"], near["status"], near["failure"]) == ("NEAR", "00", status, "")
        assert near["epicentral_distance_km"] == pytest.approx(9.1, abs=0.1)
        assert max(near["pga_m_s2"].values()) == pytest.approx(0.13, abs=0.01) and list(near["pga_m_s2"]) == ["NS", "EW", "UD"]
        assert (mid["status"], mid["file"], mid["pga_m_s2"]) == ("no data", None, {}) and "has no data" in mid["failure"]
        assert document["record"]["station"] == "NEAR"


@pytest.mark.parametrize("content", ["", "000001D XX", "<html>proxy</html>", "cut"])
def test_fetch_keeps_no_incomplete_answer(content, fetch, center, tmp_path):
    """No data, another thing than miniSEED, miniSEED that ends inside a block: the next run completes the folder."""
    whole = data_center_module.answer_of(
        "dataselect", {"station": "NEAR", "location": "00", "channel": "HNN", "starttime": TIME, "endtime": "2024-01-01T07:10:40"}
    )
    center.faults["dataselect:NEAR"] = [204 if content == "" else whole[:-1000] if content == "cut" else content.encode()]
    answer = fetch("--station", "XX.NEAR", "--time", TIME, "-o", tmp_path / "a", "--retries", "0")
    assert answer.exit_code == 3 and not list((tmp_path / "a").glob("*.mseed"))
    answer = fetch("--station", "XX.NEAR", "--time", TIME, "-o", tmp_path / "a")
    assert answer.exit_code == 0 and len(list((tmp_path / "a").glob("*.mseed"))) == 1


@pytest.mark.parametrize(
    ("status", "is_repeated"), [(429, True), (500, True), (502, True), (503, True), (400, False), (413, False), (403, False)]
)
def test_fetch_repeats_requests_that_fail_for_a_while(status, is_repeated, fetch, center, tmp_path):
    """A busy server is asked again, a refusal is final."""
    center.faults["dataselect:NEAR"] = [status, status]
    answer = fetch("--station", "XX.NEAR", "--time", TIME, "-o", tmp_path / "a")
    assert answer.exit_code == (0 if is_repeated else 3), answer.stderr
    assert center.requests["dataselect"] == (3 if is_repeated else 1)
    assert ("a shorter time window" in " ".join(answer.stderr.split())) == (status == 413)


def test_fetch_station_and_time_takes_the_location(fetch, tmp_path):
    """No event, hence no QuakeML; the folder's default name is made of station and time."""
    os.chdir(tmp_path)
    answer = fetch("--station", "xx.far", "--time", TIME, "--location", "10", "--before", "5", "--duration", "12")
    assert answer.exit_code == 0, answer.stderr
    folder = tmp_path / "XX.FAR_2024-01-01T071020"
    assert {path.name for path in folder.iterdir()} == {"fetch.json", "XX.FAR.xml", "XX.FAR.10.HN.mseed"}
    record = read(folder)
    assert record.location == "10" and record.duration_s == 12.0
    assert record.start.isoformat() == "2024-01-01T07:10:15+00:00"
    answer = fetch("--station", "XX.FAR", "--time", "2030-01-01")
    assert answer.exit_code == 3 and "has no data: waveforms of XX.FAR.00.HN" in answer.stderr


def test_fetch_takes_a_quakeml_file_of_the_user(fetch, center, tmp_path):
    """The event service is not asked."""
    event().write(str(tmp_path / "mine.xml"), "QUAKEML")
    answer = fetch(tmp_path / "mine.xml", "-o", tmp_path / "a")
    assert answer.exit_code == 0 and center.requests["event"] == 0
    assert obspy.read_events(str(tmp_path / "a" / "event.xml"))[0].magnitudes[0].mag == 6.1


def test_fetch_states_errors_in_one_sentence(fetch, center, tmp_path):
    """Unknown names, no network, no data, nonsense instead of an answer; no folder is left behind."""
    lines = {
        (EVENT_ID, "--data-center", "nowhere"): "unknown data center 'nowhere': give an address (https://...) or one of",
        (EVENT_ID, "--data-center", "http://127.0.0.1:9"): "no FDSN service responds at http://127.0.0.1:9: check the network",
        (EVENT_ID, "--data-center", "http://"): "unknown data center 'http://'",
        ("nosuch",): f"{center.url} has no data: event nosuch",
        (EVENT_ID, "--within", "1"): f"{center.url} has no data: stations *.*",
        ("--station", "XX.NONE", "--time", TIME): "has no data: stations XX.NONE",
        ("--station", "XX.NEAR", "--time", "yesterday"): "'yesterday' is no time: expected UTC",
        ("--station", "NEAR", "--time", TIME): "station 'NEAR': expected network and station, as CI.MIKB",
        ("--time", TIME): "--time requires --station",
        (): "give an event, or --station and --time",
    }
    for words, message in lines.items():
        answer = fetch(*words, "-o", tmp_path / "a", "--retries", "0")
        assert answer.exit_code == 3, (words, answer.stdout)
        assert message in answer.stderr and len(answer.stderr.strip().splitlines()) == 1, answer.stderr
        assert not (tmp_path / "a").exists()
    unreadable = f"{center.url} returned no stations XX.NEAR (unreadable answer): try again later"
    for service, message in (
        ("event", f"{center.url} returned no QuakeML for event syn0001"),
        ("station", unreadable),
        ("dataselect", "returned no miniSEED"),
    ):
        center.faults[service] = [b"<html>maintenance</html>"]
        answer = fetch(EVENT_ID, "--station", "XX.NEAR", "-o", tmp_path / service)
        assert answer.exit_code == 3 and message in answer.stderr, answer.stderr


def test_station_without_response_is_no_obstacle_for_the_others(fetch, center, tmp_path):
    """In a folder and in an archive: of all stations, it is named and the others are kept; by its own name, it is refused."""
    folder, bundle = tmp_path / "a", tmp_path / "a.tar"
    fetch(EVENT_ID, "-o", folder)
    inventory = data_center_module.station("MID")
    for channel in inventory[0][0]:
        channel.response = None
    inventory.write(str(folder / "XX.MID.xml"), "STATIONXML")
    with tarfile.open(bundle, "w") as archive:
        archive.add(folder, "a")
    for source in map(str, (folder, bundle)):
        answer = CliRunner().invoke(main, ["measure", source, "--station", "all", "--json"])
        assert json.loads(answer.stdout)["record"]["station"] == "NEAR"
        assert "warning: XX.MID.00.HN.mseed: XX.MID.00.HNE: the StationXML has no response" in answer.stderr
        assert CliRunner().invoke(main, ["measure", source, "--station", "all", "--strict"]).exit_code == 3
        assert read(source, station="near").station == "NEAR"
        for station in ("MID", "all"):
            with pytest.raises(InputError, match="has no response"):
                read_all([source], station=station)


def test_fetch_prints_the_quality_flags_of_each_record(fetch, monkeypatch, tmp_path):
    """A dead channel of one of two stations."""
    waveforms = data_center_module.trace

    def dead(code, *, station, **kwargs):
        result = waveforms(code, station=station, **kwargs)
        if station == "MID" and code == "HNZ":
            result.data = np.zeros_like(result.data)
        return result

    monkeypatch.setattr(data_center_module, "trace", dead)
    answer = fetch(EVENT_ID, "-o", tmp_path / "a")
    assert "warning: MID: UD: all samples are 0 while other components are not: dead channel" in " ".join(answer.stdout.split())


def test_fetch_names_a_service_that_is_missing(fetch, center, tmp_path):
    """A centre of events only."""
    center.services = {"station", "event"}
    answer = fetch("--station", "XX.NEAR", "--time", TIME, "-o", tmp_path / "a")
    assert answer.exit_code == 3 and "offers no dataselect service" in answer.stderr


def test_quakeml_beside_a_record_is_used_only_if_it_matches(fetch, tmp_path):
    """By the origin time; a QuakeML of another day changes nothing, nor does one beside a record whose header states its earthquake."""
    fetch("--station", "XX.NEAR", "--time", TIME, "-o", tmp_path / "a")
    assert get_earthquake(read(tmp_path / "a")) is None
    catalog = event()
    catalog[0].origins[0].time += 86400.0
    catalog.write(str(tmp_path / "a" / "other.xml"), "QUAKEML")
    assert get_earthquake(read(tmp_path / "a")) is None
    (tmp_path / "a" / "broken.xml").write_text("<q:quakeml xmlns:q='http://quakeml.org/xmlns/quakeml/1.2'>")
    assert get_earthquake(read(tmp_path / "a")) is None
    event().write(str(tmp_path / "a" / "this.xml"), "QUAKEML")
    assert get_earthquake(read(tmp_path / "a")).magnitude == 6.1
