"""Text report of harmonic uplift: modes, minima and the uplift curve."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.output.io.history_csv import CsvTable
from seisblock.output.text.tables import Part, details, styled_line, table
from seisblock.report.json.uplift import RATIO_KEYS
from seisblock.studies.uplift_regions import UpliftRegion

SYMBOLS = {"alpha": "α", "gamma": "γ", "beta": "β", "damping": "h", "phi": "φ", "rho": "ρ"}
UNITS = {"phi": "°", "rho": "°"}
RANGE_END = N_("end of the range")
MAX_ROWS = 24
"""Most rows of a curve on the terminal, unless frequencies are given."""
SHORT_ROWS = 12
"""Most rows of the curve of a single region in the shortened answer; several curves are details."""


def region_title(region: UpliftRegion, names: Sequence[str] = tuple(SYMBOLS)) -> str:
    """Return the parameters of a region in the notation of the paper."""
    return ", ".join(f"{SYMBOLS[name]} = {region.ratios[name]:.4g}{UNITS.get(name, '')}" for name in names)


def varied_names(regions: Sequence[UpliftRegion]) -> list[str]:
    """Return the names of the parameters that differ among regions."""
    return [name for name in SYMBOLS if len({region.ratios[name] for region in regions}) > 1]


def tables(regions: Sequence[UpliftRegion], *, all_rows: bool) -> Iterator[Any]:
    """Yield modes, minima and curve of each region."""
    for region in regions:
        yield styled_line(verdict(region), "bold")
        wv, w1 = region.body.omega[2], region.modes.omega_1
        yield details(
            table(
                gettext("natural modes"),
                [gettext("mode"), "f (Hz)", "ω/ω_V", "ω/ω_1"],
                [
                    [gettext(name), w / (2 * math.pi), w / wv, w / w1]
                    for name, w in zip(region.modes.names, region.modes.omega.tolist(), strict=True)
                ],
            )
        )
        yield table(
            gettext("smallest A/g with uplift"),
            [gettext("near mode"), "θ/ω_1", "A/g", gettext("corner")],
            [[gettext(m.mode or RANGE_END), m.frequency_ratio, m.acceleration_ratio, _corner_text(m.corners)] for m in region.minima]
            or [
                [
                    gettext(RANGE_END),
                    region.minimum.frequency_ratio,
                    region.minimum.acceleration_ratio,
                    _corner_text(region.minimum.corners),
                ]
            ],
        )
        full = _curve_table(region, region.frequency_ratio.size if all_rows else MAX_ROWS)
        yield full if all_rows else Part((full,), (_curve_table(region, SHORT_ROWS),) if len(regions) == 1 else ())


def _curve_table(region: UpliftRegion, max_rows: int) -> Any:
    """Return the table of a curve, of at most `max_rows` or a few more evenly spaced rows."""
    n = region.frequency_ratio.size
    step = max(n // max_rows, 1)
    return table(
        gettext("uplift curve"),
        ["θ/ω_1", "A/g"],
        [[f"{region.frequency_ratio[i]:.4g}", _finite_or_none(float(region.acceleration_ratio[i]))] for i in range(step - 1, n, step)],
        caption="" if step == 1 else gettext("every {step}th of {all} rows; all with --csv or --json", step=step, all=n),
    )


def verdict(region: UpliftRegion) -> str:
    """Return the smallest amplitude with uplift and its frequency."""
    minimum = region.minimum
    if not math.isfinite(minimum.acceleration_ratio):
        return gettext("{block}: no uplift at any amplitude.", block=region_title(region))
    text = N_("{block}: uplift from {least:.3g} g at {ratio:.3g} times the first rocking frequency.")
    return gettext(text, block=region_title(region), least=minimum.acceleration_ratio, ratio=minimum.frequency_ratio)


def _finite_or_none(value: float) -> Any:
    return value if math.isfinite(value) else None


def _corner_text(corners: Sequence[int]) -> str:
    return gettext("any") if len(corners) == 4 else " ".join(str(corner) for corner in corners)


def csv_columns(regions: Sequence[UpliftRegion]) -> CsvTable:
    """Return the curves, one below the other."""
    rows = (
        [*region.ratios.values(), float(r), float(a)]
        for region in regions
        for r, a in zip(region.frequency_ratio, region.acceleration_ratio, strict=True)
    )
    return [*RATIO_KEYS.values(), "frequency_ratio", "acceleration_ratio"], rows
