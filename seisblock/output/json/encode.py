"""JSON encoding of documents: numbers keep all digits, NaN and infinity are null."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from seisblock.output.json.schema import Document

_CONTROL_CHARACTERS = re.compile("[\x7f-\x9f\xad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb]")
"""Control characters that JSON does not escape, bidirectional and invisible ones."""


def to_json(document: Document) -> str:
    """Return a document as JSON text with control characters escaped."""
    text = msgspec.json.format(msgspec.json.encode(document, enc_hook=_encode_hook), indent=2).decode()
    return _CONTROL_CHARACTERS.sub(lambda match: json.dumps(match[0])[1:-1], text)


def to_builtins(value: Any) -> Any:
    """Return a value built of dict, list, str, int, float, bool and None only."""
    return msgspec.json.decode(msgspec.json.encode(value, enc_hook=_encode_hook))


def _encode_hook(value: Any) -> Any:
    """Return the JSON value of a message, path or NumPy number."""
    if isinstance(value, (str, Path)):
        return str(value)
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    raise NotImplementedError(f"no JSON form for {type(value).__name__}")
