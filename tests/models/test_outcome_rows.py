"""Outcomes of many bodies in one loop: bit by bit those of single runs, by each solver that has such rows."""

import math

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.errors import ParameterError
from seisblock.core.registry import SolverBody, get_solver
from seisblock.dynamics.ensemble import EVENT_CAPACITY
from seisblock.models.respond.batch import solve_runs
from seisblock.models.respond.constants import X
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rock.options import RockOptions
from seisblock.models.slide.options import SlideOptions
from seisblock.records import Motion
from seisblock.studies.batch.scalar_fields import scalar_fields
from tests.studies.batch.conftest import shaking

SIZES = [(0.1 + 0.03 * k, 0.6 + 0.1 * (k % 7)) for k in range(30)]


def motion(seed, peak, samples=1500, vertical=True):
    """Return a burst of three components."""
    _, (along, _, up) = shaking(seed, samples=samples, peak=peak)
    return Motion.from_arrays(along, 0.01, vertical=2.0 * up if vertical else None, start_s=0.3)


def rock_bodies():
    """Return blocks with options that differ from body to body, among them initial tilts and blocks that lose contact."""
    for k, (width, height) in enumerate(SIZES):
        options = RockOptions(
            linear=k % 5 == 1,
            vertical=(None, False, 0.5)[k % 3],
            restitution=None if k % 4 else 0.7,
            gravity=9.8 if k % 6 else 3.0,
            initial=(0.02 * (k % 3 - 1), 0.0) if k % 7 == 2 else (0.0, 0.0),
        )
        yield SolverBody(f"{k}", Block(width, height, centroid_offset=0.01 * (k % 3)), options)


def respond_bodies():
    """Return blocks that slide, rock, rebound and overturn, with options that differ from body to body."""
    for k, (width, height) in enumerate(SIZES):
        options = RespondOptions(
            mu=0.1 + 0.1 * (k % 9),
            restitution=(0.0, 0.3, 0.6)[k % 3],
            rocking_restitution=None if k % 4 else 0.99,
            vertical=(None, False, 0.5)[k % 3],
            sensitivity=k % 2 == 0,
        )
        yield SolverBody(f"{k}", Block(width, height, centroid_offset=0.01 * (k % 3)), options)


@pytest.mark.parametrize(("solver", "bodies"), [("rock", rock_bodies), ("respond", respond_bodies)])
@pytest.mark.parametrize(("seed", "peak", "vertical"), [(0, 2.0, True), (1, 5.0, False), (2, 8.0, True), (3, 20.0, True)])
def test_rows_equal_single_runs(solver, bodies, seed, peak, vertical):
    """Every scalar and every warning, falls during and after the record among them."""
    model, ground, falls = get_solver(solver), motion(seed, peak, vertical=vertical), set()
    groups = {}
    for body in bodies():
        shared = tuple(sorted((key, repr(value)) for key, value in body.options.keywords().items() if key not in model.row_options))
        groups.setdefault(shared, []).append(body)
    for group in groups.values():
        rows = model.solve_rows(group, ground)
        assert len(rows) >= len(group) - 2
        for body in group:
            single = model.solve(body.body, ground, **body.options.keywords())
            falls.add(single.outcome.overturned)
            if body.name in rows:
                values, warnings = rows[body.name]
                expected = {name: getattr(single.outcome, name) for name in scalar_fields(model.outcome)}
                assert {name: values[name] for name in expected} == expected
                assert tuple(warnings) == tuple(single.warnings)
    assert falls == ({False} if peak < 3.0 else {False, True})


def slide_bodies(one_way):
    """Return objects on level ground and slopes, with and without a foot, with options that differ from body to body."""
    for k in range(40):
        mu = 0.03 + 0.02 * k
        slope = 0.0 if k % 3 == 0 or one_way else (-1.0) ** k * min(0.05 * k, 1.0) * math.degrees(math.atan(mu))
        base = SlidingBase(mu, mu * (0.5 if k % 4 == 1 else 1.0), slope, 0.05 * k if k % 2 and slope else None, one_way)
        yield SolverBody(f"{k}", mu if k % 6 == 0 and not one_way else base, SlideOptions(vertical=(None, False, 0.5)[k % 3]))


