"""Wording of an assessment, the same in tables and pages."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.core.i18n import N_, format_share, gettext
from seisblock.core.results import Response
from seisblock.output.text.tables import format_seconds, styled_line
from seisblock.studies.assessment import LIKELY, MAY, MOVES, STAYS, Assessment, DirectionAssessment, assess_object
from seisblock.studies.azimuth_probability import AzimuthAverage

FAR_FACTOR = 10.0
"""Largest factor to overturning that is printed."""

STYLES = {LIKELY: "bold red", MAY: "bold yellow", MOVES: "bold blue", STAYS: "bold"}
"""Style of each class in a terminal."""


def headline(assessment: Assessment, name: str = "") -> str:
    """Return an assessment in one line: class, probability, range of the models.

    Parameters
    ----------
    assessment : Assessment
    name : str
        Begin of the line; by default the direction.

    Examples
    --------
    >>> headline(Assessment(0.74, (0.67, 0.8), 200, 0.8, (), 0.87, 1.35, None, "NS", LIKELY))
    'NS: likely overturns (74 %; factor to overturning 0.87-1.35 by model)'
    """
    return gettext("{name}: {verdict}", name=name or assessment.direction, verdict=verdict_text(assessment))


def verdict_text(assessment: Assessment) -> str:
    """Return class, probability and range of the models without a name."""
    share = share_text(assessment.class_, format_share(assessment.overturning_probability))
    values = {"verdict": gettext(assessment.class_), "share": share}
    smallest, greatest = assessment.least_factor, assessment.greatest_factor
    if smallest is None or greatest is None:
        return gettext("{verdict} ({share})", **values)
    low, high = factor_text(smallest), factor_text(greatest)
    if low == high:
        return gettext("{verdict} ({share}; factor to overturning {factor})", **values, factor=low)
    return gettext("{verdict} ({share}; factor to overturning {low}-{high} by model)", **values, low=low, high=high)


def share_text(class_: str, share: str) -> str:
    """Return an overturning probability as it stands behind a class, named behind one that does not speak of overturning.

    Examples
    --------
    >>> share_text(LIKELY, "74 %"), share_text(MOVES, "0 %")
    ('74 %', 'overturning 0 %')
    """
    return share if class_ in (LIKELY, MAY) else gettext("overturning {share}", share=share)


def factor_text(factor: float) -> str:
    """Return a factor to overturning; beyond :data:`FAR_FACTOR` its value has no meaning."""
    return f"{factor:.2f}" if factor < FAR_FACTOR else f">{FAR_FACTOR:g}"


def object_headline(assessment: Assessment, name: str = "") -> str:
    """Return the assessment of an object under any of several directions in one line; no direction if nothing moves it.

    Parameters
    ----------
    assessment : Assessment
    name : str
        Begin of the line; by default "object".
    """
    still = assessment.moved_probability == 0.0
    if name:
        text = N_("{name}: {verdict} ({share})") if still else N_("{name}: {verdict} ({share}); worst direction {direction}")
    else:
        text = N_("object: {verdict} ({share})") if still else N_("object: {verdict} ({share}); worst direction {direction}")
    share = share_text(assessment.class_, format_share(assessment.overturning_probability))
    return gettext(text, name=name, verdict=gettext(assessment.class_), share=share, direction=assessment.direction)


def predictability_text(assessment: Assessment) -> str:
    """Return until when the single run is predictable; empty if to its end."""
    if assessment.predictable_until_s is None:
        return ""
    text = N_("single run predictable until {time} s: later, input changes of 2e-6 alter it")
    return gettext(text, time=format_seconds(assessment.predictable_until_s))


def style(assessment: Assessment) -> str:
    """Return the style of an assessment in a terminal."""
    return STYLES[assessment.class_]


def name_pile(text: str, stone_count: int) -> str:
    """Return a headline; that of a pile begins with its number of stones, taken as one rigid block.

    Examples
    --------
    >>> name_pile("NS: stays (overturning 0 %)", 5)
    '5 stones as one rigid block, NS: stays (overturning 0 %)'
    """
    return text if stone_count == 1 else gettext("{count} stones as one rigid block, {text}", count=stone_count, text=text)


def assessment_lines(extra: Mapping[str, Any], body: Any = None) -> Iterator[Text]:
    """Yield the headline of a direction, and until when its single run is predictable; nothing without samples.

    Parameters
    ----------
    extra : mapping
        Further results of the direction.
    body : body of the solver
    """
    part: DirectionAssessment | None = extra.get("assessment")
    if part is None:
        return
    stone_count = getattr(body, "stone_count", 1)
    if "directions" in extra:
        worst = extra["directions"][0].azimuth_deg
        text, color = azimuths_headline(extra["all_azimuths"], worst, part.assessment.overturning_probability)
        yield styled_line(name_pile(text, stone_count), color)
    yield styled_line(name_pile(headline(part.assessment), stone_count), style(part.assessment))
    if text := predictability_text(part.assessment):
        yield styled_line("  " + text)


def azimuths_headline(average: AzimuthAverage, worst_deg: float, worst_probability: float) -> tuple[str, str]:
    """Return the assessment of a body of unknown orientation in one line, and its style.

    Parameters
    ----------
    average : AzimuthAverage
    worst_deg : float, degrees
        Worst azimuth.
    worst_probability : float
        Overturning probability there.
    """
    mean = share_text(average.class_, format_share(average.overturning_probability))
    values = {"verdict": gettext(average.class_), "mean": mean}
    if average.overturning_probability == worst_probability == 0.0:
        return gettext("all azimuths: {verdict} ({mean})", **values), STYLES[average.class_]
    text = N_("all azimuths: {verdict} ({mean} on average); worst azimuth {azimuth:g} ({share})")
    return gettext(text, **values, azimuth=worst_deg, share=format_share(worst_probability)), STYLES[average.class_]


def first_probability(extras: Sequence[Mapping[str, Any]]) -> float | None:
    """Return the overturning probability of the first direction, None without samples."""
    part: DirectionAssessment | None = extras[0].get("assessment") if extras else None
    return None if part is None else part.assessment.overturning_probability


def object_lines(pairs: Sequence[tuple[Response[Any], Mapping[str, Any]]]) -> Iterator[Text]:
    """Yield the headline of an object under several directions of one record; nothing for a single direction."""
    parts = [extra["assessment"] for _, extra in pairs if "assessment" in extra]
    if len(parts) > 1:
        assessment = assess_object(parts)
        yield styled_line(name_pile(object_headline(assessment), pairs[0][0].body.stone_count), style(assessment))
