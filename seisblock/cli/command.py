"""How a command presents its options: in groups, with two lines to paste at the end."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import click

SECTIONS = ("Record", "Body", "Solver", "Output")
"""Headings of ``--help``, in this order; an option names the one it belongs to."""


class Option(click.Option):
    """A click option that knows its section of the help."""

    def __init__(self, *args: Any, section: str = "Solver", **kwargs: Any) -> None:
        self.section = section
        super().__init__(*args, **kwargs)


class Command(click.Command):
    """A command whose help groups its options and ends with examples.

    Parameters
    ----------
    examples : sequence of str
        Lines a user can paste.
    """

    def __init__(self, *args: Any, examples: Sequence[str] = (), **kwargs: Any) -> None:
        self.examples = tuple(examples)
        super().__init__(*args, **kwargs)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options section by section."""
        groups: dict[str, list[tuple[str, str]]] = {name: [] for name in (*SECTIONS, "Other")}
        for parameter in self.get_params(ctx):
            row = parameter.get_help_record(ctx)
            if row is not None:
                groups[getattr(parameter, "section", "Other")].append(row)
        for name, rows in groups.items():
            if rows:
                with formatter.section(f"{name} options"):
                    formatter.write_dl(rows)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the examples."""
        if self.examples:
            with formatter.section("Examples"):
                for line in self.examples:
                    formatter.write(f"  {line}\n")


def option(*declarations: str, section: str = "Solver", **attributes: Any) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Declare an option in a section of the help; otherwise :func:`click.option`."""
    return click.option(*declarations, cls=Option, section=section, **attributes)
