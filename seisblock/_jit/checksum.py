"""SHA-256 digests appended to numba's cache files, so that altered machine code is not executed.

Numba reads its cache files as pickles, which mark their own end; trailing bytes are ignored.
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
"""Length of a digest, bytes."""


@functools.cache
def enable_checksums(folder: Path) -> bool:
    """Patch numba so that it appends a digest to each cache file below a folder.

    Returns
    -------
    bool
        True if the patch is installed; False if numba's internals differ from those of 0.60 to 0.68.
    """
    from numba.core import caching

    cache_file: Any = caching.IndexDataCacheFile
    open_for_write = getattr(cache_file, "_open_for_write", None)
    if open_for_write is None:
        return False

    @contextlib.contextmanager
    def open_with_checksum(self: Any, path: str) -> Iterator[Any]:
        """Open a file for writing; append the digest if it lies below the folder."""
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
    """Return True if a file ends with its digest, or no longer exists."""
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        return True
    # a file without a digest, written by an unpatched numba, is not valid either
    return hashlib.sha256(data[:-DIGEST_SIZE]).digest() == data[-DIGEST_SIZE:]
