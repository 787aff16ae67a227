"""Reading of records in three stages: names to named bytes (discover), bytes to components (parse), components to records (assemble)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import groupby
from os import PathLike
from pathlib import Path
from typing import NamedTuple

from seisblock.core import checks
from seisblock.core.errors import ComponentError, KindError, ParameterError
from seisblock.readers._memory import trim_heap
from seisblock.readers.assemble import assemble, belongs_to_recording
from seisblock.readers.discover import RecordSource, load_component_files, unpack
from seisblock.readers.limits import ReadBudget
from seisblock.readers.options import ReadOptions
from seisblock.readers.parse import parse_file
from seisblock.readers.source import STDIN, Location, RawFile, open_source, sha256_digest
from seisblock.records import Record
from seisblock.records.analytic import analytic_record, is_analytic
from seisblock.records.qc import run_qc

ALL_STATIONS = "all"
"""Station name that selects all stations of an archive."""

_TRIM_SAMPLES = 2**20
"""Number of samples above which freed heap memory is returned to the system."""


def read(
    source: Location | Sequence[Location],
    *,
    format: str | None = None,  # noqa: A002 - the parameter name of obspy
    units: str | None = None,
    dt: float | None = None,
    station: str | None = None,
    level: str | None = None,
) -> Record:
    """Return the record in a file, in the component files of one recording, or in a bundled sample.

    The samples are converted to m/s^2 and not processed: no mean is removed. ``metadata["carries_offset"]`` is True for formats whose
    samples carry an instrument offset (K-NET and KiK-net), which the caller should remove.

    Parameters
    ----------
    source : path, or sequence of paths
        File of any registered format, or name of a bundled sample. One component file of a set, as of K-NET, includes the other
        components in the same folder. Several paths are read as ONE record.
    format : str or None
        Name of a format, see :func:`~seisblock.core.format_names.format_names`, as ``JMA-CSV`` or ``AT2``, or ``OBSPY:`` followed by a
        format of obspy. None detects the format from the content.
    units : {"gal", "m/s2", "mm/s2", "g", "mg"} or None
        Unit of files that do not state it.
    dt : float or None, s
        Sampling interval of files that do not state it.
    station : str or None
        Station to select from an archive, or place in a structure; `read_all` accepts ``all`` for one record per station.
    level : {"surface", "borehole"} or None
        Sensor of a KiK-net station; the surface by default.

    Returns
    -------
    Record
        Components ``NS``, ``EW``, ``UD`` (positive north, east, up) where the file gives them, else named as in the file or by azimuth in
        degrees clockwise from north; start in UTC; ``sha256`` of the bytes of all files in order; ``doubts``, the quality flags of file
        and samples.

    Raises
    ------
    RecordNotFoundError
        If there is no such file or sample.
    RecordError
        If a limit is exceeded; the message names the environment variable that raises it.
    RecordFormatError
        If the file is malformed; the message names the line.
    UnitError, ParameterError
        If a unit or the sampling interval is missing or contradicts the file.
    ComponentError
        If a station or level is missing or must be selected.

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
    if len(sources) == 1 and is_analytic(sources[0]):
        return analytic_record(str(sources[0]))
    group = [_open_and_parse(s, options) for s in sources]
    stations = {part.station for opened_source in group for part in opened_source.parts}
    if station == ALL_STATIONS and len(stations) > 1:
        message = "{name} contains {count} stations, but one record is needed; select one with `station`"
        raise ComponentError(message, name=_group_name(group), count=len(stations))
    (record,) = _assemble_records(group, replace(options, station=None if station == ALL_STATIONS else station))
    return record


def read_all(
    sources: Iterable[Location],
    *,
    format: str | None = None,  # noqa: A002
    units: str | None = None,
    dt: float | None = None,
    station: str | None = None,
    level: str | None = None,
) -> list[Record]:
    """Return the records in several files; files with a common station and start form one record.

    Parameters
    ----------
    sources : iterable of paths
        In any order; records are in the order of their first files. A file without companions among the sources is read as by `read`.
    format, units, dt, station, level
        As for `read`.

    Raises
    ------
    InputError
        As for `read`.

    Examples
    --------
    >>> from seisblock.readers import read_all
    >>> [record.codes for record in read_all(["synthetic_jma.csv", "elcentro_1940_ns.csv"])]
    [('NS', 'EW', 'UD'), ('NS',)]
    """
    options = ReadOptions(format, units, dt, station, level)
    groups: list[list[OpenedSource]] = []
    names = [str(s) for s in _as_list(sources)]
    _check_duplicates(names)
    if any(map(is_analytic, names)):
        runs = [(analytic, list(run)) for analytic, run in groupby(names, is_analytic)]
        keywords = {"format": format, "units": units, "dt": dt, "station": station, "level": level}
        return [r for analytic, run in runs for r in (map(analytic_record, run) if analytic else read_all(run, **keywords))]  # type: ignore[arg-type]
    for name in names:
        source = _open_and_parse(name, options)
        matching_groups = (g for g in groups if belongs_to_recording(source.parts, [part for member in g for part in member.parts]))
        group = next(matching_groups, None)
        if group is None:
            groups.append([source])
        else:
            group.append(source)
    named_paths = frozenset(opened_source.blob.path for g in groups for opened_source in g)
    return [record for g in groups for record in _assemble_records(g, options, named_paths)]


