"""A table as Apache Parquet, the types of its columns kept."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

from seisblock.core.errors import OutputError
from seisblock.report.io.atomic import ENCODING_ERRORS, atomic_write, check_columns, table_errors

ROWS_PER_BLOCK = 50_000
"""Rows that are held and written at a time."""


def check_parquet() -> None:
    """Refuse to write Parquet where its package is missing.

    Raises
    ------
    OutputError
        If so, with what installs it.
    """
    try:
        import pyarrow.parquet  # noqa: F401 - only whether it is there
    except ImportError as error:
        raise OutputError("a .parquet needs pyarrow: pip install 'seisblock[parquet]', or write a .csv") from error


def write_parquet(path: Path, columns: Mapping[str, type], rows: Iterable[Sequence[Any]]) -> None:
    """Write rows as Parquet, whole or not at all.

    Parameters
    ----------
    path : Path
    columns : mapping of str to type
        Names, and bool, int, float or str.
    rows : iterable of sequences
        Cells in the order of the columns, None where empty.
    """
    import pyarrow
    from pyarrow.parquet import ParquetWriter

    kinds = {bool: pyarrow.bool_(), int: pyarrow.int64(), float: pyarrow.float64(), str: pyarrow.string()}
    schema = pyarrow.schema([(name, kinds[kind]) for name, kind in columns.items()])
    with atomic_write(path) as temporary, ParquetWriter(temporary, schema) as writer:
        for block in _blocks(rows):
            encoded = zip(*([_encode_cell(cell) for cell in row] for row in block), strict=True)
            arrays = [pyarrow.array(cells, field.type) for cells, field in zip(encoded, schema, strict=True)]
            writer.write_batch(pyarrow.record_batch(arrays, schema=schema))


def _encode_cell(cell: Any) -> Any:
    """Return a cell in letters that there are: bytes in the name of a file that are no UTF-8 are spelt out."""
    return cell.encode(errors=ENCODING_ERRORS).decode() if isinstance(cell, str) else cell


def read_parquet(path: Path, columns: Mapping[str, type]) -> Iterator[dict[str, Any]]:
    """Yield the rows of a table that was written here, None where a cell is empty.

    Raises
    ------
    OutputError
        If it has other columns, or cannot be read.
    """
    from pyarrow.parquet import ParquetFile

    with table_errors(path), ParquetFile(path) as file:
        check_columns(path, file.schema_arrow.names, columns)
        for batch in file.iter_batches(ROWS_PER_BLOCK):
            yield from batch.to_pylist()


def _blocks(rows: Iterable[Sequence[Any]]) -> Iterator[list[Sequence[Any]]]:
    """Yield the rows, many at a time."""
    remaining = iter(rows)
    while block := list(islice(remaining, ROWS_PER_BLOCK)):
        yield block
