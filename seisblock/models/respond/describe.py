"""What a run means in words: modes, outcomes, events, and what one should know before believing the numbers."""

from __future__ import annotations

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.dynamics import GuardEvent
from seisblock.models.respond import constants
from seisblock.models.respond.params import RespondParams
from seisblock.models.respond.run import Run

REST, SLIDE, ROCK = N_("rest"), N_("slide"), N_("rock")
SLIDE_ROCK, FLIGHT, OVERTURNED = N_("slide-rock"), N_("flight"), N_("overturned")
"""Modes, as users, documents and figures name them."""

STAYS_AT_REST, OVERTURNS, STILL_MOVING, ENDLESS_HOPS = N_("rests"), N_("overturns"), N_("moves on"), N_("hops without end")
"""Outcomes of a body that never moved, that fell, that time or patience left in motion."""

MOTION_OUTCOMES = {
    (True, False, False): N_("slides"), (False, True, False): N_("rocks"), (False, False, True): N_("flies"),
    (True, True, False): N_("slides and rocks"), (True, False, True): N_("slides and flies"),
    (False, True, True): N_("rocks and flies"), (True, True, True): N_("slides, rocks and flies"),
}  # fmt: skip
"""Outcomes of a body that has moved and stands: whether it slid, rocked, flew."""


def outcome_text(run: Run, modes: set[str]) -> str:
    """Say in a word or two what a body did that was seen in these modes."""
    if run.mode == constants.OVERTURNED:
        return OVERTURNS
    if run.mode == constants.GAVE_UP:
        return ENDLESS_HOPS
    if not run.ends_at_rest:
        return STILL_MOVING
    motions = (bool({SLIDE, SLIDE_ROCK} & modes), bool({ROCK, SLIDE_ROCK} & modes), FLIGHT in modes)
    return MOTION_OUTCOMES[motions] if any(motions) else STAYS_AT_REST


MODE_EVENT_NAMES = {
    REST: N_("comes to rest"), SLIDE: N_("slides"), ROCK: N_("rocks"), SLIDE_ROCK: N_("slides while rocking"),
    FLIGHT: N_("lifts off"),
}  # fmt: skip
"""Names of events by the mode that begins."""


def event_name(change: GuardEvent) -> str:
    """Return what happened."""
    if change.target == constants.OVERTURNED:
        return N_("overturns")
    if change.target == constants.GAVE_UP:
        return N_("is given up")
    if change.guard == constants.RELEASE:
        return N_("leaves the tenons") if change.target == constants.FLIGHT else N_("lifts one foot over its tenon")
    if change.after[constants.IMPACTS] > change.before[constants.IMPACTS]:
        return N_("landing") if change.source % constants.TENON_OFFSET == constants.FLIGHT else N_("impact")
    return MODE_EVENT_NAMES[constants.MODES[change.target]]


def run_warnings(run: Run, params: RespondParams, end_s: float, settle_s: float) -> tuple[str, ...]:
    """Return what the user should know before believing the numbers."""
    name = body_name(params.rigid_body.name)
    impacts, jams, lowered_count = (int(run.final[state]) for state in (constants.IMPACTS, constants.JAMS, constants.RATIO_LOWERED))
    messages: list[str] = []
    if run.mode == constants.GAVE_UP:
        text = N_("{name}: given up at {time:.3f} s after {impacts} impacts: it hops without end; lower the restitution")
        messages.append(lazy_gettext(text, name=name, time=end_s, impacts=impacts))
    elif run.mode != constants.OVERTURNED and not run.ends_at_rest:
        text = N_("{name}: still in motion {time:g} s after the record; what is given is the state then")
        messages.append(lazy_gettext(text, name=name, time=settle_s))
    if params.can_jam:
        text = N_(
            "{name}: kinetic friction {friction:g} is above {limit:.2f}, where a slipping rigid body may jam (Painleve); jams: {jams}"
        )
        messages.append(lazy_gettext(text, name=name, friction=params.mu_kinetic, limit=params.rigid_body.friction_limit, jams=jams))
    if lowered_count:
        text = N_("{name}: the rocking restitution {ratio:g} would have created energy in {impacts} impacts and was lowered there")
        messages.append(lazy_gettext(text, name=name, ratio=params.rocking_restitution, impacts=lowered_count))
    return tuple(messages)
