"""First stage of reading: names of files, folders, patterns, lists and archives to named bytes, one recording at a time.

Files are grouped into recordings by name, as one component stands for its set; nothing is read before its turn. Of an archive, only
members of incomplete sets are buffered.
"""

from __future__ import annotations

import glob
import os
import tempfile
from collections.abc import Callable, Hashable, Iterable, Iterator
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, NamedTuple

from seisblock.core.errors import InputError, RecordError, RecordFormatError, RecordNotFoundError, os_error_text
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.files import read_bytes as read_list
from seisblock.core.io.overwrite import mark_read
from seisblock.readers.archive import is_archive, iter_members
from seisblock.readers.event import is_quakeml
from seisblock.readers.limits import ReadBudget
from seisblock.readers.options import ReadOptions
from seisblock.readers.registry import FALLBACK, HEAD_BYTES, Format, detect_format, find_format, format_titles, list_formats, match_head
from seisblock.readers.response import is_station_xml
from seisblock.readers.source import LARGE_FILE_BYTES, RawFile, open_source, read_bytes, resolve_path


class _BufferedMember(NamedTuple):
    """Name of a member and position of its bytes in the buffer file."""

    name: str
    begin: int
    size: int


@dataclass
class MemberBuffer:
    """Archive members grouped by key, spooled to a temporary file beyond `in_memory` bytes.

    Examples
    --------
    >>> with MemberBuffer() as buffer:
    ...     counts = [buffer.add("station", RawFile(name, b"1")) for name in ("a.NS", "a.EW")]
    ...     counts, [blob.name for blob in buffer.pop("station")]
    ([1, 2], ['a.NS', 'a.EW'])
    """

    in_memory: int = LARGE_FILE_BYTES
    _sets: dict[Hashable, list[_BufferedMember]] = field(default_factory=dict, init=False)
    _file: IO[bytes] = field(init=False)
    _open: ExitStack = field(default_factory=ExitStack, init=False)

    def __enter__(self) -> MemberBuffer:
        self._file = self._open.enter_context(tempfile.SpooledTemporaryFile(self.in_memory))
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def add(self, key: Hashable, blob: RawFile) -> int:
        """Store a member and return the number of members under its key; raise RecordError if the file cannot be written."""
        members = self._sets.setdefault(key, [])
        try:
            begin = self._file.seek(0, 2)
            self._file.write(blob.data)
        except OSError as error:
            message = "{name}: cannot write a temporary file in {folder}: {reason}"
            raise RecordError(message, name=blob.name, folder=tempfile.gettempdir(), reason=os_error_text(error)) from error
        members.append(_BufferedMember(blob.name, begin, len(blob.content)))
        return len(members)

    def pop(self, key: Hashable) -> list[RawFile]:
        """Remove and return the members under a key, in the order added."""
        members = [self._read_member(member) for member in self._sets.pop(key)]
        # reuse the space when nothing is buffered
        if not self._sets:
            self._file.seek(0)
            self._file.truncate()
        return members

    @property
    def keys(self) -> list[Hashable]:
        """Keys with members, the oldest first."""
        return list(self._sets)

    def _read_member(self, member: _BufferedMember) -> RawFile:
        self._file.seek(member.begin)
        return RawFile(member.name, self._file.read(member.size))


LIST_PREFIX = "@"
"""Prefix of the name of a record list."""

_IGNORED_SUFFIXES = frozenset({".md", ".pdf", ".png", ".jpg", ".jpeg", ".gif", ".ps", ".html", ".toml", ".py", ".parquet", ".journal"})
"""Suffixes of files in a folder that are skipped without reading."""

INVENTORY_SUFFIXES, EVENT_SUFFIXES = (".xml", ".stationxml"), (".xml", ".quakeml", ".qml")
"""Suffixes of StationXML and of QuakeML files."""

_COMPONENT_ORDER = {"NS": 0.0, "EW": 1.0, "UD": 2.0}


@dataclass(frozen=True)
class RecordSource:
    """One recording to be read.

    `name` and `path` are those of its first file (archive/member in an archive); `stamp`, the sizes and modification times of its files,
    identifies the content under this path. The bytes are in `files` or, of an archive, in `blobs`; `inventories` are the StationXML files
    of the archive; `failure` prevents reading.
    """

    name: str
    path: str
    stamp: str
    files: tuple[str, ...] = ()
    blobs: tuple[RawFile, ...] = ()
    inventories: tuple[RawFile, ...] = ()
    failure: InputError | None = None

    @property
    def key(self) -> tuple[str, str]:
        """Identity: path and stamp."""
        return self.path, self.stamp


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
        exists = path.exists()
    except OSError:
        exists = False
    if is_folder(name):
        yield from _expand_folder(path, options)
    elif not exists and any(mark in name for mark in "*?["):
        matches = sorted(match for match in glob.glob(str(path), recursive=True) if Path(match).is_file())  # noqa: PTH207 - Path.glob takes no absolute pattern
        if not matches:
            raise RecordNotFoundError("no file matches the pattern {name}", name=name)
        yield from matches
    elif exists:
        yield name
    else:
        # an unknown name fails on reading
        with suppress(RecordNotFoundError):
            name = str(resolve_path(name))
        yield name


