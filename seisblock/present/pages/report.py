"""The report: one self-contained page about one record and what it does to some bodies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from seisblock.criteria.card import once_each
from seisblock.present.edges import edges
from seisblock.present.faces import figure_of
from seisblock.present.figures.embed import Picture, picture
from seisblock.present.figures.fonts import drawn
from seisblock.present.page import page
from seisblock.present.pages import report_words as words
from seisblock.present.scales import acceleration_unit, length_unit, velocity_unit
from seisblock.present.text.tables import NOTHING, acceleration, history, number, seconds, told_acceleration
from seisblock.present.text.whereabouts import whereabouts
from seisblock.records.doubtful import sentences as doubts
from seisblock.records.site import file_of, site_of, told_time
from seisblock.references import REFERENCES
from seisblock.studies.assessment import Assessment, BodyAssessment, Effect
from seisblock.studies.criteria_card import Card
from seisblock.words import listed, noted, strung, tell

UNBROKEN = "\u2011"
"""A hyphen at which no line ends."""

GOVERNING = "respond"
ORDER = (GOVERNING, "rock", "slide", "jump", "uplift")
"""Sections of a body, in this order: what it does, then the idealised models."""

DRAWN = (GOVERNING, "jump", "uplift")
"""What has a figure; rocking and sliding by themselves are seen in that of the first."""


def report(found: Assessment, *, command: str = "") -> str:
    """Return the page, in the language spoken.

    Parameters
    ----------
    found : Assessment
    command : str
        The command line that made it, for the provenance.
    """
    record = found.record
    read_as = record.format.replace("-", UNBROKEN)
    about = " · ".join(part for part in (told_time(record, record.start), f"{record.samples} × {record.dt:g} s", read_as) if part)
    return page(
        "report.html",
        tell("What {name} does to what stands there", name=site_of(record).label or file_of(record) or tell("record")),
        subtitles=[about, *whereabouts(record)],
        processed=history(record) if record.history else "",
        foot=", ".join(found.citations),
        contents=_contents(found),
        doubts=[tell(doubt) for doubt in doubts([record])],
        verdicts=[_tile(body) for body in found.bodies],
        record=_record(found),
        bodies=[_body(found, body) for body in found.bodies],
        provenance=_provenance(found, command),
        references=[REFERENCES[key].text() for key in found.citations],
        limits=tell(words.LIMITS),
    )


def _contents(found: Assessment) -> list[tuple[str, str]]:
    """Return the sections of the page: where each is, and its name."""
    bodies = [(f"body-{number}", tell(body.subject.name)) for number, body in enumerate(found.bodies, start=1)]
    return [("record", tell("The record")), *bodies, ("origin", tell("Where this comes from"))]


def _of(body: BodyAssessment, kind: str) -> list[Effect]:
    """Return the effects of one kind, a component each."""
    return [effect for effect in body.effects if effect.kind == kind]


def _tile(body: BodyAssessment) -> dict[str, str]:
    """Return the one card of a body: what it does in the direction in which that is worst, and how sure that is."""
    effects = _of(body, GOVERNING)
    first, text = words.card(effects)
    head = tell("{name}: {what}", name=tell(body.subject.name), what=first)
    return {"level": words.level(effects), "head": head, "text": strung(text)}


def _record(found: Assessment) -> dict[str, Any]:
    """Return the record: what it is in words, its peaks and frequencies with a column per component, its figure."""
    from seisblock.present.figures.measure import measure_figure

    measures = found.measures
    lead = []
    if measures.jma_intensity is not None:
        lead.append(tell("JMA intensity {value:.2f} (class {name}).", value=measures.jma_intensity, name=tell(measures.jma_class or "")))
    if measures.horizontal is not None:
        peak = measures.horizontal
        size = told_acceleration(peak.pga_m_s2, gal=True)
        lead.append(tell("Largest horizontal vector {size} at {time:.2f} s.", size=size, time=peak.time_s))
    parts = measures.components
    speed, far = velocity_unit(gal=True), length_unit((m.pgd_m for m in parts), gal=True)
    rows = [
        (f"PGA ({acceleration_unit(gal=True).name})", *(acceleration(m.pga_m_s2, gal=True) for m in parts)),
        (tell("time of PGA (s)"), *(seconds(m.time_of_pga_s) for m in parts)),
        (f"PGV ({speed.name})", *(number(m.pgv_m_s / speed.size) for m in parts)),
        (f"PGD ({far.name})", *(number(m.pgd_m / far.size) for m in parts)),
        ("f = PGA/2πPGV (Hz)", *(number(m.equivalent_frequency_hz.pga_pgv) for m in parts)),
        (tell("f, Fourier (Hz)"), *(number(m.equivalent_frequency_hz.fourier) for m in parts)),
        (tell("Arias (m/s)"), *(number(m.arias_m_s) for m in parts)),
        (tell("duration, 5-95 % (s)"), *(seconds(m.significant_duration_s) for m in parts)),
    ]
    caption = tell("Acceleration, velocity and spectra of the record.")
    return {
        "lead": strung(lead),
        "headings": ["", *(m.component for m in parts)],
        "rows": rows,
        "picture": picture(drawn(lambda: measure_figure(found.record, measures)), caption),
        "warnings": [tell(text) for text in measures.warnings],
    }


def _body(found: Assessment, body: BodyAssessment) -> dict[str, Any]:
    """Return one body: what it is, then a section for each kind of motion."""
    block, friction = body.subject.block, body.subject.mu
    about = [
        f"{block.width:.3g} × {block.height:.3g} m",
        f"H/B {block.height / block.width:.3g}",
        f"α {math.degrees(block.slenderness):.2f}°",
    ]
    about += [tell(edges(block))] if block.inset else []
    about += [f"μ {friction:g}\u00a0/\u00a0{body.subject.mu_kinetic:g}"] if friction is not None else []
    sections = [_section(found, body, kind) for kind in ORDER if _of(body, kind)]
    return {"name": tell(body.subject.name), "about": listed(about), "models": _models(body), "sections": sections}


def _models(body: BodyAssessment) -> list[list[str]]:
    """Return the idealised models as rows: what each says in each component, and from which factor on the record it begins."""
    rows = []
    for kind in ORDER[1:]:
        for effect in _of(body, kind):
            begins = NOTHING if effect.onset is None or not math.isfinite(effect.onset) else f"{effect.onset:.2f}"
            rows.append([tell(words.SECTIONS[kind]), effect.response.motion.name, words.verdict(effect), begins])
    return rows


def _section(found: Assessment, body: BodyAssessment, kind: str) -> dict[str, Any]:
    """Return one kind of motion: in words, then in pictures."""
    effects = _of(body, kind)
    worst = max(effects, key=words.rank)
    return {
        "name": tell(words.SECTIONS[kind]),
        "effects": [strung(words.sentences(effect)) for effect in effects],
        "scatter": words.scatter(effects),
        "warnings": list(dict.fromkeys(tell(text) for effect in effects for text in effect.response.warnings)),
        "picture": _picture(worst, of=len(effects) if words.severity(worst) else 1) if kind in DRAWN else None,
        "criteria": _criteria(found, body, effects) if kind == "rock" else None,
    }


def _picture(effect: Effect, *, of: int) -> Picture:
    """Return the figure of the worst of several effects, or of one where none is worse."""
    text = noted("{what}, {name}") if of == 1 else noted("{what}, {name}, the worst direction")
    caption = tell(text, name=effect.response.motion.name, what=tell(words.SECTIONS[effect.kind]))
    return picture(drawn(lambda: figure_of([effect.response])), caption)


def _criteria(found: Assessment, body: BodyAssessment, effects: Sequence[Effect]) -> dict[str, Any]:
    """Return the criteria beside the simulated truth."""
    from seisblock.present.figures.criteria import figure

    measured = {m.component: m for m in found.measures.components}
    cards, sentences = [], []
    for effect in effects:
        name = effect.response.motion.name
        highpass = found.measures.conventions.velocity_highpass_hz
        cards.append(Card(found.record, name, body.subject.block, measured[name], body.cards[name], effect.response.outcome, highpass))
    for card in cards:
        counted = once_each(card.rows)
        right = sum(row.overturns == card.outcome.overturned for row in counted)
        text = noted("{name}: {right} of {all} criteria agree with the simulation.")
        sentences.append(tell(text, name=card.component, right=right, all=len(counted)))
    caption = tell("Demand over threshold: right of 1 a criterion says that the body falls.")
    return {"sentences": sentences, "picture": picture(drawn(lambda: figure(cards)), caption)}


def _provenance(found: Assessment, command: str) -> list[tuple[str, str]]:
    """Return where everything comes from."""
    record, corner = found.record, found.measures.conventions.velocity_highpass_hz
    return [
        (tell("file"), file_of(record) or NOTHING),
        ("sha256", record.sha256),
        (tell("format"), record.format),
        (tell("processing"), history(record)),
        (tell("gravity"), f"{found.gravity:g} m/s²"),
        (tell("velocity"), tell("high-pass {corner:g} Hz", corner=corner) if corner else NOTHING),
        (tell("command"), command or tell("none, made in Python")),
    ]
