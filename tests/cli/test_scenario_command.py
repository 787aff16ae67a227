"""Commands ``scenario`` and ``secure``: from a spreadsheet to table, file, page and document."""

import csv
import json
import re

import pytest
from click.testing import CliRunner

from seisblock.bodies.table import read_body_list
from seisblock.cli import main
from seisblock.cli.secure import _choose_body
from seisblock.report.figures.probability import share_colour

pytestmark = pytest.mark.usefixtures("computed_once")

TABLE = "名称,幅(cm),奥行(cm),高さ(cm),質量(kg),種類\n仏像,40,35,120,80,\n=本棚,90,30,180,,bookcase\n壺,25,25,30,8,\n"
SHORT = ("synthetic_jma.csv", "--window", "25:30")


def run(*args):
    """Return the result of a command line."""
    return CliRunner().invoke(main, list(map(str, args)))


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "収蔵 品.csv"
    path.write_text(TABLE, encoding="cp932")
    return path


def test_scenario_writes_document_csv_and_page_of_a_spreadsheet(table, tmp_path):
    page, rows = tmp_path / "頁.html", tmp_path / "rows.csv"
    result = run("scenario", *SHORT, "--jma", "6強", "--bodies", table, "--json", "--html", page, "--csv", rows)
    assert result.exit_code == 0, result.output
    document = json.loads(result.stdout)
    assert document["schema"] == "seisblock/scenario/1"
    assert document["parameters"]["jma_intensity"] == 6.25
    shares = [entry["overturning_probability"] for entry in document["results"]]
    assert shares == sorted(shares, reverse=True)
    assert {entry["body"] for entry in document["results"]} == {"仏像", "=本棚", "壺"}
    assert all(entry["class"] and entry["advice"] for entry in document["results"])
    assert rows.read_bytes().startswith(b"\xef\xbb\xbf")
    text = list(csv.DictReader(rows.read_text(encoding="utf-8-sig").splitlines()))
    assert [row["body"].lstrip("'") for row in text] == [entry["body"] for entry in document["results"]]
    # a formula of a spreadsheet stays text
    assert "'=本棚" in [row["body"] for row in text]
    html = page.read_text(encoding="utf-8")
    cards = re.findall(r'<section style="border-left-color: (#[0-9a-f]{6})">', html)
    assert cards == 2 * [share_colour(share) for share in shares] and html.count("<section") == 6
    assert 'lang="ja"' in html and 'lang="en"' in html and "likely overturns" in html and "転倒の可能性" in html
    assert "<script" not in html and "http" not in html.replace("http://www.w3.org", "")


def test_scenario_scales_the_record_to_pga_and_pgv_before_the_floor():
    result = run("scenario", "synthetic_jma.csv", "--pga", "300", "--frequency", "1.5", "--bodies", "statue", "--floor", "T=0.5", "--json")
    assert result.exit_code == 0, result.output
    parameters = json.loads(result.stdout)["parameters"]
    assert parameters["pgv_m_s"] == pytest.approx(3.0 / (2 * 3.141592653589793 * 1.5))


def test_scenario_names_the_floor_in_its_first_line_and_notes():
    line = ("scenario", "--jma", "5-", "--records", "10", "--bodies", "display_case", "--floor", "T=0.5,height=0.8")
    floor = "floor motion T 0.5 s, damping 0.05, height ratio 0.8"
    assert f"JMA intensity 4.75 (class 5-), {floor}, 1 object:" in " ".join(run(*line, "--quiet").stdout.split())
    assert json.loads(run(*line, "--json").stdout)["notes"][-1].endswith(f"{floor}: the intensity is that of the ground")
    record = run("scenario", *SHORT, "--bodies", "display_case", "--floor", "T=0.5", "--quiet")
    assert record.stdout.startswith("SYN, floor motion T 0.5 s, damping 0.05, 1 object:")


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("--target", "0"), "the target probability must lie in (0, 1)"),
        (("--restraint-height", "0"), "the height of the restraint must be positive"),
    ],
)
def test_secure_rejects_numbers_before_it_generates_records(args, message):
    result = run("secure", "--jma", "6-", "--block", "bookcase", *args)
    assert result.exit_code == 3 and message in result.stderr and "records" not in result.stderr


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("--bodies", "statue"), "scenario required"),
        (("--bodies", "statue", "--jma", "6+", "--mu", "-0.2"), "mu must be zero or more"),
        (("--bodies", "statue", "--jma", "6+", "--pga", "400"), "one intensity"),
        (("--bodies", "statue", "--jma", "6+", "--target-pga", "400"), "--target-pga"),
        (("--bodies", "statue", "--pga", "nan"), "--pga"),
        (("--bodies", "statue", "--sa", "x"), "--sa"),
        (("--bodies", "statue", "--jma", "8弱"), "JMA intensity"),
        (("--bodies", "nobody.csv", "--jma", "6+"), "nobody.csv"),
        (("--bodies", ".", "--jma", "6+"), ""),
        (("--bodies", "statue", "--frequency", "2"), "--frequency requires --pga"),
        (("synthetic_jma.csv", "--records", "20", "--bodies", "statue"), "--records"),
        (("--bodies", "statue", "--jma", "6+", "--highpass", "0.1"), "--highpass"),
    ],
)
def test_scenario_rejects_bad_input_in_a_sentence(args, message):
    result = run("scenario", *args)
    assert result.exit_code in (2, 3)
    assert message in result.stderr.replace("\n", " ")
    assert "Traceback" not in result.stderr


