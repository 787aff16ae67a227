"""[Furukawa2009]_ table 6: six surveyed rates against each model of a stone."""

import numpy as np
import pytest

from seisblock.report.figures.field_test import STYLES, figure
from seisblock.validation.furukawa_field import CASES, MODELS, SURVEYED_RATES, bias, rates, rms


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_case(case):
    """Rms and bias of each model are those that the default of gravestones rests on."""
    result = case.run()
    assert result.verdict == case.status, f"{case.quantity}: expected {result.expected}, computed {result.computed}"


def test_edge_wear_of_one_tenth_is_least_biased():
    """Edges worn by 0.1 B agree with the survey without bias; sharp ones overturn too few stones, 0.15 B too many."""
    assert min((abs(bias(model.key)), model.key) for model in MODELS)[1] == "worn"
    assert bias("sharp") < -0.1 and bias("half-sine") < -0.1 and bias("worn-more") > 0.15
    assert max(rms("eq-9"), rms("worn")) < min(rms("sharp"), rms("half-sine"), rms("worn-more"))


def test_field_figure_shows_every_model_and_survey():
    """A bar per station with the surveyed rate, a marker per station and model with its rate."""
    fig = figure()
    (axis,) = fig.axes
    assert [bar.get_height() for bar in axis.patches] == SURVEYED_RATES.tolist()
    assert set(STYLES) == {model.key for model in MODELS}
    for model, line in zip(MODELS, axis.lines, strict=True):
        np.testing.assert_array_equal(line.get_ydata(), rates(model.key))
    assert [label.get_text() for label in axis.get_xticklabels()][:2] == ["Hakuta", "Kofu"]
