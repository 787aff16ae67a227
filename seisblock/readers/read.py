"""Reading of records: files, component sets, archives and bundled samples."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
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
        File of any format listed below, or name of a bundled sample. One component of a set (K-NET, KiK-net, PEER AT2, SMC, ESM, COSMOS)
        includes the other components in the same folder. Several paths are read as ONE record.
    format : str or None
        ``JMA-CSV``, ``KNET``, ``KIKNET``, ``KNET-CSV``, ``AT2``, ``CSMIP``, ``COSMOS``, ``SMC``, ``ESM``, ``GEONET``, ``CWA``, ``CSV``, or
        ``OBSPY:`` followed by a format of obspy. None detects the format from the content.
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
    """Return the record in the given bytes, without a search for companion files.

    Raises
    ------
    InputError
        As for `read`.
    """
    parts = [part for blob in blobs for part in read_parts(blob, options)]
    return run_qc(replace(assemble(name, parts, level=_applicable_level(parts, options.level)), sha256=sha256_digest(blobs)))


def _as_list(locations: Location | Iterable[Location]) -> list[Location]:
    if isinstance(locations, (str, PathLike)):
        return [locations]
    if not isinstance(locations, Iterable):
        raise KindError("expected a path or a list of paths, found {found}", found=checks.type_name(locations))
    return list(locations)


def _check_duplicates(names: Sequence[str]) -> None:
    """Raise if a file is given more than once; results would count it as several records."""
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
    """Source as given, with its bytes and the parts read from them."""

    name: str
    blob: RawFile
    parts: list[Record]


def _open_and_parse(source: Location, options: ReadOptions) -> OpenedSource:
    blob = open_source(source, options.budget)
    return OpenedSource(blob.name, blob, read_parts(blob, options))


def _assemble_records(group: Sequence[OpenedSource], options: ReadOptions, named_paths: frozenset[Path | None]) -> list[Record]:
    """Return one record from sources, or one per station if all are selected."""
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
    """Return one record from sources; files in `named_paths` are not used as companions."""
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
    """Return a record with the flags of :func:`run_qc`, and release memory after large ones."""
    checked = run_qc(record)
    if len(record.components) * record.components[0].acceleration.size > _TRIM_SAMPLES:
        trim_heap()
    return checked


def _load_components(
    group: Sequence[OpenedSource], options: ReadOptions, named_paths: frozenset[Path | None]
) -> tuple[str, list[Record], list[RawFile]]:
    """Return name, parts and bytes of sources; a single file includes its companion files."""
    name = ", ".join(opened_source.name for opened_source in group)
    blobs = [opened_source.blob for opened_source in group]
    parts = [part for opened_source in group for part in opened_source.parts]
    if len(group) == 1:
        siblings = load_component_files(blobs[0], options.budget, options.level)
        # companions that are sources themselves are not read twice
        family = [b for b in siblings if b is blobs[0] or b.path not in named_paths]
        if family != blobs:
            parts = [part for blob in family for part in (group[0].parts if blob is blobs[0] else read_parts(blob, options))]
            blobs = family
    return name, parts, blobs


def _applicable_level(parts: Sequence[Record], level: str | None) -> str | None:
    """Return the requested level if any part has one: archives may mix stations with and without a borehole."""
    return level if any("level" in part.metadata for part in parts) else None
