"""Every command answers in the language asked for: no English is left in Japanese, and neither language is wider than a terminal."""

import re
import shutil

import pytest
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from click.testing import CliRunner

from seisblock.cli import COMMANDS, locale, main
from seisblock.core import i18n
from seisblock.output.text.wrap import display_width
from tests.architecture.test_vocabulary import is_polite, japanese_sentences
from tests.i18n.english import english_words
from tests.lengths import short_studies

pytestmark = pytest.mark.usefixtures("computed_once")

WIDTH = 80
SHORT = ("synthetic_jma.csv", "--window", "25:28")
BLOCK = ("--width", "24cm", "--height", "72cm")

ANSWERS = (
    ("measure",),
    ("measure", "elcentro_1940_ns.csv", "--highpass", "0.1", "--scale", "40"),
    ("measure", "synthetic_knet.EW", *BLOCK, "--window", "0.5:30"),
    ("rock", *SHORT, "--block", "refrigerator", "--perturb", "4", "--floor", "T=0.6,zeta=0.03,height=0.8"),
    ("respond", *SHORT, "--width", "45cm", "--height", "180cm", "--mu", "0.3", "--runs", "25"),
    ("respond", *SHORT, "--block", "gravestone", "--surface", "granite/granite", "--runs", "2", "--component", "all-azimuths"),
    ("respond", *SHORT, *BLOCK, "--mu", "0.02", "--runs", "2", "--scale", "0.2"),
    ("slide", *SHORT, "--mu", "0.2", "--vertical", "--slope", "5", "--slope-length", "20cm", "--target-pga", "500"),
    ("slide", *SHORT, "--mu", "0.2", "--component", "all-azimuths", "--one-way"),
    ("slide", *SHORT, "--mu", "0.1,0.6", "--slope", "5,10"),
    ("rock", *SHORT, "--block", "gravestone", "--mu", "0.2", "--vertical", "--margin", "--margin-limit", "1.2", "--perturb", "4"),
    ("rock", *SHORT, *BLOCK, "--scale", "0.2"),
    ("rock", *SHORT, "--width", "3m", "--height", "1m", "--component", "NS,37"),
    ("rock", *SHORT, "--block", "boulder", "--component", "all-azimuths", "--scale", "0.4"),
    ("respond", *SHORT, "--block", "boulder", "--mu", "0.4", "--runs", "0", "--inset", "1cm"),
    ("body", "boulder.ply", "--inset", "10mm"),
    ("body", "boulder.ply", "--unit", "km", "--tolerance", "1cm"),
    ("jump", *SHORT, "--tenon", "2cm"),
    ("scenario", *SHORT, "--bodies", "bookcase", "--bodies", "statue", "--bodies", "refrigerator", "--jma", "6+"),
    ("secure", *SHORT, *BLOCK, "--mu", "0.5", "--pga", "400"),
    ("jump", *SHORT, "--first", "--landing", "friction", "--gal", "--scale", "0.2"),
    ("rigid3d", *SHORT, *BLOCK, "--mu", "0.5"),
    ("rigid3d", *SHORT, *BLOCK, "--mu", "0.5", "--scale", "0.2"),
    ("uplift", *SHORT, *BLOCK, "--frequency-vertical", "8"),
    ("uplift", *SHORT, "--width", "1.2", "--height", "3", "--frequency-vertical", "8", "--scale", "0.05", "--component", "EW"),
    ("uplift", "--harmonic", "--alpha", "1", "--damping", "0.05"),
    (
        "stack",
        "synthetic_jma.csv",
        "--window",
        "25.5:26.2",
        "--stones",
        "wagata",
        "--reinforced",
        "--component",
        "NS",
        "--contact",
        "grid=3",
    ),
    ("criteria", *SHORT, "--block", "gravestone", "--component", "NS"),
    ("spectrum", *SHORT, "--component", "NS", "--sizes", "1:2:1", "--height-over-width", "2:4:1", "--inset", "0.1"),
    ("spectrum", *SHORT, "--kind", "overturning", "--component", "NS", "--steps", "12"),
    ("spectrum", *SHORT, "--kind", "overturning", "--component", "all-azimuths", "--steps", "5", "--scale", "0.5"),
    ("spectrum", *SHORT, "--component", "all-azimuths", "--steps", "3"),
    ("spectrum", *SHORT, "--kind", "sliding", "--mu", "0.1:0.3:0.1"),
    ("spectrum", *SHORT, "--kind", "modes", "--mu", "0.2,0.5", "--height-over-width", "1,4", "--component", "EW"),
    ("overturn-rate", "--cemetery", "aoyama.csv"),
    ("overturn-rate", "--cemetery", "aoyama.csv", "--pga", "1,300,5000", "--frequency", "1,9", "--both"),
    ("overturn-rate", "--cemetery", "aoyama.csv", *SHORT, "--criterion", "rigid"),
    ("overturn-rate", "--cemetery", "aoyama.csv", "--inset", "0.8", "--pga", "300", "--frequency", "1", "--criterion", "rigid"),
    ("infer", "--rate", "35/100", "--cemetery", "aoyama.csv"),
    ("infer", "--rate", "100/100", "--cemetery", "aoyama.csv", "--frequency", "1"),
    ("infer", *SHORT, "--slid", "5cm", "--mu", "0.3", "--limit", "1.5", "--steps", "30"),
    ("infer", *SHORT, "--jumped", "20cm", "--limit", "1.2", "--steps", "12", "--component", "EW"),
    ("batch", "synthetic_jma.csv", "gone.csv", "--bodies", "gravestone", "--solver", "rock", "--force", "--out", "FOLDER/table.csv"),
    ("map", "shafter_1989", "synthetic_knet.EW", *BLOCK, "--mu", "0.5", "--runs", "2"),
    ("map", "shafter_1989", "gone.csv", "--cemetery", "aoyama.csv"),
    ("map", "shafter_1989"),
    (
        *("fragility", "synthetic_jma.csv", "elcentro_1940_ns.csv", "--width", "30cm", "--height", "1.2", "--solver", "rock", "--im"),
        *("pgv,pga", "--limit", "rock,lean=0.5,overturn", "--steps", "8", "--perturb", "3", "--bootstrap", "20", "--compare", "50,0.4"),
    ),
    (
        *("fragility", "synthetic_jma.csv", "elcentro_1940_ns.csv", "--mu", "0.1", "--solver", "slide", "--limit", "slip=5cm,slip=90m"),
        *("--steps", "8", "--method", "ida", "--bootstrap", "20", "--levels", "10,20,40,80,160", "--im", "pgv"),
    ),
    ("risk", "--median", "60cm/s", "--beta", "0.4", "--hazard", "synthetic_hazard.csv", "--stood", "1000"),
    ("risk", "--median", "60", "--beta", "0.4", "--hazard", "synthetic_hazard.csv", "--years", "1"),
    ("fit", "shaken_block.csv", *BLOCK, "--free", "alpha", "--scatter", "0.05", "--lapse", "0.02", "--runs", "4"),
    ("validate", "--paper", "Fujino1978", "--all"),
    ("paper",),
    ("paper", "tsutsui", "table1"),
    ("paper", "fujino1978", "fig7", "elcentro_1940_ns.csv"),
    ("cite",),
    ("samples",),
    ("schema",),
)
"""A run of every command, each of its kinds of answer among them, on bundled samples, a short window of them where it takes long."""


