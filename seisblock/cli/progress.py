"""Progress line on stderr, shown on a terminal after a delay, or progress file.

A run has one line, drawn by a thread, so that compiled code and plotting libraries need no hooks. :func:`progress` sets the description
and the count; the solver reports the progress of a single motion between slices.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock.cli.verbosity import is_quiet
from seisblock.core.i18n import format_percent, gettext
from seisblock.dynamics.cancellation import progress_scope

if TYPE_CHECKING:
    from rich.progress import Progress as Bar

SHOW_DELAY_S = 0.6
"""Delay before the progress line appears, s."""

REFRESH_DELAY_S = 0.3
"""Delay before rich is imported, s, so that it is loaded when the line appears."""

TICK_S = 0.1
"""Interval between refreshes, s."""

STALE_S = 1.0
"""Age after which the progress of a single motion is no longer shown, s."""

FILE_VARIABLE = "SEISBLOCK_PROGRESS_FILE"
"""Environment variable of a file that holds the current task as JSON, for a program that runs a command: `text`, `completed`, `total`."""

RATE_WINDOW_S = 5.0
"""Interval between two updates of the speed, s: a collapse is solved a hundred times more slowly than what stood before it."""

MAX_COUNT = 100_000
"""Largest total shown as a count; larger ones are shown as a percentage."""


@dataclass(eq=False)
class Task:
    """Task with its progress; total None if unknown."""

    text: str
    completed: int = 0
    total: int | None = None
    started: float = field(default_factory=time.monotonic)

    def __post_init__(self) -> None:
        """Start counting the speed."""
        self._before = self._last = self.started, 0

    def advance(self, completed: int, total: int) -> None:
        """Set the completed and the total number."""
        self.completed, self.total, now = completed, total, time.monotonic()
        # the speed is counted from the last but one of these times, one to two windows ago; a count that starts again starts the speed, too
        if completed < self._last[1]:
            self._before = self._last = now, completed
        elif now - self._last[0] > RATE_WINDOW_S:
            self._before, self._last = self._last, (now, completed)

    def count_text(self) -> str:
        """Return the progress as text."""
        if self.total is None:
            return ""
        count = f"{self.completed}/{self.total}" if self.total <= MAX_COUNT else format_percent(self.completed / self.total)
        since, completed = self._before
        elapsed = time.monotonic() - since
        return (
            count
            if elapsed < SHOW_DELAY_S or self.completed == completed
            else gettext("{counted}, {rate:.3g} per s", counted=count, rate=(self.completed - completed) / elapsed)
        )


class StatusLine:
    """Progress line of one run, drawn by a thread."""

    def __init__(self) -> None:
        self.works: list[Task] = []
        self._motion_task = Task(gettext("solving"))
        self._last_message_s, self._last_event_s = time.monotonic(), -math.inf
        self._displayed: tuple[str, bool] | None = None
        self._bar: Bar | None = None
        self._lock, self._ended = threading.Lock(), threading.Event()
        self._painter = threading.Thread(target=self._watch, daemon=True)

    @contextlib.contextmanager
    def painting(self) -> Iterator[None]:
        """Draw the line inside the context."""
        self._painter.start()
        try:
            yield
        finally:
            self.end()
            self._painter.join()

    @contextlib.contextmanager
    def paused(self) -> Iterator[None]:
        """Hide the line inside the context; the delay starts again after it."""
        with self._lock:
            self._clear()
            yield
            self._last_message_s = time.monotonic()

    def end(self) -> None:
        """Remove the line permanently."""
        self._ended.set()
        with self._lock:
            self._clear()

    def on_progress(self, completed: int, total: int) -> None:
        """Record the progress of a single motion, shown when no other task is active."""
        self._motion_task.advance(completed, total)
        self._last_event_s = time.monotonic()

    def _watch(self) -> None:
        """Redraw the line until the end."""
        if not self._ended.wait(REFRESH_DELAY_S):
            self._prepare()
        while not self._ended.wait(TICK_S):
            with self._lock:
                if time.monotonic() - self._last_message_s > SHOW_DELAY_S and not self._ended.is_set():
                    self._paint(self._present())

    def _present(self) -> Task:
        """Return the innermost task, or the motion in progress."""
        follows_motion = len(self.works) == 1 and time.monotonic() - self._last_event_s < STALE_S
        return self._motion_task if follows_motion else self.works[-1]

    def _prepare(self) -> None:
        """Import rich."""
        _make_bar(has_total=False)

    def _paint(self, work: Task) -> None:
        has_total = work.total is not None
        if self._bar is None or self._displayed != (work.text, has_total):
            self._clear()
            self._bar, self._displayed = _make_bar(has_total=has_total), (work.text, has_total)
            self._bar.add_task(work.text, total=work.total, count=work.count_text())
            self._bar.start()
        self._bar.update(self._bar.task_ids[0], description=work.text, completed=work.completed, total=work.total, count=work.count_text())
        self._bar.refresh()

    def _clear(self) -> None:
        if self._bar is not None:
            self._bar.stop()
            self._bar = None


class ProgressFile(StatusLine):
    """Progress of one run in a file instead of a line on the terminal, see :data:`FILE_VARIABLE`."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self._path = path

    def _prepare(self) -> None:
        """Import nothing: a file needs no rich."""

    def _paint(self, work: Task) -> None:
        draft = self._path.with_suffix(".part")
        draft.write_text(json.dumps({"text": work.text, "completed": work.completed, "total": work.total}), encoding="utf-8")
        draft.replace(self._path)


