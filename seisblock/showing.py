"""How values show themselves: a door in the ground floor through which the drawing room lends its pictures.

A response, a record or a spectrum knows that it can be seen, not how. What draws stands above them, so it is not imported from here:
the package's face (``seisblock/__init__.py``) hands over how to fetch it, and it is fetched when something is first shown.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any, Protocol


class Painter(Protocol):
    """What the drawing room offers."""

    def plot(self, shown: Any) -> Any:
        """Return the ``matplotlib.figure.Figure`` of a value."""

    def html(self, shown: Any) -> str:
        """Return what a notebook shows of a value."""


_fetch: Callable[[], Painter] | None = None


def lend(fetch: Callable[[], Painter]) -> None:
    """Say how the painter is fetched, when something is first shown."""
    global _fetch
    _fetch = fetch


def painter() -> Painter:
    """Return the painter that was lent.

    Raises
    ------
    RuntimeError
        If this part of the package is used without its face.
    """
    if _fetch is None:
        raise RuntimeError("nothing draws here: import seisblock, which brings the drawing room along")
    return _fetch()


FACTS = 5
"""How many numbers of an outcome are shown in a line."""


def in_a_line(about: str, outcome: Any, ended: str) -> str:
    """Return what a value is, the first plain facts of its outcome, a dataclass, and how it ended."""
    found = ((each.name, getattr(outcome, each.name)) for each in fields(outcome))
    plain = [(name, value) for name, value in found if isinstance(value, (bool, int, float, str))]
    facts = [f"{name}={value:.6g}" if isinstance(value, float) else f"{name}={value!r}" for name, value in plain]
    return f"<{about}: {', '.join(facts[:FACTS])}; {ended}>"


class Shown:
    """A value that a notebook shows as a table, and with its figure where it has one."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        """Return what a notebook shows."""
        return painter().html(self)


class Drawn(Shown):
    """A value that has a figure, too."""

    __slots__ = ()

    def plot(self) -> Any:
        """Return its figure, a ``matplotlib.figure.Figure``; a notebook shows it."""
        return painter().plot(self)
