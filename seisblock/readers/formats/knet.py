"""K-NET and KiK-net ASCII, decoded by ObsPy and checked against the header maximum."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from datetime import timedelta

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._header import MAX_COUNT, drop_missing, parse_jst, parse_number
from seisblock.readers._header_check import flag_count, qc_flag
from seisblock.readers.lines import line_error
from seisblock.readers.registry import FileSet, Format, register
from seisblock.readers.source import RawFile, decode_text
from seisblock.readers.table.headers import component_code
from seisblock.records import Component, QCFlag, Record

KIK_FORMAT = "KIKNET"
TRIGGER_DELAY = timedelta(seconds=15)
"""Delay of the header's record time after the first sample."""

# header labels as expected by ObsPy; the part after | may vary
_EVENT_LABELS = ("Origin Time", "Lat.", "Long.", "Depth.| (km)", "Mag.")
_STATION_LABELS = ("Station Code", "Station Lat.", "Station Lo|ng.", "Station Height|(m)")
_RECORD_LABELS = ("Record Time", "Sampling Freq|(Hz)", "Duration Time|(s)", "Dir.", "Scale Factor", "Max|. Acc. (gal)")
_LABELS = (*_EVENT_LABELS, *_STATION_LABELS, *_RECORD_LABELS, "Last Correction", "Memo|.")
ORIGIN, EVENT_LAT, EVENT_LON, DEPTH, MAGNITUDE, STATION, LAT, LON, HEIGHT = range(9)
RECORD_TIME, RATE, DURATION, DIRECTION, SCALE, MAXIMUM, CORRECTION, MEMO = range(9, 17)
_NUMBERS = {
    "event_latitude_deg": EVENT_LAT,
    "event_longitude_deg": EVENT_LON,
    "event_depth_km": DEPTH,
    "magnitude": MAGNITUDE,
    "station_latitude_deg": LAT,
    "station_longitude_deg": LON,
    "station_height_m": HEIGHT,
}
_CHANNELS = {"1": "NS", "2": "EW", "3": "UD", "4": "NS", "5": "EW", "6": "UD"}
_SENSORS = {"": "", "1": "borehole", "2": "surface"}
"""Levels of KiK-net by the last digit of the file name."""

_FILE_NAME = re.compile(
    r"(?P<stem>(?P<station>[A-Z]{3}[0-9]{3}|[A-Z]{4}[0-9]{2})[0-9]{10}|.+)\.(?P<code>NS|EW|UD)(?P<sensor>[12]?)\Z", re.IGNORECASE
)
_MAXIMUM_TOLERANCE = 0.0011
"""Tolerance of the header maximum, gal, which has three decimals."""


def is_knet(head: bytes) -> bool:
    """Return whether bytes begin a K-NET or KiK-net ASCII file."""
    return head.startswith(b"Origin Time")


def read_knet(blob: RawFile) -> Record:
    """Return the component in a K-NET or KiK-net ASCII file.

    Notes
    -----
    The scale factor is applied, and the trigger delay of 15 s is subtracted from the record time. The offset of the counts is kept:
    ``metadata["carries_offset"]`` is True and ``metadata["offset_gal"]`` its value. ``metadata["level"]`` is the sensor of a KiK-net file.
    The header's ``Max. Acc.`` is checked against the largest deviation from the mean, its duration against the count.
    """
    lines = decode_text(blob).split("\n")
    values = _parse_header(blob.name, lines)
    code, level = _parse_direction(blob.name, values[DIRECTION])
    rate = parse_number(re.sub(r"\s*Hz\s*\Z", "", values[RATE], flags=re.IGNORECASE))
    start = parse_jst(values[RECORD_TIME])
    scale = re.fullmatch(r"([\d.]+)\s*\(gal\)\s*/\s*([\d.]+)", values[SCALE], re.IGNORECASE)
    if not rate or rate < 0:
        raise line_error("expected a sampling frequency such as 100Hz, found {text!r}", blob.name, RATE + 1, text=values[RATE])
    if start is None:
        message = "expected a time such as 2016/04/16 01:25:15, found {text!r}"
        raise line_error(message, blob.name, RECORD_TIME + 1, text=values[RECORD_TIME])
    if scale is None or not float(scale[2]):
        raise line_error("expected a scale factor such as 3920(gal)/6182761, found {text!r}", blob.name, SCALE + 1, text=values[SCALE])
    counts = _decode_counts(blob.name, values, lines)
    flags = _flag_length(blob.name, counts.size, values[DURATION], rate)
    # counts and factors are whole numbers: a single, correctly rounded division
    acceleration = counts * float(scale[1]) / (float(scale[2]) * 100.0)
    metadata = _metadata(values, code, level, 100.0 * acceleration)
    flags += _flag_maximum(code, values[MAXIMUM], 100.0 * acceleration) + _flag_name(blob.basename, code, values[STATION])
    name, kind, component = values[STATION], KIK_FORMAT if level else FORMAT.name, Component(code, acceleration)
    return Record((component,), 1.0 / rate, name, start - TRIGGER_DELAY, source=blob.name, format=kind, metadata=metadata, doubts=flags)


