"""Items of a paper: figures and tables that one command computes, with the differences from the paper."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.records import Record
from seisblock.references import find_citations
from seisblock.validation.case import Case

Value = float | int | str | bool | None
"""Cell of a table."""

Kind = Literal["line", "dashed", "dotted", "points", "bars", "steps"]
"""Form of a series in a figure."""


@dataclass(frozen=True)
class ItemColumn:
    """Column of an item's table.

    Parameters
    ----------
    key : str
        Key in documents, with the unit as its suffix.
    heading : str
        Translatable, with the unit of the displayed numbers in brackets.
    size : float
        One displayed unit in the unit of the key.
    """

    key: str
    heading: str
    size: float = 1.0


@dataclass(frozen=True, eq=False)
class Series:
    """One curve, or set of points or bars, of a figure.

    Parameters
    ----------
    label : str
        Message or symbol; empty for a series without an entry in the legend.
    x, y : (n,) arrays
        In the units of the panel.
    kind : str
    """

    label: str
    x: Sequence[float] | FloatArray
    y: Sequence[float] | FloatArray
    kind: Kind = "line"


@dataclass(frozen=True, eq=False)
class Panel:
    """Panel of a figure: labels with units, series, and limits of the axes where the paper has them."""

    x_label: str
    y_label: str
    series: tuple[Series, ...]
    title: str = ""
    x_range: tuple[float, float] | None = None
    y_range: tuple[float, float] | None = None
    equal: bool = False
    levels: tuple[tuple[float, str], ...] = ()
    ticks: tuple[tuple[float, str], ...] = ()


@dataclass(frozen=True)
class Inputs:
    """User's data of an item; None where the data of the paper are used.

    Parameters
    ----------
    records : tuple of Record
    component : tuple of str
        Names of the components under analysis; empty for all horizontals.
    body : str or None
        Bundled name, file or sizes.
    stations : str or None
        CSV of stations.
    """

    records: tuple[Record, ...] = ()
    component: tuple[str, ...] = ()
    body: str | None = None
    stations: str | None = None


@dataclass(frozen=True, eq=False)
class Answer:
    """Computed item.

    Parameters
    ----------
    columns : tuple of ItemColumn
    rows : sequence of sequences
        Cells in the order of the columns.
    panels : tuple of Panel
    source : str
        Data behind the numbers, translatable.
    drawing : object
        Object of a study whose own figure is drawn instead of the panels.
    """

    columns: tuple[ItemColumn, ...]
    rows: Sequence[Sequence[Value]]
    panels: tuple[Panel, ...] = ()
    source: str = ""
    drawing: Any = None


@dataclass(frozen=True)
class Item:
    """Figure or table of a paper.

    Parameters
    ----------
    name : str
        As on the command line: ``fig7``, ``table1``.
    title : str
        Translatable.
    compute : callable
        Returns the answer of the inputs.
    takes : tuple of str
        Inputs of the user that the item accepts: ``record``, ``body``, ``stations``.
    also : tuple of str
        Further places of the paper whose cases belong to the item, for example ``eq. (9)`` or ``section 2``.
    """

    name: str
    title: str
    compute: Callable[[Inputs], Answer]
    takes: tuple[str, ...] = ()
    also: tuple[str, ...] = ()

    @property
    def place(self) -> str:
        """Place in the words of the validation cases: ``fig. 7``, ``table 1``."""
        return self.name.replace("fig", "fig. ").replace("table", "table ")

    @property
    def label(self) -> str:
        """Place in the language of the reader, translatable."""
        number = self.name.removeprefix("fig").removeprefix("table")
        text = N_("fig. {number}") if self.name.startswith("fig") else N_("table {number}")
        return lazy_gettext(text, number=number)


@dataclass(frozen=True)
class Paper:
    """Paper with its items.

    Parameters
    ----------
    citation : str
        Citation key in square brackets with an underscore.
    module : str
        Validation module or modules with its cases, separated by blanks.
    items : tuple of Item
    """

    citation: str
    module: str
    items: tuple[Item, ...] = field(default=())

    @property
    def key(self) -> str:
        """Citation key."""
        return find_citations([self.citation])[0]

    def cases(self, item: Item) -> list[Case]:
        """Return the validation cases on an item."""
        from seisblock.validation import cases

        places = {place.replace("fig.", "fig").replace("eq.", "eq") for place in (item.place, *item.also)}
        return [
            case
            for name in self.module.split()
            for case in cases(name)
            if case.paper == self.key and places & set(named_places(case.place))
        ]


_PART = re.compile(r"(?:(eq|fig|table|section|sec)s?\.?\s+)?(.+)")
"""Part of a locator: kind of place, where named, and number."""


def named_places(locator: str) -> list[str]:
    """Return the places that a locator names: those of a list, tables without the letter of a part.

    Examples
    --------
    >>> named_places("section 5, figs. 10, 11"), named_places("eqs. (7), (8)"), named_places("table 5(a)")
    (['section 5', 'fig 10', 'fig 11'], ['eq (7)', 'eq (8)'], ['table 5'])
    >>> named_places("section 6, statement 3")
    ['section 6', 'section 6, statement 3']
    """
    places: list[str] = []
    kind = ""
    for part in re.split(r",\s*|\s+and\s+|\s+against\s+", locator):
        if part.startswith("statement") and places:
            places.append(f"{places[0]}, {part}")
            continue
        match = _PART.fullmatch(part.strip())
        if match is None:
            continue
        kind = match[1] or kind
        number = re.sub(r"\([a-z]\)$", "", match[2]) if kind in ("table", "fig") else match[2]
        places.append(f"{'section' if kind == 'sec' else kind} {number}")
    return places