@pytest.mark.parametrize("one_way", [False, True])
@pytest.mark.parametrize(("seed", "peak", "vertical"), [(0, 2.0, True), (1, 5.0, False), (3, 20.0, True)])
def test_slide_rows_equal_single_runs(one_way, seed, peak, vertical):
    """Every scalar and every warning; objects in flight, and those without a result, are left to their single run."""
    model, ground, bodies = get_solver("slide"), motion(seed, peak, vertical=vertical), list(slide_bodies(one_way))
    rows = model.solve_rows(bodies, ground)
    outcomes = []
    for body in bodies:
        try:
            single = model.solve(body.body, ground, **body.options.keywords())
        except ParameterError:
            assert body.name not in rows
            continue
        outcomes.append(single.outcome)
        assert (body.name in rows) is not single.outcome.lifted_off
        if body.name in rows:
            values, warnings = rows[body.name]
            assert values == vars(single.outcome)
            assert tuple(warnings) == tuple(single.warnings)
    assert {outcome.slips for outcome in outcomes} == ({True} if peak > 10.0 else {False, True})
    assert len(rows) == len(bodies) or (peak > 10.0 and vertical)
    assert any(outcome.reversals for outcome in outcomes) is not one_way
    assert any(outcome.fell_off_slope for outcome in outcomes) is not one_way
    assert one_way or any(outcome.slides_at_end for outcome in outcomes)


def test_slide_rows_with_more_events_than_the_tables_hold():
    """The path is that of the single run to the last bit, although the events come in portions."""
    ground = Motion.from_arrays(5.0 * np.random.default_rng(7).normal(size=12001), 0.01)
    bodies = [SolverBody(f"{mu}", SlidingBase(mu), SlideOptions()) for mu in (0.3, 0.4, 0.5, 0.6)]
    rows = get_solver("slide").solve_rows(bodies, ground)
    for body in bodies:
        single = get_solver("slide").solve(body.body, ground)
        assert len(single.events) > EVENT_CAPACITY // 2
        assert rows[body.name][0] == vars(single.outcome)


def test_rocking_after_record_continues_in_rows():
    """A record that ends in motion: free rocking decides, as in the single run."""
    ground = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    bodies = [SolverBody(f"{k}", Block(0.16 + 0.01 * k, 0.8), RockOptions()) for k in range(12)]
    rows = get_solver("rock").solve_rows(bodies, ground)
    after = [values["overturned"] for values, _ in rows.values() if values["decided_after_record"]]
    assert {True, False} <= set(after)
    for body in bodies:
        assert rows[body.name][0] == vars(get_solver("rock").solve(body.body, ground).outcome)


def test_friction_demand_by_kernel_equals_dense_evaluation():
    """Largest abs(H/N) between samples, against the forces at 400 points per sample of a finer motion."""
    time = np.arange(0.0, 4.0, 0.01)
    ground = Motion.from_arrays(3.0 * np.sin(2 * math.pi * 1.1 * time), 0.01, vertical=2.0 * np.sin(2 * math.pi * 3.1 * time))
    fine_time = np.linspace(0.0, time[-1], (time.size - 1) * 400 + 1)
    fine = Motion.from_arrays(
        np.interp(fine_time, time, ground.horizontal), 0.01 / 400, vertical=np.interp(fine_time, time, ground.vertical)
    )
    solve = get_solver("rock").solve
    for width in (0.22, 0.25, 0.5):
        coarse, dense = (solve(Block(width, 0.9), ground_motion).outcome for ground_motion in (ground, fine))
        assert coarse.max_friction_demand == pytest.approx(dense.max_friction_demand, rel=1e-5)


def test_respond_rows_repeat_no_body_that_stays_at_rest(monkeypatch):
    """A body is tried for sensitivity unless the motion leaves it at rest by more than the changes tried, under vertical motion too."""
    ground = motion(4, 3.0)
    demand = float((np.abs(ground.horizontal) / (9.80665 + ground.vertical)).max())
    runs = []

    def counted(params, motion, gains, *arguments):
        result = solve_runs(params, motion, gains, *arguments)
        runs.append((len(params), float(np.abs(result.final[:, X]).max())))
        return result

    monkeypatch.setattr("seisblock.models.respond.rows.solve_runs", counted)
    for share, repeated, slips in ((0.9, True, True), (1.0 + 3e-6, True, False), (1.0 + 5e-5, False, False)):
        runs.clear()
        bodies = [SolverBody("stone", Block(2.0, 0.5), RespondOptions(mu=share * demand))]
        (result,) = get_solver("respond").solve_rows(bodies, ground).values()
        assert (len(runs) > 1) == repeated
        assert (max(displacement for _, displacement in runs) > 0.0) == slips
        assert result[0]["sensitive"] is False
    # a given state is no rest
    runs.clear()
    tilted = RespondOptions(mu=1.5 * demand, initial=(0.0, 0.25, 0.0, 0.01, 0.0, 0.0))
    get_solver("respond").solve_rows([SolverBody("stone", Block(2.0, 0.5), tilted)], ground)
    assert len(runs) > 1
