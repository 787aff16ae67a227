"""Text report of an earthquake by station, the largest response first."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, Message, format_share, gettext, join_list, lazy_gettext
from seisblock.core.units import GAL
from seisblock.measures.intensity import reported_intensity
from seisblock.output.text.record_info import describe_earthquake
from seisblock.output.text.tables import Part, format_fixed, format_number, format_range, styled_line, table
from seisblock.output.units_display import Unit, acceleration_unit, length_cell, length_unit, velocity_unit
from seisblock.records import Preparation
from seisblock.studies.assessment import LIKELY, MAY, MOVES, STAYS
from seisblock.studies.map.station_response import StationBody, StationModel, StationResult
from seisblock.studies.map.stations import StationReport, Stations
from seisblock.studies.map.surveyed_places import SurveyComparison, contradictions

EVENT_WORDS: dict[str, str] = {
    "overturned": N_("overturns"),
    "slips": N_("slides"),
    "outcome": N_("jumps"),
    "uplifts": N_("uplift"),
}
"""Column heading of the event of each solver."""

_VERDICTS: dict[str, str] = {
    "overturned": N_("{subject}: overturns at {some} of {stations}, largest response at {station}"),
    "slips": N_("{subject}: slides at {some} of {stations}, largest response at {station}"),
    "outcome": N_("{subject}: jumps at {some} of {stations}, largest response at {station}"),
    "uplifts": N_("{subject}: uplift at {some} of {stations}, largest response at {station}"),
}

_CLASSES: dict[str, str] = {
    LIKELY: N_("{subject}: likely overturns at {some} of {stations}, largest probability at {station} ({share})"),
    MAY: N_("{subject}: may overturn at {some} of {stations}, largest probability at {station} ({share})"),
    MOVES: N_("{subject}: moves at {some} of {stations}, largest response at {station}"),
    STAYS: N_("{subject}: stays at {some} of {stations}, largest response at {station}"),
}
"""Sentence on the most severe class of the stations."""

MAX_ROWS = 40
"""Most stations in the table; the files contain all."""

SHORT_ROWS = 10
"""Most stations in the shortened table."""


def tables(stations: Stations, model: StationModel | None, *, gal: bool) -> Iterator[Any]:
    """Yield the verdict over all stations, the earthquake, the table of the largest responses and the counts of missing results.

    Parameters
    ----------
    stations : Stations
    model : StationBody, StationCemetery or None
    gal : bool
        Whether accelerations are shown in gal.
    """
    answers = [answer for answer in stations.answers if answer.pga_m_s2 is not None]
    yield styled_line(verdict(stations, model), "bold")
    if scaling := preparation_texts(stations.preparation):
        yield styled_line(join_list(map(gettext, scaling)), "yellow")
    if stations.earthquake is not None:
        yield styled_line(describe_earthquake(stations.earthquake, stations.origin_told))
    if len(answers) > SHORT_ROWS:
        yield Part(*((_station_table(answers, model, max_rows, gal=gal),) for max_rows in (MAX_ROWS, SHORT_ROWS)))
    elif answers:
        yield _station_table(answers, model, MAX_ROWS, gal=gal)
    missing = [answer for answer in stations.answers if answer.failure]
    if missing:
        yield styled_line(gettext("no result: {count}", count=len(missing)), "yellow")
    unmapped = [answer for answer in answers if not answer.is_mapped]
    if unmapped:
        yield styled_line(gettext("without coordinates, listed but not on the map: {count}", count=len(unmapped)), "yellow")


def _station_table(answers: Sequence[StationReport], model: StationModel | None, max_rows: int, *, gal: bool) -> Any:
    listed_answers = answers[:max_rows]
    header, rows = station_rows(listed_answers, model, gal=gal)
    caption = "\n".join(filter(None, (_omitted_text(len(answers) - max_rows), column_note(listed_answers, model))))
    # station names need the width
    for word, lines in ((" (", "\n("), ("overturns", "over-\nturns"), ("worst azimuth", "worst\nazimuth")):
        header = [name.replace(word, lines) for name in header]
    return table("", header, rows, caption=caption)


def column_note(answers: Sequence[StationReport], model: StationModel | None) -> str:
    """Return a note on the verdict and share columns; empty without a share.

    Parameters
    ----------
    answers : sequence of StationReport
    model : StationBody, StationCemetery or None
    """
    if not isinstance(model, StationBody) or all(answer.effect.probability is None for answer in answers):
        return ""
    return gettext(
        "overturns: share of {runs} samples under either horizontal component; displacement: nominal body, worst azimuth", runs=model.runs
    )


def preparation_texts(preparation: Preparation) -> list[Message]:
    """Return how the motions differ from the recorded ones: scaling and floor.

    Parameters
    ----------
    preparation : Preparation

    Examples
    --------
    >>> preparation_texts(Preparation(scale=4.0))
    ['records scaled by 4']
    """
    texts = []
    if preparation.scale != 1.0:
        texts.append(lazy_gettext("records scaled by {factor:g}", factor=preparation.scale))
    if preparation.target_pga is not None:
        texts.append(lazy_gettext("each record scaled to a PGA of {pga:.5g} gal", pga=preparation.target_pga / GAL))
    if preparation.target_jma is not None:
        texts.append(lazy_gettext("each record scaled to JMA intensity {intensity:.3g}", intensity=preparation.target_jma))
    if preparation.floor is not None:
        texts.append(lazy_gettext("floor motions, not ground motions"))
    return texts


def survey_tables(surveys: Sequence[SurveyComparison]) -> Iterator[Any]:
    """Yield the table of surveyed cemeteries with nearby stations, and the inconsistent pairs.

    Parameters
    ----------
    surveys : sequence of SurveyComparison
    """
    header, rows = survey_rows(surveys)
    caption = gettext("stations: the nearest three, weighted by inverse distance; residual: from stones minus from stations")
    yield table(gettext("Surveyed cemeteries"), header, rows, caption=caption)
    for pair in contradictions(surveys):
        yield styled_line(gettext(pair), "yellow")


def survey_rows(surveys: Sequence[SurveyComparison]) -> tuple[list[str], list[list[str]]]:
    """Return headings and rows of a table of surveyed cemeteries.

    Parameters
    ----------
    surveys : sequence of SurveyComparison
    """
    header = [
        gettext("surveyed place"),
        gettext("overturned"),
        gettext("JMA from stones"),
        gettext("from stations"),
        gettext("residual"),
        gettext("nearest"),
    ]
    rows = []
    for answer in surveys:
        low, high = answer.estimate.jma_intensity_interval
        intensities = [
            format_number(None) if value is None else format_fixed(value, 1) for value in (answer.estimate.jma_intensity, low, high)
        ]
        nearest = answer.neighbours[0] if answer.neighbours else None
        rows.append([
            answer.surveyed.place,
            f"{answer.surveyed.fallen}/{answer.surveyed.stones}",
            f"{intensities[0]} ({format_range(intensities[1], intensities[2])})",
            format_number(None) if answer.expected_intensity is None else format_fixed(answer.expected_intensity, 1),
            format_number(None) if answer.residual is None else f"{round(answer.residual, 1) + 0.0:+.1f}",  # no -0.0
            "" if nearest is None else gettext("{station}, {distance:.1f} km", station=nearest.station, distance=nearest.distance_km),
        ])  # fmt: skip
    return header, rows


def station_rows(answers: Sequence[StationReport], model: StationModel | None, *, gal: bool) -> tuple[list[str], list[list[str]]]:
    """Return headings and rows of a table of stations.

    Parameters
    ----------
    answers : sequence of StationReport
    model : StationBody, StationCemetery or None
    gal : bool
        Whether accelerations are shown in gal.
    """
    a, v = acceleration_unit(gal=gal), velocity_unit(gal=gal)
    way = length_unit((answer.effect.max_slip_m or answer.effect.max_uplift_m or 0.0 for answer in answers), gal=gal)
    header = [gettext("station"), gettext("dist. (km)"), f"PGA ({a.name})", f"PGV ({v.name})", gettext("JMA"), *_effect_header(model, way)]
    return header, [[*_measure_cells(answer, a, v), *_effect_cells(answer, model, way)] for answer in answers]


def verdict(survey_map: Stations, model: StationModel | None) -> str:
    """Return a sentence on the outcome over all stations.

    Parameters
    ----------
    survey_map : Stations
    model : StationBody, StationCemetery or None
    """
    answers = [answer for answer in survey_map.answers if answer.pga_m_s2 is not None]
    count = len(answers)
    if not answers:
        return gettext("no station with a result")
    worst = answers[0]
    station_text = gettext("1 station") if count == 1 else gettext("{count} stations", count=count)
    if model is None:
        return gettext("{stations}, largest shaking at {station}", stations=station_text, station=worst.label)
    if isinstance(model, StationBody):
        classes = [answer.effect.assessment.class_ for answer in answers if answer.effect.assessment is not None]
        if classes:
            most_severe = min(classes, key=list(_CLASSES).index)
            return gettext(
                _CLASSES[most_severe],
                subject=gettext(model.name),
                some=classes.count(most_severe),
                stations=station_text,
                station=worst.label,
                share=format_share(worst.effect.probability or 0.0),
            )
        event_count = sum(bool(answer.effect.happened) for answer in answers)
        return gettext(
            _VERDICTS.get(model.event, N_("{subject}: event at {some} of {stations}, largest response at {station}")),
            subject=gettext(model.name),
            some=event_count,
            stations=station_text,
            station=worst.label,
        )
    rates = [answer.effect.rate or 0.0 for answer in answers]
    return gettext(
        "{subject}: stones overturn at {falls} of {stations}, largest rate at {station}: {rate}",
        subject=gettext(model.name),
        falls=sum(rate > 0.0 for rate in rates),
        stations=station_text,
        station=worst.label,
        rate=format_share(max(rates)),
    )


def _omitted_text(count: int) -> str:
    """Return a note on the stations omitted from the table; empty if none."""
    if count <= 0:
        return ""
    return gettext("1 more station in the files") if count == 1 else gettext("{count} more stations in the files", count=count)


def _measure_cells(answer: StationReport, a: Unit, v: Unit) -> list[str]:
    intensity = answer.jma_intensity
    return [
        answer.label,
        format_number(answer.epicentral_distance_km, 3),
        format_number(None if answer.pga_m_s2 is None else answer.pga_m_s2 / a.size),
        format_number(None if answer.pgv_m_s is None else answer.pgv_m_s / v.size, 3),
        format_number(None) if intensity is None else format_fixed(reported_intensity(intensity), 1),
    ]


def _effect_header(model: StationModel | None, way: Unit) -> list[str]:
    if model is None:
        return []
    if not isinstance(model, StationBody):
        return [gettext("rate"), gettext("worst azimuth")]
    header = {
        "happened": gettext(EVENT_WORDS.get(model.event, N_("event"))),
        "class": gettext("class"),
        "overturned": gettext("overturns"),
        "probability": gettext("overturns"),
        "max_slip_m": gettext("disp. ({unit})", unit=way.name),
        "max_uplift_m": gettext("uplift ({unit})", unit=way.name),
    }
    return [*(header[name] for name in _columns(model)), gettext("worst azimuth")]


def _columns(model: StationBody) -> list[str]:
    """Return the columns of a body: class and probability replace the verdict of the nominal body where samples were solved."""
    if not model.runs:
        return [name for name in model.columns if name != "probability"]
    return ["class", *(name for name in model.columns if name not in ("happened", "overturned"))]


def _effect_cells(answer: StationReport, model: StationModel | None, way: Unit) -> list[str]:
    if model is None:
        return []
    effect = answer.effect
    towards = format_number(None) if effect.azimuth_deg is None else f"{effect.azimuth_deg:g}°"
    if not isinstance(model, StationBody):
        return [format_number(None) if effect.rate is None else format_share(effect.rate), towards]
    return [*(_cell(name, effect, way) for name in _columns(model)), towards]


def _cell(name: str, effect: StationResult, way: Unit) -> str:
    if name == "class":
        return format_number(None) if effect.assessment is None else gettext(effect.assessment.class_)
    value = getattr(effect, name)
    if value is None or isinstance(value, bool):
        return format_number(value)
    return format_share(value) if name == "probability" else length_cell(value, way)