def _parse_header(name: str, lines: Sequence[str]) -> list[str]:
    """Return the 17 values of the header."""
    values = []
    for index, label in enumerate(_LABELS):
        line = lines[index] if index < len(lines) else ""
        if not line.startswith(label.split("|")[0]):
            expected_label = label.replace("|", "")
            actual = lazy_gettext("found {text!r}", text=line.strip()[:40]) if line.strip() else lazy_gettext("found the end of the file")
            message = "{name}, line {line}: expected {wanted!r}, {found}: K-NET header (17 lines) truncated or damaged"
            raise RecordFormatError(message, name=name, line=index + 1, wanted=expected_label, found=actual)
        # the labels take 18 columns
        values.append(line[18:].strip())
    return values


def _parse_direction(name: str, text: str) -> tuple[str, str]:
    """Return the component code and, for KiK-net channel numbers, the sensor level."""
    if text in _CHANNELS:
        return _CHANNELS[text], "borehole" if text in "123" else "surface"
    code = component_code(text)
    if code not in ("NS", "EW", "UD"):
        raise line_error("expected a direction N-S, E-W, U-D or 1 to 6, found {text!r}", name, DIRECTION + 1, text=text)
    return code, ""


def _decode_counts(name: str, values: Sequence[str], lines: Sequence[str]) -> FloatArray:
    """Return the counts decoded by ObsPy."""
    body = lines[len(_LABELS) :]
    if not any(line.strip() for line in body):
        raise RecordFormatError("{name}: no samples after the header (line {line})", name=name, line=len(_LABELS))
    import obspy  # imported here: the import takes longer than reading

    text = "\n".join([*_canonical_header(values), *body])
    try:
        counts = np.asarray(obspy.read(io.BytesIO(text.encode("ascii", "replace")), format="KNET")[0].data, dtype=np.float64)
    except (ValueError, IndexError, TypeError) as error:
        _raise_bad_line(name, body)
        raise RecordFormatError("{name}: ObsPy cannot decode the K-NET file ({error})", name=name, error=error) from error
    if not (np.abs(counts) < MAX_COUNT).all():
        _raise_bad_line(name, body)
    return counts


def _canonical_header(values: Sequence[str]) -> list[str]:
    """Return the header with optional fields normalised, so that ObsPy accepts empty or unusual ones."""
    fields = list(values)
    for index in (EVENT_LAT, EVENT_LON, DEPTH, MAGNITUDE, LAT, LON, HEIGHT, DURATION, MAXIMUM):
        fields[index] = values[index] if parse_number(values[index]) is not None else "nan"
    for index in (ORIGIN, CORRECTION):
        fields[index] = values[RECORD_TIME]  # unused here, but ObsPy requires a time
    fields[STATION] = "STATION"
    fields[MEMO] = ""
    return [f"{label.replace('|', ''):<18}{value}" for label, value in zip(_LABELS, fields, strict=True)]


def _raise_bad_line(name: str, body: Sequence[str]) -> None:
    """Raise for the first line with a value that is not a count."""
    for offset, line in enumerate(body):
        for cell in line.split():
            value = parse_number(cell)
            if value is None or not abs(value) < MAX_COUNT:
                raise line_error("expected counts, found {cell!r}", name, len(_LABELS) + 1 + offset, cell=cell)


