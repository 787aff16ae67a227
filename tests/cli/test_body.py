"""`seisblock body` and what takes its file: the arms of the azimuth that is solved, alike in rock, respond, criteria and batch."""

import csv
import json
import sys

import pytest
from click.testing import CliRunner

from seisblock.bodies.block import Block
from seisblock.bodies.factory import load_block
from seisblock.bodies.kinds import KINDS, of_kind
from seisblock.bodies.scan.scan import scan_body
from seisblock.bodies.scan.toml import load_scan
from seisblock.cli import main
from seisblock.samples import sample_path
from tests.bodies.meshes import box, write_stl

pytestmark = pytest.mark.usefixtures("computed_once", "few_runs")

SHORT = ("synthetic_jma.csv", "--window", "24:27")


def run(*words):
    """Return what a command line comes to."""
    return CliRunner().invoke(main, [str(word) for word in words])


def document(*words):
    """Return the document of a command line."""
    answer = run(*words, "--json")
    assert answer.exit_code == 0, answer.stderr
    return json.loads(answer.stdout)


@pytest.fixture(scope="module")
def stone(tmp_path_factory):
    """Return the file of a body that the command wrote: edges 10 mm in, +x to the azimuth of 30 degrees."""
    path = tmp_path_factory.mktemp("stone") / "stone.toml"
    result = run("body", "boulder.ply", "--inset", "10mm", "--facing", "30", "--name", "stone", "--out", path)
    assert result.exit_code == 0 and f"wrote {path}" in result.stderr.replace("\n", "")
    return path


@pytest.fixture(scope="module")
def slab(tmp_path_factory):
    """Return the file of a scan of eight vertices, which three dimensions solve a hundred times as fast as those of the boulder."""
    folder = tmp_path_factory.mktemp("slab")
    assert run("body", write_stl(folder / "slab.stl", *box(0.5, 0.6, 0.9)), "--out", folder / "slab.toml").exit_code == 0
    return folder / "slab.toml"


def test_body_file_equals_library_body(stone):
    """The file holds the body of the library call, to the last digit."""
    scan = scan_body("boulder.ply", facing=30.0, body_name="stone").body
    output = load_scan(stone)
    assert output.inset_m == 0.01
    assert output == scan.with_wear(output.inset)


def test_body_document_csv_and_rock_agree(stone, tmp_path):
    """Alpha and p of each azimuth in JSON, in the CSV, and of the block that rock solves."""
    rows = tmp_path / "azimuths.csv"
    answer = document("body", "boulder.ply", "--inset", "10mm", "--facing", "30", "--step", "90", "--csv", tmp_path / "unused.csv")
    assert run("body", "boulder.ply", "--inset", "10mm", "--facing", "30", "--step", "90", "--csv", rows).exit_code == 0
    with rows.open() as stream:
        values = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]
    (result,) = answer["results"]
    assert values == result["directions"]
    assert [item["azimuth_deg"] for item in values] == [0.0, 90.0, 180.0, 270.0]
    rocked = document("rock", *SHORT, "--component", "EW", "--block", stone)
    block = rocked["parameters"]["block"]
    sides = block["slenderness_right_rad"], block["slenderness_left_rad"]
    assert sides == pytest.approx([values[1]["slenderness_rad"], values[3]["slenderness_rad"]], rel=1e-12)
    assert rocked["results"][0]["slenderness_rad"] == pytest.approx(min(sides), rel=1e-12)
    assert rocked["results"][0]["frequency_parameter_rad_s"] == pytest.approx(
        values[1 if sides[0] <= sides[1] else 3]["frequency_parameter_rad_s"], rel=1e-12
    )


def test_each_component_uses_arms_of_its_azimuth(stone):
    """NS and EW have different arms, shown beside each result; respond and criteria use the same ones."""
    body = load_scan(stone)
    expected = [min(body.block_toward(azimuth).slendernesses) for azimuth in (0.0, 90.0)]
    rocked = document("rock", *SHORT, "--block", stone)["results"]
    assert [min(r["block"]["slenderness_right_rad"], r["block"]["slenderness_left_rad"]) for r in rocked] == pytest.approx(expected)
    stood = document("respond", *SHORT, "--block", stone, "--planar", "--mu", "0.4", "--runs", "0")["results"]
    assert [r["block"] for r in stood] == [r["block"] for r in rocked]
    cards = document("criteria", *SHORT, "--block", stone)["results"]
    assert [card["simulated"]["slenderness_rad"] for card in cards] == pytest.approx(expected)
    assert "alpha (rad)" in run("rock", *SHORT, "--block", stone).stdout
    first = document("rock", *SHORT, "--block", "gravestone")["results"][0]
    assert "block" not in first and "directions" not in first


