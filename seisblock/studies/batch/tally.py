"""Event counts of a batch by body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from seisblock.core.registry import Solver
from seisblock.studies.batch.table import REASON, Row


@dataclass
class BodyCounts:
    """Counts of one body.

    Parameters
    ----------
    body : str
    answers_count, failures_count : int
        Rows with and without a result.
    happened_count : int
        Rows with the event of the solver: overturning, sliding, jump, uplift, or fall of a stone.
    objects_count, objects_happened_count : int
        Objects, one per record, with a result, and with the event under any component.
    """

    body: str
    answers_count: int = 0
    failures_count: int = 0
    happened_count: int = 0
    objects_count: int = 0
    objects_happened_count: int = 0


@dataclass
class Tally:
    """Running counts of rows, so that no table need be stored.

    Parameters
    ----------
    solver : Solver
    """

    solver: Solver
    bodies: dict[str, BodyCounts] = field(default_factory=dict)
    records: int = 0
    unreadable: int = 0
    reasons: dict[str, int] = field(default_factory=dict)

    def add_rows(self, rows: Sequence[Row]) -> Sequence[Row]:
        """Count the rows of one record, and return them."""
        self.records += bool(rows)
        objects: dict[str, bool] = {}
        for row in rows:
            reason = row.get(REASON)
            if reason:
                self.reasons[reason] = self.reasons.get(reason, 0) + 1
            body = row.get("body")
            if body is None:
                self.unreadable += 1
                continue
            count = self.bodies.setdefault(body, BodyCounts(body))
            if reason:
                count.failures_count += 1
                continue
            count.answers_count += 1
            occurred = self.solver.event_occurred(row)
            count.happened_count += occurred
            objects[body] = objects.get(body, False) or occurred
        for body, occurred in objects.items():
            self.bodies[body].objects_count += 1
            self.bodies[body].objects_happened_count += occurred
        return rows

    def total(self, name: str) -> int:
        """Return the sum of a count, a field of :class:`BodyCounts`, over the bodies."""
        return sum(getattr(count, name) for count in self.bodies.values())

    @property
    def failures(self) -> int:
        """Number of rows without a result."""
        return self.unreadable + self.total("failures_count")

    def sorted_counts(self) -> list[BodyCounts]:
        """Return the counts of the bodies, most events first."""
        return sorted(self.bodies.values(), key=lambda count: -count.happened_count / max(count.answers_count, 1))
