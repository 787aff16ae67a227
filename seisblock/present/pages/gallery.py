"""The gallery: every checked statement of the papers on one page, with computed drawn against expected."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from seisblock.present.figures.embed import Picture
from seisblock.present.page import page
from seisblock.present.pages.formulas import set_formulas
from seisblock.present.text.validate import KINDS, explanation, quantity, short, unit, verdicts
from seisblock.references import REFERENCES
from seisblock.validation.case import VERDICTS, WORTHS, CaseResult, counts, counts_by_kind, ranked
from seisblock.words import noted, said, tell

FIELD_TEST = "furukawa-field-worn"
"""Beginning of the keys of cases that belong to the figure of the field test, and have computed what it shows."""

WORDS = {"holds": noted("holds"), "differs": noted("differs"), "fails": noted("FAILS")}
COLUMNS = (noted("expected"), noted("computed"), noted("error"), noted("tolerance"))
WORD = re.compile(r"\d+|[A-Z]?[^A-Z\d]+|[A-Z]+")
"""A name or the year of a paper's key, between which a line may end."""

SIDE, MARGIN = 240.0, 34.0
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
    side: float = SIDE
    margin: float = MARGIN
    span: float = SIDE - MARGIN - 8.0


def gallery(results: Sequence[CaseResult]) -> str:
    """Return the page: a summary, what differs with its reason, then each statement with its numbers and its figure.

    Parameters
    ----------
    results : sequence of CaseResult
        What :meth:`Case.run` gave on this machine.
    """
    differing = [result for result in ranked(results) if result.verdict != "holds"]
    return page(
        "gallery.html",
        tell("What the papers print, and what seisblock computes"),
        subtitles=[
            tell("Computed on this machine by seisblock validate; a tolerance is half the last printed digit, round-off, or stated.")
        ],
        lead=_lead(results),
        columns=[tell(name) for name in COLUMNS],
        tiles=[_tile(paper, mine) for paper, mine in _by_paper(results)],
        kinds=_kinds(results),
        differing=list(_rows(differing, place=True)),
        papers=[_paper(paper, mine) for paper, mine in _by_paper(results)],
    )


def _lead(results: Sequence[CaseResult]) -> str:
    """Return what the page comes to, in a sentence."""
    counted = counts(results)
    papers = len(list(_by_paper(results)))
    statement = noted("1 statement") if len(results) == 1 else noted("{count} statements")
    paper = noted("1 paper") if papers == 1 else noted("{count} papers")
    given = said(statement, count=len(results)), said(paper, count=papers)
    return tell("{statements} of {papers}: {verdicts}.", statements=given[0], papers=given[1], verdicts=verdicts(counted))


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


def _by_paper(results: Sequence[CaseResult]) -> Iterator[tuple[str, list[CaseResult]]]:
    """Yield each paper with its results."""
    for paper in dict.fromkeys(result.case.paper for result in results):
        yield paper, [result for result in results if result.case.paper == paper]


