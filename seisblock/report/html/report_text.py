"""The sentences of the report, about any effect."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.models.jump.chain import JUMPED
from seisblock.report.directions import direction_label, format_displacement, with_direction
from seisblock.report.text.respond import probability_sentence, variation_text
from seisblock.report.text.respond import verdict as told
from seisblock.report.text.rock import lean_text
from seisblock.report.units_display import format_length, format_size, length_unit
from seisblock.studies.assessment import ModelResponse

SECTIONS = {
    "respond": N_("What it does"),
    "rock": N_("Rocking and overturning"),
    "slide": N_("Sliding"),
    "jump": N_("Jump of the two-layer block"),
    "uplift": N_("Uplift from corner springs"),
}
LIMITS = N_(
    "Each model is rigid and planar but for uplift. What it does is followed with all of its motions together; the idealised models "
    "follow one motion each, by itself. Rocking is sensitive: read shares and margins before the verdict."
)

SEVERE = 2.0
"""Severity from which a body falls or jumps."""


def rank(effect: ModelResponse) -> tuple[float, float]:
    """Return what makes one direction worse than another: in what share of its versions the body falls there, then its verdict as given."""
    return _overturned_share(effect), severity(effect)


def severity_class(effects: Sequence[ModelResponse]) -> str:
    """Return the class of a card: a body that falls in any direction, one that moves or falls in some version, or neither."""
    worst = max(map(severity, effects))
    return "bad" if worst >= SEVERE else "mild" if worst > 0.0 or any(map(_overturned_share, effects)) else ""


def _overturned_share(effect: ModelResponse) -> float:
    """Return the share of versions that fall, 0 where none was followed."""
    run = effect.governing
    return 0.0 if run is None or run.probability is None else run.probability.overturned


def severity(effect: ModelResponse) -> float:
    """Return how bad an effect is: 0 nothing happens, below ``BAD`` the body moves, from there on it falls or jumps."""
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
    """Return how far from where it stood a block that jumped is in the end, m."""
    return float(effect.response.outcome.final_displacement_m)


def verdict(effect: ModelResponse) -> str:
    """Return what one model says of one direction, in a few words."""
    outcome, name = effect.response.outcome, effect.response.motion.name
    if effect.kind == "respond":
        return told(effect.response)
    if effect.kind == "rock":
        if outcome.overturned:
            return gettext("overturns to {side}", side=direction_label(name, outcome.overturned_towards))
        if outcome.rocks:
            return gettext("rocks and stands: {way}", way=lean_text(outcome.max_rotation_ratio))
        return gettext("stands still")
    if effect.kind == "slide":
        if not outcome.slips:
            return gettext("does not slide")
        if format_size(outcome.max_slip_m) != format_length(outcome.max_slip_m):
            return gettext("slides {path} in all", path=format_size(outcome.path_m))
        return gettext("slides up to {most}", most=format_length(outcome.max_slip_m))
    if effect.kind == "jump":
        if outcome.outcome == JUMPED:
            return gettext("jumps {moved}", moved=format_displacement(_jump_displacement(effect), name))
        return gettext("rocks without jumping" if outcome.chains else "stands still")
    if not outcome.uplifts:
        return gettext("no corner lifts")
    if not outcome.within_model:
        return gettext("corner {corner} lifts, how far is beyond the model", corner=outcome.corner)
    return gettext("corner {corner} lifts, up to {most}", corner=outcome.corner, most=format_length(outcome.max_uplift_m))


def sentences(effect: ModelResponse) -> Iterator[str]:
    """Yield what happened and with what margin, in words."""
    if effect.kind == "respond":
        yield from governing_text(effect)
        return
    name = effect.response.motion.name
    body = {"rock": _rock, "slide": _slide, "jump": _jump, "uplift": _uplift}[effect.kind]
    yield gettext("{name}:", name=name)
    yield from body(effect, effect.response.outcome)
    if effect.onset is not None and math.isfinite(effect.onset):
        yield gettext(_ONSETS[effect.kind], factor=effect.onset)


def governing_text(effect: ModelResponse) -> Iterator[str]:
    """Yield what the body does, how sure that is, and which friction it rests on."""
    run = effect.governing
    assert run is not None
    yield told(effect.response)
    if run.probability is not None:
        yield capitalize(probability_sentence(run.probability))
    options = effect.response.options
    if not run.friction_known:
        yield gettext("No friction was given: {mu:.2f} is taken, at which a foot hardly slips.", mu=options["mu"])


def card_text(effects: Sequence[ModelResponse]) -> tuple[str, list[str]]:
    """Return the head and the text of a body's card: the worst direction, each other one in which it may fall, what a share is worth."""
    worst, *remaining = sorted(effects, key=rank, reverse=True)
    head, *text = [*governing_text(worst), *share_caveat(worst)]
    for effect in remaining:
        if effect.response.outcome.overturned or _overturned_share(effect) > 0.0:
            text += [*governing_text(effect), *share_caveat(effect)]
    return head, list(dict.fromkeys(text))


