"""Records and motions from the record options."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from seisblock.cli.console import always, info, warning
from seisblock.cli.options import Source
from seisblock.cli.progress import progress, set_task
from seisblock.cli.verbosity import is_quiet
from seisblock.core.errors import ComponentError, ParameterError
from seisblock.records import Motion, Preparation, Record, motion_of


def load_records(source: Source, *, vertical_counts: bool = False, keep_whole: bool = False, use_recording: bool = False) -> list[Record]:
    """Read the records of a command and apply the record options.

    Parameters
    ----------
    source : Source
        The record options.
    vertical_counts : bool
        Whether the vertical component is among those a command looks at by default.
    keep_whole : bool
        Whether the record stays whole, because its windows are the solver's.
    use_recording : bool
        Whether a recording stands for none, instead of the synthetic sample.
    """
    if not keep_whole:
        check_single_window(source)
    from seisblock.readers import read_all
    from seisblock.samples import DEFAULT_SAMPLE, REAL_SAMPLE

    names: tuple[str, ...] = source.record
    if not names and use_recording:
        names = (REAL_SAMPLE,)
        info("no RECORD given: using the bundled sample {name}", name=REAL_SAMPLE)
    elif not names:
        names = (DEFAULT_SAMPLE,)
        info("no RECORD given: using the bundled sample {name} (synthetic)", name=DEFAULT_SAMPLE)
    with progress("reading {names}", names=[Path(name).name for name in names]):
        records = read_all(names, format=source.format, units=source.units, dt=source.dt, station=source.station, level=source.level)
        results = [_prepare(record, source, vertical_counts=vertical_counts, keep_whole=keep_whole) for record in records]
    report_qc(results, strict=source.strict)
    set_task("computing")
    return results


def report_qc(records: list[Record], *, strict: bool) -> None:
    """Print the quality warnings of the records, in one line with ``--quiet``; with `strict`, raise an error."""
    from seisblock.records.qc_report import qc_summary, require_clean

    if strict:
        for record in records:
            require_clean(record)
    messages = qc_summary(records)
    if messages and is_quiet():
        always("{names}: {doubts}", names=[record.source for record in records if record.doubts], doubts=messages)
    for message in messages:
        warning(message)


def _prepare(record: Record, source: Source, *, vertical_counts: bool, keep_whole: bool) -> Record:
    peaks = () if source.target_pga is None else selected_components(record, source, vertical_counts=vertical_counts)
    record = make_preparation(source, peaks, keep_whole=keep_whole).apply(record)
    for line in record.history:
        info("{record}: {did}", record=record.station or record.source, did=line)
    return record


def make_preparation(source: Source, peaks: tuple[str, ...], *, keep_whole: bool = False) -> Preparation:
    """Return the preparation of a record; `peaks` are the components of the target PGA."""
    return Preparation(
        demean=source.demean,
        highpass_hz=source.highpass,
        scale=1.0 if source.scale is None else source.scale,
        target_pga=None if source.target_pga is None else source.target_pga / 100.0,
        components=peaks,
        window=source.window[0] if source.window and not keep_whole else None,
        floor=source.floor,
    )


def check_single_window(source: Source) -> None:
    """Raise an error for several windows."""
    if len(source.window) > 1:
        raise ParameterError("this command accepts one --window, found {count}", count=len(source.window))


def selected_components(record: Record, source: Source, *, vertical_counts: bool = False) -> tuple[str, ...]:
    """Return the components or azimuths selected by the options."""
    available = record.codes if vertical_counts else tuple(c.code for c in record.horizontals)
    requested = source.component
    if not requested or any(name.lower() == "all" for name in requested):
        if not available:
            raise ComponentError("{source}: no horizontal component; available: {codes}", source=record.source, codes=record.codes)
        return available
    return requested


def selected_motions(record: Record, source: Source) -> Iterator[Motion]:
    """Yield one motion for each selected horizontal direction."""
    for name in selected_components(record, source):
        yield motion_of(record, name)
