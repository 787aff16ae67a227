"""Text of sliding: a sentence and a table row per component."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext, join_list
from seisblock.core.results import Response
from seisblock.models.slide.solve import SlideOutcome
from seisblock.output.directions import with_direction
from seisblock.output.text.section import SEVERE, Section
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.tables import format_seconds, group_answers, styled_line, table
from seisblock.output.text.threshold import SLIDES, threshold_text
from seisblock.output.units_display import Unit, format_length, format_size, length_cell, length_unit

SlideResponses = Sequence[Response[SlideOutcome]]


COLUMN_HEADINGS = tuple(map(N_, ("slips", "from (s)", "to (s)", "max ({unit})", "residual ({unit})", "final ({unit})")))

RESIDUAL = N_("residual: at the last sample of the record; final: at rest after the record")
"""Definition of the residual and final columns."""


def tables(responses: SlideResponses, *, gal: bool = True) -> Iterator[Any]:
    """Yield, per record, a row per direction."""
    for preamble, group in group_answers(responses, lambda item: item.motion.record, lambda item: [styled_line(describe(item, gal=gal))]):
        yield from preamble
        unit = length_unit((length for response in group for length in _lengths(response)), gal=gal)
        yield table(
            gettext("Sliding, {setting}", setting=describe_base(group[0])),
            ["", *(gettext(heading, unit=unit.name) for heading in COLUMN_HEADINGS)],
            [_row(response, unit) for response in group],
            caption=gettext("{first}; {second}", first=_sign_text(group[0]), second=gettext(RESIDUAL)),
        )
        yield from shaking_lines(group, gal=gal)


def describe_base(response: Response[SlideOutcome], *, in_figure: bool = False) -> str:
    """Return the properties of the base, with Greek letters in a figure."""
    base, options = response.body, response.options
    friction = N_("μ {mu:g}, kinetic {kinetic:g}") if in_figure else N_("mu {mu:g}, kinetic {kinetic:g}")
    parts = [gettext(friction, mu=base.mu, kinetic=base.kinetic)]
    if base.slope_deg and base.slope_length:
        parts.append(gettext("slope {slope:g}° for {length:g} m, then level", slope=base.slope_deg, length=base.slope_length))
    elif base.slope_deg:
        parts.append(gettext("slope {slope:g}°", slope=base.slope_deg))
    if base.one_way:
        parts.append(gettext("one way"))
    if options.vertical:
        scaled = gettext("vertical motion scaled by {factor:g}", factor=options.vertical)
        parts.append(gettext("vertical motion") if options.vertical == 1.0 else scaled)
    return join_list(parts)


def _lengths(response: Response[SlideOutcome]) -> tuple[float | None, ...]:
    """Return the displacements of one table row, m."""
    outcome = response.outcome
    return outcome.max_slip_m, outcome.residual_slip_m, outcome.final_slip_m


def describe(response: Response[SlideOutcome], *, gal: bool = True) -> str:
    """Return the outcome in a sentence."""
    outcome, name = response.outcome, response.motion.name
    if not outcome.slips:
        base, options = response.body, response.options
        if base.slope_deg:
            return gettext("{name}: remains at rest; static friction is not exceeded.", name=name)
        gravity, vertical = options.gravity, options.vertical
        onset_text = threshold_text(
            SLIDES, (base.mu, math.inf if base.one_way else base.mu), response.motion, gravity=gravity, vertical=vertical, gal=gal
        )
        return gettext("{name}: remains at rest; {onset}.", name=name, onset=onset_text)
    # the path has a unit of its own: many slips of millimetres add up to a path of centimetres
    unit = length_unit([outcome.max_slip_m], gal=gal)
    words = {"name": name, "most": format_size(outcome.max_slip_m, unit), "path": format_size(outcome.path_m, gal=gal)}
    if format_size(outcome.path_m, gal=gal) != format_length(outcome.path_m, gal=gal):
        text = gettext("{name}: slides {path} in total", name=name, path=format_size(outcome.path_m, gal=gal))
    elif outcome.final_slip_m is None:
        text = gettext("{name}: slides, maximum displacement {most}, path {path}; not at rest at the end", **words)
    elif outcome.final_slip_m != outcome.residual_slip_m:
        final = with_direction(format_size(outcome.final_slip_m, unit), name, outcome.final_slip_m)
        text = gettext(
            "{name}: slides, maximum displacement {most} and path {path} during the record, residual displacement {final} at rest",
            final=final,
            **words,
        )
    else:
        final = with_direction(format_size(outcome.final_slip_m, unit), name, outcome.final_slip_m)
        text = gettext("{name}: slides, maximum displacement {most}, residual displacement {final}, path {path}", final=final, **words)
    if outcome.fell_off_slope:
        text += gettext(", past the foot of the slope")
    if outcome.lifted_off:
        text += gettext("; loses contact with the base")
    return gettext("{sentence}.", sentence=text)


def _sign_text(response: Response[SlideOutcome]) -> str:
    """Return the sign convention of displacements."""
    if response.body.slope_deg > 0.0:
        return gettext("relative to the base, + in the component's positive direction, downhill")
    return gettext("relative to the base, + in the component's positive direction")


def _row(response: Response[SlideOutcome], unit: Unit) -> list[Any]:
    outcome = response.outcome
    return [
        response.motion.name,
        outcome.slip_count,
        format_seconds(outcome.slip_start_s),
        format_seconds(outcome.slip_end_s),
        *(length_cell(length, unit) for length in _lengths(response)),
    ]


def _short_verdict(response: Response[SlideOutcome]) -> str:
    outcome = response.outcome
    if not outcome.slips:
        return gettext("no sliding")
    if format_size(outcome.max_slip_m) != format_length(outcome.max_slip_m):
        return gettext("total sliding path {path}", path=format_size(outcome.path_m))
    return gettext("maximum sliding displacement {most}", most=format_length(outcome.max_slip_m))


def _sentences(response: Response[SlideOutcome]) -> Iterator[str]:
    outcome = response.outcome
    if not outcome.slips:
        yield gettext("No sliding.")
        return
    unit = length_unit([outcome.max_slip_m], gal=True)
    text = N_("Sliding from {start:.2f} s; maximum displacement {most} at {time:.2f} s, residual displacement {rest}.")
    yield gettext(
        text,
        start=outcome.slip_start_s,
        most=format_size(outcome.max_slip_m, unit),
        time=outcome.max_slip_time_s,
        rest=with_direction(format_size(outcome.residual_slip_m, unit), response.motion.name, outcome.residual_slip_m),
    )


SECTION = Section(
    title=N_("Sliding"),
    severity=lambda outcome: min(outcome.max_slip_m, SEVERE - 0.1) if outcome.slips else 0.0,
    verdict=_short_verdict,
    sentences=_sentences,
    onset=N_("Onset of sliding at {factor:.2f} times this record."),
    has_figure=False,
)