def test_inset_option_replaces_inset_of_file(stone):
    """Sharp again, or worn more: the polygon within is made anew."""
    sharp, worn = (
        document("rock", *SHORT, "--block", stone, "--component", "0", "--inset", inset)["parameters"]["block"] for inset in ("0", "3cm")
    )
    assert sharp["inset_m"] == 0.0 and sharp["slenderness_right_rad"] > worn["slenderness_right_rad"]
    assert worn["inset_m"] >= 0.03 - 1e-12


@pytest.mark.parametrize("solver", ["rock", "respond"])
def test_batch_of_scan_equals_single_commands(solver, stone, tmp_path):
    """A row of the table is the answer of the solver's own command, for a file and for a row of a table that names it."""
    table, bodies = tmp_path / "table.csv", tmp_path / "bodies.csv"
    bodies.write_text(f"name,body,mu,inset\nas told,{stone},0.4,\nworn,{stone},0.4,2cm\n", encoding="utf-8")
    result = run("batch", *SHORT, "--bodies", bodies, "--solver", solver, "--component", "EW,37", "--out", table)
    assert result.exit_code == 0, result.output
    with table.open() as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 4 and not any(row["failure"] for row in rows)
    friction = ["--planar", "--mu", "0.4", "--runs", "0"] if solver == "respond" else []
    for row in rows:
        inset = ["--inset", "2cm"] if row["body"] == "worn" else []
        (component_result,) = document(solver, *SHORT, "--component", row["component"], "--block", stone, *inset, *friction)["results"]
        for key in ("max_rotation_rad", "max_rotation_ratio", "impacts"):
            assert float(row[key]) == component_result[key], key


def test_batch_of_scan_without_azimuth_fails_its_row_only(stone, tmp_path):
    """A record without an azimuth gives one sentence in its row, and of the single command."""
    record = tmp_path / "record.csv"
    record.write_text("time,a (gal)\n" + "".join(f"{0.01 * i:.2f},{i % 7}\n" for i in range(200)), encoding="utf-8")
    result = run("rock", record, "--block", stone)
    assert result.exit_code == 3 and "depend on the azimuth" in result.stderr.replace("\n", " ")


@pytest.mark.slow
def test_all_azimuths_of_scan_lists_worst_first(slab, tmp_path):
    """The worst direction is the one that is answered, and stands first among all of them; the rose is drawn."""
    for words in (("rock",), ("respond", "--planar", "--mu", "0.2", "--runs", "0"), ("respond", "--mu", "0.2", "--runs", "0")):
        figure = tmp_path / f"{words[0]}.svg"
        line = (words[0], *SHORT, *words[1:], "--block", slab, "--component", "all-azimuths")
        (result,) = document(*line, "--plot", figure)["results"]
        directions = result["directions"]
        in_space = words[0] == "respond" and "--planar" not in words
        assert len(directions) == (72 if in_space else 36) and float(result["component"]) == directions[0]["azimuth_deg"]
        assert result["overturned"] is directions[0]["overturned"]
        assert "maximum displacement (cm)" in figure.read_text() if words[0] == "respond" else figure.exists()
        table = run(*line, "--details").stdout
        assert "All azimuths" in table and f"of {len(directions)} azimuths; results for the worst azimuth." in " ".join(table.split())


def test_body_refuses_to_overwrite_scan(tmp_path):
    """R1: a table of azimuths cannot take the place of the scan; a body needs the name of a body; a folder is none."""
    path = write_stl(tmp_path / "box.stl", *box(0.3, 0.4, 0.9))
    before = path.read_bytes()
    result = run("body", path, "--csv", path)
    assert result.exit_code == 3 and "would overwrite the input file" in result.stderr.replace("\n", " ")
    link = tmp_path / "box.toml"
    link.symlink_to(path)
    result = run("body", path, "--out", link)
    assert result.exit_code == 3 and "would overwrite the input file" in result.stderr.replace("\n", " ")
    assert path.read_bytes() == before
    assert run("body", path, "--out", tmp_path / "none" / "box.toml").exit_code == 3
    assert "must end in .toml" in run("body", path, "--out", tmp_path / "box.stl").stderr


