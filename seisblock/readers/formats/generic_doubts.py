"""What speaks against a file that obspy has read: its own counts, times and extremes, and what obspy warned of."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from datetime import datetime
from typing import Any

import numpy as np

from seisblock.readers.header import number
from seisblock.readers.source import LONGEST_SHOWN
from seisblock.records import Doubt
from seisblock.words import said

_COUNTED = {"SLIST", "TSPAIR"}
_TIMESERIES = re.compile(r"^TIMESERIES[ \t]+(.*)$", re.MULTILINE)
_UNSET = -12345.0
"""What a SAC header holds where it says nothing."""

_SLACK = 1e-5
"""How far an extreme of a SAC header may lie from the samples', in the largest of them: both are of single precision."""

_TICK_S = 1.5e-6
"""How far a time may lie from its place, s: TSPAIR prints microseconds."""


def doubts_of_file(data: bytes, waveform: str, traces: Sequence[Any], warned: Sequence[str]) -> tuple[Doubt, ...]:
    """Return what speaks against a file.

    Parameters
    ----------
    data : bytes
        Of the file.
    waveform : str
        Its format, as obspy spells it.
    traces : sequence of obspy's Trace
        What was read from it.
    warned : sequence of str
        What obspy warned of meanwhile: integrity checks of miniSEED, ends of files in the middle of a block.
    """
    said_by_obspy = (Doubt("header", said("obspy: {warning}", warning=" ".join(text.split())[:LONGEST_SHOWN])) for text in warned)
    own: Iterator[Doubt] = iter(())
    if waveform in _COUNTED:
        own = _of_lists(data.decode("latin-1"), sum(len(trace.data) for trace in traces))
    elif waveform == "SAC":
        own = _of_extremes(traces)
    elif waveform == "MSEED":
        own = _of_blocks(len(data), traces)
    return tuple(dict.fromkeys((*said_by_obspy, *own)))


def _of_lists(text: str, read: int) -> Iterator[Doubt]:
    """Yield a doubt for each channel of SLIST or TSPAIR whose header states another number of samples, or whose times are not even."""
    pieces = _TIMESERIES.split(text)
    promised = 0
    for head, body in zip(pieces[1::2], pieces[2::2], strict=True):
        fields = [field.strip() for field in head.split(",")]
        words = fields[1].split() if len(fields) > 1 else []
        stated = number(words[0]) if words else None
        cells = body.split()
        pairs = any(field.upper() == "TSPAIR" for field in fields)
        count = len(cells) // (2 if pairs else 1)
        promised += count
        if stated is None or stated != count:
            text = said(
                "{channel}: the header states {stated} samples, {count} follow",
                channel=fields[0],
                stated=words[0][:20] if words else "no",
                count=count,
            )
            yield Doubt("count", text)
        if pairs and not _ticks_evenly(cells[::2]):
            yield Doubt("clock", said("{channel}: the times of its samples are not those of an even clock", channel=fields[0]))
    if promised != read:
        yield Doubt("count", said("of {promised} samples in the file obspy read {read}", promised=promised, read=read))


def _ticks_evenly(times: Sequence[str]) -> bool:
    """Return whether times are those of an even clock."""
    try:
        instants = [datetime.fromisoformat(time) for time in times]
        seconds = np.array([(instant - instants[0]).total_seconds() for instant in instants])
    except (ValueError, TypeError):  # no times, or some with a time zone
        return False
    if not seconds.size:
        return True
    even = np.linspace(0.0, seconds[-1], seconds.size)
    return bool(np.abs(seconds - even).max() <= _TICK_S and (seconds.size < 2 or seconds[-1] > 0.0))


def _of_blocks(size: int, traces: Sequence[Any]) -> Iterator[Doubt]:
    """Yield a doubt about a miniSEED file of so many bytes that ends in the middle of a block, which obspy passes over."""
    length = min(int(trace.stats.mseed.record_length) for trace in traces)
    if size % length:
        yield Doubt("cut", said("the file ends in the middle of a block of {length} bytes: it looks cut", length=length))


def _of_extremes(traces: Sequence[Any]) -> Iterator[Doubt]:
    """Yield a doubt for each extreme and each mean of a SAC header that is not that of the samples."""
    for trace in traces:
        header, row = trace.stats.sac, np.asarray(trace.data, dtype=np.float64)
        found = {"depmin": row.min(), "depmax": row.max(), "depmen": row.mean()} if row.size else {}
        slack = _SLACK * max(abs(row.min()), abs(row.max())) if row.size else 0.0
        for key, value in found.items():
            told = float(header.get(key, _UNSET))
            if told != _UNSET and not abs(told - value) <= slack:
                text = said(
                    "{channel}: the header says {key} {told:g}, that of the samples is {value:g}",
                    channel=trace.id,
                    key=key.upper(),
                    told=told,
                    value=float(value),
                )
                yield Doubt("header", text)
