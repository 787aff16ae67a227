"""One survey sheet gives the same stones, and the same count of fallen ones, in ``overturn-rate``, ``batch`` and ``infer``."""

import csv
import json

import numpy as np
import openpyxl
import pytest
from click.testing import CliRunner

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.table import read_bodies
from seisblock.cli import main
from seisblock.core.errors import BodyError
from seisblock.models.rock.solve import solve_rock
from seisblock.readers import read
from seisblock.records import motion_of
from seisblock.records.process import scale
from seisblock.report.figures.cemetery import overturn_rate_figure
from seisblock.studies.survey.assessment import AssessmentMethod, assess_record
from seisblock.studies.survey.shaking import component_shakings

WIDTHS, COUNT, PGA = (21.2, 24.2, 27.3, 30.3), 40, 400.0
JAPANESE, ENGLISH = ("番号", "幅(cm)", "高さ(cm)", "転倒", "備考"), ("name", "width (cm)", "height (cm)", "fallen", "remark")


def sheet_rows():
    """Return number, width, height, outcome and remark of 40 stones; the slender ones fell, with some scatter."""
    rng = np.random.default_rng(4)
    ratios = rng.uniform(1.8, 4.2, COUNT)
    fell = ratios + rng.normal(0.0, 0.4, COUNT) > 2.9
    sizes = [(WIDTHS[number % 4], round(WIDTHS[number % 4] * ratio, 1)) for number, ratio in enumerate(ratios)]
    return [(number, b, h, bool(f), "御影石") for number, ((b, h), f) in enumerate(zip(sizes, fell, strict=True), start=1)]


def write_csv(path, heading, words, encoding):
    """Write the sheet as CSV."""
    rows = [heading, *((n, b, h, words[f], remark) for n, b, h, f, remark in sheet_rows())]
    path.write_text("\n".join(",".join(map(str, row)) for row in rows) + "\n", encoding=encoding)


def write_workbook(path, heading, words):
    """Write the sheet as a workbook with a title, an empty row, and units on a second line of the heading."""
    book = openpyxl.Workbook()
    book.active.append(["○○墓地 調査票"])
    book.active.append([])
    book.active.append([cell.replace("(cm)", "\n（ｃｍ）") for cell in heading])
    for n, b, h, f, remark in sheet_rows():
        book.active.append([n, b, h, words[f], remark])
    book.save(path)


@pytest.fixture
def sheets(tmp_path, monkeypatch):
    """Return the same sheet in four files."""
    monkeypatch.chdir(tmp_path)
    write_csv(tmp_path / "墓石.csv", JAPANESE, ("残存", "転倒"), "cp932")
    write_csv(tmp_path / "bom.csv", JAPANESE, ("×", "○"), "utf-8-sig")
    write_csv(tmp_path / "english.csv", ENGLISH, ("no", "yes"), "utf-8")
    write_workbook(tmp_path / "墓石.xlsx", JAPANESE, ("残存", "転倒"))
    return ["墓石.csv", "bom.csv", "english.csv", "墓石.xlsx"]


def document(*words):
    """Return the JSON document of a command."""
    result = CliRunner().invoke(main, [*map(str, words), "--json", "--quiet"])
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


def test_sheet_gives_same_stones_in_every_format(sheets):
    """Sizes, outcomes and edges: as gravestones of a cemetery and as bodies of a list."""
    first = read_cemetery(sheets[0])
    assert [(s.name, s.width, s.fallen) for s in first.stones] == [(str(n), pytest.approx(b / 100), f) for n, b, _, f, _ in sheet_rows()]
    for name in sheets:
        stones, bodies = read_cemetery(name).stones, read_bodies(name)
        assert [(s.name, s.width, s.height, s.fallen) for s in stones] == [(s.name, s.width, s.height, s.fallen) for s in first.stones]
        assert [(b.name, b.parameters["width"]) for b in bodies] == [(s.name, s.width) for s in stones]
        assert {b.parameters["kind"] for b in bodies} == {"gravestone"}


def test_commands_count_the_same_stones(sheets, tmp_path):
    """Objects, not components: what `overturn-rate` computes, `batch` lists and an independent loop over single runs finds."""
    record = scale(read("synthetic_jma.csv"), PGA / 962.39)
    expected = [
        any(solve_rock(Block(b / 100, h / 100).with_wear(0.05), motion_of(record, code)).outcome.overturned for code in ("NS", "EW"))
        for _, b, h, _, _ in sheet_rows()
    ]
    observed = [f for *_, f, _ in sheet_rows()]
    pairs = list(zip(expected, observed, strict=True))
    contingency = {
        "both": pairs.count((True, True)),
        "computed_only": pairs.count((True, False)),
        "observed_only": pairs.count((False, True)),
        "neither": pairs.count((False, False)),
    }
    assert min(contingency.values()) >= 1
    for name in sheets:
        rate = document("overturn-rate", "--cemetery", name, "synthetic_jma.csv", "--target-pga", PGA)
        assert [result["component"] for result in rate["results"]] == ["NS", "EW", "either"]
        assert [stone["overturns"] for stone in rate["each_stone"]] == expected
        assert [stone["agrees"] for stone in rate["each_stone"]] == [computed == visible for computed, visible in pairs]
        assert rate["contingency"] == rate["results"][-1]["contingency"] == contingency
        assert rate["results"][-1]["fallen"] == sum(expected)
    words = ["batch", "synthetic_jma.csv", "--bodies", "墓石.xlsx", "--solver", "rock", "--target-pga", str(PGA), "--out", "b.csv"]
    assert CliRunner().invoke(main, words).exit_code == 0
    rows = list(csv.DictReader((tmp_path / "b.csv").read_text(encoding="utf-8").splitlines()))
    fallen = {row["body"]: False for row in rows}
    for row in rows:
        fallen[row["body"]] |= row["overturned"] == "True"
    assert list(fallen.values()) == expected
    inferred = document("infer", "--cemetery", "墓石.csv")
    counts = inferred["contingency"]
    assert counts["both"] + counts["observed_only"] == inferred["results"][0]["fallen"] == sum(observed)
    assert len(inferred["each_stone"]) == COUNT


