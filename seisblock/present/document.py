"""The JSON document: one answer, SI, the unit in each key's name."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, is_dataclass
from datetime import datetime
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np

from seisblock import __version__
from seisblock.records import Record


@dataclass(frozen=True)
class Answer:
    """What a command found, before anyone decides how to show it.

    Parameters
    ----------
    command : str
    parameters : mapping
        Everything the user could have chosen, SI, unit in the key's name.
    results : sequence of mapping
        One entry per component solved, in the order asked.
    records : sequence of Record
        The records used; with several, ``results[i]["record_index"]`` says which.
    citations : sequence of str
        Keys of the papers relied on.
    warnings : sequence of str
    extra : mapping
        Further keys of the document.
    """

    command: str
    parameters: Mapping[str, Any]
    results: Sequence[Mapping[str, Any]]
    records: Sequence[Record] = ()
    citations: Sequence[str] = ()
    warnings: Sequence[str] = ()
    extra: Mapping[str, Any] = field(default_factory=dict)


def describe(record: Record) -> dict[str, Any]:
    """Return what identifies a record, for a document."""
    return {
        "station": record.station,
        "start": record.start.isoformat() if record.start else None,
        "dt_s": record.dt,
        "samples": record.samples,
        "sha256": record.sha256,
        "format": record.format,
        "source": Path(record.source).name if record.source else "",
        "components": list(record.codes),
        "offset_s": record.offset_s,
        "history": list(record.history),
    }


def document(answer: Answer) -> dict[str, Any]:
    """Return the document of an answer as plain Python values."""
    described = [describe(record) for record in answer.records]
    return plain(
        {
            "schema": f"seisblock/{answer.command}/1",
            "version": __version__,
            "record": described[0] if len(described) == 1 else (described or None),
            "parameters": answer.parameters,
            "results": answer.results,
            **answer.extra,
            "warnings": answer.warnings,
            "citations": answer.citations,
        }
    )


def to_json(answer: Answer) -> str:
    """Return the document as text; numbers keep all their digits, what is not a number is null."""
    return json.dumps(document(answer), ensure_ascii=False, indent=2, allow_nan=False)


def plain(value: Any) -> Any:
    """Return a value built of dict, list, str, int, float, bool and None alone."""
    if isinstance(value, Enum):
        return plain(value.value)
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, (float, np.floating)):
        number = float(value)
        return number if math.isfinite(number) else None
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, np.integer):
        return int(value)
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    if isinstance(value, np.ndarray):
        return [plain(entry) for entry in value.tolist()]
    if is_dataclass(value) and not isinstance(value, type):
        return plain(asdict(value))
    if isinstance(value, (Sequence, set, frozenset)):
        return [plain(entry) for entry in value]
    if isinstance(value, datetime):
        return value.isoformat()
    if isinstance(value, Path):
        return str(value)
    raise TypeError(f"no JSON form for {type(value).__name__}")
