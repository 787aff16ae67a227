"""The figure of inferred shaking draws what the numbers beside it say."""

import numpy as np
import pytest

from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.core.units import GAL
from seisblock.report.figures.infer import estimate_figure
from seisblock.studies.survey.assumptions import Assumptions
from seisblock.studies.survey.estimate import estimate_shaking
from seisblock.studies.survey.likelihood import counted_survey
from tests.lengths import all_but_slow


@pytest.mark.parametrize("bias", all_but_slow([0.0, 0.33], {0.0}))
def test_likelihood_curve_includes_requested_bias(bias):
    """The maximum of the curve is at the estimate."""
    rules = Assumptions(bias=bias, frequency_error=0.0)
    survey = counted_survey(read_cemetery("aoyama.csv"), 35, 100)
    estimate = estimate_shaking(survey, 2.0, rules)
    figure = estimate_figure("Aoyama", survey, rules, [estimate])
    (curve,) = figure.axes[-1].lines
    top = curve.get_xdata()[np.argmax(curve.get_ydata())]
    assert top == pytest.approx(estimate.pga_m_s2 / GAL, rel=0.05)
