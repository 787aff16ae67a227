"""Text report of rocking: a sentence and a table column per component."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from seisblock.core.i18n import N_, format_share, gettext
from seisblock.core.results import Response
from seisblock.models.rock.outcome import RockOutcome, friction_suffices
from seisblock.report.describe_wear import describe_edges
from seisblock.report.directions import direction_label
from seisblock.report.text.model_comparison import agreement_part, perturbation_lines
from seisblock.report.text.respond import direction_sentence, fall_azimuth, rocking_text
from seisblock.report.text.shaking import shaking_lines
from seisblock.report.text.tables import (
    DASH,
    Part,
    acceleration_cell,
    details,
    format_acceleration,
    format_number,
    format_seconds,
    group_answers,
    side_by_side,
    styled_line,
    table,
    tilt_ratio_cell,
    with_notes,
)
from seisblock.report.text.threshold import ROCKS, threshold_text
from seisblock.report.units_display import acceleration_unit
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.rocking.margin import Margin

MAX_INTERVALS = 8
"""Most intervals of overturning listed."""

RockResponses = Sequence[Response[RockOutcome]]


def tables(responses: RockResponses, extras: Sequence[Mapping[str, Any]], *, gal: bool, mu: float | None = None) -> Iterator[Any]:
    """Yield, per record, the verdicts, a table with a column per component, and margins and probabilities.

    Parameters
    ----------
    responses : sequence of Response
    extras : sequence of mapping
        Further results of each: ``agreement``, ``margin``, ``perturbation``, ``directions``.
    gal : bool
    mu : float or None
        Available friction coefficient; None if not given.
    """
    pairs = zip(responses, extras, strict=True)
    for heading, part in group_answers(
        pairs, lambda pair: pair[0].motion.record, lambda pair: [styled_line(describe(pair[0], mu, gal=gal))]
    ):
        yield from heading
        selected = [response for response, _ in part]
        outcome_table = _outcome_table(selected, gal=gal)
        has_margin = any("margin" in extra for _, extra in part)
        yield Part((outcome_table,), (_outcome_table(selected, gal=gal, empty_rows=False),)) if has_margin else outcome_table
        yield from shaking_lines([r for r, _ in part], gal=gal)
        for response, extra in part:
            yield from sentences(response, extra)
        yield styled_line()
        for _, extra in part:
            if "directions" in extra:
                yield details(_direction_table(extra["directions"]))


def _outcome_table(responses: RockResponses, *, gal: bool, empty_rows: bool = True) -> Any:
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
        (gettext("impacts"), [o.impacts for o in outcomes]),
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


def _direction_table(results: Sequence[RockAzimuth]) -> Any:
    """Return the table of all azimuths, ascending; with the slenderness if it varies."""
    slenderness_varies = len({result.slenderness_rad for result in results}) > 1
    rows = [
        [
            f"{result.azimuth_deg:g}",
            *([f"{math.degrees(result.slenderness_rad):.2f}"] if slenderness_varies else []),
            tilt_ratio_cell(result.max_rotation_ratio, overturned=result.overturned_towards is not None),
            *_fall_cells(result),
        ]
        for result in sorted(results, key=lambda result: result.azimuth_deg)
    ]
    headings = (
        N_("azimuth (deg)"),
        *((N_("alpha (deg)"),) if slenderness_varies else ()),
        N_("tilt/alpha"),
        N_("overturns to (deg)"),
        N_("overturning time (s)"),
    )
    return table(gettext("All azimuths"), [gettext(heading) for heading in headings], rows)


def _fall_cells(result: RockAzimuth) -> tuple[str, str]:
    return fall_azimuth(result.azimuth_deg, result.overturned_towards), format_seconds(result.overturning_time_s)


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


def sentences(response: Response[RockOutcome], extra: Mapping[str, Any]) -> Iterator[Any]:
    """Yield model comparison, margins and overturning probability; their intervals and samples are details."""
    name = response.motion.name or "x"
    if "agreement" in extra:
        yield agreement_part(name, extra["agreement"], is_short="margin" in extra)
    if "directions" in extra:
        yield styled_line(direction_sentence(extra["directions"]))
    answers = [_margin_lines(extra["margin"])] if "margin" in extra else []
    answers += [perturbation_lines(extra["perturbation"], response.body)] if "perturbation" in extra else []
    for texts in answers:
        first, *others = (styled_line(gettext("{name}: {text}", name=name, text=text)) for text in texts)
        yield first
        yield from map(details, others)


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


def _margin_lines(margin: Margin) -> Iterable[str]:
    """Yield the first factor with overturning, the share above, and the intervals of overturning."""
    if margin.first_fall is None or margin.falls_above_first is None:
        yield gettext("no overturning at scale factors up to {limit:g} (steps of {step:g}).", limit=margin.limit, step=margin.step)
        return
    yield gettext(
        "scale factor to overturning {first:.3g} (smallest of the factors up to {limit:g} in steps of {step:g}); of the larger "
        "factors {share:.0%} overturn the block.",
        first=margin.first_fall,
        step=margin.step,
        limit=margin.limit,
        share=margin.falls_above_first,
    )
    unsafe = [window for window in margin.windows if window.overturned]
    intervals = [gettext("{first:.4f} to {last:.4f}", first=w.first, last=w.last) for w in unsafe[:MAX_INTERVALS]]
    if len(unsafe) > MAX_INTERVALS:
        intervals.append(gettext("and {count} more intervals", count=len(unsafe) - MAX_INTERVALS))
    yield gettext("overturning at scale factors {factors}.", factors=intervals)
    if margin.nearest_flip is not None:
        yield gettext("the result changes at a scale factor of {factor:.4f} (the nearest to 1 found).", factor=margin.nearest_flip)
