"""Discovery of recordings in files, folders, patterns, lists and archives.

Files are grouped into recordings by name, as one component stands for its set; nothing is read before its turn. Of an archive, only
members of incomplete sets are buffered.
"""

from __future__ import annotations

import glob
import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from seisblock.core.errors import InputError, RecordFormatError, RecordNotFoundError, os_error_text
from seisblock.core.io.files import read_bytes
from seisblock.core.io.overwrite import mark_read
from seisblock.readers.archive import is_archive, iter_members
from seisblock.readers.components import channel_file_set, knet_file_set
from seisblock.readers.detect import OBSPY, detect_format
from seisblock.readers.dispatch import ReadOptions
from seisblock.readers.formats.at2 import split_direction
from seisblock.readers.limits import ReadBudget
from seisblock.readers.member_buffer import MemberBuffer
from seisblock.readers.read import read, record_from_files
from seisblock.readers.source import RawFile, open_source, resolve_path
from seisblock.records import Record

LIST_PREFIX = "@"
"""Prefix of the name of a record list."""

_IGNORED_SUFFIXES = frozenset({".md", ".pdf", ".png", ".jpg", ".jpeg", ".gif", ".ps", ".html", ".toml", ".py", ".parquet", ".journal"})
"""Suffixes of files in a folder that are skipped without reading."""


@dataclass(frozen=True)
class RecordSource:
    """One recording to be read.

    Parameters
    ----------
    name : str
        File name of its first file.
    path : str
        Path of its first file; archive/member for a member of an archive.
    stamp : str
        Sizes and modification times of its files; identifies the content under this path.
    files : tuple of str
        Files of the recording; empty if `blobs` are given.
    blobs : tuple of RawFile
        Archive members of the recording.
    failure : InputError or None
        Error that prevents reading.
    """

    name: str
    path: str
    stamp: str
    files: tuple[str, ...] = ()
    blobs: tuple[RawFile, ...] = ()
    failure: InputError | None = None

    @property
    def key(self) -> tuple[str, str]:
        """Identity: path and stamp."""
        return self.path, self.stamp

    def read(self, options: ReadOptions) -> Record:
        """Return the record, read with a fresh budget.

        Raises
        ------
        InputError
            If the recording cannot be read.
        """
        if self.failure is not None:
            raise self.failure
        if self.blobs:
            return record_from_files(self.path, self.blobs, replace(options, budget=ReadBudget()))
        read_options = {key: getattr(options, key) for key in ("format", "units", "dt", "station", "level")}
        return read(list(self.files), **read_options)


def iter_records(names: Iterable[str], options: ReadOptions) -> Iterator[RecordSource]:
    """Yield the recordings denoted by names, each once.

    Parameters
    ----------
    names : iterable of str
        Files, bundled samples, folders (recursive), patterns with ``*`` or ``?``, ``@list.txt`` with a name per line, and archives, of
        which each station is a recording.
    options : ReadOptions
        With a format given, no file of a folder is skipped.

    Raises
    ------
    RecordNotFoundError
        If a list or folder is empty, or no file matches a pattern.

    Examples
    --------
    >>> [recording.name for recording in iter_records(["synthetic_jma.csv", "elcentro_1940_ns.csv"], ReadOptions())]
    ['synthetic_jma.csv', 'elcentro_1940_ns.csv']
    """
    yield from group_files(expand_names(names, options), options)


def expand_names(names: Iterable[str], options: ReadOptions) -> list[str]:
    """Return the files denoted by names, each once; see :func:`iter_records`."""
    files: dict[str, str] = {}
    # by real path: a file given by several names is read once
    for path in (expanded_path for name in names for expanded_path in _expand_name(name, options)):
        files.setdefault(os.path.realpath(path), path)
    return list(files.values())


def _expand_name(name: str, options: ReadOptions, open_lists: tuple[str, ...] = ()) -> Iterator[str]:
    """Yield the files denoted by one name; `open_lists` are the lists being expanded."""
    if name.startswith(LIST_PREFIX) and not Path(name).exists():
        yield from _expand_list(Path(name[len(LIST_PREFIX) :]), options, open_lists)
        return
    path = Path(name).expanduser() if name.startswith("~") else Path(name)
    try:
        is_folder, exists = path.is_dir(), path.exists()
    except OSError:
        is_folder = exists = False
    if is_folder:
        yield from _expand_folder(path, options)
    elif not exists and any(mark in name for mark in "*?["):
        matches = sorted(match for match in glob.glob(str(path), recursive=True) if Path(match).is_file())  # noqa: PTH207 - Path.glob takes no absolute pattern
        if not matches:
            raise RecordNotFoundError("no file matches the pattern {name}", name=name)
        yield from matches
    else:
        yield name if exists else _sample_path(name)


def _sample_path(name: str) -> str:
    """Return the path of a bundled sample, else the name unchanged, which fails on reading."""
    try:
        return str(resolve_path(name))
    except RecordNotFoundError:
        return name