_line: StatusLine | None = None
"""Progress of the current run; None where nobody watches."""


@contextlib.contextmanager
def progress(text: str, /, **values: Any) -> Iterator[Callable[[int, int], None]]:
    """Show a task inside the context; yields a function of the completed and the total number.

    The outermost context of a run creates the line; nested contexts replace its description.
    """
    global _line
    with contextlib.ExitStack() as stack:
        if _line is None and (watched := _make_line()) is not None:
            _line = watched
            stack.callback(_reset)
            stack.enter_context(progress_scope(_line.on_progress))
            work = Task(gettext(text, **values))
            _line.works.append(work)
            stack.enter_context(_line.painting())
        elif _line is not None:
            work = Task(gettext(text, **values))
            _line.works.append(work)
            stack.callback(_line.works.remove, work)
        else:
            work = Task(text)
        yield work.advance


def set_task(text: str, /, **values: Any) -> None:
    """Set the description of the outermost task."""
    if _line is not None:
        _line.works[0].text = gettext(text, **values)


def paused() -> contextlib.AbstractContextManager[None]:
    """Hide the progress line inside the context."""
    return contextlib.nullcontext() if _line is None else _line.paused()


def close_line() -> None:
    """Remove the progress line for the rest of the run."""
    if _line is not None:
        _line.end()


def _reset() -> None:
    global _line
    _line = None


def _make_line() -> StatusLine | None:
    """Return the progress line or file of a run; None where nobody watches."""
    if path := os.environ.get(FILE_VARIABLE):
        return ProgressFile(Path(path))
    has_cursor = sys.stderr.isatty() and os.environ.get("TERM", "") not in ("", "dumb", "unknown")
    return StatusLine() if has_cursor and not is_quiet() else None


def _make_bar(*, has_total: bool) -> Bar:
    """Return the rich progress bar: with remaining time if the total is known, else with elapsed time."""
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    from seisblock.output.text.tables import console

    columns = TextColumn("{task.description}", markup=False), BarColumn(), TextColumn("{task.fields[count]}", markup=False)
    clock = TimeRemainingColumn() if has_total else TimeElapsedColumn()
    screen = console(stderr=True)
    return Progress(
        *columns,
        clock,
        console=screen,
        transient=True,
        auto_refresh=False,
        redirect_stdout=False,
        redirect_stderr=False,
        speed_estimate_period=2.0 * RATE_WINDOW_S,
    )
