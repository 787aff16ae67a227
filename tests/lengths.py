"""Lengths of tests: slow parameters, left to ``-m slow``, and short studies."""

from collections.abc import Iterable, Iterator, Set
from contextlib import contextmanager

import pytest


def all_but_slow(values: Iterable, quick: Set) -> list:
    """Return parameters of a test; those that are not among the quick ones are marked slow."""
    return [value if value in quick else pytest.param(value, marks=pytest.mark.slow) for value in values]


@contextmanager
def short_scenarios() -> Iterator[None]:
    """Take a quarter of the records of a scenario, a fifth of those of a hazard, without the longest one, and fewer runs of each.

    For tests of what `secure` and `scenario` accept and print; guides show the values of all runs.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("seisblock.studies.scenario.motions.DEFAULT_RECORDS", 10)
        patch.setattr("seisblock.studies.scenario.motions.RECORDINGS", ("shafter_1989",))
        patch.setattr("seisblock.studies.scenario.hazard.RECORDS_PER_LEVEL", 2)
        patch.setattr("seisblock.studies.scenario.assess.MIN_RUNS", 20)
        patch.setattr("seisblock.studies.scenario.secure.FULL_RUNS", 40)
        yield
