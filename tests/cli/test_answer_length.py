"""Default answers fit a screen of 40 lines of 80 columns; ``--details`` prints the whole result."""

import functools
import json

import pytest
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from click.testing import CliRunner

from seisblock.cli import COMMANDS, locale, main
from seisblock.cli.command import SHARED_ESSENTIAL
from seisblock.cli.console import print_tables
from seisblock.core import i18n
from seisblock.output.text.tables import Part, details, shortened_answer, styled_line, table, whole_answer
from seisblock.output.text.wrap import display_width
from tests.i18n.english import english_words

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("computed_once", "few_runs")]

MAX_LINES, WIDTH = 40, 80

BLOCK = ("--width", "24cm", "--height", "72cm")
HANMER = "hanmer_springs_2016"
RECORDS = ("synthetic_jma.csv", HANMER, "elcentro_1940_ns.csv")

BY_RECORD = (
    ("measure",),
    ("slide", "--mu", "0.2"),
    ("rock", "--block", "gravestone"),
    ("rock", "--block", "gravestone", "--margin"),
    ("jump",),
    ("jump", "--scale", "3", "--tenon", "2cm"),
    ("respond", "--block", "gravestone", "--mu", "0.6", "--runs", "20"),
    ("uplift", *BLOCK, "--frequency-vertical", "8"),
    ("criteria", "--block", "gravestone"),
    ("criteria", "--width", "45cm", "--height", "180cm"),
    ("spectrum",),
    ("spectrum", "--kind", "overturning"),
    ("spectrum", "--kind", "sliding"),
    ("infer", "--slid", "5cm", "--mu", "0.3"),
    ("infer", "--jumped", "20cm"),
    ("map", *BLOCK, "--mu", "0.5", "--runs", "5"),
    ("map", "--cemetery", "aoyama.csv"),
    ("stack", "--stones", "wagata", "--window", "10:11"),
)
"""Lines that take a record."""

BY_STRONG_MOTION = (
    ("spectrum", "--kind", "modes"),
    ("overturn-rate", "--cemetery", "aoyama.csv"),
)
"""Lines that take seconds for a whole record; the answer for a part has as many lines."""

STRONG = {"synthetic_jma.csv": "22:30", HANMER: "45:55", "elcentro_1940_ns.csv": "0:10"}
"""Part of each record with its strong motion."""

LINES = (
    *((line[0], record, *line[1:]) for line in BY_RECORD for record in RECORDS),
    *((line[0], record, *line[1:], "--window", STRONG[record]) for line in BY_STRONG_MOTION for record in RECORDS),
    ("rock", HANMER, "--block", "gravestone", "--component", "all-azimuths"),
    ("respond", HANMER, *BLOCK, "--mu", "0.3", "--runs", "5", "--component", "all-azimuths"),
    ("slide", HANMER, "--mu", "0.1", "--component", "all-azimuths"),
    ("slide", "synthetic_jma.csv", "--mu", "0.05:0.6:0.01", "--slope", "5,10", "--window", "25:28"),
    ("uplift", "--harmonic"),
    ("body", "boulder.ply"),
    ("overturn-rate", "--cemetery", "aoyama.csv"),
    ("overturn-rate", "--cemetery", "aoyama.csv", "--pga", "100:1000:50"),
    ("infer", "--rate", "35/100", "--cemetery", "aoyama.csv"),
    (
        *("fragility", "synthetic_jma.csv", "elcentro_1940_ns.csv", *BLOCK, "--solver", "rock", "--im", "pgv,pga", "--steps", "8"),
        *("--limit", "rock,lean=0.5,overturn", "--perturb", "3", "--bootstrap", "20", "--compare", "50,0.4"),
    ),
    ("risk", "--median", "60cm/s", "--beta", "0.4", "--hazard", "synthetic_hazard.csv", "--stood", "1000"),
    ("batch", "synthetic_jma.csv", HANMER, "--bodies", "gravestone", "--solver", "rock", "--force", "--out", "FOLDER/table.csv"),
    ("report", "synthetic_jma.csv", "--window", "25:28", "--output", "FOLDER/page.html"),
    ("fit", "shaken_block.csv", "--free", "alpha,p"),
    ("validate", "--quick"),
)

