"""Every direction of a record: rows side by side say what single runs say, for blocks and for scans, and the worst comes first."""

import math
from dataclasses import replace

import numpy as np
import pytest

from seisblock import Block, motion_of, read, solve_respond, solve_rock
from seisblock.bodies.block_array import wear_within
from seisblock.bodies.convex import convex_body
from seisblock.bodies.factory import block_for_motion
from seisblock.bodies.scan.toml import load_scan
from seisblock.core.errors import ComponentError, ParameterError, SolverError
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rock.options import RockOptions
from seisblock.records.process import crop, scale
from seisblock.report.text.assessment import azimuths_headline
from seisblock.studies import rocking_spectrum, rocking_spectrum_all_azimuths
from seisblock.studies.azimuth_probability import AzimuthAverage, average_azimuths, rank_by_probability, sample_orientations
from seisblock.studies.azimuths import make_azimuth_sweep
from seisblock.studies.batch.run import run_batch
from seisblock.studies.model_comparison import compare_models
from seisblock.studies.respond.azimuths import left_out_directions, respond_directions
from seisblock.studies.rocking.azimuths import RockAzimuth, rock_directions
from seisblock.studies.sampling import ParameterVariation, sample
from seisblock.uncertainty import perturb, respond_probability

BOULDER = load_scan("boulder").with_wear(0.1)
RECORD = scale(crop(read("synthetic_jma.csv"), 22.0, 32.0), 0.42)


@pytest.mark.parametrize("body", [Block(0.2, 0.72), Block(0.24, 0.72, centroid_offset=0.04), BOULDER], ids=["block", "two-sided", "scan"])
def test_rock_azimuths_equal_single_runs(body):
    """The same verdict, side, time of lying down and largest lean over alpha as one motion after the other."""
    directions = rock_directions(body, RECORD, step_deg=22.5)
    assert {entry.overturned for entry in directions} == {True, False}
    for item in directions:
        motion = motion_of(RECORD, f"{item.azimuth_deg:g}")
        block = body.block_toward(item.azimuth_deg)
        first = solve_rock(block, motion).outcome
        assert item.overturned is first.overturned and item.overturned_towards == (first.overturned_towards or None)
        assert item.overturning_time_s == pytest.approx(first.overturning_time_s, abs=1e-6)
        assert item.max_rotation_ratio == pytest.approx(first.max_rotation_ratio, rel=1e-6)
        assert item.slenderness_rad == pytest.approx(first.slenderness_rad, rel=1e-12)


def test_respond_azimuths_of_scan_equal_single_runs():
    """Verdict, largest lean, displacements and end as one motion after the other, each with its own arms."""
    for direction in respond_directions(BOULDER, RECORD, options=RespondOptions(mu=0.35), step_deg=45.0):
        motion = motion_of(RECORD, f"{direction.azimuth_deg:g}")
        block = BOULDER.block_for_motion(motion)
        first = solve_respond(block, motion, mu=0.35, sensitivity=False).outcome
        assert direction.overturned is first.overturned and direction.overturned_towards == first.overturned_towards
        assert direction.max_rotation_rad == pytest.approx(first.max_rotation_rad, rel=1e-6, abs=1e-12)
        assert direction.max_rotation_ratio == pytest.approx(first.max_rotation_ratio, rel=1e-6, abs=1e-12)
        assert direction.final_displacement_m == pytest.approx(first.final_displacement_m, rel=1e-6, abs=1e-9)


def test_azimuths_sort_worst_first():
    """Falls before leans, sooner falls before later ones, larger leans before smaller ones."""
    directions = rock_directions(BOULDER, RECORD, step_deg=15.0)
    fallen = [item.overturning_time_s for item in directions if item.overturned]
    leaning = [item.max_rotation_ratio for item in directions if not item.overturned]
    assert [item.overturned for item in directions] == [True] * len(fallen) + [False] * len(leaning)
    assert fallen == sorted(fallen) and leaning == sorted(leaning, reverse=True)


def test_azimuth_range_follows_body_symmetry():
    """Half the circle for a block of two equal sides and for a scan, which stands where it stands; all of it for a block that is turned."""
    assert make_azimuth_sweep(Block(0.24, 0.72), RECORD, step_deg=10.0).azimuths.tolist() == [10.0 * i for i in range(18)]
    assert len(make_azimuth_sweep(BOULDER, RECORD, step_deg=10.0).blocks) == 18
    assert len(make_azimuth_sweep(Block(0.24, 0.72, centroid_offset=0.01), RECORD, step_deg=10.0).blocks) == 36


def test_scan_at_opposite_azimuth_falls_to_same_side():
    """Towards the opposite azimuth, the same fall to the same side of the compass, at the same time."""
    first, counterpart = (motion_of(RECORD, name) for name in ("45", "225"))
    single, second = (solve_rock(BOULDER.block_for_motion(motion), motion).outcome for motion in (first, counterpart))
    assert single.overturned and second.overturned
    assert {single.overturned_towards, second.overturned_towards} == {"+x", "-x"}
    assert single.overturning_time_s == pytest.approx(second.overturning_time_s, abs=1e-6)


