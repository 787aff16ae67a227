"""How harmonic uplift is told: modes, minima and the curve, as tables, document and file."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from seisblock.present.documents.uplift import RATIOS
from seisblock.present.files import write_table
from seisblock.present.text.tables import line, table
from seisblock.studies.uplift_regions import UpliftRegion
from seisblock.words import noted, tell

SYMBOLS = {"alpha": "α", "gamma": "γ", "beta": "β", "damping": "h", "phi": "φ", "rho": "ρ"}
UNITS = {"phi": "°", "rho": "°"}
END = noted("end of the range")
MOST_ROWS = 24
"""Rows of a curve that a terminal shows unless the frequencies were asked for."""


def title(region: UpliftRegion, names: Sequence[str] = tuple(SYMBOLS)) -> str:
    """Return the parameters of a region in the paper's letters."""
    return ", ".join(f"{SYMBOLS[name]} = {region.ratios[name]:.4g}{UNITS.get(name, '')}" for name in names)


def varied_names(regions: Sequence[UpliftRegion]) -> list[str]:
    """Return the names of the parameters that differ among regions."""
    return [name for name in SYMBOLS if len({region.ratios[name] for region in regions}) > 1]


def tables(regions: Sequence[UpliftRegion], *, every: bool) -> Iterator[Any]:
    """Yield the modes, the minima and the curve of each region."""
    for region in regions:
        yield line(verdict(region), "bold")
        wv, w1 = region.body.omega[2], region.modes.omega_1
        yield table(
            tell("natural modes"),
            [tell("mode"), "f (Hz)", "ω/ω_V", "ω/ω_1"],
            [
                [tell(name), w / (2 * math.pi), w / wv, w / w1]
                for name, w in zip(region.modes.names, region.modes.omega.tolist(), strict=True)
            ],
        )
        yield table(
            tell("least A/g that lifts a corner"),
            [tell("near the mode"), "θ/ω_1", "A/g", tell("corner")],
            [[tell(m.mode or END), m.frequency_ratio, m.acceleration_ratio, _corners(m.corners)] for m in region.minima]
            or [[tell(END), region.minimum.frequency_ratio, region.minimum.acceleration_ratio, _corners(region.minimum.corners)]],
        )
        n = region.frequency_ratio.size
        step = 1 if every or n <= MOST_ROWS else n // MOST_ROWS
        shown = range(step - 1, n, step)
        yield table(
            tell("uplift curve"),
            ["θ/ω_1", "A/g"],
            [[f"{region.frequency_ratio[i]:.4g}", _finite(float(region.acceleration_ratio[i]))] for i in shown],
            caption="" if step == 1 else tell("one of {step} of {all} rows; all with --csv or --json", step=step, all=n),
        )


def verdict(region: UpliftRegion) -> str:
    """Return how hard the shaking must be that lifts a corner, and where it is easiest."""
    least = region.minimum
    if not math.isfinite(least.acceleration_ratio):
        return tell("{block}: no shaking lifts a corner.", block=title(region))
    text = noted("{block}: a corner lifts from {least:.3g} g on, at {ratio:.3g} times the first rocking frequency.")
    return tell(text, block=title(region), least=least.acceleration_ratio, ratio=least.frequency_ratio)


def _finite(value: float) -> Any:
    """Return a number, or nothing when no amplitude lifts."""
    return value if math.isfinite(value) else None


def _corners(corners: Sequence[int]) -> str:
    """Return corners as text."""
    return tell("any") if len(corners) == 4 else " ".join(str(corner) for corner in corners)


def write(path: Path, regions: Sequence[UpliftRegion]) -> None:
    """Write the curves as CSV, one below the other."""
    write_table(
        path,
        [*RATIOS.values(), "frequency_ratio", "acceleration_ratio"],
        (
            [*region.ratios.values(), float(r), float(a)]
            for region in regions
            for r, a in zip(region.frequency_ratio, region.acceleration_ratio, strict=True)
        ),
    )
