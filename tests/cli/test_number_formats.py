"""Numbers as people write them: per cent in a friction, full-width letters in lengths; and what an azimuth is written as."""

import json

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.core.errors import ComponentError
from seisblock.readers import read


def answer(*words):
    """Return the document of a command line."""
    done = CliRunner().invoke(main, [*words, "--json", "--quiet"])
    assert done.exit_code == 0, done.output
    return json.loads(done.stdout)


@pytest.mark.parametrize("command", [["slide", "elcentro_1940_ns"], ["rock", "elcentro_1940_ns", "--block", "gravestone"]], ids=" ".join)
@pytest.mark.parametrize("written", ["20%", "20 %", "２０％"])
def test_mu_accepts_percent(command, written):
    """20% is 0.2, as --inset has it."""
    assert answer(*command, "--mu", written)["results"] == answer(*command, "--mu", "0.2")["results"]


def test_mu_range_accepts_percent():
    """Lists and ranges, too."""
    found = answer("slide", "elcentro_1940_ns", "--mu", "5%:15%:5%,0.3")
    assert [each["mu"] for each in found["results"]] == [0.05, 0.1, 0.15, 0.3]
    done = CliRunner().invoke(main, ["slide", "--mu", "x%"])
    assert done.exit_code == 2 and "Traceback" not in done.output


def test_lengths_accept_full_width_characters():
    """What is typed in Japanese, or copied from a spreadsheet, has such letters."""
    wide = ["--width", "24㎝", "--height", "７２ｃｍ", "--inset", "１０％"]
    plain = ["--width", "24cm", "--height", "72cm", "--inset", "10%"]
    assert answer("rock", "elcentro_1940_ns", *wide)["parameters"] == answer("rock", "elcentro_1940_ns", *plain)["parameters"]


@pytest.mark.parametrize(("name", "azimuth"), [("N45E", "45"), ("s30.5w", "210.5"), ("NW", "315"), ("45°", "45"), ("10度", "10")])
def test_component_bearing_is_rejected_with_azimuth(name, azimuth):
    """The message says what to write; a record that has a component of that name has it, and names that are none are listed alone."""
    done = CliRunner().invoke(main, ["slide", "--mu", "0.2", "--component", name])
    assert done.exit_code == 3
    assert f"for an azimuth in degrees clockwise from north, write {azimuth}" in " ".join(done.stderr.split())
    with pytest.raises(ComponentError) as told:
        read("synthetic_jma.csv").component("N95E")
    assert "azimuth" not in str(told.value)
