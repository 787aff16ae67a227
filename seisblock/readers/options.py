"""Options of reading."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any

from seisblock.readers.limits import ReadBudget


@dataclass(frozen=True)
class ReadOptions:
    """Options for files that lack information in their headers; see :func:`~seisblock.readers.read`."""

    format: str | None = None
    units: str | None = None
    dt: float | None = None
    station: str | None = None
    level: str | None = None
    location: str | None = None
    inventory: Any = None
    event: Any = None
    differentiate: bool = False
    response: str = "sensitivity"
    budget: ReadBudget = field(default_factory=ReadBudget)

    @property
    def keywords(self) -> dict[str, Any]:
        """Options as keyword arguments of :func:`~seisblock.readers.read`."""
        return {f.name: getattr(self, f.name) for f in fields(self) if f.name != "budget"}
