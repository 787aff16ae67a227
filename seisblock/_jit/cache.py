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

from seisblock._jit.seal import is_sealed, seal_what_is_kept_in
from seisblock.errors import reason
from seisblock.words import Said, said

Compiled = TypeVar("Compiled")

KERNELS = ("_jit", "dynamics", "measures", "records", "solvers")
"""Packages that define kernels, or say how they are compiled."""

UNREADABLE = (
    *(OSError, EOFError, pickle.PickleError, ValueError, TypeError, LookupError, AttributeError),
    *(ImportError, RuntimeError, ArithmeticError, MemoryError),
)
"""What a kernel that lost or changed its bytes raises when it is read, and what a full disk does; numba's own errors are none of them."""

_given_up = False

_one_place = threading.RLock()
"""Held while numba's own settings name our place: another thread's kernels would be kept where the caller's are, or nowhere."""


def _source_digest() -> str:
    """Return a digest of every file that defines kernels.

    A cached kernel that calls a kernel of another file is not invalidated by numba when that other
    file changes; a cache directory named after all kernel sources is never stale.
    """
    root = Path(__file__).parent.parent
    # numba keys its entries by the path of the source: two installations do not share them
    digest = hashlib.sha256(f"{sys.version} {root}".encode())
    for folder in KERNELS:
        for path in sorted((root / folder).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@functools.cache
def directory() -> Path:
    """Return the directory of compiled kernels of this very source: ``SEISBLOCK_CACHE_DIR``, else the user's cache."""
    chosen = os.environ.get("SEISBLOCK_CACHE_DIR")
    if chosen:
        return Path(chosen) / _source_digest()
    import platformdirs

    return platformdirs.user_cache_path("seisblock", appauthor=False) / _source_digest()


@functools.cache
def _writable() -> bool:
    """Make the cache directory; return whether it can be written."""
    try:
        directory().mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(directory(), os.W_OK)


@functools.cache
def _once(say: Callable[[str], None], message: Said) -> None:
    """Say a line, once in a process."""
    say(message)


@contextlib.contextmanager
def _numba_keeps_in(place: Path) -> Iterator[None]:
    """Let numba cache in one place and, should that be impossible, nowhere; what the caller's own kernels use stays as it was."""
    import numba

    wanted = {"CACHE_DIR": str(place), "CACHE_LOCATOR_CLASSES": "UserProvidedCacheLocator"}
    with _one_place:
        before = {name: getattr(numba.config, name, "") for name in wanted}
        try:
            for name, value in wanted.items():
                setattr(numba.config, name, value)
            yield
        finally:
            for name, value in before.items():
                setattr(numba.config, name, value)


def guarded(compiled: Callable[[bool], Compiled], function: Callable[..., Any], say: Callable[[str], None], *, kept: bool) -> Compiled:
    """Compile one kernel with the help of the cache as far as it goes.

    Parameters
    ----------
    compiled : callable
        Told whether to use the cache; returns the compiled kernel.
    function : function
        The kernel's source.
    say : callable
        Told, once, what takes a while and why.
    kept : bool
        Whether something is kept of it.
    """
    global _given_up
    place = directory()
    if not _writable():
        _once(say, said("{place}: cannot be written: compiling afresh; SEISBLOCK_CACHE_DIR names another folder", place=str(place)))
        _given_up = True
    if _given_up:
        return compiled(False)
    if not kept:
        _once(say, said("compiling the kernels, once; seconds, for the largest half a minute..."))
    with _numba_keeps_in(place):
        try:
            if seal_what_is_kept_in(place):
                _check(cast(FunctionType, function))
            return compiled(True)
        except UNREADABLE as error:
            why = reason(error) if isinstance(error, OSError) and error.strerror else said("a damaged kernel")
            _once(say, said("{place}: {why}: compiling afresh what cannot be read or kept there", place=str(place), why=why))
        try:
            _remove(cast(FunctionType, function))
            return compiled(True)
        except UNREADABLE:
            _given_up = True
    return compiled(False)


def is_kept(function: Callable[..., Any]) -> bool:
    """Whether something is kept of a kernel."""
    return any(True for _ in _files(cast(FunctionType, function)))


def _check(function: FunctionType) -> None:
    """Refuse to read a kernel whose bytes are not those that were written: it would be run."""
    if not all(is_sealed(path) for path in _files(function)):
        raise ValueError("a digest does not hold")


def _remove(function: FunctionType) -> None:
    """Remove what is kept of one kernel."""
    for path in _files(function):
        path.unlink(missing_ok=True)


def _files(function: FunctionType) -> Iterator[Path]:
    """Return the files of one kernel."""
    stem = f"{Path(function.__code__.co_filename).stem}.{function.__qualname__}-{function.__code__.co_firstlineno}"
    return directory().glob(f"*/{stem}.*.nb[ci]")  # numba makes a folder for each of ours, and nothing below it
