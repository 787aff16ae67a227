"""Parsing of column names: time, unit, other quantities."""

from __future__ import annotations

import re
import unicodedata

from seisblock.core.errors import UnitError
from seisblock.core.i18n import N_
from seisblock.readers.directions import parse_direction, strip_component_words

TIME = "TIME"

_CODE_NAMES = {
    "ACC": (
        *("acc", "acceleration", "accel", "a", "加速度"),
        *("aceleración", "aceleracion", "accélération", "accelerazione", "beschleunigung", "ivme"),
    ),
    TIME: (
        "time",
        "t",
        "relativetime",
        "elapsedtime",
        "datetime",
        "timestamp",
        "sec",
        "secs",
        "seconds",
        "時間",
        "時刻",
        "経過時間",
        "日時",
        "秒",
        *("zeit", "uhrzeit", "tiempo", "tempo", "temps", "zaman", "时间", "时刻"),
    ),
}
_CODE_BY_NAME = {spelling: code for code, spellings in _CODE_NAMES.items() for spelling in spellings}
_BRACKETED_UNIT = re.compile(r"^(.*?)\s*[(\[{<]\s*([^)\]}>]*?)\s*[)\]}>]\s*$")
_INNER_UNIT = re.compile(r"^(.*?)\s*[(\[{<]\s*([^)\]}>]*?)\s*[)\]}>]\W")
_SUFFIXED_UNIT = re.compile(
    r"^(.*?)[ _]+((?:cm|mm|m)[/_ ]?s(?:ec)?[\^_]?2|(?:cm|mm|m)/s(?:ec)?/s(?:ec)?|(?:cm|mm|m)/s(?:ec)?|gals?|kines?|m?g|ガル|sec|s|ms)$",
    re.IGNORECASE,
)
_UNITS = {
    "gal": "gal",
    "gals": "gal",
    "ガル": "gal",
    "cms2": "gal",
    "ms2": "m/s2",
    "mms2": "mm/s2",
    "g": "g",
    "gs": "g",
    "mg": "mg",
    "millig": "mg",
    "milli-g": "mg",
}
_TIME_UNITS = {
    "s": 1.0,
    "sec": 1.0,
    "secs": 1.0,
    "second": 1.0,
    "seconds": 1.0,
    "秒": 1.0,
    "seg": 1.0,
    "sn": 1.0,
    "ms": 1e-3,
    "msec": 1e-3,
    "min": 60.0,
}
_ZONES = {"jst": 32400, "日本時間": 32400, "日本標準時": 32400, "utc": 0, "gmt": 0}
_CLOCK = re.compile(r"(?:y+[-/]m+[-/]d+[t ]*)?h+:m+(?::s+(?:\.[sf]+)?)?", re.IGNORECASE)
_OTHER_UNITS = {
    N_("velocity values"): ("m/s", "cm/s", "mm/s", "m/sec", "cm/sec", "kine", "kines", "カイン"),
    N_("displacement values"): ("m", "cm", "mm"),
    N_("angle"): ("deg", "rad"),
    N_("frequency"): ("hz",),
}
_OTHER_NAMES = {
    N_("velocity values"): ("vel", "velocity", "速度"),
    N_("displacement values"): ("disp", "displacement", "変位"),
    N_("line number"): ("index", "no", "nr", "number", "#", "sample", "samples", "count", "id", "step", "番号"),
    N_("remarks"): ("note", "notes", "remark", "remarks", "comment", "comments", "flag", "quality", "備考"),
}
# 合成波, 合成地震動: a synthetic motion
_RESULTANT = re.compile(r"合成(?!地震|波|動)|\bresultant\b|\bvector[ _]?sum\b|^\|[^|]+\|$", re.IGNORECASE)
_QUANTITY_BY_UNIT = {spelling: quantity for quantity, spellings in _OTHER_UNITS.items() for spelling in spellings}
_QUANTITY_BY_NAME = {spelling: quantity for quantity, spellings in _OTHER_NAMES.items() for spelling in spellings}


def normalize_cell(text: str) -> str:
    """Return a cell without quotes, surrounding blanks and full-width letters."""
    return unicodedata.normalize("NFKC", text).strip().strip("\"'").strip()


