"""What happens between the slices of compiled code: a run learns that nobody waits for it any more, and tells how far it is."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from contextvars import ContextVar
from threading import Event
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from seisblock.core.typing import Progress

_cancel_events: ContextVar[tuple[Event, ...]] = ContextVar("what halts the runs of this thread", default=())
_progress_callback: ContextVar[Progress | None] = ContextVar("who hears how far the run of this thread is", default=None)


def current_events() -> tuple[Event, ...]:
    """Return the events that halt what runs here, for the threads that it starts in its turn."""
    return _cancel_events.get()


@contextmanager
def cancel_scope(events: tuple[Event, ...]) -> Iterator[None]:
    """Let runs inside the block, one of many, end when one of these events is set; nobody hears how far each of them is."""
    events_token, progress_token = _cancel_events.set(events), _progress_callback.set(None)
    try:
        yield
    finally:
        _progress_callback.reset(progress_token)
        _cancel_events.reset(events_token)


@contextmanager
def progress_scope(callback: Progress) -> Iterator[None]:
    """Let a run inside the block tell the intervals of the motion that it has passed, and those in all."""
    token = _progress_callback.set(callback)
    try:
        yield
    finally:
        _progress_callback.reset(token)


def check_cancelled() -> None:
    """End here if whoever started this run has gone.

    Raises
    ------
    CancelledError
        If an event is set.
    """
    if any(event.is_set() for event in _cancel_events.get()):
        raise CancelledError


def report_progress(completed: int, total: int) -> None:
    """Tell whoever hears it how many intervals between the samples of a motion are passed."""
    callback = _progress_callback.get()
    if callback is not None:
        callback(completed, total)
