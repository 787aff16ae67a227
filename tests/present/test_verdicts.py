"""The first line holds the number that matters, and no two lines say 1.00 and mean different things."""

import re
from dataclasses import replace

import numpy as np
import pytest

from seisblock import Block, Contact, SlidingBase, solve_jump, solve_respond, solve_rock, solve_slide
from seisblock.criteria.card import Row
from seisblock.present.text.criteria import ratio
from seisblock.present.text.jump import verdict as jump_verdict
from seisblock.present.text.onset import SLIDES, onset
from seisblock.present.text.respond import verdict as respond_verdict
from seisblock.present.text.rock import first_line
from seisblock.present.text.slide import sentence as slide_sentence
from tests.present.long_record import PAVILION, motion


def test_what_keeps_still_says_what_it_would_take():
    """Whatever rests answers with the shaking that would move it, and with how many times the record's peak that is."""
    still = motion("NS", 0.1)
    peak = np.abs(still.horizontal).max()
    found = {
        first_line(solve_rock(Block(0.3, 0.9), still)): 9.80665 / 3.0,
        slide_sentence(solve_slide(SlidingBase(0.3), still)): 0.3 * 9.80665,
        respond_verdict(solve_respond(Block(0.45, 1.8), still, mu=0.2)): 0.2 * 9.80665,
        jump_verdict(solve_jump(PAVILION, still, contact=Contact(mu=0.18))): 4.6124,
    }
    for told, level in found.items():
        acceleration, times = map(float, re.search(r"from (\S+) gal on, (\S+) times this record's PGA", told).groups())
        assert acceleration == pytest.approx(100.0 * level, abs=0.06) and times == pytest.approx(level / peak, rel=6e-3)
    above = replace(still, rows=40.0 * still.rows)
    assert onset(SLIDES, 2.0, above, gal=False) == "slides from 2.0000 m/s² on"


def test_a_ratio_of_all_but_one_shows_on_which_side_it_is():
    """1.00 stands and 1.00 falls are not told apart: there are as many digits as it takes."""
    for demand, told in ((0.9996, "0.9996"), (1.0, "1.00"), (1.0 + 1e-5, "1.00001"), (1.0 + 1e-9, "1.000000"), (1.02, "1.02")):
        assert ratio(Row("criterion", "where", "m/s^2", None, None, 1.0, demand, demand > 1.0)) == told
