"""The first line holds the number that matters, and no two lines say 1.00 and mean different things."""

import re
from dataclasses import replace

import numpy as np
import pytest

from seisblock import Block, Contact, Motion, SlidingBase, motion_of, read, solve_jump, solve_respond, solve_rock, solve_slide
from seisblock.criteria.compare import CriterionResult
from seisblock.models.jump.describe import describe as jump_verdict
from seisblock.models.respond.describe import describe as respond_verdict
from seisblock.models.rock.describe import describe
from seisblock.models.slide.describe import describe as slide_sentence
from seisblock.output.text.tables import impacts_cell, tilt_ratio_cell
from seisblock.output.text.threshold import SLIDES, threshold_text
from seisblock.report.text.criteria import format_ratio
from tests.report.long_record import PAVILION, motion


def test_no_motion_headline_states_factor_to_move():
    """Whatever rests answers with the shaking that would move it, and with how many times the record's peak that is."""
    still = motion("NS", 0.1)
    peak = np.abs(still.horizontal).max()
    solution = {
        describe(solve_rock(Block(0.3, 0.9), still, vertical=False)): 9.80665 / 3.0,
        slide_sentence(solve_slide(SlidingBase(0.3), still, vertical=False)): 0.3 * 9.80665,
        respond_verdict(solve_respond(Block(0.45, 1.8), still, mu=0.2, vertical=False)): 0.2 * 9.80665,
        jump_verdict(solve_jump(PAVILION, still, contact=Contact(mu=0.18))): 4.6124,
    }
    for text, level in solution.items():
        acceleration, times = map(float, re.search(r"threshold (\S+) gal \((\S+) times this record's PGA", text).groups())
        assert acceleration == pytest.approx(100.0 * level, abs=0.06) and times == pytest.approx(level / peak, rel=6e-3)
    above = replace(still, rows=40.0 * still.rows)
    assert threshold_text(SLIDES, (0.2, 0.2), above, gravity=10.0, gal=False) == "sliding threshold 2.0000 m/s²"


def _stated_factor(sentence):
    """Return the scale factor stated in a sentence."""
    return float(re.search(r"([^\s(]+) times this record", sentence).group(1))


@pytest.mark.parametrize("component", ["10", "280"])
def test_factor_to_move_holds_with_vertical_motion(component):
    """The stated factor applies to both components together in each model with vertical motion."""
    still = motion_of(read("hanmer_springs_2016"), component)
    stronger = {
        lambda m: solve_rock(Block(0.24, 0.72), m, vertical=True): (describe, lambda outcome: outcome.rocks),
        lambda m: solve_respond(Block(0.24, 0.72), m, mu=0.4): (respond_verdict, lambda outcome: outcome.outcome != "rests"),
        lambda m: solve_slide(SlidingBase(0.4), m, vertical=True): (slide_sentence, lambda outcome: outcome.slips),
    }
    for solve, (say, moves) in stronger.items():
        factor = _stated_factor(say(solve(still)))
        assert factor != pytest.approx(0.4 * 9.80665 / np.abs(still.horizontal).max(), rel=0.02)
        assert not moves(solve(replace(still, rows=0.99 * factor * still.rows)).outcome)
        assert moves(solve(replace(still, rows=1.01 * factor * still.rows)).outcome)


@pytest.mark.parametrize("offset", [-0.02, 0.02])
def test_factor_to_move_uses_peak_towards_weaker_side(offset):
    """The record's larger peak may push to the stronger side."""
    still, block = motion_of(read("elcentro_1940_ns.csv"), "NS"), Block(0.24, 0.72, centroid_offset=offset)
    still = replace(still, rows=0.5 * still.rows)
    factor = _stated_factor(describe(solve_rock(block, still)))
    assert factor == _stated_factor(respond_verdict(solve_respond(block, still, mu=0.6)))
    assert not solve_rock(block, replace(still, rows=0.99 * factor * still.rows)).outcome.rocks
    assert solve_rock(block, replace(still, rows=1.01 * factor * still.rows)).outcome.rocks


def test_ratio_near_one_shows_enough_digits():
    """Factors have enough digits to distinguish a standing from a falling run."""
    for demand, text in ((0.9996, "0.9996"), (1.0, "1.00"), (1.0 + 1e-5, "1.00001"), (1.0 + 1e-9, "1.000000"), (1.02, "1.02")):
        assert format_ratio(CriterionResult("criterion", "where", "m/s^2", None, None, 1.0, demand, demand > 1.0)) == text


def test_factor_just_above_threshold_is_not_one():
    """A body that remains at rest by a hair does not need "1.00 times this record"."""
    peak = 2.0 / 1.0004
    text = threshold_text(SLIDES, (0.2, 0.2), Motion.from_arrays([0.0, peak, 0.0], 0.01), gravity=10.0)
    assert "(1.0004 times" in text


def test_impacts_and_tilt_of_fallen_or_hardly_rocking_block_are_readable():
    """A fallen block has no ratio of tilts, and a tilt of 0.02 degrees no 1381 impacts."""
    assert tilt_ratio_cell(6.412, overturned=True) == ">1"
    assert (impacts_cell(1381, 0.001), impacts_cell(1381, 0.01)) == ("negligible", "1381")