def whole(line):
    """Return a command line with ``--details`` where the command has it: shortened answers have a test of their own."""
    return (*line, "--details") if any("--details" in parameter.opts for parameter in main.get_command(None, line[0]).params) else line


TEXT = [whole(line) for line in ANSWERS]
"""Those in full, of which one takes seconds."""

REFUSALS = (
    (),
    ("batch", "--bodies", "gravestone", "--out", "table.xlsx"),
    ("fragility",),
    ("fragility", "synthetic_jma.csv"),
    ("fragility", "synthetic_jma.csv", *BLOCK, "--solver", "rock"),
    ("fragility", "synthetic_jma.csv", "elcentro_1940_ns.csv", *BLOCK, "--solver", "rock", "--levels", "1,2"),
    ("fragility", "synthetic_jma.csv", "elcentro_1940_ns.csv", *BLOCK, "--solver", "rock", "--limit", "fall"),
    ("fragility", "synthetic_jma.csv", "elcentro_1940_ns.csv", *BLOCK, "--solver", "rock", "--compare", "1"),
    ("map", "gone.csv"),
    ("map", "hanmer_springs_2016", "shafter_1989", *BLOCK),
    ("nosuch",),
    ("measure", "--nosuch"),
    ("measure", "nofile"),
    ("measure", "FOLDER/empty"),
    ("measure", "--threshold", "5"),
    ("measure", "--highpass", "1000"),
    ("measure", "--floor", "T=0"),
    ("measure", "--floor", "0.6"),
    ("measure", "--plot", "x.xyz"),
    ("measure", "--plot", "nosuch/x.png"),
    ("measure", "-", "--strict", "--format", "JMA-CSV"),
    ("slide",),
    ("slide", "--mu", "x"),
    ("slide", "--mu", "-1"),
    ("slide", "--mu", "0.2", "--window", "5:1"),
    ("slide", "--mu", "0.2", "--component", "XX"),
    ("slide", "--mu", "0.2", "--slope", "30"),
    ("slide", "--mu", "0.2", "--target-pga", "0"),
    ("rock", "--width", "1"),
    ("rock", "--width", "24", "--height", "72"),
    ("rock", "--width", "2q", "--height", "1"),
    ("rock", "--block", "nosuch"),
    ("rock", "--block", "gravestone", "--restitution", "2"),
    ("body",),
    ("body", "nosuch.ply"),
    ("body", "boulder.ply", "--up", "-z"),
    ("body", "boulder.ply", "--inset", "1"),
    ("body", "boulder.ply", "--out", "rock.ply"),
    ("respond", "--width", "1", "--height", "2"),
    ("respond", "--width", "1", "--height", "2", "--surface", "ice/ice"),
    ("jump", "--spin", "x"),
    ("jump", "--first", "--repeat"),
    ("uplift", "--width", "1"),
    ("uplift", "--width", "1", "--height", "2", "--frequency-vertical", "0"),
    ("rigid3d", *BLOCK),
    ("scenario", "--bodies", "nosuch", "--jma", "6-"),
    ("secure", *BLOCK),
    ("stack", "--without", "nosuch"),
    ("stack", "--criterion", "--resume", "."),
    ("stack", "--grid", "0"),
    ("criteria", "--width", "1"),
    ("spectrum", "--kind", "sliding", "--sizes", "1"),
    ("spectrum", "--kind", "nosuch"),
    ("spectrum", "--kind", "sliding", "--component", "all-azimuths"),
    ("overturn-rate",),
    ("overturn-rate", "--cemetery", "nosuch.csv"),
    ("infer",),
    ("infer", "--rate", "x", "--cemetery", "aoyama.csv"),
    ("risk",),
    ("risk", "--median", "0.4g", "--beta", "0.4", "--hazard", "synthetic_hazard.csv"),
    ("risk", "--fragility", "nosuch.json", "--hazard", "nosuch.csv"),
    ("fit",),
    ("fit", "nosuch.csv"),
    ("fit", "aoyama.csv"),
    ("fit", "shaken_block.csv", "--free", "mu"),
    ("fit", "shaken_block.csv", "--free", "alpha"),
    ("fit", "shaken_block.csv", "--folds", "13"),
    ("fit", "shaken_block.csv", "--bounds", "alpha=1:0.5"),
    ("fit", "shaken_block.csv", "--bounds", "alpha"),
    ("report",),
    ("report", "-o", "nosuch.html", "--body", "nosuch"),
    ("validate", "--paper", "Nope"),
    ("paper", "nosuch"),
    ("app", "--port", "70000"),
    ("fetch",),
    ("fetch", "nosuch", "--data-center", "nowhere"),
    ("samples", "nosuch"),
    ("schema", "nosuch"),
    ("cite", "nosuch"),
    ("completion", "tcsh"),
)
"""What users get wrong, for each command."""

