"""Options of solvers and bodies, declared once: a dataclass field with unit, range, help and command-line flag in its metadata.

Command-line options, documents and their schemas, columns of tables of bodies, reference tables and docstrings derive from these fields.
"""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Callable
from dataclasses import MISSING, Field, dataclass, fields
from typing import Any, Concatenate, ParamSpec, TypeVar

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import N_
from seisblock.core.units import unit_suffix

KEY = "option"
"""Key of the description in the metadata of a field."""


@dataclass(frozen=True)
class OptionField:
    """Description of one option.

    Parameters
    ----------
    help : str
        One or two sentences, translatable; for the command line, the schema and the docstring.
    flag : str
        Command-line option, or ``--yes/--no`` for a switch; empty for an option of the library only.
    unit : str
        SI unit, ``1`` for a dimensionless quantity, empty for anything but a number.
    interval : str
        Range, for example ``[0, 1)``; empty if unlimited or checked elsewhere.
    label : str
        Name of the quantity in messages; default: the name of the field.
    kind : str
        Syntax on the command line where unit and type do not tell it: ``friction`` (a number or per cent).
    choices : tuple of str
        Permitted values of a text.
    metavar : str
        Placeholder of the value in the help.
    section : str
        Section of the help.
    key : str
        Key in documents; default: the name of the field with its unit.
    document : callable or None
        Type, and conversion, of the value in documents where it differs from the field.
    """

    help: str
    flag: str = ""
    unit: str = ""
    interval: str = ""
    label: str = ""
    kind: str = ""
    choices: tuple[str, ...] = ()
    metavar: str | None = None
    section: str = "Solver"
    key: str = ""
    document: Any = None


def option(help: str, flag: str = "", **attributes: Any) -> dict[str, OptionField]:  # noqa: A002
    """Return the metadata of a field that holds an option, see :class:`OptionField`.

    Examples
    --------
    >>> from dataclasses import dataclass, field
    >>> @dataclass(frozen=True)
    ... class Sizes:
    ...     width: float = field(metadata=option("Width.", "--width", unit="m", interval="(0, inf)"))
    >>> [(spec.flag, document_key(name, spec)) for name, spec, _ in option_fields(Sizes)]
    [('--width', 'width_m')]
    """
    return {KEY: OptionField(help, flag, **attributes)}


def friction(help: str) -> dict[str, OptionField]:  # noqa: A002
    """Return the metadata of the friction coefficient between an object and its base."""
    label = N_("the friction coefficient mu")
    return option(help, "--mu", unit="1", interval="[0, inf)", label=label, kind="friction", metavar="MU", section="Body")


VERTICAL = option(
    N_("Apply or omit the vertical component. [default: applied where the record has one]"),
    "--vertical/--no-vertical",
    document=bool,
)
"""Metadata of the vertical ground motion: a switch or a factor; None applies it where the record has a vertical component."""

ACROSS = option(N_("Apply or omit the other horizontal component."), "--across/--no-across", document=bool)
"""Metadata of the horizontal ground motion along y: a switch or a factor."""

GRAVITY = option(N_("Acceleration of gravity, m/s^2."), "--gravity", unit="m/s^2", interval="(0, inf)", label=N_("gravity"), metavar="M/S2")
"""Metadata of the acceleration of gravity."""


@dataclass(frozen=True, kw_only=True, repr=False)
class SolverOptions(DisplayMixin):
    """Base of the options of a solver: values are checked against their ranges."""

    def __post_init__(self) -> None:
        for name, spec, _ in option_fields(type(self)):
            check_option(name, spec, getattr(self, name))

    def keywords(self) -> dict[str, Any]:
        """Return the options as keyword arguments of the solver."""
        return {field.name: getattr(self, field.name) for field in fields(self)}


