"""Printed list of references."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rich.padding import Padding

from seisblock.output.text.tables import styled_line
from seisblock.references.reference import Reference


def reference_lines(references: Sequence[Reference]) -> Iterator[Any]:
    """Yield the key of each reference with the reference indented below it."""
    for reference in references:
        yield styled_line(f"[{reference.key}]", "bold")
        yield Padding(styled_line(reference.text()), (0, 0, 0, 2))
