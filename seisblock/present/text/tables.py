"""Tables for people: one console, one style, units in the heading."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, TypeVar

from rich.box import SIMPLE_HEAD
from rich.console import Console, ConsoleOptions, Group, RenderResult
from rich.containers import Lines
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from seisblock.present.scales import acceleration_unit
from seisblock.present.text.whereabouts import whereabouts
from seisblock.present.wrap import breaks, fits, has_units, is_wide
from seisblock.records import Record
from seisblock.records.site import site_of, told_time
from seisblock.words import plain_text, tell

Item = TypeVar("Item")

NOTHING = "-"
"""What stands where there is no number."""

UNBOUND = 10_000
"""Columns of a terminal that is wide enough for anything."""


def console(*, stderr: bool = False) -> Console:
    """Return a console on the present stdout or stderr; colours obey NO_COLOR and pipes."""
    return _Screen(stderr=stderr, highlight=False, markup=False, emoji=False, soft_wrap=False)


class _Screen(Console):
    """A console that lets the command line decide what to do when its reader has gone."""

    def print(self, *objects: Any, **options: Any) -> None:
        """Print; a text goes in a group, for rich would join bare ones into a text of its own, broken at blanks only."""
        super().print(*(Group(each) if isinstance(each, Text) else each for each in objects), **options)

    def on_broken_pipe(self) -> None:
        """Raise, instead of leaving the process."""
        raise BrokenPipeError


def table(title: str, columns: Sequence[str], rows: Iterable[Sequence[Any]], *, caption: str = "") -> Group:
    """Return a table under its title: the first column is text, numbers are right-aligned.

    Parameters
    ----------
    title : str
    columns : sequence of str
        Headings; a unit stands in round brackets.
    rows : sequence of rows
        Texts, or numbers that :func:`number` formats.
    caption : str
    """
    return _under(title, _table(columns, [*rows]), caption)


def side_by_side(title: str, names: Sequence[str], rows: Iterable[Sequence[Any]], *, caption: str = "") -> Group:
    """Return a table with a column for each of some things; what does not fit beside each other goes on below.

    Parameters
    ----------
    title : str
    names : sequence of str
        Headings; the first is that of the names of the rows.
    rows : sequence of rows
        Texts, or numbers that :func:`number` formats.
    caption : str
    """
    return _under(title, _Parts(names, [*rows]), caption)


def _under(title: str, made: Any, caption: str) -> Group:
    """Return a table between its title and its caption: rich would wrap them to its width."""
    around = [line(title, "italic")] if title else []
    return Group(*around, made, *([line(caption, "dim")] if caption else []))


def _table(columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> Table:
    """Return the table alone."""
    made = Table(box=SIMPLE_HEAD, pad_edge=False)
    for index, heading in enumerate(columns):
        made.add_column(plain_text(heading), justify="left" if index == 0 else "right", overflow="fold")
    for row in rows:
        made.add_row(*(cell if isinstance(cell, Text) else line(cell if isinstance(cell, str) else number(cell)) for cell in row))
    return made


class _Parts:
    """A table that is cut between its columns where the terminal ends; the first column is repeated."""

    def __init__(self, names: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
        self.names, self.rows = names, rows

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield as many tables as it takes."""
        first, unbound = 1, options.update_width(UNBOUND)
        while first < len(self.names):
            last = len(self.names)
            made = self._part(first, last)
            while last > first + 1 and Measurement.get(console, unbound, made).maximum > options.max_width:
                last -= 1
                made = self._part(first, last)
            yield made
            first = last

    def _part(self, first: int, last: int) -> Table:
        """Return the table of the columns from one to before another."""
        return _table([self.names[0], *self.names[first:last]], [[row[0], *row[first:last]] for row in self.rows])


def line(text: str = "", style: str = "") -> Text:
    """Return a text for the console; what a file wrote into it neither commands the terminal nor marks anything up."""
    return _Line(plain_text(text), style)


