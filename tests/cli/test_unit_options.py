"""An option that stands in the help changes the answer: of the units, in each command that has them."""

import ast
import dataclasses
import inspect
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from seisblock import cli
from seisblock.cli import COMMANDS, main
from seisblock.cli.options import Source
from seisblock.cli.output import OutputOptions
from seisblock.readers.options import ReadOptions

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("computed_once", "few_runs")]

SHORT = ("synthetic_jma.csv", "--window", "25.5:26.5", "--component", "NS")
BLOCK = ("--width", "24cm", "--height", "72cm")

IN_GAL = {
    "measure": SHORT[:3],
    "respond": (*SHORT, *BLOCK, "--mu", "0.5", "--runs", "0"),
    "slide": (*SHORT, "--mu", "0.2"),
    "rock": (*SHORT, *BLOCK),
    "rigid3d": (*SHORT, *BLOCK, "--mu", "0.5", "--runs", "0"),
    "jump": SHORT,
    "uplift": (*SHORT, *BLOCK, "--frequency-vertical", "8"),
    "stack": SHORT,
    "criteria": (*SHORT, *BLOCK),
    "body": ("boulder.ply", "--inset", "1cm"),
    "overturn-rate": ("--cemetery", "aoyama.csv", "--pga", "300", "--frequency", "1"),
    "fit": ("shaken_block.csv", *BLOCK, "--free", "alpha", "--scatter", "0.05", "--lapse", "0.02", "--runs", "1"),
    "fragility": ("synthetic_jma.csv", "elcentro_1940_ns.csv", *BLOCK, "--solver", "rock", "--steps", "30", "--bootstrap", "20"),
    "risk": ("--median", "60cm/s", "--beta", "0.4", "--hazard", "synthetic_hazard.csv"),
    "map": ("hanmer_springs_2016",),
    "infer": (*SHORT, "--slid", "5cm", "--mu", "0.3", "--limit", "1", "--steps", "5"),
}
"""A short line of each command whose answer or figure holds an acceleration."""

WITHOUT_A_FIGURE = {"map"}


def options_of(command):
    """Return the names of a command's options."""
    return {name for param in main.get_command(None, command).params for name in param.opts}


def test_unit_option_exists_where_accelerations_are_shown():
    """F6: --gal/--si stands in the commands that show accelerations, and in no other."""
    assert {command for command in COMMANDS if "--gal" in options_of(command)} == set(IN_GAL)


@pytest.mark.parametrize("command", IN_GAL)
def test_unit_option_sets_units_of_text_and_figure(command, tmp_path):
    """F3, F6: with --si no gal, kine, cm or mm is left in the answer or the figure, with --gal no m/s²; one of the two differs."""
    answers = []
    for unit, second in (("--gal", "m/s²"), ("--si", "(gal|kine|cm|mm)")):
        path = tmp_path / f"{unit}.svg"
        figure = [] if command in WITHOUT_A_FIGURE else ["--plot", str(path)]
        answer = CliRunner().invoke(main, [command, *IN_GAL[command], unit, *figure, "--quiet"])
        assert answer.exit_code == 0, answer.output
        # letters are outlines in an .svg: each text stands before its own as a comment
        text = " ".join(re.findall(r"<!-- (.*?) -->", path.read_text(encoding="utf-8"))) if figure else ""
        assert not re.search(rf"(?<!\w){second}(?!\w)", answer.stdout + text.replace("gal s", "")), (unit, second)
        answers.append((answer.stdout, text))
    assert answers[0] != answers[1]


def test_every_option_is_read_by_its_command():
    """Whatever a command takes it reads: by name, or as a field of what its shared options were gathered in."""
    left = {}
    for name in COMMANDS:
        tree = ast.parse(inspect.getsource(inspect.unwrap(main.get_command(None, name).callback))).body[0]
        mapping = {item.arg for item in (*tree.args.args, *tree.args.kwonlyargs)}
        read = {node.id for part in tree.body for node in ast.walk(part) if isinstance(node, ast.Name)}
        assert mapping, name
        if unread := mapping - read:
            left[name] = unread
    assert left == {}


@pytest.mark.parametrize("gathered", [Source, OutputOptions])
def test_every_shared_option_field_is_read(gathered):
    """Each field of what the shared options become is read somewhere in the command line."""
    source = "\n".join(path.read_text(encoding="utf-8") for path in Path(cli.__file__).parent.rglob("*.py"))
    names = [field.name for field in dataclasses.fields(gathered)]
    if gathered is Source:
        # those of reading are passed on together
        names = [name for name in names if name not in {field.name for field in dataclasses.fields(ReadOptions)}]
    assert [name for name in names if not re.search(rf"(?<!self)\.{name}\b|getattr\(\w+, .{name}\W", source)] == []
