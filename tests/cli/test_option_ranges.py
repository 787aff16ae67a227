"""Values outside the range of an option are rejected in one sentence in the selected language."""

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
    result = CliRunner().invoke(main, words)
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, result.stdout, result.stderr.strip().rpartition("\n")[2]


@pytest.mark.parametrize("option", ["--component", "--azimuth"])
@pytest.mark.parametrize("value", ["1e300", "-361", "700"])
def test_azimuth_beyond_full_turn_is_rejected(option, value):
    """No direction is looked for in what rounding leaves of a number."""
    code, answer, message = run("rock", *SHORT, *BLOCK, f"{option}={value}")
    assert (code, answer) == (3, "") and "the azimuth must lie in [-360, 360], found" in message


@pytest.mark.parametrize("value", ["-360", "-90", "0", "360"])
def test_azimuth_within_full_turn_is_accepted(value):
    """Both ways round."""
    assert run("rock", *SHORT, *BLOCK, f"--azimuth={value}", "--quiet")[0] == 0


@pytest.mark.parametrize("option", ["--component", "--azimuth"])
@pytest.mark.parametrize("value", ["", ",", "NS,,", " "])
def test_empty_component_list_is_rejected(option, value):
    """An empty variable of a script does not ask for every component."""
    code, answer, message = run("rock", *SHORT, *BLOCK, f"{option}={value}")
    if (option, value) == ("--component", "NS,,"):
        assert code == 0
    else:
        assert (code, answer) == (2, "") and option in message


def test_empty_surface_is_rejected():
    """It does not stand for the friction of the body."""
    code, answer, message = run("respond", *SHORT, "--block", "gravestone", "--surface=", "--runs", "0")
    assert (code, answer) == (3, "") and "no friction coefficient for the pair ''" in message


@pytest.mark.parametrize(
    ("value", "reason"),
    [("0", "the value must not be zero"), ("-0.0", "the value must not be zero"), ("1e-300", "the value is outside the computable range")],
)
def test_zero_scale_is_rejected(value, reason):
    """Everything would stand."""
    code, answer, message = run("slide", *SHORT, "--mu", "0.2", f"--scale={value}")
    assert (code, answer) == (2, "") and reason in message
    assert "0 は指定できません" in run("--lang", "ja", "slide", *SHORT, "--mu", "0.2", "--scale=0")[2]


def test_negative_scale_is_accepted():
    """Is one."""
    assert run("slide", *SHORT, "--mu", "0.2", "--scale=-1", "--quiet")[0] == 0


def test_huge_integers_are_rejected():
    """Nobody counts them."""
    slow = run("slide", *SHORT, "--mu", "0.2", "--no-vertical", "--scale=1e-50", "--quiet", "--component", "NS")[1]
    assert "sliding threshold 196.1 gal (2.10e+49 times this record's" in slow and not re.search(r"\d{15}", slow)
    smooth = run("slide", *SHORT, "--mu", "0.2", "--mu-kinetic=1e-60", "--quiet", "--component", "NS")[1]
    assert "e+" in smooth and not re.search(r"\d{15}", smooth)


def test_unknown_pile_does_not_suggest_blocks():
    """Bundled bodies that are no piles are not offered in its place."""
    code, answer, message = run("stack", "--stones", "missing.toml")
    assert (code, answer) == (3, "") and message.endswith("bundled: column, lantern, statue, wagata")


def test_zero_record_is_rejected(tmp_path):
    """A record of zeros is rejected."""
    path = tmp_path / "still.csv"
    path.write_text("time,NS (gal),EW (gal),UD (gal)\n" + "".join(f"{i / 100:.2f},0,0,0\n" for i in range(200)))
    result = CliRunner().invoke(main, ["slide", str(path), "--mu", "0.2"])
    assert result.exit_code == 0 and "all samples of all components are 0" in result.stderr
    assert run("slide", str(path), "--mu", "0.2", "--strict")[0] == 3


def test_tiny_inset_is_treated_as_sharp():
    """A bevel that vanishes against its stone is none: nothing is divided by it."""
    insets = ("0", "1e-300", "1e-20", "9e-10", "1e-300cm")
    # the nominal pile and few samples: each is computed with the inset
    answers = {inset: run("stack", *SHORT, "--component", "NS", "--inset", inset, "--runs", "5", "--quiet") for inset in insets}
    assert {inset: answer[0] for inset, answer in answers.items()} == dict.fromkeys(insets, 0)
    assert {answer[1].splitlines()[0] for answer in answers.values()} == {answers["0"][1].splitlines()[0]}


