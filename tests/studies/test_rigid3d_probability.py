"""Samples in three dimensions: the same draws as in the plane, scaled solids, twist and place of those that stand."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock import Block, ConvexBody, Motion, motion_of, read, solve_rigid3d
from seisblock.bodies import load_scan
from seisblock.bodies.convex import convex_body
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.factory import load_block
from seisblock.bodies.scan.body import ScannedBody
from seisblock.cli import main
from seisblock.core.errors import KindError
from seisblock.core.i18n import use_locale
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rigid3d.describe import clean_angle, describe
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.plot import figure
from seisblock.report.text.assessment import assessment_lines
from seisblock.studies.assessment import assess_direction
from seisblock.studies.azimuth_probability import AzimuthAverage
from seisblock.studies.respond.azimuths import Rigid3dAzimuth
from seisblock.studies.respond.probability import summarize_spatial
from seisblock.studies.sampling import ParameterVariation, draw_samples, sample, sample_solids
from seisblock.studies.solvers.rigid3d import THREE_DIMENSIONS

FIXED = ParameterVariation(size=0.0, inset=0.0, mu=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)


def shaking(peak, *, plane=False, vertical=0.3):
    """Return two seconds of smooth motion, m/s^2."""
    time = np.arange(0.0, 2.0, 0.01)
    along = peak * np.sin(2.0 * np.pi * 1.3 * time) * np.sin(np.pi * time / 2.0)
    across = 0.0 * along if plane else 0.7 * peak * np.sin(2.0 * np.pi * 1.7 * time) * np.sin(np.pi * time / 2.0)
    return Motion(np.array([along, across, vertical * across]), 0.01, name="90")


def test_convex_body_scaled_is_the_hull_of_scaled_points():
    """Mass, centre and inertia are those of the homogeneous solid of the scaled vertices."""
    points = np.random.default_rng(5).normal(size=(20, 3))
    plan, tall = 1.3, 0.7
    scaled, direct = ConvexBody.polyhedron(points).scaled(plan, tall), ConvexBody.polyhedron(points * [plan, plan, tall])
    assert scaled.mass == pytest.approx(direct.mass)
    np.testing.assert_allclose(scaled.centre, direct.centre, atol=1e-12)
    np.testing.assert_allclose(scaled.inertia, direct.inertia, rtol=1e-9, atol=1e-9 * direct.mass)


def test_sample_solids_have_the_given_body_as_median():
    body = load_block("gravestone")
    draws = draw_samples(501, 0)
    solids = sample_solids(body, ParameterVariation(), draws)
    nominal = convex_body(body)
    for values, body_value in (
        ([np.ptp(solid.points[:, 0]) for solid in solids], body.width),
        ([solid.centre[2] for solid in solids], body.centre),
        ([np.ptp(solid.support_polygon[:, 0]) for solid in solids], np.ptp(nominal.support_polygon[:, 0])),
    ):
        assert np.median(values) == pytest.approx(body_value, rel=8e-3)
    assert sample_solids(body, FIXED, draws[:1])[0] == nominal


def test_sample_rigid3d_agrees_with_respond_sample_by_sample_in_the_plane():
    """A wall shaken along its thin side falls in the same samples as the planar block; nothing but the depth differs."""
    wall, motion = Block(0.3, 1.2, 4.0), shaking(3.8, plane=True, vertical=0.0)
    variation = ParameterVariation(restitution=0.0)
    planar = sample("respond", wall, motion, RespondOptions(mu=0.9), 60, variation, seed=3)
    spatial = sample("rigid3d", wall, motion, Rigid3dOptions(mu=0.9), 60, variation, seed=3)
    assert 0.2 < planar.probability < 0.8
    assert np.count_nonzero(planar.overturned != spatial.overturned) <= 1


def test_sample_rigid3d_repeats_the_run_where_nothing_varies():
    body, motion, options = load_scan("boulder"), shaking(2.6), Rigid3dOptions(mu=0.5, settle_s=3.0)
    outcome = solve_rigid3d(body, motion, **options.keywords()).outcome
    samples = sample("rigid3d", body, motion, options, 3, FIXED)
    assert set(samples.outcomes) == {outcome}
    assert outcome.max_tilt_rad > 1e-3


def toppling(length, later=()):
    """Return a half sine of 12 m/s^2 and 0.4 s along x, and more of (start, s, amplitude, m/s^2, length, s)."""
    time = np.arange(0.0, length, 0.01)
    along = np.zeros_like(time)
    for start, peak, duration in ((0.2, 12.0, 0.4), *later):
        along += np.where((time > start) & (time < start + duration), peak * np.sin(np.pi * (time - start) / duration), 0.0)
    return Motion(np.array([along, 0.0 * along, 0.0 * along]), 0.01, name="90")


@pytest.mark.parametrize("start", [5.5, 11.0])
def test_sample_rigid3d_follows_a_fallen_body_that_a_later_pulse_returns(start):
    body, options = Block(0.3, 0.4, 0.3), Rigid3dOptions(mu=1.5)
    assert sample("rigid3d", body, toppling(20.0), options, 1, FIXED).outcomes[0].overturned
    motion = toppling(20.0, [(start, -28.0, 0.3)])
    assert sample("rigid3d", body, motion, options, 1, FIXED).outcomes == (solve_rigid3d(body, motion, **options.keywords()).outcome,)
    assert not solve_rigid3d(body, motion, **options.keywords()).outcome.overturned


def test_sample_rigid3d_ends_runs_that_the_rest_of_the_motion_cannot_turn():
    """A boulder rattles for two minutes under 0.01 m/s^2 after its fall; verdict, time and azimuth are those of the whole run."""
    body, options = load_scan("boulder"), Rigid3dOptions(mu=0.6)
    motion = toppling(120.0)
    tremor = 0.01 * np.sin(2.0 * np.pi * 0.7 * motion.time)
    motion = Motion(motion.acceleration + np.array([tremor, -0.5 * tremor, 0.0 * tremor]), 0.01, name="90")
    whole, (ended,) = solve_rigid3d(body, motion, **options.keywords()).outcome, sample("rigid3d", body, motion, options, 1, FIXED).outcomes
    assert whole.overturned
    assert whole.end_s > 100.0
    assert ended.end_s < 20.0
    assert (ended.overturning_time_s, ended.fell_azimuth_deg) == (whole.overturning_time_s, whole.fell_azimuth_deg)


def test_summarize_spatial_gives_twist_and_place_of_samples_that_stand():
    body, motion = Block(0.3, 0.9, 0.4), shaking(4.5)
    samples = sample("rigid3d", body, motion, Rigid3dOptions(mu=0.6), 40)
    probability = summarize_spatial(samples, body)
    twists = [outcome.twist_deg for outcome in samples.outcomes if not outcome.overturned]
    assert 0 < samples.overturned.sum() < 40
    assert len(probability.fell_azimuths_deg) == samples.overturned.sum()
    assert probability.twist_deg["q50"] == pytest.approx(np.median(twists))
    assert probability.abs_twist_deg["q95"] > probability.abs_twist_deg["q50"] > 0.0
    assert probability.final_displacement_m["q95"] > 0.0


def test_assess_direction_compares_three_dimensions_with_the_plane():
    part = assess_direction("rigid3d", Block(0.3, 0.9, 0.4), shaking(4.5), Rigid3dOptions(mu=0.6), 10)
    assert [model.name for model in part.assessment.models] == [THREE_DIMENSIONS, "full response"]
    assert part.assessment.least_factor <= part.assessment.greatest_factor
    with pytest.raises(KindError):
        sample("respond", load_scan("boulder"), shaking(1.0), RespondOptions(mu=0.6), 2)


def test_headline_of_all_azimuths_in_three_dimensions():
    """The mean is that of samples in all azimuths, the probability of the worst azimuth that of its own samples."""
    part = assess_direction("rigid3d", Block(0.3, 0.9, 0.4), shaking(4.5), Rigid3dOptions(mu=0.6), 10)
    part = replace(part, assessment=replace(part.assessment, overturning_probability=0.7))
    directions = [Rigid3dAzimuth(30.0, True, 40.0, 0.3, 2.0, 0.1, 0.1, 0.9)]
    extra = {"assessment": part, "directions": directions, "all_azimuths": AzimuthAverage(0.25, 100, "may overturn")}
    first = next(assessment_lines(extra)).plain.replace("\xa0", " ")
    assert first == "all azimuths: may overturn (25 % on average); worst azimuth 30 (70 %)"


def run(*arguments):
    result = CliRunner().invoke(main, [*arguments, "--window", "22:28", "--json"])
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


BLOCK = ("--width", "24cm", "--height", "72cm", "--depth", "30cm", "--mu", "0.5", "--scale", "0.4")


def test_respond_in_three_dimensions_obeys_the_options_of_samples():
    """The number, spread and seed of samples act, and the answer is that of rigid3d."""
    plain = run("respond", *BLOCK, "--three-d", "--runs", "12")
    assert plain["schema"].startswith("seisblock/rigid3d/")
    result = plain["results"][0]
    assert result["assessment"]["runs"] == 12 and plain["object"] == result["assessment"]
    assert result["probability"]["versions"]["size"] == 0.05
    assert {"overturned", "overturning_time_s", "final_displacement_m", "twist_deg", "max_tilt_rad", "fell_azimuth_deg"} <= set(result)
    assert run("rigid3d", *BLOCK, "--runs", "12")["results"] == plain["results"]
    second = run("respond", *BLOCK, "--three-d", "--runs", "12", "--vary-size", "0.2", "--seed", "4")["results"][0]
    assert second["probability"]["abs_twist_deg"] != result["probability"]["abs_twist_deg"]
    none = run("respond", *BLOCK, "--three-d", "--runs", "0")
    assert "assessment" not in none["results"][0] and "object" not in none


def test_respond_solves_scans_in_three_dimensions_unless_planar():
    scan = ("respond", "--block", "boulder", "--mu", "0.6", "--scale", "0.2")
    assert run(*scan, "--runs", "0")["schema"].startswith("seisblock/rigid3d/")
    assert run(*scan, "--runs", "0", "--planar")["schema"].startswith("seisblock/respond/")
    assert run(*scan, "--runs", "0", "--mu-kinetic", "0.5")["schema"].startswith("seisblock/respond/")
    assert run("respond", *BLOCK, "--runs", "0")["schema"].startswith("seisblock/respond/")
    refused = CliRunner().invoke(main, [*scan, "--three-d", "--mu-kinetic", "0.5"])
    assert refused.exit_code == 3 and "--mu-kinetic has no effect" in refused.output


def test_respond_in_three_dimensions_turns_a_scan_through_all_azimuths():
    """72 runs with all components, the worst first; a block turned by half a circle is the same."""
    answer = run("respond", *BLOCK, "--three-d", "--component", "all-azimuths", "--runs", "0")
    directions = answer["results"][0]["directions"]
    assert sorted(item["azimuth_deg"] for item in directions) == list(np.arange(0.0, 360.0, 5.0))
    assert f"{directions[0]['azimuth_deg']:g}" == answer["results"][0]["component"]
    tilts = {item["azimuth_deg"]: item["max_tilt_rad"] for item in directions}
    assert tilts[40.0] == pytest.approx(tilts[220.0], rel=1e-6)
    assert len({round(tilt, 9) for tilt in tilts.values()}) > 30


def test_convex_body_of_a_worn_scan_stands_on_its_worn_base():
    """A plane at 45 degrees cuts the hull along each side; the worn body rocks earlier."""
    base = ((0.1, 0.15), (-0.1, 0.15), (-0.1, -0.15), (0.1, -0.15))
    inertia = ((16.0, 0.0, 0.0), (0.0, 14.0, 0.0), (0.0, 0.0, 5.0))
    hull = tuple((x, y, z) for z in (0.0, 0.8) for x, y in base)
    worn = convex_body(ScannedBody("box", 240.0, 0.8, (0.0, 0.0, 0.4), inertia, base, EdgeWear(length_m=0.02), hull=hull))
    expected = convex_body(Block(0.2, 0.8, 0.3, 240.0, inset=0.02))
    assert {tuple(row) for row in worn.points.round(9) + 0.0} == {tuple(row) for row in expected.points.round(9) + 0.0}
    push = Motion(np.array([np.full(20, 0.95 * 9.80665 * 0.08 / 0.4), np.zeros(20), np.zeros(20)]), 0.01)
    stronger = Motion(push.acceleration * 1.1, 0.01)
    assert not solve_rigid3d(worn, push, mu=1.0).outcome.moved
    assert solve_rigid3d(worn, stronger, mu=1.0).outcome.moved
    boulder = load_scan("boulder").with_wear(EdgeWear(length_m=0.01))
    assert solve_rigid3d(boulder, Motion(np.zeros((3, 10)), 0.01), mu=0.5).outcome.moved is False


def test_text_of_a_sliding_body_has_no_round_off():
    """A plate that slides has a tilt and a twist of 1e-15 degrees: both are printed as 0."""
    plate = ConvexBody.box(0.5, 0.5, 0.02)
    motion = motion_of(read("synthetic_jma.csv"), "NS")
    response = solve_rigid3d(plate, motion, mu=0.3)
    assert 0.0 < abs(response.outcome.twist_deg) < 1e-9
    assert describe(response).endswith("twist 0°.")
    assert "largest tilt 0°" in describe(response)
    assert clean_angle(4e-5) == 0.0 and clean_angle(6e-5) == 6e-5  # 0.0000 and 0.0001 in the table


def test_figure_in_three_dimensions_is_whole_in_japanese():
    """The verdict above the panels is translated, too: it was in English."""
    response = solve_rigid3d(Block(0.2, 0.8, 0.2), shaking(8.0), mu=0.7)
    assert response.outcome.overturned
    with use_locale("ja"):
        titles = [axis.get_title(loc=place) for axis in figure([response]).axes for place in ("left", "center")]
    assert any("転倒" in title for title in titles) and not any("overturns" in title for title in titles)


def test_figure_in_three_dimensions_scales_to_the_interval_that_it_shows():
    """A fallen boulder rolls on; its twist to the end of the record made that until the fall a line."""
    motion = shaking(8.0)
    motion = replace(motion, rows=np.pad(motion.acceleration, ((0, 0), (0, 600))))
    response = solve_rigid3d(Block(0.2, 0.8, 0.2), motion, mu=0.7)
    panels = figure([response]).axes[-3:]
    end = panels[0].get_xlim()[1]
    assert end < response.time[-1]
    for panel in panels:
        low, high = panel.get_ylim()
        shown = np.concatenate([line.get_ydata()[line.get_xdata() <= end] for line in panel.lines])
        assert np.ptp(shown) > 0.85 * (high - low)
