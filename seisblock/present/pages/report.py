"""The report: one self-contained page about one record and what it does to some bodies."""

from __future__ import annotations

import math
from collections.abc import Iterator
from html import escape

from seisblock.criteria.card import once_each
from seisblock.present.faces import figure_of
from seisblock.present.figures.embed import picture
from seisblock.present.figures.fonts import drawn
from seisblock.present.page import facts, html_table, note, page
from seisblock.present.pages import report_words as said
from seisblock.present.text.tables import NOTHING, number, seconds
from seisblock.records.doubts import sentences
from seisblock.references import REFERENCES
from seisblock.studies.assessment import Assessment, BodyAssessment, Effect
from seisblock.studies.criteria_card import Card
from seisblock.units import GAL, KINE
from seisblock.words import speaking, tell

ORDER = ("rock", "slide", "jump", "uplift")
"""Sections of a body, in this order."""


def report(found: Assessment, *, lang: str = "en", command: str = "") -> str:
    """Return the page.

    Parameters
    ----------
    found : Assessment
    lang : "en" or "ja"
    command : str
        The command line that made it, for the provenance.
    """
    record = found.record
    start = record.start.strftime("%Y-%m-%d %H:%M:%S UTC") if record.start else ""
    name = record.station or record.source or "record"
    title = said.told("What {name} does to what stands there", lang, name=name)
    subtitle = "  ".join(part for part in (start, f"{record.samples} × {record.dt:g} s", record.format) if part)
    with speaking(lang):
        parts = list(_parts(found, lang, command))
    return page(title, parts, lang=lang, subtitle=subtitle, foot=", ".join(found.citations))


def _parts(found: Assessment, lang: str, command: str) -> Iterator[str]:
    """Yield the page from top to bottom."""
    yield from (note(doubt) for doubt in sentences([found.record]))
    tiles = "".join(_tile(body, kind, lang) for body in found.bodies for kind in ORDER if _of(body, kind))
    yield f'<div class="verdicts">{tiles}</div>'
    yield from _record(found, lang)
    for body in found.bodies:
        yield from _body(found, body, lang)
    yield from _provenance(found, lang, command)


def _of(body: BodyAssessment, kind: str) -> list[Effect]:
    """Return the effects of one kind, a component each."""
    return [effect for effect in body.effects if effect.kind == kind]


def _tile(body: BodyAssessment, kind: str, lang: str) -> str:
    """Return the verdict on one body and one kind of motion, the component in which it is worst."""
    worst = max(_of(body, kind), key=said.severity)
    level = said.severity(worst)
    colour = "bad" if level >= said.BAD else "mild" if level > 0 else ""
    words = said.verdict(worst, lang)
    head = f"{tell(body.subject.name)}: {said.told(said.KINDS[kind], lang)}"
    return f'<div class="{colour}"><b>{escape(head)}</b><span>{escape(words)}</span></div>'


def _record(found: Assessment, lang: str) -> Iterator[str]:
    """Yield the record: its figure, its peaks, its frequencies."""
    from seisblock.present.figures.measure import measure_figure

    measures = found.measures
    yield f"<h2>{escape(said.told('The record', lang))}</h2>"
    words = []
    if measures.jma_intensity is not None:
        words.append(said.told("JMA intensity {value:.2f} (class {name}).", lang, value=measures.jma_intensity, name=measures.jma_class))
    if measures.horizontal is not None:
        peak = measures.horizontal
        words.append(said.told("Largest horizontal vector {gal:.1f} gal at {time:.2f} s.", lang, gal=peak.pga_m_s2 / GAL, time=peak.time_s))
    if words:
        yield f'<p class="lead">{escape(" ".join(words))}</p>'
    headings = ("", "PGA (gal)", "t (s)", "PGV (kine)", "PGD (cm)", "f: PGA/2πPGV (Hz)", "Fourier (Hz)", "Arias (m/s)", "5-95 % (s)")
    rows = [
        (
            m.component,
            f"{m.pga_m_s2 / GAL:.1f}",
            seconds(m.time_of_pga_s),
            number(m.pgv_m_s / KINE),
            number(m.pgd_m * 100),
            number(m.equivalent_frequency_hz.pga_pgv),
            number(m.equivalent_frequency_hz.fourier),
            number(m.arias_m_s),
            seconds(m.significant_duration_s),
        )
        for m in measures.components
    ]
    yield html_table(headings, rows)
    yield picture(
        drawn(lambda: measure_figure(found.record, measures)), said.told("Acceleration, velocity and spectra of the record.", lang)
    )
    yield from (note(text) for text in measures.warnings)


