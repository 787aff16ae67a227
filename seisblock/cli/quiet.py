"""Whether the program was asked to keep silent about everything but its answer."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

_quiet = False


@contextlib.contextmanager
def quietly(quiet: bool | None) -> Iterator[None]:
    """Keep silent inside the block when asked to; None changes nothing."""
    global _quiet
    before = _quiet
    _quiet = before if quiet is None else quiet
    try:
        yield
    finally:
        _quiet = before


def is_quiet() -> bool:
    """Whether the program was asked to keep silent."""
    return _quiet
