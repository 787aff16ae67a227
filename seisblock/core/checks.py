"""What a number must be: said once, for solvers, bodies, criteria and the command line.

Every check takes the quantity as a sentence begins with it, a template if it has values, then the number; it returns the number as a
float, or refuses it. Nothing is worded before it is refused: bodies are built in inner loops.
"""

from __future__ import annotations

import math
from numbers import Integral, Real
from os import PathLike
from typing import TYPE_CHECKING, Any, TypeVar

from seisblock.core.errors import InputError, KindError, ParameterError
from seisblock.core.i18n import lazy_gettext

if TYPE_CHECKING:
    from seisblock.core.typing import FloatArray

ErrorClass = type[InputError]
"""The class of error that says so."""

MIN_MAGNITUDE, MAX_MAGNITUDE = 1e-100, 1e100
"""Sizes between which squares and cubes stay in the range of numbers; nothing on earth is beyond."""

MAX_REPR_LENGTH = 200
"""How much is shown of what is no number."""

T = TypeVar("T")


def finite(quantity: str, value: Any, /, unit: str = "", *, error: ErrorClass = ParameterError, **names: Any) -> float:
    """Return a finite number.

    Parameters
    ----------
    quantity : str
        The quantity, as a sentence begins: ``the slope``, or ``{name}: the slope``.
    value : any
        What was given for it; a truth or a text is no number.
    unit : str
        Told after the number.
    error : class
        Raised instead of :class:`ParameterError`.
    names : any
        Of the fields of `quantity`.

    Examples
    --------
    >>> finite("the slope", 3, "degrees")
    3.0
    >>> finite("{name}: the slope", float("nan"), name="stair")
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: stair: the slope must be a finite number, found nan
    """
    number = _to_float(quantity, value, error, names)
    if not math.isfinite(number):
        raise error(
            "{what} must be a finite number, found {found}", what=lazy_gettext(quantity, **names), found=_format_value(number, unit)
        )
    return _check_magnitude(quantity, number, unit, error, names)


def positive(quantity: str, value: Any, /, unit: str = "", *, error: ErrorClass = ParameterError, **names: Any) -> float:
    """Return a finite number above zero; parameters as for :func:`finite`.

    Examples
    --------
    >>> positive("gravity", 0, "m/s^2")
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: gravity must be positive, found 0 m/s^2
    """
    number = _to_float(quantity, value, error, names)
    if not 0.0 < number < math.inf:
        raise error("{what} must be positive, found {found}", what=lazy_gettext(quantity, **names), found=_format_value(number, unit))
    return _check_magnitude(quantity, number, unit, error, names, minimum=MIN_MAGNITUDE)


def nonzero(quantity: str, value: Any, /, unit: str = "", *, error: ErrorClass = ParameterError, **names: Any) -> float:
    """Return a finite number that is not zero; parameters as for :func:`finite`.

    Examples
    --------
    >>> nonzero("the scale factor", 0)
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: the scale factor must not be zero
    """
    number = finite(quantity, value, unit, error=error, **names)
    if number == 0.0:
        raise error("{what} must not be zero", what=lazy_gettext(quantity, **names))
    return _check_magnitude(quantity, number, unit, error, names, minimum=MIN_MAGNITUDE)


def non_negative(quantity: str, value: Any, /, unit: str = "", *, error: ErrorClass = ParameterError, **names: Any) -> float:
    """Return a finite number that is zero or more; parameters as for :func:`finite`."""
    number = _to_float(quantity, value, error, names)
    if not 0.0 <= number < math.inf:
        raise error("{what} must be zero or more, found {found}", what=lazy_gettext(quantity, **names), found=_format_value(number, unit))
    return _check_magnitude(quantity, number, unit, error, names)


def in_interval(quantity: str, value: Any, /, interval: str, unit: str = "", *, error: ErrorClass = ParameterError, **names: Any) -> float:
    """Return a number of an interval.

    Parameters
    ----------
    what, value, unit, error, names
        As for :func:`finite`.
    interval : str
        Its two ends, each included by ``[`` or ``]``, left out by ``(`` or ``)``.

    Examples
    --------
    >>> in_interval("the level", 90.0, "(0, 1)")
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: the level must lie in (0, 1), found 90
    """
    number = _to_float(quantity, value, error, names)
    low, high = (float(end) for end in interval[1:-1].split(","))
    above_low = low <= number if interval[0] == "[" else low < number
    below_high = number <= high if interval[-1] == "]" else number < high
    if not (above_low and below_high):
        text = _format_value(number, unit)
        raise error("{what} must lie in {interval}, found {found}", what=lazy_gettext(quantity, **names), interval=interval, found=text)
    return number


def fraction(quantity: str, value: Any, /, *, error: ErrorClass = ParameterError, **names: Any) -> float:
    """Return a number from 0 to 1, both included; parameters as for :func:`finite`."""
    return in_interval(quantity, value, "[0, 1]", error=error, **names)


def gravity(value: Any) -> float:
    """Return an acceleration of gravity, m/s^2: positive."""
    return positive("gravity", value, "m/s^2")


