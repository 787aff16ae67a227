"""Text output of a solver without a module of its own: sentence, and a table of its outcome."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields
from typing import Any

from seisblock.core.i18n import gettext
from seisblock.core.registry import get_solver
from seisblock.core.results import Response
from seisblock.report.json.units import split_unit
from seisblock.report.text.shaking import shaking_lines
from seisblock.report.text.tables import format_number, styled_line, table


def describe(response: Response[Any]) -> str:
    """Return the result as one sentence: that of the solver, else whether its event occurred."""
    solver = get_solver(response.model)
    if solver.describe is not None:
        return gettext(solver.describe(response))
    event = solver.event.replace("_", " ")
    occurred = getattr(response.outcome, solver.event) in solver.event_values
    return gettext("{event}: yes", event=event) if occurred else gettext("{event}: no", event=event)


def tables(responses: Sequence[Response[Any]], *, gal: bool) -> Iterator[Any]:
    """Yield a sentence per direction, the scalar results, SI, and the shaking."""
    for response in responses:
        yield styled_line(gettext("{name}: {verdict}.", name=response.motion.name, verdict=describe(response)), "bold")
    names = [field.name for field in fields(responses[0].outcome)]
    rows = [[_heading(name), *(_cell(getattr(response.outcome, name)) for response in responses)] for name in names]
    yield table("", [gettext("result"), *(response.motion.name for response in responses)], rows)
    yield from shaking_lines(responses, gal=gal)


def _heading(key: str) -> str:
    name, unit = split_unit(key)
    words = gettext(name.replace("_", " "))
    return gettext("{name} ({unit})", name=words, unit=unit) if unit else words


def _cell(value: Any) -> str:
    return format_number(value) if isinstance(value, (bool, int, float)) or value is None else str(value)