def test_azimuths_reject_single_horizontal_and_invalid_step():
    """A record of one horizontal, and a step that leads nowhere."""
    with pytest.raises(ComponentError, match="two horizontal components"):
        rock_directions(BOULDER, read("elcentro_1940_ns.csv"))
    for step in (0.0, -5.0, math.nan):
        with pytest.raises(ParameterError, match="azimuth step"):
            make_azimuth_sweep(BOULDER, RECORD, step_deg=step)


def test_spectrum_all_azimuths_equals_worst_of_single():
    """Leans are the largest, falls count their directions, and the worst one is that of the first fall, or of the largest lean."""
    sizes, alphas = [0.4, 1.0, 3.0], [0.12, 0.2, 0.3, 0.5]
    directions = rocking_spectrum_all_azimuths(sizes, alphas, RECORD, step_deg=45.0)
    spectrum = [rocking_spectrum(sizes, alphas, motion_of(RECORD, name)) for name in ("0", "45", "90", "135")]
    assert directions.azimuths_deg.tolist() == [0.0, 45.0, 90.0, 135.0]
    falls = np.array([first.overturned for first in spectrum])
    assert directions.overturned.tolist() == falls.any(axis=0).tolist()
    assert directions.overturning_rate.tolist() == falls.mean(axis=0).tolist()
    assert 0.0 < directions.overturning_rate.mean() < 1.0 and not directions.overturned.all()
    leans = np.array([first.max_rotation_ratio for first in spectrum])
    assert directions.max_rotation_ratio == pytest.approx(leans.max(axis=0), rel=1e-6)
    standing = ~directions.overturned & (leans.max(axis=0) > 1e-6)
    assert standing.any()
    assert directions.worst_azimuth_deg[standing].tolist() == (45.0 * leans.argmax(axis=0)[standing]).tolist()
    for i, j in np.argwhere(directions.overturned)[:4]:
        block = Block(sizes[i] * math.sin(alphas[j]), sizes[i] * math.cos(alphas[j]))
        times = [solve_rock(block, motion_of(RECORD, name)).outcome.overturning_time_s for name in ("0", "45", "90", "135")]
        assert directions.worst_azimuth_deg[i, j] == 45.0 * min((time, k) for k, time in enumerate(times) if time is not None)[1]


@pytest.mark.parametrize("offset", [0.0, 0.09])
def test_samples_keep_centre_of_gravity_inside_base(offset):
    """A centre of gravity 10 mm inside the base has samples and other models, although a tenth of the width is more."""
    block, motion = Block(0.2, 0.6, centroid_offset=offset), motion_of(RECORD, "NS")
    assert wear_within(block, 0.1) == pytest.approx(0.04 if offset else 0.1)
    assert wear_within(block.with_wear(0.045), 0.1) == pytest.approx(0.045 if offset else 0.1)
    assert perturb(block, motion, 10).runs == respond_probability(block, motion, options=RespondOptions(mu=0.5), runs=10).runs == 10
    assert compare_models(block, motion).models >= 3


def test_block_toward_projects_base():
    """Width, inertia, inset and offset of a rectangle in a plane at an azimuth; towards the opposite side it stands turned round."""
    block = Block(0.4, 1.0, depth=0.9, centroid_offset=0.05, inset=0.02)
    rotated = block.block_toward(30.0)
    c, s = math.cos(math.pi / 6), 0.5
    assert rotated.width == pytest.approx(0.4 * c + 0.9 * s) and rotated.centroid_offset == pytest.approx(0.05 * c)
    assert rotated.gyration_squared == pytest.approx(((0.4 * c) ** 2 + (0.9 * s) ** 2 + 1.0) / 12)
    assert rotated.inset == pytest.approx(0.02 * (c + s)) and rotated.total_mass == pytest.approx(block.total_mass)
    assert block.block_toward(0.0) is block and block.block_toward(180.0) is block
    assert block.block_toward(150.0).centroid_offset == pytest.approx(0.05 * c)
    square = Block(0.3, 1.0)
    assert square.block_toward(90.0).slenderness == square.slenderness < square.block_toward(45.0).slenderness


def test_rank_by_probability_puts_most_probable_azimuth_first():
    """Each azimuth has the share of its samples; the largest comes first, whatever the single runs did."""
    block, options = Block(0.2, 0.72), RockOptions()
    directions = rock_directions(block, RECORD, step_deg=45.0)
    ranked = rank_by_probability("rock", block, RECORD, directions, options, 20, ParameterVariation())
    shares = [direction.overturning_probability for direction in ranked]
    assert shares == sorted(shares, reverse=True) and {d.azimuth_deg for d in ranked} == {0.0, 45.0, 90.0, 135.0}
    first = ranked[0]
    single = sample("rock", block.block_toward(first.azimuth_deg), motion_of(RECORD, f"{first.azimuth_deg:g}"), options, 20)
    assert first.overturning_probability == single.probability


