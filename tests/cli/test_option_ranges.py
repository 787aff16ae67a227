"""Values of options that nobody can mean: refused in one sentence, in the language asked for."""

from __future__ import annotations

import json
import re

import pytest
from click.testing import CliRunner

from seisblock.cli import main

SHORT = ("synthetic_jma.csv", "--window", "25.5:26.5")
BLOCK = ("--width", "24cm", "--height", "72cm")


def run(*words):
    """Return exit code, answer and the last line on stderr."""
    done = CliRunner().invoke(main, words)
    assert done.exception is None or isinstance(done.exception, SystemExit)
    return done.exit_code, done.stdout, done.stderr.strip().rpartition("\n")[2]


@pytest.mark.parametrize("option", ["--component", "--azimuth"])
@pytest.mark.parametrize("value", ["1e300", "-361", "700"])
def test_an_azimuth_beyond_a_turn(option, value):
    """No direction is looked for in what rounding leaves of a number."""
    code, answer, said = run("rock", *SHORT, *BLOCK, f"{option}={value}")
    assert (code, answer) == (3, "") and "the azimuth must lie in [-360, 360], found" in said


@pytest.mark.parametrize("value", ["-360", "-90", "0", "360"])
def test_an_azimuth_within_a_turn(value):
    """Both ways round."""
    assert run("rock", *SHORT, *BLOCK, f"--azimuth={value}", "--quiet")[0] == 0


@pytest.mark.parametrize("option", ["--component", "--azimuth"])
@pytest.mark.parametrize("value", ["", ",", "NS,,", " "])
def test_a_list_of_no_directions(option, value):
    """An empty variable of a script does not ask for every component."""
    code, answer, said = run("rock", *SHORT, *BLOCK, f"{option}={value}")
    if (option, value) == ("--component", "NS,,"):
        assert code == 0
    else:
        assert (code, answer) == (2, "") and option in said


def test_a_surface_without_a_name():
    """It does not stand for the friction of the body."""
    code, answer, said = run("respond", *SHORT, "--block", "gravestone", "--surface=", "--runs", "0")
    assert (code, answer) == (3, "") and "no friction coefficient for the pair ''" in said


@pytest.mark.parametrize(
    ("value", "why"),
    [("0", "the value must not be zero"), ("-0.0", "the value must not be zero"), ("1e-300", "the value is outside the computable range")],
)
def test_a_scale_that_leaves_no_motion(value, why):
    """Everything would stand."""
    code, answer, said = run("slide", *SHORT, "--mu", "0.2", f"--scale={value}")
    assert (code, answer) == (2, "") and why in said
    assert "0 は指定できません" in run("--lang", "ja", "slide", *SHORT, "--mu", "0.2", "--scale=0")[2]


def test_a_scale_that_turns_the_record_round():
    """Is one."""
    assert run("slide", *SHORT, "--mu", "0.2", "--scale=-1", "--quiet")[0] == 0


def test_no_number_of_a_hundred_digits():
    """Nobody counts them."""
    slow = run("slide", *SHORT, "--mu", "0.2", "--scale=1e-50", "--quiet", "--component", "NS")[1]
    assert "sliding threshold 196.1 gal (2.10e+49 times this record's" in slow and not re.search(r"\d{15}", slow)
    smooth = run("slide", *SHORT, "--mu", "0.2", "--mu-kinetic=1e-60", "--quiet", "--component", "NS")[1]
    assert "e+" in smooth and not re.search(r"\d{15}", smooth)


def test_a_pile_that_is_not_there():
    """Bundled bodies that are no piles are not offered in its place."""
    code, answer, said = run("stack", "--stones", "missing.toml")
    assert (code, answer) == (3, "") and said.endswith("bundled: column, lantern, statue, wagata")


def test_a_record_of_nothing_but_zeros(tmp_path):
    """What stands on it says nothing."""
    path = tmp_path / "still.csv"
    path.write_text("time,NS (gal),EW (gal),UD (gal)\n" + "".join(f"{i / 100:.2f},0,0,0\n" for i in range(200)))
    done = CliRunner().invoke(main, ["slide", str(path), "--mu", "0.2"])
    assert done.exit_code == 0 and "all samples of all components are 0" in done.stderr
    assert run("slide", str(path), "--mu", "0.2", "--strict")[0] == 3


@pytest.mark.parametrize("value", ["1e-300", "1e-20", "9e-10", "1e-300cm"])
def test_an_edge_that_is_hardly_worn(value):
    """A bevel that vanishes against its stone is none: nothing is divided by it."""
    sharp, worn = (run("stack", *SHORT, "--component", "NS", "--inset", inset, "--quiet") for inset in ("0", value))
    assert sharp[0] == worn[0] == 0 and sharp[1].splitlines()[0] == worn[1].splitlines()[0]


