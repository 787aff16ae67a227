"""How a run in a thread learns that nobody waits for it any more: between the slices of compiled code it heeds an event."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from contextvars import ContextVar
from threading import Event

_events: ContextVar[tuple[Event, ...]] = ContextVar("what halts the runs of this thread", default=())


def halting() -> tuple[Event, ...]:
    """Return the events that halt what runs here, for the threads that it starts in its turn."""
    return _events.get()


@contextmanager
def heeding(events: tuple[Event, ...]) -> Iterator[None]:
    """Let runs inside the block end when one of these events is set."""
    before = _events.set(events)
    try:
        yield
    finally:
        _events.reset(before)


def heed() -> None:
    """End here if whoever started this run has gone.

    Raises
    ------
    CancelledError
        If an event is set.
    """
    if any(event.is_set() for event in _events.get()):
        raise CancelledError
