"""``seisblock report``: one page with everything about a record and some bodies, in two languages, that fetches nothing."""

import json
import re
import shutil
import subprocess
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.bodies.factory import load_block
from seisblock.bodies.two_layer import load_contact
from seisblock.cli import main
from seisblock.core.i18n import use_locale
from seisblock.measures import measure
from seisblock.models.jump.chain import ChainOutcome
from seisblock.models.respond import solve_respond
from seisblock.models.rock.solve import solve_rock
from seisblock.output.figures.heading import heading
from seisblock.output.figures.svg import MAX_POINTS, embed_figure
from seisblock.readers import read
from seisblock.records import Preparation, motion_of
from seisblock.records.process import crop
from seisblock.report.figures.measure import measure_figure
from seisblock.report.html.report import report
from seisblock.report.html.report_text import verdict
from seisblock.samples import sample_path
from seisblock.studies.report.models import body_models
from seisblock.studies.report.responses import ReportData, collect_responses
from tests.brief_record import brief_record
from tests.i18n.english import english_words, visible_text

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("computed_once")]

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")


@pytest.fixture(scope="module")
def pages():
    """The page of a window of the bundled record, in both languages, with all four kinds of motion."""
    bodies = [body_models("gravestone"), body_models("chozusha", frequency_vertical=5.0)]
    result = collect_responses(crop(read("synthetic_jma.csv"), 22, 29), bodies, components=["EW"])
    mapping = {}
    for lang in ("en", "ja"):
        with use_locale(lang):
            mapping[lang] = report(result, command="seisblock report")
    return mapping


def test_report_is_fully_translated(pages):
    """Cards, sentences, tables, captions and provenance; references are quoted."""
    assert not english_words(visible_text(pages["ja"])) and english_words(visible_text(pages["en"]))


def test_report_loads_nothing(pages):
    """Every picture is data, and no style or script comes from elsewhere."""
    for page in pages.values():
        sources = re.findall(r'src="([^"]{0,30})', page)
        assert len(sources) == 7 and all(source.startswith("data:image/svg+xml") for source in sources)
        assert not re.search(r"<link|<script|@import|url\(", page)
        assert len(page) < 4_000_000


def test_report_contents_link_to_every_section(pages):
    """Each entry of the list names a heading of the page, and each heading of the first order is in it."""
    for page in pages.values():
        entries = re.findall(r'<li><a href="#([\w-]+)">(.*?)</a></li>', page)
        assert entries == re.findall(r'<h2 id="([\w-]+)">(.*?)</h2>', page) and len(entries) == 4


def test_friction_given_to_a_report_acts_on_its_jump():
    """`report --mu 0.7` answered the jump with the friction of the file, 0.18."""
    own, given, kinetic = (body_models("chozusha", **values) for values in ({}, {"mu": 0.7}, {"mu_kinetic": 0.1}))
    assert own.contact == load_contact("chozusha")
    assert given.contact == replace(own.contact, mu=0.7, mu_kinetic=0.7)
    assert kinetic.contact == replace(own.contact, mu_kinetic=0.1)
    assert body_models("chozusha", mu=0.1).contact == replace(own.contact, mu=0.1, mu_kinetic=0.1)


@pytest.fixture(scope="module")
def square(tmp_path_factory):
    """Return the response of a square block to an unprocessed record."""
    path = tmp_path_factory.mktemp("record") / "brief.csv"
    path.write_bytes(brief_record())
    return collect_responses(read(path), [body_models("1x1")], components=["EW"])


@pytest.fixture(scope="module")
def page_of_square(square):
    """The page of that, in English, of no command."""
    return report(square)


def test_report_title_has_file_name_without_folder(tmp_path):
    """A record without a station is named by its file, without its folder, in the titles of page and figures."""
    path = tmp_path / "somewhere" / "shaken.csv"
    path.parent.mkdir()
    path.write_text("time (s),NS (gal)\n0.00,0\n0.01,1\n0.02,-1\n0.03,0\n", encoding="utf-8")
    shaken = read(path)
    page = report(collect_responses(shaken, []))
    assert "<h1>Seismic response of unanchored objects: shaken.csv</h1>" in page and "somewhere" not in page
    assert heading(shaken) == "shaken.csv"


