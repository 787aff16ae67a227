"""HTML report: seismic response of unanchored objects to one record, on a self-contained page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext, join_list, join_sentences
from seisblock.criteria.compare import unique_criteria
from seisblock.measures.shaking import response_shaking
from seisblock.records.qc_report import qc_summary
from seisblock.records.site import format_local_time, get_site, source_name
from seisblock.references import REFERENCES
from seisblock.report.describe_wear import describe_edges
from seisblock.report.figures.fonts import build_localized
from seisblock.report.figures.svg import Picture, embed_figure
from seisblock.report.html import report_text as words
from seisblock.report.registry import response_figure
from seisblock.report.templating import render_page
from seisblock.report.text.record_info import record_info
from seisblock.report.text.tables import DASH, acceleration_cell, format_acceleration, format_number, format_seconds, processing_text
from seisblock.report.units_display import acceleration_unit, length_unit, velocity_unit
from seisblock.studies.assessment import Assessment, BodyAssessment, ModelResponse
from seisblock.studies.criteria_comparison import CriteriaComparison

NON_BREAKING_HYPHEN = "\u2011"
"""Hyphen without line break."""

GOVERNING_KIND = "respond"
ORDER = (GOVERNING_KIND, "rock", "slide", "jump", "uplift")
"""Sections of a body in order: full response, then the idealised models."""

DRAWN_KINDS = (GOVERNING_KIND, "jump", "uplift")
"""Kinds with a figure; rocking and sliding alone are covered by the figure of the full response."""


def report(assessment: Assessment, *, command: str = "") -> str:
    """Return the report page in the language of the locale.

    Parameters
    ----------
    assessment : Assessment
    command : str
        Command line that produced the page, for the provenance.
    """
    record = assessment.record
    read_as = record.format.replace("-", NON_BREAKING_HYPHEN)
    summary = " · ".join(part for part in (format_local_time(record, record.start), f"{record.samples} × {record.dt:g} s", read_as) if part)
    return render_page(
        "report.html",
        gettext("Seismic response of unanchored objects: {name}", name=get_site(record).label or source_name(record) or gettext("record")),
        subtitles=[summary, *record_info(record)],
        processed=processing_text(record) if record.history else "",
        foot=", ".join(assessment.citations),
        contents=_contents(assessment),
        doubts=[gettext(flag) for flag in qc_summary([record])],
        verdicts=[_tile(body) for body in assessment.bodies],
        record=_record(assessment),
        bodies=[_body(assessment, body) for body in assessment.bodies],
        provenance=_provenance(assessment, command),
        references=[REFERENCES[key].text() for key in assessment.citations],
        limits=gettext(words.LIMITS),
    )


def _contents(assessment: Assessment) -> list[tuple[str, str]]:
    """Return anchor and title of each section."""
    bodies = [(f"body-{number}", gettext(body.subject.name)) for number, body in enumerate(assessment.bodies, start=1)]
    return [("record", gettext("Ground motion record")), *bodies, ("origin", gettext("Provenance"))]


def _effects_of_kind(body: BodyAssessment, kind: str) -> list[ModelResponse]:
    """Return the effects of one kind, one per component."""
    return [effect for effect in body.effects if effect.kind == kind]


def _tile(body: BodyAssessment) -> dict[str, str]:
    """Return the card of a body: result of the worst component, with its probability."""
    effects = _effects_of_kind(body, GOVERNING_KIND)
    head, text = words.card_text(effects, gettext(body.subject.name))
    return {"level": words.severity_class(effects), "head": head, "text": join_sentences(text)}


def _record(assessment: Assessment) -> dict[str, Any]:
    """Return the section of the record: summary, table of intensity measures by component, figure."""
    from seisblock.report.figures.measure import measure_figure

    measures = assessment.measures
    lead = []
    if measures.jma_intensity is not None:
        lead.append(
            gettext("JMA intensity {value:.2f} (class {name})", value=measures.jma_intensity, name=gettext(measures.jma_class or ""))
        )
    if measures.horizontal is not None:
        peak = measures.horizontal
        size = format_acceleration(peak.pga_m_s2, gal=True)
        lead.append(gettext("PGA of the horizontal vector {size} at {time:.2f} s", size=size, time=peak.time_s))
    parts = measures.components
    speed, disp_unit = velocity_unit(gal=True), length_unit((m.pgd_m for m in parts), gal=True)
    rows = [
        (f"PGA ({acceleration_unit(gal=True).name})", *(acceleration_cell(m.pga_m_s2, gal=True) for m in parts)),
        (gettext("time of PGA (s)"), *(format_seconds(m.time_of_pga_s) for m in parts)),
        (f"PGV ({speed.name})", *(format_number(m.pgv_m_s / speed.size) for m in parts)),
        (f"PGD ({disp_unit.name})", *(format_number(m.pgd_m / disp_unit.size) for m in parts)),
        ("f = PGA/2πPGV (Hz)", *(format_number(m.equivalent_frequency_hz.pga_pgv) for m in parts)),
        (gettext("f, Fourier peak (Hz)"), *(format_number(m.equivalent_frequency_hz.fourier) for m in parts)),
        (gettext("Arias intensity (m/s)"), *(format_number(m.arias_m_s) for m in parts)),
        (gettext("duration, 5-95 % (s)"), *(format_seconds(m.significant_duration_s) for m in parts)),
    ]
    caption = gettext("Acceleration, velocity and spectra of the record")
    return {
        "lead": join_list(lead),
        "headings": ["", *(m.component for m in parts)],
        "rows": rows,
        "picture": embed_figure(build_localized(lambda: measure_figure(assessment.record, measures)), caption),
        "warnings": [gettext(text) for text in measures.warnings],
    }


def _body(assessment: Assessment, body: BodyAssessment) -> dict[str, Any]:
    """Return the section of one body: dimensions, then one part per kind of motion."""
    block, friction = body.subject.block, body.subject.mu
    facts = [
        f"{block.width:.3g} × {block.height:.3g} m",
        f"H/B {block.height / block.width:.3g}",
        f"α {math.degrees(block.slenderness):.2f}°",
    ]
    facts += [gettext(describe_edges(block))] if block.inset else []
    facts += [f"μ {friction:g}\u00a0/\u00a0{body.subject.mu_kinetic:g}"] if friction is not None else []
    sections = [_section(assessment, body, kind) for kind in ORDER if _effects_of_kind(body, kind)]
    return {"name": gettext(body.subject.name), "about": join_list(facts), "models": _models(body), "sections": sections}


def _models(body: BodyAssessment) -> list[list[str]]:
    """Return one row per idealised model and component: result, factor at which motion begins, threshold and time above it."""
    rows = []
    for kind in ORDER[1:]:
        for effect in _effects_of_kind(body, kind):
            begins = DASH if effect.onset is None or not math.isfinite(effect.onset) else f"{effect.onset:.2f}"
            shaking = response_shaking(effect.response)
            rows.append(
                [
                    gettext(words.SECTIONS[kind]),
                    effect.response.motion.name,
                    words.verdict(effect),
                    begins,
                    acceleration_cell(shaking.threshold_m_s2, gal=True),
                    format_seconds(shaking.time_above_threshold_s),
                    format_seconds(shaking.longest_above_threshold_s),
                ]
            )
    return rows


def _section(assessment: Assessment, body: BodyAssessment, kind: str) -> dict[str, Any]:
    """Return the part of one kind of motion: sentences, warnings, figures."""
    effects = _effects_of_kind(body, kind)
    worst = max(effects, key=words.rank)
    return {
        "name": gettext(words.SECTIONS[kind]),
        "effects": [join_sentences(words.sentences(effect)) for effect in effects],
        "scatter": words.scatter_text(effects),
        "warnings": list(dict.fromkeys(gettext(text) for effect in effects for text in effect.response.warnings)),
        "picture": _picture(worst, of=len(effects) if words.severity(worst) else 1) if kind in DRAWN_KINDS else None,
        "criteria": _criteria(assessment, body, effects) if kind == "rock" else None,
    }


def _picture(effect: ModelResponse, *, of: int) -> Picture:
    """Return the figure of an effect; the caption marks the governing one of several."""
    text = N_("{what}, {name}") if of == 1 else N_("{what}, {name} (worst component)")
    caption = gettext(text, name=effect.response.motion.name, what=gettext(words.SECTIONS[effect.kind]))
    return embed_figure(build_localized(lambda: response_figure([effect.response])), caption)


def _criteria(assessment: Assessment, body: BodyAssessment, effects: Sequence[ModelResponse]) -> dict[str, Any]:
    """Return the comparison of overturning criteria with the simulation."""
    from seisblock.report.figures.criteria import figure

    measures = {m.component: m for m in assessment.measures.components}
    cards, sentences = [], []
    for effect in effects:
        name = effect.response.motion.name
        highpass = assessment.measures.conventions.velocity_highpass_hz
        cards.append(
            CriteriaComparison(
                assessment.record,
                name,
                body.subject.block,
                measures[name],
                body.cards[name],
                effect.response.outcome,
                response_shaking(effect.response),
                highpass,
            )
        )
    for card in cards:
        rows = unique_criteria(card.rows)
        right = sum(row.overturns == card.outcome.overturned for row in rows)
        text = N_("{name}: {right} of {all} criteria agree with the simulation")
        sentences.append(gettext(text, name=card.component, right=right, all=len(rows)))
    caption = gettext("Demand / threshold; a criterion predicts overturning above 1")
    return {"sentences": sentences, "picture": embed_figure(build_localized(lambda: figure(cards)), caption)}


def _provenance(assessment: Assessment, command: str) -> list[tuple[str, str]]:
    """Return name and value of each item of the provenance."""
    record, corner = assessment.record, assessment.measures.conventions.velocity_highpass_hz
    return [
        (gettext("file"), source_name(record) or DASH),
        ("sha256", record.sha256),
        (gettext("format"), record.format),
        (gettext("processing"), processing_text(record)),
        (gettext("gravity"), f"{assessment.gravity:g} m/s²"),
        (gettext("velocity"), gettext("high-pass {corner:g} Hz", corner=corner) if corner else DASH),
        (gettext("command"), command or gettext("none (called from Python)")),
    ]