@pytest.mark.slow
@pytest.mark.usefixtures("few_runs")
def test_secure_writes_document_and_rejects_scans():
    line = ("secure", *SHORT, "--jma", "6-", "--width", "30cm", "--height", "150cm", "--mu", "0.5", "--target", "10%")
    result = run(*line, "--json")
    assert result.exit_code == 0, result.output
    entry = json.loads(result.stdout)["results"][0]
    assert entry["target_probability"] == 0.1
    assert [item["measure"] for item in entry["measures"]] == ["width", "height", "base_mass", "friction", "inset", "restraint"]
    units = {item["measure"]: item["unit"] for item in entry["measures"]}
    # the mass is unknown: ballast and force are multiples of mass and weight
    assert units == {"width": "m", "height": "m", "base_mass": "1", "friction": "1", "inset": "m", "restraint": "1"}
    for item in entry["measures"]:
        assert item["value"] is None or item["overturning_probability"] <= 0.1
    assert "measures require a block" in " ".join(run("secure", "--jma", "6-", "--block", "boulder", "--mu", "0.5").stderr.split())


def test_scenario_states_what_varies_from_run_to_run(tmp_path):
    """A width that met the target in `secure` had another probability in `respond`, and neither output told why."""
    (tmp_path / "list.csv").write_text("name,width,height,mu\nshelf,0.3,0.4,0.3\n")
    line = ("scenario", *SHORT, "--bodies", tmp_path / "list.csv", "--json")
    scaled, unscaled = (json.loads(run(*line, *args).stdout)["notes"][0] for args in (("--jma", "5-"), ()))
    assert scaled.startswith("runs vary the object") and "not the shaking; those of respond also vary amplitude ±10 %" in scaled
    assert "and the shaking (amplitude ±10 %, azimuth ±10°), as those of respond" in unscaled


@pytest.mark.slow
@pytest.mark.usefixtures("few_runs")
def test_measures_for_a_pile_are_said_to_be_those_of_one_block():
    """A lantern of six stones needed "no measure"; the document of `secure` had no note, and no friction where one was given."""
    line = ("--jma", "6-", "--records", "10")
    (entry,) = json.loads(run("scenario", *line, "--bodies", "lantern", "--json").stdout)["results"]
    (advice,) = entry["advice"]
    assert entry["class"] == "stays" and "6 stones" in advice and "seisblock stack" in advice
    result = run("secure", *line, "--block", "lantern", "--mu", "0.6")
    assert result.stdout.startswith("6 stones as one rigid block, lantern")
    document = json.loads(run("secure", *line, "--block", "lantern", "--mu", "0.6", "--json").stdout)
    assert document["results"][0]["stone_count"] == 6 and document["parameters"]["mu"] == 0.6
    assert any("6 stones as one rigid block" in note for note in document["notes"])


