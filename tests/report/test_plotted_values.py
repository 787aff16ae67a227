"""What figures without a clock draw is the answer they were given: bars, curves, maps and roses, in the unit of their axes."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.lines import Line2D

from seisblock import Block, solve_rock
from seisblock.bodies.scan.azimuths import scan_azimuths
from seisblock.bodies.scan.scan import scan_body
from seisblock.core.i18n import use_locale
from seisblock.records import Motion
from seisblock.report.figures.azimuths import figure as azimuths_figure
from seisblock.report.figures.criteria import figure as criteria_figure
from seisblock.report.figures.fragility import figure as fragility_figure
from seisblock.report.figures.rock import figure as rock_figure
from seisblock.report.text.fragility import verdict
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.survey.overturning_rate import overturning_rate
from seisblock.validation.furukawa_field import MODELS, SURVEYED_RATES
from seisblock.validation.furukawa_field import rates as field_rates
from seisblock.validation.furukawa_surveys import SURVEYS
from tests.report.long_record import (
    AOYAMA,
    EVERY,
    PLANE,
    cards,
    criterion,
    every_azimuth,
    factors,
    fitted_block,
    fragilities,
    maps,
    rates,
    record,
    regions,
    risks,
    shaking_estimates,
    slides,
    spectra,
    study,
)


def axes_of(kind):
    """Return the panels of a kind of figure."""
    return EVERY[kind][1](True).axes


def curves_of(axis):
    """Return the curves of a panel, those of its own data."""
    return [np.column_stack(line.get_data()) for line in axis.get_lines() if line.get_transform() == axis.transData]


def contains_curve(axis, x, y):
    """Return whether one of the curves of a panel runs through all of some points."""
    points = np.column_stack([x, y]).astype(float)
    return any(curve.shape == points.shape and np.allclose(curve, points, equal_nan=True) for curve in curves_of(axis))


@pytest.mark.slow
def test_criteria_bars_equal_demand_ratios():
    """A bar for each criterion of each component, in the order of the card."""
    for axis, card in zip(axes_of("criteria"), cards(), strict=True):
        assert [bar.get_width() for bar in axis.patches] == pytest.approx([row.demand / row.threshold for row in card.rows])


def test_sliding_spectrum_curves_equal_results():
    """Friction and cm; what holds has no point."""
    (axis,) = axes_of("sliding")
    for _, points in slides():
        assert contains_curve(axis, [p.mu for p in points], [100.0 * p.max_slip_m or np.nan for p in points])


def test_slide_study_curves_equal_results():
    """One curve per ratio of frictions, cm."""
    (axis,) = axes_of("study")
    (points,) = study(mu=(0.1, 0.2, 0.3), kappa=(0.5, 1.0))
    for kappa in (0.5, 1.0):
        mine = [p for p in points if p.kappa == pytest.approx(kappa)]
        assert contains_curve(axis, [p.mu for p in mine], [100.0 * p.max_slip_m for p in mine])


def test_scale_factor_figure_shows_curve_and_solutions():
    """Displacement against the factor, and a point at each factor that gives what was observed."""
    for axis, (_, found) in zip(axes_of("factors"), factors(), strict=True):
        scales, values = found.curve
        assert contains_curve(axis, scales, 100.0 * np.array(values))
        solutions = [each.scale for each in found.scale_factors if not each.leaps]
        assert not solutions or contains_curve(axis, solutions, [100.0 * found.observed_m] * len(solutions))


def test_record_figure_contains_every_peak():
    """Every peak of each component stands in its panel, gal."""
    for axis, part in zip(axes_of("a record"), record().components, strict=True):
        values = 100.0 * part.acceleration
        (curve,) = curves_of(axis)
        assert (curve[:, 1].min(), curve[:, 1].max()) == pytest.approx((values.min(), values.max()))


def test_fragility_curves_equal_lognormals():
    """Each curve of the answer, at its kine."""
    axis = axes_of("fragility")[0]
    for curve in fragilities().curves:
        shown = [each for each in curves_of(axis) if np.allclose(each[:, 1], curve.curve.probability(each[:, 0] / 100.0))]
        assert len(shown) == 1 and len(shown[0]) > 50


def test_risk_figure_shows_hazard_and_fragilities():
    """The mean hazard above, each fragility in the middle, at the same kine."""
    above, middle, _ = axes_of("risk")
    found, hazard = risks()
    assert any(len(each) > 50 and np.allclose(each[:, 1], hazard.rate(each[:, 0] / 100.0)) for each in curves_of(above))
    for given, _ in found:
        assert sum(np.allclose(each[:, 1], given.curve.probability(each[:, 0] / 100.0)) for each in curves_of(middle)) == 1


@pytest.mark.slow
def test_rocking_spectrum_cells_equal_results():
    """Dark where blocks fall, and elsewhere as blue as they lean."""
    for axis, (_, found) in zip(axes_of("rocking"), spectra(), strict=False):
        state, lean = (np.ma.filled(mesh.get_array().astype(float), np.nan) for mesh in axis.collections[:2])
        assert np.array_equal(state == 2, found.overturned)
        rocked = ~found.overturned & (found.max_rotation_ratio > 0.0)
        assert np.allclose(lean[rocked], found.max_rotation_ratio[rocked]) and np.isnan(lean[~rocked]).all()


@pytest.mark.slow
def test_azimuth_rose_bars_equal_results():
    """A bar towards each azimuth, as long as the body leans there or goes, both sides of what stands."""
    lean, path = axes_of("respond, all azimuths")
    found = every_azimuth("respond")
    heights = sorted(round(bar.get_height(), 6) for bar in path.patches)
    wanted = [100.0 * each.max_displacement_m for each in found for _ in range(1 if each.overturned else 2)]
    assert heights == pytest.approx(sorted(wanted), abs=1e-6)
    assert len(lean.patches) == len(path.patches)


def test_azimuth_rose_labels_fall_side():
    """What falls to 330 in the plane of azimuth 150 has its bar there, and its name above; what stands has both sides, and the plane's."""
    t = np.arange(300) * 0.01
    worst = solve_rock(Block(0.3, 0.9), Motion.from_arrays(6.0 * np.sin(4.0 * t), 0.01, name="150"))
    assert worst.outcome.overturned
    for towards, azimuth in (("-x", 330), ("+x", 150)):
        found = [RockAzimuth(90.0, False, None, None, 0.4, 0.3), RockAzimuth(150.0, True, towards, 1.0, 5.2, 0.3)]
        with use_locale("en"):
            drawn_rose = azimuths_figure([worst], [found])
        (rose,) = drawn_rose.axes
        assert drawn_rose.get_suptitle() == "all azimuths", "not that of the worst alone"
        assert rose.get_title("left").endswith(f"worst: azimuth {azimuth}")
        fell = [np.degrees(bar.get_x() + bar.get_width() / 2.0) for bar in rose.patches if bar.get_height() == 1.0]
        assert fell == pytest.approx([azimuth])


