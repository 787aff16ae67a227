"""What a number must be: said once, for solvers, bodies, criteria and the command line.

Every check takes the quantity as a sentence begins with it, a template if it has values, then the number; it returns the number as a
float, or refuses it. Nothing is worded before it is refused: bodies are built in inner loops.
"""

from __future__ import annotations

import math
from numbers import Integral, Real
from os import PathLike
from typing import TYPE_CHECKING, Any, TypeVar

from seisblock.errors import InputError, KindError, ParameterError
from seisblock.words import said

if TYPE_CHECKING:
    from seisblock.typing import FloatArray

Refusal = type[InputError]
"""The class of error that says so."""

SMALLEST, LARGEST = 1e-100, 1e100
"""Sizes between which squares and cubes stay in the range of numbers; nothing on earth is beyond."""

LONGEST_SHOWN = 200
"""How much is shown of what is no number."""

Kind = TypeVar("Kind")


def finite(what: str, value: Any, /, unit: str = "", *, error: Refusal = ParameterError, **names: Any) -> float:
    """Return a finite number.

    Parameters
    ----------
    what : str
        The quantity, as a sentence begins: ``the slope``, or ``{name}: the slope``.
    value : any
        What was given for it; a truth or a text is no number.
    unit : str
        Told after the number.
    error : class
        Raised instead of :class:`ParameterError`.
    names : any
        Of the fields of `what`.

    Examples
    --------
    >>> finite("the slope", 3, "degrees")
    3.0
    >>> finite("{name}: the slope", float("nan"), name="stair")
    Traceback (most recent call last):
    seisblock.errors.ParameterError: stair: the slope must be a finite number, found nan
    """
    number = _number(what, value, error, names)
    if not math.isfinite(number):
        raise error("{what} must be a finite number, found {found}", what=said(what, **names), found=_found(number, unit))
    return _in_range(what, number, unit, error, names)


def positive(what: str, value: Any, /, unit: str = "", *, error: Refusal = ParameterError, **names: Any) -> float:
    """Return a finite number above zero; parameters as for :func:`finite`.

    Examples
    --------
    >>> positive("gravity", 0, "m/s^2")
    Traceback (most recent call last):
    seisblock.errors.ParameterError: gravity must be positive, found 0 m/s^2
    """
    number = _number(what, value, error, names)
    if not 0.0 < number < math.inf:
        raise error("{what} must be positive, found {found}", what=said(what, **names), found=_found(number, unit))
    return _in_range(what, number, unit, error, names, least=SMALLEST)


def nonzero(what: str, value: Any, /, unit: str = "", *, error: Refusal = ParameterError, **names: Any) -> float:
    """Return a finite number that is not zero; parameters as for :func:`finite`.

    Examples
    --------
    >>> nonzero("the scale factor", 0)
    Traceback (most recent call last):
    seisblock.errors.ParameterError: the scale factor must not be zero
    """
    number = finite(what, value, unit, error=error, **names)
    if number == 0.0:
        raise error("{what} must not be zero", what=said(what, **names))
    return _in_range(what, number, unit, error, names, least=SMALLEST)


def not_negative(what: str, value: Any, /, unit: str = "", *, error: Refusal = ParameterError, **names: Any) -> float:
    """Return a finite number that is zero or more; parameters as for :func:`finite`."""
    number = _number(what, value, error, names)
    if not 0.0 <= number < math.inf:
        raise error("{what} must be zero or more, found {found}", what=said(what, **names), found=_found(number, unit))
    return _in_range(what, number, unit, error, names)


def within(what: str, value: Any, /, interval: str, unit: str = "", *, error: Refusal = ParameterError, **names: Any) -> float:
    """Return a number of an interval.

    Parameters
    ----------
    what, value, unit, error, names
        As for :func:`finite`.
    interval : str
        Its two ends, each included by ``[`` or ``]``, left out by ``(`` or ``)``.

    Examples
    --------
    >>> within("the level", 90.0, "(0, 1)")
    Traceback (most recent call last):
    seisblock.errors.ParameterError: the level must lie in (0, 1), found 90
    """
    number = _number(what, value, error, names)
    low, high = (float(end) for end in interval[1:-1].split(","))
    above = low <= number if interval[0] == "[" else low < number
    below = number <= high if interval[-1] == "]" else number < high
    if not (above and below):
        found = _found(number, unit)
        raise error("{what} must lie in {interval}, found {found}", what=said(what, **names), interval=interval, found=found)
    return number


def fraction(what: str, value: Any, /, *, error: Refusal = ParameterError, **names: Any) -> float:
    """Return a number from 0 to 1, both included; parameters as for :func:`finite`."""
    return within(what, value, "[0, 1]", error=error, **names)


def gravity(value: Any) -> float:
    """Return an acceleration of gravity, m/s^2: positive."""
    return positive("gravity", value, "m/s^2")


