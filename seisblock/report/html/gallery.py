"""The gallery: every checked statement of the papers on one page, with computed drawn against expected."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.references import REFERENCES
from seisblock.report.figures.svg import Picture
from seisblock.report.html.formulas import typeset_formulas
from seisblock.report.templating import render_page
from seisblock.report.text.validate import KINDS, explanation, format_short, quantity_label, unit_label, verdict_counts_text
from seisblock.validation.case import EVIDENCE_KINDS, VERDICTS, CaseResult, count_verdicts, count_verdicts_by_kind, sort_by_verdict

FIELD_TEST = "furukawa-field-worn"
"""Beginning of the keys of cases that belong to the figure of the field test, and have computed what it shows."""

VERDICT_WORDS = {"holds": N_("holds"), "differs": N_("differs"), "fails": N_("FAILS")}
COLUMNS = (N_("expected"), N_("computed"), N_("error"), N_("tolerance"))
WORD = re.compile(r"\d+|[A-Z]?[^A-Z\d]+|[A-Z]+")
"""A name or the year of a paper's key, between which a line may end."""

OVERLAY_SIDE, MARGIN = 240.0, 34.0
"""Size of the overlay figure and the room for its labels, in its own units."""


@dataclass(frozen=True)
class Mark:
    """The small drawing of a case: half the width of its tolerance, and where the computed value lies, None for nowhere."""

    half: float
    at: float | None


@dataclass(frozen=True)
class Overlay:
    """Computed against expected: points with whether they agree, the ends of both axes, what stands below, beside and under all."""

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
    """Return the page: a summary, what differs with its reason, then each statement with its numbers and its figure.

    Parameters
    ----------
    results : sequence of CaseResult
        What :meth:`Case.run` gave on this machine.
    """
    differing = [result for result in sort_by_verdict(results) if result.verdict != "holds"]
    return render_page(
        "gallery.html",
        gettext("What the papers print, and what seisblock computes"),
        subtitles=[
            gettext("Computed on this machine by seisblock validate; a tolerance is half the last printed digit, round-off, or stated.")
        ],
        lead=_summary(results),
        columns=[gettext(name) for name in COLUMNS],
        tiles=[_paper_summary(paper, group) for paper, group in _group_by_paper(results)],
        kinds=_kind_counts(results),
        differing=list(_case_rows(differing, place=True)),
        papers=[_paper_section(paper, group) for paper, group in _group_by_paper(results)],
    )


def _summary(results: Sequence[CaseResult]) -> str:
    """Return what the page comes to, in a sentence."""
    verdict_counts = count_verdicts(results)
    papers = len(list(_group_by_paper(results)))
    statement = N_("1 statement") if len(results) == 1 else N_("{count} statements")
    paper = N_("1 paper") if papers == 1 else N_("{count} papers")
    phrases = lazy_gettext(statement, count=len(results)), lazy_gettext(paper, count=papers)
    return gettext(
        "{statements} of {papers}: {verdicts}.", statements=phrases[0], papers=phrases[1], verdicts=verdict_counts_text(verdict_counts)
    )


def anchor(paper: str, place: str) -> str:
    """Return by which name a place of a paper is linked to.

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
    """Return the summary of one paper."""
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
    """Return how many cases of each kind got each verdict: what the evidence is worth."""
    rows = [
        {
            "name": gettext(KINDS[kind]),
            "worth": gettext(EVIDENCE_KINDS[kind]),
            "counts": [verdict_counts[verdict] for verdict in reversed(VERDICTS)],
        }
        for kind, verdict_counts in count_verdicts_by_kind(results).items()
    ]
    return {"headings": ["", gettext("hold"), gettext("differ"), gettext("fail")], "rows": rows}


def _paper_section(paper: str, results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return one paper: its statements equation by equation, table by table, figure by figure."""
    places = dict.fromkeys(result.case.place for result in results)
    return {
        "key": paper,
        "reference": REFERENCES[paper].text() if paper in REFERENCES else "",
        "contents": [(anchor(paper, place), place) for place in places],
        "places": [_place_section(place, [result for result in results if result.case.place == place]) for place in places],
    }


def _place_section(place: str, results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return one equation, table or figure: its statements, its overlays, its largest difference."""
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
    """Return the figure of the field test."""
    from seisblock.report.figures.field_test import figure
    from seisblock.report.figures.fonts import build_localized
    from seisblock.report.figures.svg import embed_figure

    caption = gettext(
        "Rates surveyed around six stations after the western Tottori earthquake of 2000, and those of each model of a stone."
    )
    return embed_figure(build_localized(figure), caption)


def _largest_difference(results: Sequence[CaseResult]) -> str:
    """Return the largest difference of several in words."""
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
    """Return the size of a difference in tolerances."""
    if math.isnan(result.error):
        return math.inf
    return abs(result.error) / result.case.tolerance if result.case.tolerance else (0.0 if result.error == 0.0 else math.inf)


def _case_rows(results: Sequence[CaseResult], *, place: bool = False) -> Iterator[dict[str, Any]]:
    """Yield one row per case; the last of each stretch of the same note carries the note."""
    for index, result in enumerate(results):
        case, note = result.case, explanation(result)
        last = index + 1 == len(results) or explanation(results[index + 1]) != note
        yield {
            "verdict": result.verdict,
            "told": gettext(VERDICT_WORDS[result.verdict]),
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
                "" if not (note and last) else gettext("why: {reason}", reason=note) if result.verdict != "holds" else note
            ),
        }


def _tolerance_mark(result: CaseResult) -> Mark:
    """Return where the computed value lies in the band of the tolerance."""
    half_range = max(2.0 * result.case.tolerance, 1.25 * abs(result.error) if math.isfinite(result.error) else 0.0) or 1.0
    at = None if math.isnan(result.error) else 66 + 60 * result.error / half_range
    return Mark(max(60.0 * result.case.tolerance / half_range, 1.0), at)


def _unit_overlay(unit_name: str, results: Sequence[CaseResult]) -> Overlay | None:
    """Return computed against expected for the cases of one unit, None for fewer than four."""
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
        gettext("expected{unit}", unit=inside),
        gettext("computed{unit}", unit=inside),
        gettext("{count} values of one kind: on the line computed and expected are the same; hollow ones differ.", count=len(points)),
    )