def test_report_states_processing_before_outcomes(square, page_of_square):
    """F4: a page of a scaled record begins with the scaling in both languages; that of an unscaled one does not."""
    scaled = collect_responses(Preparation(scale=0.5).apply(square.record), [body_models("1x1")], components=["EW"])
    for lang, text in (("en", "Processing: "), ("ja", "記録の処理：")):
        with use_locale(lang):
            page = report(scaled)
        (line,) = re.findall(rf'<p class="processed">{text}(.*?)</p>', page)
        assert "0.5" in line and page.index(line) < page.index('<div class="verdicts">')
    assert 'class="processed"' not in page_of_square


def test_report_provenance_from_python_is_reproducible(square, page_of_square, pages, monkeypatch):
    """F4: the page names the command that it is given, or none, independent of how the process was started."""
    monkeypatch.setattr("sys.argv", ["/home/somebody/notebook.py", "--secret"])
    page = report(square)
    assert "notebook.py" not in page and "<dd>none (called from Python)</dd>" in page
    assert page == page_of_square
    assert "<dd>seisblock report</dd>" in pages["en"]


def test_report_figure_keeps_extremes():
    """A curve of 30 000 points in a page holds few of them, the extremes among them."""
    record = read("synthetic_jma.csv")
    figure = measure_figure(record, measure(record))
    lines = [line for axis in figure.axes for line in axis.lines]
    for line in lines:
        line.axes.set_xlim(auto=True)
    before = [(np.nanmin(line.get_ydata()), np.nanmax(line.get_ydata())) for line in lines]
    assert max(len(line.get_xdata()) for line in lines) > MAX_POINTS
    fig = embed_figure(figure, "the record").source
    assert fig.startswith("data:image/svg+xml") and len(fig) < 900_000
    assert [(np.nanmin(line.get_ydata()), np.nanmax(line.get_ydata())) for line in lines] == before
    assert max(len(line.get_xdata()) for line in lines) <= MAX_POINTS + 4


