"""Tables of one record or several: rows of several stand one below the other, and the first column says which record."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from seisblock.core.errors import OutputError
from seisblock.core.results import Response
from seisblock.records import Record
from seisblock.report.io.atomic import normalize_zeros, write_table

Item = TypeVar("Item")

CHUNK_ROWS = 2**14
"""Rows of a time history that are made at a time."""


def concat_tables(header: Sequence[str], tables: Sequence[Iterable[Sequence[Any]]]) -> tuple[list[str], Iterator[list[Any]]]:
    """Return the heading and the rows of one table per record, one below the other; of several the first column says which record."""
    has_index = len(tables) > 1
    rows = ([*([index] if has_index else []), *row] for index, table in enumerate(tables) for row in table)
    return [*(["record_index"] if has_index else []), *header], rows


def group_by_record(items: Iterable[Item], record_of: Callable[[Item], Record | None]) -> list[list[Item]]:
    """Return the answers of each record, in the order in which documents count records."""
    parts: dict[int, list[Item]] = {}
    for item in items:
        parts.setdefault(id(record_of(item)), []).append(item)
    return list(parts.values())


def write_by_record(
    path: Path | str,
    header: Sequence[str],
    items: Iterable[Item],
    record_of: Callable[[Item], Record | None],
    rows_of: Callable[[Item], Iterable[Sequence[Any]]],
) -> None:
    """Write the rows of some answers as CSV, record by record; of several the first column says which record."""
    tables = [(row for item in part for row in rows_of(item)) for part in group_by_record(items, record_of)]
    write_table(path, *concat_tables(header, tables))


def write_histories(path: Path | str, responses: Sequence[Response[Any]]) -> None:
    """Write the time histories of responses, one below the other, with the component in the first column and the phase in the last.

    Rows stand at the samples and at both limits of every event; floats keep all their digits. Of several records the index stands
    before the component.
    """
    if not responses:
        raise OutputError("cannot write {path}: there is no time history to write", path=path)
    names = list(dict.fromkeys(name for response in responses for name in response.to_columns()))
    header = ["component", *names, "phase"]
    write_by_record(path, header, responses, lambda response: response.motion.record, lambda response: _history_rows(response, names))


def _history_rows(response: Response[Any], names: Sequence[str]) -> Iterator[Sequence[Any]]:
    """Yield the rows of a time history, a block of them made at a time."""
    columns, phase = response.to_columns(), response.phase_of_row()
    phases = np.array([phase.name for phase in response.phases] or [""])
    for begin in range(0, response.time.size, CHUNK_ROWS):
        part = slice(begin, begin + CHUNK_ROWS)
        cells = [normalize_zeros(columns[name][part]) if name in columns else [""] * phase[part].size for name in names]
        yield from zip([response.motion.name] * phase[part].size, *cells, phases[phase[part]].tolist(), strict=True)