def _flag_length(name: str, count: int, text: str, rate: float) -> tuple[QCFlag, ...]:
    """Raise for a file shorter than its header duration; flag a longer file or an unreadable duration."""
    duration = parse_number(text)
    if duration is None or not 0 < duration * rate < MAX_COUNT:
        return (qc_flag("header Duration Time {text!r} is not a number; number of samples not checked", "header", text=text[:20]),)
    promised_count = round(duration * rate)
    # a short file is truncated and cannot be trusted; a longer one is flagged
    if count < promised_count:
        message = (
            "{name}: file truncated: header states {promised} samples ({duration:g} s at {rate:g} Hz), file contains {count}; "
            "download it again"
        )
        raise RecordFormatError(message, name=name, promised=promised_count, duration=duration, rate=rate, count=count)
    return flag_count(promised_count, count)


def _flag_maximum(code: str, text: str, gal: FloatArray) -> tuple[QCFlag, ...]:
    """Return a flag if the largest deviation from the mean differs from the header maximum."""
    header_maximum, peak = parse_number(text), float(np.abs(gal - gal.mean()).max())
    if header_maximum is None:
        message = "{component}: header Max. Acc. {text!r} is not a number; peak of the samples not checked"
        return (qc_flag(message, "header", code, text=text[:20]),)
    if abs(peak - header_maximum) > _MAXIMUM_TOLERANCE:
        message = "{component}: header Max. Acc. {stated:g} gal differs from the peak of the samples about their mean, {peak:.3f} gal"
        return (qc_flag(message, "header", code, stated=header_maximum, peak=peak),)
    return ()


def _flag_name(basename: str, code: str, station: str) -> tuple[QCFlag, ...]:
    """Return flags if station or component in a NIED file name differ from the header."""
    match = _FILE_NAME.match(basename)
    if match is None:
        return ()
    pairs = [(match["station"], station), (match["code"], code)]
    return tuple(
        qc_flag(
            "{name}: file name ({name_value}) and header ({header_value}) disagree",
            "header",
            code,
            name=basename,
            name_value=file_value,
            header_value=header_value,
        )
        for file_value, header_value in pairs
        if file_value and header_value and file_value.upper() != header_value.upper()
    )


def _metadata(values: Sequence[str], code: str, level: str, gal: FloatArray) -> dict[str, object]:
    numbers = {label: parse_number(values[index]) for label, index in _NUMBERS.items()}
    header_maximum = parse_number(values[MAXIMUM])
    return drop_missing(
        {
            "unit": "gal",
            "clock": "JST",
            "carries_offset": True,
            "offset_gal": {code: float(gal.mean())},
            "level": level,
            **numbers,
            # a height of -9999 is unknown
            "station_height_m": None if numbers["station_height_m"] == -9999 else numbers["station_height_m"],
            "origin_time": parse_jst(values[ORIGIN]),
            "memo": values[MEMO],
            "header_max_gal": None if header_maximum is None else {code: header_maximum},
        }
    )


def knet_file_set(basename: str) -> FileSet | None:
    """Return the file set of a K-NET station (three files) or of a KiK-net station (three of each sensor), by a file name.

    Examples
    --------
    >>> knet_file_set("AOM0012003011200.EW")
    FileSet(key='AOM0012003011200', size=3, component='EW', level='')
    >>> knet_file_set("AICH040010061330.NS2")
    FileSet(key='AICH040010061330', size=6, component='NS', level='surface')
    """
    match = _FILE_NAME.match(basename)
    return match and FileSet(match["stem"], 6 if match["sensor"] else 3, match["code"].upper(), _SENSORS[match["sensor"]])


FORMAT = register(
    Format(
        name="KNET",
        title="K-NET/KiK-net",
        parse=read_knet,
        matches=is_knet,
        proves=("count", "peak", "unit", "sign", "instrument"),
        aliases=(KIK_FORMAT, "K-NET", "KIK-NET"),
        plugin=False,  # ObsPy reads it itself
        file_set=knet_file_set,
    )
)
