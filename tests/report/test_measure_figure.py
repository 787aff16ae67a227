"""The figure of a record shows its peaks, whatever the record."""

import numpy as np
import pytest

from seisblock.measures import Conventions, measure
from seisblock.records import Component, Record
from seisblock.report.figures.measure import measure_figure


@pytest.mark.parametrize("codes", [("NS",), ("NS", "EW", "UD")])
def test_measure_figure_has_panels_per_component_and_spectra(codes):
    """Acceleration and velocity of each component, and two spectra."""
    rng = np.random.default_rng(0)
    record = Record([Component(code, rng.standard_normal(500)) for code in codes], 0.01)
    figure = measure_figure(record, measure(record))
    assert len(figure.axes) == 2 * len(codes) + 2
    assert [line.get_label() for line in figure.axes[-1].get_lines()] == list(codes)


def test_measure_figure_draws_single_sample_peak():
    """One sample of 200 000 stands out, and is drawn."""
    a = np.zeros(200_000)
    a[123_457] = -7.0
    record = Record((Component("NS", a),), 0.01)
    figure = measure_figure(record, measure(record), gal=False)
    lowest = min(np.min(line.get_ydata()) for line in figure.axes[0].get_lines())
    longest = max(len(line.get_xdata()) for line in figure.axes[0].get_lines())
    assert lowest == -7.0
    assert longest < 10_000


def test_measure_figure_draws_zero_record():
    """Zeros have no logarithm; the figure is drawn all the same."""
    record = Record((Component("NS", np.zeros(1000)),), 0.01)
    figure = measure_figure(record, measure(record))
    figure.canvas.draw()
    assert figure.axes[-1].get_yscale() == "linear"


def test_measure_figure_names_smoothing_window():
    """The title of the Fourier panel names the window of the answer."""
    record = Record((Component("NS", np.sin(np.arange(2000) * 0.1)),), 0.01)
    figure = measure_figure(record, measure(record, conventions=Conventions(fourier_smoothing_hz=0.5)))
    assert "0.5 Hz" in figure.axes[-2].get_title(loc="left")
