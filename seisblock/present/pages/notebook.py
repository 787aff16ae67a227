"""What a response shows of itself in a notebook: its numbers as a table, and its figure."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from seisblock.present.documents.units import unit_of
from seisblock.present.documents.write import plain
from seisblock.present.faces import figure_of
from seisblock.present.figures.embed import picture
from seisblock.present.figures.fonts import drawn
from seisblock.present.text.tables import number
from seisblock.results import Response

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_STYLE = "border-collapse:collapse;margin:.3em 0;font-variant-numeric:tabular-nums"


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
    title = " · ".join(part for part in (response.model, response.motion.name, str(getattr(response.body, "name", ""))) if part)
    parts = [f"<b>{escape(title)}</b>", *_tables(plain(response.outcome))]
    parts += [f'<p style="border-left:4px solid #c0392b;padding-left:.6em">{escape(text)}</p>' for text in response.warnings]
    parts.append(picture(drawn(lambda: figure_of([response])), title))
    return f'<div style="max-width:60em">{"".join(parts)}</div>'


def _tables(outcome: Mapping[str, Any]) -> Iterator[str]:
    """Yield the numbers of an outcome, then a table for each list of things in it."""
    flat = {key: value for key, value in outcome.items() if not isinstance(value, (Mapping, list)) or _is_short(value)}
    yield _table([[_spelt(key), _cell(value)] for key, value in flat.items()])
    for key, value in outcome.items():
        if isinstance(value, list) and value and all(isinstance(entry, Mapping) for entry in value):
            names = list(value[0])
            yield f"<b>{escape(key.replace('_', ' '))}</b>"
            yield _table([[_spelt(name), *(_cell(entry.get(name)) for entry in value[:MOST_COLUMNS])] for name in names])


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
        return ", ".join(_cell(entry) for entry in value) or "-"
    return value if isinstance(value, str) and value else "-" if value in ("", None) else number(value)


def _table(rows: Sequence[Sequence[str]]) -> str:
    """Return rows as a small table, the first column on the left."""
    cells = (
        "".join(f'<td style="text-align:{"right" if i else "left"};padding:.1em .8em .1em 0">{escape(c)}</td>' for i, c in enumerate(row))
        for row in rows
    )
    return f'<table style="{_STYLE}">{"".join(f"<tr>{row}</tr>" for row in cells)}</table>'