@pytest.mark.skipif(CHROMIUM is None, reason="no browser is installed")
@pytest.mark.parametrize("lang", ["en", "ja"])
def test_report_fits_390_px(pages, lang, tmp_path):
    """F4: in a frame 390 px wide nothing is wider, but in a box of its own, and no word stands letter above letter."""
    path, frame = tmp_path / "report.html", tmp_path / "frame.html"
    probe = """<script>onload = () => {
      const { clientWidth, scrollWidth } = document.documentElement, all = [...document.querySelectorAll("body *")];
      const wider = all.filter(e => e.getBoundingClientRect().right > clientWidth + 1 && !e.closest(".wide"));
      const narrow = [...document.querySelectorAll("td.text")].filter(e => e.clientWidth < 4 * parseFloat(getComputedStyle(e).fontSize));
      parent.postMessage([innerWidth, scrollWidth <= clientWidth, wider.length, narrow.length].join(), "*");
    }</script>"""
    assert "<h1>" in pages[lang]
    # station names without a blank
    page = pages[lang].replace("<h1>", f"<h1>{'Kahramanmaras_Pazarcik_Turkiye_' * 2} ")
    path.write_text(page + probe, encoding="utf-8")
    frame.write_text(
        "<script>onmessage = event => { document.title = event.data }</script>"
        '<iframe src="report.html" style="width: 390px; height: 844px; border: 0"></iframe>',
        encoding="utf-8",
    )
    options = ["--headless=new", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files", "--virtual-time-budget=4000"]
    command = [CHROMIUM, *options, f"--user-data-dir={tmp_path}/profile", "--dump-dom", frame.as_uri()]
    result = subprocess.run(command, capture_output=True, text=True, check=True, timeout=600)
    assert "<title>390,true,0,0</title>" in result.stdout


def test_report_has_viewport_and_print_style(pages):
    """The page adapts to the width of the device and has a print style."""
    assert 'name="viewport"' in pages["en"] and "@media print" in pages["en"]
    assert '<html lang="en">' in pages["en"] and '<html lang="ja">' in pages["ja"]


def test_report_has_every_section(pages):
    """Record, measures, rocking, criteria, sliding, jump, uplift, provenance."""
    for names in (
        "Ground motion record",
        "gravestone",
        "Chozu-sha, short side",
        "Full response",
        "Idealised models (single mode each)",
        "Rocking and overturning",
        "Overturning criteria and simulation",
        "Sliding",
        "Jump of the two-layer block",
        "Uplift on corner springs",
        "Provenance",
    ):
        assert re.search(rf"<h[23][^>]*>{re.escape(names)}</h[23]>", pages["en"]), names
        assert re.search(rf"<h[23][^>]*>{re.escape(names)}</h[23]>", pages["ja"]) is None


def test_report_states_digest_format_and_citations(pages):
    """Digest, format, processing, citations."""
    record = read(sample_path("synthetic_jma.csv"))
    assert record.sha256 in pages["en"] and "JMA-CSV" in pages["en"]
    for key in ("Sugimoto, K.", "Fujino, Y.", "Okumura, T.", "Housner, G. W.", "Furukawa, A."):
        assert key in pages["en"]


def test_report_outcome_equals_solve_rock(pages):
    """The gravestone overturns as in solve_rock, with the margin beside it."""
    outcome = solve_rock(load_block("gravestone"), motion_of(crop(read("synthetic_jma.csv"), 22, 29), "EW")).outcome
    assert outcome.overturned
    assert f"overturning to {outcome.overturned_towards[0]}EW at {outcome.overturning_time_s:.2f}\xa0s" in pages["en"]
    assert re.search(r"Nearest scale factor at which the result changes: \d\.\d{3}", pages["en"])
    assert "転倒する最小の倍率：" in pages["ja"]


def test_report_card_states_best_estimate(pages):
    """The probability first; verdict and share are those of respond; the idealised models stand below, with the factors of their onset."""
    cards = re.findall(r'<div style="border-left-color: #[0-9a-f]{6}"><b>(.*?)</b><span>(.*?)</span></div>', pages["en"])
    assert [head.split(":")[0] for head, _ in cards] == ["gravestone, EW", "Chozu-sha, short side, EW"]
    motion = motion_of(crop(read("synthetic_jma.csv"), 22, 29), "EW")
    outcome = solve_respond(load_block("gravestone"), motion, mu=0.438).outcome
    assert re.match("gravestone, EW: likely overturns \\(\\d+\xa0%; factor to overturning .* by model\\)", cards[0][0])
    assert f"overturns to -EW at {outcome.overturning_time_s:.2f}\xa0s" in cards[0][1] and outcome.overturned
    assert re.search("Overturning probability \\d+\xa0% \\(95\xa0% CI .*, 200 samples\\)", cards[0][1]) and "slides" in cards[1][1]
    page = pages["en"]
    assert page.index("Full response") < page.index("Idealised models") < page.index("<h3>Rocking and overturning</h3>")
    assert re.search(
        r"<td>Sliding</td><td class=\"text\">EW</td><td class=\"text\">maximum sliding displacement \d+\.\d\xa0cm</td><td>0\.\d\d</td>",
        page,
    )


def test_report_card_states_assumed_friction(tmp_path):
    """With sizes alone the card states the assumed friction."""
    page = tmp_path / "report.html"
    answer = CliRunner().invoke(main, ["report", "elcentro_1940_ns.csv", "--body", "0.3x1.2", "-o", str(page), "--quiet"])
    assert answer.exit_code == 0, answer.stderr
    assert "Friction coefficient assumed: 1.07 (none given" in page.read_text(encoding="utf-8")


def test_report_rejects_bad_input_in_one_sentence(tmp_path):
    """Bodies that are none, several records, a missing directory."""
    page = str(tmp_path / "report.html")
    for words in (["--body", "nosuch"], ["--body", "0cmx10cm"], ["synthetic_jma.csv", "elcentro_1940_ns.csv"], ["--body", "aoyama.csv"]):
        answer = CliRunner().invoke(main, ["report", *words, "-o", page])
        assert answer.exit_code == 3 and answer.stderr.splitlines()[-1].startswith("seisblock: ")
    assert CliRunner().invoke(main, ["report", "--body", "1x2", "-o", str(tmp_path / "no" / "r.html"), "--quiet"]).exit_code == 3
    assert list(tmp_path.iterdir()) == []


def test_report_of_single_component_record(tmp_path):
    """Without a vertical component there is no intensity: the page lists the components."""
    page = tmp_path / "report.html"
    answer = CliRunner().invoke(main, ["report", "elcentro_1940_ns.csv", "--body", "0.3x1.2", "--mu", "0.2", "-o", str(page), "--quiet"])
    assert answer.exit_code == 0 and answer.stderr == ""
    assert "JMA intensity" not in page.read_text(encoding="utf-8").split("<footer>")[0].split("data:image")[0]


def test_report_rounds_tiny_jump_without_minus_sign():
    """A body that ends where it stood has moved to neither side, one that ends a hair's breadth to the left has moved."""
    moved = [SimpleNamespace(outcome=ChainOutcome.JUMPED, final_displacement_m=metres) for metres in (-0.0, 0.0, -4e-6, -6e-4)]
    effects = [
        SimpleNamespace(response=SimpleNamespace(model="jump", outcome=outcome, motion=SimpleNamespace(name="NS"))) for outcome in moved
    ]
    assert [verdict(effect) for effect in effects] == [
        *["jump, displacement 0.0 cm"] * 2,
        "jump, displacement less than 0.01 mm to -NS",
        "jump, displacement 0.60 mm to -NS",
    ]


@pytest.fixture(scope="module")
def report_document():
    """Document of two bodies under the bundled record, around its strongest part."""
    answer = CliRunner().invoke(main, ["report", "--body", "gravestone", "--body", "60cmx100cm", "--window", "22:29", "--json"])
    assert answer.exit_code == 0, answer.stderr
    return json.loads(answer.stdout)


def test_report_document_has_assessment_per_body_and_direction(report_document):
    """One result per body and direction, as `respond` assesses it; `object` holds each body under either direction."""
    results = report_document["results"]
    assert [(entry["body"], entry["component"]) for entry in results] == [
        *(("gravestone", name) for name in ("NS", "EW")),
        *(("block 0.6 x 1 m", name) for name in ("NS", "EW")),
    ]
    for body, pair in zip(report_document["object"], (results[:2], results[2:]), strict=True):
        shares = {entry["component"]: entry["assessment"]["overturning_probability"] for entry in pair}
        assert max(shares.values()) <= body["overturning_probability"] <= sum(shares.values()) and body["runs"] == 200
        assert shares[body["direction"]] == max(shares.values())
    words = ["respond", "--block", "gravestone", "--window", "22:29", "--component", "EW", "--json"]
    single = json.loads(CliRunner().invoke(main, words).stdout)["results"][0]
    assert results[1]["assessment"] == single["assessment"]
    assert [model["model"] for model in results[0]["models"]] == ["respond", "rock", "slide"]


def test_report_requires_page_or_json(tmp_path):
    """Without either: a usage error in one sentence. With both, the page and the document."""
    answer = CliRunner().invoke(main, ["report", "--body", "gravestone"])
    assert answer.exit_code == 2 and "requires -o FILE" in answer.stderr


def test_report_prints_one_line_per_body(tmp_path):
    """Stdout names the bundled record, then holds the assessment of each body, the head of its card, too."""
    page = tmp_path / "a.html"
    words = ["report", "--body", "gravestone", "--window", "22:29", "-o", str(page), "--quiet"]
    answer = CliRunner().invoke(main, words)
    record, line = answer.stdout.splitlines()
    assert record == "Record: synthetic_jma.csv (bundled, synthetic); none given."
    assert re.fullmatch(r"gravestone: likely overturns \(\d+.%\); worst direction (NS|EW)", line)
    assert f"<b>{line}.</b>" in page.read_text(encoding="utf-8").replace("\xa0", " ")


def test_warnings_of_several_bodies_name_the_body():
    """Of two bodies, "280: the result is sensitive to the amplitude" did not tell which."""

    def body(name, text):
        return SimpleNamespace(
            subject=SimpleNamespace(name=name), effects=[SimpleNamespace(response=SimpleNamespace(warnings=(text, text)))]
        )

    measures = SimpleNamespace(warnings=("short record",))
    bodies = (body("gravestone", "NS: sensitive"), body("bookcase", "NS: sensitive"))
    assert ReportData(None, measures, bodies[:1], 9.8).warnings == ("short record", "NS: sensitive")
    assert ReportData(None, measures, bodies, 9.8).warnings == ("short record", "gravestone: NS: sensitive", "bookcase: NS: sensitive")
