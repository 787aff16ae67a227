"""Text of uplift under a record: a sentence and a table of corners per component."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext, join_sentences
from seisblock.core.results import Response
from seisblock.models.uplift.batch_results import MAX_LEAN_RATIO
from seisblock.models.uplift.outcome import UpliftOutcome
from seisblock.output.text.section import SEVERE, Section
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.tables import format_seconds, group_answers, styled_line, table
from seisblock.output.text.threshold import format_factor
from seisblock.output.units_display import format_length, length_cell, length_unit

UpliftResponses = Sequence[Response[UpliftOutcome]]

BEYOND_MODEL = N_(
    "amount of uplift not available: the tilt exceeds {small:g} of the overturning angle, beyond the range of this model (no "
    "P-delta effect)."
)
"""Text in place of values beyond the range of the model."""

MIN_SHARE = 5e-4
"""Smallest share of time printed; smaller ones would read 0.0 %."""

CORNER_LABELS = ("1 (+x,+y)", "2 (+x,-y)", "3 (-x,+y)", "4 (-x,-y)")


def tables(responses: UpliftResponses, *, gal: bool) -> Iterator[Any]:
    """Yield the record, and per component a sentence and a table of the corners."""
    for heading, part in group_answers(responses, lambda item: item.motion.record, lambda item: [styled_line(describe(item, gal=gal))]):
        yield from heading
        yield from (block for response in part for block in _details(response, gal=gal))


def _details(response: Response[UpliftOutcome], *, gal: bool) -> Iterator[Any]:
    outcome = response.outcome
    yield table(f"+x = {response.motion.name}", [gettext("corner"), *CORNER_LABELS], _rows(response, gal=gal))
    yield styled_line(
        gettext(
            "Natural frequencies {frequencies} Hz; static settlement {settlement}.",
            frequencies=[f"{f:.3g}" for f in outcome.natural_frequencies_hz],
            settlement=format_length(outcome.static_settlement_m, gal=gal),
        )
    )
    yield from shaking_lines([response], gal=gal, static=True)
    yield styled_line()


def _rows(response: Response[UpliftOutcome], *, gal: bool) -> Iterator[list[str]]:
    """Yield the table rows, a column per corner; only the first uplift beyond the range of the model."""
    corners = response.outcome.corners
    static = response.body.static_corner_force(response.options.gravity)
    yield [gettext("first uplift (s)"), *(format_seconds(c.first_uplift_s) for c in corners)]
    if not response.outcome.within_model:
        return
    yield [gettext("uplift duration (s)"), *(format_seconds(c.uplift_duration_s) for c in corners)]
    yield [gettext("longest uplift (s)"), *(format_seconds(c.longest_uplift_s) for c in corners)]
    # of a corner that stays pressed the largest height is negative
    heights = [None if c.first_uplift_s is None else c.max_uplift_m for c in corners]
    unit = length_unit(heights, gal=gal)
    yield [gettext("maximum uplift ({unit})", unit=unit.name), *(length_cell(height, unit) for height in heights)]
    yield [gettext("  at (s)"), *(format_seconds(None if c.first_uplift_s is None else c.max_uplift_time_s) for c in corners)]
    yield [gettext("maximum contact force (kN)"), *(f"{c.max_contact_force_n / 1e3:.3f}" for c in corners)]
    yield [gettext("  over static force"), *(f"{c.max_contact_force_n / static:.2f}" for c in corners)]


def describe(response: Response[UpliftOutcome], *, gal: bool = True) -> str:
    """Return the outcome in a sentence."""
    outcome, name = response.outcome, response.motion.name
    if not outcome.uplifts:
        if outcome.uplift_scale is None:
            return gettext("{name}: no uplift.", name=name)
        factor = format_factor(outcome.uplift_scale)
        return gettext("{name}: no uplift; scale factor to uplift {factor}.", name=name, factor=factor)
    corners = outcome.first_corners
    if len(corners) > 1:
        numbers = gettext(" and ").join(map(str, corners))
        first_text = gettext(
            "{name}: first uplift at corners {corners}, at {time:.3f} s", name=name, corners=numbers, time=outcome.first_uplift_s
        )
    else:
        first_text = gettext(
            "{name}: first uplift at corner {corner}, at {time:.3f} s", name=name, corner=corners[0], time=outcome.first_uplift_s
        )
    if not outcome.within_model:
        caveat = gettext(BEYOND_MODEL, small=MAX_LEAN_RATIO)
        factor_text = gettext("Scale factor to uplift {factor:.3g}.", factor=outcome.uplift_scale)
        return join_sentences([gettext("{first}; {second}", first=first_text, second=caveat), factor_text])
    shares = [
        gettext("{share:.1%} on {corners}", share=share, corners=n) for n, share in outcome.share_on_corners.items() if share >= MIN_SHARE
    ]
    return first_text + gettext(
        "; maximum uplift {most}. Total uplift duration {air:.3f} s, {changes} changes of contact ({shares} corners). Scale "
        "factor to uplift {factor:.3g}.",
        most=format_length(outcome.max_uplift_m, gal=gal),
        air=outcome.uplift_duration_s,
        changes=outcome.contact_changes,
        shares=shares,
        factor=outcome.uplift_scale,
    )


def _short_verdict(response: Response[UpliftOutcome]) -> str:
    outcome = response.outcome
    if not outcome.uplifts:
        return gettext("no uplift")
    if not outcome.within_model:
        return gettext("uplift of corner {corner} beyond the range of the model", corner=outcome.corner)
    return gettext("uplift of corner {corner}, maximum {most}", corner=outcome.corner, most=format_length(outcome.max_uplift_m))


def _sentences(response: Response[UpliftOutcome]) -> Iterator[str]:
    outcome = response.outcome
    if not outcome.uplifts:
        yield gettext("No corner separates from its spring.")
        return
    if not outcome.within_model:
        text = N_(
            "First uplift at corner {corner}, {time:.2f} s; the subsequent tilt exceeds the range of this model, which neglects "
            "the P-delta effect."
        )
        yield gettext(text, corner=outcome.corner, time=outcome.first_uplift_s)
        return
    text = N_(
        "First uplift at corner {corner}, {time:.2f} s; maximum {most}, total duration {total:.2f} s; "
        "maximum contact force {ratio:.1f} times the static force."
    )
    yield gettext(
        text,
        corner=outcome.corner,
        time=outcome.first_uplift_s,
        most=format_length(outcome.max_uplift_m),
        total=outcome.uplift_duration_s,
        ratio=outcome.max_contact_force_ratio,
    )


SECTION = Section(
    title=N_("Uplift on corner springs"),
    severity=lambda outcome: min(outcome.max_uplift_m + 0.1, SEVERE - 0.1) if outcome.uplifts else 0.0,
    verdict=_short_verdict,
    sentences=_sentences,
    onset=N_("Onset of uplift at {factor:.2f} times this record."),
)
