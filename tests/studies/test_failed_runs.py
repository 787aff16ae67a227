"""Runs that are given up: left out of shares and maps, counted and named, and never the end of the other runs."""

from dataclasses import replace

import numpy as np
import pytest

import seisblock
from seisblock.bodies.block import Block
from seisblock.core.errors import SolverError
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.readers import read
from seisblock.records import Motion
from seisblock.studies.batch.run import run_batch
from seisblock.studies.map.station_response import StationBody
from seisblock.studies.map.stations import survey_stations
from seisblock.studies.respond import azimuths, mode_map
from seisblock.studies.respond.probability import respond_probability
from seisblock.studies.solvers import respond as respond_studies
from tests.models.respond.cases import at_lean

BLOCK = Block(0.24, 0.8, name="shelf")
PULSE = Motion.from_arrays(5.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)


@pytest.fixture
def drop_rows(monkeypatch):
    """Let modules give up some of the rows that they follow, by number in each call; all of them with None."""

    def install(module, rows):
        def follow(*args, **kwargs):
            fates = respond_many(*args, **kwargs)
            gave_up = np.zeros(len(fates.overturned), dtype=bool)
            gave_up[slice(None) if rows is None else rows] = True
            return replace(fates, gave_up=gave_up, overturned=fates.overturned & ~gave_up)

        monkeypatch.setattr(module, "respond_many", follow)

    return install


def test_respond_probability_counts_only_versions_with_an_answer(drop_rows):
    """All 20 versions fall; two that are given up do not count as standing."""
    drop_rows(respond_studies, [2, 16])
    result = respond_probability(BLOCK, PULSE, options=RespondOptions(mu=0.5), runs=20)
    assert (result.runs, result.overturned, result.no_answer) == (18, 1.0, (3, 17))
    assert result.interval == pytest.approx((0.025 ** (1 / 18), 1.0))


def test_respond_probability_refuses_where_no_version_has_an_answer(drop_rows):
    """Without any answer there is no share."""
    drop_rows(respond_studies, None)
    with pytest.raises(SolverError, match="20 of 20 runs have no result"):
        respond_probability(BLOCK, PULSE, options=RespondOptions(mu=0.5), runs=20)


def test_run_batch_names_versions_without_an_answer(drop_rows):
    """The row has its share and a warning; the table keeps its columns."""
    drop_rows(respond_studies, [0])
    table = run_batch("synthetic_jma.csv", BLOCK, "respond", components="EW", runs=10, mu=0.5)
    assert table["runs"] == [9]
    assert "1 of 10 samples stopped without a result and excluded (numbers 1)" in table["warnings"][0]
    assert "left_out" not in table.columns


def test_survey_stations_leaves_out_a_direction_without_an_answer(drop_rows):
    """The worst direction is one with an answer; the station's doubts name the other."""
    subject = StationBody(BLOCK, RespondOptions(mu=0.5), step_deg=45.0)
    record = read("synthetic_jma.csv")
    worst = azimuths.respond_directions(BLOCK, record, options=RespondOptions(mu=0.5), step_deg=45.0)[0].azimuth_deg
    drop_rows(azimuths, [round(worst / 45.0)])
    answer = survey_stations(record, subject).answers[0]
    assert answer.failure is None
    assert answer.effect.azimuth_deg != worst
    assert any(text.startswith("no result in 1 of ") and text.endswith(f"(run stopped): {worst:g}°") for text in answer.doubts)


def test_mode_map_marks_a_cell_without_an_answer(drop_rows):
    """The cell is none of the modes, and the share of the others is of all cells."""
    drop_rows(mode_map, [1])
    modes = mode_map.mode_map([0.2, 0.6], [1.0], [0.2], PULSE)
    assert [mode_map.MODES_BY_SEVERITY[index] for index in modes.governing[0]] == ["slide", "no answer"]
    assert modes.share("no answer") == 0.5


def test_respond_many_answers_the_other_rows():
    """A row that hops without end is marked; the others are those of runs of their own."""
    settings = [seisblock.models.respond_params(BLOCK, options=RespondOptions(mu=0.5, restitution=e)) for e in (0.0, 0.9999999, 0.3)]
    start = at_lean(BLOCK, 1e-8)
    still = Motion.from_arrays(np.zeros(101), 0.01)
    fates = respond_many(settings, still, initial=start)
    assert fates.gave_up.tolist() == [False, True, False]
    assert not fates.settled[1]
    single = respond_many(settings[2:], still, initial=start)
    assert fates.end_s[2] == single.end_s[0]