@pytest.mark.slow
def test_harmonic_region_curves_equal_results():
    """A over g against the frequency, and a point at each of their troughs."""
    axis = axes_of("harmonic")[0]
    for region in regions(damping=(0.02, 0.05)):
        assert contains_curve(axis, region.frequency_ratio, np.minimum(region.acceleration_ratio, 1e3))


@pytest.mark.slow
def test_mode_map_cells_equal_results():
    """Each cell is the worst mode of its friction and its slenderness."""
    for axis, (_, found) in zip(axes_of("modes"), maps(), strict=False):
        assert np.array_equal(np.asarray(axis.collections[0].get_array()), found.governing)


def test_shaking_estimate_points_equal_results():
    """A point and the two ends of its interval at each frequency asked for, gal; the likelihoods are one at their largest."""
    left, right = axes_of("estimate")
    *_, estimates = shaking_estimates()
    for each in estimates:
        assert contains_curve(left, [each.frequency_hz], [100.0 * each.pga_m_s2])
        assert contains_curve(left, [each.frequency_hz] * 2, [100.0 * end for end in each.pga_interval_m_s2])
    curves = curves_of(right)
    assert len(curves) == len(estimates)
    for curve, each in zip(curves, estimates, strict=True):
        assert curve[:, 1].max() == 1.0
        low, high = (100.0 * end for end in each.pga_interval_m_s2)
        assert low < curve[curve[:, 1].argmax(), 0] < high


