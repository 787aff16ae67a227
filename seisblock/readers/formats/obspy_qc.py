"""Quality control of files read by ObsPy: counts, times, extremes, and warnings of ObsPy."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from datetime import datetime
from typing import Any

import numpy as np

from seisblock.core.i18n import lazy_gettext
from seisblock.readers._header import parse_number
from seisblock.readers.source import MAX_QUOTED_LENGTH
from seisblock.records import QCFlag

_COUNTED_FORMATS = {"SLIST", "TSPAIR"}
_TIMESERIES = re.compile(r"^TIMESERIES[ \t]+(.*)$", re.MULTILINE)
_SAC_UNDEFINED = -12345.0
"""SAC value of undefined header entries."""

_EXTREME_TOLERANCE = 1e-5
"""Tolerance of SAC extremes relative to the largest sample; both are single precision."""

_TIME_TOLERANCE_S = 1.5e-6
"""Tolerance of sample times, s; TSPAIR prints microseconds."""


def flag_obspy_file(data: bytes, waveform: str, traces: Sequence[Any], warning_texts: Sequence[str]) -> tuple[QCFlag, ...]:
    """Return the quality flags of a file.

    Parameters
    ----------
    data : bytes
        Content of the file.
    waveform : str
        Format name of obspy.
    traces : sequence of obspy Trace
        Traces read from the file.
    warning_texts : sequence of str
        Warnings of obspy: integrity checks of miniSEED, incomplete blocks at the end of the file.
    """
    obspy_flags = (
        QCFlag("header", lazy_gettext("obspy warning: {warning}", warning=" ".join(text.split())[:MAX_QUOTED_LENGTH]))
        for text in warning_texts
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
            text = lazy_gettext(
                "{channel}: header states {stated} samples, file contains {count}",
                channel=fields[0],
                stated=words[0][:20] if words else "no",
                count=count,
            )
            yield QCFlag("count", text)
        if has_times and not _is_evenly_sampled(cells[::2]):
            yield QCFlag("clock", lazy_gettext("{channel}: sample times are not evenly spaced", channel=fields[0]))
    if total_count != read_count:
        yield QCFlag("count", lazy_gettext("obspy read {read} of {promised} samples in the file", promised=total_count, read=read_count))


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
        yield QCFlag("cut", lazy_gettext("file ends inside a block of {length} bytes: probably truncated", length=length))


def _flag_extremes(traces: Sequence[Any]) -> Iterator[QCFlag]:
    """Yield flags for extremes and means in a SAC header that differ from the samples."""
    for trace in traces:
        header, row = trace.stats.sac, np.asarray(trace.data, dtype=np.float64)
        extremes = {"depmin": row.min(), "depmax": row.max(), "depmen": row.mean()} if row.size else {}
        slack = _EXTREME_TOLERANCE * max(abs(row.min()), abs(row.max())) if row.size else 0.0
        for key, value in extremes.items():
            header_value = float(header.get(key, _SAC_UNDEFINED))
            if header_value != _SAC_UNDEFINED and not abs(header_value - value) <= slack:
                text = lazy_gettext(
                    "{channel}: header {key} {told:g} differs from the value of the samples, {value:g}",
                    channel=trace.id,
                    key=key.upper(),
                    told=header_value,
                    value=float(value),
                )
                yield QCFlag("header", text)
