"""From the names a user gives for many records to one recording after another: files, folders, patterns, lists and bundles.

What belongs to one recording is told by the names of its files, as one component of a set stands for the others; nothing is read before
its turn, and of an archive nothing is held but the members of the sets that are not whole yet.
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
from seisblock.readers.limits import new_budget
from seisblock.readers.member_buffer import MemberBuffer
from seisblock.readers.read import read, record_from_files
from seisblock.readers.source import RawFile, open_source, resolve_path
from seisblock.records import Record

LIST_PREFIX = "@"
"""What the name of a file that lists names begins with."""

_IGNORED_SUFFIXES = frozenset({".md", ".pdf", ".png", ".jpg", ".jpeg", ".gif", ".ps", ".html", ".toml", ".py", ".parquet", ".journal"})
"""Suffixes of files in a folder that are passed over without a look into them."""


@dataclass(frozen=True)
class RecordSource:
    """One record that is yet to be read.

    Parameters
    ----------
    name : str
        File name of its first file.
    path : str
        Where that is, a member of a bundle as bundle/member.
    stamp : str
        Tells its bytes from others under the same name: sizes, and when files were written last.
    files : tuple of str
        The files that make it; empty where `blobs` do.
    blobs : tuple of Blob
        Members of a bundle that make it.
    failure : InputError or None
        Why there is nothing to read.
    """

    name: str
    path: str
    stamp: str
    files: tuple[str, ...] = ()
    blobs: tuple[RawFile, ...] = ()
    failure: InputError | None = None

    @property
    def key(self) -> tuple[str, str]:
        """What tells it from every other: where it is, and which bytes."""
        return self.path, self.stamp

    def read(self, options: ReadOptions) -> Record:
        """Return the record, each reading with a budget of its own.

        Raises
        ------
        InputError
            If it cannot be read.
        """
        if self.failure is not None:
            raise self.failure
        if self.blobs:
            return record_from_files(self.path, self.blobs, replace(options, budget=new_budget()))
        read_options = {key: getattr(options, key) for key in ("format", "units", "dt", "station", "level")}
        return read(list(self.files), **read_options)


def iter_records(names: Iterable[str], options: ReadOptions) -> Iterator[RecordSource]:
    """Yield the recordings that some names stand for, each once.

    Parameters
    ----------
    names : iterable of str
        Files, bundled samples, folders (with all that lies in them), patterns with ``*`` or ``?``, ``@list.txt`` with a name on each
        line, and bundles, of which each station is a recording.
    options : Options
        The format, where it is said: then no file of a folder is passed over.

    Raises
    ------
    RecordNotFoundError
        If a list or a folder holds nothing, or no file fits a pattern.

    Examples
    --------
    >>> [recording.name for recording in iter_records(["synthetic_jma.csv", "elcentro_1940_ns.csv"], ReadOptions())]
    ['synthetic_jma.csv', 'elcentro_1940_ns.csv']
    """
    yield from group_files(expand_names(names, options), options)


def expand_names(names: Iterable[str], options: ReadOptions) -> list[str]:
    """Return the files that some names stand for, each once; see :func:`iter_records`."""
    files: dict[str, str] = {}
    for path in (expanded_path for name in names for expanded_path in _expand_name(name, options)):
        files.setdefault(os.path.realpath(path), path)
    return list(files.values())


def _expand_name(name: str, options: ReadOptions, open_lists: tuple[str, ...] = ()) -> Iterator[str]:
    """Yield the files that one name stands for, on a list within others."""
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
    """Return the path of a bundled sample; a name that is neither a file nor a sample is left as it is, to fail when it is read."""
    try:
        return str(resolve_path(name))
    except RecordNotFoundError:
        return name


def _expand_list(path: Path, options: ReadOptions, open_lists: tuple[str, ...]) -> Iterator[str]:
    """Yield the files that a list names, one on each line; those that are not here are looked for beside the list."""
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
    """Yield the files in a folder, and in those within it, that may be records."""
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
    """Return whether a file looks like a record of a format that is recognised."""
    if path.suffix.lower() in _IGNORED_SUFFIXES:
        return False
    try:
        with path.open("rb") as stream:
            head = stream.read(65536)
    except OSError:
        return True  # why it cannot be read is told in its row
    return bool(head.strip()) and (is_archive(head) or detect_format(RawFile(str(path), head)) != OBSPY)


class _FileSet(NamedTuple):
    """What the names of the files of one recording share, and how many there may be."""

    key: tuple[str, ...]
    size: int


def _file_set(name: str) -> _FileSet:
    """Return the set to which a file belongs by its name, one of its own where there is none."""
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
    """Yield the recordings that some files make, in the order of their first files."""
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
    """Return what tells a file from what it was before."""
    try:
        info = path.stat()
    except OSError:
        return "gone"
    return f"{info.st_size}@{info.st_mtime_ns}"


def _is_archive_file(path: Path) -> bool:
    """Return whether a file is a bundle; of a pipe nobody knows, for what is looked at is gone."""
    if not path.is_file():
        return False
    try:
        with path.open("rb") as stream:
            return is_archive(stream.read(512))
    except OSError:
        return False


def _iter_archive_sources(path: Path, options: ReadOptions) -> Iterator[RecordSource]:
    """Yield the recordings in a bundle, each as soon as it is whole; those of which a member is missing come last."""
    stamp = _file_stamp(path)
    member_count = 0
    archive_budget = new_budget()
    with MemberBuffer() as buffer:
        try:
            for member in iter_members(open_source(path, archive_budget), archive_budget):
                if options.format is None and options.units is None and detect_format(member) == OBSPY:
                    continue
                key, size = _file_set(member.name)
                member_count += 1
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
    """Return the recording that some members of a bundle make."""
    return RecordSource(members[0].basename, members[0].name, stamp, blobs=tuple(members))
