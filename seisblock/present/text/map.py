"""How an earthquake's stations are told: the worst first, and what has no answer or no place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.present.scales import Unit, acceleration_unit, length_cell, length_unit, velocity_unit
from seisblock.present.text.tables import fixed, line, number, table
from seisblock.present.text.whereabouts import earthquake_told
from seisblock.studies.stations.effects import StandingBody, WhatStands
from seisblock.studies.stations.survey import StationAnswer, Stations
from seisblock.studies.stations.surveys import SurveyAnswer, contradictions
from seisblock.words import noted, roughly, tell

COLUMNS = {
    "respond": ("overturned", "probability", "max_slip_m"),
    "rock": ("overturned", "probability"),
    "slide": ("happened", "max_slip_m"),
    "jump": ("happened", "overturned", "max_slip_m"),
    "uplift": ("happened", "max_uplift_m"),
}
"""What the table tells of a body, by the solver that follows it."""

HAPPENS = {
    "respond": noted("falls"),
    "rock": noted("falls"),
    "slide": noted("slides"),
    "jump": noted("jumps"),
    "uplift": noted("lifts"),
}
"""What a solver is asked about, as a heading."""

_VERDICTS = {
    "respond": noted("{subject} falls at {some} of {stations}, worst at {station}"),
    "rock": noted("{subject} falls at {some} of {stations}, worst at {station}"),
    "slide": noted("{subject} slides at {some} of {stations}, worst at {station}"),
    "jump": noted("{subject} jumps at {some} of {stations}, worst at {station}"),
    "uplift": noted("{subject} lifts at {some} of {stations}, worst at {station}"),
}

MOST = 40
"""Stations that the table tells of; the files tell of all."""


def tables(found: Stations, subject: WhatStands | None, *, gal: bool) -> Iterator[Any]:
    """Yield what is printed: the verdict over all stations, the earthquake, the table of the worst, and what is missing.

    Parameters
    ----------
    found : Stations
    subject : StandingBody, StandingStones or None
    gal : bool
        Whether accelerations are shown in gal.
    """
    answered = [answer for answer in found.answers if answer.pga_m_s2 is not None]
    yield line(verdict(found, subject), "bold")
    if found.earthquake is not None:
        yield line(earthquake_told(found.earthquake, found.origin_told))
    shown = answered[:MOST]
    if shown:
        heads, rows = cells(shown, subject, gal=gal)
        more = _more(len(answered) - MOST)
        caption = " ".join(filter(None, (more, which_is_which(shown, subject))))
        yield table("", [head.replace(" (", "\n(") for head in heads], rows, caption=caption)  # names need the room
    missing = [answer for answer in found.answers if answer.failure]
    if missing:
        yield line(tell("without an answer: {count}", count=len(missing)), "yellow")
    unmapped = [answer for answer in answered if not answer.is_mapped]
    if unmapped:
        yield line(tell("listed, and on no map, for their files do not say where they are: {count}", count=len(unmapped)), "yellow")


def which_is_which(answers: Sequence[StationAnswer], subject: WhatStands | None) -> str:
    """Return of what the verdict and the share beside it are told, empty where there is no share.

    Parameters
    ----------
    answers : sequence of StationAnswer
    subject : StandingBody, StandingStones or None
    """
    if not isinstance(subject, StandingBody) or all(answer.effect.probability is None for answer in answers):
        return ""
    return tell("falls: as given, in the worst direction; share: of {runs} plausible versions there", runs=subject.runs)


def survey_tables(surveys: Sequence[SurveyAnswer]) -> Iterator[Any]:
    """Yield what surveyed cemeteries say beside the stations around them, and the pairs that contradict each other.

    Parameters
    ----------
    surveys : sequence of SurveyAnswer
    """
    heads, rows = survey_cells(surveys)
    caption = tell("stations: the nearest three, weighted by the inverse of the distance; residual: by the stones less that")
    yield table(tell("Surveyed cemeteries"), heads, rows, caption=caption)
    for pair in contradictions(surveys):
        yield line(tell(pair), "yellow")


def survey_cells(surveys: Sequence[SurveyAnswer]) -> tuple[list[str], list[list[str]]]:
    """Return the headings of a table of surveyed cemeteries, and a row for each.

    Parameters
    ----------
    surveys : sequence of SurveyAnswer
    """
    heads = [tell("surveyed place"), tell("fell"), tell("JMA by stones"), tell("by stations"), tell("residual"), tell("nearest")]
    rows = []
    for answer in surveys:
        low, high = answer.estimate.jma_intensity_interval
        told = [number(None) if value is None else fixed(value, 1) for value in (answer.estimate.jma_intensity, low, high)]
        nearest = answer.neighbours[0] if answer.neighbours else None
        rows.append([
            answer.surveyed.place,
            f"{answer.surveyed.fallen}/{answer.surveyed.stones}",
            f"{told[0]} ({told[1]} – {told[2]})",
            number(None) if answer.expected_intensity is None else fixed(answer.expected_intensity, 1),
            number(None) if answer.residual is None else f"{round(answer.residual, 1) + 0.0:+.1f}",  # no -0.0
            "" if nearest is None else tell("{station}, {distance:.1f} km", station=nearest.station, distance=nearest.distance_km),
        ])  # fmt: skip
    return heads, rows


def cells(answers: Sequence[StationAnswer], subject: WhatStands | None, *, gal: bool) -> tuple[list[str], list[list[str]]]:
    """Return the headings of a table of stations, and a row for each.

    Parameters
    ----------
    answers : sequence of StationAnswer
    subject : StandingBody, StandingStones or None
    gal : bool
        Whether accelerations are shown in gal.
    """
    a, v = acceleration_unit(gal=gal), velocity_unit(gal=gal)
    way = length_unit((answer.effect.max_slip_m or answer.effect.max_uplift_m or 0.0 for answer in answers), gal=gal)
    heads = [tell("station"), "km", f"PGA ({a.name})", f"PGV ({v.name})", tell("JMA"), *_effect_heads(subject, way)]
    return heads, [[*_measured(answer, a, v), *_effect(answer, subject, way)] for answer in answers]


def verdict(found: Stations, subject: WhatStands | None) -> str:
    """Return what happened over all stations, in a sentence.

    Parameters
    ----------
    found : Stations
    subject : StandingBody, StandingStones or None
    """
    answered = [answer for answer in found.answers if answer.pga_m_s2 is not None]
    count = len(answered)
    if not answered:
        return tell("no station has an answer")
    worst = answered[0]
    stations = tell("1 station") if count == 1 else tell("{count} stations", count=count)
    if subject is None:
        return tell("{stations}, the largest shaking at {station}", stations=stations, station=worst.label)
    if isinstance(subject, StandingBody):
        some = sum(bool(answer.effect.happened) for answer in answered)
        return tell(_VERDICTS[subject.solver], subject=tell(subject.name), some=some, stations=stations, station=worst.label)
    rates = [answer.effect.rate or 0.0 for answer in answered]
    return tell(
        "{subject}: stones fall at {falls} of {stations}, most at {station}, {rate}",
        subject=tell(subject.name),
        falls=sum(rate > 0.0 for rate in rates),
        stations=stations,
        station=worst.label,
        rate=roughly(max(rates)),
    )


def _more(count: int) -> str:
    """Return how many stations the table leaves out, empty where it has all."""
    if count <= 0:
        return ""
    return tell("and 1 more station, in the files") if count == 1 else tell("and {count} more stations, in the files", count=count)


def _measured(answer: StationAnswer, a: Unit, v: Unit) -> list[str]:
    """Return the cells of what was measured."""
    intensity = answer.jma_intensity
    return [
        answer.label,
        number(answer.epicentral_distance_km, 3),
        number(None if answer.pga_m_s2 is None else answer.pga_m_s2 / a.size),
        number(None if answer.pgv_m_s is None else answer.pgv_m_s / v.size, 3),
        number(None) if intensity is None else fixed(intensity, 1),
    ]


def _effect_heads(subject: WhatStands | None, way: Unit) -> list[str]:
    """Return the headings of what it did."""
    if subject is None:
        return []
    if not isinstance(subject, StandingBody):
        return [tell("rate"), tell("worst to")]
    heads = {
        "happened": tell(HAPPENS[subject.solver]),
        "overturned": tell("falls"),
        "probability": tell("share"),
        "max_slip_m": tell("moves ({unit})", unit=way.name),
        "max_uplift_m": tell("rises ({unit})", unit=way.name),
    }
    return [*(heads[name] for name in COLUMNS[subject.solver]), tell("worst to")]


def _effect(answer: StationAnswer, subject: WhatStands | None, way: Unit) -> list[str]:
    """Return the cells of what it did."""
    if subject is None:
        return []
    effect = answer.effect
    towards = number(None) if effect.azimuth_deg is None else f"{effect.azimuth_deg:g}°"
    if not isinstance(subject, StandingBody):
        return [number(None) if effect.rate is None else roughly(effect.rate), towards]
    return [*(_cell(name, getattr(effect, name), way) for name in COLUMNS[subject.solver]), towards]


def _cell(name: str, value: Any, way: Unit) -> str:
    """Return one number, or one verdict, of what it did."""
    if value is None or isinstance(value, bool):
        return number(value)
    return roughly(value) if name == "probability" else length_cell(value, way)
