"""Fixtures of commands."""

import pytest


@pytest.fixture
def few_runs(monkeypatch):
    """A quarter of the records of a scenario, a fifth of those of a hazard, without the longest one, and fewer runs of each.

    For tests of what `secure` and `scenario` accept and print; guides show the values of all runs.
    """
    monkeypatch.setattr("seisblock.studies.scenario.motions.DEFAULT_RECORDS", 10)
    monkeypatch.setattr("seisblock.studies.scenario.motions.RECORDINGS", ("shafter_1989",))
    monkeypatch.setattr("seisblock.studies.scenario.hazard.RECORDS_PER_LEVEL", 2)
    monkeypatch.setattr("seisblock.studies.scenario.assess.MIN_RUNS", 20)
    monkeypatch.setattr("seisblock.studies.scenario.secure.FULL_RUNS", 40)