FULL = {
    ("jump", "synthetic_jma.csv"): (
        "NS: Chozu-sha, short side, rocking threshold 461.2 gal",
        "EW: Chozu-sha, short side, rocking threshold 461.2 gal",
        " above threshold (s)          0.045    0.141    0.157 ",
        " slide-rock distance (cm)      0.00     0.01     0.00 ",
        "Tenon of 2.00 cm: the lowest foot rises only 0.31 cm (centroid 0.31 cm); the",
    ),
    ("criteria", "synthetic_jma.csv", "--block", "gravestone"): (
        " Ishiyama, velocity                  Ishiyama1982   27.48 kine    4.22 yes ",
        " half sine, linear              Housner1963    2.33 yes    2.51 yes    1.46 yes ",
        "simulation. The thresholds of the lower table are in --csv and --json",
        "EW: overturns in all 5 models; scale factor to overturning 0.33-0.58 (largest ",
    ),
    ("rock", HANMER, "--block", "gravestone", "--margin"): (
        "10: overturning at scale factors 2.0867 to 2.0903, 2.0946 to 2.0977, 2.1019 to ",
        "280: the result changes at a scale factor of 1.3879 (the nearest to 1 found).",
        "280: samples with width and height ±5 %, edge wear 0 to 10 % of the width,",
    ),
    ("rock", HANMER, "--block", "gravestone", "--component", "all-azimuths"): ("All azimuths",),
    ("uplift", "--harmonic"): (
        " second rocking in y-z    1.563    1.563   2.821 ",
        " 0.75    0.4126 ",
        "every 25th of 600 rows; all with --csv or --json",
    ),
    ("body", "boulder.ply"): (" 350           11.03       14.56   0.4385        76.65       4.171        254.8 ",),
    ("spectrum", "synthetic_jma.csv"): ("shown: 12 of 40 2R, 9 of 40 H/B; all in --csv and --json",),
    ("spectrum", HANMER, "--kind", "modes", "--window", STRONG[HANMER]): (" 0.090     sssssssss############################### ",),
    ("overturn-rate", "--cemetery", "aoyama.csv", "--pga", "100:1000:50"): (
        "        350.0     2.50       4.94     5 of 100   0.05   0.02-0.11 ",
    ),
}
"""Lines of the whole result that the shortened answer omits."""


def line_of(parts):
    """Return a command line as text."""
    return " ".join(parts)


@pytest.fixture(scope="module")
def run_in_language(tmp_path_factory):
    """Run a command line in a language with compiled catalogues at a width of 80 columns."""
    folder, content = tmp_path_factory.mktemp("locale"), tmp_path_factory.mktemp("written")
    for catalogue in i18n.LOCALE_DIR.rglob("*.po"):
        target = folder / catalogue.relative_to(i18n.LOCALE_DIR).with_suffix(".mo")
        target.parent.mkdir(parents=True, exist_ok=True)
        with catalogue.open("rb") as source, target.open("wb") as compiled:
            write_mo(compiled, read_po(source))

    @functools.cache
    def run(line, lang="en"):
        words = [word.replace("FOLDER", str(content)) for word in line]
        result = CliRunner().invoke(main, ["--lang", lang, *words], env={"COLUMNS": str(WIDTH)})
        assert result.exit_code == 0, result.output
        return result.stdout

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(i18n, "LOCALE_DIR", folder)
        patch.setattr(locale, "LOCALE_DIR", folder)
        i18n._load_catalogue.cache_clear()
        yield run
    i18n._load_catalogue.cache_clear()


@pytest.mark.parametrize("lang", i18n.LANGUAGES)
@pytest.mark.parametrize("line", LINES, ids=line_of)
def test_default_answer_fits_a_screen(line, lang, run_in_language):
    """No more than 40 lines, each of at most 80 columns, without English in Japanese."""
    answer = run_in_language(line, lang).splitlines()
    assert len(answer) <= MAX_LINES
    assert not [text for text in answer if display_width(text.rstrip()) > WIDTH]
    assert lang == "en" or not english_words("\n".join(answer))