def test_fit_figure_shows_draws_and_outcomes():
    """Each parameter's median and the share of its draws per bin; each outcome at its shaking, none twice."""
    found = fitted_block()
    *known, calibration, outcomes = EVERY["fit"][1](True).axes
    assert len(known) == len(found.axes)
    for panel, axis in zip(known, found.axes, strict=True):
        assert contains_curve(panel, [found[axis.name].median] * 2, [0.0, 1.0]) or any(
            list(line.get_xdata()) == [found[axis.name].median] * 2 for line in panel.get_lines()
        )
        bars = [patch for patch in panel.patches if patch.get_width() > 0.0 and patch.get_facecolor()[3] == 1.0]
        edges = [bar.get_x() for bar in bars] + [bars[-1].get_x() + bars[-1].get_width()]
        counts, _ = np.histogram(found.draws[axis.name], bins=edges, density=True)
        np.testing.assert_allclose([bar.get_height() for bar in bars], counts)
    points = np.concatenate([np.asarray(each.get_offsets()) for each in outcomes.collections[:2]])
    strong = found.pga_m_s2 > 0.0
    wanted = np.column_stack([found.pgv_m_s[strong] / found.pga_m_s2[strong], 100.0 * found.pga_m_s2[strong]])
    assert np.allclose(np.sort(points, axis=0), np.sort(wanted, axis=0)) and len(points) == len(wanted)
    for step in found.held_out.calibration if found.held_out else ():
        assert contains_curve(calibration, [step.mean_probability], [step.share])


def test_scan_figure_shows_plan_and_azimuths():
    """The polygons are the base and what carries, seen from above; the roses alpha and p towards each degree, closed."""
    body = scan_body("boulder.ply", inset=0.1).body
    plan, alpha, p = axes_of("a scan")
    areas = [polygon_area(patch.get_xy()[:-1]) for patch in plan.patches]
    assert areas[1] == pytest.approx(polygon_area(body.corners)) and areas[2] == pytest.approx(polygon_area(body.support_polygon))
    around = scan_azimuths(body, step_deg=1.0)
    angles = np.radians([each.azimuth_deg for each in (*around, around[0])])
    for panel, values in (
        (alpha, [np.degrees(each.slenderness_rad) for each in (*around, around[0])]),
        (p, [each.frequency_parameter_rad_s for each in (*around, around[0])]),
    ):
        assert any(np.allclose(np.column_stack(line.get_data()), np.column_stack([angles, values])) for line in panel.get_lines())


def polygon_area(corners):
    """Return the area of a polygon, by the shoelace formula."""
    x, y = np.asarray(corners).T
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def test_slip_plane_cells_equal_results():
    """The slip of each slope and friction, in the unit of the bar, a panel per ratio of frictions."""
    (bar,) = {axis.get_ylabel() for axis in axes_of("plane") if axis.get_label() == "<colorbar>"}
    units = {"max. sliding displacement (cm)": 100.0, "max. sliding displacement (m)": 1.0}[bar]
    panels = [axis for axis in axes_of("plane") if axis.collections and axis.get_label() != "<colorbar>"]
    (points,) = study(**PLANE)
    for axis, kappa in zip(panels, PLANE["kappa"], strict=True):
        mine = {(p.mu, p.slope_deg): p.max_slip_m for p in points if p.kappa == pytest.approx(kappa)}
        cells = np.ma.filled(axis.collections[0].get_array().astype(float), np.nan).reshape(len(PLANE["mu"]), len(PLANE["slope_deg"]))
        for row, mu in enumerate(PLANE["mu"]):
            for column, slope in enumerate(PLANE["slope_deg"]):
                slip = mine[mu, slope]
                assert (
                    np.isnan(cells[row, column]) if slip is None else cells[row, column] == pytest.approx(units * max(slip, 1e-4), rel=1e-6)
                )


def test_criterion_figure_shows_thresholds_and_levels():
    """Each threshold at its PGA, gal, and the level of each frequency, beside those of the rigid block."""
    left, right = axes_of("criterion")
    found, rigid, scaled = criterion()
    for f in found.levels:
        part = [t for t in found.thresholds if t.frequency_hz == f]
        assert not part or contains_curve(left, [100.0 * t.pga_m_s2 for t in part], [t.ratio for t in part])
    (own,) = scaled.values()
    assert contains_curve(left, [100.0 * t.pga_m_s2 for t in own], [t.ratio for t in own])
    for levels in (found.levels, rigid):
        assert contains_curve(right, list(levels), [100.0 * level for level in levels.values()])


def test_field_comparison_bars_equal_rates():
    """A bar per survey, and a marker per model and survey, at the rate that the model gives."""
    (axis,) = axes_of("field test")
    assert [bar.get_height() for bar in axis.patches] == list(SURVEYED_RATES)
    shown = [curve[:, 1] for curve in curves_of(axis)]
    for model in MODELS:
        assert sum(np.allclose(values, field_rates(model.key)) for values in shown) == 1