def test_absurd_frequency_is_rejected_without_numpy_warning(recwarn):
    """One sentence, and no warning of the machine's own numbers."""
    code, answer, message = run("overturn-rate", "--cemetery", "aoyama.csv", "--pga", "300", "--frequency", "1e300")
    assert (code, answer) == (3, "") and "frequency is outside the computable range (1e-100 to 1e100), found 1e+300 Hz" in message
    assert not recwarn.list


@pytest.mark.parametrize(
    ("option", "value", "reason"),
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
def test_map_rejects_options_without_any_answer(option, value, reason):
    """Options that no station can answer are rejected at once (was: reported per station, exit code 0)."""
    code, answer, message = run("map", "--block", "gravestone", f"{option}={value}")
    assert (code, answer) == (3, "") and reason in message


def test_map_rejects_component():
    """Every direction is looked in: it was taken and left."""
    code, answer, message = run("map", "--block", "gravestone", "--component", "NS", "--runs", "0")
    assert (code, answer) == (2, "") and "--component has no effect on map" in message
    assert run("map", "--component", "280", "--target-pga", "300", "--quiet")[0] == 0


def slide_station(*words):
    """Return the entry of the station at which an object slides."""
    result = CliRunner().invoke(main, ["map", "--json", "--solver", "slide", *words])
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)["results"][0]


def test_mu_option_overrides_friction_of_file():
    """`--mu` beside a body that brings its own: the body's was taken, without a word."""
    names, plain = slide_station("--block", "gravestone", "--mu", "0.1"), slide_station("--mu", "0.1")
    assert names["max_slip_m"] == plain["max_slip_m"] > 0.0
    assert slide_station("--block", "gravestone")["max_slip_m"] < names["max_slip_m"]
    assert (
        slide_station("--block", "gravestone", "--surface", "teflon/steel")["max_slip_m"]
        == slide_station("--surface", "teflon/steel")["max_slip_m"]
    )


@pytest.mark.parametrize("value", ["1e-300", "1e-17", "1e-300cm"])
def test_scan_with_tiny_inset_keeps_its_base(value, recwarn):
    """The body turns about the edges of its base, which it was reported to lack."""
    sharp, worn = (run("body", "boulder.ply", "--inset", inset) for inset in ("0", value))
    assert sharp[0] == worn[0] == 0 and sharp[1].splitlines()[0] == worn[1].splitlines()[0]
    assert not recwarn.list


def test_interval_level_rounding_to_zero_is_rejected():
    """A level that rounds to nothing was divided by."""
    words = ("shaken_block.csv", *BLOCK, "--free", "alpha", "--scatter", "0.05", "--lapse", "0.02", "--runs", "1")
    code, answer, message = run("fit", *words, "--confidence=1e-300")
    assert (code, answer) == (3, "") and "the level of the intervals must lie in [0.001, 1), found 1e-300" in message


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
def test_unused_option_is_still_validated(line, value):
    """An option without effect in this call is rejected."""
    code, answer, message = run(*line, value)
    assert (code, answer) == (2, "") and f"'{line[-1]}': the value must be a finite number, found {value}" in message


@pytest.mark.parametrize(
    ("option", "value", "expected", "says"),
    [
        ("--depth", "0", 2, "the value must be positive, found"),
        ("--depth", "-1cm", 2, "the value must be positive, found"),
        ("--tenon", "-1cm", 3, "--tenon must be zero or more"),
        ("--drop", "0.1,-1cm", 3, "--drop must be zero or more"),
    ],
)
def test_mortise_dimensions_must_be_positive(option, value, expected, says):
    """The width of a block is positive; tenons and a drop may be none, but not less."""
    code, answer, message = run("jump", *SHORT, option, value)
    assert (code, answer) == (expected, "") and says in message


def test_empty_paper_key_is_rejected():
    """Every key begins with nothing: all cases ran."""
    code, answer, message = run("validate", "--paper=", "--quick")
    assert (code, answer) == (3, "") and "no validation case for ''" in message
