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
def temporary_handler(number: signal.Signals, handler: Handler, *, default: Any) -> Iterator[bool]:
    """Give a signal another handler inside the block, and the usual one back behind it; the block learns whether it has it.

    It has not outside the main thread, which hears all signals, nor where somebody else took the signal before.

    Parameters
    ----------
    number : signal.Signals
        Which.
    handler : callable
        What hears it.
    default : handler
        What hears it where nobody took it: :data:`signal.SIG_DFL`, or :func:`signal.default_int_handler`.

    Examples
    --------
    >>> with temporary_handler(signal.SIGINT, lambda number, frame: print("heard"), default=signal.default_int_handler) as ours:
    ...     ours
    True
    >>> signal.getsignal(signal.SIGINT) is signal.default_int_handler
    True
    """
    is_installed = threading.current_thread() is threading.main_thread() and signal.getsignal(number) is default
    if is_installed:
        signal.signal(number, handler)
    try:
        yield is_installed
    finally:
        if is_installed:
            signal.signal(number, default)


_interrupt_pending = False
"""Whether Ctrl-C was heard where none may be lost."""


@contextlib.contextmanager
def defer_interrupt() -> Iterator[None]:
    """Raise KeyboardInterrupt out of the block where Ctrl-C came inside it, whatever became of it there.

    A finalizer swallows what is raised in it; a class whose body is executed raises a RuntimeError in its place.
    """
    global _interrupt_pending
    with temporary_handler(signal.SIGINT, _on_interrupt, default=signal.default_int_handler) as is_outermost:
        try:
            yield
            if _interrupt_pending:
                raise KeyboardInterrupt
        except Exception as error:
            if _interrupt_pending:
                raise KeyboardInterrupt from error
            raise
        finally:
            if is_outermost:
                _interrupt_pending = False


def _on_interrupt(number: int, frame: FrameType | None) -> None:
    """Take note of Ctrl-C, and do what Python does."""
    global _interrupt_pending
    _interrupt_pending = True
    signal.default_int_handler(number, frame)
