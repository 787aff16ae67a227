"""From the record options to prepared records and motions; physics lives in the library."""

from __future__ import annotations

from collections.abc import Iterator

from seisblock.cli.options import Source
from seisblock.cli.talk import say
from seisblock.errors import ComponentError, ParameterError
from seisblock.records import Motion, Record, motion_of


def load(source: Source, *, vertical_counts: bool = False, several_windows: bool = False) -> list[Record]:
    """Read the records a command was given and prepare them as its options ask.

    Parameters
    ----------
    source : Source
        The record options.
    vertical_counts : bool
        Whether the vertical component is among those a command looks at by default.
    several_windows : bool
        Whether the command cuts its windows itself, with :func:`windows`.
    """
    if len(source.window) > 1 and not several_windows:
        raise ParameterError(f"this command takes one --window, found {len(source.window)}")
    from seisblock.readers import DEFAULT_SAMPLE, read_all

    names: tuple[str, ...] = source.record
    if not names:
        names = (DEFAULT_SAMPLE,)
        say(f"no RECORD given: using the bundled sample {DEFAULT_SAMPLE} (synthetic)")
    records = read_all(names, format=source.format, units=source.units, dt=source.dt, station=source.station, level=source.level)
    prepared = [prepare(record, source, vertical_counts=vertical_counts) for record in records]
    return prepared if several_windows else [cut for record in prepared for cut in windows(record, source)]


def prepare(record: Record, source: Source, *, vertical_counts: bool = False) -> Record:
    """Apply demean, high-pass and scale, in this order, each logged in the record's history."""
    from seisblock.records import process

    for message in record.metadata.get("warnings", ()):  # type: ignore[attr-defined]
        say(f"warning: {message}")
    if source.demean or (source.demean is None and record.metadata.get("carries_offset")):
        record = process.demean(record)
    if source.highpass is not None:
        record = process.highpass(record, source.highpass)
    if source.scale is not None:
        record = process.scale(record, source.scale)
    if source.target_pga is not None:
        chosen = components(record, source, vertical_counts=vertical_counts)
        record = process.scale_to_pga(record, source.target_pga / 100.0, chosen)
    for line in record.history:
        say(f"{record.station or record.source}: {line}")
    return record


def windows(record: Record, source: Source) -> list[Record]:
    """Return the record cut to each window asked for, or whole."""
    from seisblock.records import process

    return [process.crop(record, first, last) for first, last in source.window] or [record]


def components(record: Record, source: Source, *, vertical_counts: bool = False) -> tuple[str, ...]:
    """Return the components, or azimuths, that a command is asked to look at."""
    every = record.codes if vertical_counts else tuple(c.code for c in record.horizontals)
    asked = source.component
    if not asked or any(name.lower() == "all" for name in asked):
        if not every:
            raise ComponentError(f"{record.source}: no horizontal component; it has {', '.join(record.codes)}")
        return every
    return asked


def motions(record: Record, source: Source) -> Iterator[Motion]:
    """Yield one motion for each horizontal direction asked for."""
    for name in components(record, source):
        yield motion_of(record, name)
