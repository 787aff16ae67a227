"""Event counts of a batch by body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from seisblock.core.registry import Solver
from seisblock.studies.batch.table import REASON, Row


@dataclass
class BodyCounts:
    """Counts of one body: rows with a result, without, and with the event; objects, one per record, with a result and with the event.

    An object has the event if it has it in any row of its record.
    """

    body: str
    answers: int = 0
    failures: int = 0
    events: int = 0
    objects: int = 0
    object_events: int = 0


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
                count.failures += 1
                continue
            count.answers += 1
            occurred = self.solver.event_occurred(row)
            count.events += occurred
            objects[body] = objects.get(body, False) or occurred
        for body, occurred in objects.items():
            self.bodies[body].objects += 1
            self.bodies[body].object_events += occurred
        return rows

    @property
    def answers(self) -> int:
        """Number of rows with a result."""
        return sum(count.answers for count in self.bodies.values())

    @property
    def failures(self) -> int:
        """Number of rows without a result."""
        return self.unreadable + sum(count.failures for count in self.bodies.values())

    @property
    def event_count(self) -> int:
        """Number of rows with the event."""
        return sum(count.events for count in self.bodies.values())

    @property
    def objects(self) -> int:
        """Number of objects, one per body and record, with a result."""
        return sum(count.objects for count in self.bodies.values())

    @property
    def object_events(self) -> int:
        """Number of objects with the event in any row."""
        return sum(count.object_events for count in self.bodies.values())

    def sorted_counts(self) -> list[BodyCounts]:
        """Return the counts of the bodies, most events first."""
        return sorted(self.bodies.values(), key=lambda count: -count.events / max(count.answers, 1))
