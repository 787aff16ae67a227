"""`map`: table, CSV, GeoJSON and document of one earthquake's stations."""

from __future__ import annotations

import csv
import json

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.cli.map import SOLVERS
from seisblock.core.registry import get_solver
from seisblock.references import papers
from seisblock.studies.map.station_response import station_solvers
from tests.stations import EPICENTRE, bundle, station_files


@pytest.fixture(scope="module")
def map_result(tmp_path_factory):
    """Return what a bundle of six stations, one of them damaged, and a record without coordinates give: result, and the folder of files."""
    folder = tmp_path_factory.mktemp("map")
    path = bundle(folder / "event.knt.tar.gz", 6, damaged=(2,))
    words = ["map", str(path), "synthetic_jma", "--block", "gravestone", "--mu", "0.5", "--runs", "10", "--json"]
    words += ["--geojson", str(folder / "a.geojson"), "--csv", str(folder / "a.csv")]
    return CliRunner().invoke(main, words), folder


def test_map_document_lists_worst_first_and_names_failures(map_result):
    """Seven records: six answers, the worst first; the damaged one and the one without a place are named in the warnings."""
    result, _ = map_result
    assert result.exit_code == 0, result.stderr
    document = json.loads(result.stdout)
    entries = document["results"]
    assert [entry["failure"] is None for entry in entries] == [True] * 6 + [False]
    assert document["earthquake"]["magnitude"] == 6.8
    assert (document["parameters"]["subject"], document["parameters"]["solver"], document["parameters"]["runs"]) == (
        "gravestone",
        "respond",
        10,
    )
    shares = [entry["probability"] for entry in entries[:6]]
    assert shares == sorted(shares, reverse=True) and shares[0] == 1.0
    text = " ".join(document["warnings"])
    assert "SYA0020410231756" in text and "file truncated" in text
    assert "SYN 合成波形 SYNTHETIC: no coordinates in the file; listed, not on the map" in text


def test_map_geojson_is_valid_feature_collection(map_result):
    """RFC 7946: a FeatureCollection of points, longitude before latitude; the flat keys of the document; no point without a place."""
    result, folder = map_result
    entries = {entry["station"]: entry for entry in json.loads(result.stdout)["results"]}
    answer = json.loads((folder / "a.geojson").read_text(encoding="utf-8"))
    assert answer["type"] == "FeatureCollection" and len(answer["features"]) == 5
    for feature in answer["features"]:
        assert (feature["type"], feature["geometry"]["type"]) == ("Feature", "Point")
        east, north = feature["geometry"]["coordinates"]
        entry = entries[feature["properties"]["station"]]
        assert (east, north) == (entry["longitude"], entry["latitude"]) and 137 < east < 140 and 36 < north < 39
        assert feature["properties"] == {key: value for key, value in entry.items() if key not in ("latitude", "longitude", "assessment")}
    assert answer["earthquake"]["coordinates"] == [138.87, 37.288]


