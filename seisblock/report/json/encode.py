"""A document as text: numbers keep all their digits, what is not a number is null."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from seisblock.report.json.schema import Document

_CONTROL_CHARACTERS = re.compile("[\x7f-\x9f\xad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb]")
"""Control characters that JSON leaves as they are, and those that turn lines around or cannot be seen."""


def to_json(document: Document) -> str:
    """Return a document as text, in which no text of a file commands the terminal that it may be printed on."""
    text = msgspec.json.format(msgspec.json.encode(document, enc_hook=_encode_hook), indent=2).decode()
    return _CONTROL_CHARACTERS.sub(lambda match: json.dumps(match[0])[1:-1], text)


def to_builtins(value: Any) -> Any:
    """Return a value as a reader of the document finds it: built of dict, list, str, int, float, bool and None alone."""
    return msgspec.json.decode(msgspec.json.encode(value, enc_hook=_encode_hook))


def _encode_hook(value: Any) -> Any:
    """Return what JSON has for a value of another kind: a text that remembers its template, a path, numpy's numbers."""
    if isinstance(value, (str, Path)):
        return str(value)
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    raise NotImplementedError(f"no JSON form for {type(value).__name__}")
