"""Suggestions for misspelt names, missing parameters, and shell completion."""

import click
import pytest
from click.shell_completion import ShellComplete
from click.testing import CliRunner

from seisblock.cli import COMMANDS, main
from seisblock.cli.suggest import closest_name

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
    (("batch", "--body", "gravestone", "--out", "x.csv"), "--bodies"),
    (("stack", "--block", "lantern"), "--stones"),
    (("overturn-rate", "--bodies", "aoyama.csv"), "--cemetery"),
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


@pytest.mark.parametrize(("line", "suggestion"), MISSPELT, ids=lambda item: " ".join(item) if isinstance(item, tuple) else item)
def test_unknown_name_suggests_nearest(line, suggestion, tmp_path, monkeypatch):
    """Commands, options, records, bodies, stones, cemeteries, components and pairs, in English and in Japanese (F6)."""
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(main, list(line))
    assert result.exit_code in (2, 3)
    hint = " ".join(result.stderr.split()).lower().partition("did you mean")[2]
    assert suggestion.lower() in hint
    japanese = " ".join(CliRunner().invoke(main, ["--lang", "ja", *line]).stderr.split())
    assert f"{suggestion} のことでしょうか" in japanese


@pytest.mark.parametrize(
    ("line", "suggestion"),
    [
        (("measure", "記録１.V1A"), "記録 １.V1A"),
        (("measure", "data/nig019.ES"), "data/NIG019.EW"),
        (("rock", "--block", "rokc.toml"), "rock.toml"),
        (("overturn-rate", "--cemetery", "survay.csv"), "survey.csv"),
    ],
)
def test_missing_file_suggests_a_file_in_its_folder(line, suggestion, tmp_path, monkeypatch):
    """The bundled samples were listed, and the user's own file with a blank in its name was not."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "data").mkdir()
    for name in ("記録 １.V1A", "data/NIG019.EW", "rock.toml", "survey.csv"):
        (tmp_path / name).touch()
    stderr = " ".join(CliRunner().invoke(main, list(line)).stderr.split())
    assert f"did you mean {suggestion}?" in stderr


@pytest.mark.parametrize(
    ("line", "english", "japanese"),
    [
        (("overturn-rate",), "Missing option '--cemetery'.", "オプション '--cemetery' は必須です。"),
        (("fit",), "Missing argument 'OUTCOMES'.", "引数 'OUTCOMES' は必須です。"),
        (("completion",), "Missing argument '{bash|zsh|fish}'. Choose from:", "引数 '{bash|zsh|fish}' は必須です。次から選んでください："),
    ],
)
def test_missing_parameter_is_named_in_a_sentence(line, english, japanese):
    """The Japanese sentence ends in its own full stop, not in that of click."""
    assert english in CliRunner().invoke(main, line).stderr
    assert japanese in CliRunner().invoke(main, ["--lang", "ja", *line]).stderr


@pytest.mark.parametrize("line", LIKE_NOTHING, ids=" ".join)
def test_unrelated_name_suggests_nothing(line):
    """No suggestion for a name that resembles none."""
    result = CliRunner().invoke(main, [*line, *(("--mu", "0.2") if line[0] == "slide" else ())])
    assert result.exit_code in (2, 3) and "did you mean" not in result.stderr.lower()


@pytest.mark.parametrize(
    ("typed", "suggestion"),
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
def test_suggestion_allows_one_typo_or_prefix(typed, suggestion):
    """Nothing else is: of a long name two slips."""
    assert closest_name(typed, COMMANDS) == suggestion and closest_name(typed, ()) is None
    assert closest_name("ovreturn-rat", COMMANDS) == "overturn-rate" and closest_name("ovretrn-rat", COMMANDS) is None


def completions(*words):
    """Return what a shell is offered for the last word."""
    *before, last = words
    result = ShellComplete(main, {}, "seisblock", "_SEISBLOCK_COMPLETE").get_completions(before, last)
    return [item.value for item in result if item.type == "plain"]


OF_ROOMS = ("bookcase", "filing_cabinet", "lateral_filing_cabinet", "server_rack", "refrigerator", "display_case")


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (("measure", "elc"), ["elcentro_1940_ns.csv"]),
        (("rock", "--component", ""), ["NS", "EW", "UD", "all", "all-azimuths"]),
        (("slide", "--component", "al"), ["all", "all-azimuths"]),
        (("measure", "--component", "NS,u"), ["NS,UD"]),
        (("rock", "--block", ""), ["chozusha", "gravestone", "wagata", "lantern", "column", *OF_ROOMS, "statue", "machine", "boulder"]),
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
    ids=lambda item: " ".join(item) or "(nothing)",
)
def test_completion_lists_existing_names(words, names):
    """F6: components, samples, bodies of the kind that is wanted, stones of the pile that is named, cemeteries, surfaces."""
    assert completions(*words) == names


def test_completion_offers_all_azimuths_where_supported():
    """Of the commands with components, those that sweep the azimuths offer them."""
    takes_components = [name for name in COMMANDS if any(param.name == "component" for param in main.get_command(None, name).params)]
    offering = {name for name in takes_components if completions(name, "--component", "all-a")}
    assert offering == {"batch", "fragility", "respond", "rock", "slide", "spectrum"}
    assert "jump" in takes_components


@pytest.mark.parametrize("command", COMMANDS)
def test_help_describes_every_parameter(command):
    """F6: every argument and option has help, and every record option its processing step."""
    context = click.Context(main.get_command(click.Context(main), command))
    rows = [param.get_help_record(context) for param in context.command.get_params(context) if not getattr(param, "hidden", False)]
    assert all(meaning.strip() for _, meaning in rows), rows
    assert not [meaning for _, meaning in rows if meaning.count("[required]") > 1]
    output = CliRunner().invoke(main, [command, "--help"]).stdout
    assert "Positional arguments" not in output
    if "[RECORD]..." in output:
        assert output.count("[RECORD]...") == 2 and "Record options:\n  [RECORD]...  " in output
