"""The figures of cemeteries show what the studies compute ([Furukawa2009]_ figs. 14 to 20)."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.report.figures.cemetery import figure_14, figure_16, figure_20, overturn_rate_figure
from seisblock.studies.survey.assessment import AssessmentMethod, assess_cemetery, overturning_curve
from seisblock.studies.survey.overturning_rate import overturning_rate
from seisblock.studies.survey.shaking import Shaking
from seisblock.validation.furukawa_surveys import SURVEYS

AOYAMA = read_cemetery("aoyama.csv")


def test_slenderness_histograms_contain_every_stone():
    """The bars add up to one, and the share above falls from one to none through the printed shares."""
    (axis,) = figure_14(AOYAMA).axes
    assert sum(bar.get_height() for bar in axis.patches) == pytest.approx(1.0)
    (line,) = axis.get_lines()
    x, y = line.get_xdata(), line.get_ydata()
    assert (y[0], y[-1]) == (1.0, 0.0)
    assert y[np.searchsorted(x, 2.84)] == pytest.approx(0.35)


@pytest.mark.parametrize("reinforced", [False, True])
def test_rate_curves_equal_computed_rates(reinforced):
    """Six curves hold the rate at each PGA; the surveyed rates stand at their PGA."""
    figure = figure_16(AOYAMA, reinforced=reinforced, surveys=SURVEYS)
    (axis,) = figure.axes
    stones = AOYAMA.with_dowels() if reinforced else AOYAMA
    curves = {line.get_label(): line for line in axis.get_lines()}
    assert list(curves) == ["0.5 Hz", "1 Hz", "1.5 Hz", "2 Hz", "2.5 Hz", "3 Hz"]
    for label, line in curves.items():
        for pga, rate in list(zip(line.get_xdata(), line.get_ydata(), strict=True))[4::25]:
            assert rate == overturning_rate(stones, pga / 100.0, float(label.split()[0])).rate
    points = [tuple(scatter.get_offsets()[0]) for scatter in axis.collections]
    assert points == [(pytest.approx(s.pga_gal), pytest.approx(s.rate)) for s in SURVEYS]


def test_survey_points_lie_on_rate_curves():
    """Each survey stands at the rate of the curve, once without and once with dowels."""
    (axis,) = figure_20(AOYAMA).axes
    offsets = [tuple(scatter.get_offsets()[0]) for scatter in axis.collections]
    assert offsets[::2] == [(overturning_rate(AOYAMA, s.pga, s.frequency).rate, s.rate) for s in SURVEYS]


@pytest.mark.parametrize(("compared", "panels"), [(False, 2), (True, 3)])
def test_cemetery_figure_has_stones_curves_and_shaking_point(compared, panels):
    """Stones, curves and the point of a shaking; a further panel where dowels are compared."""
    method, shaking = AssessmentMethod(), Shaking(7.25, 2.75)
    found = assess_cemetery(AOYAMA, shaking, method, reinforced_cemetery=AOYAMA.with_dowels() if compared else None)
    figure = overturn_rate_figure(AOYAMA, [(None, [found])], overturning_curve(AOYAMA, method))
    assert len(figure.axes) == panels
    legend = [text.get_text() for text in figure.axes[-1].get_legend().get_texts()]
    assert legend[-1] == "2.75 Hz"


@pytest.mark.parametrize("criterion", ["furukawa", "simulate"])
def test_shaking_point_lies_within_axes(criterion):
    """However strong the shaking and whatever is drawn beside it, its point lies within the panel."""
    method, shaking = AssessmentMethod(criterion), Shaking(30.0, 2.0)
    found = assess_cemetery(AOYAMA, shaking, method)
    low, high = overturn_rate_figure(AOYAMA, [(None, [found])], ()).axes[1].get_xlim()
    assert low == 0.0
    assert high > 3000.0
