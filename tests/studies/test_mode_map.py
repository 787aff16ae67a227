"""Maps of what happens: every cell is a run of respond, and obeys the closed forms of initiation where they are exact."""

import math

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.core.errors import ParameterError
from seisblock.models.respond import solve_respond
from seisblock.records import Motion
from seisblock.studies.respond.mode_map import MODES_BY_SEVERITY, VISIBLE_SLIP_M, mode_map
from tests.models.respond.cases import constant_push as pulse
from tests.models.respond.cases import shaking

MU = np.array([0.05, 0.11, 0.17, 0.23, 0.29, 0.35, 0.41, 0.47, 0.55, 0.65, 0.8, 1.1])
RATIO = np.array([0.08, 0.14, 0.2, 0.26, 0.32, 0.38, 0.44, 0.52, 0.6, 0.7, 0.9, 1.2])
REST, SLIDE = MODES_BY_SEVERITY.index("rest"), MODES_BY_SEVERITY.index("slide")


def test_mode_map_cells_obey_initiation_limits():
    """Under a record with vertical motion, at rest, sliding, or turning: which of them A, mu and b/h alone decide, without exception."""
    modes = mode_map(MU, 0.8, np.arctan(RATIO), shaking(4, 4.0, seconds=12.0))
    assert modes.b_over_h == pytest.approx(RATIO, rel=1e-14)
    mu, ratio = np.meshgrid(MU, RATIO)
    assert 0.4 < modes.loading < 1.0
    rests = (mu >= modes.loading) & (ratio >= modes.loading)
    slides = ~rests & (mu < ratio)
    np.testing.assert_array_equal(modes.governing == REST, rests)
    np.testing.assert_array_equal(modes.governing == SLIDE, slides)
    assert rests.any() and slides.any() and not (rests | slides).all()
    assert {MODES_BY_SEVERITY[index] for index in np.unique(modes.governing)} >= {"rest", "slide", "rock", "overturned"}


def test_mode_map_slip_under_pulse_follows_closed_form():
    """A rectangular pulse: a rocking body has slid, to the last bit, if its friction is below (A - h q)/(1 + b q), and only then."""
    modes = mode_map(np.linspace(0.105, 0.995, 40), 2.0, np.arctan(RATIO), pulse(6.0, seconds=0.05), settle_s=0.0)
    assert modes.loading == pytest.approx(6.0 / 9.80665, rel=1e-14)
    for i in np.flatnonzero(~np.isnan(modes.friction_to_rock)):
        np.testing.assert_array_equal(modes.slip_path_m[i] > 0.0, modes.mu < modes.friction_to_rock[i])
    np.testing.assert_array_equal(np.isnan(modes.friction_to_rock), modes.loading <= RATIO)


def test_mode_map_cells_equal_solve_respond():
    """Mode, lean, path and end are those of the body by itself, edges worn and impacts elastic as given."""
    motion = shaking(4, 5.0, seconds=8.0)
    modes = mode_map([0.2, 0.6], 1.0, np.arctan([0.15, 0.3, 0.6]), motion, inset=EdgeWear(share=0.05), restitution=0.2, vertical=False)
    for i, ratio in enumerate((0.15, 0.3, 0.6)):
        alpha = math.atan(ratio)
        block = Block(math.sin(alpha), math.cos(alpha)).with_wear(0.05)
        for j, mu in enumerate((0.2, 0.6)):
            first = solve_respond(block, motion, mu=mu, restitution=0.2, vertical=False, sensitivity=False).outcome
            assert (MODES_BY_SEVERITY[modes.governing[i, j]] == "overturned") == first.overturned
            assert (MODES_BY_SEVERITY[modes.governing[i, j]] == "rest") == (first.outcome == "rests")
            assert modes.slip_path_m[i, j] == first.slip_path_m
            assert modes.final_displacement_m[i, j] == first.final_displacement_m
            assert modes.max_rotation_ratio[i, j] == pytest.approx(first.max_rotation_ratio, rel=1e-14)


def test_mode_map_ignores_invisible_motion():
    """A rocking body that slides by less than half a millimetre rocks, and hops too short to be seen are no flights."""
    motion = shaking(4, 9.0, seconds=12.0)
    modes = mode_map(np.linspace(0.5, 1.0, 12), 2.0, np.arctan(np.linspace(0.45, 0.9, 12)), motion, restitution=0.1)
    values = np.array(MODES_BY_SEVERITY)[modes.governing]
    assert (modes.slip_path_m[values == "rock"] < VISIBLE_SLIP_M).all()
    assert (modes.slip_path_m[values == "slide-rock"] >= VISIBLE_SLIP_M).all()
    assert {"rock", "slide-rock"} <= set(values.ravel())
    falling = mode_map([0.5], 1.0, math.atan(0.9), Motion.from_arrays(np.zeros(61), 0.01, vertical=np.full(61, -12.0)))
    assert MODES_BY_SEVERITY[falling.governing[0, 0]] == "flight" and math.isinf(falling.loading)


def test_mode_map_over_sizes_obeys_similarity_and_reports_progress():
    """Length L and time sqrt(L): the same modes for a body four times as large under a motion half as fast."""
    motion = shaking(4, 4.0, seconds=6.0)
    collected = []
    small = mode_map(
        MU, [0.3, 0.6, 1.2], math.atan(0.3), motion, settle_s=30.0, progress=lambda result, all_: collected.append((result, all_))
    )
    slow = Motion(motion.acceleration, 2.0 * motion.dt)
    large = mode_map(MU, [1.2, 2.4, 4.8], math.atan(0.3), slow)
    observed = small.slip_path_m >= VISIBLE_SLIP_M
    np.testing.assert_array_equal(small.governing[observed], large.governing[observed])
    np.testing.assert_allclose(4.0 * small.slip_path_m, large.slip_path_m, rtol=1e-6, atol=1e-9)
    assert collected[-1] == (36, 36)


@pytest.mark.parametrize(
    ("frictions", "sizes", "alphas", "says"),
    [
        ([0.1, -0.2], 1.0, 0.3, "friction"),
        ([0.1], [1.0, -1.0], 0.3, "size 2R must be positive"),
        ([0.1], 1.0, [0.3, 2.0], "slenderness alpha"),
        ([0.1], [1.0, 2.0], [0.2, 0.3, 0.4], "must have the same length"),
        ([], 1.0, 0.3, "at least one cell"),
    ],
)
def test_mode_map_rejects_invalid_numbers(frictions, sizes, alphas, says):
    """One sentence for each number out of its range."""
    with pytest.raises(ParameterError, match=says):
        mode_map(frictions, sizes, alphas, shaking(4, 4.0, seconds=1.0))
