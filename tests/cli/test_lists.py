"""Lists of widths, heights and friction in ``respond`` and ``rock``, and CSV for Excel."""

import csv
import json

import pytest
from click.testing import CliRunner

from seisblock.bodies.table import read_bodies
from seisblock.cli import main
from seisblock.studies.scenario.assess import scenario_bodies

SHORT = ("synthetic_jma.csv", "--window", "24:30", "--runs", "20")


def run(*args):
    """Return the result of a command line."""
    return CliRunner().invoke(main, list(map(str, args)))


def test_respond_with_a_list_of_friction_equals_single_calls(tmp_path):
    line = ("respond", *SHORT, "--width", "45cm", "--height", "150cm", "--target-pga", "500", "--json")
    figure, rows = tmp_path / "friction.svg", tmp_path / "friction.csv"
    result = run(*line, "--mu", "0.2,0.5", "--plot", figure, "--csv", rows, "--excel")
    assert result.exit_code == 0, result.output
    document = json.loads(result.stdout)
    assert [(entry["mu"], entry["component"]) for entry in document["results"]] == [(0.2, "NS"), (0.2, "EW"), (0.5, "NS"), (0.5, "EW")]
    for index, mu in enumerate((0.2, 0.5)):
        single = json.loads(run(*line, "--mu", mu).stdout)
        assert single["object"] == document["object"][index]
        for entry, second in zip(single["results"], document["results"][2 * index : 2 * index + 2], strict=True):
            assert "mu" not in entry
            assert entry == {key: value for key, value in second.items() if key != "mu"}
    assert result.stderr.startswith("body, first of 2: block 0.45 m wide, 1.5 m high; mu 0.2 (as given)")
    assert figure.stat().st_size
    assert rows.read_bytes().startswith(b"\xef\xbb\xbf")
    text = list(csv.DictReader(rows.read_text(encoding="utf-8-sig").splitlines()))
    assert [row["mu"] for row in text] == ["0.2", "0.2", "0.5", "0.5"]


def test_rock_combines_lists_of_width_and_height_in_columns():
    result = run("rock", *SHORT[:3], "--component", "EW", "--width", "20cm,30cm", "--height", "90cm,1.2m", "--perturb", "10")
    assert result.exit_code == 0, result.output
    assert all(text in result.stdout for text in ("B 20 cm", "B 30 cm", "H 90 cm", "H 120 cm", "overturns (%)"))
    names = [("20", "90"), ("20", "120"), ("30", "90"), ("30", "120")]
    document = json.loads(
        run("rock", *SHORT[:3], "--component", "EW", "--width", "20cm,30cm", "--height", "90cm,1.2m", "--perturb", "10", "--json").stdout
    )
    assert [(f"{100 * r['width_m']:g}", f"{100 * r['height_m']:g}") for r in document["results"]] == names


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("--mu", "0.2,0.3", "--three-d"), "three dimensions accept one width, height and friction: give one of each, or --planar"),
        (("--mu", "0.2,0.3", "--component", "all-azimuths"), "all-azimuths"),
        (("--mu", "0.2,0.3", "--animate", "x.gif"), "--animate"),
        (("--mu", "0.2,x"), "list"),
        (("--mu", "0.2,-0.3"), "-0.3"),
        (("--mu", "0.2", "--excel"), "--excel requires --csv"),
    ],
)
def test_respond_rejects_lists_without_effect(args, message):
    result = run("respond", *SHORT, "--block", "bookcase", *args)
    assert result.exit_code in (2, 3)
    assert message in result.stderr.replace("\n", " ")
    assert "Traceback" not in result.stderr


def test_batch_writes_intensity_sizes_and_friction_and_resumes_a_file_for_excel(tmp_path):
    out = tmp_path / "rows.csv"
    line = ("batch", *SHORT[:3], "--bodies", "bookcase", "--solver", "respond", "--mu", "0.4", "--out", out, "--excel")
    assert run(*line).exit_code == 0
    assert out.read_bytes().startswith(b"\xef\xbb\xbf")
    row = next(csv.DictReader(out.read_text(encoding="utf-8-sig").splitlines()))
    measured = json.loads(run("measure", *SHORT[:3], "--json").stdout)["results"][0]
    assert float(row["jma_intensity"]) == pytest.approx(measured["jma_intensity"], abs=1e-12)
    assert (float(row["width_m"]), float(row["height_m"]), float(row["mu"])) == pytest.approx((15 * 0.0254, 71 * 0.0254, 0.4), rel=0.2)
    assert float(row["pga_m_s2"]) > 0.0 and float(row["pgv_m_s"]) > 0.0 and float(row["equivalent_frequency_hz"]) > 0.0
    assert "complete" in run(*line, "--resume").stderr
    assert run(*line[:-3], "--out", tmp_path / "rows.parquet", "--excel").exit_code == 3


def test_answer_states_which_side_lies_along_the_motion():
    """Each component acts along the width: the line of the body names it beside a depth, the help says who turns the body."""
    answer = run("rock", *SHORT[:3], "--width", "90cm", "--height", "1.8", "--depth", "30cm")
    assert "block 0.9 m wide along the motion, 0.3 m deep, 1.8 m high" in " ".join(answer.stderr.split())
    for command in ("rock", "respond"):
        text = " ".join(run(command, "--help").stdout.split())
        assert "horizontal component acts along the width; seisblock scenario turns the object" in text


def test_piles_are_named_as_one_block(tmp_path):
    """A gravestone of five stones slid as a whole and stood, while its upper stone fell alone in `stack`: the answer says so."""
    note = "5 stones as one rigid block (stones one by one: seisblock stack)"
    answer = run("rock", *SHORT[:3], "--block", "wagata")
    assert f"body: wagata, {note}" in " ".join(answer.stderr.split())
    _, notes = scenario_bodies(read_bodies(["wagata", "bookcase"]))
    assert [str(text) for text in notes] == [f"wagata: {note}"]
    table = run("batch", *SHORT[:1], "--bodies", "wagata", "--solver", "rock", "--out", str(tmp_path / "table.csv"))
    assert f"wagata: {note}" in " ".join(table.stderr.split())
    # the headline itself says whose probability it is; one per direction, and that of the object
    for command in ("rock", "respond"):
        runs = ("--perturb", "10") if command == "rock" else ("--runs", "10")
        lines = run(command, "shafter_1989", "--block", "wagata", *runs).stdout.replace("\xa0", " ").splitlines()
        heads = [line for line in lines if "stays (" in line]
        assert len(heads) == 3 and all(line.startswith("5 stones as one rigid block, ") for line in heads), heads
