"""Lazily compiled kernels: complete when called from Python, unoptimised callees when used by other kernels."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from seisblock.core._signals import defer_interrupt


class LazyKernel:
    """Wrapper that replaces the function of a kernel and compiles it on first use.

    Most kernels are called by other kernels only and are linked into these: only the few that Python calls are written to the cache.

    Parameters
    ----------
    function : function
        Python source of the kernel.
    compile_kernel : callable
        Function that compiles the kernel or loads it from the cache.
    compile_callee : callable
        Function that compiles the kernel for linking; may return None.
    """

    def __init__(self, function: Callable[..., Any], compile_kernel: Callable[[], Any], compile_callee: Callable[[], Any]) -> None:
        self._make = compile_kernel
        self._make_part = compile_callee
        self._part: Any = None
        self._compiled: Any = None
        functools.update_wrapper(self, function)

    @property
    def compiled(self) -> Any:
        """Numba dispatcher, compiled on first access.

        There is no lock: two threads may both compile the kernel, the slower one usually from the cache of the other.
        """
        if self._compiled is None:
            with defer_interrupt():
                self._compiled = self._make()
        return self._compiled

    @property
    def _numba_type_(self) -> Any:
        """Attribute from which numba reads the type of a global used in a kernel."""
        if self._compiled is not None:
            return self._compiled._numba_type_
        if self._part is None:
            with defer_interrupt():
                self._part = self._make_part()
        return (self._part or self.compiled)._numba_type_

    def __call__(self, *arguments: Any) -> Any:
        """Call the kernel from Python."""
        return self.compiled(*arguments)

    def __reduce__(self) -> str:
        """Pickle by name; the other process compiles the kernel or loads it from the cache."""
        return str(self.__qualname__)  # type: ignore[attr-defined]
