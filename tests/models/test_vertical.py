"""Vertical motion: one default for all solvers, applied where the motion has a vertical component."""

import dataclasses

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.spring_block import SpringBlock
from seisblock.core.registry import get_solver, solver_names
from seisblock.models.respond.solve import solve_respond
from seisblock.models.rigid3d.solve import solve_rigid3d
from seisblock.models.rock.solve import solve_rock
from seisblock.models.slide.solve import solve_slide
from seisblock.models.stack.solve import solve_stack
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records import Component, Motion, Record, motion_of
from seisblock.records._validation import vertical_acts, vertical_gain
from seisblock.studies.model_comparison import SHARP_BLOCK, compare_models
from seisblock.studies.sliding import slide_study

TIME = 0.01 * np.arange(200)
ALONG, UP = 4.0 * np.sin(10.0 * TIME), 3.0 * np.sin(17.0 * TIME)
THREE = Record((Component("NS", ALONG), Component("EW", 0.5 * ALONG), Component("UD", UP)), 0.01, source="three.csv")
LEVEL = Record((Component("NS", ALONG), Component("EW", 0.5 * ALONG)), 0.01, source="level.csv")
STILL_UP = Record((Component("NS", ALONG), Component("UD", 0.0 * UP)), 0.01, source="still.csv")

BLOCK = Block(0.3, 0.9, centroid_offset=0.02)
"""Asymmetric block."""

RUNS = {
    "rock": (solve_rock, BLOCK, {}),
    "slide": (solve_slide, 0.2, {}),
    "respond": (solve_respond, BLOCK, {"mu": 0.25}),
    "uplift": (solve_uplift, SpringBlock.from_frequency(0.4, 0.4, 1.8, frequency_vertical=10.0, beta=0.707), {}),
    "rigid3d": (solve_rigid3d, BLOCK, {"mu": 0.25}),
    "stack": (solve_stack, load_pile("wagata"), {"points": 2}),
}
runs = pytest.mark.parametrize("name", RUNS)


def solve(name, record, **options):
    """Return the response of the body of a solver to the NS component of a record."""
    function, body, fixed = RUNS[name]
    return function(body, motion_of(record, "NS"), **fixed, **options)


def test_every_solver_with_vertical_motion_has_the_same_default():
    """A solver either has no vertical motion or applies it where the record has one."""
    names = {name: dataclasses.fields(get_solver(name).options) for name in solver_names()}
    defaults = {name: field.default for name, fields in names.items() for field in fields if field.name == "vertical"}
    assert defaults == dict.fromkeys(RUNS, None)


@runs
def test_solver_applies_vertical_motion_of_record_by_default(name):
    """The default is the run with the factor 1, and another one than that without vertical motion."""
    response = solve(name, THREE)
    assert response.options.vertical == 1.0
    assert response.outcome == solve(name, THREE, vertical=True).outcome
    assert response.outcome != solve(name, THREE, vertical=False).outcome


@runs
def test_solver_reports_no_vertical_motion_of_record_without_vertical_component(name):
    """Options say that no vertical motion acts; the outcome is that without it."""
    response = solve(name, LEVEL)
    assert response.options.vertical == 0.0
    assert response.outcome == solve(name, LEVEL, vertical=False).outcome


@pytest.mark.parametrize(
    ("motion", "gain"),
    [
        (motion_of(THREE, "NS"), 1.0),
        (motion_of(STILL_UP, "NS"), 1.0),
        (motion_of(LEVEL, "NS"), 0.0),
        (Motion.from_arrays(ALONG, 0.01, vertical=UP), 1.0),
        (Motion.from_arrays(ALONG, 0.01, vertical=0.0 * UP), 0.0),
        (Motion.from_arrays(ALONG, 0.01), 0.0),
    ],
    ids=["vertical component", "component of zeros", "no component", "vertical array", "array of zeros", "no array"],
)
def test_vertical_gain_of_none_is_one_where_motion_has_vertical_component(motion, gain):
    """A record has a vertical component or not; without a record, the samples decide."""
    assert vertical_gain(motion, None) == gain


def test_vertical_acts_if_it_acts_in_any_motion():
    """Parameters of a document cover several motions."""
    three, level = motion_of(THREE, "NS"), motion_of(LEVEL, "NS")
    assert vertical_acts([level, three], None)
    assert not vertical_acts([level], None)
    assert not vertical_acts([level, three], False)
    assert not vertical_acts([], None)


def test_slide_study_takes_vertical_motion_of_each_motion_without_beta():
    """Each point has the factor of its motion and the slip of the single run; the runs for beta are made for given factors only."""
    three, level = motion_of(THREE, "NS"), motion_of(LEVEL, "NS")
    totals = []
    points = slide_study([0.1, 0.2], [three, level], progress=lambda _, total: totals.append(total))
    assert [(point.vertical, point.beta) for point in points] == [(1.0, None)] * 2 + [(0.0, None)] * 2
    assert [point.max_slip_m for point in points] == [
        solve_slide(mu, motion).outcome.max_slip_m for motion in (three, level) for mu in (0.1, 0.2)
    ]
    assert set(totals) == {4}
    # the same slip with a given factor, beside the run of the horizontal motion alone
    arguments = slide_study([0.1, 0.2], three, vertical=True)
    assert [point.max_slip_m for point in arguments] == [point.max_slip_m for point in points[:2]]
    single = slide_study([0.1, 0.2], three, vertical=False)
    assert [point.beta for point in arguments] == [a.max_slip_m / b.max_slip_m for a, b in zip(arguments, single, strict=True)]


@pytest.mark.parametrize("up", [0.0, 4.0, -6.0])
def test_model_comparison_searches_from_the_rocking_threshold_with_vertical_motion(up):
    """Under constant vertical acceleration an asymmetric block overturns at the factor of a search from far below."""
    motion = Motion.from_arrays(6.0 * np.sin(4.0 * TIME), 0.01, vertical=np.full(TIME.size, up))
    factor = next(r.factor for r in compare_models(BLOCK, motion).opinions if r.model == SHARP_BLOCK)
    fine = 0.05 * 1.002 ** np.arange(2200)
    first = next(f for f in fine if solve_rock(BLOCK, Motion(f * motion.acceleration, 0.01)).outcome.overturned)
    assert factor == pytest.approx(first, rel=0.004)
