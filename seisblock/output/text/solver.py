"""Text of any solver: the sentence that it registers, and a table of its outcome."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields
from typing import Any

from seisblock.core.i18n import gettext
from seisblock.core.registry import get_solver
from seisblock.core.results import Response
from seisblock.output.json.units import split_unit
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.tables import format_number, styled_line, table


def describe(response: Response[Any], *, gal: bool = True) -> str:
    """Return the result of a response as one sentence: that of its model, else whether the event of the model occurred."""
    describe_model: Callable[..., str] | None = get_solver(response.model).presenter("describe")
    if describe_model is not None:
        return describe_model(response, gal=gal)
    return gettext("{name}: {verdict}.", name=response.motion.name, verdict=event_text(response))


def event_text(response: Response[Any]) -> str:
    """Return whether the event of the model occurred."""
    solver = get_solver(response.model)
    event = solver.event.replace("_", " ")
    return gettext("{event}: yes", event=event) if solver.event_occurred(vars(response.outcome)) else gettext("{event}: no", event=event)


def tables(responses: Sequence[Response[Any]], *, gal: bool) -> Iterator[Any]:
    """Yield a sentence per direction, the scalar results, SI, and the shaking."""
    for response in responses:
        yield styled_line(describe(response, gal=gal), "bold")
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
