"""A document as text: numbers keep all their digits, what is not a number is null."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from seisblock.present.documents.kind import Document


def to_json(document: Document) -> str:
    """Return a document as text."""
    return msgspec.json.format(msgspec.json.encode(document, enc_hook=_foreign), indent=2).decode()


def plain(value: Any) -> Any:
    """Return a value as a reader of the document finds it: built of dict, list, str, int, float, bool and None alone."""
    return msgspec.json.decode(msgspec.json.encode(value, enc_hook=_foreign))


def _foreign(value: Any) -> Any:
    """Return what JSON has for a value of another kind: a text that remembers its template, a path, numpy's numbers."""
    if isinstance(value, (str, Path)):
        return str(value)
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    raise NotImplementedError(f"no JSON form for {type(value).__name__}")