def test_inferred_interval_contains_the_shaking_that_felled_the_stones(sheets, tmp_path):
    """Stones overturned by a record, written by ``--stones`` and read again, give its intensity."""
    document("overturn-rate", "--cemetery", "墓石.csv", "synthetic_jma.csv", "--target-pga", PGA, "--stones", "stones.csv")
    raw = (tmp_path / "stones.csv").read_bytes()
    assert raw.startswith(b"\xef\xbb\xbf")
    rows = list(csv.DictReader(raw.decode("utf-8-sig").splitlines()))
    lines = ["番号,幅(m),高さ(m),転倒"] + [f"{row['id']},{row['width_m']},{row['height_m']},{row['overturns']}" for row in rows]
    (tmp_path / "again.csv").write_text("\n".join(lines), encoding="cp932")
    (first, *_) = document("infer", "--cemetery", "again.csv")["results"]
    measured = document("measure", "synthetic_jma.csv", "--target-pga", PGA)["results"][0]["jma_intensity"]
    low, high = first["jma_intensity_interval"]
    assert low < measured < high


def test_stones_with_counts_are_bodies_one_by_one(tmp_path):
    """A row for three equal stones is three bodies; a ratio alone has the width of the fitted stones; unknown outcomes stay unknown."""
    (tmp_path / "s.csv").write_text("高さ幅比,基数,転倒\n2.5,3,転倒\n3.0,,不明\n", encoding="utf-8")
    bodies, cemetery = read_bodies(tmp_path / "s.csv"), read_cemetery(tmp_path / "s.csv")
    assert [body.name for body in bodies] == ["1-1", "1-2", "1-3", "2"]
    assert len(bodies) == cemetery.size == 4
    assert [body.parameters["height"] for body in bodies] == pytest.approx([2.5 * 0.2424] * 3 + [3.0 * 0.2424])
    assert [stone.fallen for stone in cemetery.stones] == [True, None]


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("old.xls", b"\xd0\xcf\x11\xe0" + b"\0" * 600, "workbook of an old Excel"),
        ("cut.xlsx", b"PK\x03\x04" + b"\0" * 60, "not a readable .xlsx workbook"),
        ("text.xlsx", "幅,高さ\n1,2\n".encode(), "not a readable .xlsx workbook"),
        ("dowel.csv", b"H/B,reinforced\n2.5,1\n", "dowel is not a rigid block"),
    ],
)
def test_unreadable_sheet_is_one_sentence(tmp_path, name, content, message):
    """A damaged or an old workbook, and a stone that is no rigid block."""
    (tmp_path / name).write_bytes(content)
    with pytest.raises(BodyError, match=message) as error:
        (read_bodies if name == "dowel.csv" else read_cemetery)(tmp_path / name)
    assert len(str(error.value)) < 400


def test_figure_separates_hits_and_misses(sheets):
    """A marker for each pair of computed and observed outcome, with its number; one stone is one point."""
    cemetery, method = read_cemetery(sheets[0]), AssessmentMethod("simulate", runs=8)
    record = scale(read("synthetic_jma.csv"), PGA / 962.39)
    rates = assess_record(cemetery, component_shakings(record, ("NS", "EW")), method)
    figure = overturn_rate_figure(cemetery, [(record, rates)], rates[-1].curve)
    left, right = figure.axes[2:4]
    counts = rates[-1].contingency
    sizes = [len(points.get_offsets()) for points in left.collections]
    assert sizes == [len(points.get_offsets()) for points in right.collections]
    assert sizes == [counts.both, counts.computed_only, counts.observed_only, counts.neither]
    threshold, ratio = left.collections[0].get_offsets()[0]
    # a worn base of 0.9 B rocks at 0.9 g B/H
    assert threshold == pytest.approx(0.9 * 980.665 / ratio)


def test_inferred_pga_has_three_digits():
    """280.1 to 1070.1 gal in the first line stated digits that a factor of four between its ends does not have."""
    text = " ".join(CliRunner().invoke(main, ["infer", "--rate", "35/100", "--cemetery", "aoyama.csv"]).stdout.split())
    assert text.startswith("aoyama: PGA 455 gal (280 to 1070, 90 % interval) at 0.5-3 Hz")
