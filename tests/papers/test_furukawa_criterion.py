"""[Furukawa2009]_ section 3: the overturning criterion of gravestones and its inverses."""

import numpy as np
import pytest

from seisblock.core.errors import ParameterError
from seisblock.criteria.gravestones import (
    DOWELLED,
    PLAIN,
    GravestoneFit,
    overturning_frequency,
    overturning_level,
    overturning_pga,
    overturning_ratio,
)

EXACT = 1e-12


def test_equation_9_in_gal():
    """Eq. (9): H/B = 826.8 sqrt(1 + (f/1.92)^4.6)/PGA, both in gal."""
    f, pga = np.array([0.0, 1.0, 2.2]), np.array([300.0, 553.0, 894.0])
    printed = 826.8 * np.sqrt(1 + (f / 1.92) ** 4.6) / pga
    np.testing.assert_allclose(overturning_ratio(pga / 100, f), printed, rtol=EXACT)


def test_equation_10_in_gal():
    """Eq. (10): the dowelled stone has p = 1162.9 gal, q = 1.84 Hz, r = 4.5."""
    assert float(overturning_level(2.2, DOWELLED)) * 100 == pytest.approx(1162.9 * np.sqrt(1 + (2.2 / 1.84) ** 4.5), rel=EXACT)


@pytest.mark.parametrize("fit", [PLAIN, DOWELLED, GravestoneFit(13.629, 1.84, 4.5)])
def test_inverses_recover_input(fit):
    """PGA, frequency and H/B follow from each other."""
    f, pga = np.meshgrid([0.5, 1.5, 3.0], [3.0, 9.0])
    ratio = overturning_ratio(pga, f, fit)
    np.testing.assert_allclose(overturning_pga(ratio, f, fit), pga, rtol=EXACT)
    np.testing.assert_allclose(overturning_frequency(pga, ratio, fit), f, rtol=1e-11)


def test_no_frequency_overturns_below_the_static_level():
    """Below PGA times H/B = p no frequency overturns: NaN, not an error."""
    assert np.isnan(overturning_frequency(2.0, 4.0))


NOT_POSITIVE, NEGATIVE = "must be positive", "frequency must be zero or more"


@pytest.mark.parametrize(
    ("pga", "frequency", "message"), [(0.0, 1.0, NOT_POSITIVE), (-1.0, 1.0, NOT_POSITIVE), (3.0, -1.0, NEGATIVE), (3.0, np.nan, NEGATIVE)]
)
def test_criterion_rejects_invalid_input(pga, frequency, message):
    """PGA must be positive, the frequency not negative."""
    with pytest.raises(ParameterError, match=message):
        overturning_ratio(pga, frequency)


@pytest.mark.parametrize("value", [0.0, -1.0, np.inf])
def test_parameters_must_be_positive(value):
    """The fit refuses p, q, r that are not positive."""
    with pytest.raises(ParameterError, match="q_hz"):
        GravestoneFit(8.0, value, 4.6)
