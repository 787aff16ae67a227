"""Cancellation and progress of compiled loops, checked between slices of steps."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from contextvars import ContextVar
from threading import Event
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from seisblock.core.typing import Progress

_cancel_events: ContextVar[tuple[Event, ...]] = ContextVar("cancel_events", default=())
_progress_callback: ContextVar[Progress | None] = ContextVar("progress_callback", default=None)


def current_events() -> tuple[Event, ...]:
    """Return the cancellation events of the current context, to be passed on to worker threads."""
    return _cancel_events.get()


@contextmanager
def cancel_scope(events: tuple[Event, ...]) -> Iterator[None]:
    """Cancel runs inside the block when one of the events is set; progress of single runs is not reported."""
    events_token, progress_token = _cancel_events.set(events), _progress_callback.set(None)
    try:
        yield
    finally:
        _progress_callback.reset(progress_token)
        _cancel_events.reset(events_token)


@contextmanager
def progress_scope(callback: Progress) -> Iterator[None]:
    """Report the number of completed and of all sample intervals of the motion to a callback inside the block."""
    token = _progress_callback.set(callback)
    try:
        yield
    finally:
        _progress_callback.reset(token)


def count_samples(sample: int, record_end: int, last: int) -> tuple[int, int]:
    """Return the number of completed and of all samples of the record; after it, of the ground at rest up to `last`.

    Examples
    --------
    >>> count_samples(300, 1000, 4000), count_samples(1500, 1000, 4000)
    ((300, 1000), (500, 3000))
    """
    return (sample, record_end) if sample <= record_end else (sample - record_end, last - record_end)


def check_cancelled() -> None:
    """Raise CancelledError if the run was cancelled.

    Raises
    ------
    CancelledError
        If a cancellation event is set.
    """
    if any(event.is_set() for event in _cancel_events.get()):
        raise CancelledError


def report_progress(completed: int, total: int) -> None:
    """Report progress: pass the number of completed sample intervals to the progress callback, if any."""
    callback = _progress_callback.get()
    if callback is not None:
        callback(completed, total)
