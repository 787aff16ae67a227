"""Reasons for the difference to eq. (10) of [Furukawa2009]_, and accuracy of the steps of a pile."""

import numpy as np
import pytest

from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.pile.top_block import rigid_top
from seisblock.studies.gravestone_criterion import with_top
from seisblock.validation import furukawa_dowel, stack_round, stack_steps


@pytest.mark.parametrize("case", (*furukawa_dowel.CASES, *stack_steps.CASES, *stack_round.CASES), ids=lambda case: case.key)
def test_case(case):
    """Each case holds, or differs by the amount that its note explains."""
    result = case.run()
    assert result.verdict == case.status, f"{case.where}: expected {result.expected}, computed {result.computed}"


def impact_factor(stones, half):
    """Return the part of its turning that an impact leaves to stones one on the other, summed over squares of them, about both pivots."""
    old, new, floor = 0.0, 0.0, 0.0
    middles = (np.arange(400) + 0.5) / 400.0
    for stone in stones:
        x, z = np.meshgrid(stone.width * (middles - 0.5), floor + stone.height * middles)
        # of angular momentum about the new pivot, at +half, while all turns about the old one, at -half
        old += stone.mass * ((x - half) * (x + half) + z * z).mean()
        new += stone.mass * ((x - half) ** 2 + z * z).mean()
        floor += stone.height
    return old / new


@pytest.mark.parametrize(("reinforced", "left"), [(False, 0.87), (True, 0.73)])
def test_dowelled_pair_has_lower_restitution_than_sao(reinforced, left):
    """At H/B 2.6 on the outermost of 5 x 5 points, at 0.8 of the half width, as on the page on stack."""
    pile = with_top(load_pile("wagata", reinforced=reinforced).without("mizubachi"), 2.6)
    stones = pile.stones[-2:] if reinforced else pile.stones[-1:]
    expected = impact_factor(stones, 0.4 * stones[0].width)
    assert expected == pytest.approx(left, abs=0.005)
    assert rigid_top(pile, 5).restitution == pytest.approx(expected, abs=1e-5)
