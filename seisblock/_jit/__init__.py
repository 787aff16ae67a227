"""Compilation of kernels with numba: options, on-disk cache, function pointers and the switch to plain Python."""

from __future__ import annotations

import contextlib
import functools
import os
from collections.abc import Callable
from typing import Any, TypeVar

from seisblock._jit import cache
from seisblock.core._signals import defer_interrupt

Function = TypeVar("Function", bound=Callable[..., Any])

ENABLED = os.environ.get("NUMBA_DISABLE_JIT", "0") in ("", "0")
"""True if kernels are compiled; ``NUMBA_DISABLE_JIT=1`` runs them as plain Python."""


def types() -> Any:
    """Return numba's type names, for signatures."""
    from numba import types as numba_types

    return numba_types


def kernel(signature: Any, *, inline: bool = False) -> Callable[[Function], Function]:
    """Compile a function on first use for one explicit signature, cached, without the GIL and without ``fastmath``.

    `inline` has LLVM inline the kernel into its callers (``stack``: 10 % faster, many blocks of ``rock``: a third). A kernel creates no
    arrays: references are not counted, which would cost a short kernel 30 to 60 ns per call.
    """
    # error_model numpy: division by zero gives inf or NaN, without a test at each division
    options = {"nogil": True, "error_model": "numpy", "forceinline": inline, "_nrt": False}
    return lambda function: LazyKernel(function, signature, options) if ENABLED else function  # type: ignore[return-value]


class LazyKernel:
    """Kernel compiled on first use: complete and cached if Python calls it, an unoptimised callee if only other kernels do."""

    def __init__(self, function: Callable[..., Any], signature: Any, options: dict[str, Any]) -> None:
        functools.update_wrapper(self, function)
        self._function, self._signature, self._options = function, signature, options
        self._callee: Any = None
        self._compiled: Any = None
        self._exported: Any = None

    def _compile(self, **options: Any) -> Any:
        import numba

        internals = _internals()
        if internals:
            options = {"pipeline_class": internals.KernelCompiler} | options
        with defer_interrupt(), internals.fast_compilation() if internals else contextlib.nullcontext():
            return numba.njit(self._signature, **self._options, **options)(self._function)

    @property
    def compiled(self) -> Any:
        """Numba dispatcher for calls from Python, compiled on first access, by one thread."""
        if self._compiled is None:
            with _lock():
                self._compiled = self._compiled or cache.load_or_compile(
                    functools.partial(self._compile, no_cfunc_wrapper=True), self._function
                )
        return self._compiled

    @property
    def exported(self) -> Any:
        """Numba dispatcher for calls by pointer only, without the code that converts arguments from Python."""
        if self._exported is None:
            with _lock():
                self._exported = self._exported or cache.load_or_compile(
                    functools.partial(self._compile, no_cpython_wrapper=True), self._function, "pointer"
                )
        return self._exported

    @property
    def _numba_type_(self) -> Any:
        """Attribute from which numba reads the type of a global used in a kernel."""
        if self._compiled is None and self._callee is None and _internals():
            self._callee = self._compile(pipeline_class=_internals().CalleeCompiler)
        return (self._compiled or self._callee or self.compiled)._numba_type_

    def __call__(self, *arguments: Any) -> Any:
        """Call the kernel from Python."""
        return self.compiled(*arguments)

    def __reduce__(self) -> str:
        """Pickle by name; the other process compiles the kernel or loads it from the cache."""
        return self._function.__qualname__


def _lock() -> Any:
    """Return the lock under which numba compiles."""
    from numba.core.compiler_lock import global_compiler_lock

    return global_compiler_lock


def _internals() -> Any:
    """Return the module that uses private parts of numba; None for a version with which it has not been tested."""
    import numba

    if (0, 62) <= numba.version_info.short < (0, 69):
        from seisblock._jit import internals

        return internals
    return None


def function_pointer(function: Function, signature: Any, *, is_called: bool = True) -> Function:
    """Return a kernel as a function pointer of one signature, compiled if it is called; or the function itself without the JIT."""
    if not ENABLED:
        return function
    from seisblock._jit.pointers import FunctionPointer

    return FunctionPointer(function, signature, is_called)  # type: ignore[return-value]
