"""How a run ends when something outside it does: the terminal, the disk, another program."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from typing import Any, NoReturn

from seisblock.core._signals import temporary_handler

TERMINATED = 143
"""Exit code after SIGTERM, as shells have it."""


class Terminated(BaseException):
    """Somebody asked the program to end: temporary files go, the old ones stay."""


RETRY_S = 0.3
"""After so long what asked the program to end asks again: finalizers and callbacks of libraries swallow what is raised in them."""

EXIT_EXCEPTIONS: dict[signal.Signals, type[BaseException]] = {signal.SIGINT: KeyboardInterrupt, signal.SIGTERM: Terminated}
"""What asks a program to end, as the exception that lets everything clean up behind itself."""


@contextlib.contextmanager
def graceful_exit() -> Iterator[None]:
    """End on SIGTERM as on Ctrl-C inside the block; in the main thread of a program only, and nothing is left behind."""
    received: list[signal.Signals] = []

    def end(number: int, frame: Any) -> NoReturn:
        """Raise what ends the program, and see to it that it is raised again should it be lost."""
        received.append(signal.Signals(number))
        if repeats:
            signal.setitimer(signal.ITIMER_REAL, RETRY_S)
        raise EXIT_EXCEPTIONS[received[0]]

    def drop(unraisable: Any) -> None:
        """Say nothing of an end that a finalizer or a callback swallowed: it comes again."""
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
            if received:  # a class whose body is executed, in any import, makes a RuntimeError of what is raised in it
                raise EXIT_EXCEPTIONS[received[0]] from error
            raise
        finally:
            if repeats:
                signal.setitimer(signal.ITIMER_REAL, 0.0)


def fast_exit(code: int) -> NoReturn:
    """End the process without taking it apart: freeing the libraries takes longer than somebody who pressed Ctrl-C waits."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)


@contextlib.contextmanager
def safe_streams() -> Iterator[None]:
    """Give a run that has no stdout (``>&-``) one that takes everything, and one in Latin-1 or ASCII a sign for what it cannot write."""
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
    """Whether a stream of the C locale, which passes on bytes that it could not read, refuses letters as a strict one does."""
    return stream.errors == "surrogateescape" and "utf" not in stream.encoding.lower()


def discard_stdout() -> None:
    """Let nothing more reach stdout: what is still held there could not be written either."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
