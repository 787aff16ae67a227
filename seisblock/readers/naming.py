"""What a column's name says: component, time or unit."""

from __future__ import annotations

import re
import unicodedata

TIME = "TIME"

_CODES = {
    "NS": ("ns", "n", "north", "northsouth", "南北", "南北動", "南北成分"),
    "EW": ("ew", "e", "east", "eastwest", "東西", "東西動", "東西成分"),
    "UD": ("ud", "u", "z", "up", "updown", "vertical", "vert", "v", "上下", "上下動", "上下成分", "鉛直"),
    "ACC": ("acc", "acceleration", "accel", "a", "加速度"),
    TIME: ("time", "t", "relativetime", "elapsedtime", "時間", "時刻", "経過時間", "秒"),
}
_CODE = {spelling: code for code, spellings in _CODES.items() for spelling in spellings}
_QUANTITY = re.compile(r"^(?:acc(?:eleration)?|a)[ _-]+(?=.)|(?<=.)[ _-]+(?:acc(?:eleration)?|component|comp)$|加速度", re.IGNORECASE)
_BRACKETED = re.compile(r"^(.*?)\s*[(\[{<]\s*(.*?)\s*[)\]}>]\s*$")
_SUFFIXED = re.compile(r"^(.*?)[ _]+((?:cm|mm|m)[/_ ]?s(?:ec)?[\^_]?2|(?:cm|mm|m)/s(?:ec)?/s(?:ec)?|gals?|g|ガル|sec|s|ms)$", re.IGNORECASE)
_UNITS = {
    "gal": "gal",
    "gals": "gal",
    "ガル": "gal",
    "cms2": "gal",
    "ms2": "m/s2",
    "mms2": "mm/s2",
    "g": "g",
    "gs": "g",
}
_TIME_UNITS = {"s": 1.0, "sec": 1.0, "secs": 1.0, "second": 1.0, "seconds": 1.0, "秒": 1.0, "ms": 1e-3, "msec": 1e-3}


def tidy(text: str) -> str:
    """Return a cell without quotes, blanks around it and full-width letters."""
    return unicodedata.normalize("NFKC", text).strip().strip("\"'").strip()


def normal_unit(text: str) -> str | None:
    """Return ``gal``, ``m/s2``, ``mm/s2`` or ``g`` for any spelling of an acceleration unit, else None.

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


def split_unit(text: str) -> tuple[str, str]:
    """Return a column's name and the unit that stands in it, empty when there is none.

    Examples
    --------
    >>> split_unit("EW (gal)"), split_unit("ns_m_s2"), split_unit("UD")
    (('EW', 'gal'), ('ns', 'm_s2'), ('UD', ''))
    """
    plain = tidy(text)
    match = _BRACKETED.match(plain) or _SUFFIXED.match(plain)
    return (match[1].strip(), match[2]) if match else (plain, "")


def code_of(text: str) -> str:
    """Return the component code that a column's name means: ``NS``, ``EW``, ``UD``, ``TIME``, else the name in capitals.

    Examples
    --------
    >>> [code_of(name) for name in ("N-S(gal)", "東西", "ud_gal", "relative time (s)", "acc (g)")]
    ['NS', 'EW', 'UD', 'TIME', 'ACC']
    """
    name = split_unit(text)[0]
    stripped = _QUANTITY.sub("", name) or name
    key = re.sub(r"[\s_\-.]", "", stripped).lower()
    return _CODE.get(key, name.strip().upper())
