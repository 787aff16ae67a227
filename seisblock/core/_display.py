"""Display hooks: ``plot()`` and ``_repr_html_()`` delegate to :mod:`seisblock.report` without importing it.

Results, records and spectra lie below the plotting code in the import order. ``seisblock/__init__.py`` registers a loader of the
plotting backend; the loader runs at the first plot or notebook display, so that ``import seisblock`` does not load matplotlib.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any, Protocol


class Backend(Protocol):
    """Interface of the plotting and HTML backend."""

    def plot(self, value: Any) -> Any:
        """Return the ``matplotlib.figure.Figure`` of a value."""

    def html(self, value: Any) -> str:
        """Return the HTML representation of a value for notebooks."""

    def json_text(self, response: Any) -> str:
        """Return the JSON document of a response."""


_load_backend: Callable[[], Backend] | None = None


def register_backend(loader: Callable[[], Backend]) -> None:
    """Register the function that loads the backend; it is called at the first display."""
    global _load_backend
    _load_backend = loader


def backend() -> Backend:
    """Return the registered backend.

    Raises
    ------
    RuntimeError
        If no backend is registered, that is, if a submodule was loaded without ``import seisblock``.
    """
    if _load_backend is None:
        raise RuntimeError("no plotting backend registered: import seisblock first")
    return _load_backend()


MAX_REPR_FIELDS = 5
"""Number of scalar fields shown in a one-line representation."""


def summary_repr(label: str, outcome: Any, status: str) -> str:
    """Return a one-line representation: label, first scalar fields of the outcome (a dataclass), status."""
    items = ((item.name, getattr(outcome, item.name)) for item in fields(outcome))
    scalars = [(name, value) for name, value in items if isinstance(value, (bool, int, float, str))]
    parts = [f"{name}={value:.6g}" if isinstance(value, float) else f"{name}={value!r}" for name, value in scalars]
    return f"<{label}: {', '.join(parts[:MAX_REPR_FIELDS])}; {status}>"


class HtmlReprMixin:
    """Mixin that gives a value an HTML representation in notebooks."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        """Return the HTML representation."""
        return backend().html(self)


class PlotMixin(HtmlReprMixin):
    """Mixin that gives a value a figure and an HTML representation."""

    __slots__ = ()

    def plot(self) -> Any:
        """Return the figure of the value, a ``matplotlib.figure.Figure``."""
        return backend().plot(self)
