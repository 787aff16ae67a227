"""Page of a scenario: a card for each object, in English and Japanese."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from seisblock.core.i18n import LANGUAGES, N_, format_share, get_locale, gettext, use_locale
from seisblock.output.figures.fonts import build_localized
from seisblock.output.figures.svg import embed_figure
from seisblock.output.templating import render_page
from seisblock.output.text.tables import format_share_interval
from seisblock.report.figures.probability import share_colour
from seisblock.report.text.scenario import SIDES, advice_text, class_counts, object_name
from seisblock.studies.scenario.assess import EITHER, ObjectRisk


def scenario_page(results: Sequence[ObjectRisk], label: str, notes: Sequence[str]) -> str:
    """Return the self-contained page; its reader chooses the language, that of the locale comes first.

    Parameters
    ----------
    results : sequence of ObjectRisk
        Worst first.
    label : str
        Scenario, a translatable message.
    notes : sequence of str
        Origin of the motions, assumptions.
    """
    languages = sorted(LANGUAGES, key=lambda language: language != get_locale())
    editions = []
    for language in languages:
        with use_locale(language):
            editions.append({"language": language, **_edition(results, label, notes)})
    return render_page("scenario.html", editions[0]["title"], editions=editions)


def _edition(results: Sequence[ObjectRisk], label: str, notes: Sequence[str]) -> dict[str, Any]:
    """Return the content in the language of the locale."""
    from seisblock.report.figures.scenario import figure

    caption = gettext("Probability of each object to move and to overturn")
    return {
        "name": gettext("English") if get_locale() == "en" else gettext("Japanese"),
        "title": gettext("Objects in a scenario: {scenario}", scenario=gettext(label)),
        "lead": class_counts(results),
        "notes": [gettext(note) for note in notes],
        "cards": [_card(result) for result in results],
        "picture": embed_figure(build_localized(lambda: figure(results, label)), caption),
        "limits": [
            gettext("Model: a rigid object on a hard level floor, free on all sides; it falls if either horizontal motion overturns it."),
            gettext(
                "Not covered: soft feet, castors, carpet, drawers and doors that open, shifting contents, walls, neighbours, isolators."
            ),
            gettext("The interval covers the variation between earthquakes, not the error of the model."),
        ],
    }


def _card(result: ObjectRisk) -> dict[str, Any]:
    """Return the card of one object."""
    if result.class_name is None:
        return {"name": object_name(result), "colour": "", "head": gettext("no result"), "facts": [], "advice": [advice_text(result)]}
    interval, fall_share = result.interval or (0.0, 1.0), result.overturning_probability or 0.0
    facts = [
        (
            gettext("overturns"),
            gettext("{share} (95 %: {interval})", share=format_share(fall_share), interval=format_share_interval(interval)),
        ),
        (gettext("moves or overturns"), format_share(result.moved_probability or 0.0)),
    ]
    if result.falls_along is not None:
        text = N_("along its {side}; up to {reach:.1f} m from its side")
        if result.falls_along == EITHER:
            text = N_("up to {reach:.1f} m from its side")
        reach = gettext(text, side=gettext(SIDES[result.falls_along]), reach=result.fall_reach_m)
        facts.append((gettext("falls"), reach))
    if result.displacement_m is not None and result.displacement_m >= 0.001:
        shift = gettext("up to {shift:.1f} cm", shift=100.0 * result.displacement_m)
        facts.append((gettext("residual displacement (95 % of the cases)"), shift))
    return {
        "name": object_name(result),
        "colour": share_colour(fall_share),
        "head": gettext(result.class_name),
        "facts": facts,
        "advice": [gettext(text) for text in result.advice],
    }
