"""Click classes of commands, options and arguments with help sections and examples."""

from __future__ import annotations

import ast
import functools
import inspect
import json
import math
import textwrap
import tomllib
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import click

from seisblock.cli.help import Context, help_rows
from seisblock.cli.suggest import SuggestingChoice, closest_name, did_you_mean, suggest_options
from seisblock.core import checks
from seisblock.core.errors import ParameterError, os_error_text
from seisblock.core.i18n import LANGUAGES, N_, gettext

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
    section = table.get(command.name or "")
    values = section if isinstance(section, dict) else table
    parameters = {
        name.lstrip("-"): parameter
        for parameter in command.params
        if isinstance(parameter, click.Option) and parameter.name not in SHARED_NAMES
        for name in (*parameter.opts, *parameter.secondary_opts)
    }
    options: dict[str, Any] = {}
    for key, value in values.items():
        name = key.replace("_", "-")
        if name not in parameters:
            text = gettext("{file}: {command} has no option {name}", file=str(path), command=command.name, name=f"--{name}")
            raise click.UsageError(did_you_mean(text, closest_name(name, parameters)))
        parameter = parameters[name]
        if isinstance(value, bool) != parameter.is_flag:
            text = N_("{file}: --{name} requires a value, found {value}")
            if parameter.is_flag:
                text = N_("{file}: --{name} requires true or false, found {value}")
            raise click.UsageError(gettext(text, file=str(path), name=name, value=json.dumps(value, ensure_ascii=False, default=str)))
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


SECTIONS = (
    N_("Arguments"),
    N_("Record options"),
    N_("Site options"),
    N_("Body options"),
    N_("Solver options"),
    N_("Output options"),
)
"""Headings of ``--help`` in their order; each option names its section, without ``options``."""


SHARED_ESSENTIAL = frozenset(("--component", "--json", "--csv", "--plot", "--animate", "--details", "--help", "--help-all"))
"""Shared options of the short help."""

HELP_ALL = "seisblock.help_all"
"""Key in the context's meta for ``--help-all``."""


Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]
"""Decorator of the function of a command."""


class Finite(click.types.FloatParamType):
    """Float parameter that accepts only finite numbers."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the finite number of a text."""
        number: float = super().convert(value, param, ctx)
        if math.isfinite(number):
            return number
        try:
            return checks.finite(N_("the value"), number)
        except ParameterError as error:
            self.fail(gettext(error.message), param, ctx)


class Option(click.Option):
    """Click option with a help section."""

    def __init__(self, *args: Any, section: str = "Solver", **kwargs: Any) -> None:
        self.section = section
        if kwargs.get("type") is float:
            kwargs["type"] = Finite()
        super().__init__(*args, **kwargs)
        # "integer range" reads as if a range were to be given
        self.type.name = self.type.name.removesuffix(" range")


class Argument(click.Argument):
    """Click argument with a help section and a help text."""

    def __init__(self, *args: Any, section: str = "Arguments", **kwargs: Any) -> None:
        help_text = kwargs.pop("help")
        super().__init__(*args, **kwargs)
        self.section, self.help = section, help_text

    def get_help_record(self, ctx: click.Context) -> tuple[str, str]:
        """Return the row of the argument in the help."""
        return self.make_metavar(ctx), self.help or ""


option = functools.partial(click.option, cls=Option)
"""Declare an option in a section of the help, see :func:`click.option`."""

argument = functools.partial(click.argument, cls=Argument)
"""Declare an argument with a help text, see :func:`click.argument`."""


def docstring(target: ModuleType | Callable[..., Any]) -> str | None:
    """Return the docstring of a module or function, from its source where ``python -OO`` has removed it."""
    if target.__doc__ is not None:
        return target.__doc__
    tree = ast.parse(textwrap.dedent(inspect.getsource(target if isinstance(target, ModuleType) else inspect.unwrap(target))))
    node = tree if isinstance(target, ModuleType) else tree.body[0]
    return ast.get_docstring(node) if isinstance(node, ast.Module | ast.FunctionDef) else None


def section_heading(parameter: click.Parameter) -> str:
    """Return the heading of ``--help`` under which a parameter stands; click's own ``--help`` stands beside ``--help-all``."""
    section: str = getattr(parameter, "section", "Output")
    return section if section in SECTIONS else f"{section} options"