MINUS_NOTHING = re.compile(r"(?<![\w.])[-−]0(?:\.0*)?(?:e[-+]?0+)?(?![\w.])")
"""A zero with a sign."""

CLOSE_PERCENT = re.compile(r"\d[%％]")
"""A percentage without the blank."""

ANSWERING = {"measure", "respond", "slide", "rock", "jump", "uplift", "stack", "criteria", "spectrum", "overturn-rate", "infer"}
"""Commands that answer a question about shaking."""

VERDICT = re.compile("計測震度|転倒|滑動|ロッキング|跳躍|浮き上がり|落下|静止|移動|動かない|ほぞは|最大加速度|倍率")
"""Terms of a result."""

HEADING = re.compile(r"サンプル、|^物体：(?!(?:転倒の可能性大|転倒の可能性あり|移動|動かない)（)|：墓石 \d+ 基$|読み込んだまま|^補正なし")
"""Lines that describe the record, its processing, the body (not the class of an object with its probability) or the cemetery."""

QUOTING = {"cite", "samples"}
"""Commands that quote references, licences and origins keep their original text."""


@pytest.fixture(scope="module")
def run_in_language(tmp_path_factory):
    """Run command lines in a language, each once, with compiled catalogues for click as in an installation."""
    folder, output = tmp_path_factory.mktemp("locale"), tmp_path_factory.mktemp("written")
    (output / "empty").mkdir()
    shutil.copytree(i18n.LOCALE_DIR, folder, dirs_exist_ok=True)
    for catalogue in folder.rglob("*.po"):
        with catalogue.open("rb") as source, catalogue.with_suffix(".mo").open("wb") as target:
            write_mo(target, read_po(source))
    answers = {}

    def answer(line, lang):
        if (line, lang) not in answers:
            items = [str(output / item.removeprefix("FOLDER/")) if item.startswith("FOLDER/") else item for item in line]
            answers[line, lang] = CliRunner().invoke(main, ["--lang", lang, *items], env={"COLUMNS": str(WIDTH)})
        return answers[line, lang]

    # texts are the point here, not how well the probabilities of `secure` are known
    with pytest.MonkeyPatch.context() as patch, short_studies():
        patch.setattr(i18n, "LOCALE_DIR", folder)
        patch.setattr(locale, "LOCALE_DIR", folder)
        i18n._load_catalogue.cache_clear()
        yield answer
    i18n._load_catalogue.cache_clear()


