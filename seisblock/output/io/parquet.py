"""Typed tables as Apache Parquet."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

from seisblock.core.errors import OutputError
from seisblock.output.io.atomic import ENCODING_ERRORS, atomic_write, check_columns, table_errors

ROWS_PER_BLOCK = 50_000
"""Rows per record batch."""


def check_parquet() -> None:
    """Check that pyarrow is installed.

    Raises
    ------
    OutputError
        If pyarrow is missing.
    """
    try:
        import pyarrow.parquet  # noqa: F401 - availability check
    except ImportError as error:
        raise OutputError("writing .parquet requires pyarrow: run pip install 'seisblock[parquet]', or write .csv") from error


def write_parquet(path: Path, columns: Mapping[str, type], rows: Iterable[Sequence[Any]]) -> None:
    """Write rows as Parquet atomically.

    Parameters
    ----------
    path : Path
    columns : mapping of str to type
        Column names and types: bool, int, float or str.
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
    """Return a cell with bytes that are not UTF-8 (from file names) escaped."""
    return cell.encode(errors=ENCODING_ERRORS).decode() if isinstance(cell, str) else cell


def read_parquet(path: Path, columns: Mapping[str, type]) -> Iterator[dict[str, Any]]:
    """Yield the rows of a Parquet batch table, None where a cell is empty.

    Raises
    ------
    OutputError
        If the columns differ or the table cannot be read.
    """
    from pyarrow.parquet import ParquetFile

    with table_errors(path), ParquetFile(path) as file:
        check_columns(path, file.schema_arrow.names, columns)
        for batch in file.iter_batches(ROWS_PER_BLOCK):
            yield from batch.to_pylist()


def _blocks(rows: Iterable[Sequence[Any]]) -> Iterator[list[Sequence[Any]]]:
    """Yield the rows in blocks of :data:`ROWS_PER_BLOCK`."""
    remaining = iter(rows)
    while block := list(islice(remaining, ROWS_PER_BLOCK)):
        yield block
