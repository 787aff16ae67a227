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

from seisblock.contents import contents
from seisblock.errors import InputError, RecordFormatError, RecordNotFoundError, reason
from seisblock.ledger import reading
from seisblock.readers.budget import budget
from seisblock.readers.bundle import is_bundle, walk
from seisblock.readers.detect import OBSPY, format_of
from seisblock.readers.dispatch import Options
from seisblock.readers.formats.at2 import set_name
from seisblock.readers.read import read, record_of_blobs
from seisblock.readers.shelf import Shelf
from seisblock.readers.siblings import channel_set, knet_set
from seisblock.readers.source import Blob, fetch, locate
from seisblock.records import Record

LIST = "@"
"""What the name of a file that lists names begins with."""

_NOT_RECORDS = frozenset({".md", ".pdf", ".png", ".jpg", ".jpeg", ".gif", ".ps", ".html", ".toml", ".py", ".parquet", ".journal"})
"""Suffixes of files in a folder that are passed over without a look into them."""


@dataclass(frozen=True)
class Recording:
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
    blobs: tuple[Blob, ...] = ()
    failure: InputError | None = None

    @property
    def key(self) -> tuple[str, str]:
        """What tells it from every other: where it is, and which bytes."""
        return self.path, self.stamp

    def read(self, options: Options) -> Record:
        """Return the record, each reading with a budget of its own.

        Raises
        ------
        InputError
            If it cannot be read.
        """
        if self.failure is not None:
            raise self.failure
        if self.blobs:
            return record_of_blobs(self.path, self.blobs, replace(options, budget=budget()))
        said = {key: getattr(options, key) for key in ("format", "units", "dt", "station", "level")}
        return read(list(self.files), **said)


