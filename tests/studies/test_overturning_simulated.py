"""Simulated stones with inset pivots overturn as in [Furukawa2009]_ eq. (9), those without do not."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.core.errors import ParameterError
from seisblock.criteria.gravestones import overturning_level
from seisblock.models.rock.solve import solve_rock
from seisblock.readers import read
from seisblock.records import motion_of
from seisblock.records.process import scale
from seisblock.studies.survey.overturning_rate import CURVE_PGA, overturning_rate
from seisblock.studies.survey.simulation import simulated_curve, simulated_overturns, sine_motion, stone_block

AOYAMA = read_cemetery("aoyama.csv")
GRID = Cemetery(tuple(Stone(float(ratio)) for ratio in np.arange(1.25, 6.51, 0.05)))


def fitted_level(frequency: float, inset: EdgeWear) -> float:
    """Return a(f) of (7) from the least ratios that fall under sines of 300 to 1300 gal, in gal."""
    motion, products = sine_motion(1.0, frequency), []
    for pga in np.arange(3.0, 13.1, 1.0):
        falls = simulated_overturns(GRID, motion, scale=float(pga), inset=inset)
        if falls.any() and not falls.all():
            products.append(100.0 * pga * GRID.ratios[falls].min())
    return float(np.mean(products))


def test_inset_pivots_keep_mass_and_inertia():
    """Inset pivots change the arms and nothing else."""
    plain, inset = stone_block(Stone(2.6), inset=SHARP_EDGES), stone_block(Stone(2.6))
    assert plain == Block(0.2424, 2.6 * 0.2424, name="sao")
    assert inset.total_mass == pytest.approx(Block(0.2424, 2.6 * 0.2424).total_mass)
    assert inset.gyration_squared == pytest.approx((0.2424**2 + (2.6 * 0.2424) ** 2) / 12)
    assert inset.rocking_threshold() == pytest.approx(0.9 * plain.rocking_threshold())


@pytest.mark.parametrize("frequency", [0.5, 1.0, 1.5, 2.0])
def test_inset_pivots_reproduce_eq_9(frequency):
    """With the pivots of 5 x 5 contact points a(f) is within a tenth of (9), without inset it is more than 20 % too high."""
    printed = 100.0 * float(overturning_level(frequency))
    assert fitted_level(frequency, EdgeWear(share=0.1)) == pytest.approx(printed, rel=0.1)
    assert fitted_level(frequency, SHARP_EDGES) > 1.2 * printed


def test_cemetery_stones_equal_single_stones():
    """Stones that are alike are solved once, and each gets the verdict of the solver."""
    motion = motion_of(read("synthetic_jma.csv"), "NS")
    mixed = Cemetery((Stone(2.0), Stone(2.9, count=2), Stone(2.0), Stone(4.0, width=0.15)))
    falls = simulated_overturns(mixed, motion, scale=0.6)
    scaled = motion_of(scale(read("synthetic_jma.csv"), 0.6), "NS")
    single = [solve_rock(stone_block(Stone(r, w)), scaled).outcome.overturned for r, w in ((2.0, 0.2424), (2.9, 0.2424), (4.0, 0.15))]
    assert falls.tolist() == [single[0], single[1], single[1], single[0], single[2]]


def test_simulated_rates_are_close_to_eq_9_at_low_frequency():
    """At 0.5 Hz and with the pivots of 5 x 5 contact points the simulated rates are within 0.05 of (9)."""
    for point in simulated_curve(AOYAMA, [([sine_motion(1.0, 0.5)], 0.5)], inset=EdgeWear(share=0.1)):
        assert point.rate == pytest.approx(overturning_rate(AOYAMA, point.pga_m_s2, 0.5).rate, abs=0.05)


def test_simulated_rate_rejects_unsupported_stones():
    """A dowel, an inset that leaves no base and a sine without a frequency are one sentence."""
    with pytest.raises(ParameterError, match="does not model dowels"):
        simulated_overturns(AOYAMA.with_dowels(), sine_motion(1.0, 1.0))
    with pytest.raises(ParameterError, match=r"inset of 0\.1212 m per side is too large"):
        stone_block(Stone(2.0), inset=EdgeWear(share=0.5))
    with pytest.raises(ParameterError, match="the frequency of the sine must be positive"):
        sine_motion(1.0, 0.0)


def test_simulated_curve_has_the_steps_of_the_criterion():
    """The simulated curve advanced in steps of 100 gal, beside curves of the criterion in steps of 50."""
    curve = simulated_curve(GRID, [([sine_motion(1.0, 2.0)], 2.0)])
    assert np.diff([point.pga_m_s2 for point in curve]) == pytest.approx(np.diff(CURVE_PGA).max())