def _expand_list(path: Path, options: ReadOptions, open_lists: tuple[str, ...]) -> Iterator[str]:
    """Yield the files of a list; names that do not exist here are looked up next to the list."""
    real_path = os.path.realpath(path)
    if real_path in open_lists:
        raise RecordNotFoundError("{name}: the record list contains itself; remove that line", name=path)
    try:
        lines = read_bytes(path, str(path), RecordNotFoundError).decode("utf-8-sig").splitlines()
    except UnicodeDecodeError as error:
        raise RecordNotFoundError("{name}: cannot read the record list: {reason}", name=path, reason=str(error)) from error
    entries = [line.strip() for line in lines if line.strip() and not line.lstrip().startswith("#")]
    if not entries:
        raise RecordNotFoundError("{name}: the record list is empty; write one file name per line", name=path)
    for line in entries:
        sibling = path.parent / line
        yield from _expand_name(str(sibling) if not Path(line).exists() and sibling.exists() else line, options, (*open_lists, real_path))


def _expand_folder(path: Path, options: ReadOptions) -> Iterator[str]:
    """Yield the files in a folder and its subfolders that may be records."""
    try:
        files = sorted(
            file for file in path.rglob("*") if file.is_file() and not any(p.startswith(".") for p in file.relative_to(path).parts)
        )
    except OSError as error:
        raise RecordNotFoundError("{name}: cannot read the folder: {reason}", name=path, reason=os_error_text(error)) from error
    candidates = [str(file) for file in files if options.format is not None or _may_be_record(file)]
    if not candidates:
        raise RecordNotFoundError("{name}: no record found in this folder ({count} other files)", name=path, count=len(files))
    yield from candidates


def _may_be_record(path: Path) -> bool:
    """Return whether the content of a file is that of a known format."""
    if path.suffix.lower() in _IGNORED_SUFFIXES:
        return False
    try:
        with path.open("rb") as stream:
            head = stream.read(65536)
    except OSError:
        return True  # reading reports the error later
    return bool(head.strip()) and (is_archive(head) or detect_format(RawFile(str(path), head)) != OBSPY)


class _FileSet(NamedTuple):
    """Common name key of the files of one recording, and the number of files in a complete set."""

    key: tuple[str, ...]
    size: int


def _file_set(name: str) -> _FileSet:
    """Return the set of a file by its name; a set of one for other names."""
    path = Path(name)
    knet = knet_file_set(path.name)
    if knet is not None:
        return _FileSet((str(path.parent), knet[0].upper()), knet[1])
    channels = channel_file_set(path.name)
    if channels is not None:
        return _FileSet((str(path.parent), channels.upper()), 3)
    at2 = split_direction(path.name) if path.suffix.lower() == ".at2" else None
    return _FileSet((name,), 1) if at2 is None else _FileSet((str(path.parent), at2[0].upper()), 3)


def group_files(files: Iterable[str], options: ReadOptions) -> Iterator[RecordSource]:
    """Yield the recordings made up of files, in the order of their first files."""
    sets: dict[tuple[str, ...], list[str]] = {}
    for name in files:
        sets.setdefault(_file_set(name).key, []).append(name)
    for members in sets.values():
        for member in members:
            mark_read(Path(member))
        first = Path(members[0])
        if len(members) == 1 and _is_archive_file(first):
            yield from _iter_archive_sources(first, options)
        else:
            yield RecordSource(first.name, members[0], "|".join(_file_stamp(Path(member)) for member in members), files=tuple(members))


def _file_stamp(path: Path) -> str:
    """Return size and modification time, as text."""
    try:
        info = path.stat()
    except OSError:
        return "gone"
    return f"{info.st_size}@{info.st_mtime_ns}"


def _is_archive_file(path: Path) -> bool:
    """Return whether a regular file is an archive; pipes are not inspected, as reading consumes them."""
    if not path.is_file():
        return False
    try:
        with path.open("rb") as stream:
            return is_archive(stream.read(512))
    except OSError:
        return False


def _iter_archive_sources(path: Path, options: ReadOptions) -> Iterator[RecordSource]:
    """Yield the recordings in an archive as soon as complete; incomplete sets come last."""
    stamp = _file_stamp(path)
    member_count = 0
    archive_budget = ReadBudget()
    with MemberBuffer() as buffer:
        try:
            for member in iter_members(open_source(path, archive_budget), archive_budget):
                # members such as notes are skipped unless the options declare them to be records
                if options.format is None and options.units is None and detect_format(member) == OBSPY:
                    continue
                key, size = _file_set(member.name)
                member_count += 1
                # a complete set is yielded at once, which keeps the buffer small
                if buffer.add(key, member) == size:
                    yield _archive_source(buffer.pop(key), stamp)
        except InputError as error:
            yield RecordSource(path.name, str(path), stamp, failure=error)
        else:
            if not member_count:
                yield RecordSource(
                    path.name, str(path), stamp, failure=RecordFormatError("{name}: no record found in this archive", name=path)
                )
        for incomplete_key in buffer.keys:
            yield _archive_source(buffer.pop(incomplete_key), stamp)


def _archive_source(members: list[RawFile], stamp: str) -> RecordSource:
    return RecordSource(members[0].basename, members[0].name, stamp, blobs=tuple(members))
