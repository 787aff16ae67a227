"""Uploads: a limit that holds before anything is in memory, and safe file names."""

from __future__ import annotations

import asyncio
import contextlib
import re
import shutil
import time
import unicodedata
from collections.abc import Iterable
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any, BinaryIO

if TYPE_CHECKING:
    from starlette.datastructures import UploadFile
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

MAX_UPLOAD_BYTES = 200 * 1000 * 1000 - 1
"""Size of the largest request body: a file of 200 MB is refused."""

IDLE_S, MAX_DISCARD_S = 1.0, 60.0
"""Times after which the rest of a refused body is no longer awaited: without data, and in all, s."""

MAX_FILES = 5000
"""Largest number of files of one upload."""

MAX_NAME_BYTES = 200
"""Longest file name that is kept, bytes of UTF-8 (file systems take 255); the beginning of a longer one is dropped."""

_RESERVED = re.compile(r'[\x00-\x1f\x7f<>:"/|?*\[\]]')
"""Characters that a system or the pattern of a command line reserves."""


class UploadTooLargeError(Exception):
    """Request body above the limit."""


class BodyLimit:
    """ASGI middleware that keeps no byte of a request body above the limit; a declared length is refused before the first byte is read.

    What a browser still sends is discarded before the answer, which it would not read otherwise.
    """

    def __init__(self, app: ASGIApp, limit: int = MAX_UPLOAD_BYTES) -> None:
        self._app, self._limit = app, limit

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on with a limited `receive`."""
        length = dict(scope.get("headers", ())).get(b"content-length", b"0")
        declared, received = int(length) if length.isdigit() else 0, 0

        async def receive_limited() -> Message:
            nonlocal received
            if declared > self._limit:
                raise UploadTooLargeError
            message = await receive()
            received += len(message.get("body", b""))
            if received > self._limit:
                raise UploadTooLargeError
            return message

        async def send_after_body(message: Message) -> None:
            if message["type"] == "http.response.start" and max(declared, received) > self._limit:
                await _discard(receive)
            await send(message)

        await self._app(scope, receive_limited, send_after_body)


async def _discard(receive: Receive) -> None:
    """Take the rest of a request body, piece by piece, until its end or until nothing more comes."""
    end = time.monotonic() + MAX_DISCARD_S
    with contextlib.suppress(TimeoutError):
        while time.monotonic() < end:
            message = await asyncio.wait_for(receive(), IDLE_S)
            if message["type"] != "http.request" or not message.get("more_body", False):
                return


def safe_name(name: str) -> str:
    r"""Return the file name of an upload without folders, and without characters that have a meaning for a command line or a system.

    Examples
    --------
    >>> safe_name("../../etc/passwd"), safe_name("C:\\data\\記録（1）.csv"), safe_name("-o<b>.csv"), safe_name("")
    ('passwd', '記録（1）.csv', 'o_b_.csv', 'file')
    """
    last = unicodedata.normalize("NFC", PurePosixPath(name.replace("\\", "/")).name)
    printable = "".join(letter if letter.isprintable() else "_" for letter in _RESERVED.sub("_", last))
    end = printable.encode(errors="replace")[-MAX_NAME_BYTES:].decode(errors="ignore")
    return end.lstrip("-.~@ ").rstrip(". ") or "file"


async def save_uploads(uploads: Iterable[UploadFile], folder: Path, *, taken: Iterable[str] = ()) -> list[str]:
    """Write uploads to a folder and return their names there.

    A file gets a number where its name is `taken`, or that of a file in another folder of the user.
    """
    folder.mkdir(parents=True, exist_ok=True)
    names: list[str] = []
    used = set(map(str.casefold, taken))
    for upload in uploads:
        if not upload.filename:
            continue
        name = _free_name(safe_name(upload.filename), used)
        used.add(name.casefold())
        await asyncio.to_thread(_copy, upload.file, folder / name)
        names.append(name)
    return names


def _free_name(name: str, used: set[str]) -> str:
    stem, dot, suffix = name.partition(".")
    number, free = 1, name
    while free.casefold() in used:
        number += 1
        free = f"{stem}_{number}{dot}{suffix}"
    return free


def _copy(source: Any, target: Path) -> None:
    stream: BinaryIO
    with target.open("wb") as stream:
        shutil.copyfileobj(source, stream)
