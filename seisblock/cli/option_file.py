"""``--options FILE``: options of a command from a TOML file."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import click

from seisblock.cli.suggest import closest_name, did_you_mean
from seisblock.core.errors import os_error_text
from seisblock.core.i18n import gettext

SHARED_NAMES = ("help", "help_all", "options", "lang")
"""Options that a file cannot hold."""


def read_option_file(path: Path, command: click.Command) -> dict[str, Any]:
    """Return the options of a file by parameter name, for click's ``default_map``.

    The file holds names of options with or without dashes, at its top or in a table of the command's name. Lists stand for repeated
    options, or for a list of values.

    Raises
    ------
    click.UsageError
        If the file cannot be read, or holds an unknown option.
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        reason = os_error_text(error) if isinstance(error, OSError) else str(error)
        raise click.UsageError(gettext("cannot read --options {file}: {error}", file=str(path), error=reason)) from None
    own = table.get(command.name or "")
    values = own if isinstance(own, dict) else table
    known = {
        name.lstrip("-"): parameter
        for parameter in command.params
        if isinstance(parameter, click.Option) and parameter.name not in SHARED_NAMES
        for name in (*parameter.opts, *parameter.secondary_opts)
    }
    options: dict[str, Any] = {}
    for key, value in values.items():
        name = key.replace("_", "-")
        if name not in known:
            text = gettext("{file}: {command} has no option {name}", file=str(path), command=command.name, name=f"--{name}")
            raise click.UsageError(did_you_mean(text, closest_name(name, known)))
        parameter = known[name]
        switch_off = f"--{name}" in parameter.secondary_opts
        options[parameter.name or name] = not value if switch_off else _value(parameter, value)
    return options


def _value(parameter: click.Option, value: Any) -> Any:
    """Return a value of TOML as click takes it."""
    if parameter.multiple:
        return [str(item) for item in value] if isinstance(value, list) else [str(value)]
    if isinstance(value, list):
        return ",".join(map(str, value))
    return value if isinstance(value, (bool, str)) else str(value)
