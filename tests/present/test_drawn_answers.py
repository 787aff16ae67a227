"""What figures without a clock draw is the answer they were given: bars, curves, maps and roses, in the unit of their axes."""

import numpy as np
import pytest

from tests.present.long_record import (
    EVERY,
    cards,
    every_azimuth,
    factors,
    fragilities,
    maps,
    record,
    regions,
    risks,
    slides,
    spectra,
    study,
)


def axes_of(kind):
    """Return the panels of a kind of figure."""
    return EVERY[kind][1](True).axes


def drawn(axis):
    """Return the curves of a panel, those of its own data."""
    return [np.column_stack(line.get_data()) for line in axis.get_lines() if line.get_transform() == axis.transData]


def holds(axis, x, y):
    """Return whether one of the curves of a panel runs through all of some points."""
    points = np.column_stack([x, y]).astype(float)
    return any(curve.shape == points.shape and np.allclose(curve, points, equal_nan=True) for curve in drawn(axis))


@pytest.mark.slow
def test_criteria_are_bars_as_long_as_their_ratio():
    """A bar for each criterion of each component, in the order of the card."""
    for axis, card in zip(axes_of("criteria"), cards(), strict=True):
        assert [bar.get_width() for bar in axis.patches] == pytest.approx([row.demand / row.threshold for row in card.rows])


def test_a_sliding_spectrum_is_its_points():
    """Friction and cm; what holds has no point."""
    (axis,) = axes_of("sliding")
    for _, points in slides():
        assert holds(axis, [p.mu for p in points], [100.0 * p.max_slip_m or np.nan for p in points])


def test_a_study_is_its_curves():
    """One curve per ratio of frictions, cm."""
    (axis,) = axes_of("study")
    (points,) = study(mu=(0.1, 0.2, 0.3), kappa=(0.5, 1.0))
    for kappa in (0.5, 1.0):
        mine = [p for p in points if p.kappa == pytest.approx(kappa)]
        assert holds(axis, [p.mu for p in mine], [100.0 * p.max_slip_m for p in mine])


def test_factors_are_their_curve_and_their_solutions():
    """Displacement against the factor, and a point at each factor that gives what was observed."""
    for axis, (_, found) in zip(axes_of("factors"), factors(), strict=True):
        scales, values = found.curve
        assert holds(axis, scales, 100.0 * np.array(values))
        solutions = [each.scale for each in found.scale_factors if not each.leaps]
        assert not solutions or holds(axis, solutions, [100.0 * found.observed_m] * len(solutions))


def test_a_record_is_its_samples():
    """Every peak of each component stands in its panel, gal."""
    for axis, part in zip(axes_of("a record"), record().components, strict=True):
        values = 100.0 * part.acceleration
        (curve,) = drawn(axis)
        assert (curve[:, 1].min(), curve[:, 1].max()) == pytest.approx((values.min(), values.max()))


def test_fragilities_are_their_lognormals():
    """Each curve of the answer, at its kine."""
    axis = axes_of("fragility")[0]
    for curve in fragilities().curves:
        shown = [each for each in drawn(axis) if np.allclose(each[:, 1], curve.curve.probability(each[:, 0] / 100.0))]
        assert len(shown) == 1 and len(shown[0]) > 50


def test_risks_are_their_hazard_and_fragilities():
    """The mean hazard above, each fragility in the middle, at the same kine."""
    above, middle, _ = axes_of("risk")
    found, hazard = risks()
    assert any(len(each) > 50 and np.allclose(each[:, 1], hazard.rate(each[:, 0] / 100.0)) for each in drawn(above))
    for given, _ in found:
        assert sum(np.allclose(each[:, 1], given.curve.probability(each[:, 0] / 100.0)) for each in drawn(middle)) == 1


@pytest.mark.slow
def test_a_rocking_spectrum_is_its_map():
    """Dark where blocks fall, and elsewhere as blue as they lean."""
    for axis, (_, found) in zip(axes_of("rocking"), spectra(), strict=False):
        state, lean = (np.ma.filled(mesh.get_array().astype(float), np.nan) for mesh in axis.collections[:2])
        assert np.array_equal(state == 2, found.overturned)
        rocked = ~found.overturned & (found.max_rotation_ratio > 0.0)
        assert np.allclose(lean[rocked], found.max_rotation_ratio[rocked]) and np.isnan(lean[~rocked]).all()


@pytest.mark.slow
def test_a_rose_is_its_directions():
    """A bar towards each azimuth, as long as the body leans there or goes, both sides of what stands."""
    lean, path = axes_of("respond, all azimuths")
    found = every_azimuth("respond")
    heights = sorted(round(bar.get_height(), 6) for bar in path.patches)
    wanted = [100.0 * each.max_displacement_m for each in found for _ in range(1 if each.overturned else 2)]
    assert heights == pytest.approx(sorted(wanted), abs=1e-6)
    assert len(lean.patches) == len(path.patches)


@pytest.mark.slow
def test_harmonic_regions_are_their_curves():
    """A over g against the frequency, and a point at each of their troughs."""
    axis = axes_of("harmonic")[0]
    for region in regions(damping=(0.02, 0.05)):
        assert holds(axis, region.frequency_ratio, np.minimum(region.acceleration_ratio, 1e3))


@pytest.mark.slow
def test_a_map_of_modes_is_its_cells():
    """Each cell is the worst mode of its friction and its slenderness."""
    for axis, (_, found) in zip(axes_of("modes"), maps(), strict=False):
        assert np.array_equal(np.asarray(axis.collections[0].get_array()), found.governing)
