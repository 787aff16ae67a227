"""How values show themselves: a door in the ground floor through which the drawing room lends its pictures.

A response, a record or a spectrum knows that it can be seen, not how. What draws stands above them, so it is not imported from here:
the package's face (``seisblock/__init__.py``) hands over how to fetch it, and it is fetched when something is first shown.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any, Protocol


class Backend(Protocol):
    """What the drawing room offers."""

    def plot(self, value: Any) -> Any:
        """Return the ``matplotlib.figure.Figure`` of a value."""

    def html(self, value: Any) -> str:
        """Return what a notebook shows of a value."""


_load_backend: Callable[[], Backend] | None = None


def register_backend(loader: Callable[[], Backend]) -> None:
    """Say how the painter is fetched, when something is first shown."""
    global _load_backend
    _load_backend = loader


def backend() -> Backend:
    """Return the painter that was lent.

    Raises
    ------
    RuntimeError
        If this part of the package is used without its face.
    """
    if _load_backend is None:
        raise RuntimeError("nothing draws here: import seisblock, which brings the drawing room along")
    return _load_backend()


MAX_REPR_FIELDS = 5
"""How many numbers of an outcome are shown in a line."""


def summary_repr(label: str, outcome: Any, status: str) -> str:
    """Return what a value is, the first plain facts of its outcome, a dataclass, and how it ended."""
    items = ((item.name, getattr(outcome, item.name)) for item in fields(outcome))
    scalars = [(name, value) for name, value in items if isinstance(value, (bool, int, float, str))]
    parts = [f"{name}={value:.6g}" if isinstance(value, float) else f"{name}={value!r}" for name, value in scalars]
    return f"<{label}: {', '.join(parts[:MAX_REPR_FIELDS])}; {status}>"


class HtmlReprMixin:
    """A value that a notebook shows as a table, and with its figure where it has one."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        """Return what a notebook shows."""
        return backend().html(self)


class PlotMixin(HtmlReprMixin):
    """A value that has a figure, too."""

    __slots__ = ()

    def plot(self) -> Any:
        """Return its figure, a ``matplotlib.figure.Figure``; a notebook shows it."""
        return backend().plot(self)
