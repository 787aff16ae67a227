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

from seisblock.core.i18n import escape_control, gettext
from seisblock.records import Record
from seisblock.records.site import format_local_time, get_site
from seisblock.report.text.record_info import record_info
from seisblock.report.text.wrap import break_positions, fits, has_quantity, is_wide
from seisblock.report.units_display import acceleration_unit

Item = TypeVar("Item")

DASH = "-"
"""What stands where there is no number."""

UNBOUNDED_WIDTH = 10_000
"""Columns of a terminal that is wide enough for anything."""


def console(*, stderr: bool = False) -> Console:
    """Return a console on the present stdout or stderr; colours obey NO_COLOR and pipes."""
    return _Console(stderr=stderr, highlight=False, markup=False, emoji=False, soft_wrap=False)


class _Console(Console):
    """A console that lets the command line decide what to do when its reader has gone."""

    def print(self, *objects: Any, **options: Any) -> None:
        """Print; a text goes in a group, for rich would join bare ones into a text of its own, broken at blanks only."""
        super().print(*(Group(item) if isinstance(item, Text) else item for item in objects), **options)

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
        Texts, or numbers that :func:`format_number` formats.
    caption : str
    """
    return _with_title(title, _table(columns, [*rows]), caption)


def side_by_side(title: str, names: Sequence[str], rows: Iterable[Sequence[Any]], *, caption: str = "") -> Group:
    """Return a table with a column for each of some things; what does not fit beside each other goes on below.

    Parameters
    ----------
    title : str
    names : sequence of str
        Headings; the first is that of the names of the rows.
    rows : sequence of rows
        Texts, or numbers that :func:`format_number` formats.
    caption : str
    """
    return _with_title(title, _SplitTable(names, [*rows]), caption)


def _with_title(title: str, body: Any, caption: str) -> Group:
    """Return a table between its title and its caption: rich would wrap them to its width."""
    around = [styled_line(title, "italic")] if title else []
    return Group(*around, body, *([styled_line(caption, "dim")] if caption else []))


def _table(columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> Table:
    """Return the table alone."""
    result = Table(box=SIMPLE_HEAD, pad_edge=False)
    for index, heading in enumerate(columns):
        result.add_column(escape_control(heading), justify="left" if index == 0 else "right", overflow="fold")
    for row in rows:
        result.add_row(
            *(cell if isinstance(cell, Text) else styled_line(cell if isinstance(cell, str) else format_number(cell)) for cell in row)
        )
    return result


class _SplitTable:
    """A table that is cut between its columns where the terminal ends; the first column is repeated."""

    def __init__(self, names: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
        self.names, self.rows = names, rows

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield as many tables as it takes."""
        first, unbound = 1, options.update_width(UNBOUNDED_WIDTH)
        while first < len(self.names):
            last = len(self.names)
            part = self._part(first, last)
            while last > first + 1 and Measurement.get(console, unbound, part).maximum > options.max_width:
                last -= 1
                part = self._part(first, last)
            yield part
            first = last

    def _part(self, first: int, last: int) -> Table:
        """Return the table of the columns from one to before another."""
        return _table([self.names[0], *self.names[first:last]], [[row[0], *row[first:last]] for row in self.rows])


def styled_line(text: str = "", style: str = "") -> Text:
    """Return a text for the console; what a file wrote into it neither commands the terminal nor marks anything up."""
    return _WrappedText(escape_control(text), style)


class _WrappedText(Text):
    """A text that is broken between wide letters too: rich breaks at blanks, of which Japanese has few."""

    def wrap(self, console: Console, width: int, **options: Any) -> Lines:  # type: ignore[override]
        """Return the lines of the text."""
        if not is_wide(self.plain) and not (has_quantity(self.plain) and fits(self.plain, width)):
            return super().wrap(console, width, **options)
        lines = Lines()
        for part in self.split("\n", allow_blank=True):
            first, *further_pieces = part.divide(break_positions(part.plain, width))
            # a line that goes on begins with no blank
            lines.extend([first, *(segment[len(segment) - len(segment.plain.lstrip()) :] for segment in further_pieces)])
        for segment in lines:
            segment.rstrip()
        justify = options.get("justify") or self.justify
        if justify in ("right", "center"):
            lines.justify(console, width, justify=justify, overflow="fold")
        return lines


def format_number(value: Any, digits: int = 4) -> str:
    """Return a number with so many significant digits, a truth as yes or no, nothing as a dash."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return DASH
    if isinstance(value, bool):
        return gettext("yes") if value else gettext("no")
    if isinstance(value, int):
        return str(value)
    size = abs(float(value))
    if size != 0.0 and (size < 1e-3 or size >= 1e6):
        return f"{value:.{digits - 1}e}"
    decimals = digits if size == 0.0 else max(digits - 1 - math.floor(math.log10(size)), 0)
    return f"{value:.{min(decimals, digits)}f}"


def format_fixed(value: float, decimals: int) -> str:
    """Return a number with so many decimals; what rounds to nothing has no sign."""
    # adding zero after rounding turns -0.0 into 0.0
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


def format_seconds(value: float | None) -> str:
    """Return a time to the millisecond."""
    return DASH if value is None else f"{value:.3f}"


def acceleration_cell(value: float | None, *, gal: bool) -> str:
    """Return an acceleration given in m/s^2 in the unit asked for."""
    return DASH if value is None else f"{value / acceleration_unit(gal=gal).size:.{1 if gal else 4}f}"


def format_acceleration(value: float | None, *, gal: bool) -> str:
    """Return an acceleration given in m/s^2 with the unit asked for."""
    return f"{acceleration_cell(value, gal=gal)} {acceleration_unit(gal=gal).name}"


def group_answers(
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
    for record, group in parts.values():
        verdicts = [text for item in group for text in verdict_of(item)]
        heading = [] if record is None else [record_line(record)]
        yield heading + verdicts if len(parts) > 1 else verdicts + heading, group


def record_line(record: Record) -> Text:
    """Return one line that says which record an answer is about."""
    start = format_local_time(record, record.start) or gettext("start unknown")
    name = get_site(record).label or record.source or gettext("record")
    text = gettext(
        "{name}  {start}  {samples} samples, {rate:g} Hz, {format}",
        name=name,
        start=start,
        samples=record.samples,
        rate=1 / record.dt,
        format=record.format,
    )
    result = styled_line(text, "bold")
    for text in record_info(record):
        result.append(f"\n{escape_control(text)}", style="not bold")
    result.append(f"\n{escape_control(processing_text(record))}", style="dim not bold")
    for flag in record.doubts:
        result.append("\n" + gettext("doubtful: {doubt}", doubt=flag.message), style="yellow not bold")
    return result


def processing_text(record: Record) -> str:
    """Return what was done to a record since it was read."""
    return "; ".join(map(gettext, record.history)) or gettext("as read")