@pytest.mark.slow
@pytest.mark.usefixtures("few_runs")
def test_secure_assumes_the_friction_and_gives_the_probability_of_a_scenario(tmp_path):
    path = tmp_path / "list.csv"
    path.write_text("name,width (cm),height (cm),place\nbad,x,1,\nshelf,30,150,hall\n", encoding="utf-8")
    results = json.loads(run("scenario", *SHORT, "--jma", "6-", "--bodies", path, "--json").stdout)["results"]
    assert [(entry["body"], entry["class"] is None) for entry in results] == [("shelf", False), ("bad", True)]
    assert "line 2: width 'x'" in results[1]["failure"]
    for body in (("--bodies", path, "--object", "shelf"), ("--width", "30cm", "--height", "150cm")):
        document = json.loads(run("secure", *SHORT, "--jma", "6-", *body, "--target", "10%", "--json").stdout)
        assert document["results"][0]["overturning_probability"] == results[0]["overturning_probability"]
        assert document["parameters"]["mu"] is None


@pytest.mark.parametrize(("cell", "is_drawn"), [("", True), ("0.2-0.7", False), ("0.3", False)])
def test_secure_knows_a_given_range_from_the_assumed_one(cell, is_drawn, tmp_path):
    """The document of an object with the user's own range 0.2-0.7 gave no friction."""
    (tmp_path / "list.csv").write_text(f"name,width,height,mu\nshelf,0.3,1.5,{cell}\n")
    body, drawn, _ = _choose_body(read_body_list(tmp_path / "list.csv")[0], None, {})
    assert drawn == is_drawn and body.options.mu == pytest.approx({"": 0.4, "0.2-0.7": 0.45, "0.3": 0.3}[cell])


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("--object", "vase"), "--object has no effect without --bodies"),
        (("--bodies", "list.csv"), "give --object with one of their names, vase, bad"),
        (("--bodies", "list.csv", "--object", "cup"), "no object 'cup' in the table"),
        (("--bodies", "list.csv", "--object", "bad"), "line 3: width 'x'"),
        (("--bodies", "list.csv", "--width", "30cm"), "--width has no effect with --bodies"),
    ],
)
def test_secure_rejects_other_than_one_object_in_a_sentence(args, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "list.csv").write_text("name,width (cm),height (cm)\nvase,15,40\nbad,x,1\n", encoding="utf-8")
    result = run("secure", "--jma", "6-", *args)
    assert result.exit_code in (2, 3)
    assert message in " ".join(result.stderr.split())
    assert "Traceback" not in result.stderr


def test_criteria_of_peaks_are_those_of_a_record_with_the_same_peaks():
    peaks = ("--pga", "934.0", "--pgv", "115.9")
    single = json.loads(run("criteria", *peaks, "--block", "gravestone", "--json").stdout)
    assert single["record"] is None and single["results"][0]["suite"] is None
    rows = {row["criterion"]: row for row in single["results"][0]["criteria"]}
    document = json.loads(run("criteria", "synthetic_jma.csv", "--component", "NS", "--block", "gravestone", "--json").stdout)
    for row in document["results"][0]["criteria"]:
        if row["frequency"] in (None, "pga_pgv"):
            assert rows[row["criterion"]]["threshold"] == pytest.approx(row["threshold"], rel=1e-3)
            assert rows[row["criterion"]]["overturns"] == row["overturns"]


def test_rock_with_peaks_says_the_suite_and_writes_its_files(tmp_path):
    figure, rows = tmp_path / "peaks.svg", tmp_path / "rows.csv"
    line = ("rock", "--pga", "400", "--frequency", "1.6", "--width", "24cm", "--height", "72cm", "--plot", figure, "--csv", rows)
    result = run(*line, "--json")
    assert result.exit_code == 0, result.output
    document = json.loads(result.stdout)
    assert document["parameters"]["pgv_m_s"] == pytest.approx(4.0 / (2 * 3.141592653589793 * 1.6))
    assert "scaled to PGA 400 gal" in document["notes"][0]
    assert document["results"][0]["suite"]["records"] == 40
    assert figure.stat().st_size and len(rows.read_text(encoding="utf-8").splitlines()) == 1 + len(document["results"][0]["criteria"])


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("--pga", "400"), "--pga with --pgv"),
        (("--pgv", "40"), "--pga with --pgv"),
        (("--pga", "400", "--pgv", "40", "--frequency", "2"), "excludes --pgv"),
        (("--pga", "400", "--pgv", "40", "--component", "NS"), "--component has no effect"),
        (("--pga", "400", "--pgv", "40", "--vertical", "--mu", "0.4"), "--mu"),
        (("synthetic_jma.csv", "--pga", "400", "--pgv", "40"), "exclude each other"),
        (("--pga", "-1", "--pgv", "40"), "positive"),
        (("--pga", "40", "--pgv", "400"), "check both values"),
    ],
)
def test_peaks_reject_bad_input_in_a_sentence(args, message):
    result = run("rock", *args, "--block", "gravestone")
    assert result.exit_code in (2, 3)
    assert message in result.stderr.replace("\n", " ")
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize("paired", [(), ("--paired",)])
def test_overturn_rate_with_pgv_takes_the_equivalent_frequency(paired):
    line = ("overturn-rate", "--cemetery", "aoyama.csv", "--pga", "400,500", *paired, "--json")
    shares = [entry["rate"] for entry in json.loads(run(*line, "--pgv", "40,50").stdout)["results"]]
    frequencies = [a / (2 * 3.141592653589793 * v) for a, v in ((400, 40), (500, 50))]
    same = [entry["rate"] for entry in json.loads(run(*line, "--frequency", ",".join(map(str, frequencies))).stdout)["results"]]
    if paired:
        assert shares == same and len(shares) == 2
    else:
        assert len(shares) == 4 and (shares[0], shares[3]) == (same[0], same[3])
    assert run(*line, "--pgv", "40", "--frequency", "2").exit_code == 2
    assert run("overturn-rate", "--cemetery", "aoyama.csv", "--pgv", "40").exit_code == 2


