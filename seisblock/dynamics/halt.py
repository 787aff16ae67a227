"""What happens between the slices of compiled code: a run learns that nobody waits for it any more, and tells how far it is."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from contextvars import ContextVar
from threading import Event
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from seisblock.typing import Progress

_events: ContextVar[tuple[Event, ...]] = ContextVar("what halts the runs of this thread", default=())
_listener: ContextVar[Progress | None] = ContextVar("who hears how far the run of this thread is", default=None)


def halting() -> tuple[Event, ...]:
    """Return the events that halt what runs here, for the threads that it starts in its turn."""
    return _events.get()


@contextmanager
def heeding(events: tuple[Event, ...]) -> Iterator[None]:
    """Let runs inside the block, one of many, end when one of these events is set; nobody hears how far each of them is."""
    before, heard = _events.set(events), _listener.set(None)
    try:
        yield
    finally:
        _listener.reset(heard)
        _events.reset(before)


@contextmanager
def hearing(listener: Progress) -> Iterator[None]:
    """Let a run inside the block tell the intervals of the motion that it has passed, and those in all."""
    before = _listener.set(listener)
    try:
        yield
    finally:
        _listener.reset(before)


def heed() -> None:
    """End here if whoever started this run has gone.

    Raises
    ------
    CancelledError
        If an event is set.
    """
    if any(event.is_set() for event in _events.get()):
        raise CancelledError


def tell_samples(done: int, total: int) -> None:
    """Tell whoever hears it how many intervals between the samples of a motion are passed."""
    listener = _listener.get()
    if listener is not None:
        listener(done, total)