def is_folder(name: object) -> bool:
    """Return whether a name is that of a folder."""
    try:
        return Path(str(name)).expanduser().is_dir()
    except (OSError, RuntimeError, ValueError):  # name too long, unknown home directory, NUL character
        return False


def _expand_list(path: Path, options: ReadOptions, open_lists: tuple[str, ...]) -> Iterator[str]:
    """Yield the files of a list; names that do not exist here are looked up next to the list."""
    real_path = os.path.realpath(path)
    if real_path in open_lists:
        raise RecordNotFoundError("{name}: the record list contains itself; remove that line", name=path)
    try:
        lines = read_list(path, str(path), RecordNotFoundError).decode("utf-8-sig").splitlines()
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
        paths = sorted(path.rglob("*"))
        files = [file for file in paths if file.is_file() and not any(p.startswith(".") for p in file.relative_to(path).parts)]
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
    blob = RawFile(str(path), head)
    return bool(head.strip()) and (is_archive(head) or (_has_own_format(blob) and not _is_derived(blob)))


def _is_derived(blob: RawFile) -> bool:
    """Return whether a file has only data derived from a record."""
    head = blob.content[:HEAD_BYTES]
    return any(f.is_derived is not None and f.is_derived(head) for f in list_formats())


def _has_own_format(blob: RawFile) -> bool:
    return detect_format(blob).name != FALLBACK


def _file_set(name: str) -> tuple[tuple[str, ...], int]:
    """Return the set of a file by its name, with its folder, and the size of the set; a set of one for other names."""
    path = Path(name)
    file_sets = (f.file_set(path.name) for f in list_formats() if f.file_set is not None)
    file_set = next((item for item in file_sets if item is not None), None)
    return ((name,), 1) if file_set is None else ((str(path.parent), file_set.key.upper()), file_set.size)


def group_files(files: Iterable[str], options: ReadOptions) -> Iterator[RecordSource]:
    """Yield the recordings made up of files, in the order of their first files."""
    sets: dict[tuple[str, ...], list[str]] = {}
    for name in files:
        sets.setdefault(_file_set(name)[0], []).append(name)
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
    inventories: tuple[RawFile, ...] | None = None
    with MemberBuffer() as buffer:
        try:
            for member in iter_members(open_source(path, archive_budget), archive_budget):
                if not _may_be_member(member, options) or _is_derived(member):
                    continue
                key, size = _file_set(member.name)
                member_count += 1
                if inventories is None and options.inventory is None and _has_response(member):
                    # a first pass for StationXML files, which may stand behind the records
                    inventories = _archive_inventories(path)
                # a complete set is yielded at once, which keeps the buffer small
                if buffer.add(key, member) == size:
                    yield _archive_source(buffer.pop(key), stamp, inventories)
            if not member_count:
                unpack(open_source(path, ReadBudget()), options)  # states what is missing
                raise RecordFormatError("{name}: no record found in this archive", name=path)
        except InputError as error:
            yield RecordSource(path.name, str(path), stamp, failure=error)
        for incomplete_key in buffer.keys:
            yield _archive_source(buffer.pop(incomplete_key), stamp, inventories)


def _archive_source(members: list[RawFile], stamp: str, inventories: tuple[RawFile, ...] | None) -> RecordSource:
    return RecordSource(members[0].basename, members[0].name, stamp, blobs=tuple(members), inventories=inventories or ())


def _has_response(blob: RawFile) -> bool:
    """Return whether the format of a file takes a StationXML."""
    file_format = match_head(blob.content[:HEAD_BYTES])
    return file_format is not None and "inventory" in file_format.options


def _archive_inventories(path: Path) -> tuple[RawFile, ...]:
    """Return the StationXML files in an archive."""
    budget = ReadBudget()
    return tuple(member for member in iter_members(open_source(path, budget), budget) if is_station_xml(member.content[:HEAD_BYTES]))