def test_cemetery_rates_equal_formula():
    """Curves of fig. 16 and points of fig. 20 against single rates; the share above each H/B of fig. 14 against a count."""
    (distribution,), (curves,), (points,) = (axes_of(f"as fig. {number}") for number in (14, 16, 20))
    (above,) = [curve for curve in curves_of(distribution) if len(curve) > 50]
    for ratio in (1.5, 2.5, 3.5):
        seen = above[above[:, 0] >= ratio][0, 1]
        assert seen == pytest.approx(np.mean(AOYAMA.ratios >= ratio), abs=1e-12)
    lines = [line for line in curves.get_lines() if line.get_label().endswith("Hz")]
    assert len(lines) == 6
    for line in lines:
        frequency = float(line.get_label().split()[0])
        for pga, rate in list(zip(*line.get_data(), strict=True))[::37]:
            assert rate == pytest.approx(overturning_rate(AOYAMA, pga / 100.0, frequency).rate)
    where = [tuple(np.asarray(each.get_offsets())[0]) for each in points.collections]
    for survey in SURVEYS:
        assert (pytest.approx(overturning_rate(AOYAMA, survey.pga, survey.frequency).rate), survey.rate) in where


def test_rate_legend_matches_component_colours():
    """What is red in the panel is red in the key, in the same line, with the mark of its point."""
    _, axis = axes_of("rate")
    shown = [each for each in rates() if each.component in ("NS", "EW")]
    red = [line for line in axis.get_legend().findobj(Line2D) if line.get_color() == "#c0392b" and line.get_linestyle() == "-"]
    assert len(red) == len(shown) == 2
    for each in shown:
        own = [point for point in each.curve if point.frequency_hz == each.equivalent_frequency_hz]
        assert contains_curve(axis, [100.0 * point.pga_m_s2 for point in own], [point.rate for point in own])


def test_criteria_title_names_block_and_size():
    """The title of the criteria names the block and its size, as the table does."""
    assert criteria_figure(cards()).heading.get_text().endswith("block 0.3 × 0.9 m")


@pytest.mark.parametrize(("gal", "told"), [(True, "displacement > 5 cm"), (False, "displacement > 0.05 m")])
def test_slip_limit_uses_figure_unit(gal, told):
    """F: cm, or with --si m, in the key of the figure and in the table's sentence."""
    found = fragilities()
    found = replace(found, curves=(replace(found.curves[0], limit="slip=0.05m"), *found.curves[1:]))
    texts = [text.get_text() for text in fragility_figure(found, gal=gal).axes[0].get_legend().get_texts()]
    assert any(text.startswith(told) for text in texts)
    assert f"stone, {told}" in verdict(found, found.curves[0], gal=gal)


def test_phase_plane_is_smooth_between_impacts():
    """Between two samples the state goes as it turns: what is drawn is that of samples ten times as close, to a 200th of the plane."""
    time = np.arange(301) * 0.01
    coarse = Motion.from_arrays(3.4 * np.sin(2.0 * np.pi * 2.7 * time), 0.01)
    slow, close = (solve_rock(Block(0.3, 0.9), each) for each in (coarse, finer_motion(coarse)))
    axes = rock_figure([slow]).axes
    (plane,) = [axis for axis in axes if "p α" in axis.get_ylabel()]
    (shown,) = [curve for curve in curves_of(plane) if len(curve) >= slow.time.size]
    outcome = slow.outcome
    scale = np.array([plane.get_xlim()[1], plane.get_ylim()[1]])
    exact = np.column_stack([close["rotation"], close["angular_velocity"] / outcome.frequency_parameter_rad_s]) / outcome.slenderness_rad
    outer = shown[np.abs(shown / scale).max(axis=1) > 0.2]
    apart = [np.abs((exact - point) / scale).max(axis=1).min() for point in outer]
    assert len(outer) > 50 and max(apart) < 0.05
    assert np.quantile(apart, 0.9) < 0.01


def finer_motion(given):
    """Return a motion with nine samples between each two, on the straight lines between them."""
    time = np.linspace(given.time[0], given.time[-1], 10 * (given.samples - 1) + 1)
    return Motion.from_arrays(np.interp(time, given.time, given.horizontal), given.dt / 10.0)
