"""What a response shows of itself in a notebook: its numbers as a table, and its figure."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from seisblock.present.documents.units import unit_of
from seisblock.present.documents.write import plain
from seisblock.present.faces import figure_of
from seisblock.present.figures.embed import picture
from seisblock.present.figures.fonts import drawn
from seisblock.present.page import page
from seisblock.present.text.tables import number
from seisblock.results import Response
from seisblock.words import listed, tell

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def plot(response: Response[Any]) -> Figure:
    """Return the figure of a response, in the language of the locale; a notebook shows it.

    Parameters
    ----------
    response : Response

    Raises
    ------
    ParameterError
        If the model has no figure.
    """
    figure = drawn(lambda: figure_of([response]))
    # a notebook asks what it shows for its picture; pyplot, which would teach it Figures, is not used here
    vars(figure)["_repr_png_"] = lambda: _png(figure)
    return figure


def _png(figure: Figure) -> bytes:
    """Return a figure as .png."""
    held = io.BytesIO()
    figure.savefig(held, format="png")
    return held.getvalue()


def html(response: Response[Any]) -> str:
    """Return a response as a notebook shows it: what it is about, its outcome, its warnings, its figure."""
    parts = (response.model, response.motion.name, tell(str(getattr(response.body, "name", ""))))
    title = " · ".join(part for part in parts if part)
    return page(
        "notebook.html",
        title,
        tables=list(_tables(plain(response.outcome))),
        warnings=[tell(text) for text in response.warnings],
        picture=picture(drawn(lambda: figure_of([response])), title),
    )


def _tables(outcome: Mapping[str, Any]) -> Iterator[tuple[str, list[list[str]]]]:
    """Yield the numbers of an outcome, then a table with its name for each list of things in it."""
    flat = {key: value for key, value in outcome.items() if not isinstance(value, (Mapping, list)) or _is_short(value)}
    yield "", [[_spelt(key), _cell(value)] for key, value in flat.items()]
    for key, value in outcome.items():
        if isinstance(value, list) and value and all(isinstance(entry, Mapping) for entry in value):
            rows = [[_spelt(name), *(_cell(entry.get(name)) for entry in value[:MOST_COLUMNS])] for name in value[0]]
            yield key.replace("_", " "), rows


MOST_COLUMNS, MOST_ENTRIES = 8, 12
"""How many things of a list a table shows."""


def _is_short(value: Any) -> bool:
    """Whether a list of plain values fits a cell."""
    return isinstance(value, list) and len(value) <= MOST_ENTRIES and not any(isinstance(entry, (Mapping, list)) for entry in value)


def _spelt(key: str) -> str:
    """Return a key as words with its unit in brackets."""
    name, unit = unit_of(key)
    words = name.replace("_", " ")
    return f"{words} ({_superscript(unit)})" if unit else words


def _superscript(unit: str) -> str:
    """Return a unit with raised powers."""
    return unit.replace("^2", "²").replace("^3", "³")


def _cell(value: Any) -> str:
    """Return a value as text."""
    if isinstance(value, list):
        return listed(_cell(entry) for entry in value) or "-"
    return tell(value) if isinstance(value, str) and value else "-" if value in ("", None) else number(value)
