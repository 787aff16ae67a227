"""Other formats read by ObsPy, and checks of counts and times that ObsPy does not make."""

from __future__ import annotations

import re
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from seisblock.core.errors import ParameterError, RecordFormatError
from seisblock.core.format_names import format_names
from seisblock.core.i18n import lazy_gettext
from seisblock.readers._header import parse_number
from seisblock.readers._header_check import qc_flag
from seisblock.readers.event import is_quakeml
from seisblock.readers.lines import read_lines
from seisblock.readers.registry import FALLBACK, HEAD_BYTES, Format, format_titles, list_formats, register
from seisblock.readers.response import is_station_xml
from seisblock.readers.source import RawFile
from seisblock.readers.table.layout import MAX_PREAMBLE_LINES, preamble_error
from seisblock.readers.waveforms import WAVEFORM_OPTIONS, WaveformOptions, read_waveform_file, write_temporary
from seisblock.records import QCFlag, Record

_CRASHING_FORMATS = {"GSE1", "GSE2"}
"""Formats whose ObsPy decoder crashes (segmentation fault) on damaged files."""

_UNSAFE_FORMATS = _CRASHING_FORMATS | {"PICKLE"}
"""Formats that are never read: unpickling executes arbitrary code."""

_GSE = re.compile(rb"^WID[12] ", re.MULTILINE)
_COUNTED_FORMATS = {"SLIST", "TSPAIR"}
_TIMESERIES = re.compile(r"^TIMESERIES[ \t]+(.*)$", re.MULTILINE)
_TIME_TOLERANCE_S = 1.5e-6
"""Tolerance of sample times, s; TSPAIR prints microseconds."""


def is_gse(head: bytes) -> bool:
    """Return whether bytes begin a GSE 1 or 2 file (not supported)."""
    return _GSE.search(head) is not None


def read_obspy(
    blob: RawFile,
    *,
    format: str | None = None,  # noqa: A002 - the read option
    **options: Any,
) -> list[Record]:
    """Return the components in a file of any waveform format of ObsPy except PICKLE.

    `units` is the unit of the samples as returned by ObsPy; the calibration factor ``stats.calib`` is not applied. `format` is ``OBSPY:``
    and a format name of ObsPy, or that name alone; None and ``OBSPY`` try all formats.

    Raises
    ------
    RecordFormatError
        If ObsPy does not know the format or fails on the file.
    UnitError
        If the unit is missing or unknown.
    """
    waveform = (format or FALLBACK).upper()
    name = waveform.removeprefix(f"{FALLBACK}:")
    if waveform == FALLBACK:
        with tempfile.TemporaryDirectory(prefix="seisblock-") as directory:
            name = _detect_obspy_format(blob, write_temporary(blob, directory))
    _check_format(blob.name, name)
    return read_waveform_file(blob, name, WaveformOptions(**options), _flag_sample_lists if name in _COUNTED_FORMATS else None)


def _check_format(name: str, waveform: str) -> None:
    """Raise for a format that ObsPy does not have, or whose decoder is unsafe."""
    from obspy.core.util.base import ENTRY_POINTS

    if waveform in _CRASHING_FORMATS:
        _raise_unsupported(name, waveform)
    usable = set(ENTRY_POINTS["waveform"]) - _UNSAFE_FORMATS
    if waveform not in usable:
        message = "unknown format {waveform!r}: expected {known}, or OBSPY: followed by one of {usable}"
        names = sorted(set(format_names()) - {FALLBACK})
        raise ParameterError(message, waveform=waveform, known=names, usable=", ".join(sorted(usable)))


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
    if (companion := _companion_kind(blob.content[:HEAD_BYTES])) is not None:
        return RecordFormatError("{name}: {kind}, not a record: give the record", name=blob.name, kind=companion)
    expected = lazy_gettext("{formats}, a plain table, an archive of these, or a waveform format of ObsPy", formats=format_titles())
    try:
        lines = read_lines(blob)[:MAX_PREAMBLE_LINES]
    except RecordFormatError:
        return RecordFormatError("{name}: unknown file format; expected {known}", name=blob.name, known=expected)
    first = next((line.strip() for line in lines if line.strip()), "")[:60]
    return preamble_error(blob.name, lines) or RecordFormatError(
        "{name}: unknown file format (begins with {first!r}); expected {known}", name=blob.name, first=first, known=expected
    )


def _companion_kind(head: bytes) -> str | None:
    """Return what a file is that belongs beside a record, with its option."""
    if is_station_xml(head):
        return lazy_gettext("StationXML of a station (`inventory`)")
    if is_quakeml(head):
        return lazy_gettext("QuakeML of an earthquake (`event`)")
    return None


def _raise_unsupported(name: str, waveform: str) -> NoReturn:
    """Raise for a format whose decoder is unsafe."""
    message = "{name}: format {format} not supported (the ObsPy decoder crashes on damaged files); convert the record to MSEED or SAC"
    raise RecordFormatError(message, name=name, format=waveform)


def _flag_sample_lists(data: bytes, traces: Sequence[Any]) -> Sequence[QCFlag]:
    """Return flags for SLIST or TSPAIR channels with a wrong sample count or uneven times."""
    return tuple(_iter_sample_list_flags(data.decode("latin-1"), sum(len(trace.data) for trace in traces)))


def _iter_sample_list_flags(text: str, read_count: int) -> Iterator[QCFlag]:
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
        yield qc_flag("ObsPy read {read} of {promised} samples in the file", "count", promised=total_count, read=read_count)


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


FORMAT = register(
    Format(
        name=FALLBACK,
        parse=read_obspy,
        matches=is_gse,  # text files, which are not tables
        specificity=0,
        options=(*WAVEFORM_OPTIONS, "format"),
        aligned=True,
        plugin=False,
    )
)
