"""The one place that decides where an output may go, and writes it so that nothing that is there is ever harmed."""

from __future__ import annotations

import contextlib
import csv
import errno
import os
import secrets
import shutil
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from seisblock.core.errors import OutputError, SeisblockError, os_error_text
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.csv_safety import escape_formula, unescape_formula
from seisblock.core.io.locking import PREFIX, file_lock, remove_stale
from seisblock.core.io.overwrite import check_not_input, mark_written
from seisblock.core.typing import FloatArray
from seisblock.records import Record

FIGURE_SUFFIXES, ANIMATION_SUFFIXES = (".png", ".svg", ".pdf"), (".gif", ".mp4", ".html")
"""What a figure and an animation may be."""

TIME_DECIMALS = 9
"""Of the times of samples, s: what is beyond is round-off."""

ENCODING_ERRORS = "backslashreplace"
"""How bytes in names of files that are no UTF-8 are written."""


@contextlib.contextmanager
def atomic_write(path: Path | str) -> Iterator[Path]:
    """Give a temporary name, and move what was written there to `path` when the block ends well.

    A link is followed, a device or a pipe is written into, and what cannot be written whole leaves the old file as it was.

    Raises
    ------
    OutputError
        If it is a directory, lies in none, is read-only, is a file that is read or another output, or if the disk is full.
    """
    target = Path(path)
    try:
        real = check_target(target)
        if real.exists() and not real.is_file():
            with tempfile.TemporaryDirectory() as folder:
                temporary = Path(folder) / f"written{target.suffix}"
                yield temporary
                with real.open("wb") as stream:
                    stream.write(temporary.read_bytes())
            return
        # named before it is made: an interruption at any instant finds it here
        temporary = real.parent / f"{PREFIX}{secrets.token_hex(6)}{target.suffix[-20:]}"
        try:
            temporary.touch(mode=0o600, exist_ok=False)
            with file_lock(temporary):
                remove_stale(real.parent)
                yield temporary
                mode = real.stat().st_mode & 0o777 if real.exists() else 0o666 & ~_umask()
                temporary.chmod(mode)
                temporary.replace(real)
        finally:
            temporary.unlink(missing_ok=True)
    except (SeisblockError, BrokenPipeError):
        raise
    except OSError as error:
        note = lazy_gettext("; what was there is unchanged") if target.is_file() else ""
        raise OutputError("cannot write {target}: {reason}{kept}", target=target, reason=os_error_text(error), kept=note) from error
    mark_written(real)


def check_target(path: Path | str) -> Path:
    """Return the file that a name leads to, links followed, if an output may go there.

    Raises
    ------
    OutputError
        If it may not, in one sentence.
    """
    target = Path(path)
    if target.exists() and not (target.is_file() or target.is_dir()):
        return target  # a name such as /dev/fd/63 leads to a pipe, which has no other
    try:
        target.stat()
    except OSError as error:
        if error.errno == errno.ELOOP:
            raise OutputError("cannot write {target}: {reason}{kept}", target=target, reason=os_error_text(error), kept="") from error
    real = target.resolve()
    if real.is_dir():
        raise OutputError("{target} is a directory: give a file name", target=target)
    if not real.parent.is_dir():
        raise OutputError(
            "cannot write {target}: there is no directory {parent}",
            target=target,
            parent=real.parent if target.is_symlink() else target.parent,
        )
    if real.is_file() and not real.stat().st_mode & 0o222:
        raise OutputError("{target} is read-only: make it writable, or give another name", target=target)
    check_not_input(target)
    return real


def check_distinct_outputs(*targets: Path | str | None) -> None:
    """Refuse, before anything is written, outputs that cannot all be written: see :func:`check_target`.

    Raises
    ------
    OutputError
        If one may not be written, or two are one file.
    """
    targets_by_path: dict[Path, Path] = {}
    for target in (Path(path) for path in targets if path is not None):
        real = check_target(target)
        if real in targets_by_path and (real.is_file() or not real.exists()):
            raise OutputError(
                "{first} and {target} are one file: give each output its own name", first=targets_by_path[real], target=target
            )
        targets_by_path[real] = target


def check_figure(path: Path | str) -> None:
    """Refuse a figure whose name does not say its format.

    Raises
    ------
    OutputError
        If the suffix is none of ``FIGURES``.
    """
    if Path(path).suffix.lower() not in FIGURE_SUFFIXES:
        raise OutputError("cannot draw {target}: the name must end in {suffixes}", target=path, suffixes=list(FIGURE_SUFFIXES))


