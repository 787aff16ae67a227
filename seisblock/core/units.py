"""Unit conversion and parsing of quantities; all internal values are SI."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping
from itertools import pairwise
from typing import NamedTuple

from seisblock.core import checks
from seisblock.core._warnings import called_externally, warn_external
from seisblock.core.errors import ParameterError, UnitError
from seisblock.core.i18n import lazy_gettext

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity, m/s^2 (CGPM 1901)."""

GAL = 0.01
"""One gal (cm/s^2) in m/s^2."""

KINE = 0.01
"""One kine (cm/s) in m/s."""

SUN = 0.0303
"""One sun in m: 1/33 m rounded as masons use it, 30.3 mm ([Furukawa2009]_, table 1)."""

SHAKU = 10 * SUN
"""One shaku in m, ten sun."""

BU = SUN / 10
"""One bu in m, a tenth of a sun."""

MAX_UNITLESS_LENGTH = 20.0
"""Maximum length accepted without a unit, m; a larger number was probably meant in cm or mm."""

ACCELERATION_UNITS = {
    "gal": GAL,
    "cm/s2": GAL,
    "cm/s^2": GAL,
    "cm/s/s": GAL,
    "cm/sec2": GAL,
    "cm/sec/sec": GAL,
    "mm/s2": 1e-3,
    "mm/s^2": 1e-3,
    "m/s2": 1.0,
    "m/s^2": 1.0,
    "m/s/s": 1.0,
    "g": STANDARD_GRAVITY,
    "mg": 1e-3 * STANDARD_GRAVITY,
}


VELOCITY_UNITS = {"m/s": 1.0, "cm/s": KINE, "kine": KINE, "mm/s": 1e-3, "in/s": 0.0254}


class FigureSize(NamedTuple):
    """Width and height of a figure, m, and the unit in which they are displayed."""

    width: float
    height: float
    unit: str = "cm"


LENGTH_UNITS = {
    "m": 1.0,
    "cm": 1e-2,
    "mm": 1e-3,
    "km": 1e3,
    "sun": SUN,
    "寸": SUN,
    "shaku": SHAKU,
    "尺": SHAKU,
    "bu": BU,
    "分": BU,
    "in": 0.0254,
    "ft": 0.3048,
}

MASS_UNITS = {"kg": 1.0, "t": 1e3, "g": 1e-3}

MAX_QUANTITY_LENGTH = 200
"""Maximum length of the text of a number with its unit, characters."""

WIDE_DECOMPOSITIONS = ("<wide>", "<square>")
"""Unicode decomposition types of full-width characters and of units in a single character cell."""

_QUANTITY_TERM = re.compile(r"\s*+((?<!\d)\d++(?:\.\d*+)?|\.\d++)\s*+([^\d\s.+-]++)")
_QUANTITY = re.compile(r"\s*+([-+]?+(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][-+]?+\d++)?+)\s*+(.*\S|)\s*\Z")


def unit_suffix(unit: str) -> str:
    """Return the suffix of names of quantities in a unit: ``_m_s2`` for ``m/s^2``, empty for a dimensionless one.

    Parameters
    ----------
    unit : str
        Unit, ``1`` for a dimensionless quantity.

    Returns
    -------
    str

    Examples
    --------
    >>> from seisblock.units import unit_suffix
    >>> unit_suffix("m/s^2"), unit_suffix("1")
    ('_m_s2', '')
    """
    return "" if unit in ("", "1") else "_" + unit.replace("/", "_").replace("^", "")


def acceleration_unit(name: str) -> float:
    """Return the value of an acceleration unit in m/s^2.

    Parameters
    ----------
    name : str
        Unit, such as ``gal``; case-insensitive.

    Returns
    -------
    float, m/s^2

    Raises
    ------
    UnitError
        If the unit is not one of ``ACCELERATION_UNITS``.

    Examples
    --------
    >>> from seisblock.units import acceleration_unit
    >>> acceleration_unit("gal"), acceleration_unit("g")
    (0.01, 9.80665)
    """
    factor = ACCELERATION_UNITS.get(name.strip().lower())
    if factor is None:
        raise UnitError("unknown unit of acceleration {name!r}: give gal, m/s2 or g", name=name)
    return factor


