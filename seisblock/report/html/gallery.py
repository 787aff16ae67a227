"""Validation gallery page: published against computed values of every case, by paper."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.output.figures.svg import Picture
from seisblock.output.templating import render_page
from seisblock.references import REFERENCES
from seisblock.report.text.validate import KINDS, explanation, format_short, quantity_label, unit_label, verdict_counts_text
from seisblock.validation.case import EVIDENCE_KINDS, VERDICTS, CaseResult, count_verdicts, count_verdicts_by_kind, sort_by_verdict

_GREEK_NAMES = "alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi pi rho sigma tau phi psi omega"
_GREEK = dict(zip(_GREEK_NAMES.split(), "αβγδεζηθκλμνξπρστφψω", strict=True))
_LETTER = re.compile(rf"(?<![A-Za-z])({'|'.join(_GREEK)})(?![A-Za-z])")
_TIMES_PI = re.compile(r"(?<=\d) (?=π)")
_POWER = re.compile(r"(?<=[\w)\]])\^(-?\d+)(?![\d.])")
_INDEX = re.compile(r"(?<=[A-Za-zα-ω'])_(\d+)(?![\w.])")
_THETA_0 = re.compile(r"(?<=[α-ω])(\d)(?![\w.])")
_SYMBOLS = {"<=": "≤", ">=": "≥", "+/-": "±", "-/+": "∓", "sqrt(": "√("}
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def typeset_formulas(text: str) -> str:
    """Replace names of Greek letters, roots, powers, indices and relations in a text by Unicode characters.

    Examples
    --------
    >>> typeset_formulas("omega_1/omega_V <= sqrt(3), m/s^2"), typeset_formulas("2 pi theta0 of the mu_s that alphabets print, 1e-4 s")
    ('ω₁/ω_V ≤ √(3), m/s²', '2π θ₀ of the μ_s that alphabets print, 1e-4 s')
    """
    for source, symbol in _SYMBOLS.items():
        text = text.replace(source, symbol)
    text = _LETTER.sub(lambda match: _GREEK[match[1]], text)
    text = _TIMES_PI.sub("", text)
    text = _POWER.sub(lambda match: match[1].translate(_SUPERSCRIPTS), text)
    return _THETA_0.sub(lambda match: match[1].translate(_SUBSCRIPTS), _INDEX.sub(lambda match: match[1].translate(_SUBSCRIPTS), text))


FIELD_TEST = "furukawa-field-worn"
"""Prefix of the keys of the field-test cases, whose place gets the field-test figure."""

VERDICT_WORDS = {"holds": N_("agrees"), "differs": N_("differs"), "fails": N_("FAILS")}
COLUMNS = (N_("published"), N_("computed"), N_("error"), N_("tolerance"))
WORD = re.compile(r"\d+|[A-Z]?[^A-Z\d]+|[A-Z]+")
"""A word or the year of a paper key; lines may break between them."""

OVERLAY_SIDE, MARGIN = 240.0, 34.0
"""Side of the overlay figure and margin for its labels, SVG units."""


@dataclass(frozen=True)
class Mark:
    """Tolerance strip of a case: half width of the tolerance, and position of the computed value (or None), SVG units."""

    half: float
    at: float | None


@dataclass(frozen=True)
class Overlay:
    """Plot of computed against published values: points (x, y, agrees), labels of the axis ends, axis labels, caption."""

    points: tuple[tuple[float, float, bool], ...]
    first: str
    last: str
    below: str
    beside: str
    caption: str
    side: float = OVERLAY_SIDE
    margin: float = MARGIN
    span: float = OVERLAY_SIDE - MARGIN - 8.0


def gallery(results: Sequence[CaseResult]) -> str:
    """Return the gallery page: summary, differences with their reasons, then every case with numbers and figure.

    Parameters
    ----------
    results : sequence of CaseResult
        Results of :meth:`Case.run`.
    """
    differing = [result for result in sort_by_verdict(results) if result.verdict != "holds"]
    return render_page(
        "gallery.html",
        gettext("Validation: published and computed values"),
        subtitles=[
            gettext("Computed by seisblock validate on this machine. Tolerance: half the last printed digit, round-off, or as stated.")
        ],
        lead=_summary(results),
        columns=[gettext(name) for name in COLUMNS],
        tiles=[_paper_summary(paper, group) for paper, group in _group_by_paper(results)],
        kinds=_kind_counts(results),
        differing=list(_case_rows(differing, place=True)),
        papers=[_paper_section(paper, group) for paper, group in _group_by_paper(results)],
    )


def _summary(results: Sequence[CaseResult]) -> str:
    """Return the summary sentence of the page."""
    verdict_counts = count_verdicts(results)
    papers = len(list(_group_by_paper(results)))
    statement = N_("1 case") if len(results) == 1 else N_("{count} cases")
    paper = N_("1 paper") if papers == 1 else N_("{count} papers")
    phrases = lazy_gettext(statement, count=len(results)), lazy_gettext(paper, count=papers)
    return gettext(
        "{statements} from {papers}: {verdicts}.", statements=phrases[0], papers=phrases[1], verdicts=verdict_counts_text(verdict_counts)
    )


def anchor(paper: str, place: str) -> str:
    """Return the HTML anchor of a place in a paper.

    Parameters
    ----------
    paper, place : str

    Examples
    --------
    >>> anchor("Fujino1978", "eq. (1) against (5)")
    'Fujino1978-eq-1-against-5'
    """
    return "-".join((paper, *re.findall(r"\w+", place)))


def _group_by_paper(results: Sequence[CaseResult]) -> Iterator[tuple[str, list[CaseResult]]]:
    """Yield each paper with its results."""
    for paper in dict.fromkeys(result.case.paper for result in results):
        yield paper, [result for result in results if result.case.paper == paper]


def _paper_summary(paper: str, results: Sequence[CaseResult]) -> dict[str, Any]:
    verdict_counts = count_verdicts(results)
    level = "bad" if verdict_counts["fails"] else "mild" if verdict_counts["differs"] else ""
    parts = WORD.findall(paper)
    return {
        "paper": paper,
        "parts": parts,
        "level": level,
        "text": verdict_counts_text(verdict_counts),
    }


def _kind_counts(results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return the table of verdict counts by kind of evidence."""
    rows = [
        {
            "name": gettext(KINDS[kind]),
            "worth": gettext(EVIDENCE_KINDS[kind]),
            "counts": [verdict_counts[verdict] for verdict in reversed(VERDICTS)],
        }
        for kind, verdict_counts in count_verdicts_by_kind(results).items()
    ]
    return {"headings": ["", gettext("agree"), gettext("differ"), gettext("fail")], "rows": rows}


