"""From a name, or several, to a record or several."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path

from seisblock import checks
from seisblock.errors import ComponentError, KindError, ParameterError
from seisblock.readers.assemble import assemble, continues
from seisblock.readers.dispatch import Options, parts_of
from seisblock.readers.heap import give_back
from seisblock.readers.siblings import with_siblings
from seisblock.readers.source import STDIN, Blob, Location, digest, fetch
from seisblock.records import Record
from seisblock.records.signs import examined

ALL = "all"
"""The station that stands for every station of a bundle."""

_MANY = 2**20
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
    options = Options(format, units, dt, station, level)
    sources = _listed(source)
    if not sources:
        raise ParameterError("no file was named: give at least one record")
    return _record_of([_open(s, options) for s in sources], options)


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
    options = Options(format, units, dt, station, level)
    groups: list[list[Opened]] = []
    names = [str(s) for s in _listed(sources)]
    _refuse_repeats(names)
    for name in names:
        opened = _open(name, options)
        home = next((g for g in groups if continues(opened.parts, [part for other in g for part in other.parts])), None)
        if home is None:
            groups.append([opened])
        else:
            home.append(opened)
    named = frozenset(opened.blob.path for g in groups for opened in g)
    return [record for g in groups for record in _records_of(g, options, named)]


def record_of_blobs(name: str, blobs: Sequence[Blob], options: Options) -> Record:
    """Return the record that some bytes make, called `name` in messages; no sibling is looked for.

    Raises
    ------
    InputError
        As `read` does.
    """
    parts = [part for blob in blobs for part in parts_of(blob, options)]
    return examined(replace(assemble(name, parts, level=_level(parts, options.level)), sha256=digest(blobs)))


def _listed(given: Location | Iterable[Location]) -> list[Location]:
    """Return what was named as a list: one path, or several."""
    if isinstance(given, (str, PathLike)):
        return [given]
    if not isinstance(given, Iterable):
        raise KindError("a path is needed, or a list of paths, found {found}", found=checks.kind_of(given))
    return list(given)


def _refuse_repeats(names: Sequence[str]) -> None:
    """Refuse files that are named more than once: an answer would count them as several records, or the user meant another one."""
    counts = Counter(str(Path(name).absolute()) for name in names if name != STDIN)
    repeated = [name for name in dict.fromkeys(names) if counts[str(Path(name).absolute())] > 1]
    if repeated or names.count(STDIN) > 1:
        raise ParameterError(
            "{name} is named {count} times among the records: name each file once",
            name=repeated[0] if repeated else STDIN,
            count=counts[str(Path(repeated[0]).absolute())] if repeated else names.count(STDIN),
        )


@dataclass(frozen=True)
class Opened:
    """One source as named, its bytes and the parts in them."""

    name: str
    blob: Blob
    parts: list[Record]


def _open(source: Location, options: Options) -> Opened:
    """Return a source with its bytes and the parts in them."""
    blob = fetch(source, options.budget)
    return Opened(blob.name, blob, parts_of(blob, options))


def _records_of(group: Sequence[Opened], options: Options, named: frozenset[Path | None]) -> list[Record]:
    """Return the one record that some sources make, or those of every station when all are asked for."""
    if options.station != ALL:
        return [_record_of(group, options, named)]
    name, parts, blobs = _family(group, options, named)
    recordings: dict[tuple[object, ...], list[Record]] = {}
    for part in parts:
        recordings.setdefault((part.station, part.start, part.metadata.get("event")), []).append(part)
    sha256 = digest(blobs)
    return [_examined(replace(assemble(name, each, level=_level(each, options.level)), sha256=sha256)) for each in recordings.values()]


def _record_of(group: Sequence[Opened], options: Options, named: frozenset[Path | None] = frozenset()) -> Record:
    """Return the one record that some sources make; `named` are files that speak for themselves."""
    name, parts, blobs = _family(group, options, named)
    if options.station == ALL:
        stations = list(dict.fromkeys(part.station for part in parts))
        if len(stations) > 1:
            raise ComponentError("{name} holds {count} stations, and one record was asked for: choose one", name=name, count=len(stations))
    record = assemble(name, parts, station=None if options.station == ALL else options.station, level=options.level)
    return _examined(replace(record, sha256=digest(blobs)))


def _examined(record: Record) -> Record:
    """Return a record with what its samples tell; what reading and looking took is the system's again."""
    told = examined(record)
    if len(record.components) * record.components[0].acceleration.size > _MANY:
        give_back()
    return told


def _family(group: Sequence[Opened], options: Options, named: frozenset[Path | None]) -> tuple[str, list[Record], list[Blob]]:
    """Return the name, the parts and the bytes of some sources, a lone file with its siblings."""
    name = ", ".join(opened.name for opened in group)
    blobs = [opened.blob for opened in group]
    parts = [part for opened in group for part in opened.parts]
    if len(group) == 1:
        siblings = with_siblings(blobs[0], options.budget, options.level)
        family = [b for b in siblings if b is blobs[0] or b.path not in named]
        if family != blobs:
            parts = [part for blob in family for part in (group[0].parts if blob is blobs[0] else parts_of(blob, options))]
            blobs = family
    return name, parts, blobs


def _level(parts: Sequence[Record], level: str | None) -> str | None:
    """Return the level asked for where there is one: a bundle mixes stations with and without a borehole."""
    return level if any("level" in part.metadata for part in parts) else None
