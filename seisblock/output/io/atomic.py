"""Atomic write of output files: checks of the target, and replacement of the old file only by a complete new one."""

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
from seisblock.core.i18n import join_alternatives
from seisblock.core.io.csv_safety import escape_formula, unescape_formula
from seisblock.core.io.locking import PREFIX, file_lock, remove_stale
from seisblock.core.io.overwrite import check_not_input, mark_written
from seisblock.core.typing import FloatArray
from seisblock.records import Record

FIGURE_SUFFIXES, ANIMATION_SUFFIXES = (".png", ".svg", ".pdf"), (".gif", ".mp4", ".html")
"""Suffixes of figures and of animations."""

TIME_DECIMALS = 9
"""Decimals of sample times, s; further digits are round-off."""

ENCODING_ERRORS = "backslashreplace"
"""Error handler for bytes of file names that are not UTF-8."""


@contextlib.contextmanager
def atomic_write(path: Path | str) -> Iterator[Path]:
    """Write atomically: yield a temporary file that replaces `path` when the block succeeds; an OutputError leaves the old file unchanged.

    Links are followed; devices and pipes are written into.
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
        # the name exists before the file does, so that the cleanup below works after an interrupt at any instant
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
        text = "cannot write {target}: {reason}; the existing file is unchanged" if target.is_file() else "cannot write {target}: {reason}"
        raise OutputError(text, target=target, reason=os_error_text(error)) from error
    mark_written(real)


def check_target(path: Path | str) -> Path:
    """Return the resolved path of an output file; raise OutputError if it cannot be written."""
    target = Path(path)
    if target.exists() and not (target.is_file() or target.is_dir()):
        return target  # a pipe such as /dev/fd/63 has no resolved path
    try:
        target.stat()
    except OSError as error:
        if error.errno == errno.ELOOP:
            raise OutputError("cannot write {target}: {reason}", target=target, reason=os_error_text(error)) from error
    real = target.resolve()
    if real.is_dir():
        raise OutputError("{target} is a folder: give a file name", target=target)
    if not real.parent.is_dir():
        raise OutputError(
            "cannot write {target}: the folder {parent} does not exist",
            target=target,
            parent=real.parent if target.is_symlink() else target.parent,
        )
    if real.is_file() and not real.stat().st_mode & 0o222:
        raise OutputError("{target} is read-only: make the file writable or give another name", target=target)
    check_not_input(target)
    return real


def check_distinct_outputs(*targets: Path | str | None) -> None:
    """Raise OutputError, before anything is written, if an output cannot be written or two outputs are the same file."""
    targets_by_path: dict[Path, Path] = {}
    for target in (Path(path) for path in targets if path is not None):
        real = check_target(target)
        if real in targets_by_path and (real.is_file() or not real.exists()):
            raise OutputError(
                "{first} and {target} are the same file: give every output its own name", first=targets_by_path[real], target=target
            )
        targets_by_path[real] = target


def check_figure(path: Path | str) -> None:
    """Raise OutputError if the suffix of a figure file is not in :data:`FIGURE_SUFFIXES`."""
    if Path(path).suffix.lower() not in FIGURE_SUFFIXES:
        raise OutputError(
            "cannot save the figure as {target}: the name must end in {suffixes}", target=path, suffixes=join_alternatives(FIGURE_SUFFIXES)
        )


def check_animation(path: Path | str) -> None:
    """Raise OutputError if the suffix of an animation is not in :data:`ANIMATION_SUFFIXES`, or ffmpeg is missing for .mp4."""
    suffix = Path(path).suffix.lower()
    if suffix not in ANIMATION_SUFFIXES:
        raise OutputError(
            "cannot save the animation as {target}: the name must end in {suffixes}",
            target=path,
            suffixes=join_alternatives(ANIMATION_SUFFIXES),
        )
    if suffix == ".mp4" and find_ffmpeg() is None:
        text = "cannot write {suffix}: ffmpeg not found; install ffmpeg or the package imageio-ffmpeg, or write .gif or .html"
        raise OutputError(text, suffix=suffix)


def find_ffmpeg() -> str | None:
    """Return the path of ffmpeg: that of the system, else that of the package imageio-ffmpeg; None if neither is installed."""
    program = shutil.which("ffmpeg")
    if program is None and find_spec("imageio_ffmpeg") is not None:
        with contextlib.suppress(RuntimeError):  # imageio-ffmpeg may be installed without its binary
            return str(import_module("imageio_ffmpeg").get_ffmpeg_exe())
    return program


def _umask() -> int:
    """Return the file mode mask of the process."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write_text(path: Path | str, text: str) -> None:
    """Write a UTF-8 text file atomically."""
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8", errors=ENCODING_ERRORS)


