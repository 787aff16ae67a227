"""JSON document of ``seisblock batch``: event counts of each body."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from msgspec import Meta, Struct

from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema
from seisblock.references import papers
from seisblock.studies.batch.tally import BodyCounts, Tally
from seisblock.studies.batch.task import Plan


class BatchParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    solver : str
    table : str
        File with a row for each record, component and body; not written if no row has a result.
    components : list of str
        Codes or azimuths; empty for all horizontals.
    runs, seed : int
        Number of samples of a probability, and their seed.
    """

    solver: str
    table: str
    components: tuple[str, ...]
    runs: int
    seed: int


BATCH_ENTRY = entry_type("BatchEntry", BodyCounts)
TOTALS = {
    "records_count": Annotated[int, Meta(description="Number of records.")],
    "unread_count": Annotated[int, Meta(description="Records and components that could not be read.")],
}
BATCH = DocumentSchema("batch", BatchParameters, BATCH_ENTRY, TOTALS)


def document(tally: Tally, plan: Plan, table: str, notes: Sequence[str]) -> Document:
    """Return the document of a finished batch."""
    entries = ((None, to_entry(BATCH_ENTRY, count)) for count in tally.sorted_counts())
    return BATCH.document(
        BatchParameters(solver=plan.solver, table=table, components=plan.components, runs=plan.runs, seed=plan.seed),
        entries,
        citations=papers(*plan.model.topics),
        warnings=notes,
        has_floor_motion=plan.preparation.floor is not None,
        records_count=tally.records,
        unread_count=tally.unreadable,
    )