def line_of(parts):
    """Return a command line as one types it."""
    return " ".join(parts) or "(nothing)"


def wide_lines(text):
    """Return the lines of a text that do not fit a terminal; examples are to be copied in one piece."""
    return [line for line in text.splitlines() if display_width(line.rstrip()) > WIDTH and not line.startswith("  seisblock ")]


@pytest.mark.parametrize("lang", i18n.LANGUAGES)
@pytest.mark.parametrize("line", TEXT, ids=line_of)
def test_output_follows_the_rules_of_its_language(line, lang, run_in_language):
    """Lines fit 80 columns, zeros have no sign (F2), percentages one form, on either stream; Japanese holds no English."""
    answer = run_in_language(line, lang)
    text = answer.stdout + answer.stderr
    assert answer.exit_code == 0, answer.output
    assert wide_lines(answer.stdout) == []
    assert not MINUS_NOTHING.findall(text)
    assert line[0] in QUOTING or not CLOSE_PERCENT.findall(text)
    if lang == "ja":
        assert line[0] in QUOTING or not english_words(answer.stdout)
        assert not english_words(answer.stderr)
        assert not text.isascii() or line == ("schema",)


@pytest.mark.parametrize("line", REFUSALS, ids=line_of)
def test_errors_are_fully_japanese(line, run_in_language):
    """Errors are in Japanese, those of click included."""
    answer = run_in_language(line, "ja")
    assert answer.exit_code != 0 or not line
    assert not english_words(answer.stderr + answer.stdout)
    assert not answer.output.isascii()


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_is_fully_japanese(command, run_in_language):
    """Lines of commands and of options; examples are command lines."""
    answer = run_in_language((*command.split(), "--help"), "ja")
    assert answer.exit_code == 0 and not english_words(answer.stdout)
    assert not re.search(r"\[既定|既定値", answer.stdout), "one bracket for all commands"
    text = "".join(line.strip() for line in answer.stdout.partition("使用例")[0].splitlines())
    assert [sentence for sentence in japanese_sentences(text) if not is_polite(sentence)] == [], "one register for all commands"


@pytest.mark.parametrize("lang", i18n.LANGUAGES)
@pytest.mark.parametrize("command", COMMANDS)
def test_help_fits_80_columns(command, lang, run_in_language):
    """Wide letters take two columns."""
    answer = run_in_language((command, "--help"), lang)
    assert answer.exit_code == 0 and wide_lines(answer.stdout) == []


def test_negative_zero_rule_detects_violations():
    """The guard sees it in a cell and in a sentence, and lets ranges, dates and small numbers pass."""
    assert len(MINUS_NOTHING.findall("jumped -0 mm, -0.0 and −0.00 deg; -0.0e+00")) == 4
    assert not MINUS_NOTHING.findall("0.00-0.00, 2024-01-01, -0.04 mm, 1e-05, e-0.5")


@pytest.mark.parametrize("line", [line for line in ANSWERS if line[0] in ANSWERING], ids=line_of)
def test_output_begins_with_the_result(line, run_in_language):
    """F2: an answer begins with its result, after the name of the bundled record where none was given; tables stand below."""
    lines = run_in_language(line, "ja").stdout.splitlines()
    first = next(text for text in lines if not text.startswith("記録："))
    assert VERDICT.search(first) and not HEADING.search(first)


def test_outputs_cover_every_command():
    """A new command is looked at, too."""
    assert {line[0] for line in ANSWERS} == set(COMMANDS) - {"report", "completion", "fetch", "app"}, (
        "report writes a page, completion a script, fetch needs a server, app is one"
    )
    assert {line[0] for line in REFUSALS if line} >= set(COMMANDS)


def test_english_rule_detects_sentences():
    """The guard sees a sentence, and lets names, units, citations and command lines pass."""
    assert english_words("警告：all samples are zero") == ["all samples are zero"]
    assert english_words("なし: No such option") and not english_words("K-NET の NS、PGA 934 gal。seisblock rock を使う")
    assert not english_words("Furukawa2009 eq. (9)、--width と --height HZ、JMA CSV、'some odd name here'")
