"""Commands in worker processes: progress, cancellation, and documents."""

from __future__ import annotations

import asyncio
import contextlib
import importlib
import json
import multiprocessing
import os
import pkgutil
import shlex
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from seisblock.core.i18n import N_, gettext, use_locale

PROGRESS_VARIABLE = "SEISBLOCK_PROGRESS_FILE"
"""Environment variable of the file in which a command reports its progress, see :mod:`seisblock.cli.progress`."""

POLL_S = 0.05
"""Interval between looks at a worker, s."""

KILL_DELAY_S = 2.0
"""Time that a terminated worker has to remove its temporary files, s."""

COMMAND_MODULES = ("respond", "measure", "report", "scenario", "infer", "overturn_rate", "map", "secure", "load_records", "write_results")
"""Modules of the command line that workers need."""

PRELOADED = (
    *(f"seisblock.cli.{name}" for name in COMMAND_MODULES),
    "seisblock.readers",
    "seisblock.models.respond.solver",
    "seisblock.models.rock.solver",
    "seisblock.output.figures.solver",
    "seisblock.report.json.respond",
    "seisblock.report.json.measure",
    "seisblock.report.text.respond",
    "seisblock.report.figures.measure",
    "seisblock.studies.assessment",
    "seisblock.studies.scenario.assess",
)
"""Modules that the server of workers imports, so that a forked worker starts at once."""

COMPILING = "compiling kernels (first run only, up to 30 s)..."
"""Message of :mod:`seisblock._jit.cache`, which is no note on results."""

ERROR_PREFIX = "seisblock: "
"""Beginning of the line on the error that ends a command."""

NO_MESSAGE = N_("the computation ended without a message, possibly for lack of memory")
"""Error of a worker that the operating system ended."""


class JobState(StrEnum):
    """State of a job."""

    WAITING = "waiting"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"


