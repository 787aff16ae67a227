"""Names of modes, outcomes and events of a full-response run, and its warnings."""

from __future__ import annotations

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.dynamics import GuardEvent
from seisblock.models.respond import constants
from seisblock.models.respond.params import RespondParams
from seisblock.models.respond.run import Run

REST, SLIDE, ROCK = N_("rest"), N_("slide"), N_("rock")
SLIDE_ROCK, FLIGHT, OVERTURNED = N_("slide-rock"), N_("flight"), N_("overturned")
"""Names of modes in tables, JSON and figures."""

STAYS_AT_REST, OVERTURNS, STILL_MOVING, ENDLESS_HOPS = N_("rests"), N_("overturns"), N_("moves on"), N_("hops without end")
"""Outcomes: no motion, overturning, still moving at the end, impact limit exceeded."""

MOTION_OUTCOMES = {
    (True, False, False): N_("slides"), (False, True, False): N_("rocks"), (False, False, True): N_("flies"),
    (True, True, False): N_("slides and rocks"), (True, False, True): N_("slides and flies"),
    (False, True, True): N_("rocks and flies"), (True, True, True): N_("slides, rocks and flies"),
}  # fmt: skip
"""Outcomes of a body that moved and did not overturn, by (slid, rocked, flew)."""


def outcome_text(run: Run, modes: set[str]) -> str:
    """Return the outcome of a run that passed through `modes`."""
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
"""Names of events by the mode that starts."""


def event_name(change: GuardEvent) -> str:
    """Return the name of an event."""
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
    """Return the warnings of a run."""
    name = body_name(params.rigid_body.name)
    impacts, jams, lowered_count = (int(run.final[state]) for state in (constants.IMPACTS, constants.JAMS, constants.RATIO_LOWERED))
    messages: list[str] = []
    if run.mode == constants.GAVE_UP:
        text = N_("{name}: run stopped at {time:.3f} s, still bouncing after {impacts} impacts; use a smaller restitution")
        messages.append(lazy_gettext(text, name=name, time=end_s, impacts=impacts))
    elif run.mode != constants.OVERTURNED and not run.ends_at_rest:
        text = N_("{name}: still in motion {time:g} s after the record; results refer to that instant")
        messages.append(lazy_gettext(text, name=name, time=settle_s))
    if params.can_jam:
        text = N_(
            "{name}: kinetic friction {friction:g} exceeds Painleve's limit {limit:.2f}, above which sliding contact can jam; jams: {jams}"
        )
        messages.append(lazy_gettext(text, name=name, friction=params.mu_kinetic, limit=params.rigid_body.friction_limit, jams=jams))
    if lowered_count:
        text = N_("{name}: rocking restitution {ratio:g} reduced in {impacts} impacts, where this value would create energy")
        messages.append(lazy_gettext(text, name=name, ratio=params.rocking_restitution, impacts=lowered_count))
    return tuple(messages)
