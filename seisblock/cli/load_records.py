"""Records and motions from the record options."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from seisblock.cli.console import always, info, note_default_record, warning
from seisblock.cli.options import Source
from seisblock.cli.progress import progress, set_task
from seisblock.cli.verbosity import is_quiet
from seisblock.core.errors import InputError, ParameterError
from seisblock.core.i18n import gettext
from seisblock.output.text.record_info import format_step
from seisblock.records import Motion, Preparation, Record, motion_of
from seisblock.records.process import require_horizontals

MAX_HISTORIES = 5
"""Most records whose processing is printed."""


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
    from seisblock.samples import DEFAULT_SAMPLE, REAL_SAMPLE

    names: tuple[str, ...] = source.record
    if not names and use_recording:
        names = (REAL_SAMPLE,)
        note_default_record(REAL_SAMPLE, synthetic=False)
    elif not names:
        names = (DEFAULT_SAMPLE,)
        note_default_record(DEFAULT_SAMPLE, synthetic=True)
    with progress("reading {names}", names=[Path(name).name for name in names]):
        records = _read_records(names, source)
        results = [_prepare(record, source, vertical_counts=vertical_counts, keep_whole=keep_whole) for record in records]
    _report_history(results)
    _report_checks(results)
    report_qc(results, strict=source.strict)
    set_task("computing")
    return results


def _read_records(names: tuple[str, ...], source: Source) -> list[Record]:
    """Return the records; of all stations, those that can be read, with a warning for each other one."""
    from seisblock.readers import read_all
    from seisblock.readers.discover import iter_records
    from seisblock.readers.read import ALL_STATIONS, read_source

    options = source.read_options()
    try:
        return read_all(names, **options.keywords)
    except InputError:
        if options.station != ALL_STATIONS or source.strict:
            raise
        records = []
        for recording in iter_records(names, options):
            try:
                records.append(read_source(recording, options))
            except InputError as error:
                warning("{name}: {what}", name=recording.name, what=error.message)
        if not records:
            raise
    return records


def _report_checks(records: list[Record]) -> None:
    """Print what was proved and assumed of a record that the user gave, in one line."""
    from seisblock.records.qc_report import record_checks
    from seisblock.samples import find_sample

    for record in records:
        checks = record_checks(record)
        # of bundled samples, the manifest tells
        if len(records) == 1 and (checks.proved or checks.assumed) and find_sample(record.source) is None:
            # the bare word stands for other counts, too
            labels = {"count": gettext("sample count")}
            proved, assumed = ([labels.get(word) or gettext(word) for word in words] for words in (checks.proved, checks.assumed))
            none = [gettext("nothing")]
            info(
                "{record}: proved {proved}; assumed {assumed}",
                record=record.station or record.source,
                proved=proved or none,
                assumed=assumed or none,
            )


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
    return make_preparation(source, peaks, keep_whole=keep_whole).apply(record)


def _report_history(records: list[Record]) -> None:
    """Print the processing of the first records, and the number of the others."""
    processed = [record for record in records if record.history]
    for record in processed[:MAX_HISTORIES]:
        for line in record.history:
            info("{record}: {did}", record=record.station or record.source, did=format_step(line))
    if len(processed) > MAX_HISTORIES:
        info("processing of {count} further records: in --json", count=len(processed) - MAX_HISTORIES)


def make_preparation(source: Source, peaks: tuple[str, ...], *, keep_whole: bool = False) -> Preparation:
    """Return the preparation of a record; `peaks` are the components of the target PGA."""
    return Preparation(
        demean=source.demean,
        highpass_hz=source.highpass,
        scale=1.0 if source.scale is None else source.scale,
        target_pga=None if source.target_pga is None else source.target_pga / 100.0,
        target_jma=source.target_jma,
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
    if source.component and not any(name.lower() == "all" for name in source.component):
        return source.component
    return record.codes if vertical_counts else tuple(component.code for component in require_horizontals(record))


def selected_motions(record: Record, source: Source) -> Iterator[Motion]:
    """Yield one motion for each selected horizontal direction."""
    for name in selected_components(record, source):
        yield motion_of(record, name)


def iter_motions(source: Source, *, keep_whole: bool = False) -> Iterator[Motion]:
    """Yield the selected motions of each record of a command, see :func:`load_records`."""
    for record in load_records(source, keep_whole=keep_whole):
        yield from selected_motions(record, source)
