"""Validation of numbers and types, shared by solvers, bodies, criteria and the command line.

Every check takes the name of the quantity (a message template), then the value, and returns the value as a float or raises an
:class:`~seisblock.core.errors.InputError`. Messages are formatted only on failure, because bodies are built in inner loops.
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
"""Exception class raised by a check."""

MIN_MAGNITUDE, MAX_MAGNITUDE = 1e-100, 1e100
"""Bounds of the magnitude of a value: squares and cubes within them neither overflow nor underflow in float64."""

MAX_REPR_LENGTH = 200
"""Maximum length of the representation of an invalid value in a message."""

T = TypeVar("T")


def finite(quantity: str, value: Any, /, unit: str = "", *, error: ErrorClass = ParameterError, **names: Any) -> float:
    """Return a finite number.

    Parameters
    ----------
    quantity : str
        Name of the quantity at the start of the message: ``the slope``, or ``{name}: the slope``.
    value : any
        Value to check; booleans and texts are rejected.
    unit : str
        Unit printed after the value.
    error : class
        Exception class instead of :class:`ParameterError`.
    names : any
        Values of the fields of `quantity`.

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
    """Return a finite positive number; parameters as for :func:`finite`.

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
    """Return a finite nonzero number; parameters as for :func:`finite`.

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
    """Return a number inside an interval.

    Parameters
    ----------
    quantity, value, unit, error, names
        As for :func:`finite`.
    interval : str
        Ends of the interval, closed by ``[`` and ``]``, open by ``(`` and ``)``.

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
    """Return an acceleration of gravity, positive, m/s^2."""
    return positive("gravity", value, "m/s^2")


def azimuth(value: Any, /, *, error: ErrorClass = ParameterError) -> float:
    """Return an azimuth from -360 to 360 degrees; parameters as for :func:`finite`.

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
    """Return a value after checking its type.

    Examples
    --------
    >>> instance(None, dict)
    Traceback (most recent call last):
    seisblock.core.errors.KindError: expected dict, found None
    """
    if not isinstance(value, kind):
        raise KindError("expected {kind}, found {found}", kind=kind.__name__, found=type_name(value))
    return value


def type_name(value: Any) -> str:
    """Return the name of the type of a value for messages."""
    return "None" if value is None else type(value).__name__


def function(quantity: str, value: Any, /) -> Any:
    """Return a callable after checking it.

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
    """Return a path (str or PathLike) after checking its type.

    Examples
    --------
    >>> path(None)
    Traceback (most recent call last):
    seisblock.core.errors.KindError: expected a path or a name, found None
    """
    if not isinstance(value, (str, PathLike)):
        raise KindError("expected a path or a name, found {found}", found=type_name(value))
    return value


def float_array(quantity: str, values: Any, /) -> FloatArray:
    """Return a float64 array of any shape; finiteness and range are not checked.

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
    except ValueError:
        # rows of different lengths
        array = np.asarray(None)
    if array.dtype.kind not in "iuf":
        raise ParameterError("{what} must be numbers, found {found}", what=lazy_gettext(quantity), found=repr(values)[:MAX_REPR_LENGTH])
    # the values below a mask are no data
    if np.ma.is_masked(values):
        message = "{what}: {count} of {size} values are masked; fill the gaps, or cut the array before them"
        raise ParameterError(message, what=lazy_gettext(quantity), count=int(np.ma.getmaskarray(values).sum()), size=array.size)
    return np.asarray(array, dtype=np.float64)


def float_vector(quantity: str, values: Any, /) -> FloatArray:
    """Return a one-dimensional float64 array, (n,); finiteness and range are not checked.

    Examples
    --------
    >>> float_vector("the acceleration", [[1.0, 2.0]])
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: the acceleration must have shape (n,), found (1, 2): give one component
    """
    vector = float_array(quantity, values)
    if vector.ndim != 1:
        raise ParameterError(
            "{what} must have shape (n,), found {shape}: give one component",
            what=lazy_gettext(quantity),
            shape=str(vector.shape),
        )
    return vector


def integer(quantity: str, value: Any, /, *, minimum: int) -> int:
    """Return an integer not below a minimum.

    Examples
    --------
    >>> integer("the number of runs", 2.5, minimum=1)
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: the number of runs must be an integer of at least 1, found 2.5
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < minimum:
        text = repr(value)[:MAX_REPR_LENGTH]
        raise ParameterError(
            "{what} must be an integer of at least {least}, found {found}", what=lazy_gettext(quantity), least=minimum, found=text
        )
    return int(value)


def seed(value: Any) -> int:
    """Return a seed of a random number generator, a non-negative integer."""
    return integer("the seed", value, minimum=0)


def _to_float(quantity: str, value: Any, error: ErrorClass, names: dict[str, Any]) -> float:
    if isinstance(value, float):
        return value
    if isinstance(value, bool) or not isinstance(value, Real):
        raise error("{what} must be a number, found {value}", what=lazy_gettext(quantity, **names), value=repr(value)[:MAX_REPR_LENGTH])
    try:
        return float(value)
    except OverflowError:
        # an integer of more than 308 digits
        return math.inf if value > 0 else -math.inf  # type: ignore[operator]


def _check_magnitude(quantity: str, number: float, unit: str, error: ErrorClass, names: dict[str, Any], *, minimum: float = 0.0) -> float:
    """Return a number whose square and cube are representable."""
    if abs(number) > MAX_MAGNITUDE or 0.0 < abs(number) < minimum:
        quantity = lazy_gettext(quantity, **names)
        text = lazy_gettext(
            "{what} is outside the computable range (1e-100 to 1e100), found {found}", what=quantity, found=_format_value(number, unit)
        )
        raise error(text)
    return number


def _format_value(number: float, unit: str) -> str:
    return f"{number:.10g} {unit}".rstrip()
