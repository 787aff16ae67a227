"""Reading of records in three stages: names to named bytes (discover), bytes to components (parse), components to records (assemble)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields, replace
from itertools import groupby
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from seisblock.core import checks
from seisblock.core.errors import ComponentError, InputError, KindError, ParameterError, RecordFormatError
from seisblock.core.i18n import lazy_gettext
from seisblock.readers._memory import trim_heap
from seisblock.readers.assemble import assemble, belongs_to_recording, is_same_recording, select_station
from seisblock.readers.discover import RecordSource, find_events, find_inventories, is_folder, iter_records, load_component_files, unpack
from seisblock.readers.event import apply_event, load_event, load_events_beside
from seisblock.readers.limits import ReadBudget
from seisblock.readers.options import ReadOptions
from seisblock.readers.parse import parse_file
from seisblock.readers.registry import HEAD_BYTES, find_format
from seisblock.readers.response import Inventories, is_station_xml, require_response
from seisblock.readers.source import STDIN, Location, RawFile, open_source, read_bytes, resolve_path, sha256_digest
from seisblock.readers.streams import is_obspy, record_from_obspy
from seisblock.records import Record
from seisblock.records.analytic import analytic_record, is_analytic
from seisblock.records.qc import run_qc
from seisblock.records.site import matches_station

ALL_STATIONS = "all"
"""Station name that selects all stations of an archive."""

_TRIM_SAMPLES = 2**20
"""Number of samples above which freed heap memory is returned to the system."""


def read(
    source: Location | Sequence[Location] | Any,
    *,
    format: str | None = None,  # noqa: A002 - the parameter name of obspy
    units: str | None = None,
    dt: float | None = None,
    station: str | None = None,
    level: str | None = None,
    location: str | None = None,
    inventory: Any = None,
    event: Any = None,
    differentiate: bool = False,
    response: str = "sensitivity",
) -> Record:
    """Return the record in a file, in the component files of one recording, or in a bundled sample.

    The samples are converted to m/s^2 and not processed: no mean is removed. ``metadata["carries_offset"]`` is True for formats whose
    samples carry an instrument offset (K-NET and KiK-net), which the caller should remove.

    Parameters
    ----------
    source : path, sequence of paths, or ObsPy Stream or Trace
        File of any registered format, or name of a bundled sample. One component file of a set, as of K-NET, includes the other
        components in the same folder. Several paths are read as ONE record; of a folder, `station` selects one. A Stream is read as by
        :meth:`~seisblock.records.Record.from_obspy`.
    format : str or None
        Name of a format, see :func:`~seisblock.core.format_names.format_names`, as ``JMA-CSV`` or ``AT2``, or ``OBSPY:`` followed by a
        format of ObsPy. None detects the format from the content.
    units : {"gal", "m/s2", "mm/s2", "g", "mg"} or None
        Unit of files that do not state it.
    dt : float or None, s
        Sampling interval of files that do not state it.
    station : str or None
        Station to select from an archive, or place in a structure; `read_all` accepts ``all`` for one record per station.
    level : {"surface", "borehole"} or None
        Sensor of a KiK-net station; the surface by default.
    location : str or None
        Sensor of a station with several: location code, ``--`` for the empty one, or with the first letters of the channels, ``00.HN``.
    inventory : path, ObsPy Inventory or None
        StationXML with the instrument response of counts; None uses a StationXML beside the file or in the archive.
    event : path, ObsPy Event or None
        QuakeML or JSON file with the earthquake; None uses a QuakeML beside a file that ObsPy reads, if its origin time matches.
    differentiate : bool
        Whether velocities of a seismometer are differentiated; they are rejected otherwise.
    response : {"sensitivity", "full"}
        Divide counts by the sensitivity, or remove the full response within the band noted in ``history``.

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
    options = _load_options(ReadOptions(format, units, dt, station, level, location, inventory, event, differentiate, response))
    if is_obspy(source):
        return record_from_obspy(
            source,
            options.inventory and options.inventory.inventory,
            event,
            units=units,
            station=station,
            location=location,
            differentiate=differentiate,
            response=response,
        )
    sources = _as_list(source)
    if not sources:
        raise ParameterError("no record given: give at least one file")
    if len(sources) == 1 and is_analytic(sources[0]):
        return _analytic_record(str(sources[0]), options)
    if len(sources) == 1 and is_folder(sources[0]):
        records = _read_folder(str(sources[0]), options)
        if len(records) > 1:
            message = "{name} contains {count} records, but one is needed: give one file"
            raise ComponentError(message, name=str(sources[0]), count=len(records))
        return records[0]
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
    location: str | None = None,
    inventory: Any = None,
    event: Any = None,
    differentiate: bool = False,
    response: str = "sensitivity",
) -> list[Record]:
    """Return the records in several files; files with a common station and start form one record.

    Parameters
    ----------
    sources : iterable of paths
        In any order; records are in the order of their first files. A file without companions among the sources is read as by `read`.
    format, units, dt, station, level, location, inventory, event, differentiate, response
        As for `read`.

    Returns
    -------
    list of Record
        In the order of the files.

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
    options = _load_options(ReadOptions(format, units, dt, station, level, location, inventory, event, differentiate, response))
    groups: list[list[OpenedSource]] = []
    names = [str(s) for s in _as_list(sources)]
    _check_duplicates(names)
    if any(map(_special_reader, names)):
        records: list[Record] = []
        for reader, run in groupby(names, _special_reader):
            if reader is None:
                # neighbouring files stay together: components of one recording may lie in several of them
                records += read_all(list(run), **options.keywords)
            else:
                records += [record for name in run for record in reader(name, options)]
        return records
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


def _special_reader(name: str) -> Callable[[str, ReadOptions], list[Record]] | None:
    """Return the reader of a name that is no file."""
    if is_analytic(name):
        return _analytic_records
    return _read_folder if is_folder(name) else None


def _analytic_records(name: str, options: ReadOptions) -> list[Record]:
    return [_analytic_record(name, options)]


def _read_folder(name: str, options: ReadOptions) -> list[Record]:
    """Return the records in a folder or an archive: those of the station in the options, else of the only station.

    Raises
    ------
    ComponentError
        If the folder lacks the station, or has several and none is selected.
    """
    selects = options.station not in (None, ALL_STATIONS)
    records: list[Record] = []
    failure: InputError | None = None
    for source in iter_records([name], options):
        try:
            records.append(read_source(source, options))
        except InputError as error:
            # of another station, it is no obstacle
            if not selects:
                raise
            failure = failure if failure is not None or isinstance(error, ComponentError) else error
    if not records:
        raise failure or ComponentError("{name}: no station {station!r}", name=name, station=options.station)
    if options.station is None:
        select_station(name, records, None)
    return records


def _analytic_record(name: str, options: ReadOptions) -> Record:
    """Return an analytic motion, which has its units and sampling interval in its name; other options of reading have no effect on it.

    Raises
    ------
    ParameterError
        If one of them is given.
    """
    # the budget is no option of the caller
    names = [f"`{f.name}`" for f in fields(options) if f.name != "budget" and getattr(options, f.name) != f.default]
    if names:
        raise ParameterError(
            "{names} has no effect on the analytic motion {motion}: omit it (a sampling interval is part of the name: dt=0.005)",
            names=names,
            motion=name,
        )
    return analytic_record(name)


def read_source(source: RecordSource, options: ReadOptions) -> Record:
    """Return the record of a discovered recording, read with a fresh budget.

    Raises
    ------
    InputError
        If the recording cannot be read.
    """
    if source.failure is not None:
        raise source.failure
    # files of a folder are read by name, members of an archive from their bytes
    if not source.blobs:
        return read(list(source.files), **options.keywords)
    options = _load_options(replace(options, budget=ReadBudget()))
    parts = [part for blob in source.blobs for part in parse_file(blob, options, lambda: source.inventories)]
    record = assemble(source.path, parts, level=_applicable_level(parts, options.level), location=options.location)
    return run_qc(apply_event(replace(record, sha256=sha256_digest(source.blobs)), options.event))


def _load_options(options: ReadOptions) -> ReadOptions:
    """Return the options with the files of inventory and event loaded."""
    require_response(options.response)
    inventory = options.inventory
    if isinstance(inventory, (str, PathLike)):
        path = resolve_path(inventory)
        file = RawFile(str(inventory), read_bytes(path, str(inventory), options.budget), path)
        if not is_station_xml(file.content[:HEAD_BYTES]):
            message = "{name}: not a StationXML file; expected the inventory of a station (level=response)"
            raise RecordFormatError(message, name=file.name)
        inventory = Inventories((file,), is_requested=True)
    elif inventory is not None and not isinstance(inventory, Inventories):
        inventory = Inventories(inventory=inventory, is_requested=True)
    return replace(options, inventory=inventory, event=None if options.event is None else load_event(options.event))


def _as_list(locations: Location | Iterable[Location]) -> list[Location]:
    if isinstance(locations, (str, PathLike)):
        return [locations]
    items = list(locations) if isinstance(locations, Iterable) else [locations]
    # a DataFrame iterates over the names of its columns
    if hasattr(locations, "columns") or not all(isinstance(item, (str, PathLike)) for item in items):
        text = "expected a path or a list of paths, found {found}; for arrays use Record.from_arrays"
        raise KindError(text, found=checks.type_name(locations))
    return items


def _check_duplicates(names: Sequence[str]) -> None:
    """Raise if a file is given more than once; results would count it as several records."""
    # two spellings of one path are one file
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
    files, inventories = unpack(blob, options)
    # anything but the file itself comes from an archive
    bundle = {} if files[0] is blob else {"bundle": blob.name}

    def companions() -> tuple[RawFile, ...]:
        return inventories or find_inventories(blob, options.budget)

    try:
        parts = [part for file in files for part in parse_file(file, options, companions)]
    except InputError:
        # of another station, it is no obstacle
        if not bundle or blob.path is None or options.station in (None, ALL_STATIONS):
            raise
        parts = [part for part in _read_folder(str(blob.path), options) if matches_station(part, options.station)]
        if not parts:
            raise
    return _drop_uncorrected([replace(part, metadata={**part.metadata, **bundle}) for part in parts]) if bundle else parts


def _drop_uncorrected(parts: list[Record]) -> list[Record]:
    """Return the parts of an archive without the uncorrected volume of stations that have a corrected one."""
    corrected = {part.station for part in parts if part.metadata.get("volume") == "V2"}
    note = lazy_gettext("corrected volume 2 used, volume 1 in the archive not")
    remaining = [part for part in parts if part.metadata.get("volume") != "V1" or part.station not in corrected]
    if len(remaining) == len(parts):
        return parts
    return [replace(part, history=(note, *part.history)) if part.station in corrected else part for part in remaining]


def _assemble_records(
    sources: Sequence[OpenedSource], options: ReadOptions, named_paths: frozenset[Path | None] = frozenset()
) -> list[Record]:
    """Return one record from sources, or one per station if all are selected; files in `named_paths` are not used as companions."""
    parts, blobs = _load_components(sources, options, named_paths)
    name = _group_name(sources)
    if options.station != ALL_STATIONS:
        records = [assemble(name, parts, station=options.station, level=options.level, location=options.location)]
    else:
        recordings: list[list[Record]] = []
        for part in parts:
            group = next((recording for recording in recordings if is_same_recording(part, recording[0])), None)
            if group is None:
                recordings.append([part])
            else:
                group.append(part)
        records = [assemble(name, p, level=_applicable_level(p, options.level), location=options.location) for p in recordings]
    sha256 = sha256_digest(blobs)
    event = options.event
    if event is None and all(find_format(part.format).aligned for part in parts):
        event = load_events_beside(find_events(blobs[0], options.budget))
    records = [run_qc(apply_event(replace(record, sha256=sha256), event)) for record in records]
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
