"""HTML report: seismic response of unanchored objects to one record, on a self-contained page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import N_, gettext, join_list, join_sentences
from seisblock.criteria.compare import count_agreeing
from seisblock.measures.shaking import response_shaking
from seisblock.output.describe_wear import describe_edges
from seisblock.output.figures.fonts import build_localized
from seisblock.output.figures.solver import response_figure
from seisblock.output.figures.svg import Picture, embed_figure
from seisblock.output.templating import render_page
from seisblock.output.text.record_info import record_info
from seisblock.output.text.tables import DASH, acceleration_cell, format_acceleration, format_number, format_seconds, processing_text
from seisblock.output.units_display import acceleration_unit, length_unit, velocity_unit
from seisblock.records.qc_report import qc_summary
from seisblock.records.site import format_local_time, get_site, source_name
from seisblock.references import REFERENCES
from seisblock.report.figures.probability import share_colour
from seisblock.report.html import report_text as words
from seisblock.report.text.report import body_headline
from seisblock.studies.criteria_comparison import CriteriaComparison
from seisblock.studies.report.responses import BodyResponses, ModelResponse, ReportData

NON_BREAKING_HYPHEN = "\u2011"
"""Hyphen without line break."""


def report(data: ReportData, *, command: str = "") -> str:
    """Return the report page in the language of the locale.

    Parameters
    ----------
    data : ReportData
    command : str
        Command line that produced the page, for the provenance.
    """
    record = data.record
    read_as = record.format.replace("-", NON_BREAKING_HYPHEN)
    summary = " · ".join(part for part in (format_local_time(record, record.start), f"{record.samples} × {record.dt:g} s", read_as) if part)
    return render_page(
        "report.html",
        gettext("Seismic response of unanchored objects: {name}", name=get_site(record).label or source_name(record) or gettext("record")),
        subtitles=[summary, *record_info(record)],
        processed=processing_text(record) if record.history else "",
        foot=", ".join(data.citations),
        contents=_contents(data),
        doubts=[gettext(flag) for flag in qc_summary([record])],
        verdicts=[_tile(body) for body in data.bodies],
        record=_record(data),
        bodies=[_body(data, body) for body in data.bodies],
        provenance=_provenance(data, command),
        references=[REFERENCES[key].text() for key in data.citations],
        limits=gettext(words.LIMITS),
    )


def _contents(data: ReportData) -> list[tuple[str, str]]:
    """Return anchor and title of each section."""
    bodies = [(f"body-{number}", gettext(body_name(body.subject.name))) for number, body in enumerate(data.bodies, start=1)]
    return [("record", gettext("Ground motion record")), *bodies, ("origin", gettext("Provenance"))]


def _effects_by_model(body: BodyResponses) -> list[list[ModelResponse]]:
    """Return the effects of each model, one per component: the full response first, then the idealised models."""
    models = dict.fromkeys(effect.response.model for effect in body.effects)
    return [[effect for effect in body.effects if effect.response.model == model] for model in models]


def _tile(body: BodyResponses) -> dict[str, str]:
    """Return the card of a body: probability as an object, then the directions, the worst first."""
    effects = [effect for effect in body.effects if effect.probability is not None]
    return {
        "colour": share_colour(body.assessment.overturning_probability),
        "head": gettext("{text}.", text=body_headline(body)),
        "text": join_sentences(words.card_text(effects)),
    }


def _record(data: ReportData) -> dict[str, Any]:
    """Return the section of the record: summary, table of intensity measures by component, figure."""
    from seisblock.report.figures.measure import measure_figure

    measures = data.measures
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
        "picture": embed_figure(build_localized(lambda: measure_figure(data.record, measures)), caption),
        "warnings": [gettext(text) for text in measures.warnings],
    }


def _body(data: ReportData, body: BodyResponses) -> dict[str, Any]:
    """Return the section of one body: dimensions, then one part per kind of motion."""
    block, friction = body.subject.block, body.subject.mu
    facts = [
        f"{block.width:.3g} × {block.height:.3g} m",
        f"H/B {block.height / block.width:.3g}",
        f"α {math.degrees(block.slenderness):.2f}°",
    ]
    facts += [gettext(describe_edges(block))] if block.inset else []
    if friction is not None:
        kinetic = body.subject.mu_kinetic
        facts.append(
            gettext("mu {mu:g}", mu=friction)
            if kinetic == friction
            else gettext("mu {mu:g}, kinetic {kinetic:g}", mu=friction, kinetic=kinetic)
        )
    sections = [_section(data, body, effects) for effects in _effects_by_model(body)]
    return {"name": gettext(body_name(body.subject.name)), "about": join_list(facts), "models": _models(body), "sections": sections}


def _models(body: BodyResponses) -> list[list[str]]:
    """Return one row per idealised model and component: result, factor at which motion begins, threshold and time above it."""
    rows = []
    for effects in _effects_by_model(body)[1:]:
        for effect in effects:
            begins = DASH if effect.onset is None or not math.isfinite(effect.onset) else f"{effect.onset:.2f}"
            shaking = response_shaking(effect.response)
            rows.append(
                [
                    gettext(words.section(effect).title),
                    effect.response.motion.name,
                    words.verdict(effect),
                    begins,
                    acceleration_cell(shaking.threshold_m_s2, gal=True),
                    format_seconds(shaking.time_above_threshold_s),
                    format_seconds(shaking.longest_above_threshold_s),
                ]
            )
    return rows


def _section(data: ReportData, body: BodyResponses, effects: Sequence[ModelResponse]) -> dict[str, Any]:
    """Return the part of one model: sentences, warnings, figures; the criteria stand beside the margins of rocking."""
    worst = max(effects, key=words.rank)
    return {
        "name": gettext(words.section(worst).title),
        "effects": [join_sentences(words.sentences(effect)) for effect in effects],
        "scatter": words.scatter_text(effects),
        "warnings": list(dict.fromkeys(gettext(text) for effect in effects for text in effect.response.warnings)),
        "picture": _picture(worst, of=len(effects) if words.severity(worst) else 1) if words.section(worst).has_figure else None,
        "criteria": _criteria(data, body, effects) if worst.margin is not None else None,
    }


def _picture(effect: ModelResponse, *, of: int) -> Picture:
    """Return the figure of an effect; the caption marks the governing one of several."""
    text = N_("{what}, {name}") if of == 1 else N_("{what}, {name} (worst component)")
    caption = gettext(text, name=effect.response.motion.name, what=gettext(words.section(effect).title))
    known = [] if effect.assessment is None else [effect.assessment.assessment.overturning_probability]
    return embed_figure(build_localized(lambda: response_figure([effect.response], probabilities=known)), caption)


def _criteria(data: ReportData, body: BodyResponses, effects: Sequence[ModelResponse]) -> dict[str, Any]:
    """Return the comparison of overturning criteria with the simulation."""
    from seisblock.report.figures.criteria import figure

    measures = {m.component: m for m in data.measures.components}
    cards, sentences = [], []
    for effect in effects:
        name = effect.response.motion.name
        highpass = data.measures.conventions.velocity_highpass_hz
        cards.append(
            CriteriaComparison(
                data.record,
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
        right, count = count_agreeing(card.rows, card.outcome.overturned)
        text = N_("{name}: {right} of {all} criteria agree with the simulation")
        sentences.append(gettext(text, name=card.component, right=right, all=count))
    caption = gettext("Demand / threshold; a criterion predicts overturning above 1")
    return {"sentences": sentences, "picture": embed_figure(build_localized(lambda: figure(cards)), caption)}


def _provenance(data: ReportData, command: str) -> list[tuple[str, str]]:
    """Return name and value of each item of the provenance."""
    record, corner = data.record, data.measures.conventions.velocity_highpass_hz
    return [
        (gettext("file"), source_name(record) or DASH),
        ("sha256", record.sha256),
        (gettext("format"), record.format),
        (gettext("processing"), processing_text(record)),
        (gettext("gravity"), f"{data.gravity:g} m/s²"),
        (gettext("velocity"), gettext("high-pass {corner:g} Hz", corner=corner) if corner else DASH),
        (gettext("command"), command or gettext("none (called from Python)")),
    ]
