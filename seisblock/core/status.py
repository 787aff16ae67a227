"""How an integration ended: the one list of statuses, for kernels (integers) and for answers (an enumeration)."""

from __future__ import annotations

from enum import IntEnum

from seisblock.core.i18n import N_


class Status(IntEnum):
    """How an integration ended; every compiled kernel returns one of these, never an exception."""

    RECORD_ENDED = 0
    STOPPED = 1
    TOO_MANY_EVENTS = 2
    CHATTERING = 3
    NOT_FINITE = 4
    STEP_TOO_SMALL = 5
    PAUSED = 6


RECORD_ENDED, STOPPED, TOO_MANY_EVENTS, CHATTERING, NOT_FINITE, STEP_TOO_SMALL, PAUSED = map(int, Status)
"""The same as plain integers. PAUSED is no end: the allowance of steps is used up, and the kernel wants to be called again."""

FAILURES = {
    TOO_MANY_EVENTS: N_("it changes its mode without end"),
    CHATTERING: N_("two modes return to each other at one instant"),
    NOT_FINITE: N_("its state overflows"),
    STEP_TOO_SMALL: N_("its power series does not converge on any step"),
}
"""Statuses that are no answer, in words."""
