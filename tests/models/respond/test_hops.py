"""Ever smaller hops: where they end, that hops of 1e-20 m are followed, and that hops without end are given up with a sentence."""

import math
from dataclasses import replace

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.core.errors import SolverError
from seisblock.core.results import Status
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond import constants, solve_respond
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.describe import describe
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.run import run
from seisblock.models.respond.solve import respond_params
from seisblock.readers import read
from seisblock.records import Motion, motion_of
from tests.models.respond.cases import SLENDER, at_lean, sequence, shaking, solve_case, still_ground


def test_free_rocking_on_still_ground_decays_geometrically_to_rest():
    """Housner's block on still ground: swings shorten by the restitution down to v_z, then it rests, on time to 1e-9 s."""
    response = solve_respond(SLENDER, still_ground(), mu=2.0, initial=at_lean(SLENDER, 0.02))
    outcome = response.outcome
    times = np.array([event["time_s"] for event in outcome.events])
    hops = np.diff(times[1:])
    assert sequence(outcome)[-1] == "rest"
    e = SLENDER.restitution
    clear = hops[(hops > 1e-9) & (hops < 1e-3)]
    assert clear.size > 100
    np.testing.assert_allclose(clear[1:] / clear[:-1], e, rtol=1e-5)
    # the swings left out would last as long again as a geometric series says
    assert hops[-1] * e / (1.0 - e) < 1e-9
    first = response["angular_velocity"][np.searchsorted(response.time, times[1])] * SLENDER.width
    expected = math.log(1e-12 * math.sqrt(G * SLENDER.radius) / abs(first)) / math.log(e)
    assert len(times) == pytest.approx(expected + 2, abs=2)


def test_flat_drop_with_restitution_rests_at_sum_of_geometric_series():
    """Flat drops with restitution e come to rest after t (1 + e)/(1 - e); the smallest hop followed is below 1e-22 m."""
    e, fall = 0.5, 0.1
    setting, run = solve_case(Block(0.5, 0.5), still_ground(), mu=0.5, restitution=e, initial=(0.0, 0.25 + fall, 0.0, 0.0, 0.0, 0.0))
    first = math.sqrt(2.0 * fall / G)
    assert run.ends_at_rest
    rest = [change.time for change in run.events if change.target in (constants.REST, constants.SETTLED)]
    assert rest[0] == pytest.approx(first * (1.0 + e) / (1.0 - e), abs=1e-9)
    rates = [change.after[constants.RATE_RIGHT] for change in run.events if change.target == constants.FLIGHT]
    assert rates[-1] ** 2 / (2.0 * G) < 1e-22
    np.testing.assert_allclose(np.array(rates[2:]) / np.array(rates[1:-1]), e, rtol=1e-9)
    assert setting.small_rate < rates[-1]


def test_leaning_block_hops_on_one_corner_then_rocks():
    """A leaning block that hops on its foot stops hopping and rocks on; the hops shrink by e to below 1e-20 m."""
    block = Block(0.5, 1.0)
    _, run = solve_case(block, still_ground(3.0), mu=2.0, restitution=0.3, initial=_above(block, 0.2, 1e-3))
    bounces = [change for change in run.events if change.source == constants.FLIGHT][:30]
    gaps = [change.after[constants.RATE_RIGHT] ** 2 / (2.0 * G) for change in bounces if change.target == constants.FLIGHT]
    assert min(gap for gap in gaps if gap > 0.0) < 1e-20
    assert any(change.target == constants.ROCK_RIGHT for change in bounces)
    assert run.ends_at_rest


def _above(block, theta, gap):
    """Return a leaning start with the right foot a little above the ground."""
    x, y, *rest = at_lean(block, theta)
    return (x, y + gap, *rest)


NEARLY_LOSSLESS = {"mu": 0.5, "restitution": 0.99999}
"""Hops that shrink by 1e-5 take more impacts than are followed."""


def test_restitution_near_one_ends_with_unresolved_status():
    """A restitution near 1 gives a status and a sentence within seconds, beginning with the missing result."""
    response = solve_respond(
        SLENDER, still_ground(1.0), **NEARLY_LOSSLESS, initial=at_lean(SLENDER, 1e-8), settle_s=10.0, sensitivity=False
    )
    assert response.status is Status.TOO_MANY_EVENTS
    assert response.outcome.outcome == "still bouncing"
    assert not response.outcome.settled
    assert any("still bouncing" in text for text in response.warnings)
    assert "no result: analysis stopped at" in describe(response, gal=True)


def test_respond_many_excludes_unresolved_runs():
    """Among many, a run that was given up is none that stands: a study asks for answers alone."""
    settings = [respond_params(SLENDER, RespondOptions(**NEARLY_LOSSLESS)), respond_params(SLENDER, options=RespondOptions(mu=0.5))]
    fates = respond_many(settings, still_ground(1.0), initial=at_lean(SLENDER, 1e-8), settle_s=10.0)
    assert fates.gave_up.tolist() == [True, False]
    with pytest.raises(SolverError, match=r"1 of 2 runs have no result: .* smaller `restitution`"):
        fates.require_complete()


