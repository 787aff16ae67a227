"""Any other format that obspy reads, once its unit is known."""

from __future__ import annotations

import re
import tempfile
import warnings
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from seisblock.errors import ParameterError, RecordFormatError, UnitError
from seisblock.readers.cells import turned_si
from seisblock.readers.directions import Direction, direction_of
from seisblock.readers.formats.generic_doubts import doubts_of_file
from seisblock.readers.formats.unknown import unknown
from seisblock.readers.naming import normal_unit
from seisblock.readers.source import LONGEST_SHOWN, Blob
from seisblock.records import Component, Doubt, Record
from seisblock.words import said

# PICKLE runs whatever the file says; the others have a reader here
_NOT_TRIED = {"PICKLE", "JMACSV", "KNETCSV", "AT2", "CSMIP", "COSMOS", "SMC", "ESM", "GEONET", "CWA", "KNET", "GSE1", "GSE2"}
_CRASHING = {"GSE1", "GSE2"}
"""Formats whose decoder in obspy ends the process (segmentation fault) on a damaged file."""

_GSE = re.compile(rb"^WID[12] ", re.MULTILINE)
_LETTERS = {"N": "NS", "E": "EW", "Z": "UD"}


def is_gse(head: bytes) -> bool:
    """Return whether a file's first bytes are those of GSE 1 or 2, which no reader here takes."""
    return _GSE.search(head) is not None


def read_generic(blob: Blob, *, units: str | None, waveform: str | None = None) -> list[Record]:
    """Return the components in a file that obspy recognises.

    Parameters
    ----------
    blob : Blob
        Any waveform format of obspy but its pickles.
    units : str or None
        Unit of the samples as obspy gives them; formats with a calibration of their own (``stats.calib``) are not calibrated further.
    waveform : str or None
        Name of the format as obspy spells it; None tries them all.

    Raises
    ------
    RecordFormatError
        If obspy knows no such format, or fails on the file.
    UnitError
        If the unit is not given.
    """
    with tempfile.TemporaryDirectory(prefix="seisblock-") as directory:
        suffix = "".join(c for c in Path(blob.basename).suffix[:12] if c.isalnum() or c == ".")
        path = Path(directory) / f"record{suffix}"
        path.write_bytes(blob.data)
        name = _recognise(blob, path) if waveform is None else waveform.upper()
        traces, warned = _traces(blob.name, path, name)
    doubts = doubts_of_file(blob.data, name, traces, warned)
    if units is None:
        raise UnitError(
            "{name} is a {format} file, which does not say the unit of its samples: give `units`, gal|m/s2|g", name=blob.name, format=name
        )
    unit = normal_unit(units)
    if unit is None:
        raise UnitError("unknown unit of acceleration {units!r}: give gal, m/s2 or g", units=units)
    traces.reverse()
    # one by one out of the list: obspy's samples go as ours come
    return [_record(blob.name, traces.pop(), name, unit, doubts) for _ in range(len(traces))]


def _recognise(blob: Blob, path: Path) -> str:
    """Return obspy's name of the format of a file."""
    from obspy.core.util.base import ENTRY_POINTS, buffered_load_entry_point

    for candidate, entry in ENTRY_POINTS["waveform"].items():
        if candidate in _NOT_TRIED:
            continue
        try:
            claims = buffered_load_entry_point(entry.dist.name, f"obspy.plugin.waveform.{candidate}", "isFormat")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                if claims(str(path)):
                    return str(candidate)
        except Exception:  # noqa: BLE001 - a plugin that stumbles over a foreign file does not know it, whatever it raises
            continue
    with path.open("rb") as file:
        if is_gse(file.read(4096)):
            _refuse(blob.name, "GSE")
    raise unknown(blob)


def _refuse(name: str, waveform: str) -> NoReturn:
    """Refuse a format whose decoder cannot be trusted."""
    raise RecordFormatError(
        "{name}: {format} is not read here, for its decoder in obspy crashes on damaged files: convert the record, "
        "with obspy for example, to MSEED or SAC",
        name=name,
        format=waveform,
    )


def _traces(name: str, path: Path, waveform: str) -> tuple[list[Any], list[str]]:
    """Return the traces of a file, gapless pieces of one channel joined, and what obspy warned of."""
    import obspy
    from obspy.core.util.base import ENTRY_POINTS

    if waveform in _CRASHING:
        _refuse(name, waveform)
    if waveform not in ENTRY_POINTS["waveform"] or waveform == "PICKLE":
        usable = ", ".join(sorted(set(ENTRY_POINTS["waveform"]) - _CRASHING - {"PICKLE"}))
        raise ParameterError(
            "unknown format {waveform!r}: give JMA-CSV, KNET, KIKNET, KNET-CSV, AT2, CSMIP, COSMOS, SMC, ESM, GEONET, CWA, CSV, or OBSPY: "
            "and one of {usable}",
            waveform=waveform,
            usable=usable,
        )
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", UserWarning)
            stream = obspy.read(str(path), format=waveform).merge()
    except Exception as error:  # obspy's readers raise bare Exceptions
        why = " ".join(str(error).split())[:LONGEST_SHOWN] or type(error).__name__
        raise RecordFormatError("{name}: obspy cannot read it as {format} ({why})", name=name, format=waveform, why=why) from error
    if not stream:
        raise RecordFormatError("{name}: obspy finds no samples in it", name=name)
    return list(stream), [str(warning.message) for warning in caught if issubclass(warning.category, UserWarning)]


def _record(name: str, trace: Any, waveform: str, unit: str, doubts: tuple[Doubt, ...]) -> Record:
    """Return one trace as a record of one component."""
    from datetime import UTC

    stats = trace.stats
    if np.ma.is_masked(trace.data):
        raise RecordFormatError("{name}: channel {channel} has gaps: cut the record to a stretch without", name=name, channel=trace.id)
    if trace.data.dtype.kind not in "iuf":
        raise RecordFormatError("{name}: channel {channel} holds text, not samples", name=name, channel=trace.id)
    values = np.require(trace.data, np.float64, ["C", "O", "W"])  # nobody holds them but us
    if values.size < 2 or not stats.delta > 0:
        raise RecordFormatError(
            "{name}: channel {channel} holds {count} samples at an interval of {dt} s: no waveform",
            name=name,
            channel=trace.id,
            count=values.size,
            dt=stats.delta,
        )
    metadata: dict[str, object] = {"unit": unit, "channel": trace.id}
    if stats.calib != 1.0:
        text = said(
            "{channel}: the calibration factor {factor:g} of the file was not applied: units are as you said",
            channel=trace.id,
            factor=stats.calib,
        )
        doubts = (*doubts, Doubt("calibration", text))
    told = direction_of(stats.channel)
    if told is None or told.bare:
        told = Direction(_LETTERS.get(stats.channel[-1:].upper(), stats.channel.upper() or "ACC"))
    start = stats.starttime.datetime.replace(tzinfo=UTC) if stats.starttime.timestamp else None
    return Record(
        (Component(told.code, turned_si(values, unit, told.sign), told.azimuth_deg),),
        float(stats.delta),
        station=stats.station,
        start=start,
        source=name,
        format=f"OBSPY:{waveform}",
        metadata=metadata,
        doubts=doubts,
    )
