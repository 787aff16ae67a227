"""A signal that is heard in another way for a while, and one that is never lost."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Any

Handler = Callable[[int, FrameType | None], Any]


@contextlib.contextmanager
def taken(number: signal.Signals, handler: Handler, *, usual: Any) -> Iterator[bool]:
    """Give a signal another handler inside the block, and the usual one back behind it; the block learns whether it has it.

    It has not outside the main thread, which hears all signals, nor where somebody else took the signal before.

    Parameters
    ----------
    number : signal.Signals
        Which.
    handler : callable
        What hears it.
    usual : handler
        What hears it where nobody took it: :data:`signal.SIG_DFL`, or :func:`signal.default_int_handler`.

    Examples
    --------
    >>> with taken(signal.SIGINT, lambda number, frame: print("heard"), usual=signal.default_int_handler) as ours:
    ...     ours
    True
    >>> signal.getsignal(signal.SIGINT) is signal.default_int_handler
    True
    """
    ours = threading.current_thread() is threading.main_thread() and signal.getsignal(number) is usual
    if ours:
        signal.signal(number, handler)
    try:
        yield ours
    finally:
        if ours:
            signal.signal(number, usual)


_interrupted = False
"""Whether Ctrl-C was heard where none may be lost."""


@contextlib.contextmanager
def losing_no_interrupt() -> Iterator[None]:
    """Raise KeyboardInterrupt out of the block where Ctrl-C came inside it, whatever became of it there.

    A finalizer swallows what is raised in it; a class whose body is executed raises a RuntimeError in its place.
    """
    global _interrupted
    with taken(signal.SIGINT, _hear, usual=signal.default_int_handler) as outermost:
        try:
            yield
            if _interrupted:
                raise KeyboardInterrupt
        except Exception as error:
            if _interrupted:
                raise KeyboardInterrupt from error
            raise
        finally:
            if outermost:
                _interrupted = False


def _hear(number: int, frame: FrameType | None) -> None:
    """Take note of Ctrl-C, and do what Python does."""
    global _interrupted
    _interrupted = True
    signal.default_int_handler(number, frame)
