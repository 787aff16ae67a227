"""Polar panels over azimuth, and the rose of directions of fall."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from seisblock.core.i18n import gettext
from seisblock.output.figures import style

MAX_RINGS = 4
"""Rings of a polar panel, at most."""

SECTORS = 24
"""Sectors of a rose; the first is centred on north."""

FALL_COLOUR = "#c0504d"


def style_rose(panel: Any, title: str, largest: float, *, origin: str = "") -> None:
    """Style a polar panel: north, or the direction with the label `origin`, up, azimuth clockwise, rings up to the largest value."""
    panel.set_theta_zero_location("N")
    panel.set_theta_direction(-1)
    labels = [origin or "0°", *(f"{azimuth}°" for azimuth in range(45, 360, 45))]
    panel.set_xticks(np.radians(np.arange(0, 360, 45)), labels)
    panel.set_rlabel_position(22.5)
    panel.set_yticks([tick for tick in MaxNLocator(MAX_RINGS).tick_values(0.0, largest) if 0.0 < tick <= largest])
    panel.set_ylim(0.0, 1.1 * largest)
    panel.grid(True, color="0.88", linewidth=0.6)
    panel.spines["polar"].set_color("0.7")
    panel.tick_params(labelsize=style.TICK_LABEL_SIZE - 1)
    for label in panel.get_yticklabels():
        label.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
    style.set_panel_title(panel, title)


def draw_fall_rose(panel: Any, azimuths_deg: Sequence[float], runs: int, *, origin: str = "") -> None:
    """Draw the share of runs that fall into each sector, in percent of all runs.

    Parameters
    ----------
    panel : polar Axes
    azimuths_deg : sequence of float
        Azimuth of each fall, clockwise from north, or from the direction `origin`.
    runs : int
        Number of runs, those that do not fall included.
    origin : str
        Label of the azimuth 0; north by default.
    """
    shares = 100.0 * fall_counts(azimuths_deg) / runs
    width = 2.0 * np.pi / SECTORS
    panel.bar(np.arange(SECTORS) * width, shares, width=0.94 * width, color=FALL_COLOUR, edgecolor="0.3", linewidth=0.4)
    title = gettext("direction of fall (% of {runs} runs; {falls} fall)", runs=runs, falls=len(azimuths_deg))
    style_rose(panel, title, float(shares.max()), origin=origin)


def fall_counts(azimuths_deg: Sequence[float]) -> Any:
    """Return the number of azimuths in each sector, (24,); sectors are centred on multiples of 15 degrees.

    Examples
    --------
    >>> fall_counts([359.0, 3.0, 90.0])[[0, 6]].tolist()
    [2, 1]
    """
    sector = 360.0 / SECTORS
    indices = np.round(np.asarray(azimuths_deg, dtype=np.float64) / sector).astype(np.int64) % SECTORS
    return np.bincount(indices, minlength=SECTORS)
