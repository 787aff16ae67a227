"""Records made of arrays, and documents made of responses, without a file or a command."""

import copy
import json
import pickle
from datetime import UTC, datetime

import numpy as np
import pytest
from click.testing import CliRunner

import seisblock as sb
from seisblock.cli import main
from seisblock.records.motion import LONG_MOTION_SAMPLES

SINE = 4.0 * np.sin(2.0 * np.pi * np.arange(301) * 0.01)


def test_record_from_arrays_holds_components_azimuths_and_start():
    """Codes give azimuths, numbers as codes too; the arrays are copied; a start without a zone is UTC."""
    values = SINE.copy()
    record = sb.Record.from_arrays({"NS": values, "37": 0.5 * SINE, "UD": 0.1 * SINE}, dt=0.01, station="table", start=datetime(2026, 1, 2))
    values[:] = 0.0
    assert np.array_equal(record.component("NS").acceleration, SINE)
    assert [part.azimuth_deg for part in record.components] == [0.0, 37.0, None]
    assert record.vertical is record.components[2]
    assert (record.station, record.dt, record.start) == ("table", 0.01, datetime(2026, 1, 2, tzinfo=UTC))
    assert np.array_equal(sb.motion_of(record, "NS").vertical, 0.1 * SINE)


CLONES = [lambda original: pickle.loads(pickle.dumps(original)), copy.copy, copy.deepcopy]


@pytest.mark.parametrize("clone", CLONES)
def test_samples_of_a_pickled_or_copied_record_are_read_only(clone):
    """As those of the record itself."""
    copied = clone(sb.Record.from_arrays({"NS": SINE}, dt=0.01))
    assert not copied.components[0].acceleration.flags.writeable
    assert np.array_equal(copied.components[0].acceleration, SINE)


@pytest.mark.parametrize("clone", CLONES)
@pytest.mark.parametrize("samples", [301, LONG_MOTION_SAMPLES + 1], ids=["short", "long"])
def test_motion_from_another_process_or_copy_gives_equal_response(clone, samples):
    """Also one with a row across that is computed on demand."""
    values = 4.0 * np.sin(0.06 * np.arange(samples)) * np.exp(-((np.arange(samples) - 150.0) ** 2) / 1e4)
    record = sb.Record.from_arrays({"30": values, "100": 0.5 * values, "UD": 0.1 * values}, dt=0.01)
    motion = sb.motion_of(record, "70")
    copied = clone(motion)
    assert not copied.horizontal.flags.writeable
    assert np.array_equal(copied.transverse, motion.transverse)
    assert sb.solve_rock(sb.Block(0.2, 0.9), copied).outcome == sb.solve_rock(sb.Block(0.2, 0.9), motion).outcome


@pytest.mark.parametrize(
    ("components", "message"),
    [
        ({}, "no components"),
        ({"NS": SINE, "EW": SINE[:-1]}, "differ in length"),
        ({"NS": [0.0, np.nan]}, "not finite at 1 of its samples"),
        ({"NS": np.zeros((2, 3))}, r"the accelerations must have shape \(n,\)"),
    ],
)
def test_record_from_arrays_rejects_unusable_arrays(components, message):
    """Nothing, unequal lengths, gaps and tables are errors that say so."""
    with pytest.raises(sb.InputError, match=message):
        sb.Record.from_arrays(components, dt=0.01)


@pytest.mark.parametrize(
    ("command", "solve"),
    [
        (["slide", "--mu", "0.3"], lambda motion: sb.solve_slide(sb.SlidingBase(0.3), motion)),
        (["rock", "--block", "gravestone"], lambda motion: sb.solve_rock(sb.load_block("gravestone"), motion)),
        (
            ["respond", "--block", "gravestone", "--mu", "0.4", "--runs", "0"],
            lambda motion: sb.solve_respond(sb.load_block("gravestone"), motion, mu=0.4),
        ),
        (
            ["jump", "--block", "chozusha"],
            lambda motion: sb.solve_jump(sb.load_two_layer("chozusha"), motion, contact=sb.load_contact("chozusha"), drop=0.3, tenon=0.02),
        ),
    ],
)
def test_response_document_equals_json_of_the_command(command, solve):
    """The text is that of --json for one direction."""
    response = solve(sb.motion_of(sb.read("synthetic_jma.csv"), "EW"))
    result = CliRunner().invoke(main, [*command, "synthetic_jma.csv", "--component", "EW", "--json"])
    assert result.exit_code == 0, result.stderr
    assert response.to_json() == result.stdout.rstrip("\n")
    assert response.to_dict() == json.loads(result.stdout)


@pytest.mark.parametrize(
    "response",
    [
        lambda motion: sb.solve_rock(sb.Block(0.3, 0.9), motion),
        lambda motion: sb.solve_respond(sb.Block(0.3, 0.9), motion, mu=0.5, sensitivity=False),
        lambda motion: sb.solve_uplift(sb.SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707), motion),
        lambda motion: sb.solve_stack(sb.Pile("one", (sb.PileStone("a", 0.3, 0.3, 0.3),)), motion, points=2),
    ],
    ids=["rock", "respond", "uplift", "stack"],
)
def test_response_document_has_the_outcome_in_si(response):
    """The keys of a result are those of the outcome; a document needs no file of a record."""
    result = response(sb.Motion.from_arrays(SINE, 0.01, name="x"))
    document = result.to_dict()
    assert document["schema"].startswith(f"seisblock/{result.model}/")
    assert document["record"] is None
    assert document["results"][0]["component"] == "x"
    assert sum(key in document["results"][0] for key in vars(result.outcome)) >= 2