def check_option(name: str, spec: OptionField, value: Any) -> None:
    """Raise ParameterError for a value outside the range of its option; None is not checked."""
    if value is None or not spec.interval:
        return
    label = spec.label or f"`{name}`"
    unit = "" if spec.unit == "1" else spec.unit
    if spec.interval == "(0, inf)":
        checks.positive(label, value, unit)
    elif spec.interval == "[0, inf)":
        checks.non_negative(label, value, unit)
    else:
        checks.in_interval(label, value, spec.interval, unit)


def option_fields(kind: type) -> list[tuple[str, OptionField, Field[Any]]]:
    """Return name, description and field of each option of a dataclass, in their order."""
    return [(field.name, field.metadata[KEY], field) for field in fields(kind) if KEY in field.metadata]


def document_key(name: str, spec: OptionField) -> str:
    """Return the key of an option in documents: its name with its unit."""
    if spec.key:
        return spec.key
    suffix = unit_suffix(spec.unit).lower()
    return name if name.endswith(suffix) else name + suffix


def plain_help(text: str) -> str:
    """Return a help text, or its translation, without its default."""
    return re.sub(r"\s*(\[(default|required)[^\]]*\]|［(既定|必須)[^］]*］)$", "", text)


Kind = TypeVar("Kind")


def documented(kind: type[Kind]) -> type[Kind]:
    """Add the Parameters section of a dataclass of options to its docstring."""
    lines = ["", "", "Parameters", "----------"]
    for name, spec, field in option_fields(kind):
        unit = f", {spec.unit}" if spec.unit else ""
        default = "" if field.default is MISSING or field.default is None else f" Default: {field.default!r}."
        lines += [f"{name} : {field.type}{unit}", f"    {plain_help(spec.help)}{default}"]
    kind.__doc__ = inspect.cleandoc(kind.__doc__ or "") + "\n".join(lines) + "\n"
    return kind


P = ParamSpec("P")
Body = TypeVar("Body")
Motion = TypeVar("Motion")
Options = TypeVar("Options")
Result = TypeVar("Result")


def keywords_of(
    make: Callable[P, Options],
) -> Callable[[Callable[[Body, Motion, Options], Result]], Callable[Concatenate[Body, Motion, P], Result]]:
    """Return a decorator that gives a solver the fields of its options as keyword arguments.

    The decorated function takes body, motion and one object of options; the result takes body, motion and keyword arguments, typed like
    the fields. ``__wrapped__`` is the function itself.

    Parameters
    ----------
    make : type
        Dataclass of the options.

    Examples
    --------
    >>> from dataclasses import dataclass, field
    >>> @dataclass(frozen=True, kw_only=True)
    ... class Fall:
    ...     gravity: float = field(default=9.8, metadata=GRAVITY)
    >>> @keywords_of(Fall)
    ... def speed(height, motion, options):
    ...     return (2 * options.gravity * height) ** 0.5
    >>> round(speed(10.0, None), 1), speed(10.0, None, gravity=5.0)
    (14.0, 10.0)
    """

    def decorate(solve: Callable[[Body, Motion, Options], Result]) -> Callable[Concatenate[Body, Motion, P], Result]:
        signature = inspect.signature(solve)
        first = list(signature.parameters.values())[:2]

        @functools.wraps(solve)
        def solve_with_keywords(*args: Any, **kwargs: Any) -> Result:
            inputs = [*args, *(kwargs.pop(parameter.name) for parameter in first[len(args) :] if parameter.name in kwargs)]
            if len(inputs) != len(first):
                raise TypeError(f"{solve.__name__}() takes {', '.join(parameter.name for parameter in first)} and keyword arguments")
            try:
                options = make(**kwargs)  # type: ignore[call-arg]
            except TypeError as error:  # a missing or unknown keyword is one of the function
                raise TypeError(str(error).replace(f"{make.__name__}.__init__", solve.__name__)) from error
            return solve(*inputs, options)  # type: ignore[call-arg, arg-type]

        parameters = [*first, *inspect.signature(make).parameters.values()]
        solve_with_keywords.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
        return solve_with_keywords

    return decorate
