"""A motion of a day is followed stretch by stretch and nothing keeps its path; the answers are those of a motion that is held whole."""

from __future__ import annotations

import tracemalloc
from dataclasses import fields
from types import SimpleNamespace

import numpy as np
import pytest

import seisblock
from seisblock import Block, Motion, Record, SpringBlock, motion_of, read
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.errors import ParameterError
from seisblock.core.results import Response
from seisblock.dynamics import integrate_many
from seisblock.models.jump import jump_many
from seisblock.models.rock import model as rocking
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_params
from seisblock.models.stack.options import StackOptions
from seisblock.records import Component, scale_to_pga
from seisblock.studies.criteria_comparison import compare_criteria
from seisblock.studies.model_comparison import compare_pile_models
from tests.lengths import all_but_slow

RECORD = scale_to_pga(read("synthetic_jma.csv"), 9.0)
BLOCK = Block(0.24, 0.9)
SPRINGS = SpringBlock.from_frequency(1.2, 1.2, 3.0, frequency_vertical=8.0, beta=0.707)
CHOZUSHA = seisblock.load_two_layer("chozusha")

PILE = Pile("two stones", (PileStone("foot", 0.3, 0.3, 0.6), PileStone("head", 0.2, 0.2, 0.6, on="foot")), mu=0.4)
SOFT = PileContact(stiffness=1e8)

SOLVES = {
    "slide": lambda motion: seisblock.solve_slide(0.1, motion, vertical=True),
    "rock": lambda motion: seisblock.solve_rock(BLOCK, motion, vertical=True),
    "a block that stands": lambda motion: seisblock.solve_rock(Block(3.0, 1.0), motion),
    "a block that falls": lambda motion: seisblock.solve_rock(Block(0.1, 0.9), motion),
    "respond": lambda motion: seisblock.solve_respond(BLOCK, motion, mu=0.5),
    "uplift": lambda motion: seisblock.solve_uplift(SPRINGS, motion),
    "jump": lambda motion: seisblock.solve_jump(CHOZUSHA, motion, contact=seisblock.load_contact("chozusha")),
    "jump by friction": lambda motion: seisblock.solve_jump(
        CHOZUSHA, motion, contact=seisblock.load_contact("chozusha"), landing="friction"
    ),
    "stack": lambda motion: seisblock.solve_stack(PILE, motion, points=2, contact=SOFT),
}


@pytest.fixture
def in_stretches(monkeypatch):
    """Let every motion count as long."""

    def cut():
        monkeypatch.setattr("seisblock.records.motion.LONG_MOTION_SAMPLES", 100)
        monkeypatch.setattr("seisblock.records.motion.SEGMENT_SAMPLES", 700)

    return cut


@pytest.mark.parametrize("solve", SOLVES.values(), ids=SOLVES)
def test_chunked_motion_gives_same_response(solve, in_stretches):
    """Outcome, phases, events, time and channels, of a motion whose rows are the record's own."""
    full = solve(motion_of(RECORD, "NS"))
    assert full.channels
    in_stretches()
    motion = motion_of(RECORD, "NS")
    assert motion.is_long and np.shares_memory(motion.horizontal, RECORD.component("NS").acceleration)
    parts = solve(motion)
    for field in fields(full.outcome):
        assert getattr(parts.outcome, field.name) == getattr(full.outcome, field.name), field.name
    assert (parts.phases, parts.status, parts.warnings) == (full.phases, full.status, full.warnings)
    assert [(event.name, event.time_s) for event in parts.events] == [(event.name, event.time_s) for event in full.events]
    np.testing.assert_array_equal(parts.time, full.time)
    for first, second in zip(full.channels, parts.channels, strict=True):
        np.testing.assert_array_equal(second.values, first.values, err_msg=first.name)


def test_chunked_rows_equal_whole_rows(in_stretches):
    """Along, across and up of a turned direction, at once and stretch by stretch; a row that does not act is not looked at."""
    full = motion_of(RECORD, "37")
    in_stretches()
    parts = motion_of(RECORD, "37")
    np.testing.assert_array_equal(parts.acceleration, full.acceleration)
    stretches = list(parts.segments((True, False, True)))
    joined = np.concatenate([stretches[0].acceleration, *(stretch.acceleration[:, 1:] for stretch in stretches[1:])], axis=1)
    np.testing.assert_array_equal(joined, full.acceleration * [[1.0], [0.0], [1.0]])
    assert stretches[-1].samples_after == 0 and [stretch.first for stretch in stretches[1:]] == [700 * k for k in range(1, len(stretches))]