def test_body_without_trimesh_names_extra(monkeypatch):
    """One sentence, and no traceback; the body that was written is read without it."""
    monkeypatch.setitem(sys.modules, "trimesh", None)
    result = run("body", "boulder.ply")
    assert result.exit_code == 3 and "pip install 'seisblock[scan]'" in result.stderr
    assert run("rock", *SHORT, "--block", "boulder").exit_code == 0


def test_scan_rejects_unsupported_solvers():
    """One block for all directions, a jump and a pile: each states the reason."""
    for words in (("report", "-o", "x.html", "--body", "boulder"), ("jump", "--block", "boulder"), ("stack", "--stones", "boulder")):
        result = run(*words)
        assert result.exit_code == 3 and "scan" in result.stderr, words
    assert sample_path("boulder.ply").exists()


FIT = ("fit", "shaken_block.csv", "--free", "inset", "--runs", "1", "--folds", "2", "--scatter", "0.05", "--lapse", "0.02")


@pytest.mark.slow
def test_fit_starts_from_block_of_shaken_azimuth(stone):
    """The arms towards that azimuth."""
    block = document(*FIT, "--block", stone, "--azimuth", "40")["parameters"]["block"]
    expected = load_scan(stone).block_toward(40.0)
    assert block["width_m"] == expected.width and block["centroid_offset_m"] == expected.centroid_offset
    assert block["centroid_inertia_kg_m2"] == pytest.approx(expected.gyration_squared * expected.mass, rel=1e-12)


def test_fit_of_scan_requires_azimuth(stone):
    """Without an azimuth a scan is refused, with one a block is."""
    for words, text in (
        ((stone,), "dimensions depend on the azimuth"),
        (("gravestone", "--azimuth", "3"), "has the same dimensions in all azimuths"),
    ):
        result = run(*FIT, "--block", *words)
        assert result.exit_code == 3 and text in " ".join(result.stderr.split())


@pytest.mark.parametrize("kind", KINDS)
def test_body_of_kind_is_the_body_of_its_sizes(kind, tmp_path):
    """The printed file is the body that --kind with the sizes gives, prior included; an edited range replaces the prior."""
    result = CliRunner().invoke(main, ["body", "--kind", kind, "--width", "24cm", "--height", "72cm"])
    path = tmp_path / "stone.toml"
    path.write_text(result.stdout, encoding="utf-8")
    block, expected = load_block(path), of_kind(Block(0.24, 0.72), kind)
    assert (block.width, block.height, block.inset) == (0.24, 0.72, pytest.approx(expected.inset))
    assert (block.ranges is None) == (expected.ranges is None)
    if expected.ranges is not None:
        assert block.ranges.inset_m == pytest.approx(expected.ranges.inset_m)
        path.write_text(result.stdout.replace('"10%"', '"20%"'), encoding="utf-8")
        assert load_block(path).ranges.inset_m[1] == pytest.approx(0.048)


def test_body_requires_scan_or_kind():
    """Neither, both, or a kind without sizes: a usage error."""
    sizes = ["--kind", "statue", "--width", "1", "--height", "2"]
    for words in ([], ["boulder.ply", "--kind", "statue"], ["--kind", "statue"], [*sizes, "--up", "z"]):
        assert CliRunner().invoke(main, ["body", *words]).exit_code == 2


@pytest.mark.parametrize("words", (["--json"], ["--plot", "stone.png"], ["--csv", "stone.csv"], ["--details"]))
def test_outputs_of_a_scan_are_rejected_with_a_kind(words, tmp_path, monkeypatch):
    """``body --kind`` prints a body file; it wrote no figure and no JSON, without a word."""
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(main, ["body", "--kind", "statue", "--width", "1", "--height", "2", *words])
    assert result.exit_code == 2 and f"{words[0]} has no effect with --kind" in " ".join(result.stderr.split())
    assert not list(tmp_path.iterdir())
