"""Status codes of an integration: integers for kernels, an enumeration for results."""

from __future__ import annotations

from enum import IntEnum

from seisblock.core.i18n import N_


class Status(IntEnum):
    """Status code of an integration; compiled kernels return one of these and never raise."""

    RECORD_ENDED = 0
    STOPPED = 1
    TOO_MANY_EVENTS = 2
    CHATTERING = 3
    NOT_FINITE = 4
    STEP_TOO_SMALL = 5
    PAUSED = 6


RECORD_ENDED, STOPPED, TOO_MANY_EVENTS, CHATTERING, NOT_FINITE, STEP_TOO_SMALL, PAUSED = map(int, Status)
"""Status codes as plain integers. PAUSED: the allotted steps are used up; the kernel is to be called again."""

FAILURES = {
    TOO_MANY_EVENTS: N_("too many mode changes"),
    CHATTERING: N_("chattering between two modes"),
    NOT_FINITE: N_("the state is not finite"),
    STEP_TOO_SMALL: N_("the power series does not converge at the minimum step size"),
}
"""Causes of failure, by status; none of these statuses is a valid result."""
