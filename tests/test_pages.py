"""The lines of README.md and of docs/ print, compute and draw what the pages show; those that are shown only could be typed."""

import importlib
import re

import click
import pytest

from seisblock.cli import COMMANDS, main
from tests.pages import FENCED, PAGES, ROOT, changed_figures, lines_of, matches, page_differences

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("computed_once")]  # a page and its Japanese one print the same results

ELSEWHERE = {"docs/tutorials/from_records_to_a_frequency.md"}
"""A page whose lines take seconds each, and lead to files that a test of its own looks at."""

LANGUAGES = {"console", "python", "sh", "toml", "jinja"}
FILE_OF_A_RECIPE = "# seisblock/"
"""Head of a block that is a file; tests/architecture/test_recipes.py runs these."""

RECIPES = {name for name, page in PAGES.items() if f"```python\n{FILE_OF_A_RECIPE}" in page.read_text("utf-8")}
RUN = {name for name, page in PAGES.items() if {"console", "python"} & {kind for kind, _ in FENCED.findall(page.read_text("utf-8"))}}


@pytest.mark.parametrize("name", sorted(RUN - ELSEWHERE - RECIPES))
def test_page_output_equals_program(name, tmp_path, monkeypatch):
    """Outputs and figures on the pages equal those of the program at 80 columns."""
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.chdir(tmp_path)
    assert page_differences(PAGES[name]) == []
    assert changed_figures(PAGES[name], tmp_path) == []


def test_page_lines_are_all_recognised():
    """Every kind of line occurs, and only kinds that are checked."""
    kinds = {kind for page in PAGES.values() for kind, _ in FENCED.findall(page.read_text("utf-8"))}
    assert {"console", "python", "sh"} <= kinds <= LANGUAGES
    blocks = [block for page in PAGES.values() for kind, block in FENCED.findall(page.read_text("utf-8")) if kind == "python"]
    assert [block for block in blocks if not block.startswith((">>> ", FILE_OF_A_RECIPE))] == []


@pytest.mark.parametrize("name", sorted(PAGES.keys() - RECIPES))
def test_shown_commands_and_options_exist(name):
    """Every command and option of a page exists, those that are shown only and those in a sentence too."""
    text = PAGES[name].read_text(encoding="utf-8")
    items = [line.split(" #")[0] for kind, block in FENCED.findall(text) if kind == "sh" for line in block.splitlines()]
    mask = [line for line in (*items, *re.findall(r"`([^`\n]+)`", text)) if re.search(r"(^|&& )seisblock [a-z]", line)]
    for line in mask:
        command, *words = line[line.index("seisblock ") :].split(" | ")[0].split()[1:]
        assert command in COMMANDS, line
        expected = {
            name for param in main.get_command(click.Context(main), command).params for name in (*param.opts, *param.secondary_opts)
        }
        assert {word.split("=")[0] for word in words if re.match(r"--?[a-z]", word)} <= expected | {"--help"}, line


def test_page_comparison_detects_changes():
    """A line of another number is another line; dots stand for any lines, not for parts of one."""
    assert matches("NS: falls\n...\nend", "NS: falls\na\n\nb\nend")
    assert matches("NS: falls\n...", "NS: falls\na")
    assert not matches("NS: falls\n...\nend", "NS: stands\na\nend")
    assert not matches("NS: falls ... 3", "NS: falls 1 3")
    assert lines_of("$ seisblock a\nx  \n\n$ seisblock b\n")[0].output == "x"


def test_fractions_of_two_digits_are_halves(monkeypatch):
    r"""``\tfrac12 W`` was written as 12 over W on the page of `rigid3d`."""
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "_ext"))
    mathml = importlib.import_module("mathml")
    assert "<mfrac><mn>3</mn><mn>2</mn></mfrac>" in "".join(mathml.to_mathml(r"\frac32 x", block=False).split())


def test_gallery_titles_are_unique(monkeypatch):
    """Two entries had the title "Hazard, fragility, and disaggregation ...": a link list that names two things alike."""
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "_ext"))
    titles = re.findall(r"^## (.*)", importlib.import_module("reference").gallery(""), re.M)
    assert len(titles) > 20 and sorted(set(titles)) == sorted(titles)


def test_theme_words_of_japanese_pages_are_japanese(monkeypatch):
    """The site is built in English: the theme wrote "Next" and "Previous" below Japanese pages."""
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    conf, english, japanese = importlib.import_module("conf"), {}, {}
    conf.translate_theme(None, "start/faq", "page.html", english, None)
    conf.translate_theme(None, "ja/start", "page.html", japanese, None)
    assert "_" not in english and [japanese["_"](text) for text in ("Next", "Previous")] == ["次へ", "前へ"]
