"""Whether the program was asked to keep silent about everything but its answer."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

_quiet = False


@contextlib.contextmanager
def quiet_output(quiet: bool | None) -> Iterator[None]:
    """Keep silent inside the block when asked to; None changes nothing."""
    global _quiet
    previous = _quiet
    _quiet = previous if quiet is None else quiet
    try:
        yield
    finally:
        _quiet = previous


def is_quiet() -> bool:
    """Whether the program was asked to keep silent."""
    return _quiet
