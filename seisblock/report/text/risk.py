"""Text report of the risk at a site: return period, probability, disaggregation and branches."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, format_share, gettext, join_list
from seisblock.output.text.tables import DASH, format_number, format_range, styled_line, table
from seisblock.report.text.fragility import limit_label, measure_label
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.fragility.io import FragilityCurve
from seisblock.studies.hazard.curve import Hazard
from seisblock.studies.hazard.risk import Risk, RiskShare

Risks = Sequence[tuple[FragilityCurve, Risk]]

MIN_SHARE = 0.005
"""Smallest share in the disaggregation table; smaller ones would read 0 %."""


def tables(risks: Risks, hazard: Hazard, *, gal: bool) -> Iterator[Any]:
    """Yield the return periods, the table of rates, the disaggregation and the hazard branches.

    Parameters
    ----------
    risks : sequence of (FragilityCurve, Risk)
    hazard : Hazard
    gal : bool
        Intensities in gal, kine and cm; otherwise SI.
    """
    for fragility, risk in risks:
        yield styled_line(verdict(fragility, risk, gal=gal), "bold")
    yield _rate_table(risks, hazard, gal=gal)
    for fragility, risk in risks:
        name = risk_label(fragility, gal=gal)
        yield _disaggregation_table(name if len(risks) > 1 else "", risk, hazard, gal=gal)
        if len(hazard.branches) > 1 or risk.stood_years is not None:
            yield _branch_table(name if len(risks) > 1 else "", risk)


def risk_label(fragility: FragilityCurve, *, gal: bool = True) -> str:
    """Return body and limit state; empty if unnamed."""
    return join_list(part for part in (gettext(fragility.body), limit_label(fragility.limit, gal=gal) if fragility.limit else "") if part)


def verdict(fragility: FragilityCurve, risk: Risk, *, gal: bool = True) -> str:
    """Return a sentence on return period and probability."""
    name = risk_label(fragility, gal=gal)
    prefix = f"{name}: " if name else ""
    probability, years = format_share(risk.probability.value), risk.probability.years
    if risk.return_period_years is None:
        return prefix + gettext("annual rate 0 within the range of the hazard.")
    text = N_("return period {period} years; probability in {years:g} years {chance}.")
    return prefix + gettext(text, period=format_number(risk.return_period_years, 3), chance=probability, years=years)


def _rate_table(risks: Risks, hazard: Hazard, *, gal: bool) -> Any:
    measure = intensity_measure(hazard.im)
    size, _ = measure.display_unit(gal=gal)
    header = [
        gettext("limit state"),
        f"{gettext('median')} {measure_label(measure, gal=gal)}",
        "beta",
        gettext("rate (1/year)"),
        gettext("return period (years)"),
    ]
    rows = [
        [
            risk_label(fragility, gal=gal),
            format_number(fragility.curve.median / size, 3),
            f"{fragility.curve.beta:.2f}",
            f"{risk.annual_rate:.3g}",
            DASH if risk.return_period_years is None else format_number(risk.return_period_years, 3),
        ]
        for fragility, risk in risks
    ]
    # a curve of --median has no name
    start = 0 if any(risk_label(fragility, gal=gal) for fragility, _ in risks) else 1
    return table("", header[start:], [row[start:] for row in rows])


def _disaggregation_table(name: str, risk: Risk, hazard: Hazard, *, gal: bool) -> Any:
    """Return the table of contributions by intensity."""
    measure = intensity_measure(hazard.im)
    size, label = measure.display_unit(gal=gal)[0], measure_label(measure, gal=gal)
    shares = [item for item in risk.disaggregation if item.share >= MIN_SHARE]
    rows = [[interval_text(item, size), f"{item.annual_rate:.3g}", f"{100.0 * item.share:.0f}"] for item in shares]
    return table(name, [label, gettext("rate (1/year)"), "%"], rows, caption=gettext("disaggregation by intensity"))


def interval_text(share: RiskShare, size: float) -> str:
    """Return an intensity interval in the displayed unit."""
    low, high = (None if end is None else format_number(end / size, 3) for end in (share.im_from, share.im_to))
    if low is None:
        return gettext("below {level}", level=high)
    return gettext("{level} and above", level=low) if high is None else format_range(low, high)


def _branch_table(name: str, risk: Risk) -> Any:
    """Return the table of hazard branches with their weights before and after the observation."""
    header = [gettext("branch"), gettext("weight"), gettext("rate (1/year)")]
    rows = [[branch.branch or DASH, f"{branch.weight:.3g}", f"{branch.annual_rate:.3g}"] for branch in risk.branches]
    caption = ""
    if risk.stood_years is not None:
        header += [gettext("P(none)"), gettext("posterior")]
        for row, branch in zip(rows, risk.branches, strict=True):
            row += [f"{branch.standing:.3g}", f"{branch.weight_after:.3g}"]
        text = N_("P(none): probability of no event in {years:g} years; annual rate with the posterior weights {rate:.3g}")
        caption = gettext(text, years=risk.stood_years, rate=risk.annual_rate_after)
    return table(name, header, rows, caption=caption)


def csv_columns(risks: Risks, hazard: Hazard) -> tuple[list[str], list[Sequence[Any]]]:
    """Return header and rows of ``--csv``: contribution of each intensity interval."""
    header = ["body", "limit", "im", "unit", "im_from", "im_to", "annual_rate", "share"]
    rows: list[Sequence[Any]] = [
        [fragility.body, fragility.limit, hazard.im, hazard.unit, share.im_from, share.im_to, share.annual_rate, share.share]
        for fragility, risk in risks
        for share in risk.disaggregation
    ]
    return header, rows
