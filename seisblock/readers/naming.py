"""What stands in a column's name besides its direction: the time, a unit, another quantity."""

from __future__ import annotations

import re
import unicodedata

from seisblock.readers.directions import direction_of, without_company
from seisblock.words import noted

TIME = "TIME"

_NAMES = {
    "ACC": ("acc", "acceleration", "accel", "a", "加速度"),
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
    ),
}
_NAME = {spelling: code for code, spellings in _NAMES.items() for spelling in spellings}
_BRACKETED = re.compile(r"^(.*?)\s*[(\[{<]\s*([^)\]}>]*?)\s*[)\]}>]\s*$")
_WITHIN = re.compile(r"^(.*?)\s*[(\[{<]\s*([^)\]}>]*?)\s*[)\]}>]\W")
_SUFFIXED = re.compile(
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
_TIME_UNITS = {"s": 1.0, "sec": 1.0, "secs": 1.0, "second": 1.0, "seconds": 1.0, "秒": 1.0, "ms": 1e-3, "msec": 1e-3, "min": 60.0}
_ZONES = {"jst": 32400, "日本時間": 32400, "日本標準時": 32400, "utc": 0, "gmt": 0}
_CLOCK = re.compile(r"(?:y+[-/]m+[-/]d+[t ]*)?h+:m+(?::s+(?:\.[sf]+)?)?", re.IGNORECASE)
_OTHER_UNITS = {
    noted("a velocity"): ("m/s", "cm/s", "mm/s", "m/sec", "cm/sec", "kine", "kines", "カイン"),
    noted("a displacement"): ("m", "cm", "mm"),
    noted("an angle"): ("deg", "rad"),
    noted("a frequency"): ("hz",),
}
_OTHER_NAMES = {
    noted("a velocity"): ("vel", "velocity", "速度"),
    noted("a displacement"): ("disp", "displacement", "変位"),
    noted("a number of the line"): ("index", "no", "nr", "number", "#", "sample", "samples", "count", "id", "step", "番号"),
    noted("a note"): ("note", "notes", "remark", "remarks", "comment", "comments", "flag", "quality", "備考"),
}
_OTHER_UNIT = {spelling: what for what, spellings in _OTHER_UNITS.items() for spelling in spellings}
_OTHER_NAME = {spelling: what for what, spellings in _OTHER_NAMES.items() for spelling in spellings}


def tidy(text: str) -> str:
    """Return a cell without quotes, blanks around it and full-width letters."""
    return unicodedata.normalize("NFKC", text).strip().strip("\"'").strip()


def normal_unit(text: str) -> str | None:
    """Return ``gal``, ``m/s2``, ``mm/s2``, ``g`` or ``mg`` (a thousandth of g) for any spelling of an acceleration unit, else None.

    Examples
    --------
    >>> normal_unit("cm/sec/sec"), normal_unit("m/s²"), normal_unit("g's"), normal_unit("V")
    ('gal', 'm/s2', 'g', None)
    """
    plain = tidy(text).lower().replace("sec", "s").replace("/s/s", "s2").replace("s^-2", "s2").replace("s-2", "s2")
    return _UNITS.get(re.sub(r"[\s/^_*.'’]", "", plain))


def time_unit(text: str) -> float | None:
    """Return the value of a unit of time in seconds, or None."""
    return _TIME_UNITS.get(tidy(text).lower())


def zone_of(text: str) -> int | None:
    """Return how far the clock of a zone is ahead of UTC, s: of what stands in the place of a unit of time, ``time (JST)``; else None."""
    return _ZONES.get(tidy(text).lower())


def tells_clock(text: str) -> bool:
    """Return whether what stands in the place of a unit of time says that a clock tells it: ``JST``, ``hh:mm:ss``."""
    return zone_of(text) is not None or _CLOCK.fullmatch(tidy(text)) is not None


def is_unit(text: str) -> bool:
    """Return whether a text is a unit: of acceleration, of time, or of what a table holds beside them."""
    return bool(normal_unit(text) or time_unit(text) or tidy(text).lower() in _OTHER_UNIT)


def split_unit(text: str) -> tuple[str, str]:
    """Return a column's name and the unit that stands in it, empty when there is none.

    Examples
    --------
    >>> split_unit("EW (gal)"), split_unit("ns_m_s2"), split_unit("UD"), split_unit("Time [s] - Plot 0")
    (('EW', 'gal'), ('ns', 'm_s2'), ('UD', ''), ('Time', 's'))
    """
    plain = tidy(text)
    match = _BRACKETED.match(plain) or _SUFFIXED.match(plain)
    if match is None:
        within = _WITHIN.match(plain)
        match = within if within and (normal_unit(within[2]) or time_unit(within[2])) else None
    return (match[1].strip(), match[2]) if match else (plain, "")


def bare_name(text: str) -> str:
    """Return a column's name without unit and without the words acceleration, component and direction: ``x`` of ``acc_x (gal)``."""
    return without_company(split_unit(text)[0])


def other_quantity(text: str) -> str | None:
    """Return what a column holds that is no acceleration and no time by its own name or unit, or None.

    Examples
    --------
    >>> other_quantity("vel (cm/s)"), other_quantity("index"), other_quantity("NS (gal)")
    ('a velocity', 'a number of the line', None)
    """
    name, unit = split_unit(text)
    if normal_unit(unit) or time_unit(unit):
        return None
    return _OTHER_UNIT.get(unit.lower()) or _OTHER_NAME.get(re.sub(r"[\s_.]", "", name).lower())


def code_of(text: str) -> str:
    """Return the component code that a column's name means: ``NS``, ``EW``, ``UD``, an azimuth, ``TIME``, else the name in capitals.

    Examples
    --------
    >>> [code_of(name) for name in ("N-S(gal)", "東西", "ud_gal", "relative time (s)", "acc (g)", "acc_x", "N80W")]
    ['NS', 'EW', 'UD', 'TIME', 'ACC', 'X', '280']
    """
    stripped = bare_name(text)
    key = re.sub(r"[\s_\-.]", "", stripped).lower()
    if key in _NAME:
        return _NAME[key]
    direction = direction_of(stripped)
    return direction.code if direction and not direction.bare else stripped.upper()
