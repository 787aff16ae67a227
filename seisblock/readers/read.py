"""From a name, or several, to a record or several."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path

from seisblock.core import checks
from seisblock.core.errors import ComponentError, KindError, ParameterError
from seisblock.readers._memory import trim_heap
from seisblock.readers.assemble import assemble, belongs_to_recording
from seisblock.readers.components import load_component_files
from seisblock.readers.dispatch import ReadOptions, read_parts
from seisblock.readers.source import STDIN, Location, RawFile, open_source, sha256_digest
from seisblock.records import Record
from seisblock.records.qc import run_qc

ALL_STATIONS = "all"
"""The station that stands for every station of a bundle."""

_TRIM_SAMPLES = 2**20
"""Samples from which on it is worth while to let go of what reading them left behind."""


def read(
    source: Location | Sequence[Location],
    *,
    format: str | None = None,  # noqa: A002 - the word users know from obspy
    units: str | None = None,
    dt: float | None = None,
    station: str | None = None,
    level: str | None = None,
) -> Record:
    """Return the record in a file, in the files of one recording, or among the bundled samples.

    The samples are kept as the file has them, converted to m/s^2: no mean is removed. ``metadata["carries_offset"]`` is True for the
    formats whose samples carry an instrument's offset (K-NET and KiK-net), where a caller should remove it.

    Parameters
    ----------
    source : path, or sequence of paths
        A file of any format told below, or the name of a bundled sample. One component of a three-file set (K-NET, KiK-net, PEER AT2,
        SMC, ESM, COSMOS) stands for its siblings beside it. Several paths are read as ONE record.
    format : str or None
        ``JMA-CSV``, ``KNET``, ``KIKNET``, ``KNET-CSV``, ``AT2``, ``CSMIP``, ``COSMOS``, ``SMC``, ``ESM``, ``GEONET``, ``CWA``, ``CSV``, or
        ``OBSPY:`` and a format of obspy. None: the content decides.
    units : {"gal", "m/s2", "mm/s2", "g", "mg"} or None
        Of files that do not name theirs.
    dt : float or None, s
        Sampling interval of files that do not tell theirs.
    station : str or None
        Code of the station to take from a bundle of several, or of the place in a structure; `read_all` takes ``all``, a record for each.
    level : {"surface", "borehole"} or None
        Sensor of a KiK-net station; the surface by default.

    Returns
    -------
    Record
        Components ``NS``, ``EW``, ``UD`` (positive north, east, up) where the file tells them, else under the file's own names or
        azimuths in degrees clockwise from north; start in UTC; ``sha256`` of the bytes of all files in order; ``doubts``, what a careful
        reader notices in the file and in the samples.

    Raises
    ------
    RecordNotFoundError
        If there is no such file or sample.
    RecordError
        If it is too large: the message names the environment variable that lifts the limit.
    RecordFormatError
        If the content breaks its format; the message names the line.
    UnitError, ParameterError
        If a unit or the sampling interval is missing or contradicts the file.
    ComponentError
        If a station or level is missing or must be chosen.

    Examples
    --------
    >>> record = read("synthetic_jma.csv")
    >>> record.codes, record.dt, record.samples
    (('NS', 'EW', 'UD'), 0.01, 6000)
    """
    options = ReadOptions(format, units, dt, station, level)
    sources = _as_list(source)
    if not sources:
        raise ParameterError("no record given: give at least one file")
    return _assemble_record([_open_and_parse(s, options) for s in sources], options)


def read_all(
    sources: Iterable[Location],
    *,
    format: str | None = None,  # noqa: A002
    units: str | None = None,
    dt: float | None = None,
    station: str | None = None,
    level: str | None = None,
) -> list[Record]:
    """Return the records in several files: those that share a station and a start are one record.

    Parameters
    ----------
    sources : iterable of paths
        In any order; records come in the order of their first file. A file that shares its recording with no other is read as by `read`.
    format, units, dt, station, level
        As for `read`.

    Raises
    ------
    InputError
        As `read` does.

    Examples
    --------
    >>> [record.codes for record in read_all(["synthetic_jma.csv", "elcentro_1940_ns.csv"])]
    [('NS', 'EW', 'UD'), ('NS',)]
    """
    options = ReadOptions(format, units, dt, station, level)
    groups: list[list[OpenedSource]] = []
    names = [str(s) for s in _as_list(sources)]
    _check_duplicates(names)
    for name in names:
        opened_source = _open_and_parse(name, options)
        matching_group = next(
            (g for g in groups if belongs_to_recording(opened_source.parts, [part for member in g for part in member.parts])), None
        )
        if matching_group is None:
            groups.append([opened_source])
        else:
            matching_group.append(opened_source)
    named_paths = frozenset(opened_source.blob.path for g in groups for opened_source in g)
    return [record for g in groups for record in _assemble_records(g, options, named_paths)]


def record_from_files(name: str, blobs: Sequence[RawFile], options: ReadOptions) -> Record:
    """Return the record that some bytes make, called `name` in messages; no sibling is looked for.

    Raises
    ------
    InputError
        As `read` does.
    """
    parts = [part for blob in blobs for part in read_parts(blob, options)]
    return run_qc(replace(assemble(name, parts, level=_applicable_level(parts, options.level)), sha256=sha256_digest(blobs)))


def _as_list(locations: Location | Iterable[Location]) -> list[Location]:
    """Return what was named as a list: one path, or several."""
    if isinstance(locations, (str, PathLike)):
        return [locations]
    if not isinstance(locations, Iterable):
        raise KindError("expected a path or a list of paths, found {found}", found=checks.type_name(locations))
    return list(locations)


def _check_duplicates(names: Sequence[str]) -> None:
    """Refuse files that are named more than once: an answer would count them as several records, or the user meant another one."""
    counts = Counter(str(Path(name).absolute()) for name in names if name != STDIN)
    repeated_names = [name for name in dict.fromkeys(names) if counts[str(Path(name).absolute())] > 1]
    if repeated_names or names.count(STDIN) > 1:
        raise ParameterError(
            "{name} is given {count} times; give each record once",
            name=repeated_names[0] if repeated_names else STDIN,
            count=counts[str(Path(repeated_names[0]).absolute())] if repeated_names else names.count(STDIN),
        )


@dataclass(frozen=True)
class OpenedSource:
    """One source as named, its bytes and the parts in them."""

    name: str
    blob: RawFile
    parts: list[Record]


def _open_and_parse(source: Location, options: ReadOptions) -> OpenedSource:
    """Return a source with its bytes and the parts in them."""
    blob = open_source(source, options.budget)
    return OpenedSource(blob.name, blob, read_parts(blob, options))


def _assemble_records(group: Sequence[OpenedSource], options: ReadOptions, named_paths: frozenset[Path | None]) -> list[Record]:
    """Return the one record that some sources make, or those of every station when all are asked for."""
    if options.station != ALL_STATIONS:
        return [_assemble_record(group, options, named_paths)]
    name, parts, blobs = _load_components(group, options, named_paths)
    recordings: dict[tuple[object, ...], list[Record]] = {}
    for part in parts:
        recordings.setdefault((part.station, part.start, part.metadata.get("event")), []).append(part)
    sha256 = sha256_digest(blobs)
    return [
        _finish_record(replace(assemble(name, group_parts, level=_applicable_level(group_parts, options.level)), sha256=sha256))
        for group_parts in recordings.values()
    ]


def _assemble_record(group: Sequence[OpenedSource], options: ReadOptions, named_paths: frozenset[Path | None] = frozenset()) -> Record:
    """Return the one record that some sources make; `named_paths` are files that speak for themselves."""
    name, parts, blobs = _load_components(group, options, named_paths)
    if options.station == ALL_STATIONS:
        station_codes = list(dict.fromkeys(part.station for part in parts))
        if len(station_codes) > 1:
            raise ComponentError(
                "{name} contains {count} stations, but one record is needed; select one with `station`", name=name, count=len(station_codes)
            )
    record = assemble(name, parts, station=None if options.station == ALL_STATIONS else options.station, level=options.level)
    return _finish_record(replace(record, sha256=sha256_digest(blobs)))


def _finish_record(record: Record) -> Record:
    """Return a record with what its samples tell; what reading and looking took is the system's again."""
    checked = run_qc(record)
    if len(record.components) * record.components[0].acceleration.size > _TRIM_SAMPLES:
        trim_heap()
    return checked


def _load_components(
    group: Sequence[OpenedSource], options: ReadOptions, named_paths: frozenset[Path | None]
) -> tuple[str, list[Record], list[RawFile]]:
    """Return the name, the parts and the bytes of some sources, a lone file with its siblings."""
    name = ", ".join(opened_source.name for opened_source in group)
    blobs = [opened_source.blob for opened_source in group]
    parts = [part for opened_source in group for part in opened_source.parts]
    if len(group) == 1:
        siblings = load_component_files(blobs[0], options.budget, options.level)
        family = [b for b in siblings if b is blobs[0] or b.path not in named_paths]
        if family != blobs:
            parts = [part for blob in family for part in (group[0].parts if blob is blobs[0] else read_parts(blob, options))]
            blobs = family
    return name, parts, blobs


def _applicable_level(parts: Sequence[Record], level: str | None) -> str | None:
    """Return the level asked for where there is one: a bundle mixes stations with and without a borehole."""
    return level if any("level" in part.metadata for part in parts) else None
