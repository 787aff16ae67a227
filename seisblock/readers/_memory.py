"""Return of freed heap memory to the operating system."""

from __future__ import annotations

import ctypes
import sys


def trim_heap() -> None:
    """Call `malloc_trim(0)` on glibc.

    A decoder allocates many small blocks. Freed, they stay with the process as long as later blocks are in use (twelve bytes per sample of
    three components), while large arrays are allocated in addition.

    Examples
    --------
    >>> trim_heap()
    """
    if sys.platform == "linux" and (malloc_trim := getattr(ctypes.CDLL(None), "malloc_trim", None)) is not None:
        malloc_trim(0)
