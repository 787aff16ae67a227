"""Temporary signal handlers; deferred KeyboardInterrupt."""

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
    """Install a signal handler inside the block and restore the default handler after it; yield whether it was installed.

    Nothing is installed outside the main thread, where Python forbids it, or where a handler other than `default` is active, which is
    :data:`signal.SIG_DFL` or :func:`signal.default_int_handler`.

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
"""True if SIGINT arrived inside a :func:`defer_interrupt` block."""


@contextlib.contextmanager
def defer_interrupt() -> Iterator[None]:
    """Raise KeyboardInterrupt at the end of the block if SIGINT arrived inside it and was swallowed there.

    Python discards exceptions raised in finalizers, and the creation of a class replaces them by a RuntimeError.
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
    """Record the interrupt, then call Python's default handler."""
    global _interrupt_pending
    _interrupt_pending = True
    signal.default_int_handler(number, frame)