def normalize_unit(text: str) -> str | None:
    """Return ``gal``, ``m/s2``, ``mm/s2``, ``g`` or ``mg`` for a spelling of an acceleration unit, else None.

    Examples
    --------
    >>> normalize_unit("cm/sec/sec"), normalize_unit("m/s²"), normalize_unit("g's"), normalize_unit("V")
    ('gal', 'm/s2', 'g', None)
    """
    # in Latin-1 read as Shift-JIS a superscript 2 is a half-width katakana
    unit_text = normalize_cell(text).lower().replace("\u2212", "-").replace("イ", "2")
    unit_text = unit_text.replace("sec", "s").replace("/s/s", "s2").replace("s^-2", "s2").replace("s-2", "s2")
    return _UNITS.get(re.sub(r"[\s/^_*.'’·⋅]", "", unit_text))


def require_unit(name: str, line: int, text: str) -> str:
    """Return the normalised acceleration unit in a line of a file; raise UnitError if there is none."""
    unit = normalize_unit(text)
    if unit is None:
        raise UnitError("{name}, line {line}: unknown acceleration unit {text!r}", name=name, line=line, text=text)
    return unit


def time_unit_seconds(text: str) -> float | None:
    """Return a time unit in seconds, or None."""
    return _TIME_UNITS.get(normalize_cell(text).lower())


def zone_offset_s(text: str) -> int | None:
    """Return the UTC offset, s, of a time zone written as a unit (``time (JST)``), or None."""
    return _ZONES.get(normalize_cell(text).lower())


def is_clock_unit(text: str) -> bool:
    """Return whether a text in the place of a time unit denotes clock time: ``JST``, ``hh:mm:ss``."""
    return zone_offset_s(text) is not None or _CLOCK.fullmatch(normalize_cell(text)) is not None


def is_unit(text: str) -> bool:
    """Return whether a text is a unit of acceleration, time or another known quantity."""
    return bool(normalize_unit(text) or time_unit_seconds(text) or normalize_cell(text).lower() in _QUANTITY_BY_UNIT)


def split_unit(text: str) -> tuple[str, str]:
    """Return the name and the unit of a column heading; the unit may be empty.

    Examples
    --------
    >>> split_unit("EW (gal)"), split_unit("ns_m_s2"), split_unit("UD"), split_unit("Time [s] - Plot 0")
    (('EW', 'gal'), ('ns', 'm_s2'), ('UD', ''), ('Time', 's'))
    """
    cell = normalize_cell(text)
    # a unit stands in brackets at the end, as a suffix, or in brackets before other words
    match = _BRACKETED_UNIT.match(cell) or _SUFFIXED_UNIT.match(cell)
    if match is None:
        inner_match = _INNER_UNIT.match(cell)
        match = inner_match if inner_match and (normalize_unit(inner_match[2]) or time_unit_seconds(inner_match[2])) else None
    return (match[1].strip(), match[2]) if match else (cell, "")


def strip_name(text: str) -> str:
    """Return a column name without unit and filler words: ``x`` for ``acc_x (gal)``."""
    return strip_component_words(split_unit(text)[0])


def classify_other_quantity(text: str) -> str | None:
    """Return the quantity of a column that is neither acceleration nor time, or None.

    Examples
    --------
    >>> classify_other_quantity("vel (cm/s)"), classify_other_quantity("index"), classify_other_quantity("NS (gal)")
    ('velocity values', 'line number', None)
    >>> classify_other_quantity("合成 (gal)"), classify_other_quantity("合成波 (gal)")
    ('resultant of several components', None)
    """
    name, unit = split_unit(text)
    if _RESULTANT.search(name):
        return N_("resultant of several components")
    if normalize_unit(unit) or time_unit_seconds(unit):
        return None
    return _QUANTITY_BY_UNIT.get(unit.lower()) or _QUANTITY_BY_NAME.get(re.sub(r"[\s_.]", "", name).lower())


def component_code(text: str) -> str:
    """Return the code of a column name: ``NS``, ``EW``, ``UD``, azimuth, ``TIME``, else the name in capitals.

    Examples
    --------
    >>> [component_code(name) for name in ("N-S(gal)", "東西", "ud_gal", "relative time (s)", "acc (g)", "acc_x", "N80W")]
    ['NS', 'EW', 'UD', 'TIME', 'ACC', 'X', '280']
    """
    bare_name_text = strip_name(text)
    key = re.sub(r"[\s_\-.]", "", bare_name_text).lower()
    if key in _CODE_BY_NAME:
        return _CODE_BY_NAME[key]
    direction = parse_direction(bare_name_text)
    return direction.code if direction and not direction.is_bare_number else bare_name_text.upper()