def test_all_azimuths_headline_states_share_and_worst_azimuth():
    """Mean and largest probability; a body that does not move stays in all azimuths, and no azimuth is named."""

    def azimuth(degrees, share, tilt, **keywords):
        return RockAzimuth(degrees, False, None, None, tilt, 0.3, overturning_probability=share, **keywords)

    average = average_azimuths([azimuth(135.0, 0.6, 0.5), azimuth(0.0, 0.0, 0.2), azimuth(90.0, None, 0.0, gave_up=True)], 200)
    assert average == AzimuthAverage(0.3, 80, "may overturn")
    text, _ = azimuths_headline(average, 135.0, 0.6)
    assert text.replace("\xa0", " ") == "all azimuths: may overturn (30 % on average); worst azimuth 135 (60 %)"
    still, _ = azimuths_headline(average_azimuths([azimuth(0.0, None, 0.0), azimuth(90.0, None, 0.0)], 40), 0.0, 0.0)
    assert still.replace("\xa0", " ") == "all azimuths: stays (overturning 0 %)"


def test_azimuth_sweep_checks_both_sides_of_lopsided_block():
    """Towards the opposite azimuth the heavier side is the other one: the same plane has two thresholds, and other outcomes."""
    block = Block(0.24, 0.72, centroid_offset=0.04)
    results = {result.azimuth_deg: result for result in rock_directions(block, RECORD, step_deg=30.0)}
    pairs = [(results[azimuth], results[azimuth + 180.0]) for azimuth in (0.0, 30.0, 60.0, 120.0, 150.0)]
    moving = [(one, other) for one, other in pairs if one.moves and other.moves]
    assert len(moving) >= 2 and all(one != replace(other, azimuth_deg=one.azimuth_deg) for one, other in moving)
    for one, other in moving:
        assert not (one.overturned and other.overturned) or one.overturning_time_s != other.overturning_time_s


def test_requested_azimuth_projects_base_as_sweep_does():
    """Component 120 is the row of the sweep at 120; a recorded component keeps the width along it."""
    block = Block(0.2, 0.72, depth=0.26)
    assert block_for_motion(block, motion_of(RECORD, "120")) == block.block_toward(120.0)
    assert block_for_motion(block, motion_of(RECORD, "EW")) is block
    row = next(row for row in rock_directions(block, RECORD, step_deg=60.0) if row.azimuth_deg == 120.0)
    motion = motion_of(RECORD, "120")
    alone = solve_rock(block_for_motion(block, motion), motion).outcome
    assert row.overturned == alone.overturned and row.max_rotation_ratio == pytest.approx(alone.max_rotation_ratio, rel=1e-6)


def test_batch_row_of_worst_azimuth_projects_base_once():
    """Width in the row is that towards its azimuth; with samples the azimuth is the most probable one."""
    block, options = Block(0.2, 0.72, depth=0.26), RespondOptions(mu=0.6)
    table = run_batch(RECORD, {"stone": block}, "respond", components="all-azimuths", runs=5, mu=0.6)
    azimuth = float(table["component"][0])
    assert table["width_m"][0] == pytest.approx(block.block_toward(azimuth).width, rel=1e-12)
    directions = respond_directions(block, RECORD, options)
    ranked = rank_by_probability("respond", block, RECORD, directions, options, 5, ParameterVariation())
    assert azimuth == ranked[0].azimuth_deg and table["overturning_probability"][0] == ranked[0].overturning_probability


def test_rank_by_probability_names_azimuth_without_result(monkeypatch):
    """Samples that all give up in one azimuth leave the other azimuths an answer."""

    def failing(solver, body, motion, *arguments, **keywords):
        if motion.name == "90":
            raise SolverError("stopped")
        return sample(solver, body, motion, *arguments, **keywords)

    monkeypatch.setattr("seisblock.studies.azimuth_probability.sample", failing)
    directions = rock_directions(Block(0.2, 0.72), RECORD, step_deg=45.0)
    ranked = rank_by_probability("rock", Block(0.2, 0.72), RECORD, directions, RockOptions(), 5, ParameterVariation())
    assert ranked[-1].azimuth_deg == 90.0 and ranked[-1].gave_up and "90" in str(left_out_directions(ranked)[0])


def test_sample_orientations_averages_full_circle():
    """Of a square post that no azimuth spares all samples overturn; at a hundredth of the record none; a scan is turned, too."""
    record, options = crop(RECORD, 25.0, 30.0), Rigid3dOptions(mu=0.6)
    for body in (Block(0.1, 0.9), convex_body(BOULDER)):
        average = sample_orientations(body, scale(record, 0.01), options, 4)
        assert average == AzimuthAverage(0.0, 4, "stays")
    assert sample_orientations(Block(0.1, 0.9), scale(record, 3.0), options, 12) == AzimuthAverage(1.0, 12, "likely overturns")
