"""Where compiled kernels are kept between processes, and what happens when they cannot be."""

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
"""Packages that define kernels, or say how they are compiled."""

CACHE_ERRORS = (
    *(OSError, EOFError, pickle.PickleError, ValueError, TypeError, LookupError, AttributeError),
    *(ImportError, RuntimeError, ArithmeticError, MemoryError),
)
"""What a kernel that lost or changed its bytes raises when it is read, and what a full disk does; numba's own errors are none of them."""

_disabled = False

_config_lock = threading.RLock()
"""Held while numba's own settings name our place: another thread's kernels would be kept where the caller's are, or nowhere."""


def _source_digest() -> str:
    """Return a digest of every file that defines kernels.

    A cached kernel that calls a kernel of another file is not invalidated by numba when that other
    file changes; a cache directory named after all kernel sources is never stale.
    """
    root = Path(__file__).parent.parent
    # numba keys its entries by the path of the source: two installations do not share them
    digest = hashlib.sha256(f"{sys.version} {root}".encode())
    for folder in KERNEL_PACKAGES:
        for path in sorted((root / folder).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@functools.cache
def cache_directory() -> Path:
    """Return the directory of compiled kernels of this very source: ``SEISBLOCK_CACHE_DIR``, else the user's cache."""
    override = os.environ.get("SEISBLOCK_CACHE_DIR")
    if override:
        return Path(override) / _source_digest()
    import platformdirs

    return platformdirs.user_cache_path("seisblock", appauthor=False) / _source_digest()


@functools.cache
def _writable() -> bool:
    """Make the cache directory; return whether it can be written."""
    try:
        cache_directory().mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(cache_directory(), os.W_OK)


@functools.cache
def _emit_once(emit: Callable[[str], None], message: Message) -> None:
    """Say a line, once in a process."""
    emit(message)


@contextlib.contextmanager
def _numba_cache_dir(folder: Path) -> Iterator[None]:
    """Let numba cache in one place and, should that be impossible, nowhere; what the caller's own kernels use stays as it was."""
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
    """Compile one kernel with the help of the cache as far as it goes.

    Parameters
    ----------
    compile_kernel : callable
        Told whether to use the cache; returns the compiled kernel.
    function : function
        The kernel's source.
    emit : callable
        Told, once, what takes a while and why.
    cached : bool
        Whether something is kept of it.
    """
    global _disabled
    folder = cache_directory()
    if not _writable():
        _emit_once(
            emit, lazy_gettext("{place}: cannot be written: compiling afresh; SEISBLOCK_CACHE_DIR names another folder", place=str(folder))
        )
        _disabled = True
    if _disabled:
        return compile_kernel(False)
    if not cached:
        _emit_once(emit, lazy_gettext("compiling the kernels, once; seconds, for the largest half a minute..."))
    with _numba_cache_dir(folder):
        try:
            if enable_checksums(folder):
                _verify_checksums(cast(FunctionType, function))
            return compile_kernel(True)
        except CACHE_ERRORS as error:
            cause = os_error_text(error) if isinstance(error, OSError) and error.strerror else lazy_gettext("a damaged kernel")
            _emit_once(
                emit, lazy_gettext("{place}: {why}: compiling afresh what cannot be read or kept there", place=str(folder), why=cause)
            )
        try:
            _remove_cached(cast(FunctionType, function))
            return compile_kernel(True)
        except CACHE_ERRORS:
            _disabled = True
    return compile_kernel(False)


def is_cached(function: Callable[..., Any]) -> bool:
    """Whether something is kept of a kernel."""
    return any(True for _ in _cached_files(cast(FunctionType, function)))


def _verify_checksums(function: FunctionType) -> None:
    """Refuse to read a kernel whose bytes are not those that were written: it would be run."""
    if not all(has_valid_checksum(path) for path in _cached_files(function)):
        raise ValueError("a digest does not hold")


def _remove_cached(function: FunctionType) -> None:
    """Remove what is kept of one kernel."""
    for path in _cached_files(function):
        path.unlink(missing_ok=True)


def _cached_files(function: FunctionType) -> Iterator[Path]:
    """Return the files of one kernel."""
    stem = f"{Path(function.__code__.co_filename).stem}.{function.__qualname__}-{function.__code__.co_firstlineno}"
    return cache_directory().glob(f"*/{stem}.*.nb[ci]")  # numba makes a folder for each of ours, and nothing below it
