"""Digests at the end of what is kept of a kernel: machine code that changed on the disk is not run.

Numba reads its files as pickles, which end by themselves, so that what stands behind them disturbs nobody.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

DIGEST_SIZE = hashlib.sha256().digest_size
"""Bytes of a digest."""


@functools.cache
def enable_checksums(folder: Path) -> bool:
    """Let numba end each file that it keeps below a folder with a digest of it, from now on.

    Returns
    -------
    bool
        Whether it does; not where numba writes its files otherwise than it did from 0.60 to 0.68.
    """
    from numba.core import caching

    cache_file: Any = caching.IndexDataCacheFile
    open_for_write = getattr(cache_file, "_open_for_write", None)
    if open_for_write is None:
        return False

    @contextlib.contextmanager
    def open_with_checksum(self: Any, path: str) -> Iterator[Any]:
        """Write a file, with its digest behind it if it is one of ours."""
        with open_for_write(self, path) as stream:
            if not Path(path).is_relative_to(folder):
                yield stream
                return
            content = io.BytesIO()
            yield content
            stream.write(content.getvalue())
            stream.write(hashlib.sha256(content.getvalue()).digest())

    cache_file._open_for_write = open_with_checksum
    return True


def has_valid_checksum(path: Path) -> bool:
    """Whether a file ends with its own digest; one that is gone meanwhile does no harm."""
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        return True
    return hashlib.sha256(data[:-DIGEST_SIZE]).digest() == data[-DIGEST_SIZE:]
