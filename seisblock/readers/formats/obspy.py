"""Other formats read by ObsPy, with the unit given by the user."""

from __future__ import annotations

import re
import tempfile
import warnings
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from seisblock.core.errors import ParameterError, RecordFormatError, UnitError
from seisblock.core.i18n import lazy_gettext
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.formats.obspy_qc import flag_obspy_file
from seisblock.readers.formats.unrecognized import unrecognized_error
from seisblock.readers.source import MAX_QUOTED_LENGTH, RawFile
from seisblock.readers.table.headers import normalize_unit
from seisblock.readers.table.parse import to_si_in_place
from seisblock.records import Component, QCFlag, Record

# unpickling executes arbitrary code; the other formats have a reader here
_SKIPPED_FORMATS = {"PICKLE", "JMACSV", "KNETCSV", "AT2", "CSMIP", "COSMOS", "SMC", "ESM", "GEONET", "CWA", "KNET", "GSE1", "GSE2"}
_CRASHING_FORMATS = {"GSE1", "GSE2"}
"""Formats whose obspy decoder crashes (segmentation fault) on damaged files."""

_GSE = re.compile(rb"^WID[12] ", re.MULTILINE)
_LETTERS = {"N": "NS", "E": "EW", "Z": "UD"}


def is_gse(head: bytes) -> bool:
    """Return whether bytes begin a GSE 1 or 2 file (not supported)."""
    return _GSE.search(head) is not None


def read_obspy(blob: RawFile, *, units: str | None, waveform: str | None = None) -> list[Record]:
    """Return the components in a file of a format known to obspy.

    Parameters
    ----------
    blob : RawFile
        File of any waveform format of obspy except PICKLE.
    units : str or None
        Unit of the samples as returned by obspy; the calibration factor ``stats.calib`` is not applied.
    waveform : str or None
        Format name of obspy; None tries all formats.

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
        name = _detect_obspy_format(blob, path) if waveform is None else waveform.upper()
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

    for candidate, entry in ENTRY_POINTS["waveform"].items():
        if candidate in _SKIPPED_FORMATS:
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
    raise unrecognized_error(blob)


def _raise_unsupported(name: str, waveform: str) -> NoReturn:
    """Raise for a format whose decoder is unsafe."""
    raise RecordFormatError(
        "{name}: format {format} not supported (the obspy decoder crashes on damaged files); convert the record to MSEED or SAC",
        name=name,
        format=waveform,
    )


def _read_traces(name: str, path: Path, waveform: str) -> tuple[list[Any], list[str]]:
    """Return the traces of a file, contiguous pieces merged, and the warnings of obspy."""
    import obspy
    from obspy.core.util.base import ENTRY_POINTS

    if waveform in _CRASHING_FORMATS:
        _raise_unsupported(name, waveform)
    if waveform not in ENTRY_POINTS["waveform"] or waveform == "PICKLE":
        known_formats = ", ".join(sorted(set(ENTRY_POINTS["waveform"]) - _CRASHING_FORMATS - {"PICKLE"}))
        raise ParameterError(
            "unknown format {waveform!r}: expected JMA-CSV, KNET, KIKNET, KNET-CSV, AT2, CSMIP, COSMOS, SMC, ESM, GEONET, CWA, "
            "CSV, or OBSPY: followed by one of {usable}",
            waveform=waveform,
            usable=known_formats,
        )
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
    from datetime import UTC

    stats = trace.stats
    if np.ma.is_masked(trace.data):
        raise RecordFormatError("{name}: channel {channel} has gaps; extract a window without gaps", name=name, channel=trace.id)
    if trace.data.dtype.kind not in "iuf":
        raise RecordFormatError("{name}: channel {channel} contains text, not samples", name=name, channel=trace.id)
    values = np.require(trace.data, np.float64, ["C", "O", "W"])  # owned, so that they can be scaled in place
    if values.size < 2 or not stats.delta > 0:
        raise RecordFormatError(
            "{name}: channel {channel} is not a waveform ({count} samples, interval {dt} s)",
            name=name,
            channel=trace.id,
            count=values.size,
            dt=stats.delta,
        )
    metadata: dict[str, object] = {"unit": unit, "channel": trace.id}
    if stats.calib != 1.0:
        text = lazy_gettext(
            "{channel}: calibration factor {factor:g} of the file not applied; samples taken in the unit given by `units`",
            channel=trace.id,
            factor=stats.calib,
        )
        flags = (*flags, QCFlag("calibration", text))
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
