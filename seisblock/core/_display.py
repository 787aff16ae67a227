"""Representations of values: bounded texts, and the figure and HTML of :func:`~seisblock.core.backends.backend`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from seisblock.core.backends import backend

MAX_REPR_FIELDS = 5
"""Number of scalar fields shown in a one-line representation."""


def summary_repr(label: str, outcome: Any, status: str) -> str:
    """Return a one-line representation: label, first scalar fields of the outcome (a dataclass), status."""
    items = ((item.name, getattr(outcome, item.name)) for item in fields(outcome))
    scalars = [(name, value) for name, value in items if isinstance(value, (bool, int, float, str))]
    parts = [f"{name}={value:.6g}" if isinstance(value, float) else f"{name}={value!r}" for name, value in scalars]
    return f"<{label}: {', '.join(parts[:MAX_REPR_FIELDS])}; {status}>"


MAX_REPR_LENGTH = 800
"""Length of the representation of a value, ten lines of 80 letters."""

MAX_ITEM_LENGTH = 160
"""Length of one field in the representation; longer sequences are shown as a count."""


def bounded_repr(value: Any) -> str:
    """Return the representation of a dataclass in at most ten lines of 80 letters; long sequences and arrays are counts and shapes.

    Examples
    --------
    >>> from seisblock.bodies import EdgeWear
    >>> bounded_repr(EdgeWear(0.01))
    'EdgeWear(length_m=0.01, share=0.0)'
    """
    name, text = type(value).__name__, ""
    for item in (item for item in fields(value) if item.repr):
        part = f"{item.name}={item_repr(getattr(value, item.name))}"
        if len(name) + len(text) + len(part) > MAX_REPR_LENGTH - 10:
            return f"{name}({text}, ...)"
        text += f", {part}" if text else part
    return f"{name}({text})"


def item_repr(value: Any) -> str:
    """Return the representation of a field: itself if short, else its type with the number of items."""
    if hasattr(value, "shape") and value.shape:
        return f"<array {tuple(value.shape)}>"
    if isinstance(value, (Sequence, Mapping)) and not isinstance(value, str):
        if len(value) > MAX_ITEM_LENGTH // 3:
            return _count(value)
        parts = (
            [f"{key!r}: {item_repr(value[key])}" for key in value] if isinstance(value, Mapping) else [item_repr(item) for item in value]
        )
        opening, closing = ("{", "}") if isinstance(value, Mapping) else ("[", "]") if isinstance(value, list) else ("(", ")")
        comma = "," if opening == "(" and len(parts) == 1 else ""
        text = f"{opening}{', '.join(parts)}{comma}{closing}"
        return text if len(text) <= MAX_ITEM_LENGTH else _count(value)
    if is_dataclass(value) and not isinstance(value, type):
        text = repr(value)
        return text if len(text) <= MAX_ITEM_LENGTH else f"<{type(value).__name__}>"
    text = repr(value)
    return text if len(text) <= MAX_ITEM_LENGTH and "\n" not in text else f"<{type(value).__name__}>"


def _count(items: Any) -> str:
    kinds = {type(item).__name__ for item in (items.values() if isinstance(items, Mapping) else items)}
    return f"<{len(items)} {kinds.pop() if len(kinds) == 1 else 'items'}>"


def exact_repr(value: Any) -> str:
    """Return a text that differs for values that differ in any field, for keys and digests.

    Examples
    --------
    >>> exact_repr({"block": (1.0, [2])})
    "{'block': (1.0, [2])}"
    """
    if is_dataclass(value) and not isinstance(value, type):
        return f"{type(value).__name__}({', '.join(f'{item.name}={exact_repr(getattr(value, item.name))}' for item in fields(value))})"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key!r}: {exact_repr(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return f"[{', '.join(map(exact_repr, value))}]"
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        return f"({', '.join(map(exact_repr, value))})"
    if hasattr(value, "tolist") and hasattr(value, "shape"):
        return repr(value.tolist())
    return repr(value)


class DisplayMixin:
    """Mixin for dataclasses: representation of at most ten lines, and an HTML representation in notebooks."""

    __slots__ = ()

    def __repr__(self) -> str:
        """Return the fields; long sequences and arrays are counts and shapes."""
        return bounded_repr(self)

    def _repr_html_(self) -> str:
        """Return the HTML representation."""
        return backend("display").html(self)  # type: ignore[no-any-return]


class PlotMixin(DisplayMixin):
    """Mixin that gives a value a figure and an HTML representation."""

    __slots__ = ()

    def plot(self) -> Any:
        """Return the figure of the value, a ``matplotlib.figure.Figure``."""
        return backend("display").plot(self)