def parse_length(text: str | float, *, quantity: str = "length") -> float:
    """Return a length in metres from a number (metres) or a text such as ``24cm``, ``8sun`` or ``2尺4寸``.

    Parameters
    ----------
    text : str or float
        A number without a unit is in metres and at most 20. Several units in descending order add up.
    quantity : str
        Name of the length in messages.

    Returns
    -------
    float, m

    Raises
    ------
    UnitError
        If the unit is unknown, or missing for a number above 20.
    ParameterError
        If the text is not a number with a unit.

    Examples
    --------
    >>> from seisblock.units import parse_length
    >>> parse_length("8sun"), parse_length("2尺4寸")
    (0.2424, 0.7272)
    """
    if isinstance(text, str):
        text = to_halfwidth(text)
        pieces = _QUANTITY_TERM.findall(text) if len(text) <= MAX_QUANTITY_LENGTH else []
        units = [LENGTH_UNITS.get(unit, 0.0) for _, unit in pieces]
        # several terms with known, descending units and nothing between them
        if len(pieces) > 1 and not _QUANTITY_TERM.sub("", text).strip() and all(a > b > 0.0 for a, b in pairwise(units)):
            # rounding removes binary round-off such as 0.24240000000000003
            return round(sum(float(number) * unit for (number, _), unit in zip(pieces, units, strict=True)), 15)
    value = _parse(text, LENGTH_UNITS, "m", quantity)
    if abs(value) > MAX_UNITLESS_LENGTH and (not isinstance(text, str) or is_unitless(text)):
        raise UnitError(
            "{what} {value:g} has no unit and exceeds 20 m: write {value:g}cm, {value:g}mm or {value:g}m",
            what=quantity,
            value=value,
        )
    return value


def to_halfwidth(text: str) -> str:
    """Return a text with full-width letters, digits and unit signs replaced by ASCII.

    Superscripts and fractions are kept (``10²`` is not 102), and so are texts longer than a number with its unit.

    Examples
    --------
    >>> to_halfwidth("２４ｃｍ"), to_halfwidth("24㎝"), to_halfwidth("10²m")
    ('24cm', '24cm', '10²m')
    """
    if len(text) > MAX_QUANTITY_LENGTH or text.isascii():
        return text
    return "".join(
        unicodedata.normalize("NFKC", character) if unicodedata.decomposition(character).startswith(WIDE_DECOMPOSITIONS) else character
        for character in text
    )


def warn_large_lengths(name: str, depth: int = 3, /, **lengths: float | None) -> None:
    """Warn of lengths above 20 m passed from external code, where cm or mm were probably meant.

    Parameters
    ----------
    name : str
        Name of the body.
    depth : int
        Number of stack frames to the caller, see :func:`~seisblock.core._warnings.called_externally`; three from ``__post_init__``.
    lengths : float or None, m
        Lengths by name; None if not specified.
    """
    large = {quantity: value for quantity, value in lengths.items() if value is not None and value > MAX_UNITLESS_LENGTH}
    if large and called_externally(depth):
        text = lazy_gettext(
            "{name}: {lengths} (above 20 m); lengths are in m, {value:g} cm = {metres:g} m",
            name=name,
            lengths=[f"{quantity} = {value:g} m" for quantity, value in large.items()],
            value=next(iter(large.values())),
            metres=0.01 * next(iter(large.values())),
        )
        warn_external(text, depth)


