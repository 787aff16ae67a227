"""How a run ends when something outside it does: the terminal, the disk, another program."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from typing import Any, NoReturn

from seisblock.signals import taken

TERMINATED = 143
"""Exit code after SIGTERM, as shells have it."""


class Terminated(BaseException):
    """Somebody asked the program to end: temporary files go, the old ones stay."""


def _terminate(number: int, frame: Any) -> NoReturn:
    """Turn the signal into an exception, so that everything cleans up behind itself."""
    raise Terminated


@contextlib.contextmanager
def ending_in_order() -> Iterator[None]:
    """End on SIGTERM as on Ctrl-C inside the block; in the main thread of a program only, and nothing is left behind."""
    with taken(signal.SIGTERM, _terminate, usual=signal.SIG_DFL):
        yield


@contextlib.contextmanager
def printable() -> Iterator[None]:
    """Give a run that has no stdout (``>&-``) one that takes everything, and one in Latin-1 or ASCII a sign for what it cannot write."""
    with contextlib.ExitStack() as stack:
        for name in ("stdout", "stderr"):
            stream = getattr(sys, name)
            if stream is None:
                void = stack.enter_context(open(os.devnull, "w", encoding="utf-8"))  # noqa: PTH123
                setattr(sys, name, void)
                stack.callback(setattr, sys, name, None)
            elif hasattr(stream, "reconfigure") and (stream.errors == "strict" or _is_narrow(stream)):
                stack.callback(stream.reconfigure, errors=stream.errors)
                stream.reconfigure(errors="replace")
        yield


def _is_narrow(stream: Any) -> bool:
    """Whether a stream of the C locale, which passes on bytes that it could not read, refuses letters as a strict one does."""
    return stream.errors == "surrogateescape" and "utf" not in stream.encoding.lower()


def discard_stdout() -> None:
    """Let nothing more reach stdout: what is still held there could not be written either."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