def test_a_frequency_of_nothing_on_earth(recwarn):
    """One sentence, and no warning of the machine's own numbers."""
    code, answer, said = run("overturn-rate", "--cemetery", "aoyama.csv", "--pga", "300", "--frequency", "1e300")
    assert (code, answer) == (3, "") and "frequency is outside the computable range (1e-100 to 1e100), found 1e+300 Hz" in said
    assert not recwarn.list


@pytest.mark.parametrize(
    ("option", "value", "why"),
    [
        ("--mu", "-1", "mu must be zero or more, found -1"),
        ("--mu", "-0.1", "mu must be zero or more, found -0.1"),
        ("--mu-kinetic", "1e300", "is outside the computable range"),
        ("--restitution", "-1", "must lie in [0, 1), found -1"),
        ("--rocking-restitution", "1e300", "must lie in [0, 1], found 1e+300"),
        ("--tenon", "-1", "must be zero or more, found -1 m"),
        ("--seed", "-1", "the seed must be an integer"),
    ],
)
def test_a_map_of_no_answers(option, value, why):
    """What no station can answer is refused at once; it was told of each station, with exit code 0."""
    code, answer, said = run("map", "--block", "gravestone", f"{option}={value}")
    assert (code, answer) == (3, "") and why in said


def test_a_component_of_a_map():
    """Every direction is looked in: it was taken and left."""
    code, answer, said = run("map", "--block", "gravestone", "--component", "NS", "--runs", "0")
    assert (code, answer) == (2, "") and "--component has no effect on map" in said
    assert run("map", "--component", "280", "--target-pga", "300", "--quiet")[0] == 0


def slid(*words):
    """Return the entry of the station at which an object slides."""
    done = CliRunner().invoke(main, ["map", "--json", "--solver", "slide", *words])
    assert done.exit_code == 0, done.stderr
    return json.loads(done.stdout)["results"][0]


def test_what_is_asked_for_goes_before_what_a_file_says():
    """`--mu` beside a body that brings its own: the body's was taken, without a word."""
    named, plain = slid("--block", "gravestone", "--mu", "0.1"), slid("--mu", "0.1")
    assert named["max_slip_m"] == plain["max_slip_m"] > 0.0
    assert slid("--block", "gravestone")["max_slip_m"] < named["max_slip_m"]
    assert slid("--block", "gravestone", "--surface", "teflon/steel")["max_slip_m"] == slid("--surface", "teflon/steel")["max_slip_m"]


@pytest.mark.parametrize("value", ["1e-300", "1e-17", "1e-300cm"])
def test_a_scan_that_is_hardly_worn(value, recwarn):
    """It turns about the edges of its base; it was said to have none left."""
    sharp, worn = (run("body", "boulder.ply", "--inset", inset) for inset in ("0", value))
    assert sharp[0] == worn[0] == 0 and sharp[1].splitlines()[0] == worn[1].splitlines()[0]
    assert not recwarn.list


def test_an_interval_of_no_width():
    """A level that rounds to nothing was divided by."""
    words = ("shaken_block.csv", *BLOCK, "--free", "alpha", "--scatter", "0.05", "--lapse", "0.02", "--runs", "1")
    code, answer, said = run("fit", *words, "--confidence=1e-300")
    assert (code, answer) == (3, "") and "the level of the intervals must lie in [0.001, 1), found 1e-300" in said


@pytest.mark.parametrize("value", ["nan", "inf", "-inf"])
@pytest.mark.parametrize(
    "line",
    [
        ("rock", *BLOCK, "--spread"),
        ("rock", *BLOCK, "--margin-limit"),
        ("criteria", *BLOCK, "--mu-kinetic"),
        ("infer", "--slid", "3cm", "--mu", "0.4", "--restitution-x"),
    ],
)
def test_what_is_no_number_is_refused_where_nothing_reads_it(line, value):
    """An option that this line has no use for: it was taken, and nothing said."""
    code, answer, said = run(*line, value)
    assert (code, answer) == (2, "") and f"'{line[-1]}': the value must be a finite number, found {value}" in said


@pytest.mark.parametrize("option", ["--depth", "--tenon"])
@pytest.mark.parametrize("value", ["0", "-1cm"])
def test_lengths_of_a_foot_that_jumps(option, value):
    """Neither width nor depth of a hole can be nothing or less."""
    code, answer, said = run("jump", *SHORT, option, value)
    assert (code, answer) == (2, "") and "the value must be positive, found" in said


def test_a_paper_without_a_name():
    """Every key begins with nothing: all cases ran."""
    code, answer, said = run("validate", "--paper=", "--quick")
    assert (code, answer) == (3, "") and "no validation case for ''" in said
