"""Figures without a time axis show the values of their answer: bars, curves, maps and roses, in the unit of their axes."""

import re
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.lines import Line2D

from seisblock import Block, Pile, PileStone, solve_respond, solve_rock, solve_stack
from seisblock.bodies.scan.azimuths import scan_azimuths
from seisblock.bodies.scan.scan import scan_body
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.i18n import use_locale
from seisblock.criteria.sliding import slip_limits
from seisblock.models.respond.plot import figure as respond_figure
from seisblock.models.rock.plot import figure as rock_figure
from seisblock.models.slide.plot import figure as slide_figure
from seisblock.models.slide.solve import solve_slide
from seisblock.output.figures.fit_size import fit_figure_size
from seisblock.output.figures.solver import response_figure
from seisblock.output.figures.style import THRESHOLD
from seisblock.records import Motion
from seisblock.report.figures.azimuths import figure as azimuths_figure
from seisblock.report.figures.criteria import figure as criteria_figure
from seisblock.report.figures.fragility import figure as fragility_figure
from seisblock.report.figures.scenario import figure as scenario_figure
from seisblock.report.figures.spectrum import figure as spectrum_figure
from seisblock.report.text.fragility import verdict
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.survey.overturning_rate import overturning_rate
from seisblock.validation.furukawa import SURVEYS
from seisblock.validation.furukawa_field import MODELS, SURVEYED_RATES
from seisblock.validation.furukawa_field import rates as field_rates
from tests.report.long_record import (
    AOYAMA,
    EVERY,
    OBJECTS,
    PLANE,
    cards,
    criterion,
    every_azimuth,
    factors,
    fitted_block,
    fragilities,
    maps,
    paper_figure,
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
        computed = [p for p in points if p.kappa == pytest.approx(kappa)]
        assert contains_curve(axis, [p.mu for p in computed], [100.0 * p.max_slip_m for p in computed])


def test_scale_factor_figure_shows_curve_and_solutions():
    """Displacement against the factor, and a point at each factor that gives what was observed."""
    for axis, (_, result) in zip(axes_of("factors"), factors(), strict=True):
        scales, values = result.curve
        assert contains_curve(axis, scales, 100.0 * np.array(values))
        solutions = [factor.scale for factor in result.scale_factors if not factor.leaps]
        assert not solutions or contains_curve(axis, solutions, [100.0 * result.observed_m] * len(solutions))


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
        result = [item for item in curves_of(axis) if np.allclose(item[:, 1], curve.curve.probability(item[:, 0] / 100.0))]
        assert len(result) == 1 and len(result[0]) > 50


def test_risk_figure_shows_hazard_and_fragilities():
    """The mean hazard above, each fragility in the middle, at the same kine."""
    above, middle, _ = axes_of("risk")
    result, hazard = risks()
    assert any(len(item) > 50 and np.allclose(item[:, 1], hazard.rate(item[:, 0] / 100.0)) for item in curves_of(above))
    for arguments, _ in result:
        assert sum(np.allclose(item[:, 1], arguments.curve.probability(item[:, 0] / 100.0)) for item in curves_of(middle)) == 1


@pytest.mark.parametrize("count", [1, 2])
def test_rocking_spectrum_names_each_direction_above_its_panel_where_there_are_several(count):
    """The only direction stood in the title and again above the panel."""
    figure = spectrum_figure(spectra()[:count], "rocking", 9.81)
    assert sum(bool(axis.get_title("left")) for axis in figure.axes) == (count if count > 1 else 0)
    assert spectra()[0][0].name in figure.heading.get_text()


@pytest.mark.slow
def test_rocking_spectrum_cells_equal_results():
    """Dark where blocks fall, and elsewhere as blue as they lean."""
    for axis, (_, result) in zip(axes_of("rocking"), spectra(), strict=False):
        state, lean = (np.ma.filled(mesh.get_array().astype(float), np.nan) for mesh in axis.collections[:2])
        assert np.array_equal(state == 2, result.overturned)
        rocked = ~result.overturned & (result.max_rotation_ratio > 0.0)
        assert np.allclose(lean[rocked], result.max_rotation_ratio[rocked]) and np.isnan(lean[~rocked]).all()


@pytest.mark.slow
def test_azimuth_rose_bars_equal_results():
    """A bar towards each azimuth, as long as the body leans there or goes, both sides of what stands."""
    lean, path = axes_of("respond, all azimuths")
    result = every_azimuth("respond")
    heights = sorted(round(bar.get_height(), 6) for bar in path.patches)
    expected = [100.0 * item.max_displacement_m for item in result for _ in range(1 if item.overturned else 2)]
    assert heights == pytest.approx(sorted(expected), abs=1e-6)
    assert len(lean.patches) == len(path.patches)


def test_azimuth_rose_labels_fall_side():
    """A fall to 330 in the plane of azimuth 150 has its bar and its name at 330."""
    t = np.arange(300) * 0.01
    worst = solve_rock(Block(0.3, 0.9), Motion.from_arrays(6.0 * np.sin(4.0 * t), 0.01, name="150"))
    assert worst.outcome.overturned
    for towards, azimuth in (("-x", 330), ("+x", 150)):
        items = [RockAzimuth(90.0, False, None, None, 0.4, 0.3), RockAzimuth(150.0, True, towards, 1.0, 5.2, 0.3)]
        with use_locale("en"):
            drawn_rose = azimuths_figure([worst], [items])
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
    for axis, (_, result) in zip(axes_of("modes"), maps(), strict=False):
        assert np.array_equal(np.asarray(axis.collections[0].get_array()), result.governing)


def test_shaking_estimate_points_equal_results():
    """A point and the two ends of its interval at each frequency asked for, gal; the likelihoods are one at their largest."""
    left, right = axes_of("estimate")
    *_, estimates = shaking_estimates()
    for estimate in estimates:
        assert contains_curve(left, [estimate.frequency_hz], [100.0 * estimate.pga_m_s2])
        assert contains_curve(left, [estimate.frequency_hz] * 2, [100.0 * end for end in estimate.pga_interval_m_s2])
    curves = curves_of(right)
    assert len(curves) == len(estimates)
    for curve, estimate in zip(curves, estimates, strict=True):
        assert curve[:, 1].max() == 1.0
        low, high = (100.0 * end for end in estimate.pga_interval_m_s2)
        assert low < curve[curve[:, 1].argmax(), 0] < high


def test_fit_figure_shows_draws_and_outcomes():
    """Each parameter's median and the share of its draws per bin; each outcome at its shaking, none twice."""
    result = fitted_block()
    *expected, calibration, outcomes = EVERY["fit"][1](True).axes
    assert len(expected) == len(result.axes)
    for panel, axis in zip(expected, result.axes, strict=True):
        assert contains_curve(panel, [result[axis.name].median] * 2, [0.0, 1.0]) or any(
            list(line.get_xdata()) == [result[axis.name].median] * 2 for line in panel.get_lines()
        )
        bars = [patch for patch in panel.patches if patch.get_width() > 0.0 and patch.get_facecolor()[3] == 1.0]
        edges = [bar.get_x() for bar in bars] + [bars[-1].get_x() + bars[-1].get_width()]
        counts, _ = np.histogram(result.draws[axis.name], bins=edges, density=True)
        np.testing.assert_allclose([bar.get_height() for bar in bars], counts)
    points = np.concatenate([np.asarray(collection.get_offsets()) for collection in outcomes.collections[:2]])
    strong = result.pga_m_s2 > 0.0
    required_value = np.column_stack([result.pgv_m_s[strong] / result.pga_m_s2[strong], 100.0 * result.pga_m_s2[strong]])
    assert np.allclose(np.sort(points, axis=0), np.sort(required_value, axis=0)) and len(points) == len(required_value)
    for step in result.held_out.calibration if result.held_out else ():
        assert contains_curve(calibration, [step.mean_probability], [step.share])


def test_scan_figure_shows_plan_and_azimuths():
    """The polygons are the base and what carries, seen from above; the roses alpha and p towards each degree, closed."""
    body = scan_body("boulder.ply", inset=0.1).body
    plan, alpha, p = axes_of("a scan")
    areas = [polygon_area(patch.get_xy()[:-1]) for patch in plan.patches]
    assert areas[1] == pytest.approx(polygon_area(body.corners)) and areas[2] == pytest.approx(polygon_area(body.support_polygon))
    around = scan_azimuths(body, step_deg=1.0)
    angles = np.radians([item.azimuth_deg for item in (*around, around[0])])
    for panel, values in (
        (alpha, [np.degrees(item.slenderness_rad) for item in (*around, around[0])]),
        (p, [item.frequency_parameter_rad_s for item in (*around, around[0])]),
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
        computed = {(p.mu, p.slope_deg): p.max_slip_m for p in points if p.kappa == pytest.approx(kappa)}
        cells = np.ma.filled(axis.collections[0].get_array().astype(float), np.nan).reshape(len(PLANE["mu"]), len(PLANE["slope_deg"]))
        for row, mu in enumerate(PLANE["mu"]):
            for column, slope in enumerate(PLANE["slope_deg"]):
                slip = computed[mu, slope]
                assert (
                    np.isnan(cells[row, column]) if slip is None else cells[row, column] == pytest.approx(units * max(slip, 1e-4), rel=1e-6)
                )


def test_criterion_figure_shows_thresholds_and_levels():
    """Each threshold at its PGA, gal, and the level of each frequency, beside those of the rigid block."""
    left, right = axes_of("criterion")
    result, rigid, scaled = criterion()
    for f in result.levels:
        part = [t for t in result.thresholds if t.frequency_hz == f]
        assert not part or contains_curve(left, [100.0 * t.pga_m_s2 for t in part], [t.ratio for t in part])
    (body_value,) = scaled.values()
    assert contains_curve(left, [100.0 * t.pga_m_s2 for t in body_value], [t.ratio for t in body_value])
    for levels in (result.levels, rigid):
        assert contains_curve(right, list(levels), [100.0 * level for level in levels.values()])


def test_field_comparison_bars_equal_rates():
    """A bar per survey, and a marker per model and survey, at the rate that the model gives."""
    (axis,) = axes_of("field test")
    assert [bar.get_height() for bar in axis.patches] == list(SURVEYED_RATES)
    items = [curve[:, 1] for curve in curves_of(axis)]
    for model in MODELS:
        assert sum(np.allclose(values, field_rates(model.key)) for values in items) == 1


def test_cemetery_rates_equal_formula():
    """Curves of fig. 16 and points of fig. 20 against single rates; bars of fig. 14 and shares of fig. 15 against counts of H/B."""
    (bars,), (shares,), (curves,), (points,) = (paper_figure("furukawa2009", f"fig{number}").axes for number in (14, 15, 16, 20))
    assert sum(bar.get_height() for bar in bars.patches) == len(AOYAMA.ratios)
    for bar in bars.patches:
        middle = bar.get_x() + 0.5 * bar.get_width()
        assert bar.get_height() == np.sum((AOYAMA.ratios >= middle - 0.125) & (AOYAMA.ratios < middle + 0.125))
    (below,) = curves_of(shares)
    for ratio in (1.5, 2.5, 3.5):
        assert below[below[:, 0] <= ratio][-1, 1] == pytest.approx(np.mean(AOYAMA.ratios <= ratio), abs=1e-12)
    lines = [line for line in curves.get_lines() if line.get_label().endswith("Hz")]
    assert len(lines) == 6
    for line in lines:
        frequency = float(line.get_label().split()[0])
        for pga, rate in list(zip(*line.get_data(), strict=True))[::37]:
            assert rate == pytest.approx(overturning_rate(AOYAMA, pga / 100.0, frequency).rate)
    place = {line.get_label(): tuple(curve[0]) for line, curve in zip(points.get_lines(), curves_of(points), strict=True)}
    for survey in SURVEYS:
        computed = overturning_rate(AOYAMA, survey.pga, survey.printed_frequency_hz).rate
        assert place[survey.name] == (pytest.approx(computed), pytest.approx(survey.rate))


def test_rate_legend_matches_component_colours():
    """Colours, lines and markers of the legend are those of the panel."""
    _, axis = axes_of("rate")
    values = [entry for entry in rates() if entry.component in ("NS", "EW")]
    red = [line for line in axis.get_legend().findobj(Line2D) if line.get_color() == "#c0392b" and line.get_linestyle() == "-"]
    assert len(red) == len(values) == 2
    for item in values:
        items = [point for point in item.curve if point.frequency_hz == item.equivalent_frequency_hz]
        assert contains_curve(axis, [100.0 * point.pga_m_s2 for point in items], [point.rate for point in items])


def test_criteria_title_names_block_and_size():
    """The title of the criteria names the block and its size, as the table does."""
    assert criteria_figure(cards()).heading.get_text().endswith("block 0.3 × 0.9 m")


@pytest.mark.parametrize(("gal", "message"), [(True, "displacement > 5 cm"), (False, "displacement > 0.05 m")])
def test_slip_limit_uses_figure_unit(gal, message):
    """F: cm, or with --si m, in the key of the figure and in the table's sentence."""
    fragility = fragilities()
    fragility = replace(fragility, curves=(replace(fragility.curves[0], limit="slip=0.05m"), *fragility.curves[1:]))
    texts = [text.get_text() for text in fragility_figure(fragility, gal=gal).axes[0].get_legend().get_texts()]
    assert any(text.startswith(message) for text in texts)
    # the median had no unit
    assert all(re.search(r": [\d.]+ (gal|kine|m/s²?), β", text) for text in texts if "β" in text) and any("β" in text for text in texts)
    assert f"stone, {message}" in verdict(fragility, fragility.curves[0], gal=gal)


def test_phase_plane_is_smooth_between_impacts():
    """Between two samples the curve equals that of samples ten times as dense, within a 200th of the plane."""
    time = np.arange(301) * 0.01
    coarse = Motion.from_arrays(3.4 * np.sin(2.0 * np.pi * 2.7 * time), 0.01)
    slow, close = (solve_rock(Block(0.3, 0.9), item) for item in (coarse, finer_motion(coarse)))
    axes = rock_figure([slow]).axes
    (plane,) = [axis for axis in axes if "p α" in axis.get_ylabel()]
    (items,) = [curve for curve in curves_of(plane) if len(curve) >= slow.time.size]
    outcome = slow.outcome
    scale = np.array([plane.get_xlim()[1], plane.get_ylim()[1]])
    exact = np.column_stack([close["rotation"], close["angular_velocity"] / outcome.frequency_parameter_rad_s]) / outcome.slenderness_rad
    outer = items[np.abs(items / scale).max(axis=1) > 0.2]
    apart = [np.abs((exact - point) / scale).max(axis=1).min() for point in outer]
    assert len(outer) > 50 and max(apart) < 0.05
    assert np.quantile(apart, 0.9) < 0.01


def finer_motion(arguments):
    """Return a motion with nine samples between each two, on the straight lines between them."""
    time = np.linspace(arguments.time[0], arguments.time[-1], 10 * (arguments.samples - 1) + 1)
    return Motion.from_arrays(np.interp(time, arguments.time, arguments.horizontal), arguments.dt / 10.0)


def test_thresholds_of_asymmetric_block_lie_on_their_side():
    """A block with its centre of gravity to the right uplifts about the right corner first, under ground acceleration to the left."""
    block = Block(0.4, 1.2, centroid_offset=0.08)
    motion = Motion.from_arrays(np.array([0.0, 5.0, -5.0, 0.0]), 0.02, name="NS")
    to_right, to_left = 0.12 / 0.6 * 980.665, 0.28 / 0.6 * 980.665
    lines = respond_figure([solve_respond(block, motion, mu=0.6)]).axes[0].get_lines()
    levels = sorted(line.get_ydata()[0] for line in lines if len(line.get_ydata()) == 2)
    assert levels == pytest.approx([-to_right, to_left])
    (band,) = rock_figure([solve_rock(block, motion)]).axes[0].collections
    ordinates = band.get_paths()[0].vertices[:, 1]
    assert (ordinates.min(), ordinates.max()) == pytest.approx((-to_right, to_left))


def pulse_response(peak: float):
    """Return a block under one sine of a second, as quick as can be."""
    time = np.arange(0.0, 2.0, 0.01)
    motion = Motion.from_arrays(peak * np.sin(2.0 * np.pi * time) * (time < 1.0), 0.01, name="NS")
    return solve_respond(Block(0.24, 0.72), motion, mu=0.6, restitution=0.1)


def test_time_history_names_object_friction_and_probability():
    responses = [pulse_response(4.0)]
    (title,) = [
        axis.get_title(loc="left") for axis in respond_figure(responses, probabilities=[0.82]).axes if "μ" in axis.get_title(loc="left")
    ]
    assert title.splitlines()[1] == "24 × 72 cm, μ 0.6, overturning probability 82 %"
    titles = [
        axis.get_title(loc="left") for axis in rock_figure([solve_rock(Block(0.24, 0.72), responses[0].motion)], probabilities=[0.5]).axes
    ]
    assert any("24 × 72 cm, overturning probability 50 %" in text for text in titles)
    pile = Pile("post", (PileStone("post", 0.24, 0.24, 0.72),), mu=0.7)
    fig = response_figure([solve_stack(pile, responses[0].motion)], probabilities=[0.31])
    assert "+x = NS: post\nheight 72 cm, μ 0.7, overturning probability 31 %" in [axis.get_title(loc="left") for axis in fig.axes]


def test_time_history_fits_a_column_of_85_mm():
    fig = fit_figure_size(respond_figure([pulse_response(4.0)], probabilities=[0.82]), size=(0.085, 0.14))
    assert fig.get_size_inches()[0] == pytest.approx(0.085 / 0.0254)
    assert any("overturning probability 82 %" in axis.get_title(loc="left").replace("\n", " ") for axis in fig.axes)


def test_four_responses_are_small_multiples_of_one_page():
    responses = [pulse_response(peak) for peak in (3.0, 3.5, 4.0, 6.0)]
    fig = response_figure(responses, probabilities=[0.1, None, 0.3, 1.0])
    wide, high = fig.get_size_inches()
    assert wide <= 10.0 and high <= 11.0
    items = [axis for axis in fig.axes if axis.lines]
    assert len(items) == len(responses)
    for axis, response in zip(items, responses, strict=True):
        values = np.asarray(axis.lines[0].get_ydata())
        assert np.abs(values).max() == pytest.approx(np.degrees(np.abs(response["rotation"]).max()), rel=1e-3)
    below = [axis.get_title(loc="left").splitlines()[1] for axis in items]
    assert below[::2] == [f"overturning probability {p} %" for p in (10, 30)]
    assert below[1] == f"peak {np.degrees(np.abs(responses[1]['rotation']).max()):.3g}°"
    assert fig.get_suptitle() == "respond, block, 24 × 72 cm, μ 0.6: 4 of 4 time histories"


def test_three_responses_are_drawn_in_full():
    assert len([axis for axis in response_figure([pulse_response(4.0)] * 3).axes if axis.lines]) > 3


def test_small_multiples_stop_at_thirty():
    fig = response_figure([pulse_response(4.0)] * 31)
    assert len([axis for axis in fig.axes if axis.lines]) == 30
    assert "30 of 31" in fig.get_suptitle()


def test_sliding_limits_on_slope_are_drawn_on_their_side():
    """On a slope the downhill limit is the nearer one; each curve has the sign of its acceleration."""
    motion = Motion.from_arrays(np.linspace(-6.0, 6.0, 201), 0.01, name="EW")
    response = solve_slide(SlidingBase(0.3, slope_deg=10.0), motion)
    lines = slide_figure([response], gal=False).axes[0].get_lines()
    limits = [float(np.median(line.get_ydata())) for line in lines if line.get_color() == THRESHOLD]
    # the limits vary with the load normal to the slope: their median is that of a small acceleration
    assert limits == pytest.approx(slip_limits(10.0, 0.3), rel=5e-3)


def test_scenario_legend_explains_the_dashed_lines():
    """The limits of the classes, 5 and 50 %, were drawn without a word."""
    (legend,) = scenario_figure(OBJECTS, "JMA 6 upper").legends
    assert "limits of the classes" in [text.get_text() for text in legend.get_texts()]
