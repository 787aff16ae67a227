"""Memoised type inference during compilation.

Numba tries about ten templates for each ``+``, a few hundred times per kernel, for few combinations of types; without memoisation this is
a third of the compile time.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

_thread = threading.local()


@functools.cache
def _install_cache() -> None:
    """Patch numba so that function types look into the cache of the current thread first."""
    from numba import types

    original = types.Function.get_call_type

    @functools.wraps(original)
    def get_call_type(self: Any, context: Any, args: Any, kws: Any) -> Any:
        """Return the signature for argument types, from the cache if present."""
        signatures = getattr(_thread, "answers", None)
        if signatures is None:
            return original(self, context, args, kws)
        key = id(self), tuple(args), tuple(kws.items())
        if key not in signatures:
            # self is stored, too: its id stays unique only while it is alive
            signatures[key] = original(self, context, args, kws), self
        return signatures[key][0]

    types.Function.get_call_type = get_call_type


@contextmanager
def memoize_typing() -> Iterator[None]:
    """Cache numba's type inference inside the block; a nested block has its own cache."""
    _install_cache()
    previous = getattr(_thread, "answers", None)
    _thread.answers = {}
    try:
        yield
    finally:
        _thread.answers = previous
