"""Round numbers mark a logarithmic axis of any position and length."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from seisblock.output.figures.log_ticks import MAX_TICKS, round_ticks


@pytest.mark.parametrize(
    ("low", "high", "names"),
    [
        (5.0, 200.0, ["5", "10", "20", "50", "100", "200"]),
        (270.0, 1090.0, ["300", "500", "700", "1000"]),
        (21.0, 95.0, ["30", "40", "50", "60", "70", "80", "90"]),
        (1e-4, 3e2, ["0.0001", "0.001", "0.01", "0.1", "1", "10", "100"]),
        (41.0, 49.0, ["42", "44", "46", "48"]),
    ],
)
def test_log_ticks_are_round_numbers(low, high, names):
    """As many digits of each decade as there is room for; within one digit even steps; the axis reaches as far as before."""
    axis = Figure().subplots()
    axis.set_xscale("log")
    axis.set_xlim(low, high)
    round_ticks(axis.xaxis)
    assert [xticklabel.get_text() for xticklabel in axis.get_xticklabels()] == names
    assert axis.get_xlim() == (low, high)


def test_log_ticks_number_two_to_seven():
    """Two to seven, over ranges from a hundredth of a decade to five of them."""
    rng = np.random.default_rng(0)
    for _ in range(40):
        axis = Figure().subplots()
        axis.set_yscale("log")
        low = 10.0 ** rng.uniform(-4, 4)
        axis.set_ylim(low, low * 10.0 ** rng.uniform(0.01, 5.0))
        round_ticks(axis.yaxis)
        assert 2 <= len(axis.get_yticks()) <= MAX_TICKS
