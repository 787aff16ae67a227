"""Options without effect in a call are rejected."""

import json
import shlex

import click
import pytest
from click.testing import CliRunner

from seisblock.cli import infer, main
from seisblock.cli.console import reset_warnings, warning
from seisblock.cli.option_checks import RECORD_OPTIONS
from seisblock.cli.options import Source
from seisblock.cli.output import OutputOptions

STONES = "infer --cemetery aoyama.csv --rate 35/100"
SLID = "infer synthetic_jma.csv --slid 5cm --mu 0.3"
BLOCK = "--width 24cm --height 72cm"
AOYAMA = "overturn-rate --cemetery aoyama.csv"
SUITE = f"fragility --suite synthetic:M6.5:R15:4 --solver rock {BLOCK}"

IDLE = (
    (f"{STONES} --scale 2", "--scale"),
    (f"{STONES} --largest", "--largest"),
    (f"{STONES} --gravity 1.6", "--gravity"),
    (f"{SLID} --criterion rigid --confidence 0.5", "--criterion"),
    (f"{SLID} --spin printed", "--spin"),
    (f"{SLID} --drop 1", "--drop"),
    (f"{SLID} --runs 50", "--runs"),
    ("infer --twist 8 --steps 50", "--steps"),
    ("infer --jumped 5cm --vertical", "--vertical"),
    ("infer --jumped 5cm --frequency 2", "--frequency"),
    (f"rock {BLOCK} --perturb 5 --margin-limit 2", "--margin-limit"),
    (f"{AOYAMA} --target-pga 300", "--target-pga"),
    (f"{AOYAMA} --pga 300 --equivalent fourier", "--equivalent"),
    (f"{AOYAMA} synthetic_jma.csv --frequency 1 --equivalent fourier", "--equivalent"),
    (f"{AOYAMA} --criterion rigid --pga 300 --fit 800,1.9,4.5", "--fit"),
    (f"{AOYAMA} --stone-width 30cm", "--stone-width"),
    ("uplift --harmonic --scale 2", "--scale"),
    ("uplift --figure 4 --window 1:2", "--window"),
    ("jump --depth 1", "--depth"),
    ("jump --width 0.5 --heights 0.3,0.4 --masses 30,40 --mu 0.5 --side long", "--side"),
    ("measure --side long", "--side"),
    (f"criteria {BLOCK} --mu-kinetic 0.2", "--mu-kinetic"),
    ("map --mu 0.3", "--mu"),
    ("map --cemetery aoyama.csv --inset 0.1", "--inset"),
    ("map --cemetery aoyama.csv --gravity 1.6", "--gravity"),
    ("report --body gravestone --drop 1 -o page.html", "--drop"),
    ("report --body 24cmx72cm --side long -o page.html", "--side"),
    (f"{SUITE} --units g", "--units"),
    (f"{SUITE} --suite-format knet", "--suite-format"),
    (f"{SUITE} --nrml-shape discrete", "--nrml-shape"),
    ("fit shaken_block.csv --free=", "--free"),
)
"""A line, and the option in it that changed nothing."""

OF_ONE_SIDE = (
    f"rock {BLOCK} --side long",
    "rock --block gravestone --side short",
    f"respond {BLOCK} --mu 0.4 --side long",
    f"fragility --suite synthetic:M6.5:R15:4 --solver rock {BLOCK} --side long",
    "map --solver slide --mu 0.1 --side long",
)


@pytest.mark.parametrize(("line", "flag"), IDLE, ids=[line for line, _ in IDLE])
def test_options_without_effect_are_rejected_by_name(line, flag, tmp_path, monkeypatch):
    """One sentence that names the option, before anything is computed; nothing on stdout."""
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(main, shlex.split(line))
    assert result.exit_code == 2 and result.stdout == ""
    assert flag in result.stderr.splitlines()[-1]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("words", "says"), [("--seed -1", "the seed must be an integer of at least 0"), ("--spread -0.1", "found -0.1")])
