"""Text of rocking: a sentence and a table column per component."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from seisblock.core.i18n import N_, format_share, gettext
from seisblock.core.results import Response
from seisblock.models.respond.describe import rocking_text
from seisblock.models.rock.outcome import RockOutcome, friction_suffices
from seisblock.output.describe_wear import describe_edges
from seisblock.output.directions import direction_label
from seisblock.output.text.section import SEVERE, Section
from seisblock.output.text.tables import (
    DASH,
    acceleration_cell,
    format_acceleration,
    format_number,
    format_seconds,
    impacts_cell,
    side_by_side,
    tilt_ratio_cell,
    with_notes,
)
from seisblock.output.text.threshold import ROCKS, threshold_text
from seisblock.output.units_display import acceleration_unit

RockResponses = Sequence[Response[RockOutcome]]


def outcome_table(responses: RockResponses, *, gal: bool, empty_rows: bool = True) -> Any:
    """Return the table of the outcome, a column per direction; rows of dashes are left out without `empty_rows`."""
    outcomes = [response.outcome for response in responses]
    first, body = outcomes[0], responses[0].body
    varies = any(response.body != body for response in responses)
    title = gettext(body.name)
    if not varies:
        title = gettext(
            "{body}: alpha {alpha:.4f} rad, p {p:.3f} rad/s\nrestitution {restitution:.4f}, rocking threshold {threshold}",
            body=gettext(body.name),
            alpha=first.slenderness_rad,
            p=first.frequency_parameter_rad_s,
            restitution=first.restitution,
            threshold=format_acceleration(first.threshold_m_s2, gal=gal),
        ) + (f"\n{gettext(wear_text)}" if (wear_text := describe_edges(body, gal=gal)) else "")
    rows: list[tuple[str, list[Any]]] = _block_rows(outcomes, gal=gal) if varies else []
    rows += [
        (
            f"PGA ({acceleration_unit(gal=gal).name})",
            [acceleration_cell(float(np.abs(r.motion.horizontal).max()), gal=gal) for r in responses],
        ),
        (gettext("rocking start (s)"), [format_seconds(o.rocking_start_s) for o in outcomes]),
        (gettext("peak tilt (deg)"), [f"{math.degrees(o.max_rotation_rad):.3f}" for o in outcomes]),
        (gettext("  over alpha"), [tilt_ratio_cell(o.max_rotation_ratio, overturned=o.overturned) for o in outcomes]),
        (gettext("  at (s)"), [format_seconds(o.max_rotation_s) for o in outcomes]),
        (gettext("impacts"), [impacts_cell(o.impacts, o.max_rotation_ratio) for o in outcomes]),
        (gettext("overturned"), [_overturned_cell(response) for response in responses]),
        (gettext("  alpha exceeded (s)"), [format_seconds(o.alpha_passed_s) for o in outcomes]),
        (gettext("  overturning time (s)"), [format_seconds(o.overturning_time_s) for o in outcomes]),
        (gettext("friction required"), [format_number(o.max_friction_demand) for o in outcomes]),
        (gettext("  at (s)"), [format_seconds(o.max_friction_demand_s) for o in outcomes]),
        (gettext("contact lost (s)"), [format_seconds(o.contact_lost_s) for o in outcomes]),
    ]
    filled = [[heading, *cells] for heading, cells in rows if empty_rows or any(cell != DASH for cell in cells)]
    return side_by_side(title, ["", *(r.motion.name or "x" for r in responses)], filled)


def _block_rows(outcomes: Sequence[RockOutcome], *, gal: bool) -> list[tuple[str, list[Any]]]:
    """Return the rows of block properties for bodies that differ between directions."""
    unit = acceleration_unit(gal=gal).name
    return [
        (gettext("alpha (rad)"), [f"{o.slenderness_rad:.4f}" for o in outcomes]),
        (gettext("p (rad/s)"), [f"{o.frequency_parameter_rad_s:.3f}" for o in outcomes]),
        (gettext("restitution"), [f"{o.restitution:.4f}" for o in outcomes]),
        (gettext("threshold ({unit})", unit=unit), [acceleration_cell(o.threshold_m_s2, gal=gal) for o in outcomes]),
    ]


def _onset_text(response: Response[RockOutcome], *, gal: bool) -> str:
    """Return the rocking threshold of a block at rest."""
    options, arms = response.options, response.body.arms
    weakest = response.outcome.threshold_m_s2 / options.gravity / min(arms)
    towards = (arms[0] * weakest, arms[1] * weakest)
    return threshold_text(ROCKS, towards, response.motion, gravity=options.gravity, vertical=options.vertical, gal=gal)


def describe(response: Response[RockOutcome], mu: float | None = None, *, gal: bool = True) -> str:
    """Return the verdict, the rocking threshold of a block at rest, and a note if the friction does not suffice."""
    outcome, name = response.outcome, response.motion.name or "x"
    verdict_text = verdict(outcome, response.motion.name)
    if not outcome.rocks:
        verdict_text = gettext("{verdict}; {onset}", verdict=verdict_text, onset=_onset_text(response, gal=gal))
    sentence = gettext("{name}: {verdict}.", name=name, verdict=verdict_text)
    if mu is None or friction_suffices(outcome, mu, response.options.gravity):
        return sentence
    ratio = outcome.threshold_m_s2 / response.options.gravity
    if mu < ratio:
        text = N_(
            "With a friction coefficient of {mu:g} < b/h = {ratio:.3f} the block slides instead of rocking; this result does not apply."
        )
        return with_notes(sentence, [gettext(text, mu=mu, ratio=ratio)])
    if outcome.max_friction_demand is None:
        return with_notes(sentence, [gettext("The block leaves the ground, so no friction suffices; this result does not apply.")])
    text = N_(
        "Rocking requires a friction coefficient of {needed:.2f} at {time:.3f} s; with {mu:g} the block slides while rocking "
        "(see `respond`)."
    )
    return with_notes(sentence, [gettext(text, needed=outcome.max_friction_demand, time=outcome.max_friction_demand_s, mu=mu)])


def _overturned_cell(response: Response[RockOutcome]) -> str:
    outcome = response.outcome
    return (
        gettext("to {side}", side=direction_label(response.motion.name, outcome.overturned_towards))
        if outcome.overturned
        else gettext("no")
    )


def verdict(outcome: RockOutcome, direction: str) -> str:
    """Return the outcome of a block, and a note if a small change of the record alters the outcome."""
    direction_text = direction_label(direction, outcome.overturned_towards)
    if not outcome.rocks:
        text = gettext("remains at rest")
    elif not outcome.overturned:
        text = rocking_text(outcome.max_rotation_ratio)
    elif outcome.overturning_time_s is None:
        text = gettext("overturns to {side}", side=direction_text)
    else:
        late = outcome.decided_after_record
        template = (
            N_("overturns to {side} at {time:.2f} s, after the end of the record") if late else N_("overturns to {side} at {time:.2f} s")
        )
        text = gettext(template, side=direction_text, time=outcome.overturning_time_s)
    return text + flip_text(outcome)


def flip_text(outcome: RockOutcome) -> str:
    """Return the scale factor near 1 with the opposite outcome; empty without one."""
    if outcome.flips_at_factor is None:
        return ""
    would = N_("; does not overturn at a scale factor of {factor:.3f}"), N_("; overturns at a scale factor of {factor:.3f}")
    text = would[0] if outcome.overturned else would[1]
    return gettext(text, factor=outcome.flips_at_factor)


def lean_text(ratio: float) -> str:
    """Return the peak tilt as a share of the overturning angle."""
    return gettext("peak tilt {share} of the overturning angle", share=format_share(ratio))


def _severity(outcome: RockOutcome) -> float:
    return SEVERE + 1.0 if outcome.overturned else min(outcome.max_rotation_ratio, 1.0) if outcome.rocks else 0.0


def _short_verdict(response: Response[RockOutcome]) -> str:
    outcome = response.outcome
    if outcome.overturned:
        return gettext("overturning to {side}", side=direction_label(response.motion.name, outcome.overturned_towards))
    if outcome.rocks:
        return gettext("rocking without overturning, {way}", way=lean_text(outcome.max_rotation_ratio))
    return gettext("no motion")


def _sentences(response: Response[RockOutcome]) -> Iterator[str]:
    """Yield the outcome, and the scale factor near 1 with the opposite outcome."""
    outcome = response.outcome
    if not outcome.rocks:
        yield gettext("No motion.")
    elif outcome.overturned:
        fall_time = math.nan if outcome.overturning_time_s is None else outcome.overturning_time_s
        if outcome.decided_after_record:
            text = N_("Overturning to {side} after the end of the record, at {time:.2f} s.")
        else:
            text = N_("Overturning to {side} at {time:.2f} s.")
        yield gettext(text, side=direction_label(response.motion.name, outcome.overturned_towards), time=fall_time)
    else:
        text = N_("Rocking from {time:.2f} s without overturning; {way}.")
        yield gettext(text, time=outcome.rocking_start_s, way=lean_text(outcome.max_rotation_ratio))
    if outcome.flips_at_factor is not None:
        text = (
            N_("No overturning at {factor:.3f} times this record.")
            if outcome.overturned
            else N_("Overturning at {factor:.3f} times this record.")
        )
        yield gettext(text, factor=outcome.flips_at_factor)


SECTION = Section(
    title=N_("Rocking and overturning"),
    severity=_severity,
    verdict=_short_verdict,
    sentences=_sentences,
    onset=N_("Onset of rocking at {factor:.2f} times this record."),
    has_figure=False,
)
