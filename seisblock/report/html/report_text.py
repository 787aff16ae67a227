"""Sentences of the HTML report on the response of one model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext, join_list
from seisblock.models.jump.chain import JUMPED
from seisblock.report.directions import direction_label, format_displacement, with_direction
from seisblock.report.text.respond import probability_sentence, variation_text
from seisblock.report.text.respond import verdict as respond_verdict
from seisblock.report.text.rock import lean_text
from seisblock.report.units_display import format_length, format_size, length_unit
from seisblock.studies.assessment import ModelResponse

SECTIONS = {
    "respond": N_("Full response"),
    "rock": N_("Rocking and overturning"),
    "slide": N_("Sliding"),
    "jump": N_("Jump of the two-layer block"),
    "uplift": N_("Uplift on corner springs"),
}
LIMITS = N_(
    "All models are rigid and plane, except uplift. The full response combines rest, sliding, rocking and flight; the idealised models "
    "have one mode of motion each. Rocking is sensitive to small changes of the input: rely on probabilities and margins rather than on "
    "a single result."
)

SEVERE = 2.0
"""Severity of overturning and of a jump."""


def rank(effect: ModelResponse) -> tuple[float, float]:
    """Return the sort key of severity of a direction: overturning probability, then severity of the nominal body."""
    return _overturned_share(effect), severity(effect)


def severity_class(effects: Sequence[ModelResponse]) -> str:
    """Return the CSS class of a card: ``bad`` for overturning, ``mild`` for motion or overturning of some sample, else empty."""
    worst = max(map(severity, effects))
    return "bad" if worst >= SEVERE else "mild" if worst > 0.0 or any(map(_overturned_share, effects)) else ""


def _overturned_share(effect: ModelResponse) -> float:
    """Return the overturning probability, 0 without samples."""
    run = effect.governing
    return 0.0 if run is None or run.probability is None else run.probability.overturned


def severity(effect: ModelResponse) -> float:
    """Return the severity of a response: 0 no motion, below :data:`SEVERE` motion, from there on overturning or a jump."""
    outcome = effect.response.outcome
    if effect.kind == "respond":
        motion_measure = max(outcome.max_rotation_ratio, outcome.slip_path_m)
        return SEVERE + 1.0 + 1.0 / (1.0 + outcome.overturning_time_s) if outcome.overturned else min(motion_measure, SEVERE - 0.1)
    if effect.kind == "rock":
        return SEVERE + 1.0 if outcome.overturned else min(outcome.max_rotation_ratio, 1.0) if outcome.rocks else 0.0
    if effect.kind == "slide":
        return min(outcome.max_slip_m, SEVERE - 0.1) if outcome.slips else 0.0
    if effect.kind == "jump":
        return SEVERE + abs(_jump_displacement(effect)) if outcome.outcome == JUMPED else 1.0 if outcome.chains else 0.0
    return min(outcome.max_uplift_m + 0.1, SEVERE - 0.1) if outcome.uplifts else 0.0


def _jump_displacement(effect: ModelResponse) -> float:
    """Return the residual displacement of a jump, m."""
    return float(effect.response.outcome.final_displacement_m)


def verdict(effect: ModelResponse) -> str:
    """Return the result of one model in one direction as a short text."""
    outcome, name = effect.response.outcome, effect.response.motion.name
    if effect.kind == "respond":
        return respond_verdict(effect.response)
    if effect.kind == "rock":
        if outcome.overturned:
            return gettext("overturning to {side}", side=direction_label(name, outcome.overturned_towards))
        if outcome.rocks:
            return gettext("rocking without overturning, {way}", way=lean_text(outcome.max_rotation_ratio))
        return gettext("no motion")
    if effect.kind == "slide":
        if not outcome.slips:
            return gettext("no sliding")
        if format_size(outcome.max_slip_m) != format_length(outcome.max_slip_m):
            return gettext("total sliding path {path}", path=format_size(outcome.path_m))
        return gettext("maximum sliding displacement {most}", most=format_length(outcome.max_slip_m))
    if effect.kind == "jump":
        if outcome.outcome == JUMPED:
            return gettext("jump, displacement {moved}", moved=format_displacement(_jump_displacement(effect), name))
        return gettext("rocking without jump" if outcome.chains else "no motion")
    if not outcome.uplifts:
        return gettext("no uplift")
    if not outcome.within_model:
        return gettext("uplift of corner {corner} beyond the range of the model", corner=outcome.corner)
    return gettext("uplift of corner {corner}, maximum {most}", corner=outcome.corner, most=format_length(outcome.max_uplift_m))


def sentences(effect: ModelResponse) -> Iterator[str]:
    """Yield sentences on the response and its margin."""
    if effect.kind == "respond":
        yield from governing_text(effect)
        return
    name = effect.response.motion.name
    body = {"rock": _rock, "slide": _slide, "jump": _jump, "uplift": _uplift}[effect.kind]
    first, *remaining = body(effect, effect.response.outcome)
    yield gettext("{name}: {text}", name=name, text=decapitalize(first))
    yield from remaining
    if effect.onset is not None and math.isfinite(effect.onset):
        yield gettext(_ONSETS[effect.kind], factor=effect.onset)


def governing_text(effect: ModelResponse, *, name: str = "") -> Iterator[str]:
    """Yield sentences on the full response, its probability, and an assumed friction; `name` replaces the component at the begin."""
    run = effect.governing
    assert run is not None
    yield respond_verdict(effect.response, name=name)
    if run.probability is not None:
        yield capitalize(probability_sentence(run.probability))
    options = effect.response.options
    if not run.friction_known:
        yield gettext("Friction coefficient assumed: {mu:.2f} (none given; almost no sliding).", mu=options["mu"])


def card_text(effects: Sequence[ModelResponse], body: str = "") -> tuple[str, list[str]]:
    """Return head and text of the card of a body: worst component, other components with possible overturning, caveats."""
    worst, *remaining = sorted(effects, key=rank, reverse=True)
    head, *text = [*governing_text(worst, name=join_list(filter(None, (body, worst.response.motion.name)))), *share_caveat(worst)]
    for effect in remaining:
        if effect.response.outcome.overturned or _overturned_share(effect) > 0.0:
            text += [*governing_text(effect), *share_caveat(effect)]
    return head, list(dict.fromkeys(text))


def share_caveat(effect: ModelResponse) -> Iterator[str]:
    """Yield the observed error rate of predictions with no or all samples overturned."""
    if effect.governing is None or effect.governing.probability is None:
        return
    if _overturned_share(effect) == 0.0:
        yield gettext("In shaking-table runs of two granite rocks, 3 % of those predicted 0/20 overturned.")
    elif _overturned_share(effect) == 1.0:
        yield gettext("In shaking-table runs of two granite rocks, 2 % of those predicted 20/20 did not overturn.")


def scatter_text(effects: Sequence[ModelResponse]) -> str:
    """Return the varied parameters of the samples as a sentence, empty without samples."""
    for effect in effects:
        if effect.governing is not None and effect.governing.probability is not None:
            return variation_text(effect.governing.probability, effect.response.body)
    return ""


def decapitalize(text: str) -> str:
    """Return a text with an initial small letter, for use after a colon."""
    return text[:1].lower() + text[1:]


def capitalize(text: str) -> str:
    """Return a text with an initial capital."""
    return text[:1].upper() + text[1:]


_ONSETS = {
    "rock": N_("Onset of rocking at {factor:.2f} times this record."),
    "slide": N_("Onset of sliding at {factor:.2f} times this record."),
    "jump": N_("Onset of rocking and jump at {factor:.2f} times this record."),
    "uplift": N_("Onset of uplift at {factor:.2f} times this record."),
}


def _rock(effect: ModelResponse, outcome: Any) -> Iterator[str]:
    """Yield sentences on rocking and its margins."""
    if not outcome.rocks:
        yield gettext("No motion.")
    elif outcome.overturned:
        fall_time = math.nan if outcome.overturning_time_s is None else outcome.overturning_time_s
        if outcome.decided_after_record:
            text = N_("Overturning to {side} after the end of the record, at {time:.2f} s.")
        else:
            text = N_("Overturning to {side} at {time:.2f} s.")
        yield gettext(text, side=direction_label(effect.response.motion.name, outcome.overturned_towards), time=fall_time)
    else:
        text = N_("Rocking from {time:.2f} s without overturning; {way}.")
        yield gettext(text, time=outcome.rocking_start_s, way=lean_text(outcome.max_rotation_ratio))
    margin = effect.margin
    if margin is not None:
        if margin.nearest_flip is None:
            yield gettext("Same result at all scale factors up to {limit:g}.", limit=margin.limit)
        else:
            yield gettext("Nearest change of the result at scale factor {factor:.3f}.", factor=margin.nearest_flip)
        first = next((window for window in margin.windows if window.overturned), None)
        if first is not None:
            yield gettext("No overturning at the scale factors examined below {factor:.3f}.", factor=first.first)
    if outcome.flips_at_factor is not None:
        text = (
            N_("No overturning at {factor:.3f} times this record.")
            if outcome.overturned
            else N_("Overturning at {factor:.3f} times this record.")
        )
        yield gettext(text, factor=outcome.flips_at_factor)


def _slide(effect: ModelResponse, outcome: Any) -> Iterator[str]:
    """Yield sentences on sliding."""
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
        rest=with_direction(format_size(outcome.residual_slip_m, unit), effect.response.motion.name, outcome.residual_slip_m),
    )


def _jump(effect: ModelResponse, outcome: Any) -> Iterator[str]:
    """Yield sentences on each rocking-jump sequence."""
    if not outcome.chains:
        yield gettext("The ground acceleration does not exceed the rocking threshold.")
    unit = length_unit((length for chain in outcome.chains for length in (chain.total_displacement_m, chain.max_rise_m)), gal=True)
    for number, chain in enumerate(outcome.chains, start=1):
        if chain.outcome == JUMPED:
            displacement = chain.total_displacement_m or 0.0
            text = N_("Chain {number}, rocking {rock:.3f} s, flight {fly:.3f} s, displacement {moved}, rise of the centroid {rise}.")
            yield gettext(
                text,
                number=number,
                rock=chain.rocking_duration_s,
                fly=chain.jump_duration_s,
                moved=format_displacement(displacement, effect.response.motion.name, unit),
                rise=format_length(chain.max_rise_m or 0.0, unit),
            )
        else:
            yield gettext("Chain {number}, {outcome}.", number=number, outcome=gettext(chain.outcome))


def _uplift(effect: ModelResponse, outcome: Any) -> Iterator[str]:
    """Yield sentences on uplift."""
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