def _body(found: Assessment, body: BodyAssessment, lang: str) -> Iterator[str]:
    """Yield one body: what it is, then a section for each kind of motion."""
    block = body.subject.block
    yield f"<h2>{escape(tell(body.subject.name))}</h2>"
    alpha = math.degrees(block.slenderness)
    size = f"{block.width:.3g} × {block.height:.3g} m, H/B {block.height / block.width:.3g}, α {alpha:.2f}°"
    friction = "" if body.subject.mu is None else f", μ {body.subject.mu:g} / {body.subject.mu_kinetic:g}"
    worn = f", worn {block.inset * 1e3:.3g} mm per side" if block.inset else ""
    yield f'<p class="soft">{escape(size + worn + friction)}</p>'
    for kind in ORDER:
        effects = _of(body, kind)
        if effects:
            yield f"<h3>{escape(said.told(said.SECTIONS[kind], lang))}</h3>"
            for effect in effects:
                yield f"<p>{escape(' '.join(said.sentences(effect, lang)))}</p>"
                yield from (note(text) for text in effect.response.warnings)
            # uplift has a panel per corner: the worst component is enough to see
            drawn = [max(effects, key=said.severity)] if kind == "uplift" else effects
            yield '<div class="pairs">' + "".join(_figure(effect, lang) for effect in drawn) + "</div>"
            if kind == "rock":
                yield from _cards(found, body, lang)


def _figure(effect: Effect, lang: str) -> str:
    """Return the figure of one effect."""
    caption = f"{effect.response.motion.name}: {said.told(said.KINDS[effect.kind], lang)}"
    return picture(drawn(lambda: figure_of([effect.response])), caption)


def _cards(found: Assessment, body: BodyAssessment, lang: str) -> Iterator[str]:
    """Yield the criteria beside the simulated truth."""
    from seisblock.present.figures.criteria import figure

    measured = {m.component: m for m in found.measures.components}
    cards = []
    for effect in _of(body, "rock"):
        name = effect.response.motion.name
        highpass = found.measures.conventions.velocity_highpass_hz
        cards.append(Card(found.record, name, body.subject.block, measured[name], body.cards[name], effect.response.outcome, highpass))
    yield f"<h3>{escape(said.told('Criteria beside the simulation', lang))}</h3>"
    for card in cards:
        counted = once_each(card.rows)
        right = sum(row.overturns == card.outcome.overturned for row in counted)
        text = "{name}: {right} of {all} criteria agree with the simulation."
        yield f"<p>{escape(said.told(text, lang, name=card.component, right=right, all=len(counted)))}</p>"
    yield picture(drawn(lambda: figure(cards)), said.told("Demand over threshold: right of 1 a criterion says that the body falls.", lang))


def _provenance(found: Assessment, lang: str, command: str) -> Iterator[str]:
    """Yield where everything comes from."""
    record = found.record
    yield f"<h2>{escape(said.told('Where this comes from', lang))}</h2>"
    rules = found.measures.conventions
    yield facts(
        [
            (said.told("file", lang), record.source.rsplit("/", 1)[-1] if record.source else NOTHING),
            ("sha256", record.sha256),
            (said.told("format", lang), record.format),
            (said.told("processing", lang), "; ".join(record.history) or said.told("as read", lang)),
            (said.told("gravity", lang), f"{found.gravity:g} m/s²"),
            (said.told("velocity", lang), f"high-pass {rules.velocity_highpass_hz:g} Hz" if rules.velocity_highpass_hz else "-"),
            (said.told("command", lang), command),
        ]
    )
    yield "<ul>" + "".join(f"<li>{escape(REFERENCES[key].text())}</li>" for key in found.citations) + "</ul>"
    yield f'<p class="soft">{escape(said.told(said.LIMITS, lang))}</p>'