def make_folder(folder: Path) -> None:
    """Create a folder and its parents if they do not exist; raise OutputError if that is impossible."""
    if folder.exists() and not folder.is_dir():
        raise OutputError("cannot write into {directory}: a file, not a folder; give a folder", directory=folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError("cannot create the folder {directory}: {reason}", directory=folder, reason=os_error_text(error)) from error


def write_records(folder: Path, records: Sequence[Record]) -> list[Path]:
    """Write records as CSV at full precision, one file per record, into a folder that is created if needed; return the files."""
    make_folder(folder)
    paths = []
    for record in records:
        path = folder / f"{record.source}.csv"
        columns = [normalize_zeros(np.round(record.time, TIME_DECIMALS)), *(normalize_zeros(c.acceleration) for c in record.components)]
        write_table(path, ["time (s)", *(f"{code} (m/s2)" for code in record.codes)], zip(*columns, strict=True))
        paths.append(path)
    return paths


def write_table(path: Path | str, header: Sequence[str], rows: Iterable[Sequence[Any]], *, bom: bool = False) -> None:
    """Write rows as CSV at full precision, with a byte order mark by which Excel knows UTF-8 if `bom`; text like a formula is escaped."""
    encoding = "utf-8-sig" if bom else "utf-8"
    with atomic_write(path) as temporary, temporary.open("w", encoding=encoding, errors=ENCODING_ERRORS, newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(map(escape_formula, row) for row in rows)


def read_table(path: Path, columns: Mapping[str, type]) -> Iterator[dict[str, Any]]:
    """Yield the rows of a CSV batch table, cells converted to the types of the columns, None where empty."""
    with table_errors(path), path.open(encoding="utf-8-sig", newline="") as stream:
        rows = csv.DictReader(stream)
        check_columns(path, rows.fieldnames or (), columns)
        for row in rows:
            yield {name: _parse_cell(row[name], kind) for name, kind in columns.items()}


@contextlib.contextmanager
def table_errors(path: Path) -> Iterator[None]:
    """Convert errors of reading a batch table to :class:`OutputError`."""
    try:
        yield
    except SeisblockError:
        raise
    except (OSError, ValueError, csv.Error) as error:  # pyarrow's errors are subclasses of these
        raise OutputError("cannot read {path} as a batch table: {error}", path=path, error=str(error)[:200]) from error


def check_columns(path: Path, header: Iterable[str], columns: Iterable[str]) -> None:
    """Raise OutputError if the columns of a table differ from those expected."""
    if list(header) != list(columns):
        raise OutputError("the columns of {path} differ from those of this table: give another name", path=path)


def _parse_cell(text: str, kind: type) -> Any:
    """Return the value of a CSV cell, None if empty."""
    if text == "":
        return None
    return text == str(True) if kind is bool else unescape_formula(text) if kind is str else kind(text)


def normalize_zeros(values: FloatArray) -> list[float]:
    """Return a column as numbers without negative zeros.

    Examples
    --------
    >>> normalize_zeros(np.array([-0.0, -1.5]))
    [0.0, -1.5]
    """
    numbers: list[float] = (values + 0.0).tolist()
    return numbers
