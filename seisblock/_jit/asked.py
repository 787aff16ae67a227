"""What numba asks of its functions' types while it compiles one kernel, asked once.

For each ``+`` numba tries some ten templates, for each kernel a few hundred times, at few combinations of types: a third of compiling.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

_here = threading.local()


@functools.cache
def _ask_once() -> None:
    """Let numba's functions look first into what was answered, wherever this thread keeps that."""
    from numba import types

    answer = types.Function.get_call_type

    @functools.wraps(answer)
    def get_call_type(self: Any, context: Any, args: Any, kws: Any) -> Any:
        """Return the signature for types of arguments; what numba keeps in the function itself, it kept the first time."""
        answers = getattr(_here, "answers", None)
        if answers is None:
            return answer(self, context, args, kws)
        question = id(self), tuple(args), tuple(kws.items())
        if question not in answers:
            answers[question] = answer(self, context, args, kws), self  # which must live for its id to be its own
        return answers[question][0]

    types.Function.get_call_type = get_call_type


@contextmanager
def asked_once() -> Iterator[None]:
    """Keep numba's answers while one kernel is compiled; one within it has its own."""
    _ask_once()
    before = getattr(_here, "answers", None)
    _here.answers = {}
    try:
        yield
    finally:
        _here.answers = before
