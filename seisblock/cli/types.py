"""Click parameter types: lengths with units, lists, ranges, time windows."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Generic, TypeVar

import click
from click.shell_completion import CompletionItem

from seisblock.bodies.edge_wear import parse_edge_wear
from seisblock.cli.command import Finite
from seisblock.cli.suggest import SuggestingChoice
from seisblock.core.errors import InputError
from seisblock.core.format_names import format_names
from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.core.jma_scale import parse_jma_intensity
from seisblock.core.limits import MAX_JOINT_POINTS, MAX_VALUES, check_limit
from seisblock.core.units import (
    ACCELERATION_UNITS,
    GAL,
    KINE,
    LENGTH_UNITS,
    VELOCITY_UNITS,
    FigureSize,
    parse_length,
    parse_mass,
    parse_quantity,
    to_halfwidth,
)
from seisblock.records.floor import parse_storey

MIN_SIDE, MAX_SIDE = 0.04, 1.2
"""Smallest and largest side of a figure, m."""

SIZES = (N_("width"), N_("height"), N_("depth"))
"""Parameters named in errors of their lengths; other options are named by click alone."""


Parameter = TypeVar("Parameter")


class Count(click.ParamType):  # type: ignore[type-arg]
    """Integer parameter with an upper limit from :mod:`seisblock.core.limits`.

    Parameters
    ----------
    quantity : str
        Noun of the message, see :func:`seisblock.core.limits.check_limit`.
    limit : int
    minimum : int
    power : int
        Power of the number that is limited: 2 for points on two axes.
    """

    name = "integer"

    def __init__(self, quantity: str, limit: int, *, minimum: int = 1, power: int = 1) -> None:
        self.quantity, self.limit, self.minimum, self.power = quantity, limit, minimum, power

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number."""
        kind = click.IntRange(min=self.minimum)
        kind.name = self.name
        count: int = kind.convert(value, param, ctx)
        try:
            check_limit(self.quantity, count**self.power, self.limit)
        except InputError as error:
            self.fail(gettext(error.message), param, ctx)
        return count


class FormatType(click.types.StringParamType):
    """Format of a record; help and completion list the names."""

    names = tuple("OBSPY:NAME" if name == "OBSPY" else name for name in format_names())

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Complete the name of a format."""
        return [CompletionItem(name) for name in self.names if name.startswith(incomplete.upper())]


class OutputFile(click.Path):
    """File to write, checked before the command runs.

    Parameters
    ----------
    form : str
        Text format, see :func:`seisblock.output.io.suffix.check_text_suffix`; empty where the command checks the suffix.
    """

    def __init__(self, form: str = "") -> None:
        super().__init__(path_type=Path)
        self.form = form

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Path:
        """Return the path of a file that can be written."""
        from seisblock.output.io.atomic import check_target
        from seisblock.output.io.suffix import check_text_suffix

        path = Path(super().convert(value, param, ctx))  # type: ignore[arg-type]
        if self.form:
            check_text_suffix(path, self.form)
        check_target(path)
        return path


class Parsed(click.ParamType, Generic[Parameter]):  # type: ignore[type-arg]
    """Parameter of a parser of the library, whose error becomes that of the option.

    Parameters
    ----------
    name : str
    parse : callable
        ``parse(text, parameter name) -> value``.
    """

    def __init__(self, name: str, parse: Callable[[str, str], Parameter]) -> None:
        self.name, self._parse = name, parse

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Parameter:
        """Return the value of a text; a default, or what is already converted, as it is."""
        if not isinstance(value, str):
            return value  # type: ignore[no-any-return]
        try:
            return self._parse(value, (param and param.name) or "")
        except InputError as error:
            self.fail(gettext(error.message), param, ctx)


class ContactType(click.ParamType):  # type: ignore[type-arg]
    """Contact points of a joint: ``edges``, or ``grid=N`` for N x N points."""

    name = "contact"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number of points along each side of a joint; 2 for its edges."""
        if isinstance(value, int) or value == "edges":
            return 2 if value == "edges" else value
        name, _, count = str(value).partition("=")
        if name != "grid":
            self.fail(gettext("{value!r} is neither edges nor grid=N, for example grid=5", value=value), param, ctx)
        return Count(N_("contact points along each side of a joint"), MAX_JOINT_POINTS, minimum=3).convert(count, param, ctx)


