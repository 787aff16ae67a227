"""What a run means in words: modes, outcomes, events, and what one should know before believing the numbers."""

from __future__ import annotations

from seisblock.bodies.called import said_name
from seisblock.dynamics import Change
from seisblock.solvers.respond import names
from seisblock.solvers.respond.run import Run
from seisblock.solvers.respond.setting import Setting
from seisblock.words import noted, said

REST, SLIDE, ROCK = noted("rest"), noted("slide"), noted("rock")
SLIDE_ROCK, FLIGHT, OVERTURNED = noted("slide-rock"), noted("flight"), noted("overturned")
"""Modes, as users, documents and figures name them."""

RESTS, OVERTURNS, MOVES_ON, HOPS_ON = noted("rests"), noted("overturns"), noted("moves on"), noted("hops without end")
"""Outcomes of a body that never moved, that fell, that time or patience left in motion."""

MOVED = {
    (True, False, False): noted("slides"), (False, True, False): noted("rocks"), (False, False, True): noted("flies"),
    (True, True, False): noted("slides and rocks"), (True, False, True): noted("slides and flies"),
    (False, True, True): noted("rocks and flies"), (True, True, True): noted("slides, rocks and flies"),
}  # fmt: skip
"""Outcomes of a body that has moved and stands: whether it slid, rocked, flew."""


def in_words(run: Run, seen: set[str]) -> str:
    """Say in a word or two what a body did that was seen in these modes."""
    if run.mode == names.OVERTURNED:
        return OVERTURNS
    if run.mode == names.GAVE_UP:
        return HOPS_ON
    if not run.settles:
        return MOVES_ON
    did = (bool({SLIDE, SLIDE_ROCK} & seen), bool({ROCK, SLIDE_ROCK} & seen), FLIGHT in seen)
    return MOVED[did] if any(did) else RESTS


BEGINS = {
    REST: noted("comes to rest"), SLIDE: noted("slides"), ROCK: noted("rocks"), SLIDE_ROCK: noted("slides while rocking"),
    FLIGHT: noted("lifts off"),
}  # fmt: skip
"""Names of events by the mode that begins."""


def event_name(change: Change) -> str:
    """Return what happened."""
    if change.target == names.OVERTURNED:
        return noted("overturns")
    if change.target == names.GAVE_UP:
        return noted("is given up")
    if change.guard == names.RELEASE:
        return noted("leaves the tenons") if change.target == names.FLIGHT else noted("lifts one foot over its tenon")
    if change.after[names.IMPACTS] > change.before[names.IMPACTS]:
        return noted("landing") if change.source % names.HELD == names.FLIGHT else noted("impact")
    return BEGINS[names.MODES[change.target]]


def warnings(run: Run, setting: Setting, end_s: float, settle_s: float) -> tuple[str, ...]:
    """Return what the user should know before believing the numbers."""
    name = said_name(setting.stand.name)
    impacts, jams, lowered = (int(run.final[state]) for state in (names.IMPACTS, names.JAMS, names.LOWERED))
    found: list[str] = []
    if run.mode == names.GAVE_UP:
        text = noted("{name}: given up at {time:.3f} s after {impacts} impacts: it hops without end; lower the restitution")
        found.append(said(text, name=name, time=end_s, impacts=impacts))
    elif run.mode != names.OVERTURNED and not run.settles:
        text = noted("{name}: still in motion {time:g} s after the record; what is given is the state then")
        found.append(said(text, name=name, time=settle_s))
    if setting.may_jam:
        text = noted(
            "{name}: kinetic friction {friction:g} is above {limit:.2f}, where a slipping rigid body may jam (Painleve); jams: {jams}"
        )
        found.append(said(text, name=name, friction=setting.mu_kinetic, limit=setting.stand.friction_limit, jams=jams))
    if lowered:
        text = noted("{name}: the rocking restitution {ratio:g} would have created energy in {impacts} impacts and was lowered there")
        found.append(said(text, name=name, ratio=setting.rocking_restitution, impacts=lowered))
    return tuple(found)
