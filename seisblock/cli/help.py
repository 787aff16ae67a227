"""Help formatter: translated texts, wrapped by display width."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

import click

from seisblock.core.i18n import gettext
from seisblock.output.text.wrap import is_wide, wrap_text

CLICK_SUFFIX = re.compile(r"  \[([^\[\]]*)\]\Z")
"""Default appended by click to a help text; full-width brackets replace it in Japanese."""


def paragraphs(text: str) -> list[str]:
    """Return the paragraphs of a docstring, each as one line."""
    return [" ".join(part.split()) for part in text.split("\n\n") if part.strip()]


class Formatter(click.HelpFormatter):
    """Help formatter that wraps texts with wide characters by display columns, others as click does."""

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        """Write the usage line."""
        super().write_usage(prog, args, f"{gettext('Usage:')} ")

    def write_text(self, text: str) -> None:
        """Write translated paragraphs."""
        indent = " " * self.current_indent
        for index, part in enumerate(map(gettext, paragraphs(text))):
            if index:
                self.write("\n")
            if is_wide(part):
                self.write("".join(f"{indent}{line}\n" for line in wrap_text(part, self.width - self.current_indent)))
            else:
                super().write_text(part)

    def write_dl(self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2) -> None:
        """Write a definition list."""
        entries = list(rows)
        if not any(is_wide(meaning) for _, meaning in entries):
            super().write_dl(entries, col_max, col_spacing)
            return
        first = min(max(len(term) for term, _ in entries), col_max) + col_spacing
        indent = " " * self.current_indent
        for term, meaning in entries:
            lines = iter(wrap_text(meaning, max(self.width - first - 2, 10)))
            self.write(f"{indent}{term:{first}}{next(lines)}\n" if len(term) <= first - col_spacing else f"{indent}{term}\n")
            self.write("".join(f"{indent}{'':{first}}{line}\n" for line in lines))


class Context(click.Context):
    """Click context with the formatter of this module."""

    formatter_class = Formatter


def help_rows(parameters: Iterable[click.Parameter], ctx: click.Context) -> Iterator[tuple[click.Parameter, tuple[str, str]]]:
    """Yield each parameter with its translated row of the help."""
    for parameter in parameters:
        row = parameter.get_help_record(ctx)
        if row is not None:
            text = getattr(parameter, "help", None) or ""
            names = getattr(parameter.type, "names", ())
            meaning = row[1].replace(text, gettext(text) + (f" {', '.join(names)}" if names else ""), 1)
            yield parameter, (row[0], CLICK_SUFFIX.sub(r"［\1］", meaning) if is_wide(meaning) else meaning)
