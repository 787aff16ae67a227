"""State of one browser tab: its uploads, its jobs, its language. Tabs share nothing."""

from __future__ import annotations

import asyncio
import secrets
import shutil
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from seisblock.app.jobs import Job

EXPIRY_S = 6 * 3600.0
"""Time after the last request of a tab after which its uploads are removed, s; an open page sends one every minute."""


@dataclass(eq=False)
class Tab:
    """One open page.

    Parameters
    ----------
    token : str
        Unguessable part of its addresses.
    folder : Path
        Its part of the temporary folder: ``files`` for uploads, one folder for each job.
    locale : str
    record, intensity : tuple of str, str
        Ground motion: arguments RECORD and their options, or the JMA intensity of a scenario.
    uploaded, body_files : tuple of str
        Uploaded files of the record and of the object.
    sheets : dict of str to str
        Uploaded sheet of the survey and of the collection, and the files of the event.
    columns : tuple of (str, int, int)
        What was recognised of the survey's sheet: name of a column, rows with a value, all rows.
    form, record_form : dict of str to str
        Fields of the object that was computed, and of the record.
    scenario : tuple of str
        Arguments of the collection's scenario.
    slots : asyncio.Semaphore
        Shared by all tabs: number of workers at a time.
    """

    token: str
    folder: Path
    locale: str
    slots: asyncio.Semaphore
    record: tuple[str, ...] = ()
    intensity: str = ""
    uploaded: tuple[str, ...] = ()
    body_files: tuple[str, ...] = ()
    sheets: dict[str, str] = field(default_factory=dict)
    columns: tuple[tuple[str, int, int], ...] = ()
    form: dict[str, str] = field(default_factory=dict)
    record_form: dict[str, str] = field(default_factory=dict)
    scenario: tuple[str, ...] = ()
    jobs: dict[str, Job] = field(default_factory=dict)
    serials: dict[str, int] = field(default_factory=dict)
    last_request: float = field(default_factory=time.monotonic)
    uploading: asyncio.Lock = field(default_factory=asyncio.Lock)
    reporting: asyncio.Lock = field(default_factory=asyncio.Lock)

    @property
    def files(self) -> Path:
        """Folder of the uploads, working directory of the commands."""
        path = self.folder / "files"
        path.mkdir(parents=True, exist_ok=True)
        return path

    def names_of_others(self, kind: str) -> set[str]:
        """Return the names of uploaded files that are not of a kind."""
        files = {"record": self.uploaded, "object": self.body_files, **{sheet: (name,) for sheet, name in self.sheets.items()}}
        return {name for other, names in files.items() if other != kind for name in names}

    async def start(
        self, kind: str, arguments: tuple[str, ...], outputs: Mapping[str, str] | None = None, first: tuple[str, ...] = ()
    ) -> Job:
        """Start a command, after another one that makes its input; it replaces the previous one of its kind, which is cancelled."""
        await self.cancel(kind)
        serial = self.serials[kind] = self.serials.get(kind, 0) + 1
        job = self.jobs[kind] = Job(arguments, outputs or {}, self.files, self.folder / f"{kind}-{serial}", self.locale, first=first)
        job.start(self.slots)
        return job

    async def set_locale(self, locale: str) -> None:
        """Change the language of the page and run its commands again, whose figures and tables have texts."""
        self.locale = locale
        for kind, job in list(self.jobs.items()):
            if kind in ("film", "report", "secure"):
                await self.cancel(kind)
            else:
                await self.start(kind, job.arguments, job.outputs, job.first)

    async def cancel(self, kind: str) -> None:
        """Cancel the job of a kind and remove its files."""
        job = self.jobs.pop(kind, None)
        if job is not None:
            await job.cancel()
            await asyncio.to_thread(shutil.rmtree, job.folder, ignore_errors=True)

    async def close(self) -> None:
        """Cancel all jobs and remove the folder."""
        await asyncio.gather(*(job.cancel() for job in self.jobs.values()))
        await asyncio.to_thread(shutil.rmtree, self.folder, ignore_errors=True)


class Tabs:
    """Open tabs by token.

    Parameters
    ----------
    folder : Path
        Temporary folder of the server.
    workers : int
        Workers at a time.
    """

    def __init__(self, folder: Path, workers: int) -> None:
        self._folder = folder
        self._slots = asyncio.Semaphore(workers)
        self._tabs: dict[str, Tab] = {}

    def open(self, locale: str) -> Tab:
        """Return a new tab; tabs closed long ago are removed."""
        for token, tab in list(self._tabs.items()):
            if time.monotonic() - tab.last_request > EXPIRY_S:
                del self._tabs[token]
                asyncio.get_running_loop().create_task(tab.close())
        token = secrets.token_urlsafe(16)
        tab = self._tabs[token] = Tab(token, self._folder / token, locale, self._slots)
        return tab

    def get(self, token: str) -> Tab | None:
        """Return a tab by its token."""
        tab = self._tabs.get(token)
        if tab is not None:
            tab.last_request = time.monotonic()
        return tab

    async def close(self) -> None:
        """Close all tabs."""
        await asyncio.gather(*(tab.close() for tab in self._tabs.values()))
        self._tabs.clear()
