"""Compilation of kernels with numba: options, on-disk cache, function pointers and the switch to plain Python."""

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
"""Callback for one-line messages about slow or repeated compilation; set by the command line."""

on_compile: Callable[[str], AbstractContextManager[Any]] | None = None
"""Callback that returns a context manager active during compilation or loading of a kernel; set by the command line."""

ENABLED = os.environ.get("NUMBA_DISABLE_JIT", "0") in ("", "0")
"""True if kernels are compiled; ``NUMBA_DISABLE_JIT=1`` runs them as plain Python."""

_without_linking = False
"""True if callees are compiled as complete kernels, because numba lacks what :mod:`seisblock._jit.linking` needs."""


def types() -> Any:
    """Return numba's type names, for signatures."""
    from numba import types as numba_types

    return numba_types


def kernel(signature: Any, *, inline: bool = False, allocates: bool = False) -> Callable[[Function], Function]:
    """Compile a function on first use for one explicit signature, cached, without the GIL and without ``fastmath``.

    A damaged, full or read-only cache causes recompilation and has no other effect.

    Parameters
    ----------
    signature : numba signature
        Signature; being explicit, it lets the kernel be compiled once, cached and passed as a function pointer.
    inline : bool
        Ask LLVM to inline the kernel into every caller. An array is passed as seven words or more: eight calls of kernels that take
        named tuples of arrays cost 0.3 us per step.
    allocates : bool
        True if the kernel creates arrays. Otherwise (the default) numba rejects ``np.zeros`` and the like, and slices need no reference
        counting, which is atomic and costs a short kernel with branches 30 to 60 ns per call.
    """

    def decorate(function: Function) -> Function:
        if not ENABLED:
            return function

        def compile_kernel(use_cache: bool, **overrides: Any) -> Any:
            """Compile the kernel or load it from numba's cache."""
            import numba

            from seisblock._jit.typing_cache import memoize_typing

            nrt_options = {} if allocates else {"_nrt": False}
            # error_model numpy: division by zero gives inf or NaN, without a test at each division
            options = {"cache": use_cache, "nogil": True, "error_model": "numpy", "forceinline": inline, **nrt_options, **overrides}
            with memoize_typing():
                return numba.njit(signature, **options)(function)

        return LazyKernel(function, lambda: _compile_or_load(compile_kernel, function), lambda: _compile_callee(compile_kernel))  # type: ignore[return-value]

    return decorate


def _compile_callee(compile_kernel: Callable[..., Any]) -> Any:
    """Compile a kernel for linking into other kernels only; None if numba's internals differ from those of 0.60 to 0.68."""
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
    """Compile or load a kernel inside the context of :data:`on_compile`."""
    cached = cache.is_cached(function)
    activity = N_("loading compiled kernels") if cached else N_("compiling kernels")
    with nullcontext() if on_compile is None else on_compile(activity):
        return cache.compile_with_cache(compile_kernel, function, emit_message, cached=cached)


def emit_message(message: str) -> None:
    """Pass a message to :data:`on_message`."""
    if on_message is not None:
        on_message(message)


def function_pointer(function: Function, signature: Any) -> Function:
    """Return a kernel as a function pointer of one signature, or the function itself if kernels are not compiled.

    Numba looks up the address of a dispatcher at each call that takes it as an argument, 30 us each; the pointer stores the address.
    """
    if not ENABLED:
        return function
    from seisblock._jit.pointers import FunctionPointer

    return FunctionPointer(function, signature)  # type: ignore[return-value]
