"""Batch result table: a row for each record, component and body."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.registry import Solver
from seisblock.studies.batch.directions import DIRECTIONS, FALLEN_DIRECTIONS
from seisblock.studies.batch.probability import PROBABILITY_COLUMNS
from seisblock.studies.batch.scalar_fields import scalar_fields
from seisblock.studies.batch.shaking import BODY_COLUMNS, SHAKING_COLUMNS

if TYPE_CHECKING:
    import pandas

Row = Mapping[str, Any]

KEY_COLUMNS: dict[str, type] = dict.fromkeys(("record", "path", "station", "seed_id", "start", "component", "body", "solver"), str)
"""Columns that identify a row."""

REASON, WARNINGS = "failure", "warnings"
"""Columns for the reason of a missing result, and for warnings."""


def batch_columns(solver: Solver, *, runs: int = 0, all_azimuths: bool = False) -> dict[str, type]:
    """Return the columns of a batch with their types, including shaking, probabilities and azimuth sweeps."""
    probability_columns = PROBABILITY_COLUMNS if runs else {}
    directions: dict[str, type] = {DIRECTIONS: int} if all_azimuths else {}
    if all_azimuths and solver.event == "overturned":
        directions[FALLEN_DIRECTIONS] = int
    results = {**scalar_fields(solver.outcome), **SHAKING_COLUMNS, **BODY_COLUMNS, **probability_columns}
    return {**KEY_COLUMNS, **directions, **results, WARNINGS: str, REASON: str}


@dataclass(frozen=True, eq=False, repr=False)
class BatchTable(DisplayMixin):
    """Rows and columns; an empty cell is None.

    Parameters
    ----------
    columns : mapping of str to type
        The names of the columns, in order, with the types of their cells: bool, int, float or str.
    rows : sequence of mappings
        By column name; missing keys are None.
    notes : tuple of str
        Notes on the table.

    Examples
    --------
    >>> table = BatchTable({"body": str, "overturned": bool}, [{"body": "vase", "overturned": True}])
    >>> table["overturned"], len(table)
    ([True], 1)
    """

    columns: Mapping[str, type]
    rows: Sequence[Row]
    notes: tuple[str, ...] = field(default=())

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, column: str) -> list[Any]:
        """Return the cells of a column."""
        if column not in self.columns:
            raise ParameterError("no column {column!r}; available: {known}", column=str(column)[:100], known=list(self.columns))
        return [row.get(column) for row in self.rows]

    @property
    def failures(self) -> list[Row]:
        """Rows without a result, each with its reason."""
        return [row for row in self.rows if row.get(REASON)]

    def cells(self) -> Iterator[list[Any]]:
        """Yield the cells of each row in column order."""
        return (row_cells(self.columns, row) for row in self.rows)

    def to_pandas(self) -> pandas.DataFrame:
        """Return a DataFrame with nullable column types.

        Raises
        ------
        ParameterError
            If pandas is not installed.
        """
        try:
            import pandas
        except ImportError as error:
            raise ParameterError("pandas is not installed: pip install pandas") from error
        kinds = {bool: "boolean", int: "Int64", float: "float64", str: "string"}
        return pandas.DataFrame({name: pandas.array(self[name], dtype=kinds[kind]) for name, kind in self.columns.items()})


def row_cells(columns: Iterable[str], row: Row) -> list[Any]:
    """Return the cells of a row in column order."""
    return [row.get(name) for name in columns]