def azimuth(value: Any, /, *, error: Refusal = ParameterError) -> float:
    """Return a direction within a turn either way, degrees; parameters as for :func:`finite`.

    Examples
    --------
    >>> azimuth(-90)
    -90.0
    >>> azimuth(1e300)
    Traceback (most recent call last):
    seisblock.errors.ParameterError: the azimuth must lie in [-360, 360], found 1e+300 degrees
    """
    return within("the azimuth", value, "[-360, 360]", "degrees", error=error)


def instance(value: Any, kind: type[Kind]) -> Kind:
    """Return what is of a kind, or refuse it.

    Examples
    --------
    >>> instance(None, dict)
    Traceback (most recent call last):
    seisblock.errors.KindError: a dict is needed, found nothing
    """
    if not isinstance(value, kind):
        raise KindError("a {kind} is needed, found {found}", kind=kind.__name__, found=kind_of(value))
    return value


def kind_of(value: Any) -> str:
    """Return what a value is, for a message."""
    return said("nothing") if value is None else type(value).__name__


def function(what: str, value: Any, /) -> Any:
    """Return what can be called, or refuse it.

    Examples
    --------
    >>> function("the criterion", 3)
    Traceback (most recent call last):
    seisblock.errors.KindError: the criterion must be a function, found int
    """
    if not callable(value):
        raise KindError("{what} must be a function, found {found}", what=said(what), found=kind_of(value))
    return value


def path(value: Any) -> str | PathLike[str]:
    """Return the name of a file, or refuse what is none.

    Examples
    --------
    >>> path(None)
    Traceback (most recent call last):
    seisblock.errors.KindError: a path or a name is needed, found nothing
    """
    if not isinstance(value, (str, PathLike)):
        raise KindError("a path or a name is needed, found {found}", found=kind_of(value))
    return value


def numbers(what: str, values: Any, /) -> FloatArray:
    """Return an array of numbers, in whatever shape they come; whether they are finite and in range is asked elsewhere.

    Examples
    --------
    >>> numbers("the sizes", [1, 2.5])
    array([1. , 2.5])
    >>> numbers("the sizes", ["a"])
    Traceback (most recent call last):
    seisblock.errors.ParameterError: the sizes must be numbers, found ['a']
    """
    import numpy as np

    try:
        given = np.asarray(values)
    except ValueError:  # rows that differ in length
        given = np.asarray(None)
    if given.dtype.kind not in "iuf":
        raise ParameterError("{what} must be numbers, found {found}", what=said(what), found=repr(values)[:LONGEST_SHOWN])
    return np.asarray(given, dtype=np.float64)


def row(what: str, values: Any, /) -> FloatArray:
    """Return one row of numbers, (n,); whether they are finite and in range is asked elsewhere.

    Examples
    --------
    >>> row("the acceleration", [[1.0, 2.0]])
    Traceback (most recent call last):
    seisblock.errors.ParameterError: the acceleration must be one row of samples, of shape (n,), found shape (1, 2): give one component
    """
    found = numbers(what, values)
    if found.ndim != 1:
        raise ParameterError(
            "{what} must be one row of samples, of shape (n,), found shape {shape}: give one component",
            what=said(what),
            shape=str(found.shape),
        )
    return found


def whole(what: str, value: Any, /, *, least: int) -> int:
    """Return a whole number that is so large at least.

    Examples
    --------
    >>> whole("the number of runs", 2.5, least=1)
    Traceback (most recent call last):
    seisblock.errors.ParameterError: the number of runs must be a whole number, 1 or more, found 2.5
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < least:
        found = repr(value)[:LONGEST_SHOWN]
        raise ParameterError("{what} must be a whole number, {least} or more, found {found}", what=said(what), least=least, found=found)
    return int(value)


def seed(value: Any) -> int:
    """Return a seed of dice: a whole number, zero or more."""
    return whole("the seed", value, least=0)


def _number(what: str, value: Any, error: Refusal, names: dict[str, Any]) -> float:
    """Return what is a number as one."""
    if isinstance(value, float):
        return value
    if isinstance(value, bool) or not isinstance(value, Real):
        raise error("{what} must be a number, found {value}", what=said(what, **names), value=repr(value)[:LONGEST_SHOWN])
    try:
        return float(value)
    except OverflowError:  # a whole number of more than 308 digits
        return math.inf if value > 0 else -math.inf  # type: ignore[operator]


def _in_range(what: str, number: float, unit: str, error: Refusal, names: dict[str, Any], *, least: float = 0.0) -> float:
    """Return a number of which squares and cubes can be taken."""
    if abs(number) > LARGEST or 0.0 < abs(number) < least:
        what = said(what, **names)
        text = said("{what} lies outside all that can be computed with, found {found}", what=what, found=_found(number, unit))
        raise error(text)
    return number


def _found(number: float, unit: str) -> str:
    """Return a number with its unit."""
    return f"{number:.10g} {unit}".rstrip()