class ShareType(Finite):
    """Number or percentage: ``0.2``, ``20%``."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number."""
        text = to_halfwidth(value).strip() if isinstance(value, str) else ""
        if not text.endswith("%"):
            return super().convert(value, param, ctx)
        return round(super().convert(text[:-1], param, ctx) / 100.0, 15)


class FloatWithUnit(Finite):
    """Number in a default unit, or with its unit: ``400``, ``400gal``, ``0.4g``.

    Parameters
    ----------
    units : mapping of str to float
        Values of the admissible units in SI.
    default : float
        Value of the default unit.
    """

    def __init__(self, units: Mapping[str, float], default: float) -> None:
        self._units, self._default = units, default

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number in the default unit."""
        try:
            number, has_unit = parse_quantity(value.lower() if isinstance(value, str) else value, self._units, quantity=self.name)
        except InputError:
            has_unit = False
        return round(number / self._default, 12) if has_unit else super().convert(value, param, ctx)


class Floats(click.ParamType):  # type: ignore[type-arg]
    """One number, a list ``a,b,c``, or a range ``first:last:step`` that includes its last value."""

    name = "number|list|range"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, ...]:
        """Return the values, in the order given."""
        if isinstance(value, tuple):
            return value
        if isinstance(value, (int, float)):
            return (float(value),)
        try:
            return tuple(x for part in value.split(",") for x in self._range(part, param, ctx))
        except ValueError:
            self.fail(gettext("{value!r} is not a number, a list a,b,c or a range first:last:step", value=value), param, ctx)

    def _range(self, text: str, param: click.Parameter | None, ctx: click.Context | None) -> list[float]:
        """Return the values of one part of the list."""
        pieces = [self._number(piece, param, ctx) for piece in text.split(":")]
        if len(pieces) == 1:
            return pieces
        if len(pieces) != 3:
            raise ValueError(text)
        first, last, step = pieces
        if step == 0 or (last - first) * step < 0:
            self.fail(gettext("{text!r}: the step does not lead from the first value to the last", text=text), param, ctx)
        count = math.floor(min((last - first) / step, 1e18) + 1e-9) + 1
        try:
            check_limit(N_("values"), count, MAX_VALUES, source=repr(text))
        except InputError as error:
            self.fail(gettext(error.message), param, ctx)
        return [round(first + i * step, 12) for i in range(count)]

    def _number(self, text: str, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return one finite number."""
        value = float(text)
        if not math.isfinite(value):
            raise ValueError(text)
        return value