def test_map_csv_has_row_per_record(map_result):
    """A row for each record, its flat keys, every digit of its numbers, empty where there is nothing."""
    result, folder = map_result
    entries = json.loads(result.stdout)["results"]
    with (folder / "a.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(entries)
    for row, entry in zip(rows, entries, strict=True):
        assert list(row) == [key for key in entry if key != "assessment"]
        assert row["pga_m_s2"] == ("" if entry["pga_m_s2"] is None else repr(entry["pga_m_s2"]))
        assert row["station"] == entry["station"]


def test_map_prints_outcome_earthquake_and_stations(tmp_path, monkeypatch):
    """The verdict, the earthquake on its network's clock, the stations; of a cemetery the rate."""
    monkeypatch.setenv("COLUMNS", "100")
    for number in (1, 4):
        for name, data in station_files(number).items():
            (tmp_path / name).write_bytes(data)
    result = CliRunner().invoke(main, ["map", str(tmp_path), "--cemetery", "aoyama.csv"])
    assert result.exit_code == 0, result.stderr
    assert "of 2 stations, largest rate at SYA001" in result.stdout
    assert "earthquake of magnitude 6.8, depth 13 km, 37.288 N 138.87 E, 2004-10-23 17:56:00 JST" in result.stdout
    peaks = CliRunner().invoke(main, ["map", str(tmp_path)])
    assert "2 stations, largest shaking at SYA001" in peaks.stdout


@pytest.mark.parametrize(
    ("words", "code", "says"),
    [
        (["EMPTY"], 3, "no record found in this folder"),
        (["hanmer_springs_2016", "shafter_1989"], 3, "records of two earthquakes: 2016-11-13 11:02 UTC (HSES Hanmer Springs"),
        (["shafter_1989", "--cemetery", "aoyama.csv", "--block", "gravestone"], 2, "--cemetery and a body exclude each other"),
        (["shafter_1989", "--width", "24cm", "--height", "72cm"], 3, "friction required"),
        (["shafter_1989", "--solver", "rock", "--cemetery", "aoyama.csv"], 2, "--cemetery and a body exclude each other"),
        (["shafter_1989", "--solver", "rock"], 3, "body required (--width, --height missing)"),
        (["shafter_1989", "--solver", "rock", "--block", "gravestone", "--mu", "0.5"], 3, "rock has no option --mu: omit it"),
        (["shafter_1989", "--solver", "stack", "--block", "wagata"], 2, "'stack' is not one of 'jump', 'respond'"),
        (["shafter_1989", "--solver", "slide", "--mu", "0.1", "--runs", "9"], 3, "slide does not support samples"),
        (["shafter_1989", "--solver", "jump", "--block", "gravestone"], 3, "jump requires a two-layer body"),
        (["shafter_1989", "--solver", "uplift", "--width", "1", "--height", "3"], 3, "spring stiffness required"),
        (
            ["shafter_1989", "--block", "gravestone", "--frequency-vertical", "8"],
            2,
            "--frequency-vertical requires --solver uplift: omit it",
        ),
    ],
)
def test_map_reports_bad_input_in_one_sentence(words, code, says, tmp_path):
    """A folder without records, two earthquakes, a body and a cemetery, no friction."""
    (tmp_path / "note.md").write_text("nothing here")
    words = [str(tmp_path) if word == "EMPTY" else word for word in words]
    result = CliRunner().invoke(main, ["map", *words])
    assert result.exit_code == code
    assert says in " ".join(result.stderr.split())


def test_map_lists_the_solvers_that_it_accepts():
    """It listed ``stack`` and refused it."""
    assert list(SOLVERS) == station_solvers()


def test_map_warns_of_records_far_apart_in_time():
    """Two records seven months apart, one without an earthquake: a result with a warning that names the span."""
    result = CliRunner().invoke(main, ["map", "synthetic_jma.csv", "hanmer_springs_2016", "--json"])
    assert result.exit_code == 0 and len(json.loads(result.stdout)["results"]) == 2
    (doubt,) = (warning for warning in json.loads(result.stdout)["warnings"] if "days apart" in warning)
    assert doubt.startswith("the records begin 212 days apart, 2016-04-16 01:25:00 JST (SYN") and "2016-11-1" in doubt
    assert "a map requires records of one earthquake" in " ".join(result.stderr.split())
    single = CliRunner().invoke(main, ["map", "hanmer_springs_2016", "elcentro_1940_ns"])
    assert single.exit_code == 0 and "days apart" not in single.stderr


@pytest.mark.parametrize(
    ("words", "says", "heads"),
    [
        ("--solver rock --block gravestone --runs 3", "gravestone: stays at 1 of 1 station", "class over- turns worst samples"),
        ("--solver slide --mu 0.1", "object: slides at 1 of 1 station", "slides disp."),
        ("--solver jump --body chozusha --mu 0.18", "chozusha: jumps at 0 of 1 station", "jumps over- turns disp."),
        ("--solver uplift --width 1.2 --height 3 --frequency-vertical 8", "block 1.2 x 3 m: uplift at 1 of 1 station", "uplift"),
    ],
)
def test_map_states_outcome_of_every_solver(words, says, heads, monkeypatch):
    """The map has verdict, subject and papers; a name of several words breaks between words only."""
    monkeypatch.setenv("COLUMNS", "80")
    result = CliRunner().invoke(main, ["map", "hanmer_springs_2016", *words.split()])
    assert result.exit_code == 0 and says in result.stdout, result.stderr
    assert all(word in result.stdout for word in (*heads.split(), "Emergency"))
    output = json.loads(CliRunner().invoke(main, ["map", "hanmer_springs_2016", *words.split(), "--json"]).stdout)
    assert output["parameters"]["solver"] == words.split()[1] and set(papers(*get_solver(words.split()[1]).topics)) <= set(
        output["citations"]
    )


def test_words_of_a_class_are_not_broken_at_80_columns(monkeypatch):
    """Headline, note and the cell of the class hold the whole word, the station's name, too."""
    monkeypatch.setenv("COLUMNS", "80")
    line = "map hanmer_springs_2016 --target-pga 900 --block gravestone --mu 0.5 --runs 8"
    text = CliRunner().invoke(main, line.split()).stdout
    assert text.count("overturns") == 3 and "Emergency" in text.split("station ", 1)[1]


def test_map_states_floor_motion():
    """Processing of each record stands in the document and in the points."""
    words = ["map", "hanmer_springs_2016", "--floor", "T=0.5", "--scale", "2", "--json"]
    (entry,) = json.loads(CliRunner().invoke(main, words).stdout)["results"]
    assert entry["history"].startswith("scaled by 2; floor motion T 0.5 s")


def test_map_figure_requires_coordinates(tmp_path):
    """Stations are drawn where it is known where they are; without any, one sentence."""
    for name, data in station_files(1).items():
        (tmp_path / name).write_bytes(data)
    result = CliRunner().invoke(main, ["map", str(tmp_path / "SYA0010410231756.NS"), "--plot", str(tmp_path / "a.png")])
    assert result.exit_code == 0, result.stderr
    page = CliRunner().invoke(main, ["map", str(tmp_path / "SYA0010410231756.NS"), "--html", str(tmp_path / "a.html")])
    assert page.exit_code == 0 and "SYA001" in (tmp_path / "a.html").read_text(encoding="utf-8")
    assert (tmp_path / "a.png").stat().st_size > 10_000
    words = ["--plot", str(tmp_path / "b.svg"), "--html", str(tmp_path / "b.html"), "--csv", str(tmp_path / "b.csv")]
    refused = CliRunner().invoke(main, ["map", "elcentro_1940_ns", *words])
    assert (refused.exit_code, list(tmp_path.glob("b.*"))) == (3, [])
    assert "no station has coordinates" in refused.stderr


def test_map_includes_surveys_and_contradictions(tmp_path):
    """Table, document, points, figure and page tell of surveyed cemeteries; contradictory pairs are named."""
    for name, data in station_files(1, place=EPICENTRE).items():
        (tmp_path / name).write_bytes(data)
    (tmp_path / "surveys.csv").write_text("place,latitude,longitude,stones,fallen\n光明寺,37.3,138.9,100,1\n", encoding="utf-8")
    words = ["map", str(tmp_path / "SYA0010410231756.NS"), "--survey", str(tmp_path / "surveys.csv")]
    words += ["--geojson", str(tmp_path / "a.geojson"), "--html", str(tmp_path / "a.html"), "--plot", str(tmp_path / "a.png")]
    result = CliRunner().invoke(main, [*words, "--json"])
    assert result.exit_code == 0, result.stderr
    document = json.loads(result.stdout)
    (survey,) = document["surveys"]
    assert (survey["place"], survey["stones_count"], survey["fallen_count"]) == ("光明寺", 100, 1)
    assert survey["neighbours"][0]["station"] == "SYA001"
    assert "光明寺 and station SYA001" in document["contradictions"][0]
    point = json.loads((tmp_path / "a.geojson").read_text(encoding="utf-8"))["features"][-1]
    assert (point["geometry"]["coordinates"], point["properties"]["place"]) == ([138.9, 37.3], "光明寺")
    assert "inconsistent" in (tmp_path / "a.html").read_text(encoding="utf-8")
    output = " ".join(CliRunner().invoke(main, words[:4]).stdout.split())
    assert "Surveyed cemeteries" in output and "光明寺" in output and "inconsistent" in output


def test_map_states_scaling_everywhere():
    """The table, stderr and the parameters say that the records are scaled."""
    words = ["map", "hanmer_springs_2016", "--scale", "4"]
    answer = CliRunner().invoke(main, words)
    assert "records scaled by 4" in answer.stdout and "records scaled by 4" in answer.stderr
    parameters = json.loads(CliRunner().invoke(main, [*words, "--json"]).stdout)["parameters"]
    assert (parameters["scale"], parameters["target_pga_m_s2"], parameters["target_jma_intensity"]) == (4.0, None, None)
    assert "scaled" not in CliRunner().invoke(main, words[:2]).stdout


def test_map_first_line_is_class_and_probability(map_result):
    """The sentence names the most severe class, the number of its stations, and the largest probability."""
    result, folder = map_result
    entries = json.loads(result.stdout)["results"][:6]
    words = ["map", str(folder / "event.knt.tar.gz"), "synthetic_jma", "--block", "gravestone", "--mu", "0.5", "--runs", "10"]
    answer = CliRunner().invoke(main, words)
    likely = sum(entry["assessment"]["class"] == "likely overturns" for entry in entries)
    assert answer.stdout.startswith(f"gravestone: likely overturns at {likely} of 6 stations")