def test_strong_noise_with_many_impacts_is_solved_to_the_end():
    """Half a minute of strong noise along two axes makes hundred thousands of impacts; the object is followed to its end, alone or not."""
    noise = np.random.default_rng(0).standard_normal((2, 1501))
    motion = Motion.from_arrays(3.0 * noise[0], 0.02, vertical=4.0 * noise[1])
    outcome = solve_respond(Block(0.5, 1.0), motion, mu=0.8, restitution=0.7, sensitivity=False).outcome
    assert outcome.impacts > 200_000
    assert outcome.settled
    assert outcome.end_s >= 30.0
    fates = respond_many([respond_params(Block(0.5, 1.0), options=RespondOptions(mu=0.8, restitution=0.7))], motion).require_complete()
    assert (fates.impacts[0], fates.end_s[0]) == (outcome.impacts, outcome.end_s)


@pytest.mark.parametrize("mu", [0.187, 0.1875, 0.18751])
def test_rocking_that_decays_beyond_the_load_of_a_corner_ends(mu):
    """Ever smaller slide-rocking under a load that tips the flat body ends at its limit; below 1e-17 m/s it was not resolved in time."""
    block = Block(0.625, 1.75, centroid_height=1.3125, centroid_offset=-0.09765625)
    response = solve_respond(block, shaking(92985, 8.7498909, seconds=8.0, dt=0.005), sensitivity=False, mu=mu, restitution=0.05)
    assert sequence(response.outcome)[-1] == "rest"


KEPT_UP = [
    (
        Block(0.6875, 0.76171875, centroid_height=0.40625 * 0.76171875),
        {"mu": 1.125, "restitution": 0.6},
        shaking(4507, 10.375, seconds=8.0, dt=0.02),
    ),
    (Block(2.25, 2.875, centroid_height=0.80859375), {"mu": 1.457, "restitution": 0.6}, shaking(26400, 11.878, seconds=8.0, dt=0.02)),
]
"""Sliding blocks whose hops are kept up by friction at any scale: one corner's rebound is suppressed, the other's is not."""


@pytest.mark.parametrize(("block", "options", "motion"), KEPT_UP)
def test_hops_kept_up_by_friction_end(block, options, motion):
    """The run is repeated with bodies set flat, to the same end alone and among other rows, with its energy accounted for."""
    outcome = solve_respond(block, motion, sensitivity=False, **options).outcome
    balance = outcome.energy_ground_j - outcome.energy_friction_j - outcome.energy_impacts_j
    assert outcome.settled
    assert balance == pytest.approx(0.0, abs=1e-8 * outcome.energy_ground_j)
    params = respond_params(block, options=RespondOptions(**options))
    mild = respond_params(block, options=RespondOptions(mu=0.3))
    rows = respond_many([mild, params, mild], motion).require_complete()
    alone = respond_many([mild], motion)
    assert rows.impacts[1] == outcome.impacts
    assert rows.final_displacement_m[1] == outcome.final_displacement_m
    assert rows.final_displacement_m[[0, 2]].tolist() == alone.final_displacement_m.tolist() * 2


def test_lively_slender_block_without_result_is_told_to_use_less_restitution():
    """The error named no remedy; with a restitution smaller by 0.1 the run ends."""
    block, motion = Block(0.1, 1.2), motion_of(read("synthetic_jma.csv"), "NS")
    with pytest.raises(SolverError, match="too many mode changes; use a smaller `restitution`"):
        solve_respond(block, motion, mu=0.5, restitution=0.99)
    assert solve_respond(block, motion, mu=0.5, restitution=0.89).outcome.overturned


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_bodies_set_flat_move_as_others(seed):
    """Setting bodies flat at 1e-10 sqrt(g R) leaves out impacts at the end of a motion, and nothing that can be measured."""
    params = respond_params(Block(0.6, 0.7), options=RespondOptions(mu=0.9, restitution=0.4))
    motion = shaking(seed, 11.0, seconds=8.0, dt=0.02)
    default, flat = (run(params, motion, (1.0, 0.0, 1.0), None, 10.0) for params in (params, replace(params, sets_flat=True)))
    assert flat.record_part.n_events < default.record_part.n_events
    assert flat.final[constants.X] == pytest.approx(default.final[constants.X], abs=1e-12)
    assert flat.extrema(constants.THETA) == pytest.approx(default.extrema(constants.THETA), abs=1e-12)


def test_slide_longer_than_settle_s_ends_with_time_limit_status():
    """A slide that lasts longer than `settle_s` ends with a status and a sentence; a longer time ends it."""
    start = (0.0, 0.25, 0.0, 1.0, 0.0, 0.0)
    short = solve_respond(Block(0.5, 0.5), still_ground(), mu=0.01, initial=start, settle_s=2.0)
    assert short.status is Status.RECORD_ENDED
    assert short.outcome.outcome == "still moving"
    assert short.outcome.end_s == pytest.approx(3.0, abs=1e-9)
    assert any("still in motion" in text for text in short.warnings)
    rests = solve_respond(Block(0.5, 0.5), still_ground(), mu=0.01, initial=start)
    assert rests.outcome.end_s == pytest.approx(1.0 / (0.01 * G), abs=1e-9)
    assert rests.outcome.final_displacement_m == pytest.approx(1.0 / (0.02 * G), abs=1e-9)
    assert not rests.warnings


def test_block_at_unstable_balance_runs_to_time_limit():
    """Unstable balance is no rest."""
    block = Block(0.3, 0.4)
    outcome = solve_respond(block, still_ground(0.1), mu=1.0, initial=at_lean(block, block.slenderness), settle_s=0.5).outcome
    assert not outcome.settled
