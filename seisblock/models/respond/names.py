"""Names of modes, outcomes and events of a full-response run, and its warnings."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import N_, Term, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.criteria.initiation import Mode
from seisblock.dynamics import GuardEvent
from seisblock.models.respond import constants
from seisblock.models.respond.params import RespondParams
from seisblock.models.respond.run import is_rest


class OutcomeName(Term):
    """Outcomes of a run: no motion, the modes of a body that stays upright, overturning, or no end of the motion."""

    RESTS = N_("rests")
    SLIDES = N_("slides")
    ROCKS = N_("rocks")
    FLIES = N_("flies")
    SLIDES_ROCKS = N_("slides and rocks")
    SLIDES_FLIES = N_("slides and flies")
    ROCKS_FLIES = N_("rocks and flies")
    SLIDES_ROCKS_FLIES = N_("slides, rocks and flies")
    OVERTURNS = N_("overturns")
    STILL_MOVING = N_("still moving")
    """Still moving at the end of the analysis."""
    STILL_BOUNCING = N_("still bouncing")
    """Stopped at the limit of impacts."""


MOTION_OUTCOMES = {
    (False, False, False): OutcomeName.RESTS,
    (True, False, False): OutcomeName.SLIDES, (False, True, False): OutcomeName.ROCKS, (False, False, True): OutcomeName.FLIES,
    (True, True, False): OutcomeName.SLIDES_ROCKS, (True, False, True): OutcomeName.SLIDES_FLIES,
    (False, True, True): OutcomeName.ROCKS_FLIES, (True, True, True): OutcomeName.SLIDES_ROCKS_FLIES,
}  # fmt: skip
"""Outcomes of a body that did not overturn, by (slid, rocked, flew)."""


def outcome_name(mode: int, modes: Collection[str]) -> OutcomeName:
    """Return the outcome of a run that ended in `mode` and passed through `modes`."""
    if mode == constants.OVERTURNED:
        return OutcomeName.OVERTURNS
    if mode == constants.GAVE_UP:
        return OutcomeName.STILL_BOUNCING
    if not is_rest(mode):
        return OutcomeName.STILL_MOVING
    slid, rocked = (mode in modes or Mode.SLIDE_ROCK in modes for mode in (Mode.SLIDE, Mode.ROCK))
    return MOTION_OUTCOMES[slid, rocked, Mode.FLIGHT in modes]


MODE_EVENT_NAMES = {
    Mode.REST: N_("comes to rest"), Mode.SLIDE: N_("slides"), Mode.ROCK: N_("rocks"), Mode.SLIDE_ROCK: N_("slides while rocking"),
    Mode.FLIGHT: N_("lifts off"),
}  # fmt: skip
"""Names of events by the mode that starts."""


def event_name(change: GuardEvent) -> str:
    """Return the name of an event."""
    if change.target == constants.OVERTURNED:
        return N_("overturns")
    if change.target == constants.GAVE_UP:
        return N_("calculation stopped")
    if change.guard == constants.RELEASE:
        return N_("leaves the mortises") if change.target == constants.FLIGHT else N_("lifts one foot out of its mortise")
    if change.after[constants.IMPACTS] > change.before[constants.IMPACTS]:
        return N_("landing") if change.source % constants.TENON_OFFSET == constants.FLIGHT else N_("impact")
    return MODE_EVENT_NAMES[Mode(constants.MODES[change.target])]


def run_warnings(mode: int, final: Sequence[float] | FloatArray, params: RespondParams, end_s: float, settle_s: float) -> tuple[str, ...]:
    """Return the warnings of a run that ended in a mode and a state."""
    name = body_name(params.rigid_body.name)
    impacts, jams, lowered_count = (int(final[state]) for state in (constants.IMPACTS, constants.JAMS, constants.RATIO_LOWERED))
    messages: list[str] = []
    if mode == constants.GAVE_UP:
        text = N_("{name}: run stopped at {time:.3f} s, still bouncing after {impacts} impacts; use a smaller `restitution`")
        messages.append(lazy_gettext(text, name=name, time=end_s, impacts=impacts))
    elif mode != constants.OVERTURNED and not is_rest(mode):
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
