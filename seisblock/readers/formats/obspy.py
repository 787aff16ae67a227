"""Other formats read by ObsPy, with the unit given by the user, and checks that ObsPy does not make: counts, times, extremes."""

from __future__ import annotations

import re
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from seisblock.core.errors import ParameterError, RecordFormatError, UnitError
from seisblock.core.format_names import format_names
from seisblock.core.i18n import lazy_gettext
from seisblock.readers._header import parse_number
from seisblock.readers._header_check import qc_flag
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.lines import read_lines
from seisblock.readers.registry import FALLBACK, Format, format_titles, list_formats, register
from seisblock.readers.source import MAX_QUOTED_LENGTH, RawFile
from seisblock.readers.table.headers import normalize_unit
from seisblock.readers.table.layout import MAX_PREAMBLE_LINES, preamble_error
from seisblock.readers.table.parse import to_si_in_place
from seisblock.records import Component, QCFlag, Record

_CRASHING_FORMATS = {"GSE1", "GSE2"}
"""Formats whose obspy decoder crashes (segmentation fault) on damaged files."""

_UNSAFE_FORMATS = _CRASHING_FORMATS | {"PICKLE"}
"""Formats that are never read: unpickling executes arbitrary code."""

_GSE = re.compile(rb"^WID[12] ", re.MULTILINE)
_LETTERS = {"N": "NS", "E": "EW", "Z": "UD"}
_COUNTED_FORMATS = {"SLIST", "TSPAIR"}
_TIMESERIES = re.compile(r"^TIMESERIES[ \t]+(.*)$", re.MULTILINE)
_SAC_UNDEFINED = -12345.0
"""SAC value of undefined header entries."""

_EXTREME_TOLERANCE = 1e-5
"""Tolerance of SAC extremes relative to the largest sample; both are single precision."""

_TIME_TOLERANCE_S = 1.5e-6
"""Tolerance of sample times, s; TSPAIR prints microseconds."""


def is_gse(head: bytes) -> bool:
    """Return whether bytes begin a GSE 1 or 2 file (not supported)."""
    return _GSE.search(head) is not None


def read_obspy(blob: RawFile, *, units: str | None, format: str | None = None) -> list[Record]:  # noqa: A002 - the read option
    """Return the components in a file of any waveform format of obspy except PICKLE.

    `units` is the unit of the samples as returned by obspy; the calibration factor ``stats.calib`` is not applied. `format` is ``OBSPY:``
    and a format name of obspy, or that name alone; None and ``OBSPY`` try all formats.

    Raises
    ------
    RecordFormatError
        If obspy does not know the format or fails on the file.
    UnitError
        If the unit is missing or unknown.
    """
    with tempfile.TemporaryDirectory(prefix="seisblock-") as directory:
        # keep the suffix, which format detection of obspy may use
        suffix = "".join(c for c in Path(blob.basename).suffix[:12] if c.isalnum() or c == ".")
        path = Path(directory) / f"record{suffix}"
        path.write_bytes(blob.data)
        waveform = (format or FALLBACK).upper()
        name = _detect_obspy_format(blob, path) if waveform == FALLBACK else waveform.removeprefix(f"{FALLBACK}:")
        traces, warning_texts = _read_traces(blob.name, path, name)
    flags = flag_obspy_file(blob.data, name, traces, warning_texts)
    if units is None:
        raise UnitError("{name}: {format} file without a sample unit: give `units`, gal|m/s2|g", name=blob.name, format=name)
    unit = normalize_unit(units)
    if unit is None:
        raise UnitError("unknown acceleration unit {units!r}: expected gal, m/s2 or g", units=units)
    traces.reverse()
    # popped one by one, so that the samples of obspy are freed during conversion
    return [_to_record(blob.name, traces.pop(), name, unit, flags) for _ in range(len(traces))]


def _detect_obspy_format(blob: RawFile, path: Path) -> str:
    from obspy.core.util.base import ENTRY_POINTS, buffered_load_entry_point

    skipped_formats = _UNSAFE_FORMATS | {file_format.obspy_name for file_format in list_formats()}
    for candidate, entry in ENTRY_POINTS["waveform"].items():
        if candidate in skipped_formats:
            continue
        try:
            is_format = buffered_load_entry_point(entry.dist.name, f"obspy.plugin.waveform.{candidate}", "isFormat")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                if is_format(str(path)):
                    return str(candidate)
        except Exception:  # noqa: BLE001 - a plugin that stumbles over a foreign file does not know it, whatever it raises
            continue
    with path.open("rb") as file:
        if is_gse(file.read(4096)):
            _raise_unsupported(blob.name, "GSE")
    raise _unrecognized_error(blob)