@pytest.mark.slow
@pytest.mark.usefixtures("few_runs")
def test_secure_under_a_hazard_gives_the_probability_in_the_period():
    line = ("secure", "--hazard", "synthetic_hazard.csv", "--width", "40cm", "--height", "180cm", "--mu", "0.4", "--json")
    short, long = (json.loads(run(*line, "--target", "20%", "--years", years).stdout) for years in ("10", "50"))
    assert short["parameters"]["hazard"] == "synthetic_hazard.csv"
    now = [document["results"][0]["overturning_probability"] for document in (short, long)]
    # Poisson: the same annual frequency
    assert 1.0 - now[1] == pytest.approx((1.0 - now[0]) ** 5, rel=0.02)
    assert all(m["value"] is None or m["overturning_probability"] <= 0.2 for m in long["results"][0]["measures"])


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("--hazard", "synthetic_hazard.csv", "--jma", "6+"), "--jma has no effect with --hazard"),
        (("synthetic_jma.csv", "--hazard", "synthetic_hazard.csv"), "exclude each other"),
        (("--jma", "6+", "--years", "30"), "--years has no effect without --hazard"),
        (("--hazard", "nowhere.csv"), "nowhere.csv"),
    ],
)
def test_secure_rejects_a_hazard_beside_a_scenario(args, message):
    result = run("secure", *args, "--block", "bookcase")
    assert result.exit_code in (2, 3)
    assert message in result.stderr.replace("\n", " ")
    assert "Traceback" not in result.stderr


def test_scenario_reads_and_writes_workbooks_in_the_language_of_the_call(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    source, target = tmp_path / "台帳.xlsx", tmp_path / "結果.xlsx"
    book = openpyxl.Workbook()
    for row in (["収蔵品台帳"], [], ["名称", "幅（cm）", "奥行（cm）", "高さ（cm）", "種類"]):
        book.active.append(row)
    for row in (["像", "４０", 35, 120, None], [None] * 5, ["本棚A", None, None, None, "bookcase"]):
        book.active.append(row)
    book.active["A4"].value = "=像"
    book.active["A4"].data_type = "s"
    book.save(source)
    result = run("scenario", *SHORT, "--jma", "5弱", "--bodies", source, "--xlsx", target, "--lang", "ja")
    assert result.exit_code == 0, result.output
    rows = list(openpyxl.load_workbook(target).active.iter_rows(values_only=True))
    assert rows[0][:2] == ("物体", "判定") and {rows[1][0], rows[2][0]} == {"=像", "本棚A"}
    assert all(isinstance(row[2], (int, float)) and row[-1].endswith("。") for row in rows[1:])
    assert run("scenario", *SHORT, "--jma", "5弱", "--bodies", source, "--xlsx", tmp_path / "x.csv").exit_code == 3


def test_scenario_counts_one_object_in_the_singular():
    """``1 object``, not ``1 objects``."""
    result = run("scenario", *SHORT, "--jma", "6+", "--bodies", "bookcase", "--quiet")
    assert "(class 6+), 1 object: " in " ".join(result.stdout.split())
