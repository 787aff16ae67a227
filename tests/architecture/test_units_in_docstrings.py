"""Units are stated in the help of every option and for every number in the docstrings of the public API."""

import inspect
import itertools
import re

import click
import pytest

from seisblock.cli import COMMANDS, main
from seisblock.cli.types import Count
from seisblock.output.json.units import split_unit
from tests.public_names import PUBLIC

UNIT = (
    r"(?:N/m\^3|N/m|kg\sm\^2|kg/m\^3|kg|m/s\^[23]|m/s|m\^[23]|1/s\^2|1/s|1/m|rad/s|rad|deg(?:rees)?|Hz|gal|kine|Pa|J|N|1/year|years"
    r"|km|m|s|1)"
)
DIMENSION = re.compile(
    rf"(?:(?:,|\)|\bin|\bor|\band)\s|\(){UNIT}(?![\w^/])"  # "Height H, m or with a unit", "(n,) array, m/s^2"
    r"|\b0\sto\s1\b|\bbetween\s0\sand\s1\b|\[0,\s1|\bunits\b|in\s`unit`"
    r"|\b[Ss]hares?\b|\b[Rr]atios?\b|\b[Ff]actors?\b|\b[Cc]oefficients?\b|\btimes\sslower\b|\bln\s(?:PGA|f)\b|[A-Za-z]/[A-Z]\b"
    r"|\bJMA\sintensity\b|\b[Dd]egrees\b|\b[Pp]er\scent\b|\blogarithm\b|\bpoints\b",
)
"""A unit in the usual notation, or the word for a dimensionless number."""

COUNTS = (click.IntRange, type(click.INT), Count)
"""Types of options that are counts."""


def dimension_of_help(text):
    """Return whether the help of an option, its default excluded, states the unit of its numbers."""
    return bool(DIMENSION.search(re.sub(r"\[default:[^]]*\]", "", text)))


def every_option():
    """Return (command, option) for every option of every command."""
    context = click.Context(main)
    pairs = []
    for name in COMMANDS:
        command = main.get_command(context, name)
        pairs += [(name, option) for option in command.params if isinstance(option, click.Option)]
    return pairs


def test_every_option_has_help():
    """Each has a help text that ends like a sentence."""
    assert [f"{name} {option.opts[0]}" for name, option in every_option() if not option.help] == []


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("Height H, m or with a unit.", True),
        ("Scale so that the largest PGA is this, gal.", True),
        ("Level of the intervals, 0 to 1.", True),
        ("Kinetic friction, 1. [default: as --mu]", True),
        ("Friction, for --kind sliding. [default: 0.02 to 0.8]", False),
        ("Width of the stones. [default: 1 m]", False),
        ("Number of seconds that it is followed.", False),
        ("Largest step; 1 step is enough.", False),
    ],
)
def test_unit_rule_recognises_units(text, says):
    """A unit after a comma or a word for a pure number counts; a default, a count of words or a lone figure does not."""
    assert dimension_of_help(text) is says


def test_numeric_options_state_their_unit():
    """The help of each option that takes other numbers than counts names their unit."""
    numbers = [
        (name, option)
        for name, option in every_option()
        if not (option.is_flag or isinstance(option.type, (click.Choice, click.Path, *COUNTS)) or option.type.name == "text")
    ]
    assert len(numbers) > 100
    assert [f"{name} {option.opts[0]}: {option.help}" for name, option in numbers if not dimension_of_help(option.help)] == []


def named_dimension(name):
    """Return whether a name contains the unit: `width_m`, `max_rotation_ratio`."""
    return bool(split_unit(name)[1]) or name.split("_")[-1] in {"ratio", "ratios", "share", "factor"}


def numbers_described(text):
    """Yield (names, description) of each numeric parameter or field of a docstring."""
    lines = text.splitlines()
    for i, line in enumerate(lines):
        result = re.fullmatch(r"([a-z_]\w*(?:, [a-z_]\w*)*) : (.*\b(?:floats?|arrays?)\b(?! of (?:int|bool)).*)", line)
        if result:
            message = itertools.takewhile(lambda following: following.startswith("    "), lines[i + 1 :])
            yield result[1].split(", "), " ".join([result[2], *(item.strip() for item in message)])


@pytest.mark.parametrize("name", PUBLIC)
def test_public_api_states_units(name):
    """Every number that goes in or comes out has its unit in its name or in its docstring."""
    described = list(numbers_described(inspect.getdoc(PUBLIC[name]) or ""))
    silent = [item for names, text in described for item in names if not (named_dimension(item) or DIMENSION.search(text))]
    assert silent == []


def test_unit_rule_has_numbers_to_check():
    """The rule above has something to judge."""
    assert sum(len(list(numbers_described(inspect.getdoc(PUBLIC[name]) or ""))) for name in PUBLIC) > 150