class Shares(Floats):
    """Numbers or percentages, ``0.2`` or ``20%``, as :class:`Floats`."""

    def _number(self, text: str, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return one share."""
        if to_halfwidth(text).strip().endswith("%"):
            return MU.convert(text, param, ctx)
        return super()._number(text, param, ctx)


class Quantities(Floats):
    """Numbers with units as :class:`Floats`; the type of one value words its errors."""

    def __init__(self, item: Parsed[float] | FloatWithUnit) -> None:
        self.item = item

    def _number(self, text: str, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return one value in SI."""
        return self.item.convert(text, param, ctx)


class SizeType(click.ParamType):  # type: ignore[type-arg]
    """Width and height of a figure, ``18x12``: cm, or with units (``7inx5in``, ``180x120mm``)."""

    name = "size"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> FigureSize:
        """Return width and height, m, and the unit of the first."""
        if isinstance(value, FigureSize):
            return value
        sides = to_halfwidth(value).lower().replace("×", "x").split("x")
        if len(sides) != 2:
            self.fail(gettext("{value!r} is not a width and a height, for example 18x12 (cm)", value=value), param, ctx)
        # a side without unit has that of the other: 85x120mm
        units = [side.strip().lstrip("0123456789.+-e ") for side in sides]
        unit = next(filter(None, units), "cm")
        try:
            width, height = (
                parse_length(side if own_unit else f"{side}{unit}", quantity="size") for side, own_unit in zip(sides, units, strict=True)
            )
        except InputError as error:
            self.fail(str(error), param, ctx)
        for side in (width, height):
            if not MIN_SIDE <= side <= MAX_SIDE:
                lower, upper = (f"{limit_m / LENGTH_UNITS[unit]:.4g} {unit}" for limit_m in (MIN_SIDE, MAX_SIDE))
                text = gettext(
                    "{value!r}: width and height of a figure must lie between {least} and {most}", value=value, least=lower, most=upper
                )
                self.fail(text, param, ctx)
        return FigureSize(width, height, unit)


class WindowType(click.ParamType):  # type: ignore[type-arg]
    """Time window ``T0:T1``, s from the record's first sample; either end may be omitted."""

    name = "t0:t1"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float | None, float | None]:
        """Return both ends, s; None where omitted."""
        if isinstance(value, tuple):
            return value
        try:
            first, last = (float(piece) if piece.strip() else None for piece in value.split(":"))
        except ValueError:
            self.fail(gettext("{value!r} is not a time window T0:T1 in seconds, for example 20:35", value=value), param, ctx)
        if any(end is not None and not math.isfinite(end) for end in (first, last)):
            self.fail(gettext("{value!r}: both ends must be finite", value=value), param, ctx)
        if first is not None and last is not None and last <= first:
            self.fail(gettext("{value!r}: the end of the window must be later than its start", value=value), param, ctx)
        return first, last


class Sides(click.ParamType):  # type: ignore[type-arg]
    """One side of a body in plan, ``short`` or ``long``, or both as a list."""

    name = "text"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, ...]:
        """Return the sides without duplicates, in the order given."""
        if isinstance(value, tuple):
            return value
        choice = SuggestingChoice(["short", "long"])
        return tuple(dict.fromkeys(choice.convert(part.strip(), param, ctx) for part in value.split(",")))

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Complete the name of a side."""
        return [CompletionItem(name) for name in ("short", "long") if name.startswith(incomplete)]


LENGTH = Parsed("length", lambda text, name: parse_length(text, quantity=lazy_gettext(name if name in SIZES else "length")))
"""A length: metres, or a number with a unit (``24cm``, ``8sun``)."""

MASS = Parsed("mass", lambda text, _: parse_mass(text))
"""A mass: kilograms, or a number with a unit (``1.3t``)."""

INSET = Parsed("inset", lambda text, _: parse_edge_wear(text))
"""Inset of worn edges per side: a share of the width (``0.1``, ``10%``), or a length with unit (``1cm``)."""

STOREY = Parsed("storey", lambda text, _: parse_storey(text))
"""Storey ``T=0.6,zeta=0.05,height=0.8``: period, s, damping ratio and height ratio; only T is required."""

JMA = Parsed("intensity", lambda text, _: parse_jma_intensity(text))
"""JMA intensity: ``6+``, ``5弱`` or a number."""

PEAK_UNITS = {
    "GAL": FloatWithUnit(ACCELERATION_UNITS, GAL),
    "KINE": FloatWithUnit(VELOCITY_UNITS, KINE),
    "HZ": FloatWithUnit({"hz": 1.0}, 1.0),
}
"""Types of PGA, PGV and frequency by the default unit in the help."""

ANGLE = FloatWithUnit({"deg": 1.0, "°": 1.0, "度": 1.0}, 1.0)
"""An angle: degrees, or a number with that unit."""

ANGLES = Quantities(ANGLE)

FLOATS = Floats()
LENGTHS = Quantities(LENGTH)
MU = ShareType()
MUS = Shares()
MASSES = Quantities(MASS)
WINDOW = WindowType()
SIZE = SizeType()
SIDES = Sides()