def check_animation(path: Path | str) -> None:
    """Refuse an animation whose name does not say its format, or that nothing here can write.

    Raises
    ------
    OutputError
        If the suffix is none of ``FILMS``, or ffmpeg is missing for .mp4.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in ANIMATION_SUFFIXES:
        raise OutputError("cannot animate {target}: the name must end in {suffixes}", target=path, suffixes=list(ANIMATION_SUFFIXES))
    if suffix == ".mp4" and find_ffmpeg() is None:
        text = "cannot write {suffix}: ffmpeg is not installed, nor is the package imageio-ffmpeg; write a .gif or a .html instead"
        raise OutputError(text, suffix=suffix)


def find_ffmpeg() -> str | None:
    """Return the program that makes an .mp4: that of the system, else that of the package imageio-ffmpeg; None where there is neither."""
    program = shutil.which("ffmpeg")
    if program is None and find_spec("imageio_ffmpeg") is not None:
        with contextlib.suppress(RuntimeError):  # the package stands there without its program
            return str(import_module("imageio_ffmpeg").get_ffmpeg_exe())
    return program


def _umask() -> int:
    """Return the process's file mode mask."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write_text(path: Path | str, text: str) -> None:
    """Write a text file in UTF-8, whole or not at all."""
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8", errors=ENCODING_ERRORS)


def make_folder(folder: Path) -> None:
    """Make a folder, unless it is there.

    Raises
    ------
    OutputError
        If it cannot be made, or is a file.
    """
    if folder.exists() and not folder.is_dir():
        raise OutputError("cannot write into {directory}: it is a file; give a directory", directory=folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError("cannot make the directory {directory}: {reason}", directory=folder, reason=os_error_text(error)) from error


def write_records(folder: Path, records: Sequence[Record]) -> list[Path]:
    """Write records as CSV with all their digits, one file each, into a folder that is made if need be; return the files.

    Raises
    ------
    OutputError
        If the folder cannot be made, or a file not be written.
    """
    make_folder(folder)
    paths = []
    for record in records:
        path = folder / f"{record.source}.csv"
        columns = [normalize_zeros(np.round(record.time, TIME_DECIMALS)), *(normalize_zeros(c.acceleration) for c in record.components)]
        write_table(path, ["time (s)", *(f"{code} (m/s2)" for code in record.codes)], zip(*columns, strict=True))
        paths.append(path)
    return paths


def write_table(path: Path | str, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write rows as CSV; floats keep all their digits, and no text of a record's becomes a formula of a spreadsheet."""
    with atomic_write(path) as temporary, temporary.open("w", encoding="utf-8", errors=ENCODING_ERRORS, newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(map(escape_formula, row) for row in rows)


def read_table(path: Path, columns: Mapping[str, type]) -> Iterator[dict[str, Any]]:
    """Yield the rows of a table that was written here, with cells of the types of its columns, None where empty.

    Raises
    ------
    OutputError
        If it has other columns, or cannot be read.
    """
    with table_errors(path), path.open(encoding="utf-8", newline="") as stream:
        rows = csv.DictReader(stream)
        check_columns(path, rows.fieldnames or (), columns)
        for row in rows:
            yield {name: _parse_cell(row[name], kind) for name, kind in columns.items()}


@contextlib.contextmanager
def table_errors(path: Path) -> Iterator[None]:
    """Say in one sentence that a file is not the table that was written here."""
    try:
        yield
    except SeisblockError:
        raise
    except (OSError, ValueError, csv.Error) as error:  # pyarrow's errors are among these
        raise OutputError("{path} is no table of a batch: {error}", path=path, error=str(error)[:200]) from error


def check_columns(path: Path, header: Iterable[str], columns: Iterable[str]) -> None:
    """Refuse a table that has other columns than it should."""
    if list(header) != list(columns):
        raise OutputError("{path} is a table with other columns: give another name", path=path)


def _parse_cell(text: str, kind: type) -> Any:
    """Return what a cell says."""
    if text == "":
        return None
    return text == str(True) if kind is bool else unescape_formula(text) if kind is str else kind(text)


def normalize_zeros(values: FloatArray) -> list[float]:
    """Return the numbers of a column as they are written: a zero has no sign.

    Examples
    --------
    >>> normalize_zeros(np.array([-0.0, -1.5]))
    [0.0, -1.5]
    """
    numbers: list[float] = (values + 0.0).tolist()
    return numbers
