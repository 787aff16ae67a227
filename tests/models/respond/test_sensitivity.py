"""Verdicts that a change of the input by up to 2e-6 turns over: which changes are tried, and when."""

import numpy as np
import pytest

from seisblock.models.respond.constants import OVERTURNED, REST, THETA, X
from seisblock.models.respond.outcome import MAX_GROWTH, PERTURBATIONS, RunEnd, are_sensitive

LIMIT = MAX_GROWTH * 2e-6
"""Relative growth of a peak above which smaller changes are tried, too."""


def end(tilt=0.1, displacement=0.2, final=0.15, falls=0.0):
    """Return the end of a run with peaks of tilt and displacement and a final displacement; it falls towards the sign of `falls`."""
    state = np.zeros(15)
    state[THETA], state[X] = falls, final
    return RunEnd(OVERTURNED if falls else REST, state.tolist(), 1.0, (tilt, -0.01), (0.05, -displacement), 0, ("rock",))


@pytest.mark.parametrize(
    ("changed", "tries"),
    [
        ({}, 2),
        ({"tilt": 0.1 * (1.0 + 0.9 * LIMIT), "displacement": 0.2 * (1.0 - 0.9 * LIMIT), "final": 0.15 + 0.2 * 0.9 * LIMIT}, 2),
        ({"tilt": 0.1 * (1.0 + 1.1 * LIMIT)}, 4),
        ({"tilt": 0.1 * (1.0 - 1.1 * LIMIT)}, 4),
        ({"displacement": 0.2 * (1.0 - 1.1 * LIMIT)}, 4),
        ({"final": 0.15 + 0.2 * 1.1 * LIMIT}, 4),
    ],
)
def test_smaller_changes_are_tried_where_larger_ones_have_grown(changed, tries):
    """By more than 50 times in the tilt, the largest or the final displacement."""
    tried = []

    def repeat(rows, change):
        tried.append(change)
        return [end(**changed) for _ in rows]

    assert are_sensitive([end()], repeat) == [False]
    assert tuple(tried) == PERTURBATIONS[:tries]


@pytest.mark.parametrize("number", range(4))
def test_any_change_that_turns_a_verdict_over_makes_it_sensitive(number):
    """A fall to the other side counts as much as one that does not happen; what is decided is not run again."""
    calls = []

    def repeat(rows, change):
        calls.append(len(rows))
        turned = change == PERTURBATIONS[number]
        changed = [end(tilt=0.2), end(tilt=0.2, falls=-1.0 if turned else 1.0), end(tilt=0.2, falls=1.0 if turned else 0.0)]
        return [changed[row] for row in rows]

    assert are_sensitive([end(), end(falls=1.0), end()], repeat) == [False, True, True]
    assert calls == [3] * (number + 1) + [1] * (3 - number)
