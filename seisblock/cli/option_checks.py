"""Rejection of options that have no effect in the chosen mode."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields

import click
from click.core import ParameterSource

from seisblock.cli.options import Source
from seisblock.core.i18n import gettext

RECORD_OPTIONS = tuple(field.name for field in fields(Source) if field.name != "record")
"""Names of all record options."""


def given_flags(names: Iterable[str]) -> list[str]:
    """Return the flags of those options, by parameter name, that the user gave."""
    context = click.get_current_context()
    flags = {parameter.name: parameter.opts[0] for parameter in context.command.params}
    return [flags[name] for name in names if name in flags and context.get_parameter_source(name) is not ParameterSource.DEFAULT]


def reject_with(condition: str, names: Iterable[str]) -> None:
    """Raise an error for options that have no effect with `condition`.

    Raises
    ------
    click.UsageError
        If one of the options was given, even with its default value.
    """
    if flags := given_flags(names):
        raise click.UsageError(gettext("{flags} has no effect with {what}: omit one of them", what=condition, flags=flags))


def reject_without(condition: str, names: Iterable[str]) -> None:
    """Raise an error for options that have no effect without `condition`.

    Raises
    ------
    click.UsageError
        If one of the options was given, even with its default value.
    """
    if flags := given_flags(names):
        raise click.UsageError(gettext("{flags} has no effect without {what}: omit it, or add {what}", what=condition, flags=flags))
