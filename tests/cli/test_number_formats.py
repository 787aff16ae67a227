"""Numbers as people write them: per cent in a friction, full-width letters in lengths; and what an azimuth is written as."""

import json
import re

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


@pytest.mark.parametrize(
    "words",
    [
        ["criteria", "--block", "gravestone", "--pga", "400gal", "--pgv", "0.4m/s"],
        ["criteria", "--block", "gravestone", "--pga", "４ m/s2", "--pgv", "40 kine"],
        ["overturn-rate", "--cemetery", "aoyama.csv", "--pga", "300gal:4m/s2:100gal", "--frequency", "1.5Hz"],
        ["criteria", "--block", "gravestone", "elcentro_1940_ns", "--target-pga", "400gal"],
    ],
)
def test_peaks_accept_units(words):
    """A unit was refused in --pga, --pgv, --frequency and --target-pga, but required in --threshold."""
    bare = [re.sub(r"^４ m/s2|400gal$", "400", word) for word in words]
    bare = ["300:400:100" if ":" in word else re.sub(r"^(0\.4m/s|40 kine)$", "40", word).replace("Hz", "") for word in bare]
    assert bare != words
    assert answer(*words)["results"] == answer(*bare)["results"]


@pytest.mark.parametrize(
    "words",
    [
        ["slide", "sine:300gal@1.5Hz,1s", "--mu", "0.2", "--slope", "5deg"],
        ["slide", "sine:300gal@1.5Hz,1s", "--mu", "0.2", "--slope", "0:１０°:5度"],
        ["respond", "synthetic_jma.csv", "--window", "25:27", "--block", "gravestone", "--runs", "20", "--vary-azimuth", "5deg"],
        ["infer", "elcentro_1940_ns", "--twist", "1deg", "--block", "gravestone", "--mu", "0.5", "--runs", "20", "--window", "1:3"],
    ],
)
def test_angles_accept_their_unit(words):
    """``--twist 5deg`` was refused."""
    bare = [re.sub("deg|°|度", "", word) for word in words]
    assert bare != words
    assert answer(*words)["results"] == answer(*bare)["results"]


def test_peaks_in_other_units_are_refused_or_doubted():
    """``--pga 0.4``, meant in g, was computed as 0.4 gal without a word."""
    words = ["criteria", "--block", "gravestone", "--pgv", "40"]
    result = CliRunner().invoke(main, [*words, "--pga", "400furlong"])
    assert result.exit_code == 2 and "'400furlong' is not a valid float" in result.stderr
    result = CliRunner().invoke(main, [*words, "--pga", "0.4"])
    assert "--pga: 0.4 gal moves no object: check the unit" in result.stderr
    assert "check the unit" not in CliRunner().invoke(main, [*words, "--pga", "0.4g"]).stderr


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
