"""Memory that a decoder in C has freed, given back to the system."""

from __future__ import annotations

import ctypes
import sys


def trim_heap() -> None:
    """Let go of what is free within the heap, where its library can (glibc).

    A decoder takes a file apart into many small blocks. Freed, they stay with the process as long as anything lies above them, twelve
    bytes of each sample of three components, and whatever is large is then taken from the system besides.

    Examples
    --------
    >>> trim_heap()
    """
    if sys.platform == "linux" and (malloc_trim := getattr(ctypes.CDLL(None), "malloc_trim", None)) is not None:
        malloc_trim(0)
