"""Console, tables and number formats of the text reports."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from rich.box import SIMPLE_HEAD
from rich.console import Console, ConsoleOptions, Group, RenderResult
from rich.containers import Lines
from rich.measure import Measurement
from rich.segment import Segment
from rich.table import Table
from rich.text import Text

from seisblock.core.i18n import escape_control, gettext, join_clauses, join_sentences
from seisblock.output.text.record_info import format_step, record_info
from seisblock.output.text.wrap import break_positions, fits, has_quantity, is_wide
from seisblock.output.units_display import acceleration_unit
from seisblock.records import Record
from seisblock.records.analytic import ANALYTIC
from seisblock.records.site import format_local_time, get_site

Item = TypeVar("Item")

DASH = "-"
"""Cell without a value."""

UNBOUNDED_WIDTH = 10_000
"""Console width without wrapping, columns."""


def console(*, stderr: bool = False) -> Console:
    """Return a console on the current stdout or stderr; colours follow NO_COLOR and pipes."""
    return _Console(stderr=stderr, highlight=False, markup=False, emoji=False, soft_wrap=False)


class _Console(Console):
    """Console that leaves broken pipes to the command line."""

    def print(self, *objects: Any, **options: Any) -> None:
        """Print; single texts are grouped because rich joins bare ones into its own text, broken at blanks only."""
        super().print(*(Group(item) if isinstance(item, Text) else item for item in objects), **options)

    def on_broken_pipe(self) -> None:
        """Raise instead of exiting."""
        raise BrokenPipeError


def table(title: str, columns: Sequence[str], rows: Iterable[Sequence[Any]], *, caption: str = "") -> Group:
    """Return a table under its title: the first column left-aligned, the others right-aligned.

    Parameters
    ----------
    title : str
    columns : sequence of str
        Headings, with the unit in round brackets.
    rows : sequence of rows
        Texts, or numbers that :func:`format_number` formats.
    caption : str
    """
    return _with_title(title, _table(columns, [*rows]), caption)


def side_by_side(title: str, names: Sequence[str], rows: Iterable[Sequence[Any]]) -> Group:
    """Return a table with a column per item, split into several tables where the terminal ends.

    Parameters
    ----------
    title : str
    names : sequence of str
        Headings; the first one is that of the row names.
    rows : sequence of rows
        Texts, or numbers that :func:`format_number` formats.
    """
    return _with_title(title, _SplitTable(names, [*rows]), "")


def _with_title(title: str, body: Any, caption: str) -> Group:
    """Return a table between title and caption; rich would wrap both to the table width."""
    around = [styled_line(title, "italic")] if title else []
    return Group(*around, body, *([styled_line(caption, "dim")] if caption else []))


def _table(columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> Table:
    result = _Table(box=SIMPLE_HEAD, pad_edge=False, show_header=any(columns))
    for index, heading in enumerate(columns):
        result.add_column(escape_control(heading), justify="left" if index == 0 else "right", overflow="fold")
    for row in rows:
        result.add_row(
            *(cell if isinstance(cell, Text) else styled_line(cell if isinstance(cell, str) else format_number(cell)) for cell in row)
        )
    return result


class _Table(Table):
    """Table whose columns move together where it would not fit the terminal otherwise: 3, 2 or 1 blanks between cells."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        unbound = options.update_width(UNBOUNDED_WIDTH)
        # where cells wrap in any case, 2 blanks
        for padding in ((0, 1), (0, 1, 0, 0), (0, 0), (0, 1, 0, 0)):
            self.padding = padding
            if Measurement.get(console, unbound, self).maximum <= options.max_width:
                break
        return super().__rich_console__(console, options)


