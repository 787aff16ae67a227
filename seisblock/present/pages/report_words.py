"""The sentences of the report, about any effect."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.present.directions import moved, moved_by, side
from seisblock.present.scales import length_unit, told_length, told_size
from seisblock.present.text.respond import share, varied
from seisblock.present.text.respond import verdict as told
from seisblock.present.text.rock import way_to_alpha
from seisblock.solvers.jump.chain import JUMPED
from seisblock.studies.assessment import Effect
from seisblock.words import noted, tell

SECTIONS = {
    "respond": noted("What it does"),
    "rock": noted("Rocking and overturning"),
    "slide": noted("Sliding"),
    "jump": noted("Jump of the two-layer block"),
    "uplift": noted("Uplift from corner springs"),
}
LIMITS = noted(
    "Each model is rigid and planar but for uplift. What it does is followed with all of its motions together; the idealised models "
    "follow one motion each, by itself. Rocking is sensitive: read shares and margins before the verdict."
)

BAD = 2.0
"""Severity from which a body falls or jumps."""


def rank(effect: Effect) -> tuple[float, float]:
    """Return what makes one direction worse than another: in what share of its versions the body falls there, then its verdict as given."""
    return _share(effect), severity(effect)


def level(effects: Sequence[Effect]) -> str:
    """Return the class of a card: a body that falls in any direction, one that moves or falls in some version, or neither."""
    worst = max(map(severity, effects))
    return "bad" if worst >= BAD else "mild" if worst > 0.0 or any(map(_share, effects)) else ""


def _share(effect: Effect) -> float:
    """Return the share of versions that fall, 0 where none was followed."""
    found = effect.governing
    return 0.0 if found is None or found.probability is None else found.probability.overturned


def severity(effect: Effect) -> float:
    """Return how bad an effect is: 0 nothing happens, below ``BAD`` the body moves, from there on it falls or jumps."""
    outcome = effect.response.outcome
    if effect.kind == "respond":
        moved = max(outcome.max_rotation_ratio, outcome.slip_path_m)
        return BAD + 1.0 + 1.0 / (1.0 + outcome.overturning_time_s) if outcome.overturned else min(moved, BAD - 0.1)
    if effect.kind == "rock":
        return BAD + 1.0 if outcome.overturned else min(outcome.max_rotation_ratio, 1.0) if outcome.rocks else 0.0
    if effect.kind == "slide":
        return min(outcome.max_slip_m, BAD - 0.1) if outcome.slips else 0.0
    if effect.kind == "jump":
        return BAD + abs(_moved(effect)) if outcome.outcome == JUMPED else 1.0 if outcome.chains else 0.0
    return min(outcome.max_uplift_m + 0.1, BAD - 0.1) if outcome.uplifts else 0.0


def _moved(effect: Effect) -> float:
    """Return how far from where it stood a block that jumped is in the end, m."""
    return float(effect.response.outcome.final_displacement_m)


def verdict(effect: Effect) -> str:
    """Return what one model says of one direction, in a few words."""
    outcome, name = effect.response.outcome, effect.response.motion.name
    if effect.kind == "respond":
        return told(effect.response)
    if effect.kind == "rock":
        if outcome.overturned:
            return tell("overturns to {side}", side=side(name, outcome.overturned_towards))
        if outcome.rocks:
            return tell("rocks and stands: {way}", way=way_to_alpha(outcome.max_rotation_ratio))
        return tell("stands still")
    if effect.kind == "slide":
        if not outcome.slips:
            return tell("does not slide")
        if told_size(outcome.max_slip_m) != told_length(outcome.max_slip_m):
            return tell("slides {path} in all", path=told_size(outcome.path_m))
        return tell("slides up to {most}", most=told_length(outcome.max_slip_m))
    if effect.kind == "jump":
        if outcome.outcome == JUMPED:
            return tell("jumps {moved}", moved=moved_by(_moved(effect), name))
        return tell("rocks without jumping" if outcome.chains else "stands still")
    if not outcome.uplifts:
        return tell("no corner lifts")
    if not outcome.within_model:
        return tell("corner {corner} lifts, how far is beyond the model", corner=outcome.corner)
    return tell("corner {corner} lifts, up to {most}", corner=outcome.corner, most=told_length(outcome.max_uplift_m))


def sentences(effect: Effect) -> Iterator[str]:
    """Yield what happened and with what margin, in words."""
    if effect.kind == "respond":
        yield from governing(effect)
        return
    name = effect.response.motion.name
    body = {"rock": _rock, "slide": _slide, "jump": _jump, "uplift": _uplift}[effect.kind]
    yield tell("{name}:", name=name)
    yield from body(effect, effect.response.outcome)
    if effect.onset is not None and math.isfinite(effect.onset):
        yield tell(_ONSETS[effect.kind], factor=effect.onset)


def governing(effect: Effect) -> Iterator[str]:
    """Yield what the body does, how sure that is, and which friction it rests on."""
    found = effect.governing
    assert found is not None
    yield told(effect.response)
    if found.probability is not None:
        yield sentence(share(found.probability))
    options = effect.response.options
    if not found.friction_known:
        yield tell("No friction was given: {mu:.2f} is taken, at which a foot hardly slips.", mu=options["mu"])


def card(effects: Sequence[Effect]) -> tuple[str, list[str]]:
    """Return the head and the text of a body's card: the worst direction, each other one in which it may fall, what a share is worth."""
    worst, *others = sorted(effects, key=rank, reverse=True)
    head, *text = [*governing(worst), *worth(worst)]
    for other in others:
        if other.response.outcome.overturned or _share(other) > 0.0:
            text += [*governing(other), *worth(other)]
    return head, list(dict.fromkeys(text))