def test_ensemble_over_chunked_motion_equals_whole(in_stretches):
    """Runs of a study share the stretches: extrema and ends are those in the whole motion."""
    motion = motion_of(RECORD, "EW")
    p = np.array([rocking.parameters(rock_params(Block(width, 0.9), motion), motion.dt) for width in (0.1, 0.2, 0.3)])
    gains = np.array([[1.0, 0.0, 0.0], [0.9, -0.3, 1.0], [1.2, 0.0, 0.5]])
    full = integrate_many(rocking.ROCKING, motion, p, np.zeros(2), rocking.REST, gains=gains)
    in_stretches()
    parts = integrate_many(rocking.ROCKING, motion_of(RECORD, "EW"), p, np.zeros(2), rocking.REST, gains=gains)
    for field in ("final", "final_mode", "end_time", "extrema", "dwell_times"):
        np.testing.assert_array_equal(getattr(parts, field), getattr(full, field))


def test_rows_of_chains_pass_each_stretch_few_times(in_stretches, monkeypatch):
    """Each of many chains of a jump starts where the one before it ended, and rows that have ended need no further stretch."""
    motion, contact = motion_of(RECORD, "EW"), seisblock.load_contact("chozusha")
    whole = jump_many([CHOZUSHA], motion, contacts=[contact], factors=2.0)
    in_stretches()
    read_samples, segments = [], Motion.segments

    def counted(self, *arguments):
        for segment in segments(self, *arguments):
            read_samples.append(segment.acceleration.shape[1])
            yield segment

    monkeypatch.setattr(Motion, "segments", counted)
    result = jump_many([CHOZUSHA], motion, contacts=[contact], factors=2.0)
    assert result.row_dict(0) == whole.row_dict(0)
    chains = len(whole.chains.row)
    assert chains > 10
    # search, rocking and flight of a chain each read the stretch in which they end
    assert sum(read_samples) < 3 * (chains + 1) * 701 + 2 * motion.samples


def test_curves_are_computed_on_demand(monkeypatch):
    """A verdict alone does not integrate the path again."""
    created = SimpleNamespace(count=0)
    original = seisblock.models.slide.solve._curves

    def counted(*args):
        created.count += 1
        return original(*args)

    monkeypatch.setattr("seisblock.models.slide.solve._curves", counted)
    response = seisblock.solve_slide(0.1, Motion.from_arrays(np.sin(np.arange(300.0)), 0.01))
    assert response.outcome.slips and created.count == 0
    assert response.time.size == response["displacement"].size and created.count == 1


NOISE = Motion.from_arrays(np.random.default_rng(1).normal(size=3000), 0.01)


def test_event_buffer_overflow_changes_nothing(monkeypatch):
    """They are taken out in time: the answer is that of tables that hold all of them."""
    full = seisblock.solve_slide(0.05, NOISE)
    assert len(full.events) > 1000
    monkeypatch.setattr("seisblock.dynamics.integration._INITIAL_EVENT_CAPACITY", 16)
    monkeypatch.setattr("seisblock.dynamics.integration._MAX_EVENT_CAPACITY", 16)
    parts = seisblock.solve_slide(0.05, NOISE)
    assert (parts.outcome, parts.phases) == (full.outcome, full.phases)
    for first, second in zip(full.events, parts.events, strict=True):
        assert (first.name, first.time_s, *first.before, *first.after) == (second.name, second.time_s, *second.before, *second.after)


def test_unbounded_events_are_rejected_with_remedy(monkeypatch):
    """Each request above the memory limit names its size and the variable that lifts the limit."""
    monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", "1")
    noise = Motion.from_arrays(np.random.default_rng(1).normal(size=40_000), 0.01)
    with pytest.raises(ParameterError, match=r"^\d+ mode changes need 2 MiB, more than the limit of 1 MiB: .* raise SEISBLOCK_MEMORY_MIB"):
        seisblock.solve_slide(0.05, noise)


BYTES_AN_EVENT = 300.0
"""What a change of mode of a sliding object may take at the peak: 112 in the columns, as much again while they are joined."""


def test_memory_per_event(monkeypatch):
    """The slope between two lengths of noise: an object for each event, and one for each phase, took 0.8 kB."""
    monkeypatch.setattr("seisblock.records.motion.LONG_MOTION_SAMPLES", 100)
    peaks, counts = [], []
    for samples in (20_000, 40_000):
        motion = Motion.from_arrays(np.random.default_rng(1).normal(size=samples), 0.01)
        tracemalloc.start()
        try:
            counts.append(len(seisblock.solve_slide(0.05, motion).events))
            peaks.append(tracemalloc.get_traced_memory()[1])
        finally:
            tracemalloc.stop()
    assert (peaks[1] - peaks[0]) / (counts[1] - counts[0]) < BYTES_AN_EVENT


