"""The gallery: every checked statement of the papers on one page, with computed drawn against expected."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from html import escape

from seisblock.present.page import page
from seisblock.present.text.validate import KINDS, explanation, quantity, short
from seisblock.references import REFERENCES
from seisblock.validation.case import VERDICTS, WORTHS, CaseResult, counts, counts_by_kind, ranked

STYLE = """
td.text { min-width: 14rem; } td.strip { width: 11rem; padding: .15rem 0; } td.strip svg { width: 11rem; height: 1.5rem; display: block; }
.fails td { background: #fbe9e7; } .tag { font-size: .8rem; font-weight: 600; white-space: nowrap; }
.holds .tag { color: var(--good); } .differs .tag { color: #a86a00; } .fails .tag { color: var(--accent); }
.verdicts b { overflow-wrap: anywhere; }
.kind { font-size: .78rem; color: var(--soft); white-space: nowrap; }
.plots { display: flex; flex-wrap: wrap; gap: .5rem 1.5rem; } .plots svg { width: 17rem; height: auto; }
.legend svg { width: 3.2rem; height: 1.2rem; vertical-align: middle; }
tr.why td { text-align: left; color: var(--soft); font-size: .88rem; padding-left: .8rem; border-left: 3px solid var(--line); }
tr.why.differs td { border-left-color: #d9a441; }
@media (max-width: 48rem) {
  table.cases, .cases tbody, .cases tr, .cases td { display: block; width: auto; } .cases thead { display: none; }
  .cases td { text-align: left; border: 0; padding: .05rem 0; } .cases tr { border-bottom: 1px solid var(--line); padding: .45rem 0; }
  .cases td[data-name]::before { content: attr(data-name) " "; color: var(--soft); font-size: .84rem; display: inline-block; }
  .cases td[data-name]::before { min-width: 6rem; }
  .cases td.text { font-weight: 600; }
}
"""

BAND, ACCENT = "#d9dde1", "#c0392b"
RING = '<circle cx="66" cy="9" r="5" fill="none" stroke="#444" stroke-width="1.3"/>'

FIELD_TEST = "furukawa-field-worn"
"""Beginning of the keys of cases that belong to the figure of the field test, and have computed what it shows."""

WORDS = {"holds": "holds", "differs": "differs", "fails": "FAILS"}
SIDE, MARGIN = 240.0, 34.0
"""Size of the overlay figure and the room for its labels, in its own units."""


def gallery(results: Sequence[CaseResult]) -> str:
    """Return the page: a summary, what differs with its reason, then each statement with its numbers and its figure.

    Parameters
    ----------
    results : sequence of CaseResult
        What :meth:`Case.run` gave on this machine.
    """
    origin = "Computed on this machine by seisblock validate; a tolerance is half the last printed digit, round-off, or stated."
    return page("What the papers print, and what seisblock computes", _parts(results), style=STYLE, subtitle=origin)


def _parts(results: Sequence[CaseResult]) -> Iterator[str]:
    """Yield the page from top to bottom."""
    yield _summary(results)
    yield _kinds(results)
    yield _legend()
    differing = [r for r in ranked(results) if r.verdict != "holds"]
    if differing:
        yield "<h2>What differs from the papers, and why</h2>"
        yield _table(differing, place=True)
    for paper in dict.fromkeys(result.case.paper for result in results):
        mine = [result for result in results if result.case.paper == paper]
        yield f'<h2 id="{escape(paper)}">{escape(paper)}</h2>'
        if paper in REFERENCES:
            yield f'<p class="soft">{escape(REFERENCES[paper].text())}</p>'
        for place in dict.fromkeys(result.case.place for result in mine):
            yield from _group(place, [result for result in mine if result.case.place == place])


def _summary(results: Sequence[CaseResult]) -> str:
    """Return one tile for each paper."""
    tiles = []
    for paper in dict.fromkeys(result.case.paper for result in results):
        counted = counts([result for result in results if result.case.paper == paper])
        kind = "bad" if counted["fails"] else "mild" if counted["differs"] else ""
        told = f"{counted['holds']} hold, {counted['differs']} differ as explained, {counted['fails']} fail"
        tiles.append(f'<div class="{kind}"><b><a href="#{escape(paper)}">{escape(paper)}</a></b><span>{told}</span></div>')
    return f'<div class="verdicts">{"".join(tiles)}</div>'


def _kinds(results: Sequence[CaseResult]) -> str:
    """Return how many cases of each kind got each verdict: what the evidence is worth."""
    rows = "".join(
        f'<tr><td class="text"><b>{escape(KINDS[kind])}</b>: {escape(WORTHS[kind])}</td>'
        + "".join(f"<td>{counted[verdict]}</td>" for verdict in reversed(VERDICTS))
        + "</tr>"
        for kind, counted in counts_by_kind(results).items()
    )
    head = "".join(f"<th>{name}</th>" for name in ("", "hold", "differ", "fail"))
    return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


def _field_test() -> str:
    """Return the figure of the field test."""
    from seisblock.present.figures.embed import picture
    from seisblock.present.figures.field_test import figure
    from seisblock.present.figures.fonts import drawn

    caption = "Rates surveyed around six stations after the western Tottori earthquake of 2000, and those of each model of a stone."
    return picture(drawn(figure), caption)


def _legend() -> str:
    """Return what the marks mean."""
    ring = f'<svg viewBox="42 0 48 18"><rect x="52" y="3" width="28" height="12" fill="{BAND}"/>{RING}</svg>'
    dot = f'<svg viewBox="0 0 48 18"><circle cx="24" cy="9" r="3.2" fill="{ACCENT}"/></svg>'
    return f'<p class="legend soft">{ring} expected, and its tolerance &nbsp; {dot} computed</p>'


def _group(place: str, results: Sequence[CaseResult]) -> Iterator[str]:
    """Yield one equation, table or figure: its statements, its overlay, its largest difference."""
    worst = max(results, key=_tolerances)
    yield f"<h3>{escape(place)}</h3>"
    if any(result.case.key.startswith(FIELD_TEST) for result in results):
        yield _field_test()
    drawings = [_overlay(unit, results) for unit in dict.fromkeys(result.case.unit for result in results)]
    if any(drawings):
        yield f'<div class="plots">{"".join(drawings)}</div>'
    yield _table(results)
    size = _tolerances(worst)
    told = "none" if worst.error == 0.0 else f"{short(worst.error, 3)} {worst.case.unit if worst.case.unit != '1' else ''}".strip()
    share = f", {size:.2g} of its tolerance" if math.isfinite(size) and worst.error else ""
    which = f" ({worst.case.quantity})" if len(results) > 1 and worst.error else ""
    yield f'<p class="soft">Largest difference: {escape(told + share + which)}.</p>'


def _tolerances(result: CaseResult) -> float:
    """Return the size of a difference in tolerances."""
    if math.isnan(result.error):
        return math.inf
    return abs(result.error) / result.case.tolerance if result.case.tolerance else (0.0 if result.error == 0.0 else math.inf)


def _table(results: Sequence[CaseResult], *, place: bool = False) -> str:
    """Return one row per case, and below each stretch of the same note the note."""
    rows = []
    for index, result in enumerate(results):
        rows.append(_row(result, place=place))
        told = explanation(result)
        if told and (index + 1 == len(results) or explanation(results[index + 1]) != told):
            label = "why: " if result.verdict != "holds" else ""
            rows.append(f'<tr class="why {result.case.status}"><td colspan="7">{label}{escape(told)}</td></tr>')
    names = ("", "expected", "computed", "error", "tolerance", "", "")
    head = "".join(f"<th>{name}</th>" for name in names)
    return f'<table class="cases"><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}</tbody></table>'


def _row(result: CaseResult, *, place: bool) -> str:
    """Return the row of one case."""
    case = result.case
    statement = f"{result.case.paper} {result.case.place}: {quantity(result)}" if place else quantity(result)
    numbers = {"expected": short(result.expected, 6), "computed": short(result.computed, 6)}
    numbers |= {"error": short(result.error, 2), "tolerance": short(case.tolerance, 2)}
    cells = "".join(f'<td data-name="{name}">{text}</td>' for name, text in numbers.items())
    tag = f'<td><span class="tag">{WORDS[result.verdict]}</span> <span class="kind">{KINDS[case.kind]}</span></td>'
    return f'<tr class="{result.verdict}"><td class="text">{escape(statement)}</td>{cells}<td class="strip">{_strip(result)}</td>{tag}</tr>'


def _strip(result: CaseResult) -> str:
    """Return a small drawing: the tolerance as a band about the expected value, and where the computed value lies."""
    reach = max(2.0 * result.case.tolerance, 1.25 * abs(result.error) if math.isfinite(result.error) else 0.0)
    if reach == 0.0:
        reach = 1.0
    half = max(60.0 * result.case.tolerance / reach, 1.0)
    band = f'<rect x="{66 - half:.1f}" y="3" width="{2 * half:.1f}" height="12" fill="{BAND}"/>'
    line = '<line x1="2" x2="130" y1="9" y2="9" stroke="#c3c8cd"/>'
    dot = "" if math.isnan(result.error) else f'<circle cx="{66 + 60 * result.error / reach:.1f}" cy="9" r="3.2" fill="{ACCENT}"/>'
    return f'<svg viewBox="0 0 132 18" role="img" aria-label="{result.verdict}">{band}{line}{RING}{dot}</svg>'


def _overlay(unit: str, results: Sequence[CaseResult]) -> str:
    """Return computed against expected for the cases of one unit, nothing for fewer than four."""
    points = [(r.expected, r.computed, r.verdict) for r in results if r.case.unit == unit and math.isfinite(r.computed)]
    values = [value for x, y, _ in points for value in (x, y)]
    if len(points) < 4 or max(values) == min(values):
        return ""
    low, high = min(values), max(values)
    margin = 0.06 * (high - low)
    low, high = low - margin, high + margin
    span = SIDE - MARGIN - 8.0

    def at(value: float) -> float:
        return (value - low) / (high - low) * span

    dots = "".join(
        f'<circle cx="{MARGIN + at(x):.1f}" cy="{8 + span - at(y):.1f}" r="4" fill="{ACCENT if verdict != "differs" else "none"}" '
        f'stroke="{ACCENT}" stroke-width="1.4" fill-opacity=".75"/>'
        for x, y, verdict in points
    )
    text = 'font-size="10" fill="#626a73" font-family="system-ui, sans-serif"'
    first, last = (short(value, 3) for value in (min(values), max(values)))
    unit_text = "" if unit in ("", "1") else f" ({escape(unit)})"
    bottom, right, middle, left = 8 + span, MARGIN + span, 8 + span / 2, MARGIN - 8
    return (
        f'<svg viewBox="0 0 {SIDE:g} {SIDE + 4:g}" role="img" aria-label="computed against expected">'
        f'<rect x="{MARGIN}" y="8" width="{span}" height="{span}" fill="#f5f6f7"/>'
        f'<line x1="{MARGIN}" y1="{bottom}" x2="{right}" y2="8" stroke="#777" stroke-dasharray="5 3"/>{dots}'
        f'<text x="{MARGIN}" y="{bottom + 13}" {text}>{first}</text>'
        f'<text x="{right}" y="{bottom + 13}" text-anchor="end" {text}>{last}</text>'
        f'<text x="{MARGIN + span / 2}" y="{bottom + 27}" text-anchor="middle" {text}>expected{unit_text}; hollow: differs</text>'
        f'<text x="{left}" y="{middle}" text-anchor="middle" {text} transform="rotate(-90 {left} {middle})">computed{unit_text}</text>'
        "</svg>"
    )