def test_rock_checks_options_of_its_default_samples(words, says):
    """Samples are drawn without --perturb, too: their options have an effect, and are checked."""
    result = CliRunner().invoke(main, shlex.split(f"rock {BLOCK} --component NS {words}"))
    assert result.exit_code == 3 and result.stdout == "" and says in result.stderr.splitlines()[-1]


def test_options_of_default_samples_of_rock_change_the_probability():
    """Neither the seed nor the half width needs --perturb."""
    lines = [f"rock {BLOCK} --component NS --scale 0.5 --json {words}" for words in ("", "--seed 3", "--spread 0.3")]
    shares = [json.loads(CliRunner().invoke(main, shlex.split(line)).stdout)["results"][0]["assessment"] for line in lines]
    assert len({share["overturning_probability"] for share in shares}) == 3


@pytest.mark.parametrize("line", OF_ONE_SIDE)
def test_side_requires_two_layer_block(line):
    """--side chose nothing of bodies that are no two-layer block, without a word."""
    result = CliRunner().invoke(main, shlex.split(line))
    assert result.exit_code == 3 and "--side has no effect: this body is not a two-layer --block" in result.stderr


def test_infer_rejects_options_of_other_modes():
    """Each option of the command belongs to a form, or to all; the refused are those of the other forms."""
    shared = {
        *Source.__dataclass_fields__,
        *OutputOptions.__dataclass_fields__,
        "help",
        "help_all",
        "options",
        "lang",
        "cemetery",
        "slid",
        "jumped",
        "twist",
        "rate",
    }
    mapping = {
        "--cemetery": {*infer.STONE_OPTIONS},
        "--slid": {*infer.SLID_OPTIONS},
        "--jumped": {*infer.JUMPED_OPTIONS},
        "--twist": {*infer.TWIST_OPTIONS},
    }
    assert {param.name for param in main.get_command(None, "infer").params} - shared == set().union(*mapping.values())
    for form, read in mapping.items():
        idle = set(infer._foreign_options(form, rigid=False))
        assert not idle & (read - {"gravity"})
        assert idle == set().union(*mapping.values()) - read | (set(RECORD_OPTIONS) if form == "--cemetery" else set())


def test_infer_accepts_options_of_its_mode():
    """With rigid stones gravity has a say, and is taken."""
    rigid = f"{STONES} --frequency 1 --criterion rigid --gravity 1.62 --quiet"
    assert CliRunner().invoke(main, shlex.split(rigid)).exit_code == 0
    assert CliRunner().invoke(main, shlex.split(f"{SLID} --limit 2 --steps 5 --largest --quiet")).exit_code == 0


def test_jump_rejects_vertical():
    """--vertical of a solver that has none fell with a traceback."""
    result = CliRunner().invoke(main, shlex.split("map --block chozusha --solver jump --vertical"))
    assert result.exit_code == 3 and "jump has no option --vertical" in result.stderr


def test_suggested_respond_command_keeps_side():
    """The command suggested by rock keeps the side of the body (was: always the short one)."""
    line = "rock synthetic_jma.csv --component NS --block chozusha --side long --mu 0.01 --quiet"
    typed = " ".join(CliRunner().invoke(main, shlex.split(line)).stdout.split())
    assert "seisblock respond synthetic_jma.csv --component NS --block chozusha --side long --mu 0.01" in typed


def test_warning_prints_option_instead_of_parameter():
    """Warnings of the library name parameters; the command line shows its options, as in errors."""

    @click.command()
    @click.option("--step")
    def solve(step):
        reset_warnings()
        warning("not converged in {share:.0f} % of the steps; give a finer `step`, not a finer `grid`", share=3.0)

    assert CliRunner().invoke(solve).stderr == "warning: not converged in 3 % of the steps; give a finer --step, not a finer grid\n"
