"""How help is laid out: told in the language spoken, and wrapped by what letters are wide on a terminal."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

import click

from seisblock.words import tell

_WIDE = r"\u1100-\u115f\u2e80-\ua4cf\uac00-\ud7a3\uf900-\ufaff\ufe30-\ufe6f\uff00-\uff60\uffe0-\uffe6"
"""Letters that take two columns."""

_ATOM = re.compile(rf"\s*[（「『]*(?:[^\s{_WIDE}]+|[{_WIDE}])[、。，．）」』：；！？ー・々ぁぃぅぇぉゃゅょっァィゥェォャュョッ]*")
"""What is not broken: a word, or a wide letter with the marks that may not begin a line."""

_MARKS = re.compile(rf"[{_WIDE}]")


def columns(text: str) -> int:
    """Return how many columns of a terminal a text takes."""
    return len(text) + len(_MARKS.findall(text))


def wrapped(text: str, width: int) -> list[str]:
    """Return a text in lines of at most so many columns, broken between words and between wide letters.

    Parameters
    ----------
    text : str
    width : int
    """
    lines = [""]
    for atom in _ATOM.findall(text):
        joined = lines[-1] + (atom if lines[-1] else atom.lstrip())
        if columns(joined) <= width or not lines[-1]:
            lines[-1] = joined
        else:
            lines.append(atom.lstrip())
    return lines


def paragraphs(text: str) -> list[str]:
    """Return the paragraphs of a docstring, each as one line."""
    return [" ".join(part.split()) for part in text.split("\n\n") if part.strip()]


class Formatter(click.HelpFormatter):
    """Writes help; a text with wide letters is wrapped by columns, any other as click does."""

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        """Write the line that says how a command is called."""
        super().write_usage(prog, args, f"{tell('Usage:')} ")

    def write_text(self, text: str) -> None:
        """Write paragraphs, told."""
        indent = " " * self.current_indent
        for index, part in enumerate(map(tell, paragraphs(text))):
            if index:
                self.write("\n")
            if _MARKS.search(part):
                self.write("".join(f"{indent}{line}\n" for line in wrapped(part, self.width - self.current_indent)))
            else:
                super().write_text(part)

    def write_dl(self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2) -> None:
        """Write terms and what they mean."""
        listed = list(rows)
        if not any(_MARKS.search(meaning) for _, meaning in listed):
            super().write_dl(listed, col_max, col_spacing)
            return
        first = min(max(len(term) for term, _ in listed), col_max) + col_spacing
        indent = " " * self.current_indent
        for term, meaning in listed:
            lines = iter(wrapped(meaning, max(self.width - first - 2, 10)))
            self.write(f"{indent}{term:{first}}{next(lines)}\n" if len(term) <= first - col_spacing else f"{indent}{term}\n")
            self.write("".join(f"{indent}{'':{first}}{line}\n" for line in lines))


class Context(click.Context):
    """A context whose help is laid out here."""

    formatter_class = Formatter


def rows_of(parameters: Iterable[click.Parameter], ctx: click.Context) -> Iterator[tuple[click.Parameter, tuple[str, str]]]:
    """Yield each parameter with its line of help, told."""
    for parameter in parameters:
        row = parameter.get_help_record(ctx)
        if row is not None:
            text = getattr(parameter, "help", None) or ""
            yield parameter, (row[0], row[1].replace(text, tell(text), 1))