@dataclass(eq=False)
class Job:
    """Command in a worker process.

    Parameters
    ----------
    arguments : tuple of str
        Command line as a user would type it.
    outputs : mapping of str to str
        Options of output files and the names of these files in `folder`.
    cwd, folder : Path
        Working directory, which holds the uploads, and folder of the outputs.
    locale : str
    first : tuple of str
        Command line before it, which makes a file of the working directory.
    """

    arguments: tuple[str, ...]
    outputs: Mapping[str, str]
    cwd: Path
    folder: Path
    locale: str
    state: JobState = JobState.WAITING
    first: tuple[str, ...] = ()
    started: float = field(default_factory=time.monotonic)
    _process: Any = None
    _task: asyncio.Task[None] | None = None

    def start(self, slots: asyncio.Semaphore) -> None:
        """Start the worker as soon as there is a slot."""
        self.folder.mkdir(parents=True, exist_ok=True)
        self._task = asyncio.create_task(self._run(slots))

    async def wait(self) -> None:
        """Return after the end of the job."""
        if self._task is not None:
            await asyncio.wait([self._task])

    async def cancel(self) -> None:
        """End the worker; a job that has ended stays as it is."""
        if self.state in (JobState.WAITING, JobState.RUNNING):
            self.state = JobState.CANCELLED
        await self.wait()

    async def _run(self, slots: asyncio.Semaphore) -> None:
        async with slots:
            if self.state is not JobState.WAITING:
                return
            self.state = JobState.RUNNING
            paths = [text for flag, name in self.outputs.items() for text in (flag, str(self.folder / name))]
            line = [*self.arguments, *paths, "--json"] if self.arguments[0] != "report" else [*self.arguments, *paths]
            succeeds = not self.first or await self._succeeds(list(self.first))
            if succeeds and self.state is JobState.RUNNING:
                succeeds = await self._succeeds(line)
            if self.state is JobState.RUNNING:
                self.state = JobState.DONE if succeeds else JobState.FAILED

    async def _succeeds(self, line: list[str]) -> bool:
        """Run a command until its end or until the job is cancelled."""
        self._process = context().Process(target=run_command, args=(line, str(self.cwd), str(self.folder), self.locale), daemon=True)
        await asyncio.to_thread(self._process.start)
        while self._process.is_alive() and self.state is JobState.RUNNING:
            await asyncio.sleep(POLL_S)
        succeeds: bool = self._process.exitcode == 0
        await asyncio.to_thread(self._stop)
        return succeeds

    def _stop(self) -> None:
        """End the process: SIGTERM, by which it removes its temporary files, then SIGKILL."""
        if self._process.is_alive():
            self._process.terminate()
            self._process.join(KILL_DELAY_S)
        if self._process.is_alive():
            self._process.kill()
        self._process.join()
        self._process.close()

    @property
    def progress(self) -> tuple[str, float | None]:
        """Current task and its completed share, None if unknown."""
        with contextlib.suppress(OSError, ValueError):
            task = json.loads((self.folder / "progress.json").read_text(encoding="utf-8"))
            return task["text"], task["completed"] / task["total"] if task["total"] else None
        return "", None

    @property
    def command(self) -> str:
        """Lines that a user would type."""
        return "\n".join(shlex.join(["seisblock", *line]) for line in (self.first, self.arguments) if line)

    @property
    def document(self) -> dict[str, Any]:
        """JSON document of the command."""
        document: dict[str, Any] = json.loads((self.folder / "stdout.txt").read_text(encoding="utf-8"))
        return document

    @property
    def notes(self) -> list[str]:
        """Lines that a command printed beside its results, without those on output files and kernels."""
        with use_locale(self.locale):
            hidden_texts = str(self.folder), gettext(COMPILING)
        return [line for line in self._messages if not any(text in line for text in hidden_texts)]

    @property
    def error(self) -> str:
        """Sentence of a command on its error."""
        sentence = next((line for line in self._messages if line.startswith(ERROR_PREFIX)), None)
        if sentence is not None:
            return sentence.removeprefix(ERROR_PREFIX)
        with use_locale(self.locale):
            # an error in the options, which click words
            return self._messages[-1].removeprefix(gettext("Error: {message}", message="")) if self._messages else gettext(NO_MESSAGE)

    @property
    def _messages(self) -> list[str]:
        with contextlib.suppress(OSError):
            lines = (self.folder / "stderr.txt").read_text(encoding="utf-8", errors="replace").splitlines()
            return [line.strip() for line in lines if line.strip()]
        return []


def context() -> Any:
    """Return the multiprocessing context: a fork server with the modules of the commands, where there is one, else new interpreters."""
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    server = multiprocessing.get_context("forkserver")
    server.set_forkserver_preload([f"{__package__}._preload"])
    return server


def start_fork_server() -> None:
    """Start the fork server, which imports the modules of the commands while the page loads."""
    if "forkserver" in multiprocessing.get_all_start_methods():
        context()
        from multiprocessing.forkserver import ensure_running

        ensure_running()


def preload() -> None:
    """Import :data:`PRELOADED`."""
    for name in PRELOADED:
        importlib.import_module(name)


def run_command(arguments: list[str], cwd: str, folder: str, locale: str) -> None:
    """Run a command line in this process, with stdout and stderr in files of the folder."""
    for name, number, mode in (("stdout", 1, os.O_TRUNC), ("stderr", 2, os.O_APPEND)):
        descriptor = os.open(Path(folder, f"{name}.txt"), os.O_WRONLY | os.O_CREAT | mode, 0o600)
        os.dup2(descriptor, number)
        os.close(descriptor)
        setattr(sys, name, open(number, "w", encoding="utf-8", closefd=False))  # noqa: SIM115
    os.environ[PROGRESS_VARIABLE] = str(Path(folder, "progress.json"))
    os.environ["NO_COLOR"] = "1"
    os.chdir(cwd)
    sys.argv = ["seisblock", *arguments, "--lang", locale]
    # the command line, which is above this package
    pkgutil.resolve_name("seisblock.__main__:run")()