def find_inventories(blob: RawFile, budget: ReadBudget) -> tuple[RawFile, ...]:
    """Return the StationXML files in the folder of a file; those named after it, if any, else all."""
    if blob.path is None:
        return ()
    paths = [path for path in _directory_files(blob.path) if path.suffix.lower() in INVENTORY_SUFFIXES]
    # BK.CMB.xml beside BK.CMB.00.HNE.mseed: a folder of a network has many StationXML files
    name_matches = [path for path in paths if blob.path.name.upper().startswith(f"{path.stem}.".upper())]
    return _load_matching(name_matches or paths, is_station_xml, budget)


def find_events(blob: RawFile, budget: ReadBudget) -> tuple[RawFile, ...]:
    """Return the QuakeML files in the folder of a file."""
    if blob.path is None:
        return ()
    return _load_matching([path for path in _directory_files(blob.path) if path.suffix.lower() in EVENT_SUFFIXES], is_quakeml, budget)


def _load_matching(paths: Iterable[Path], matches: Callable[[bytes], bool], budget: ReadBudget) -> tuple[RawFile, ...]:
    """Return those of the files whose first bytes match; unreadable ones are omitted."""
    files = []
    for path in paths:
        try:
            with path.open("rb") as stream:
                head = stream.read(HEAD_BYTES)
            if matches(head):
                files.append(RawFile(str(path), read_bytes(path, str(path), budget), path))
        except OSError:
            continue
    return tuple(files)


def _may_be_member(blob: RawFile, options: ReadOptions) -> bool:
    """Return whether a member of an archive may be a record; notes are skipped unless the options declare them to be records."""
    if options.format is not None:
        return True
    return not is_station_xml(blob.content[:HEAD_BYTES]) and (options.units is not None or _has_own_format(blob))


def unpack(blob: RawFile, options: ReadOptions) -> tuple[list[RawFile], tuple[RawFile, ...]]:
    """Return the records in an archive, nested archives included, or a file that is not an archive; and the archive's StationXML files.

    Raise RecordFormatError if the archive is damaged or no member is a record, RecordError if it exceeds a limit.
    """
    if not is_archive(blob.content[:512]):
        return [blob], ()
    members = list(iter_members(blob, options.budget))
    records = [member for member in members if _may_be_member(member, options)]
    # spectra stand beside the records in downloads of CESMD
    records = [member for member in records if not _is_derived(member)] or records
    if not records:
        for member in members:
            # a waveform format of ObsPy that states its unit, or its error about the missing one
            with suppress(RecordFormatError):
                find_format(FALLBACK).parse(member)
                records.append(member)
    if not records:
        message = "{name}: no record found in this archive (contents: {held}); expected {formats}, or a plain table"
        contents = [member.basename for member in members[:8]] or lazy_gettext("plots only")
        raise RecordFormatError(message, name=blob.name, held=contents, formats=format_titles())
    return records, tuple(member for member in members if is_station_xml(member.content[:HEAD_BYTES]))


def load_component_files(blob: RawFile, budget: ReadBudget, level: str | None = None) -> list[RawFile]:
    """Return a file and the other component files of its set in the same folder, in the order NS, EW, others, UD.

    Files belong together by their names and, where the format has such entries, by their headers. For a station with two sensors, the
    files of the same sensor or of the sensor `level`.

    Raises
    ------
    RecordError
        If a component file cannot be read.
    """
    file_format = match_head(blob.content[:HEAD_BYTES])
    if file_format is None or file_format.file_set is None or blob.path is None:
        return [blob]
    own_set = file_format.file_set(blob.path.name)
    if own_set is None:
        return [blob]
    level = level if level and own_set.level else own_set.level
    files: dict[str, RawFile] = {}
    for path in _directory_files(blob.path):
        file_set = file_format.file_set(path.name)
        if file_set is not None and (file_set.key, file_set.level) == (own_set.key, level):
            file = blob if path == blob.path else _load_file(path, blob, budget)
            if _recording_key(file_format, file) == _recording_key(file_format, blob):
                # by component: of two files with one direction, the last
                files[file_set.component] = file
    if not files or (level == own_set.level and not any(file is blob for file in files.values())):
        return [blob]
    return [files[code] for code in sorted(files, key=lambda code: (_COMPONENT_ORDER.get(code, 1.5), code))]


def _recording_key(file_format: Format, blob: RawFile) -> object:
    return None if file_format.recording_key is None else file_format.recording_key(blob.content[: 2 * HEAD_BYTES])


def _directory_files(path: Path) -> list[Path]:
    try:
        return sorted(p for p in path.parent.iterdir() if p.is_file())
    except OSError:
        return [path]


def _load_file(path: Path, origin: RawFile, budget: ReadBudget) -> RawFile:
    try:
        return RawFile(str(path), read_bytes(path, str(path), budget), path)
    except RecordError as error:
        raise RecordError("{error} (component file of the same set as {name})", error=error.message, name=origin.name) from error
