"""The figures of cemeteries show what the studies compute ([Furukawa2009]_ figs. 14 to 20)."""

from __future__ import annotations

import pytest

from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.report.figures.cemetery import overturn_rate_figure
from seisblock.studies.survey.assessment import AssessmentMethod, assess_cemetery, overturning_curve
from seisblock.studies.survey.shaking import Shaking

AOYAMA = read_cemetery("aoyama.csv")


@pytest.mark.parametrize(("compared", "panels"), [(False, 2), (True, 3)])
def test_cemetery_figure_has_stones_curves_and_shaking_point(compared, panels):
    """Stones, curves and the point of a shaking; a further panel where dowels are compared."""
    method, shaking = AssessmentMethod(), Shaking(7.25, 2.75)
    cemetery = assess_cemetery(AOYAMA, shaking, method, reinforced_cemetery=AOYAMA.with_dowels() if compared else None)
    figure = overturn_rate_figure(AOYAMA, [(None, [cemetery])], overturning_curve(AOYAMA, method))
    assert len(figure.axes) == panels
    legend = [text.get_text() for text in figure.axes[-1].get_legend().get_texts()]
    assert legend[-1] == "2.75 Hz"


@pytest.mark.parametrize("criterion", ["furukawa", "simulate"])
def test_shaking_point_lies_within_axes(criterion):
    """The point of the record is inside the panel for any strength of shaking."""
    method, shaking = AssessmentMethod(criterion), Shaking(30.0, 2.0)
    cemetery = assess_cemetery(AOYAMA, shaking, method)
    low, high = overturn_rate_figure(AOYAMA, [(None, [cemetery])], ()).axes[1].get_xlim()
    assert low == 0.0
    assert high > 3000.0
