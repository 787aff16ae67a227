"""Numbers as people write them: per cent in a friction, full-width letters in lengths; and what an azimuth is written as."""

import json

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.core.errors import ComponentError
from seisblock.readers import read


def answer(*words):
    """Return the document of a command line."""
    result = CliRunner().invoke(main, [*words, "--json", "--quiet"])
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


@pytest.mark.parametrize("command", [["slide", "elcentro_1940_ns"], ["rock", "elcentro_1940_ns", "--block", "gravestone"]], ids=" ".join)
@pytest.mark.parametrize("output", ["20%", "20 %", "２０％"])
def test_mu_accepts_percent(command, output):
    """20% is 0.2, as --inset has it."""
    assert answer(*command, "--mu", output)["results"] == answer(*command, "--mu", "0.2")["results"]


def test_mu_range_accepts_percent():
    """Lists and ranges, too."""
    content = answer("slide", "elcentro_1940_ns", "--mu", "5%:15%:5%,0.3")
    assert [item["mu"] for item in content["results"]] == [0.05, 0.1, 0.15, 0.3]
    result = CliRunner().invoke(main, ["slide", "--mu", "x%"])
    assert result.exit_code == 2 and "Traceback" not in result.output


def test_lengths_accept_full_width_characters():
    """Lengths accept full-width characters, as typed in Japanese or copied from a spreadsheet."""
    wide = ["--width", "24㎝", "--height", "７２ｃｍ", "--inset", "１０％"]
    plain = ["--width", "24cm", "--height", "72cm", "--inset", "10%"]
    assert answer("rock", "elcentro_1940_ns", *wide)["parameters"] == answer("rock", "elcentro_1940_ns", *plain)["parameters"]


@pytest.mark.parametrize(("name", "azimuth"), [("N45E", "45"), ("s30.5w", "210.5"), ("NW", "315"), ("45°", "45"), ("10度", "10")])
def test_component_bearing_is_rejected_with_azimuth(name, azimuth):
    """The message names the accepted notation; a record with a component of that name uses it."""
    result = CliRunner().invoke(main, ["slide", "--mu", "0.2", "--component", name])
    assert result.exit_code == 3
    assert f"for an azimuth in degrees clockwise from north, write {azimuth}" in " ".join(result.stderr.split())
    with pytest.raises(ComponentError) as error:
        read("synthetic_jma.csv").component("N95E")
    assert "azimuth" not in str(error.value)
