"""Furukawa et al. (2009): the paper's band on the line, the range of the fit, and how the criterion must lean."""

from __future__ import annotations

import numpy as np

from seisblock.criteria.gravestones import DOWELLED, fit_range_warnings, overturning_level, overturning_ratio, predict


def test_threshold_ratio_is_monotone_in_pga_and_frequency():
    """The threshold falls with PGA and climbs with frequency; a dowel raises it."""
    frequencies = np.linspace(0.0, 5.0, 51)
    assert (np.diff(overturning_level(frequencies)) > 0).all()
    assert (overturning_level(frequencies, DOWELLED) > overturning_level(frequencies)).all()
    assert (np.diff(overturning_ratio(np.linspace(1.0, 13.0, 20), 2.0)) < 0).all()


def test_table_5_band_on_the_line_includes_its_ends():
    """|threshold - H/B| <= 0.1 is on the line, to the last bit of 2.6 - 2.5."""
    assert [predict(2.6, t) for t in (2.49, 2.5, 2.6, 2.7, 2.71)] == ["overturns", *["on the line"] * 3, "stands"]


def test_criterion_warns_outside_fitted_range():
    """Each of PGA, frequency and H/B outside its range is one sentence; the ends are inside."""
    assert fit_range_warnings(1.0, 0.5, [1.25, 6.5]) == ()
    assert fit_range_warnings(13.0, 3.0) == ()
    warnings = fit_range_warnings(14.0, 3.2, [1.0, 2.0, 7.0])
    assert len(warnings) == 3
    assert "1400 gal" in warnings[0]
    assert "3.2 Hz" in warnings[1]
    assert "2 of 3 stones" in warnings[2]
