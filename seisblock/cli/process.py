"""Process-level events: signals, broken pipes and exit codes."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from typing import Any, NoReturn

from seisblock.core._signals import temporary_handler

TERMINATED = 143
"""Exit code after SIGTERM (shell convention)."""


class Terminated(BaseException):
    """Raised on SIGTERM, so that temporary files are removed."""


RETRY_S = 0.3
"""Interval, s, at which a signal is raised again: finalizers and library callbacks may swallow it."""

EXIT_EXCEPTIONS: dict[signal.Signals, type[BaseException]] = {signal.SIGINT: KeyboardInterrupt, signal.SIGTERM: Terminated}
"""Termination signals and the exceptions that run the clean-up."""


@contextlib.contextmanager
def graceful_exit() -> Iterator[None]:
    """Handle SIGTERM as Ctrl-C inside the context (main thread only); restore the handlers after it."""
    received: list[signal.Signals] = []

    def end(number: int, frame: Any) -> NoReturn:
        """Raise the exception of the signal, and again should it be lost."""
        received.append(signal.Signals(number))
        if repeats:
            signal.setitimer(signal.ITIMER_REAL, RETRY_S)
        raise EXIT_EXCEPTIONS[received[0]]

    def drop(unraisable: Any) -> None:
        """Drop the report of an exception swallowed by a finalizer or callback: it is raised again."""
        if not issubclass(unraisable.exc_type, tuple(EXIT_EXCEPTIONS.values())):
            default_hook(unraisable)

    default_hook = sys.unraisablehook
    with contextlib.ExitStack() as stack:
        sys.unraisablehook = drop
        stack.callback(setattr, sys, "unraisablehook", default_hook)
        repeats = hasattr(signal, "SIGALRM") and stack.enter_context(temporary_handler(signal.SIGALRM, end, default=signal.SIG_DFL))
        stack.enter_context(temporary_handler(signal.SIGTERM, end, default=signal.SIG_DFL))
        stack.enter_context(temporary_handler(signal.SIGINT, end, default=signal.default_int_handler))
        try:
            yield
        except Exception as error:
            if received:  # class creation during an import wraps exceptions into a RuntimeError
                raise EXIT_EXCEPTIONS[received[0]] from error
            raise
        finally:
            if repeats:
                signal.setitimer(signal.ITIMER_REAL, 0.0)


def fast_exit(code: int) -> NoReturn:
    """Exit without interpreter shutdown, whose clean-up of libraries takes seconds."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)


@contextlib.contextmanager
def safe_streams() -> Iterator[None]:
    """Replace a closed stdout by a null stream, and characters that the encoding lacks by a placeholder."""
    with contextlib.ExitStack() as stack:
        for name in ("stdout", "stderr"):
            stream = getattr(sys, name)
            if stream is None:
                void = stack.enter_context(open(os.devnull, "w", encoding="utf-8"))  # noqa: PTH123
                setattr(sys, name, void)
                stack.callback(setattr, sys, name, None)
            elif hasattr(stream, "reconfigure") and (stream.errors == "strict" or _rejects_unicode(stream)):
                stack.callback(stream.reconfigure, errors=stream.errors)
                stream.reconfigure(errors="replace")
        yield


def _rejects_unicode(stream: Any) -> bool:
    """Return whether the surrogateescape stream of the C locale rejects letters as a strict one does."""
    return stream.errors == "surrogateescape" and "utf" not in stream.encoding.lower()


def discard_stdout() -> None:
    """Redirect stdout to a null stream: buffered data could not be written either."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