class _Line(Text):
    """A text that is broken between wide letters too: rich breaks at blanks, of which Japanese has few."""

    def wrap(self, console: Console, width: int, **options: Any) -> Lines:  # type: ignore[override]
        """Return the lines of the text."""
        if not is_wide(self.plain) and not (has_units(self.plain) and fits(self.plain, width)):
            return super().wrap(console, width, **options)
        lines = Lines()
        for part in self.split("\n", allow_blank=True):
            first, *others = part.divide(breaks(part.plain, width))
            # a line that goes on begins with no blank
            lines.extend([first, *(piece[len(piece) - len(piece.plain.lstrip()) :] for piece in others)])
        for piece in lines:
            piece.rstrip()
        justify = options.get("justify") or self.justify
        if justify in ("right", "center"):
            lines.justify(console, width, justify=justify, overflow="fold")
        return lines


def number(value: Any, digits: int = 4) -> str:
    """Return a number with so many significant digits, a truth as yes or no, nothing as a dash."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return NOTHING
    if isinstance(value, bool):
        return tell("yes") if value else tell("no")
    if isinstance(value, int):
        return str(value)
    size = abs(float(value))
    if size != 0.0 and (size < 1e-3 or size >= 1e6):
        return f"{value:.{digits - 1}e}"
    decimals = digits if size == 0.0 else max(digits - 1 - math.floor(math.log10(size)), 0)
    return f"{value:.{min(decimals, digits)}f}"


def fixed(value: float, decimals: int) -> str:
    """Return a number with so many decimals; what rounds to nothing has no sign."""
    # adding zero after rounding turns -0.0 into 0.0
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


def seconds(value: float | None) -> str:
    """Return a time to the millisecond."""
    return NOTHING if value is None else f"{value:.3f}"


def acceleration(value: float | None, *, gal: bool) -> str:
    """Return an acceleration given in m/s^2 in the unit asked for."""
    return NOTHING if value is None else f"{value / acceleration_unit(gal=gal).size:.{1 if gal else 4}f}"


def told_acceleration(value: float | None, *, gal: bool) -> str:
    """Return an acceleration given in m/s^2 with the unit asked for."""
    return f"{acceleration(value, gal=gal)} {acceleration_unit(gal=gal).name}"


def answered(
    items: Iterable[Item], record_of: Callable[[Item], Record | None], verdict_of: Callable[[Item], Iterable[Text]]
) -> Iterator[tuple[list[Text], list[Item]]]:
    """Yield, record by record, what the answer begins with, and what belongs to it.

    The answer to what was asked comes first, then the line of the record that it is about; several records begin with their lines.

    Parameters
    ----------
    items : sequence
    record_of : callable
        Returns the record of an item, None where it has none.
    verdict_of : callable
        Returns the lines that say what happened.
    """
    parts: dict[int, tuple[Record | None, list[Item]]] = {}
    for item in items:
        record = record_of(item)
        parts.setdefault(id(record), (record, []))[1].append(item)
    for record, mine in parts.values():
        verdicts = [told for item in mine for told in verdict_of(item)]
        heading = [] if record is None else [record_line(record)]
        yield heading + verdicts if len(parts) > 1 else verdicts + heading, mine


def record_line(record: Record) -> Text:
    """Return one line that says which record an answer is about."""
    start = told_time(record, record.start) or tell("start unknown")
    name = site_of(record).label or record.source or tell("record")
    told = tell(
        "{name}  {start}  {samples} samples, {rate:g} Hz, {format}",
        name=name,
        start=start,
        samples=record.samples,
        rate=1 / record.dt,
        format=record.format,
    )
    shown = line(told, "bold")
    for told in whereabouts(record):
        shown.append(f"\n{plain_text(told)}", style="not bold")
    shown.append(f"\n{plain_text(history(record))}", style="dim not bold")
    for doubt in record.doubts:
        shown.append("\n" + tell("doubtful: {doubt}", doubt=doubt.message), style="yellow not bold")
    return shown


def history(record: Record) -> str:
    """Return what was done to a record since it was read."""
    return "; ".join(map(tell, record.history)) or tell("as read")