def _paper_section(paper: str, results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return the section of one paper, with one part per equation, table or figure."""
    places = dict.fromkeys(result.case.place for result in results)
    return {
        "key": paper,
        "reference": REFERENCES[paper].text() if paper in REFERENCES else "",
        "contents": [(anchor(paper, place), place) for place in places],
        "places": [_place_section(place, [result for result in results if result.case.place == place]) for place in places],
    }


def _place_section(place: str, results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return the part of one equation, table or figure: cases, overlays, largest difference."""
    overlays = [_unit_overlay(unit_name, results) for unit_name in dict.fromkeys(unit_label(result.case) for result in results)]
    return {
        "name": place,
        "anchor": anchor(results[0].case.paper, place),
        "picture": _field_test() if any(result.case.key.startswith(FIELD_TEST) for result in results) else None,
        "overlays": [overlay for overlay in overlays if overlay is not None],
        "rows": list(_case_rows(results)),
        "largest": _largest_difference(results),
    }


def _field_test() -> Picture:
    from seisblock.output.figures.fonts import build_localized
    from seisblock.output.figures.svg import embed_figure
    from seisblock.report.figures.field_test import figure

    caption = gettext("Overturning rates of gravestones around six stations, western Tottori earthquake 2000: survey and models.")
    return embed_figure(build_localized(figure), caption)


def _largest_difference(results: Sequence[CaseResult]) -> str:
    """Return the largest difference of several cases as text."""
    worst = max(results, key=_error_in_tolerances)
    if len(results) == 1:
        return ""
    if not worst.error:
        return gettext("Largest difference: none.")
    size = f"{format_short(worst.error, 3)} {unit_label(worst.case)}".strip()
    if math.isfinite(_error_in_tolerances(worst)):
        size = gettext("{size}, {share:.2g} of its tolerance", size=size, share=_error_in_tolerances(worst))
    return gettext("Largest difference: {size}.", size=f"{size} ({typeset_formulas(gettext(worst.case.quantity))})")


def _error_in_tolerances(result: CaseResult) -> float:
    """Return the absolute error of a case over its tolerance."""
    if math.isnan(result.error):
        return math.inf
    return abs(result.error) / result.case.tolerance if result.case.tolerance else (0.0 if result.error == 0.0 else math.inf)


def _case_rows(results: Sequence[CaseResult], *, place: bool = False) -> Iterator[dict[str, Any]]:
    """Yield one row per case; consecutive cases with the same note show it once, after the last."""
    for index, result in enumerate(results):
        case, note = result.case, explanation(result)
        last = index + 1 == len(results) or explanation(results[index + 1]) != note
        yield {
            "verdict": result.verdict,
            "verdict_text": gettext(VERDICT_WORDS[result.verdict]),
            "kind": gettext(KINDS[case.kind]),
            "status": case.status,
            "statement": typeset_formulas(f"{case.paper} {case.place}: {quantity_label(result)}" if place else quantity_label(result)),
            "numbers": [
                format_short(result.expected, 6),
                format_short(result.computed, 6),
                format_short(result.error, 2),
                format_short(case.tolerance, 2),
            ],
            "strip": _tolerance_mark(result),
            "why": typeset_formulas(
                "" if not (note and last) else gettext("reason: {reason}", reason=note) if result.verdict != "holds" else note
            ),
        }


def _tolerance_mark(result: CaseResult) -> Mark:
    """Return the tolerance strip of a case."""
    half_range = max(2.0 * result.case.tolerance, 1.25 * abs(result.error) if math.isfinite(result.error) else 0.0) or 1.0
    at = None if math.isnan(result.error) else 66 + 60 * result.error / half_range
    return Mark(max(60.0 * result.case.tolerance / half_range, 1.0), at)


def _unit_overlay(unit_name: str, results: Sequence[CaseResult]) -> Overlay | None:
    """Return the overlay of the cases of one unit, None for fewer than four points or equal values."""
    points = [(r.expected, r.computed, r.verdict) for r in results if unit_label(r.case) == unit_name and math.isfinite(r.computed)]
    values = [value for x, y, _ in points for value in (x, y)]
    if len(points) < 4 or max(values) == min(values):
        return None
    margin = 0.06 * (max(values) - min(values))
    low, high = min(values) - margin, max(values) + margin
    inside = f" ({unit_name})" if unit_name else ""

    def at(value: float) -> float:
        return (value - low) / (high - low) * Overlay.span

    return Overlay(
        tuple((MARGIN + at(x), 8 + Overlay.span - at(y), verdict != "differs") for x, y, verdict in points),
        format_short(min(values), 3),
        format_short(max(values), 3),
        gettext("published{unit}", unit=inside),
        gettext("computed{unit}", unit=inside),
        gettext("{count} values. Line: computed = published; hollow: known difference.", count=len(points)),
    )