@pytest.mark.parametrize("line", FULL, ids=line_of)
def test_details_print_what_the_default_answer_omits(line, run_in_language):
    """The shortened answer names the option in its last line; the whole one holds the omitted lines."""
    short, full = (run_in_language(words).splitlines() for words in (line, (*line, "--details")))
    # columns move together where a table is wide
    omitted, short_words, full_words = ([text.split() for text in lines] for lines in (FULL[line], short, full))
    assert [words for words in omitted if words not in full_words] == []
    assert not [words for words in omitted if words in short_words]
    assert short[-1] == "more: --details" and short[-1] not in full
    assert short[0] == full[0], "the verdict comes first in both"


def test_answer_without_details_does_not_name_the_option(run_in_language):
    """The option changes nothing where the answer is whole."""
    line = ("slide", "synthetic_jma.csv", "--mu", "0.2")
    assert run_in_language(line) == run_in_language((*line, "--details"))


def test_details_leave_documents_alone(run_in_language, tmp_path):
    """JSON and CSV hold everything without the option."""
    line = ("criteria", "synthetic_jma.csv", "--block", "gravestone", "--csv", str(tmp_path / "rows.csv"), "--json")
    documents, tables = [], []
    for extra in ((), ("--details",)):
        documents.append(json.loads(run_in_language((*line, *extra))))
        tables.append((tmp_path / "rows.csv").read_bytes())
    assert documents[0] == documents[1] and tables[0] == tables[1]


def test_every_command_with_tables_takes_details():
    """The option stands in the short help of all commands with output options, and of validate."""
    commands = {name: main.get_command(None, name) for name in COMMANDS}
    with_gal = {name for name, command in commands.items() if any("--json" in parameter.opts for parameter in command.params)}
    with_details = {name for name, command in commands.items() if any("--details" in parameter.opts for parameter in command.params)}
    assert with_gal - with_details == {"batch", "cite", "fetch", "report", "samples"}, "summaries and lists"
    assert "--details" in SHARED_ESSENTIAL


def test_whole_and_shortened_answer_of_parts():
    """A part in two lengths prints one of them."""
    parts = ["verdict", Part(("long", "table"), ("row",)), details("modes"), "end"]
    assert list(whole_answer(parts)) == ["verdict", "long", "table", "modes", "end"]
    assert [str(part) for part in shortened_answer(parts)] == ["verdict", "row", "end", "more: --details"]
    assert list(shortened_answer(["verdict", "end"])) == ["verdict", "end"]


def test_blank_lines_separate_parts_and_end_no_answer():
    """A blank line between two parts stays, the last one is dropped, also before the hint to --details."""
    parts = ["verdict", styled_line(), "row", Part((styled_line("all"), styled_line()), (styled_line(),))]
    assert [str(part) for part in whole_answer(parts)] == ["verdict", "", "row", "all"]
    assert [str(part) for part in shortened_answer(parts)] == ["verdict", "", "row", "more: --details"]


def test_hint_to_details_follows_a_table_directly(capsys):
    """The blank line under the last table is left out, that above it is not."""
    print_tables([details("modes"), table("title", ["item", "value"], [["row", "1"]])])
    assert [line.strip() for line in capsys.readouterr().out.splitlines()][-3:] == ["\u2500" * 12, "row        1", "more: --details"]


@pytest.mark.parametrize("language", ["en", "ja"])
def test_short_help_fits_two_screens(language):
    """The short help has at most 80 lines, that of ``respond`` at most 70; the rest is in ``--help-all``."""
    for name in COMMANDS:
        result = CliRunner().invoke(main, [name, "--lang", language, "--help"], terminal_width=WIDTH - 2)
        assert result.exit_code == 0
        assert len(result.stdout.splitlines()) <= (70 if name == "respond" else 80), name
