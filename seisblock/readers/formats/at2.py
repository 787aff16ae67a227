"""PEER AT2: one component in g, direction in the second header line or in the file name."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.readers._header import parse_number
from seisblock.readers.directions import parse_direction
from seisblock.readers.lines import line_error
from seisblock.readers.registry import FileSet, Format, register
from seisblock.readers.source import RawFile, decode_text
from seisblock.records import Component, Record

_HEADER_LINES = 12
_COUNT = re.compile(r"NPTS\s*=\s*(\d+)", re.IGNORECASE)
_INTERVAL = re.compile(r"\bDT\s*=\s*([\d.]+(?:[ED][-+]?\d+)?)", re.IGNORECASE)
_OLD_STYLE = re.compile(r"^\s*(\d+)\s+([\d.]+(?:E[-+]?\d+)?)\s+NPTS,\s*DT", re.IGNORECASE | re.MULTILINE)
_SEED_DIRECTION = re.compile(r"[BHELS][HLN]([ENZ123])[._]?\d{0,2}", re.IGNORECASE)
"""Direction of a broadband station: SEED code and location, ``BHZ.00``."""

_SEED_NAME = re.compile(r"^(?P<before>.+\.[BHELS][HLN])(?P<code>[ENZ123])(?P<after>(?:\.\d\d)?)$", re.IGNORECASE)
_FILE_NAME = re.compile(
    r"^(?P<base>.*?[^0-9_-]|(?:RSN\d+_|[A-Z]-).*?)?[-_ ]*"
    r"(?P<direction>[NS]\d\d[EW]|[0-2]\d\d|3[0-5]\d|360|UPDN|UP|DWN|DOWN|DN|VERT|VER|UD|NS|EW|V|(?<=[-_])[EN])"
    r"(?:[-_]h(?:or)?\w*|(?<!\d)[-_](?:ver|up|v)\w*)?$",
    re.IGNORECASE,
)
"""Name that ends with the direction. Names of PEER (``RSN4013_SANSIMEO_36258021``, ``H-E06140``) may have a digit before it."""

_INTEGRAL = re.compile(r"(VELOCITY|DISPLACEMENT) TIME", re.IGNORECASE)
"""Title of the velocities and displacements (``.VT2``, ``.DT2``) beside a record."""


def is_at2(head: bytes) -> bool:
    """Return whether bytes begin an AT2 header: NPTS and DT in the first lines, no velocity or displacement."""
    # a plain table may state npts and dt in its comments
    text = b"\n".join(line for line in head.splitlines()[:_HEADER_LINES] if not line.startswith(b"#")).decode("latin-1")
    if b"\x00" in head or _INTEGRAL.search(text):
        return False
    return _has_sampling(text)


def _is_integral(lines: Sequence[str]) -> bool:
    """Return whether lines begin with the header of velocities or displacements of PEER."""
    text = "\n".join(lines[:_HEADER_LINES])
    return bool(_INTEGRAL.search(text)) and _has_sampling(text)


def _has_sampling(text: str) -> bool:
    return bool(_OLD_STYLE.search(text) or (_COUNT.search(text) and _INTERVAL.search(text)))


def read_at2(blob: RawFile) -> Record:
    """Return the component in an AT2 file.

    Notes
    -----
    Azimuths 0 and 360 are called ``NS``, 90 ``EW``; any other direction keeps its azimuth as its code (``180``, ``164``), with its sign
    as recorded. ``UP`` is ``UD``; ``DWN`` is ``UD`` with reversed sign, noted in the history. The header has a date but no time: `start`
    is None, and ``metadata["event"]`` identifies files of one recording.
    """
    lines = decode_text(blob).split("\n")
    sampling_line, count, dt = _parse_sampling(blob.name, lines)
    header = " ".join(lines[:sampling_line])
    unit_match = re.search(r"UNITS?\s*(?:OF|:|=)\s*([A-Za-z/0-9^]+)", header, re.IGNORECASE)
    if unit_match and unit_match[1].upper() not in ("G", "G'S", "GS"):
        raise RecordFormatError("{name}: AT2 unit {found!r} in the header: expected acceleration in g", name=blob.name, found=unit_match[1])
    values = _parse_samples(blob.name, lines[sampling_line + 1 :], sampling_line + 2)
    if values.size != count:
        message = "{name}: header states {count} samples (NPTS), file contains {found}: file truncated or damaged"
        raise RecordFormatError(message, name=blob.name, count=count, found=values.size)
    event, station, direction = _parse_title(lines[1] if sampling_line > 1 else "", blob.basename)
    code, azimuth, sign = parse_orientation(direction)
    metadata: dict[str, object] = {"unit": "g", "event": event or blob.basename, "direction": direction}
    history = (lazy_gettext("sign of {name!r} (positive down) reversed to UD (positive up)", name=direction),) if sign < 0 else ()
    component = Component(code, sign * values * STANDARD_GRAVITY, azimuth)
    return Record((component,), dt, station=station, source=blob.name, format=FORMAT.name, history=history, metadata=metadata)


def parse_orientation(direction: str) -> tuple[str, float | None, float]:
    """Return code, azimuth in degrees clockwise from north, and sign of a PEER direction.

    Examples
    --------
    >>> parse_orientation("360"), parse_orientation("090"), parse_orientation("164"), parse_orientation("DWN"), parse_orientation("N21E")
    (('NS', 0.0, 1.0), ('EW', 90.0, 1.0), ('164', 164.0, 1.0), ('UD', None, -1.0), ('21', 21.0, 1.0))
    """
    seed = _SEED_DIRECTION.fullmatch(direction.strip())
    parsed_direction = parse_direction(direction.strip()[:3] if seed else direction)
    if parsed_direction is None:
        return re.sub(r"[\s.]", "", direction.upper()) or "H1", None, 1.0
    return parsed_direction.code, parsed_direction.azimuth_deg, parsed_direction.sign


def split_direction(basename: str) -> tuple[str, str] | None:
    """Return a file name without the direction, and the direction; None if there is none.

    Examples
    --------
    >>> split_direction("RSN1690_NORTH151_SYL360-hor2.AT2"), split_direction("I-ELC-UP.AT2"), split_direction("elcentro.at2")
    (('RSN1690_NORTH151_SYL', '360'), ('I-ELC', 'UP'), None)
    """
    stem = re.sub(r"\.at2\Z", "", basename, flags=re.IGNORECASE)
    seed = _SEED_NAME.match(stem)
    if seed is not None:
        return f"{seed['before']}?{seed['after']}", stem[seed.start("code") - 2 : seed.end("code")]
    match = _FILE_NAME.match(stem)
    if match is None or not match["base"]:
        return None
    return match["base"].rstrip("-_ "), match["direction"]


def _parse_sampling(name: str, lines: Sequence[str]) -> tuple[int, int, float]:
    """Return line index, NPTS and DT of the sampling line."""
    for index, line in enumerate(lines[:_HEADER_LINES]):
        old_match = _OLD_STYLE.match(line)
        new_match = [(pattern.findall(line) or [""])[0] for pattern in (_COUNT, _INTERVAL)]
        count, interval = old_match.groups() if old_match else new_match
        if count and interval:
            stated_values = [set(map(parse_number, pattern.findall("\n".join(lines[: index + 1])))) for pattern in (_COUNT, _INTERVAL)]
            # contradicting values indicate concatenated or edited headers
            if any(len(values) > 1 for values in stated_values):
                message = "expected one NPTS and one DT, found several in the header: {text!r}"
                raise line_error(message, name, index + 1, text=line.strip()[:80])
            dt = parse_number(interval)
            if not dt or dt < 0:
                raise line_error("expected a sampling interval DT above 0, found {interval!r}", name, index + 1, interval=interval)
            return index, int(count), dt
    message = "{name}: AT2 header incomplete: no NPTS= and DT= in the first {count} lines"
    raise RecordFormatError(message, name=name, count=_HEADER_LINES)


def _parse_samples(name: str, lines: Sequence[str], first_line: int) -> FloatArray:
    """Return the samples, g, (n,)."""
    tokens = " ".join(lines).split()
    if not tokens:
        raise RecordFormatError("{name}: no samples after the header (line {line})", name=name, line=first_line - 1)
    try:
        values = np.fromiter(map(float, tokens), dtype=np.float64, count=len(tokens))
    except ValueError:
        values = np.full(1, np.nan)
    if not np.isfinite(values).all():
        for offset, line in enumerate(lines):
            for cell in line.split():
                if parse_number(cell) is None:
                    raise line_error("expected accelerations in g, found {cell!r}", name, first_line + offset, cell=cell)
    return values


def _parse_title(line: str, basename: str) -> tuple[str, str, str]:
    """Return event, station and direction from the second header line, else the direction from the file name."""
    fields = [field.strip() for field in line.split(",")]
    name_parts = split_direction(basename)
    # event, date, station, which may contain commas, and direction
    if len(fields) >= 4:
        return ", ".join(fields[:2]), ", ".join(fields[2:-1]), fields[-1]
    if len(fields) == 3 and parse_orientation(fields[-1])[1:] != (None, 1.0):
        return fields[0], fields[1], fields[2]
    return line.strip(), name_parts[0] if name_parts else "", name_parts[1] if name_parts else ""


def at2_file_set(basename: str) -> FileSet | None:
    """Return the file set of an AT2 file whose name ends with the direction.

    Examples
    --------
    >>> at2_file_set("RSN1690_NORTH151_SYL360-hor2.AT2"), at2_file_set("elcentro.at2")
    (FileSet(key='rsn1690_north151_syl', size=3, component='NS', level=''), None)
    """
    parts = split_direction(basename) if basename.lower().endswith(".at2") else None
    return parts and FileSet(parts[0].lower(), 3, parse_orientation(parts[1])[0])


def _recording_key(head: bytes) -> object:
    """Return the title without the direction, and the sampling interval."""
    lines = head[:2000].splitlines()
    interval = re.search(rb"DT\s*=\s*0*([\d.]+)", head[:2000])
    # .0200 and 0.02 are the same interval
    return lines[1].rpartition(b",")[0] if len(lines) > 1 else b"", interval and interval[1].rstrip(b"0")


FORMAT = register(
    Format(
        name="AT2",
        title="PEER AT2",
        parse=read_at2,
        matches=is_at2,
        matches_text=_is_integral,
        is_derived=lambda head: _is_integral(head[:2000].decode("latin-1").splitlines()),
        proves=("count", "unit", "instrument"),
        specificity=1,  # NPTS and DT may stand in any of the first lines
        synchronous=True,
        file_set=at2_file_set,
        recording_key=_recording_key,
    )
)
