"""Every direction of a record: rows side by side say what single runs say, for blocks and for scans, and the worst comes first."""

import math

import numpy as np
import pytest

from seisblock import Block, motion_of, read, solve_respond, solve_rock
from seisblock.bodies.block_array import wear_within
from seisblock.bodies.scan.toml import load_scan
from seisblock.core.errors import ComponentError, ParameterError
from seisblock.models.respond.options import RespondOptions
from seisblock.records.process import crop, scale
from seisblock.studies import rocking_spectrum, rocking_spectrum_all_azimuths
from seisblock.studies.azimuths import make_azimuth_sweep
from seisblock.studies.model_comparison import compare_models
from seisblock.studies.respond.azimuths import respond_directions
from seisblock.studies.rocking.azimuths import rock_directions
from seisblock.uncertainty import perturb, respond_probability

BOULDER = load_scan("boulder").with_wear(0.1)
RECORD = scale(crop(read("synthetic_jma.csv"), 22.0, 32.0), 0.42)


@pytest.mark.parametrize("body", [Block(0.2, 0.72), Block(0.24, 0.72, centroid_offset=0.02), BOULDER], ids=["block", "two-sided", "scan"])
def test_rock_azimuths_equal_single_runs(body):
    """The same verdict, side, time of lying down and largest lean over alpha as one motion after the other."""
    found = rock_directions(body, RECORD, step_deg=22.5)
    assert {each.overturned for each in found} == {True, False}
    for each in found:
        motion = motion_of(RECORD, f"{each.azimuth_deg:g}")
        block = body.block_for_motion(motion) if body is BOULDER else body
        one = solve_rock(block, motion).outcome
        assert each.overturned is one.overturned and each.overturned_towards == (one.overturned_towards or None)
        assert each.overturning_time_s == pytest.approx(one.overturning_time_s, abs=1e-6)
        assert each.max_rotation_ratio == pytest.approx(one.max_rotation_ratio, rel=1e-6)
        assert each.slenderness_rad == pytest.approx(one.slenderness_rad, rel=1e-12)


def test_respond_azimuths_of_scan_equal_single_runs():
    """Verdict, largest lean, displacements and end as one motion after the other, each with its own arms."""
    for each in respond_directions(BOULDER, RECORD, options=RespondOptions(mu=0.35), step_deg=45.0):
        motion = motion_of(RECORD, f"{each.azimuth_deg:g}")
        block = BOULDER.block_for_motion(motion)
        one = solve_respond(block, motion, mu=0.35, sensitivity=False).outcome
        assert each.overturned is one.overturned and each.overturned_towards == one.overturned_towards
        assert each.max_rotation_rad == pytest.approx(one.max_rotation_rad, rel=1e-6, abs=1e-12)
        assert each.max_rotation_ratio == pytest.approx(each.max_rotation_rad / block.slenderness, rel=1e-12)
        assert each.final_displacement_m == pytest.approx(one.final_displacement_m, rel=1e-6, abs=1e-9)


def test_azimuths_sort_worst_first():
    """Falls before leans, sooner falls before later ones, larger leans before smaller ones."""
    found = rock_directions(BOULDER, RECORD, step_deg=15.0)
    fallen = [each.overturning_time_s for each in found if each.overturned]
    leaning = [each.max_rotation_ratio for each in found if not each.overturned]
    assert [each.overturned for each in found] == [True] * len(fallen) + [False] * len(leaning)
    assert fallen == sorted(fallen) and leaning == sorted(leaning, reverse=True)


def test_azimuth_range_follows_body_symmetry():
    """Half the circle for a block of two equal sides and for a scan, which stands where it stands; all of it for a block that is turned."""
    assert make_azimuth_sweep(Block(0.24, 0.72), RECORD, step_deg=10.0).azimuths.tolist() == [10.0 * i for i in range(18)]
    assert len(make_azimuth_sweep(BOULDER, RECORD, step_deg=10.0).blocks) == 18
    assert len(make_azimuth_sweep(Block(0.24, 0.72, centroid_offset=0.01), RECORD, step_deg=10.0).blocks) == 36


def test_scan_at_opposite_azimuth_falls_to_same_side():
    """Towards the opposite azimuth, the same fall to the same side of the compass, at the same time."""
    here, there = (motion_of(RECORD, name) for name in ("45", "225"))
    one, other = (solve_rock(BOULDER.block_for_motion(motion), motion).outcome for motion in (here, there))
    assert one.overturned and other.overturned
    assert {one.overturned_towards, other.overturned_towards} == {"+x", "-x"}
    assert one.overturning_time_s == pytest.approx(other.overturning_time_s, abs=1e-6)


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
    found = rocking_spectrum_all_azimuths(sizes, alphas, RECORD, step_deg=45.0)
    each = [rocking_spectrum(sizes, alphas, motion_of(RECORD, name)) for name in ("0", "45", "90", "135")]
    assert found.azimuths_deg.tolist() == [0.0, 45.0, 90.0, 135.0]
    falls = np.array([one.overturned for one in each])
    assert found.overturned.tolist() == falls.any(axis=0).tolist()
    assert found.overturning_rate.tolist() == falls.mean(axis=0).tolist()
    assert 0.0 < found.overturning_rate.mean() < 1.0 and not found.overturned.all()
    leans = np.array([one.max_rotation_ratio for one in each])
    assert found.max_rotation_ratio == pytest.approx(leans.max(axis=0), rel=1e-6)
    standing = ~found.overturned & (leans.max(axis=0) > 1e-6)
    assert standing.any()
    assert found.worst_azimuth_deg[standing].tolist() == (45.0 * leans.argmax(axis=0)[standing]).tolist()
    for i, j in np.argwhere(found.overturned)[:4]:
        block = Block(sizes[i] * math.sin(alphas[j]), sizes[i] * math.cos(alphas[j]))
        first = next(one for one in rock_directions(block, RECORD, step_deg=45.0) if one.overturned)
        assert found.worst_azimuth_deg[i, j] == first.azimuth_deg


@pytest.mark.parametrize("offset", [0.0, 0.09])
def test_samples_keep_centre_of_gravity_inside_base(offset):
    """A body whose centre of gravity lies 10 mm inside its base has versions, and other models, though a tenth of its width is more."""
    block, motion = Block(0.2, 0.6, centroid_offset=offset), motion_of(RECORD, "NS")
    assert wear_within(block, 0.1) == pytest.approx(0.04 if offset else 0.1)
    assert wear_within(block.with_wear(0.045), 0.1) == pytest.approx(0.045 if offset else 0.1)
    assert perturb(block, motion, 10).runs == respond_probability(block, motion, options=RespondOptions(mu=0.5), runs=10).runs == 10
    assert compare_models(block, motion).models >= 3
