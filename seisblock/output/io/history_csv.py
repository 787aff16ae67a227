"""Time histories as CSV, of one record or several; several are concatenated, with the record index in the first column."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, TypeVar

import numpy as np

from seisblock.core.results import Response
from seisblock.output.io.atomic import normalize_zeros
from seisblock.records import Record

Item = TypeVar("Item")

CsvTable = tuple[Sequence[str], Iterable[Sequence[Any]]]
"""Header and rows of a CSV file."""

CHUNK_ROWS = 2**14
"""Rows of a time history that are formatted at a time."""


def concat_tables(header: Sequence[str], tables: Sequence[Iterable[Sequence[Any]]]) -> CsvTable:
    """Return header and rows of concatenated tables, one per record; several tables get a column ``record_index``."""
    has_index = len(tables) > 1
    rows = ([*([index] if has_index else []), *row] for index, table in enumerate(tables) for row in table)
    return [*(["record_index"] if has_index else []), *header], rows


def group_by_record(items: Iterable[Item], record_of: Callable[[Item], Record | None]) -> list[list[Item]]:
    """Group items by record, in the order of the record indices of the JSON documents."""
    parts: dict[int, list[Item]] = {}
    for item in items:
        parts.setdefault(id(record_of(item)), []).append(item)
    return list(parts.values())


def table_by_record(
    header: Sequence[str],
    items: Iterable[Item],
    record_of: Callable[[Item], Record | None],
    rows_of: Callable[[Item], Iterable[Sequence[Any]]],
) -> CsvTable:
    """Return header and rows grouped by record; several records get a column ``record_index``."""
    tables = [(row for item in part for row in rows_of(item)) for part in group_by_record(items, record_of)]
    return concat_tables(header, tables)


def history_table(responses: Sequence[Response[Any]]) -> CsvTable:
    """Return the time histories of responses, concatenated: component, channels, phase.

    Rows are the samples and both sides of every event, at full precision. Several records get a first column ``record_index``.
    """
    names = list(dict.fromkeys(name for response in responses for name in response.to_columns()))
    header = ["component", *names, "phase"]
    return table_by_record(header, responses, lambda response: response.motion.record, lambda response: _history_rows(response, names))


def _history_rows(response: Response[Any], names: Sequence[str]) -> Iterator[Sequence[Any]]:
    """Yield the rows of a time history, formatted in chunks of :data:`CHUNK_ROWS`."""
    columns, phase = response.to_columns(), response.phase_of_row()
    phases = np.array([phase.name for phase in response.phases] or [""])
    for begin in range(0, response.time.size, CHUNK_ROWS):
        part = slice(begin, begin + CHUNK_ROWS)
        cells = [normalize_zeros(columns[name][part]) if name in columns else [""] * phase[part].size for name in names]
        yield from zip([response.motion.name] * phase[part].size, *cells, phases[phase[part]].tolist(), strict=True)
