"""How the risk at a site is told: how often, how probably in some years, and which shaking and which branch it comes from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.present.text.fragility import limit_name
from seisblock.present.text.tables import NOTHING, line, number, table
from seisblock.studies.fragility.intensity import IntensityMeasure, intensity_measure
from seisblock.studies.hazard.curve import Hazard
from seisblock.studies.hazard.given import GivenFragility
from seisblock.studies.hazard.risk import Risk, RiskShare
from seisblock.words import listed, noted, roughly, tell

Found = Sequence[tuple[GivenFragility, Risk]]

SMALL = 0.005
"""Shares below are left out of the table, %% that would read 0."""


def tables(found: Found, hazard: Hazard, *, gal: bool) -> Iterator[Any]:
    """Yield what is printed: how often, the table of all, the levels it comes from, and what its standing says.

    Parameters
    ----------
    found : sequence of (GivenFragility, Risk)
    hazard : Hazard
    gal : bool
        Whether intensities are told in gal, kine and cm, else in SI.
    """
    for given, risk in found:
        yield line(verdict(given, risk, gal=gal), "bold")
    yield _rates(found, hazard, gal=gal)
    for given, risk in found:
        name = name_of(given, gal=gal)
        yield _shares(name if len(found) > 1 else "", risk, hazard, gal=gal)
        if len(hazard.branches) > 1 or risk.stood_years is not None:
            yield _branches(name if len(found) > 1 else "", risk)


def name_of(given: GivenFragility, *, gal: bool = True) -> str:
    """Return what happens, and to what; empty where nobody said."""
    return listed(part for part in (tell(given.body), limit_name(given.limit, gal=gal) if given.limit else "") if part)


def verdict(given: GivenFragility, risk: Risk, *, gal: bool = True) -> str:
    """Return how often it happens, in a sentence."""
    name = name_of(given, gal=gal)
    what = f"{name}: " if name else ""
    chance, years = roughly(risk.probability.value), risk.probability.years
    if risk.return_period_years is None:
        return what + tell("it never happens as far as the hazard tells.")
    text = noted("once in {period} years on average; {chance} in {years:g} years.")
    return what + tell(text, period=number(risk.return_period_years, 3), chance=chance, years=years)


def _rates(found: Found, hazard: Hazard, *, gal: bool) -> Any:
    """Return the table of all."""
    measure = intensity_measure(hazard.im)
    size, _ = measure.shown(gal=gal)
    heads = [tell("what"), _head(measure, tell("median"), gal=gal), "beta", tell("rate (1/year)"), tell("once in (years)")]
    rows = [
        [
            name_of(given, gal=gal) or NOTHING,
            number(given.curve.median / size, 3),
            f"{given.curve.beta:.2f}",
            f"{risk.annual_rate:.3g}",
            NOTHING if risk.return_period_years is None else number(risk.return_period_years, 3),
        ]
        for given, risk in found
    ]
    return table("", heads, rows)


def _head(measure: IntensityMeasure, name: str, *, gal: bool) -> str:
    """Return a heading with the measure and its unit."""
    unit = measure.shown(gal=gal)[1]
    return f"{name} {measure.label} ({unit})" if unit else f"{name} {measure.label}"


def _shares(name: str, risk: Risk, hazard: Hazard, *, gal: bool) -> Any:
    """Return which shaking it comes from."""
    measure = intensity_measure(hazard.im)
    size, unit = measure.shown(gal=gal)
    label = f"{measure.label} ({unit})" if unit else measure.label
    shown = [each for each in risk.disaggregation if each.share >= SMALL]
    rows = [[stretch(each, size), f"{each.annual_rate:.3g}", f"{100.0 * each.share:.0f}"] for each in shown]
    return table(name, [label, tell("rate (1/year)"), "%"], rows, caption=tell("which shaking it comes from"))


def stretch(share: RiskShare, size: float) -> str:
    """Return two levels in the unit shown."""
    low, high = (None if end is None else number(end / size, 3) for end in (share.im_from, share.im_to))
    if low is None:
        return tell("below {level}", level=high)
    return tell("from {level}", level=low) if high is None else f"{low} - {high}"


def _branches(name: str, risk: Risk) -> Any:
    """Return what each branch says, and how likely it made what stood."""
    heads = [tell("branch"), tell("weight"), tell("rate (1/year)")]
    rows = [[each.branch or NOTHING, f"{each.weight:.3g}", f"{each.annual_rate:.3g}"] for each in risk.branches]
    caption = ""
    if risk.stood_years is not None:
        heads += [tell("P(stands)"), tell("weight after")]
        for row, each in zip(rows, risk.branches, strict=True):
            row += [f"{each.standing:.3g}", f"{each.weight_after:.3g}"]
        text = noted("P(stands): that it did not happen in {years:g} years; with the weights after, {rate:.3g} a year")
        caption = tell(text, years=risk.stood_years, rate=risk.annual_rate_after)
    return table(name, heads, rows, caption=caption)


def columns(found: Found, hazard: Hazard) -> tuple[list[str], list[Sequence[Any]]]:
    """Return the header and the rows of ``--csv``: what each stretch of intensities contributes."""
    header = ["body", "limit", "im", "unit", "im_from", "im_to", "annual_rate", "share"]
    rows: list[Sequence[Any]] = [
        [given.body, given.limit, hazard.im, hazard.unit, each.im_from, each.im_to, each.annual_rate, each.share]
        for given, risk in found
        for each in risk.disaggregation
    ]
    return header, rows