def _unrecognized_error(blob: RawFile) -> RecordFormatError:
    """Return the error of a file of unknown format; quotes the first line and locates a table below it."""
    known = lazy_gettext("{formats}, a plain table, an archive of these, or a waveform format of obspy", formats=format_titles())
    try:
        lines = read_lines(blob)[:MAX_PREAMBLE_LINES]
    except RecordFormatError:
        return RecordFormatError("{name}: unknown file format; expected {known}", name=blob.name, known=known)
    first = next((line.strip() for line in lines if line.strip()), "")[:60]
    return preamble_error(blob.name, lines) or RecordFormatError(
        "{name}: unknown file format (begins with {first!r}); expected {known}", name=blob.name, first=first, known=known
    )


def _raise_unsupported(name: str, waveform: str) -> NoReturn:
    """Raise for a format whose decoder is unsafe."""
    message = "{name}: format {format} not supported (the obspy decoder crashes on damaged files); convert the record to MSEED or SAC"
    raise RecordFormatError(message, name=name, format=waveform)


def _read_traces(name: str, path: Path, waveform: str) -> tuple[list[Any], list[str]]:
    """Return the traces of a file, contiguous pieces merged, and the warnings of obspy."""
    import obspy
    from obspy.core.util.base import ENTRY_POINTS

    if waveform in _CRASHING_FORMATS:
        _raise_unsupported(name, waveform)
    if waveform not in ENTRY_POINTS["waveform"] or waveform == "PICKLE":
        message = "unknown format {waveform!r}: expected {known}, or OBSPY: followed by one of {usable}"
        known, usable = set(format_names()) - {FALLBACK}, set(ENTRY_POINTS["waveform"]) - _UNSAFE_FORMATS
        raise ParameterError(message, waveform=waveform, known=sorted(known), usable=", ".join(sorted(usable)))
    try:
        with warnings.catch_warnings(record=True) as warning_list:
            warnings.simplefilter("always", UserWarning)
            # merge joins contiguous pieces; gaps become masked samples, which are refused later
            stream = obspy.read(str(path), format=waveform).merge()
    except Exception as error:  # obspy's readers raise bare Exceptions
        reason = " ".join(str(error).split())[:MAX_QUOTED_LENGTH] or type(error).__name__
        raise RecordFormatError("{name}: obspy cannot read the file as {format} ({why})", name=name, format=waveform, why=reason) from error
    if not stream:
        raise RecordFormatError("{name}: no samples found by obspy", name=name)
    return list(stream), [str(warning.message) for warning in warning_list if issubclass(warning.category, UserWarning)]


def _to_record(name: str, trace: Any, waveform: str, unit: str, flags: tuple[QCFlag, ...]) -> Record:
    """Return one trace as a single-component record."""
    stats = trace.stats
    if np.ma.is_masked(trace.data):
        raise RecordFormatError("{name}: channel {channel} has gaps; extract a window without gaps", name=name, channel=trace.id)
    if trace.data.dtype.kind not in "iuf":
        raise RecordFormatError("{name}: channel {channel} contains text, not samples", name=name, channel=trace.id)
    values = np.require(trace.data, np.float64, ["C", "O", "W"])  # owned, so that they can be scaled in place
    if values.size < 2 or not stats.delta > 0:
        message = "{name}: channel {channel} is not a waveform ({count} samples, interval {dt} s)"
        raise RecordFormatError(message, name=name, channel=trace.id, count=values.size, dt=stats.delta)
    metadata: dict[str, object] = {"unit": unit, "channel": trace.id}
    if stats.calib != 1.0:
        message = "{channel}: calibration factor {factor:g} of the file not applied; samples taken in the unit given by `units`"
        flags = (*flags, qc_flag(message, "calibration", channel=trace.id, factor=stats.calib))
    direction = parse_direction(stats.channel)
    if direction is None or direction.is_bare_number:
        direction = Direction(_LETTERS.get(stats.channel[-1:].upper(), stats.channel.upper() or "ACC"))
    # 1970-01-01 is obspy's default for files without a time
    start = stats.starttime.datetime.replace(tzinfo=UTC) if stats.starttime.timestamp else None
    return Record(
        (Component(direction.code, to_si_in_place(values, unit, direction.sign), direction.azimuth_deg),),
        float(stats.delta),
        station=stats.station,
        start=start,
        source=name,
        format=f"OBSPY:{waveform}",
        metadata=metadata,
        doubts=flags,
    )


