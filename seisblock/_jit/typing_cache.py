"""What numba asks of its functions' types while it compiles one kernel, asked once.

For each ``+`` numba tries some ten templates, for each kernel a few hundred times, at few combinations of types: a third of compiling.
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
    """Let numba's functions look first into what was answered, wherever this thread keeps that."""
    from numba import types

    original = types.Function.get_call_type

    @functools.wraps(original)
    def get_call_type(self: Any, context: Any, args: Any, kws: Any) -> Any:
        """Return the signature for types of arguments; what numba keeps in the function itself, it kept the first time."""
        signatures = getattr(_thread, "answers", None)
        if signatures is None:
            return original(self, context, args, kws)
        key = id(self), tuple(args), tuple(kws.items())
        if key not in signatures:
            signatures[key] = original(self, context, args, kws), self  # which must live for its id to be its own
        return signatures[key][0]

    types.Function.get_call_type = get_call_type


@contextmanager
def memoize_typing() -> Iterator[None]:
    """Keep numba's answers while one kernel is compiled; one within it has its own."""
    _install_cache()
    previous = getattr(_thread, "answers", None)
    _thread.answers = {}
    try:
        yield
    finally:
        _thread.answers = previous
