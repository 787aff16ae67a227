"""A name that is misspelt is asked back, and a shell knows the names there are."""

import click
import pytest
from click.shell_completion import ShellComplete
from click.testing import CliRunner

from seisblock.cli import COMMANDS, main
from seisblock.cli.shell_completion import SWEEP_COMMANDS
from seisblock.cli.suggest import closest_name
from seisblock.core.i18n import use_locale

MISSPELT = (
    (("messure",), "measure"),
    (("overturnrate",), "overturn-rate"),
    (("rock", "--widht", "1"), "--width"),
    (("measure", "synthetic_jam"), "synthetic_jma.csv"),
    (("rock", "--block", "graveston"), "gravestone"),
    (("stack", "--stones", "lanten"), "lantern"),
    (("stack", "--without", "soa"), "sao"),
    (("overturn-rate", "--cemetery", "aoyoma"), "aoyama.csv"),
    (("slide", "--mu", "0.2", "--component", "N"), "NS"),
    (("respond", "--width", "1", "--height", "2", "--surface", "granit/granite"), "granite/granite"),
    (("samples", "wagatta"), "wagata.toml"),
    (("report", "-o", "x.html", "--body", "chozushu"), "chozusha"),
    (("rock", "--blok", "gravestone"), "--block"),
    (("measure", "--plotfile", "x.png"), "--plot"),
    (("batch", "--solver", "rok"), "rock"),
    (("spectrum", "--kind", "rokcing"), "rocking"),
    (("cite", "slid"), "slide"),
    (("--verson",), "--version"),
    (("overturn",), "overturn-rate"),
)

LIKE_NOTHING = (
    ("slide", "--component", "XX"),
    ("slide", "--blok", "gravestone"),  # not --plot
    ("criteria", "--slow", "2"),
    ("report", "--html", "x.html"),
    ("rock", "--corpse", "gravestone"),
    ("batch", "--solver", "falling"),
    ("rate",),
)


@pytest.mark.parametrize(("line", "meant"), MISSPELT, ids=lambda each: " ".join(each) if isinstance(each, tuple) else each)
def test_unknown_name_suggests_nearest(line, meant, tmp_path, monkeypatch):
    """F6: whatever is named, command, option, record, body, stone, cemetery, component or pair: in English and in Japanese."""
    monkeypatch.chdir(tmp_path)
    told = CliRunner().invoke(main, list(line))
    assert told.exit_code in (2, 3)
    asked = " ".join(told.stderr.split()).lower().partition("did you mean")[2]
    assert meant.lower() in asked
    japanese = " ".join(CliRunner().invoke(main, ["--lang", "ja", *line]).stderr.split())
    assert f"{meant} のことでしょうか" in japanese


@pytest.mark.parametrize("line", LIKE_NOTHING, ids=" ".join)
def test_unrelated_name_suggests_nothing(line):
    """A guess that is none would lead astray."""
    told = CliRunner().invoke(main, [*line, *(("--mu", "0.2") if line[0] == "slide" else ())])
    assert told.exit_code in (2, 3) and "did you mean" not in told.stderr.lower()


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("xyz", None),
        ("ROCK", "rock"),
        ("rokc", "rock"),
        ("rocks", "rock"),
        ("measurement", "measure"),
        ("s", None),
        ("", None),
        ("jmp", "jump"),
    ],
)
def test_suggestion_allows_one_typo_or_prefix(typed, meant):
    """Nothing else is: of a long name two slips."""
    assert closest_name(typed, COMMANDS) == meant and closest_name(typed, ()) is None
    assert closest_name("ovreturn-rat", COMMANDS) == "overturn-rate" and closest_name("ovretrn-rat", COMMANDS) is None


def completions(*words):
    """Return what a shell is offered for the last word."""
    *before, last = words
    found = ShellComplete(main, {}, "seisblock", "_SEISBLOCK_COMPLETE").get_completions(before, last)
    return [item.value for item in found if item.type == "plain"]


OF_ROOMS = ("bookcase", "filing_cabinet", "lateral_filing_cabinet", "server_rack", "refrigerator", "display_case")


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (("measure", "elc"), ["elcentro_1940_ns.csv"]),
        (("rock", "--component", ""), ["NS", "EW", "UD", "all", "all-azimuths"]),
        (("slide", "--component", "al"), ["all", "all-azimuths"]),
        (("measure", "--component", "NS,u"), ["NS,UD"]),
        (("rock", "--block", ""), ["chozusha", "gravestone", "wagata", "lantern", "column", *OF_ROOMS, "statue", "boulder"]),
        (("jump", "--block", ""), ["chozusha"]),
        (("body", "bo"), ["boulder.ply"]),
        (("stack", "--stones", ""), ["wagata", "lantern", "column", "statue"]),
        (("stack", "--without", "mi"), ["mizubachi"]),
        (("stack", "--stones", "lantern", "--fix", "hi"), ["hibukuro"]),
        (("stack", "--stones", "nosuch", "--fix", ""), []),
        (("overturn-rate", "--cemetery", ""), ["aoyama.csv"]),
        (("risk", "--hazard", "syn"), ["synthetic_hazard.csv"]),
        (("infer", "--cemetery", "a"), ["aoyama.csv"]),
        (("respond", "--surface", "wood"), ["wood/stone", "wood/wood"]),
        (("samples", "ch"), ["chozusha.toml"]),
        (("spectrum", "--kind", "m"), ["modes"]),
        (("cite", "ro"), ["rock"]),
    ],
    ids=lambda each: " ".join(each) or "(nothing)",
)
def test_completion_lists_existing_names(words, names):
    """F6: components, samples, bodies of the kind that is wanted, stones of the pile that is named, cemeteries, surfaces."""
    assert completions(*words) == names


def test_completion_offers_all_azimuths_where_supported():
    """A command that sweeps the azimuths says so in its help, and the others do not offer it."""
    for name in COMMANDS:
        with use_locale("en"):
            told = " ".join(CliRunner().invoke(main, [name, "--help"]).stdout.split())
        assert ("--component all-azimuths" in told) == (name in SWEEP_COMMANDS), name


@pytest.mark.parametrize("command", COMMANDS)
def test_help_describes_every_parameter(command):
    """F6: no argument or option stands without a word, and a record stands with what is done to it."""
    context = click.Context(main.get_command(click.Context(main), command))
    rows = [each.get_help_record(context) for each in context.command.get_params(context) if not getattr(each, "hidden", False)]
    assert all(meaning.strip() for _, meaning in rows), rows
    assert not [meaning for _, meaning in rows if meaning.count("[required]") > 1]
    told = CliRunner().invoke(main, [command, "--help"]).stdout
    assert "Positional arguments" not in told
    if "[RECORD]..." in told:
        assert told.count("[RECORD]...") == 2 and "Record options:\n  [RECORD]...  " in told