class _SplitTable:
    """Table split between columns at the terminal width; the first column is repeated."""

    def __init__(self, names: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
        self.names, self.rows = names, rows

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
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
        return _table([self.names[0], *self.names[first:last]], [[row[0], *row[first:last]] for row in self.rows])


def styled_line(text: str = "", style: str = "") -> Text:
    """Return a text for the console with control characters escaped and without markup."""
    return _WrappedText(escape_control(text), style)


class _WrappedText(Text):
    """Text with its indent on every line and breaks between wide characters; rich breaks at blanks, of which Japanese has few."""

    def wrap(self, console: Console, width: int, **options: Any) -> Lines:  # type: ignore[override]
        indent = len(self.plain) - len(self.plain.lstrip(" "))
        if 0 < indent < min(len(self.plain), width):
            indented = _WrappedText(self.plain[indent:], self.style).wrap(console, width - indent, **options)
            for line in indented:
                line.pad_left(indent)
            return indented
        if not is_wide(self.plain) and not (has_quantity(self.plain) and fits(self.plain, width)):
            return super().wrap(console, width, **options)
        lines = Lines()
        for part in self.split("\n", allow_blank=True):
            first, *further_pieces = part.divide(break_positions(part.plain, width))
            # continuation lines begin without a blank
            lines.extend([first, *(segment[len(segment) - len(segment.plain.lstrip()) :] for segment in further_pieces)])
        for segment in lines:
            segment.rstrip()
        justify = options.get("justify") or self.justify
        if justify in ("right", "center"):
            lines.justify(console, width, justify=justify, overflow="fold")
        return lines


@dataclass(frozen=True)
class Part:
    """Part of an answer in two lengths.

    Parameters
    ----------
    full : tuple
        Rich renderables printed with ``--details``.
    short : tuple
        Rich renderables printed otherwise.
    """

    full: tuple[Any, ...]
    short: tuple[Any, ...] = ()


def details(*full: Any) -> Part:
    """Return a part of an answer that is printed with ``--details`` only."""
    return Part(full)


def whole_answer(parts: Iterable[Any]) -> Iterator[Any]:
    """Yield an answer in full."""
    yield from _without_last_blank_lines(line for part in parts for line in (part.full if isinstance(part, Part) else [part]))


def shortened_answer(parts: Iterable[Any]) -> Iterator[Any]:
    """Yield an answer without its details, and the option that prints them where there are any."""
    answer = list(parts)
    lines = list(_without_last_blank_lines(line for part in answer for line in (part.short if isinstance(part, Part) else [part])))
    if any(isinstance(part, Part) for part in answer):
        lines = [*lines[:-1], *map(_WithoutLowerEdge, lines[-1:]), styled_line(gettext("more: --details"), "dim")]
    yield from lines


@dataclass(frozen=True)
class _WithoutLowerEdge:
    """Part of an answer without the blank line under its last table."""

    part: Any

    def __str__(self) -> str:
        return str(self.part)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        lines = console.render_lines(self.part, options, pad=False)
        for line in lines if "".join(segment.text for segment in lines[-1]).strip() else lines[:-1]:
            yield from line
            yield Segment.line()


def _without_last_blank_lines(lines: Iterable[Any]) -> Iterator[Any]:
    """Yield lines and tables; blank lines separate parts and do not end an answer."""
    blank_lines: list[Any] = []
    for line in lines:
        if isinstance(line, Text) and not line.plain:
            blank_lines.append(line)
            continue
        yield from blank_lines
        blank_lines.clear()
        yield line


def format_number(value: Any, digits: int = 4) -> str:
    """Return a number with `digits` significant digits, yes or no for a boolean, a dash for none."""
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
    """Return a number with a fixed number of decimals, without negative zero."""
    # adding zero after rounding turns -0.0 into 0.0
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


def format_seconds(value: float | None) -> str:
    """Return a time, s, to the millisecond."""
    return DASH if value is None else f"{value:.3f}"


def format_range(low: str, high: str) -> str:
    """Return the range between two formatted numbers.

    Examples
    --------
    >>> format_range("0.19", "0.38")
    '0.19-0.38'
    """
    return gettext("{low}-{high}", low=low, high=high)


def format_share_interval(interval: tuple[float, float]) -> str:
    """Return an interval of shares in per cent, with one decimal where whole numbers would round to 0 or 100 and tenths do not.

    Examples
    --------
    >>> format_share_interval((0.297, 0.438)), format_share_interval((0.0, 0.018)), format_share_interval((0.0013, 0.9996))
    ('30-44 %', '0-2 %', '0.1-100 %')
    """
    low, high = (f"{100.0 * end:.{1 if 0.0005 <= end < 0.005 or 0.995 <= end < 0.9995 else 0}f}" for end in interval)
    return gettext("{low}-{high} %", low=low, high=high)


SLIGHT_TILT = 0.01
"""Peak tilt over alpha below which impacts are not counted in tables: the number of decaying impacts has no meaning."""


def impacts_cell(impacts: int, ratio: float) -> str:
    """Return the number of impacts of a run with a peak tilt of `ratio` times alpha.

    Examples
    --------
    >>> impacts_cell(1381, 0.001), impacts_cell(90, 0.5), impacts_cell(0, 0.0)
    ('negligible', '90', '0')
    """
    return gettext("negligible") if impacts and ratio < SLIGHT_TILT else str(impacts)


def tilt_ratio_cell(ratio: float, *, overturned: bool) -> str:
    """Return the peak tilt over the overturning angle; beyond it the tilt of a falling body has no meaning as a ratio."""
    return ">1" if overturned else format_number(ratio)


def with_notes(result: str, notes: Sequence[str]) -> str:
    """Return a result followed by its notes."""
    return gettext("{result} {notes}", result=result, notes=join_sentences(notes)) if notes else result


def acceleration_cell(value: float | None, *, gal: bool) -> str:
    """Return an acceleration, m/s^2, in gal or m/s^2."""
    return DASH if value is None else f"{value / acceleration_unit(gal=gal).size:.{1 if gal else 4}f}"


def format_acceleration(value: float | None, *, gal: bool) -> str:
    """Return an acceleration, m/s^2, in gal or m/s^2 with the unit."""
    return f"{acceleration_cell(value, gal=gal)} {acceleration_unit(gal=gal).name}"


def group_answers(
    items: Iterable[Item],
    record_of: Callable[[Item], Record | None],
    verdict_of: Callable[[Item], Iterable[Any]],
    first_of: Callable[[list[Item]], Iterable[Any]] = lambda group: (),
) -> Iterator[tuple[list[Any], list[Item]]]:
    """Yield, per record, the heading lines and the items.

    For one record the verdicts come first, then the record line; for several records each group begins with its record line.

    Parameters
    ----------
    items : sequence
    record_of : callable
        Returns the record of an item, None where it has none.
    verdict_of : callable
        Returns the verdict lines, or parts of an answer.
    first_of : callable
        Returns the lines above all verdicts of a record.
    """
    parts: dict[int, tuple[Record | None, list[Item]]] = {}
    for item in items:
        record = record_of(item)
        parts.setdefault(id(record), (record, []))[1].append(item)
    for record, group in parts.values():
        verdicts = [*first_of(group), *(text for item in group for text in verdict_of(item))]
        heading = [] if record is None else [record_line(record)]
        yield heading + verdicts if len(parts) > 1 else verdicts + heading, group


def record_line(record: Record) -> Text:
    """Return a line that identifies a record, with station, earthquake, processing and warnings below."""
    start = format_local_time(record, record.start) or gettext("start time unknown")
    name = get_site(record).label or record.source or gettext("record")
    text = gettext(
        "{name}  analytic motion, {samples} samples, {rate:g} Hz"
        if record.format == ANALYTIC
        else "{name}  {start}  {samples} samples, {rate:g} Hz, {format}",
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
        result.append("\n" + gettext("warning: {doubt}", doubt=flag.message), style="yellow not bold")
    return result


def processing_text(record: Record) -> str:
    """Return the processing applied to a record."""
    return join_clauses(map(format_step, record.history)) or gettext("no processing")
