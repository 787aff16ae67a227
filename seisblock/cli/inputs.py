"""From the record options to prepared records and motions; physics lives in the library."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from seisblock.cli.options import Source
from seisblock.cli.progress import at_work, progress
from seisblock.cli.quiet import is_quiet
from seisblock.cli.talk import insist, say, warn
from seisblock.errors import ComponentError, ParameterError
from seisblock.records import Motion, Preparation, Record, motion_of


def load(source: Source, *, vertical_counts: bool = False, whole: bool = False, real: bool = False) -> list[Record]:
    """Read the records a command was given and prepare them as its options ask.

    Parameters
    ----------
    source : Source
        The record options.
    vertical_counts : bool
        Whether the vertical component is among those a command looks at by default.
    whole : bool
        Whether the record stays whole, because its windows are the solver's.
    real : bool
        Whether a recording stands for none, instead of the synthetic sample.
    """
    if not whole:
        refuse_windows(source)
    from seisblock.readers import DEFAULT_SAMPLE, REAL_SAMPLE, read_all

    names: tuple[str, ...] = source.record
    if not names and real:
        names = (REAL_SAMPLE,)
        say("no RECORD given: using the bundled sample {name}", name=REAL_SAMPLE)
    elif not names:
        names = (DEFAULT_SAMPLE,)
        say("no RECORD given: using the bundled sample {name} (synthetic)", name=DEFAULT_SAMPLE)
    with progress("reading {names}", names=[Path(name).name for name in names]):
        records = read_all(names, format=source.format, units=source.units, dt=source.dt, station=source.station, level=source.level)
        prepared = [_prepared(record, source, vertical_counts=vertical_counts, whole=whole) for record in records]
    tell_doubts(prepared, strict=source.strict)
    at_work("computing")
    return prepared


def tell_doubts(records: list[Record], *, strict: bool) -> None:
    """Say what is doubtful about the records, in one line where silence was asked for, or refuse them."""
    from seisblock.records.doubtful import refuse_doubtful, sentences

    if strict:
        for record in records:
            refuse_doubtful(record)
    doubts = sentences(records)
    if doubts and is_quiet():
        insist("{names}: {doubts}", names=[record.source for record in records if record.doubts], doubts=doubts)
    for doubt in doubts:
        warn(doubt)


def _prepared(record: Record, source: Source, *, vertical_counts: bool, whole: bool) -> Record:
    """Return a record that went through the steps asked for, and say them."""
    peaks = () if source.target_pga is None else components(record, source, vertical_counts=vertical_counts)
    record = preparation_of(source, peaks, whole=whole).apply(record)
    for line in record.history:
        say("{record}: {did}", record=record.station or record.source, did=line)
    return record


def preparation_of(source: Source, peaks: tuple[str, ...], *, whole: bool = False) -> Preparation:
    """Return what the options ask to be done to a record; `peaks` are the components among which the target PGA is looked for."""
    return Preparation(
        demean=source.demean,
        highpass_hz=source.highpass,
        scale=1.0 if source.scale is None else source.scale,
        target_pga=None if source.target_pga is None else source.target_pga / 100.0,
        components=peaks,
        window=source.window[0] if source.window and not whole else None,
        floor=source.floor,
    )


def refuse_windows(source: Source) -> None:
    """Refuse several windows where a command takes one."""
    if len(source.window) > 1:
        raise ParameterError("this command takes one --window, found {count}", count=len(source.window))


def components(record: Record, source: Source, *, vertical_counts: bool = False) -> tuple[str, ...]:
    """Return the components, or azimuths, that a command is asked to look at."""
    every = record.codes if vertical_counts else tuple(c.code for c in record.horizontals)
    asked = source.component
    if not asked or any(name.lower() == "all" for name in asked):
        if not every:
            raise ComponentError("{source}: no horizontal component; it has {codes}", source=record.source, codes=record.codes)
        return every
    return asked


def motions(record: Record, source: Source) -> Iterator[Motion]:
    """Yield one motion for each horizontal direction asked for."""
    for name in components(record, source):
        yield motion_of(record, name)
