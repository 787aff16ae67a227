"""Command-line options built from the fields of a dataclass of options."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import MISSING
from typing import Any, get_type_hints

from seisblock.cli.command import Decorator, add_options, option
from seisblock.cli.options import check_callback
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import LENGTH, MASS, MU
from seisblock.core import checks
from seisblock.core.options import GRAVITY, KEY, OptionField, option_fields
from seisblock.core.units import STANDARD_GRAVITY

CHECKS = {"(0, inf)": checks.positive}
"""Checks of a range before the command runs."""


def solver_options(kind: type, *names: str, exclude: Iterable[str] = ()) -> Decorator:
    """Return a decorator that adds an option for each field with a flag, or for the named ones.

    Parameters
    ----------
    kind : type
        Dataclass of options, see :mod:`seisblock.core.options`.
    names : str
        Fields in the order of the help; default: all.
    exclude : iterable of str
        Fields without an option.
    """
    table = {name: (spec, field.default) for name, spec, field in option_fields(kind) if spec.flag and name not in exclude}
    hints = get_type_hints(kind)
    return add_options(*(_declare(name, hints[name], *table[name]) for name in names or table))


def _declare(name: str, hint: Any, spec: OptionField, default: Any) -> Decorator:
    """Return the click option of one field; `default` is ``MISSING`` for a required one."""
    default = None if default is MISSING else default
    attributes: dict[str, Any] = {"help": spec.help, "section": spec.section}
    if "/" in spec.flag:
        return option(spec.flag, name, default=default, **attributes)
    if hint is bool:
        return option(spec.flag, name, is_flag=True, **attributes)
    if spec.interval in CHECKS:
        attributes["callback"] = check_callback(CHECKS[spec.interval])
    if spec.choices:
        attributes["type"] = SuggestingChoice(list(spec.choices))
    else:
        attributes |= {"type": _parameter_type(spec, hint), "metavar": spec.metavar}
    return option(spec.flag, name, default=default, show_default=default is not None and "[default" not in spec.help, **attributes)


def _parameter_type(spec: OptionField, hint: Any) -> Any:
    """Return the click type of the values of an option."""
    if spec.kind == "friction":
        return MU
    quantity = {"m": LENGTH, "kg": MASS}.get(spec.unit)
    return quantity or (hint if hint in (int, str) else float)


gravity_option = _declare("gravity", float, GRAVITY[KEY], STANDARD_GRAVITY)
"""Option ``--gravity`` of commands without a solver."""