def share_caveat(effect: ModelResponse) -> Iterator[str]:
    """Yield what it is worth that no version falls, or that all of them do."""
    if effect.governing is None or effect.governing.probability is None:
        return
    if _overturned_share(effect) == 0.0:
        yield gettext("In runs of two granite rocks on shaking tables 3 % fell where no version did.")
    elif _overturned_share(effect) == 1.0:
        yield gettext("In runs of two granite rocks on shaking tables 2 % stood where every version fell.")


def scatter_text(effects: Sequence[ModelResponse]) -> str:
    """Return what was varied in the versions of a body, as a sentence; nothing where none were followed."""
    for effect in effects:
        if effect.governing is not None and effect.governing.probability is not None:
            return gettext("Shares are {varied}.", varied=variation_text(effect.governing.probability, effect.response.body))
    return ""


def capitalize(text: str) -> str:
    """Return a text with a capital letter, where its language has them."""
    return text[:1].upper() + text[1:]


_ONSETS = {
    "rock": N_("Rocking begins at {factor:.2f} times this record."),
    "slide": N_("Sliding begins at {factor:.2f} times this record."),
    "jump": N_("The chain begins at {factor:.2f} times this record."),
    "uplift": N_("A corner just lifts at {factor:.2f} times this record."),
}


def _rock(effect: ModelResponse, outcome: Any) -> Iterator[str]:
    """Yield rocking and its margins."""
    if not outcome.rocks:
        yield gettext("The body stands still.")
    elif outcome.overturned:
        fall_time = math.nan if outcome.overturning_time_s is None else outcome.overturning_time_s
        if outcome.decided_after_record:
            text = N_("The body overturns to {side} after the record's end; it lies down at {time:.2f} s.")
        else:
            text = N_("The body overturns to {side}; it lies down at {time:.2f} s.")
        yield gettext(text, side=direction_label(effect.response.motion.name, outcome.overturned_towards), time=fall_time)
    else:
        text = N_("The body rocks from {time:.2f} s and stands; largest lean: {way}.")
        yield gettext(text, time=outcome.rocking_start_s, way=lean_text(outcome.max_rotation_ratio))
    margin = effect.margin
    if margin is not None:
        if margin.nearest_flip is None:
            yield gettext("The verdict is the same at every factor up to {limit:g}.", limit=margin.limit)
        else:
            yield gettext("The verdict changes next at {factor:.3f} times this record.", factor=margin.nearest_flip)
        first = next((window for window in margin.windows if window.overturned), None)
        if first is not None:
            yield gettext("Of the factors looked at, all below {factor:.3f} let it stand.", factor=first.first)
    if outcome.flips_at_factor is not None:
        text = (
            N_("At {factor:.3f} times this record it would stand.")
            if outcome.overturned
            else N_("At {factor:.3f} times this record it would fall.")
        )
        yield gettext(text, factor=outcome.flips_at_factor)


def _slide(effect: ModelResponse, outcome: Any) -> Iterator[str]:
    """Yield sliding."""
    if not outcome.slips:
        yield gettext("Friction holds throughout.")
        return
    unit = length_unit([outcome.max_slip_m], gal=True)
    text = N_("The body slides from {start:.2f} s, up to {most} at {time:.2f} s; {rest} remain.")
    yield gettext(
        text,
        start=outcome.slip_start_s,
        most=format_size(outcome.max_slip_m, unit),
        time=outcome.max_slip_time_s,
        rest=with_direction(format_size(outcome.residual_slip_m, unit), effect.response.motion.name, outcome.residual_slip_m),
    )


def _jump(effect: ModelResponse, outcome: Any) -> Iterator[str]:
    """Yield the chains of a jump."""
    if not outcome.chains:
        yield gettext("The ground acceleration never exceeds the rocking threshold.")
    for number, chain in enumerate(outcome.chains, start=1):
        if chain.outcome == JUMPED:
            displacement = chain.total_displacement_m or 0.0
            text = N_("Chain {number}: rocks for {rock:.3f} s, flies for {fly:.3f} s, moves {moved}; the centroid rises by {rise}.")
            yield gettext(
                text,
                number=number,
                rock=chain.rocking_duration_s,
                fly=chain.jump_duration_s,
                moved=format_displacement(displacement, effect.response.motion.name),
                rise=format_length(chain.max_rise_m or 0.0),
            )
        else:
            yield gettext("Chain {number}: {outcome}.", number=number, outcome=gettext(chain.outcome))


def _uplift(effect: ModelResponse, outcome: Any) -> Iterator[str]:
    """Yield uplift."""
    if not outcome.uplifts:
        yield gettext("No corner leaves its spring.")
        return
    if not outcome.within_model:
        text = N_(
            "Corner {corner} lifts first, at {time:.2f} s; the block then leans so far that this model, without P-delta, does not hold."
        )
        yield gettext(text, corner=outcome.corner, time=outcome.first_uplift_s)
        return
    text = N_(
        "Corner {corner} lifts first, at {time:.2f} s; up to {most}, {total:.2f} s in the air; "
        "largest force {ratio:.1f} times the static one."
    )
    yield gettext(
        text,
        corner=outcome.corner,
        time=outcome.first_uplift_s,
        most=format_length(outcome.max_uplift_m),
        total=outcome.uplift_duration_s,
        ratio=outcome.max_contact_force_ratio,
    )