def parse_quantity(text: str | float, units: Mapping[str, float], *, quantity: str) -> tuple[float, bool]:
    """Return a number in SI and whether the text had a unit.

    Parameters
    ----------
    text : str or float
    units : mapping of str to float
        Admissible units and their values in SI.
    quantity : str
        Name of the number in messages.

    Raises
    ------
    UnitError
        If the unit is unknown.
    ParameterError
        If the text is not a number with a unit.

    Examples
    --------
    >>> parse_quantity("60 cm/s", VELOCITY_UNITS, quantity="the median"), parse_quantity(0.6, VELOCITY_UNITS, quantity="the median")
    ((0.6, True), (0.6, False))
    """
    unitless = not isinstance(text, str) or is_unitless(text)
    return _parse(text.strip() if isinstance(text, str) else text, {"": 1.0, **units}, "", quantity), not unitless


def parse_mass(text: str | float, *, quantity: str = "mass") -> float:
    """Return a mass in kilograms from a number (kg) or a text such as ``1.3t``.

    Parameters
    ----------
    text : str or float
        Number, kg, or text with a unit of ``MASS_UNITS``.
    quantity : str
        Name of the quantity in an error.

    Returns
    -------
    float, kg

    Raises
    ------
    UnitError
        If the unit is unknown.

    Examples
    --------
    >>> from seisblock.units import parse_mass
    >>> parse_mass("1.3t"), parse_mass(250)
    (1300.0, 250.0)
    """
    return _parse(text, MASS_UNITS, "kg", quantity)


def parse_acceleration(text: str, *, quantity: str = "acceleration") -> float:
    """Return an acceleration in m/s^2 from a text with its unit, such as ``245gal``, ``2.45 m/s2`` or ``0.25g``.

    Parameters
    ----------
    text : str
        A number with a unit, which is required: gal and m/s^2 differ by a factor of 100.
    quantity : str
        Name of the acceleration in messages.

    Returns
    -------
    float, m/s^2

    Raises
    ------
    UnitError
        If the unit is missing or unknown.
    ParameterError
        If the text is not a number with a unit.

    Examples
    --------
    >>> from seisblock.units import parse_acceleration
    >>> parse_acceleration("245gal")
    2.45
    """
    match = _match_quantity(text)
    if match is None:
        raise ParameterError(
            "{what} {text!r} is not a number with a unit: write, for example, 245gal, 2.45m/s2 or 0.25g", what=quantity, text=text
        )
    if not match[2]:
        raise UnitError(
            "{what} {text!r} has no unit: write {number}gal, {number}m/s2 or {number}g", what=quantity, text=text, number=text.strip()
        )
    return _parse(text.lower(), ACCELERATION_UNITS, "m/s2", quantity)


def _match_quantity(text: str) -> re.Match[str] | None:
    """Match a number and its unit; overlong texts are rejected first to bound the time of the regular expression."""
    return _QUANTITY.match(to_halfwidth(text)) if len(text) <= MAX_QUANTITY_LENGTH else None


def is_unitless(text: str) -> bool:
    """Return True if a text is a number without a unit."""
    match = _match_quantity(text)
    return match is not None and not match[2]


def _parse(text: str | float, table: Mapping[str, float], default: str, quantity: str) -> float:
    """Return a number in SI, its unit looked up in `table`."""
    if not isinstance(text, str):
        value, unit = checks.finite(quantity, text), ""
    else:
        match = _match_quantity(text)
        if match is None:
            raise ParameterError(
                "{what} {text!r} is not a number with a unit: write, for example, 0.24, 24cm or 8sun", what=quantity, text=text
            )
        value, unit = float(match[1]), match[2]
    factor = table.get(unit or default)
    if unit.startswith(","):
        raise ParameterError(
            "{what} {text!r} contains a comma: write a decimal point, and no separator of thousands", what=quantity, text=text
        )
    if factor is None:
        raise UnitError(
            "{what} {text!r}: unknown unit {unit!r}; use one of {known}",
            what=quantity,
            text=text,
            unit=unit,
            known=[name for name in table if name],
        )
    if not math.isfinite(value):
        raise ParameterError("{what} must be finite, found {text!r}", what=quantity, text=text)
    return round(value * factor, 15) if unit else value
