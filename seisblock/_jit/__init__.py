"""The one place where numba options live: how a kernel is compiled, cached, passed on, and switched off."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import Any, TypeVar

from seisblock._jit import cache
from seisblock._jit.lazy import LazyKernel
from seisblock.core.i18n import N_

Function = TypeVar("Function", bound=Callable[..., Any])

on_message: Callable[[str], None] | None = None
"""Called with one line when compiling takes a while, or afresh; the command line sets it."""

on_compile: Callable[[str], AbstractContextManager[Any]] | None = None
"""Told in a word what is done to a kernel, for as long as it takes; the command line sets it."""

ENABLED = os.environ.get("NUMBA_DISABLE_JIT", "0") in ("", "0")
"""Whether kernels are compiled; ``NUMBA_DISABLE_JIT=1`` runs them as plain Python."""

_without_linking = False
"""Whether each kernel is compiled as a whole, since parts cannot be made."""


def types() -> Any:
    """Return numba's type names, for signatures."""
    from numba import types as numba_types

    return numba_types


def kernel(signature: Any, *, inline: bool = False, allocates: bool = False) -> Callable[[Function], Function]:
    """Compile a function for one explicit signature when it is first needed, cached, without the GIL and without ``fastmath``.

    A cache that is damaged, full or read-only costs the time of compiling afresh, and nothing else.

    Parameters
    ----------
    signature : numba signature
        Explicit, so that the kernel compiles once, caches, and can travel as a function pointer.
    inline : bool
        Ask LLVM to inline it into every caller. A call hands over each array as seven words or more: of kernels that take records
        of arrays and run at every step, eight calls cost a third of a microsecond.
    allocates : bool
        Whether it makes arrays. A kernel that does not (the default; numba then refuses ``np.zeros`` and its like) borrows its
        arguments and may slice them freely; one that does counts references, atomically and on every path, which costs a
        short kernel with branches 30 to 60 ns a call.
    """

    def decorate(function: Function) -> Function:
        if not ENABLED:
            return function

        def compile_kernel(use_cache: bool, **overrides: Any) -> Any:
            """Compile, or load what an earlier process compiled."""
            import numba

            from seisblock._jit.typing_cache import memoize_typing

            nrt_options = {} if allocates else {"_nrt": False}
            options = {"cache": use_cache, "nogil": True, "error_model": "numpy", "forceinline": inline, **nrt_options, **overrides}
            with memoize_typing():
                return numba.njit(signature, **options)(function)

        return LazyKernel(function, lambda: _compile_or_load(compile_kernel, function), lambda: _compile_callee(compile_kernel))  # type: ignore[return-value]

    return decorate


def _compile_callee(compile_kernel: Callable[..., Any]) -> Any:
    """Compile what other kernels link, and nothing to be called from Python; None where numba is not as it was from 0.60 to 0.68."""
    global _without_linking
    if _without_linking:
        return None
    try:
        from seisblock._jit.linking import CalleeCompiler

        return compile_kernel(False, pipeline_class=CalleeCompiler)
    except (ImportError, AttributeError, TypeError):
        _without_linking = True
    return None


def _compile_or_load(compile_kernel: Callable[[bool], Any], function: Callable[..., Any]) -> Any:
    """Compile a kernel, or read it, while somebody may be told which."""
    cached = cache.is_cached(function)
    activity = N_("reading the compiled kernels") if cached else N_("compiling the kernels")
    with nullcontext() if on_compile is None else on_compile(activity):
        return cache.compile_with_cache(compile_kernel, function, emit_message, cached=cached)


def emit_message(message: str) -> None:
    """Say one line to whoever listens."""
    if on_message is not None:
        on_message(message)


def function_pointer(function: Function, signature: Any) -> Function:
    """Return a kernel as a function pointer of one signature, for kernels that take functions; a kernel itself where none is compiled.

    Numba asks a kernel for its address anew at each call that takes it, 30 us each; a pointer knows it.
    """
    if not ENABLED:
        return function
    from seisblock._jit.pointers import FunctionPointer

    return FunctionPointer(function, signature)  # type: ignore[return-value]