def gather(names: Iterable[str], options: Options) -> Iterator[Recording]:
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
    >>> [recording.name for recording in gather(["synthetic_jma.csv", "elcentro_1940_ns.csv"], Options())]
    ['synthetic_jma.csv', 'elcentro_1940_ns.csv']
    """
    yield from recordings(expand(names, options), options)


def expand(names: Iterable[str], options: Options) -> list[str]:
    """Return the files that some names stand for, each once; see :func:`gather`."""
    files: dict[str, str] = {}
    for found in (each for name in names for each in _expanded(name, options)):
        files.setdefault(os.path.realpath(found), found)
    return list(files.values())


def _expanded(name: str, options: Options, within: tuple[str, ...] = ()) -> Iterator[str]:
    """Yield the files that one name stands for, on a list within others."""
    if name.startswith(LIST) and not Path(name).exists():
        yield from _listed(Path(name[len(LIST) :]), options, within)
        return
    path = Path(name).expanduser() if name.startswith("~") else Path(name)
    try:
        folder, there = path.is_dir(), path.exists()
    except OSError:
        folder = there = False
    if folder:
        yield from _in_folder(path, options)
    elif not there and any(mark in name for mark in "*?["):
        found = sorted(each for each in glob.glob(str(path), recursive=True) if Path(each).is_file())  # noqa: PTH207 - Path.glob takes no absolute pattern
        if not found:
            raise RecordNotFoundError("no file fits the pattern {name}", name=name)
        yield from found
    else:
        yield name if there else _sample(name)


def _sample(name: str) -> str:
    """Return the path of a bundled sample; a name that is neither a file nor a sample is left as it is, to fail when it is read."""
    try:
        return str(locate(name))
    except RecordNotFoundError:
        return name


def _listed(path: Path, options: Options, within: tuple[str, ...]) -> Iterator[str]:
    """Yield the files that a list names, one on each line; those that are not here are looked for beside the list."""
    real = os.path.realpath(path)
    if real in within:
        raise RecordNotFoundError("{name}: this list of records names itself: take it off the list", name=path)
    try:
        lines = contents(path, str(path), RecordNotFoundError).decode("utf-8-sig").splitlines()
    except UnicodeDecodeError as error:
        raise RecordNotFoundError("{name}: the list of records cannot be read: {reason}", name=path, reason=str(error)) from error
    named = [line.strip() for line in lines if line.strip() and not line.lstrip().startswith("#")]
    if not named:
        raise RecordNotFoundError("{name}: the list names no record: write one file on each line", name=path)
    for line in named:
        beside = path.parent / line
        yield from _expanded(str(beside) if not Path(line).exists() and beside.exists() else line, options, (*within, real))


def _in_folder(path: Path, options: Options) -> Iterator[str]:
    """Yield the files in a folder, and in those within it, that may be records."""
    try:
        inside = sorted(
            each for each in path.rglob("*") if each.is_file() and not any(p.startswith(".") for p in each.relative_to(path).parts)
        )
    except OSError as error:
        raise RecordNotFoundError("{name}: the folder cannot be read: {reason}", name=path, reason=reason(error)) from error
    found = [str(each) for each in inside if options.format is not None or _may_be_record(each)]
    if not found:
        raise RecordNotFoundError("{name}: no record in this folder, {count} other files", name=path, count=len(inside))
    yield from found


def _may_be_record(path: Path) -> bool:
    """Return whether a file looks like a record of a format that is recognised."""
    if path.suffix.lower() in _NOT_RECORDS:
        return False
    try:
        with path.open("rb") as stream:
            head = stream.read(65536)
    except OSError:
        return True  # why it cannot be read is told in its row
    return bool(head.strip()) and (is_bundle(head) or format_of(Blob(str(path), head)) != OBSPY)


class _Set(NamedTuple):
    """What the names of the files of one recording share, and how many there may be."""

    key: tuple[str, ...]
    size: int


def _set_of(name: str) -> _Set:
    """Return the set to which a file belongs by its name, one of its own where there is none."""
    path = Path(name)
    knet = knet_set(path.name)
    if knet is not None:
        return _Set((str(path.parent), knet[0].upper()), knet[1])
    channels = channel_set(path.name)
    if channels is not None:
        return _Set((str(path.parent), channels.upper()), 3)
    at2 = set_name(path.name) if path.suffix.lower() == ".at2" else None
    return _Set((name,), 1) if at2 is None else _Set((str(path.parent), at2[0].upper()), 3)


def recordings(files: Iterable[str], options: Options) -> Iterator[Recording]:
    """Yield the recordings that some files make, in the order of their first files."""
    sets: dict[tuple[str, ...], list[str]] = {}
    for name in files:
        sets.setdefault(_set_of(name).key, []).append(name)
    for members in sets.values():
        for each in members:
            reading(Path(each))
        first = Path(members[0])
        if len(members) == 1 and _is_archive(first):
            yield from _in_bundle(first, options)
        else:
            yield Recording(first.name, members[0], "|".join(_stamp(Path(each)) for each in members), files=tuple(members))


def _stamp(path: Path) -> str:
    """Return what tells a file from what it was before."""
    try:
        info = path.stat()
    except OSError:
        return "gone"
    return f"{info.st_size}@{info.st_mtime_ns}"


def _is_archive(path: Path) -> bool:
    """Return whether a file is a bundle; of a pipe nobody knows, for what is looked at is gone."""
    if not path.is_file():
        return False
    try:
        with path.open("rb") as stream:
            return is_bundle(stream.read(512))
    except OSError:
        return False


def _in_bundle(path: Path, options: Options) -> Iterator[Recording]:
    """Yield the recordings in a bundle, each as soon as it is whole; those of which a member is missing come last."""
    stamp = _stamp(path)
    found = 0
    spending = budget()
    with Shelf() as waiting:
        try:
            for member in walk(fetch(path, spending), spending):
                if options.format is None and options.units is None and format_of(member) == OBSPY:
                    continue
                key, size = _set_of(member.name)
                found += 1
                if waiting.put(key, member) == size:
                    yield _packed(waiting.take(key), stamp)
        except InputError as error:
            yield Recording(path.name, str(path), stamp, failure=error)
        else:
            if not found:
                yield Recording(path.name, str(path), stamp, failure=RecordFormatError("{name}: no record in this bundle", name=path))
        for unfinished in waiting.keys:
            yield _packed(waiting.take(unfinished), stamp)


def _packed(members: list[Blob], stamp: str) -> Recording:
    """Return the recording that some members of a bundle make."""
    return Recording(members[0].basename, members[0].name, stamp, blobs=tuple(members))