class Command(click.Command):
    """Command with options grouped into sections and examples at the end of the help.

    Parameters
    ----------
    examples : sequence of str
        Example command lines.
    essential : sequence of str
        Options of ``--help``, beside the shared ones; ``--help-all`` shows all. Default: all.
    """

    context_class = Context

    def __init__(self, *args: Any, examples: Sequence[str] = (), essential: Sequence[str] = (), **kwargs: Any) -> None:
        self.examples, self.essential = tuple(examples), frozenset(essential)
        super().__init__(*args, **kwargs)
        if self.help is None and self.callback is not None:
            self.help = docstring(self.callback)
        self.params.append(lang_option())
        if essential:
            self.params += [_option_file_option(), _help_all_option()]

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the arguments; check repeated options and suggest names for unknown ones."""
        with suggest_options(self, ctx):
            if not ctx.resilient_parsing:
                self._check_repeated(ctx, args)
            return super().parse_args(ctx, args)

    def _check_repeated(self, ctx: click.Context, args: list[str]) -> None:
        """Raise an error for a single-value option given twice; click would use only the last value."""
        _, _, order = self.make_parser(ctx).parse_args(list(args))
        counts = Counter(order)
        if self.get_help_option(ctx) in counts:
            return
        for option_given, count in counts.items():
            if (
                count > 1
                and isinstance(option_given, click.Option)
                and not (option_given.multiple or option_given.is_flag or option_given.count)
            ):
                text = gettext("{option} may be given only once, found {count} times", option=max(option_given.opts, key=len), count=count)
                raise click.UsageError(text, ctx)

    def get_help_option(self, ctx: click.Context) -> click.Option | None:
        """Return ``--help`` with its untranslated description: click caches the option across locales."""
        return english_help_option(super().get_help_option(ctx))

    def format_arguments(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write nothing: arguments appear in their sections."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options section by section."""
        groups: dict[str, list[tuple[str, str]]] = {name: [] for name in SECTIONS}
        parameters = self.get_params(ctx)
        if self.essential and HELP_ALL not in ctx.meta:
            parameters = [parameter for parameter in parameters if self._is_essential(parameter)]
        for parameter, row in help_rows(parameters, ctx):
            groups[section_heading(parameter)].append(row)
        for name, rows in groups.items():
            if rows:
                with formatter.section(gettext(name)):
                    formatter.write_dl(rows)

    def _is_essential(self, parameter: click.Parameter) -> bool:
        """Return whether a parameter belongs to the short help."""
        return isinstance(parameter, click.Argument) or not (self.essential | SHARED_ESSENTIAL).isdisjoint(parameter.opts)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the examples."""
        if self.examples:
            with formatter.section(gettext("Examples")):
                for line in self.examples:
                    formatter.write(f"  {line}\n")


def _help_all_option() -> click.Option:
    """Return ``--help-all``, which shows the help with all options."""

    def show(ctx: click.Context, param: click.Parameter, value: bool) -> None:
        del param
        if value and not ctx.resilient_parsing:
            ctx.meta[HELP_ALL] = True
            click.echo(ctx.get_help(), color=ctx.color)
            ctx.exit()

    text = N_("Show all options and exit.")
    return Option(["--help-all"], is_flag=True, is_eager=True, expose_value=False, callback=show, section="Output", help=text)


def _option_file_option() -> click.Option:
    """Return ``--options``, which takes options from a TOML file; those of the line take precedence."""

    def load(ctx: click.Context, param: click.Parameter, value: Path | None) -> None:
        del param
        if value is not None and not ctx.resilient_parsing:
            ctx.default_map = {**read_option_file(value, ctx.command), **(ctx.default_map or {})}

    text = N_("TOML file of options, such as mu = 0.3; options on the command line take precedence.")
    path = click.Path(path_type=Path, dir_okay=False)
    return Option(["--options"], type=path, is_eager=True, expose_value=False, callback=load, section="Output", metavar="FILE", help=text)


def lang_option() -> click.Option:
    """Return ``--lang``; ``cli.locale`` evaluates it before the line is parsed."""
    text = "Language of messages, tables and figures. [default: of the locale, else en]"
    return Option(["--lang"], type=SuggestingChoice(LANGUAGES), expose_value=False, section="Output", help=text)


def english_help_option(option: click.Option | None) -> click.Option | None:
    """Return ``--help`` with its untranslated description."""
    if option is not None:
        option.help = N_("Show this message and exit.")
    return option


def add_options(*declarations: Decorator) -> Decorator:
    """Return a decorator that adds options and arguments to a command in their order."""

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        for declare in reversed(declarations):
            function = declare(function)
        return function

    return decorate