def flag_obspy_file(data: bytes, waveform: str, traces: Sequence[Any], warning_texts: Sequence[str]) -> tuple[QCFlag, ...]:
    """Return the quality flags of a file from its bytes, traces and the warnings of obspy (integrity checks, incomplete last blocks)."""
    obspy_flags = (
        qc_flag("obspy warning: {warning}", "header", warning=" ".join(text.split())[:MAX_QUOTED_LENGTH]) for text in warning_texts
    )
    file_flags: Iterator[QCFlag] = iter(())
    if waveform in _COUNTED_FORMATS:
        file_flags = _flag_sample_lists(data.decode("latin-1"), sum(len(trace.data) for trace in traces))
    elif waveform == "SAC":
        file_flags = _flag_extremes(traces)
    elif waveform == "MSEED":
        file_flags = _flag_partial_block(len(data), traces)
    return tuple(dict.fromkeys((*obspy_flags, *file_flags)))


def _flag_sample_lists(text: str, read_count: int) -> Iterator[QCFlag]:
    """Yield flags for SLIST or TSPAIR channels with a wrong sample count or uneven times."""
    pieces = _TIMESERIES.split(text)
    total_count = 0
    for head, body in zip(pieces[1::2], pieces[2::2], strict=True):
        fields = [field.strip() for field in head.split(",")]
        words = fields[1].split() if len(fields) > 1 else []
        stated_count = parse_number(words[0]) if words else None
        cells = body.split()
        has_times = any(field.upper() == "TSPAIR" for field in fields)
        # TSPAIR lists pairs of time and value
        count = len(cells) // (2 if has_times else 1)
        total_count += count
        if stated_count is None or stated_count != count:
            message = "{channel}: header states {stated} samples, file contains {count}"
            yield qc_flag(message, "count", channel=fields[0], stated=words[0][:20] if words else "no", count=count)
        if has_times and not _is_evenly_sampled(cells[::2]):
            yield qc_flag("{channel}: sample times are not evenly spaced", "clock", channel=fields[0])
    if total_count != read_count:
        yield qc_flag("obspy read {read} of {promised} samples in the file", "count", promised=total_count, read=read_count)


def _is_evenly_sampled(times: Sequence[str]) -> bool:
    try:
        instants = [datetime.fromisoformat(time) for time in times]
        seconds = np.array([(instant - instants[0]).total_seconds() for instant in instants])
    except (ValueError, TypeError):  # unreadable times, or mixed time zones
        return False
    if not seconds.size:
        return True
    even_times = np.linspace(0.0, seconds[-1], seconds.size)
    return bool(np.abs(seconds - even_times).max() <= _TIME_TOLERANCE_S and (seconds.size < 2 or seconds[-1] > 0.0))


def _flag_partial_block(size: int, traces: Sequence[Any]) -> Iterator[QCFlag]:
    """Yield a flag if a miniSEED file of `size` bytes ends inside a block, which obspy ignores."""
    length = min(int(trace.stats.mseed.record_length) for trace in traces)
    if size % length:
        yield qc_flag("file ends inside a block of {length} bytes: probably truncated", "cut", length=length)


def _flag_extremes(traces: Sequence[Any]) -> Iterator[QCFlag]:
    """Yield flags for extremes and means in a SAC header that differ from the samples."""
    for trace in traces:
        header, row = trace.stats.sac, np.asarray(trace.data, dtype=np.float64)
        extremes = {"depmin": row.min(), "depmax": row.max(), "depmen": row.mean()} if row.size else {}
        slack = _EXTREME_TOLERANCE * max(abs(row.min()), abs(row.max())) if row.size else 0.0
        for key, value in extremes.items():
            header_value = float(header.get(key, _SAC_UNDEFINED))
            if header_value != _SAC_UNDEFINED and not abs(header_value - value) <= slack:
                message = "{channel}: header {key} {told:g} differs from the value of the samples, {value:g}"
                yield qc_flag(message, "header", channel=trace.id, key=key.upper(), told=header_value, value=float(value))


FORMAT = register(
    Format(
        name=FALLBACK,
        parse=read_obspy,
        matches=is_gse,  # text files, which are not tables
        specificity=0,
        options=("units", "format"),
        plugin=False,
    )
)