def azimuth(value: Any, /, *, error: ErrorClass = ParameterError) -> float:
    """Return a direction within a turn either way, degrees; parameters as for :func:`finite`.

    Examples
    --------
    >>> azimuth(-90)
    -90.0
    >>> azimuth(1e300)
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: the azimuth must lie in [-360, 360], found 1e+300 degrees
    """
    return in_interval("the azimuth", value, "[-360, 360]", "degrees", error=error)


def instance(value: Any, kind: type[T]) -> T:
    """Return what is of a kind, or refuse it.

    Examples
    --------
    >>> instance(None, dict)
    Traceback (most recent call last):
    seisblock.core.errors.KindError: a dict is needed, found nothing
    """
    if not isinstance(value, kind):
        raise KindError("a {kind} is needed, found {found}", kind=kind.__name__, found=type_name(value))
    return value


def type_name(value: Any) -> str:
    """Return what a value is, for a message."""
    return lazy_gettext("nothing") if value is None else type(value).__name__


def function(quantity: str, value: Any, /) -> Any:
    """Return what can be called, or refuse it.

    Examples
    --------
    >>> function("the criterion", 3)
    Traceback (most recent call last):
    seisblock.core.errors.KindError: the criterion must be a function, found int
    """
    if not callable(value):
        raise KindError("{what} must be a function, found {found}", what=lazy_gettext(quantity), found=type_name(value))
    return value


def path(value: Any) -> str | PathLike[str]:
    """Return the name of a file, or refuse what is none.

    Examples
    --------
    >>> path(None)
    Traceback (most recent call last):
    seisblock.core.errors.KindError: a path or a name is needed, found nothing
    """
    if not isinstance(value, (str, PathLike)):
        raise KindError("a path or a name is needed, found {found}", found=type_name(value))
    return value


def float_array(quantity: str, values: Any, /) -> FloatArray:
    """Return an array of numbers, in whatever shape they come; whether they are finite and in range is asked elsewhere.

    Examples
    --------
    >>> float_array("the sizes", [1, 2.5])
    array([1. , 2.5])
    >>> float_array("the sizes", ["a"])
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: the sizes must be numbers, found ['a']
    """
    import numpy as np

    try:
        array = np.asarray(values)
    except ValueError:  # rows that differ in length
        array = np.asarray(None)
    if array.dtype.kind not in "iuf":
        raise ParameterError("{what} must be numbers, found {found}", what=lazy_gettext(quantity), found=repr(values)[:MAX_REPR_LENGTH])
    return np.asarray(array, dtype=np.float64)


def float_vector(quantity: str, values: Any, /) -> FloatArray:
    """Return one row of numbers, (n,); whether they are finite and in range is asked elsewhere.

    Examples
    --------
    >>> float_vector("the acceleration", [[1.0, 2.0]])
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: the acceleration must be one row of samples, of shape (n,), found shape (1, 2): give one component
    """
    vector = float_array(quantity, values)
    if vector.ndim != 1:
        raise ParameterError(
            "{what} must be one row of samples, of shape (n,), found shape {shape}: give one component",
            what=lazy_gettext(quantity),
            shape=str(vector.shape),
        )
    return vector


def integer(quantity: str, value: Any, /, *, minimum: int) -> int:
    """Return a whole number that is so large at least.

    Examples
    --------
    >>> integer("the number of runs", 2.5, minimum=1)
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: the number of runs must be a whole number, 1 or more, found 2.5
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < minimum:
        text = repr(value)[:MAX_REPR_LENGTH]
        raise ParameterError(
            "{what} must be a whole number, {least} or more, found {found}", what=lazy_gettext(quantity), least=minimum, found=text
        )
    return int(value)


def seed(value: Any) -> int:
    """Return a seed of dice: a whole number, zero or more."""
    return integer("the seed", value, minimum=0)


def _to_float(quantity: str, value: Any, error: ErrorClass, names: dict[str, Any]) -> float:
    """Return what is a number as one."""
    if isinstance(value, float):
        return value
    if isinstance(value, bool) or not isinstance(value, Real):
        raise error("{what} must be a number, found {value}", what=lazy_gettext(quantity, **names), value=repr(value)[:MAX_REPR_LENGTH])
    try:
        return float(value)
    except OverflowError:  # a whole number of more than 308 digits
        return math.inf if value > 0 else -math.inf  # type: ignore[operator]


def _check_magnitude(quantity: str, number: float, unit: str, error: ErrorClass, names: dict[str, Any], *, minimum: float = 0.0) -> float:
    """Return a number of which squares and cubes can be taken."""
    if abs(number) > MAX_MAGNITUDE or 0.0 < abs(number) < minimum:
        quantity = lazy_gettext(quantity, **names)
        text = lazy_gettext(
            "{what} lies outside all that can be computed with, found {found}", what=quantity, found=_format_value(number, unit)
        )
        raise error(text)
    return number


def _format_value(number: float, unit: str) -> str:
    """Return a number with its unit."""
    return f"{number:.10g} {unit}".rstrip()