def read_source(source: RecordSource, options: ReadOptions) -> Record:
    """Return the record of a discovered recording, read with a fresh budget.

    Raises
    ------
    InputError
        If the recording cannot be read.
    """
    if source.failure is not None:
        raise source.failure
    if not source.blobs:
        return read(list(source.files), **options.keywords)
    options = replace(options, budget=ReadBudget())
    parts = [part for blob in source.blobs for part in parse_file(blob, options)]
    record = assemble(source.path, parts, level=_applicable_level(parts, options.level))
    return run_qc(replace(record, sha256=sha256_digest(source.blobs)))


def _as_list(locations: Location | Iterable[Location]) -> list[Location]:
    if isinstance(locations, (str, PathLike)):
        return [locations]
    if not isinstance(locations, Iterable):
        raise KindError("expected a path or a list of paths, found {found}", found=checks.type_name(locations))
    return list(locations)


def _check_duplicates(names: Sequence[str]) -> None:
    """Raise if a file is given more than once; results would count it as several records."""
    counts = Counter(STDIN if name == STDIN else str(Path(name).absolute()) for name in names)
    for name in names:
        count = counts[STDIN if name == STDIN else str(Path(name).absolute())]
        if count > 1:
            raise ParameterError("{name} is given {count} times; give each record once", name=name, count=count)


class OpenedSource(NamedTuple):
    """Bytes of a source as given, and the parts read from them."""

    blob: RawFile
    parts: list[Record]


def _open_and_parse(source: Location, options: ReadOptions) -> OpenedSource:
    blob = open_source(source, options.budget)
    return OpenedSource(blob, _parse_parts(blob, options))


def _group_name(group: Sequence[OpenedSource]) -> str:
    return ", ".join(opened_source.blob.name for opened_source in group)


def _parse_parts(blob: RawFile, options: ReadOptions) -> list[Record]:
    """Return the records, or single components, in a file or an archive."""
    files = unpack(blob, options)
    bundle = {} if files[0] is blob else {"bundle": blob.name}
    parts = [part for file in files for part in parse_file(file, options)]
    return [replace(part, metadata={**part.metadata, **bundle}) for part in parts] if bundle else parts


def _assemble_records(
    group: Sequence[OpenedSource], options: ReadOptions, named_paths: frozenset[Path | None] = frozenset()
) -> list[Record]:
    """Return one record from sources, or one per station if all are selected; files in `named_paths` are not used as companions."""
    parts, blobs = _load_components(group, options, named_paths)
    name = _group_name(group)
    if options.station != ALL_STATIONS:
        records = [assemble(name, parts, station=options.station, level=options.level)]
    else:
        recordings: dict[tuple[object, ...], list[Record]] = {}
        for part in parts:
            recordings.setdefault((part.station, part.start, part.metadata.get("event")), []).append(part)
        records = [assemble(name, p, level=_applicable_level(p, options.level)) for p in recordings.values()]
    sha256 = sha256_digest(blobs)
    records = [run_qc(replace(record, sha256=sha256)) for record in records]
    if max(len(record.components) * record.samples for record in records) > _TRIM_SAMPLES:
        trim_heap()
    return records


def _load_components(
    group: Sequence[OpenedSource], options: ReadOptions, named_paths: frozenset[Path | None]
) -> tuple[list[Record], list[RawFile]]:
    """Return parts and bytes of sources; a single file includes its companion files, but for those that are sources themselves."""
    blobs = [opened_source.blob for opened_source in group]
    parts = [part for opened_source in group for part in opened_source.parts]
    if len(group) > 1:
        return parts, blobs
    family = [b for b in load_component_files(blobs[0], options.budget, options.level) if b is blobs[0] or b.path not in named_paths]
    return [part for b in family for part in (parts if b is blobs[0] else _parse_parts(b, options))], family


def _applicable_level(parts: Sequence[Record], level: str | None) -> str | None:
    """Return the requested level if any part has one: archives may mix stations with and without a borehole."""
    return level if any("level" in part.metadata for part in parts) else None
