"""Verbosity state: ``--quiet``."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

_quiet = False


@contextlib.contextmanager
def quiet_output(quiet: bool | None) -> Iterator[None]:
    """Set quiet mode inside the context; None keeps the current mode."""
    global _quiet
    previous = _quiet
    _quiet = previous if quiet is None else quiet
    try:
        yield
    finally:
        _quiet = previous


def is_quiet() -> bool:
    """Return whether ``--quiet`` is on."""
    return _quiet
