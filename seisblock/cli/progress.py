"""A bar on stderr for work that lasts over a second; silent with ``--quiet`` and when nobody watches."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

from seisblock import words
from seisblock.cli import talk

PATIENCE_S = 1.0
"""Work that is done sooner shows no bar."""


@contextlib.contextmanager
def progress(what: str, /, **values: Any) -> Iterator[Callable[[int, int], None]]:
    """Give a function to call with the number done and the number in all; the bar, with a text that is told, goes when the block ends."""
    if talk.is_quiet() or not sys.stderr.isatty():
        yield lambda done, total: None
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    from seisblock.present.text.tables import console

    began = time.monotonic()
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    bar = Progress(*columns, console=console(stderr=True), transient=True)
    task = bar.add_task(words.tell(what, **values))
    started = False

    def tell(done: int, total: int) -> None:
        """Move the bar, once there is reason to show it."""
        nonlocal started
        if not started and time.monotonic() - began > PATIENCE_S:
            bar.start()
            started = True
        bar.update(task, completed=done, total=total)

    try:
        yield tell
    finally:
        if started:
            bar.stop()
