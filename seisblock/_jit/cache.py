"""On-disk cache of compiled kernels, with fallback to recompilation."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import pickle
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FunctionType
from typing import Any, TypeVar, cast

from seisblock._jit.checksum import enable_checksums, has_valid_checksum
from seisblock.core.errors import os_error_text
from seisblock.core.i18n import Message, lazy_gettext

Compiled = TypeVar("Compiled")

KERNEL_PACKAGES = ("_jit", "dynamics", "measures", "records", "models")
"""Subpackages that define kernels or their compilation options."""

CACHE_ERRORS = (
    *(OSError, EOFError, pickle.PickleError, ValueError, TypeError, LookupError, AttributeError),
    *(ImportError, RuntimeError, ArithmeticError, MemoryError),
)
"""Exceptions raised while loading a damaged cache file or writing to a full disk; numba's own errors are not among them."""

_disabled = False

_config_lock = threading.RLock()
"""Lock held while ``numba.config.CACHE_DIR`` points at this package's folder, because the setting is global to the process."""


def _source_digest() -> str:
    """Return a digest of every file that defines kernels.

    Numba does not invalidate a cached kernel when a kernel in another file that it calls changes. A cache folder named after the digest
    of all kernel sources is never stale.
    """
    root = Path(__file__).parent.parent
    # numba's cache keys contain the source path: two installations cannot share entries
    digest = hashlib.sha256(f"{sys.version} {root}".encode())
    for folder in KERNEL_PACKAGES:
        for path in sorted((root / folder).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@functools.cache
def cache_directory() -> Path:
    """Return the cache folder of this version of the sources, below ``SEISBLOCK_CACHE_DIR`` or the user's cache folder."""
    override = os.environ.get("SEISBLOCK_CACHE_DIR")
    if override:
        return Path(override) / _source_digest()
    import platformdirs

    return platformdirs.user_cache_path("seisblock", appauthor=False) / _source_digest()


@functools.cache
def _writable() -> bool:
    """Create the cache folder; return True if it is writable."""
    try:
        cache_directory().mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(cache_directory(), os.W_OK)


@functools.cache
def _emit_once(emit: Callable[[str], None], message: Message) -> None:
    """Emit a message once per process."""
    emit(message)


@contextlib.contextmanager
def _numba_cache_dir(folder: Path) -> Iterator[None]:
    """Point numba's cache at a folder inside the block and restore the previous settings, which the user's own kernels need."""
    import numba

    settings = {"CACHE_DIR": str(folder), "CACHE_LOCATOR_CLASSES": "UserProvidedCacheLocator"}
    with _config_lock:
        previous = {name: getattr(numba.config, name, "") for name in settings}
        try:
            for name, value in settings.items():
                setattr(numba.config, name, value)
            yield
        finally:
            for name, value in previous.items():
                setattr(numba.config, name, value)


def compile_with_cache(
    compile_kernel: Callable[[bool], Compiled], function: Callable[..., Any], emit: Callable[[str], None], *, cached: bool
) -> Compiled:
    """Compile one kernel, using the cache as far as it works.

    Parameters
    ----------
    compile_kernel : callable
        Function of a flag (use the cache or not) that returns the compiled kernel.
    function : function
        Python source of the kernel.
    emit : callable
        Callback for messages about slow or repeated compilation, each issued once per process.
    cached : bool
        True if the cache holds files of the kernel.
    """
    global _disabled
    folder = cache_directory()
    if not _writable():
        _emit_once(
            emit,
            lazy_gettext(
                "the kernel cache {place} is not writable: kernels are compiled in every run; set SEISBLOCK_CACHE_DIR to a writable folder",
                place=str(folder),
            ),
        )
        _disabled = True
    if _disabled:
        return compile_kernel(False)
    if not cached:
        _emit_once(emit, lazy_gettext("compiling kernels (first run only, up to 30 s)..."))
    with _numba_cache_dir(folder):
        try:
            if enable_checksums(folder):
                _verify_checksums(cast(FunctionType, function))
            return compile_kernel(True)
        except CACHE_ERRORS as error:
            cause = os_error_text(error) if isinstance(error, OSError) and error.strerror else lazy_gettext("damaged file")
            _emit_once(
                emit, lazy_gettext("kernel cache {place}: {why}; the affected kernels are compiled again", place=str(folder), why=cause)
            )
        try:
            # without the damaged files; on a full disk this fails again, and the cache is given up
            _remove_cached(cast(FunctionType, function))
            return compile_kernel(True)
        except CACHE_ERRORS:
            _disabled = True
    return compile_kernel(False)


def is_cached(function: Callable[..., Any]) -> bool:
    """Return True if the cache holds files of a kernel."""
    return any(True for _ in _cached_files(cast(FunctionType, function)))


def _verify_checksums(function: FunctionType) -> None:
    """Raise ValueError if a cache file was changed: its machine code must not be executed."""
    if not all(has_valid_checksum(path) for path in _cached_files(function)):
        raise ValueError("checksum mismatch")


def _remove_cached(function: FunctionType) -> None:
    for path in _cached_files(function):
        path.unlink(missing_ok=True)


def _cached_files(function: FunctionType) -> Iterator[Path]:
    """Yield the cache files of one kernel."""
    # numba names its files after source file, function and first line
    stem = f"{Path(function.__code__.co_filename).stem}.{function.__qualname__}-{function.__code__.co_firstlineno}"
    # numba creates one subfolder per source folder
    return cache_directory().glob(f"*/{stem}.*.nb[ci]")