def test_memory_of_short_trajectories_in_long_motion():
    """`jump` follows many chains: each took room for the whole motion (7 GB of a million samples of noise)."""
    motion = Motion.from_arrays(np.concatenate([np.full(300, 4.0), np.zeros(50_000)]), 0.01)
    response = seisblock.solve_rock(Block(0.1, 0.9), motion)
    path = next(response.make_histories.args[-1].iter_paths())
    assert response.outcome.overturned and 0 < len(path.states) < 100
    assert path.states.base is None and path.modes.base is None


SHORTER, LONGER, MINIMUM = 2**17, 2**18, 8.0
"""Samples of a burst in a quiet day, and the bytes of each that a single row would take."""


def burst_of(samples):
    """Return a row that shakes at its beginning alone, m/s^2."""
    place = np.arange(samples)
    return 6.0 * np.exp(-(((place - 2000.0) / 200.0) ** 2)) * np.sin(0.06 * place)


def rotated_record(samples):
    """Return a record of two components, and its motion towards a direction between them."""
    record = Record((Component("NS", burst_of(samples)), Component("EW", 0.8 * burst_of(samples))), 0.005)
    return record, motion_of(record, "37")


def peak_bytes(solve, samples):
    """Return what a solve holds at its peak, bytes, of a motion that shakes at its beginning alone."""
    burst = burst_of(samples)
    motion = Motion((burst, np.zeros(samples), 0.3 * burst), 0.005)
    return bytes_held(solve, motion)


def bytes_held(use, *arguments):
    """Return the peak memory of an operation, bytes."""
    tracemalloc.start()
    try:
        assert use(*arguments) is not None
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("names", all_but_slow(SOLVES, set(SOLVES) - {"stack", "uplift"}))
def test_memory_per_sample_of_outcome(names, monkeypatch):
    """The slope between two lengths: less than one row; the path of a slide takes five."""
    monkeypatch.setattr("seisblock.records.motion.LONG_MOTION_SAMPLES", 2**16)
    monkeypatch.setattr("seisblock.records.motion.SEGMENT_SAMPLES", 2**15)
    peak_bytes(SOLVES[names], 2**16 + 2)
    assert (peak_bytes(SOLVES[names], LONGER) - peak_bytes(SOLVES[names], SHORTER)) / (LONGER - SHORTER) < MINIMUM


def check_models_with_pile(record, motion):
    """Look at each sample of the three rows, as a pile does, and ask the other models."""
    assert all(np.isfinite(stretch.acceleration).all() for stretch in motion.segments((True, True, True)))
    answer = Response("stack", SimpleNamespace(overturned=()), motion, PILE, options=StackOptions(gravity=9.81, vertical=False))
    return compare_pile_models(answer)


STUDIES = {
    "criteria": lambda record, motion: compare_criteria(record, motion, BLOCK, options=RockOptions(gravity=9.81, vertical=False)).agreement,
    "stack": check_models_with_pile,
}

ONE_ROW = 10.0
"""Bytes of each sample, that of one row and a share: a high-pass looks at all of it."""


@pytest.mark.parametrize("names", STUDIES)
def test_memory_per_sample_of_model_comparison(names, monkeypatch):
    """The slope between two lengths of a turned motion: the row across, the filtered row and its velocity were held at once."""
    for size, samples in {
        "records.motion.LONG_MOTION_SAMPLES": 2**16,
        "records.motion.SEGMENT_SAMPLES": 2**15,
        "records.filters.CHUNK_SIZE": 2**14,
        "records.integrals.CHUNK_SIZE": 2**14,
        "measures.frequency.CHUNK_SIZE": 2**14,
        "measures.spectra.LONG_TRANSFORM": 2**13,
    }.items():
        monkeypatch.setattr(f"seisblock.{size}", samples)
    fallen = SimpleNamespace(overturned=True)  # dozens of factors are tried, and what a verdict holds is looked at above
    monkeypatch.setattr("seisblock.studies.model_comparison.rock_verdict", lambda *args, **options: fallen)
    study = STUDIES[names]
    study(*rotated_record(2**16 + 2))  # compiles
    assert (bytes_held(study, *rotated_record(LONGER)) - bytes_held(study, *rotated_record(SHORTER))) / (LONGER - SHORTER) < ONE_ROW
