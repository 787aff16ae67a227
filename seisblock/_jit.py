"""The one place where numba options live: how a kernel is compiled, cached, and switched off."""

from __future__ import annotations

import functools
import hashlib
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])

announce: Callable[[str], None] | None = None
"""Called once with one line before a first compilation; the command line sets it."""

ENABLED = os.environ.get("NUMBA_DISABLE_JIT", "0") in ("", "0")
"""Whether kernels are compiled; ``NUMBA_DISABLE_JIT=1`` runs them as plain Python."""


def _source_digest() -> str:
    """Return a digest of every file that defines kernels.

    A cached kernel that calls a kernel of another file is not invalidated by numba when that other
    file changes; a cache directory named after all kernel sources is never stale.
    """
    root = Path(__file__).parent
    # numba keys its entries by the path of the source: two installations do not share them
    digest = hashlib.sha256(f"{sys.version} {root}".encode())
    for folder in ("dynamics", "measures", "solvers"):
        for path in sorted((root / folder).rglob("*.py")):
            digest.update(path.read_bytes())
    digest.update(Path(__file__).read_bytes())
    return digest.hexdigest()[:16]


@functools.cache
def cache_directory() -> Path:
    """Return the directory of compiled kernels of this very source: ``SEISBLOCK_CACHE_DIR``, else the user's cache."""
    chosen = os.environ.get("SEISBLOCK_CACHE_DIR")
    if chosen:
        base = Path(chosen)
    elif sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA", Path.home())) / "seisblock"
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches" / "seisblock"
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "seisblock"
    return base / _source_digest()


@functools.cache
def _cache_is_usable() -> bool:
    """Make the cache directory; return whether it can be written."""
    directory = cache_directory()
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    if not os.access(directory, os.W_OK):
        return False
    if announce is not None and not any(directory.rglob("*.nbi")):
        announce("compiling the kernels, once; a few seconds...")
    return True


def types() -> Any:
    """Return numba's type names, for signatures."""
    from numba import types as numba_types

    return numba_types


def kernel(signature: Any, *, inline: bool = False, allocates: bool = False) -> Callable[[Function], Function]:
    """Compile a function for one explicit signature, cached, without the GIL and without ``fastmath``.

    Parameters
    ----------
    signature : numba signature
        Explicit, so that the kernel compiles once, caches, and can travel as a function pointer.
    inline : bool
        Ask LLVM to inline it into every caller.
    allocates : bool
        Whether it makes arrays. A kernel that does not (the default; numba then refuses ``np.zeros`` and its like) borrows its
        arguments and may slice them freely; one that does counts references, atomically and on every path, which costs a
        short kernel with branches 30 to 60 ns a call.
    """

    def decorate(function: Function) -> Function:
        if not ENABLED:
            return function
        import numba

        # numba asks where to cache while it decorates; what the caller's own kernels use stays as it was
        before = numba.config.CACHE_DIR
        cache = _cache_is_usable()
        numba.config.CACHE_DIR = str(cache_directory()) if cache else before
        try:
            counting = {} if allocates else {"_nrt": False}
            compiled = numba.njit(signature, cache=cache, nogil=True, error_model="numpy", forceinline=inline, **counting)
            return compiled(function)  # type: ignore[no-any-return]
        finally:
            numba.config.CACHE_DIR = before

    return decorate
