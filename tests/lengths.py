"""Lengths of tests: slow parameters, left to ``-m slow``, and short studies."""

from collections.abc import Iterable, Iterator, Set
from contextlib import contextmanager

import pytest


def all_but_slow(values: Iterable, quick: Set) -> list:
    """Return parameters of a test; those that are not among the quick ones are marked slow."""
    return [value if value in quick else pytest.param(value, marks=pytest.mark.slow) for value in values]


SCENARIOS = {
    "motions.DEFAULT_RECORDS": 10,
    "motions.RECORDINGS": ("shafter_1989",),
    "hazard.RECORDS_PER_LEVEL": 2,
    "assess.MIN_RUNS": 20,
    "secure.FULL_RUNS": 40,
    "secure.QUICK_RUNS": 20,
    "secure.COARSE": 6,
    "secure.RESOLUTION": 0.1,
    "secure.INSET_RESOLUTION": 0.02,
}
"""A quarter of the records of a scenario, a fifth of those of a hazard, without the longest one, fewer runs, and coarser measures."""

FITS = {
    "importance_sampling.INITIAL_BLOCKS": 16,
    "importance_sampling.SEARCH_BLOCKS": 32,
    "importance_sampling.CANDIDATES": 256,
    "importance_sampling.PROPOSAL_BLOCKS": 64,
    "importance_sampling.MIN_EFFECTIVE": 15.0,
    "importance_sampling.TARGET_EFFECTIVE": 40.0,
    "importance_sampling.MIN_EFFECTIVE_WITHOUT": 5.0,
    "fit.TARGET_EFFECTIVE": 40.0,
    "fit.MIN_EFFECTIVE_HELD_OUT": 5.0,
}
"""A quarter of the blocks of a fit."""


@contextmanager
def short_studies() -> Iterator[None]:
    """Take few records and runs for `secure` and `scenario`, and few blocks for `fit`.

    For tests of what these commands accept and print; guides show the values of all runs.
    """
    with pytest.MonkeyPatch.context() as patch:
        for package, constants in (("scenario", SCENARIOS), ("fit", FITS)):
            for name, value in constants.items():
                patch.setattr(f"seisblock.studies.{package}.{name}", value)
        yield