def worth(effect: Effect) -> Iterator[str]:
    """Yield what it is worth that no version falls, or that all of them do."""
    if effect.governing is None or effect.governing.probability is None:
        return
    if _share(effect) == 0.0:
        yield tell("In runs of two granite rocks on shaking tables 3 % fell where no version did.")
    elif _share(effect) == 1.0:
        yield tell("In runs of two granite rocks on shaking tables 2 % stood where every version fell.")


def scatter(effects: Sequence[Effect]) -> str:
    """Return what was varied in the versions of a body, as a sentence; nothing where none were followed."""
    for effect in effects:
        if effect.governing is not None and effect.governing.probability is not None:
            return tell("Shares are {varied}.", varied=varied(effect.governing.probability, effect.response.body))
    return ""


def sentence(text: str) -> str:
    """Return a text with a capital letter, where its language has them."""
    return text[:1].upper() + text[1:]


_ONSETS = {
    "rock": noted("Rocking begins at {factor:.2f} times this record."),
    "slide": noted("Sliding begins at {factor:.2f} times this record."),
    "jump": noted("The chain begins at {factor:.2f} times this record."),
    "uplift": noted("A corner just lifts at {factor:.2f} times this record."),
}


def _rock(effect: Effect, outcome: Any) -> Iterator[str]:
    """Yield rocking and its margins."""
    if not outcome.rocks:
        yield tell("The body stands still.")
    elif outcome.overturned:
        when = math.nan if outcome.overturning_time_s is None else outcome.overturning_time_s
        if outcome.decided_after_record:
            text = noted("The body overturns to {side} after the record's end; it lies down at {time:.2f} s.")
        else:
            text = noted("The body overturns to {side}; it lies down at {time:.2f} s.")
        yield tell(text, side=side(effect.response.motion.name, outcome.overturned_towards), time=when)
    else:
        text = noted("The body rocks from {time:.2f} s and stands; largest lean: {way}.")
        yield tell(text, time=outcome.rocking_start_s, way=way_to_alpha(outcome.max_rotation_ratio))
    margin = effect.margin
    if margin is not None:
        if margin.nearest_flip is None:
            yield tell("The verdict is the same at every factor up to {limit:g}.", limit=margin.limit)
        else:
            yield tell("The verdict changes next at {factor:.3f} times this record.", factor=margin.nearest_flip)
        first = next((window for window in margin.windows if window.overturned), None)
        if first is not None:
            yield tell("Of the factors looked at, all below {factor:.3f} let it stand.", factor=first.first)
    if outcome.flips_at_factor is not None:
        text = (
            noted("At {factor:.3f} times this record it would stand.")
            if outcome.overturned
            else noted("At {factor:.3f} times this record it would fall.")
        )
        yield tell(text, factor=outcome.flips_at_factor)


def _slide(effect: Effect, outcome: Any) -> Iterator[str]:
    """Yield sliding."""
    if not outcome.slips:
        yield tell("Friction holds throughout.")
        return
    unit = length_unit([outcome.max_slip_m], gal=True)
    text = noted("The body slides from {start:.2f} s, up to {most} at {time:.2f} s; {rest} remain.")
    yield tell(
        text,
        start=outcome.slip_start_s,
        most=told_size(outcome.max_slip_m, unit),
        time=outcome.max_slip_time_s,
        rest=moved(told_size(outcome.residual_slip_m, unit), effect.response.motion.name, outcome.residual_slip_m),
    )


def _jump(effect: Effect, outcome: Any) -> Iterator[str]:
    """Yield the chains of a jump."""
    if not outcome.chains:
        yield tell("The ground acceleration never exceeds the rocking threshold.")
    for number, chain in enumerate(outcome.chains, start=1):
        if chain.outcome == JUMPED:
            far = chain.total_displacement_m or 0.0
            text = noted("Chain {number}: rocks for {rock:.3f} s, flies for {fly:.3f} s, moves {moved}; the centroid rises by {rise}.")
            yield tell(
                text,
                number=number,
                rock=chain.rocking_duration_s,
                fly=chain.jump_duration_s,
                moved=moved_by(far, effect.response.motion.name),
                rise=told_length(chain.max_rise_m or 0.0),
            )
        else:
            yield tell("Chain {number}: {outcome}.", number=number, outcome=tell(chain.outcome))


def _uplift(effect: Effect, outcome: Any) -> Iterator[str]:
    """Yield uplift."""
    if not outcome.uplifts:
        yield tell("No corner leaves its spring.")
        return
    if not outcome.within_model:
        text = noted(
            "Corner {corner} lifts first, at {time:.2f} s; the block then leans so far that this model, without P-delta, does not hold."
        )
        yield tell(text, corner=outcome.corner, time=outcome.first_uplift_s)
        return
    text = noted(
        "Corner {corner} lifts first, at {time:.2f} s; up to {most}, {total:.2f} s in the air; "
        "largest force {ratio:.1f} times the static one."
    )
    yield tell(
        text,
        corner=outcome.corner,
        time=outcome.first_uplift_s,
        most=told_length(outcome.max_uplift_m),
        total=outcome.uplift_duration_s,
        ratio=outcome.max_contact_force_ratio,
    )