def _tile(paper: str, results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return the summary of one paper."""
    counted = counts(results)
    level = "bad" if counted["fails"] else "mild" if counted["differs"] else ""
    parts = WORD.findall(paper)
    return {
        "paper": paper,
        "parts": parts,
        "level": level,
        "text": verdicts(counted),
    }


def _kinds(results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return how many cases of each kind got each verdict: what the evidence is worth."""
    rows = [
        {"name": tell(KINDS[kind]), "worth": tell(WORTHS[kind]), "counts": [counted[verdict] for verdict in reversed(VERDICTS)]}
        for kind, counted in counts_by_kind(results).items()
    ]
    return {"headings": ["", tell("hold"), tell("differ"), tell("fail")], "rows": rows}


def _paper(paper: str, results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return one paper: its statements equation by equation, table by table, figure by figure."""
    places = dict.fromkeys(result.case.place for result in results)
    return {
        "key": paper,
        "reference": REFERENCES[paper].text() if paper in REFERENCES else "",
        "contents": [(anchor(paper, place), place) for place in places],
        "places": [_place(place, [result for result in results if result.case.place == place]) for place in places],
    }


def _place(place: str, results: Sequence[CaseResult]) -> dict[str, Any]:
    """Return one equation, table or figure: its statements, its overlays, its largest difference."""
    overlays = [_overlay(each, results) for each in dict.fromkeys(unit(result.case) for result in results)]
    return {
        "name": place,
        "anchor": anchor(results[0].case.paper, place),
        "picture": _field_test() if any(result.case.key.startswith(FIELD_TEST) for result in results) else None,
        "overlays": [overlay for overlay in overlays if overlay is not None],
        "rows": list(_rows(results)),
        "largest": _largest(results),
    }


def _field_test() -> Picture:
    """Return the figure of the field test."""
    from seisblock.present.figures.embed import picture
    from seisblock.present.figures.field_test import figure
    from seisblock.present.figures.fonts import drawn

    caption = tell("Rates surveyed around six stations after the western Tottori earthquake of 2000, and those of each model of a stone.")
    return picture(drawn(figure), caption)


def _largest(results: Sequence[CaseResult]) -> str:
    """Return the largest difference of several in words."""
    worst = max(results, key=_tolerances)
    if len(results) == 1:
        return ""
    if not worst.error:
        return tell("Largest difference: none.")
    size = f"{short(worst.error, 3)} {unit(worst.case)}".strip()
    if math.isfinite(_tolerances(worst)):
        size = tell("{size}, {share:.2g} of its tolerance", size=size, share=_tolerances(worst))
    return tell("Largest difference: {size}.", size=f"{size} ({set_formulas(tell(worst.case.quantity))})")


def _tolerances(result: CaseResult) -> float:
    """Return the size of a difference in tolerances."""
    if math.isnan(result.error):
        return math.inf
    return abs(result.error) / result.case.tolerance if result.case.tolerance else (0.0 if result.error == 0.0 else math.inf)


def _rows(results: Sequence[CaseResult], *, place: bool = False) -> Iterator[dict[str, Any]]:
    """Yield one row per case; the last of each stretch of the same note carries the note."""
    for index, result in enumerate(results):
        case, note = result.case, explanation(result)
        last = index + 1 == len(results) or explanation(results[index + 1]) != note
        yield {
            "verdict": result.verdict,
            "told": tell(WORDS[result.verdict]),
            "kind": tell(KINDS[case.kind]),
            "status": case.status,
            "statement": set_formulas(f"{case.paper} {case.place}: {quantity(result)}" if place else quantity(result)),
            "numbers": [short(result.expected, 6), short(result.computed, 6), short(result.error, 2), short(case.tolerance, 2)],
            "strip": _mark(result),
            "why": set_formulas("" if not (note and last) else tell("why: {reason}", reason=note) if result.verdict != "holds" else note),
        }


def _mark(result: CaseResult) -> Mark:
    """Return where the computed value lies in the band of the tolerance."""
    reach = max(2.0 * result.case.tolerance, 1.25 * abs(result.error) if math.isfinite(result.error) else 0.0) or 1.0
    at = None if math.isnan(result.error) else 66 + 60 * result.error / reach
    return Mark(max(60.0 * result.case.tolerance / reach, 1.0), at)


def _overlay(named: str, results: Sequence[CaseResult]) -> Overlay | None:
    """Return computed against expected for the cases of one unit, None for fewer than four."""
    points = [(r.expected, r.computed, r.verdict) for r in results if unit(r.case) == named and math.isfinite(r.computed)]
    values = [value for x, y, _ in points for value in (x, y)]
    if len(points) < 4 or max(values) == min(values):
        return None
    margin = 0.06 * (max(values) - min(values))
    low, high = min(values) - margin, max(values) + margin
    inside = f" ({named})" if named else ""

    def at(value: float) -> float:
        return (value - low) / (high - low) * Overlay.span

    return Overlay(
        tuple((MARGIN + at(x), 8 + Overlay.span - at(y), verdict != "differs") for x, y, verdict in points),
        short(min(values), 3),
        short(max(values), 3),
        tell("expected{unit}", unit=inside),
        tell("computed{unit}", unit=inside),
        tell("{count} values of one kind: on the line computed and expected are the same; hollow ones differ.", count=len(points)),
    )
