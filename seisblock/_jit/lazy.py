"""A kernel that is compiled, or read from the cache, when somebody first needs it: as a whole for Python, as a part for other kernels."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from seisblock.core._signals import defer_interrupt


class LazyKernel:
    """A kernel in the place of its function: Python calls it, and kernels that name it call what it holds.

    Most kernels are called by other kernels alone, whose machine code holds theirs: only the few that Python calls are kept, and read.

    Parameters
    ----------
    function : function
        The kernel's source.
    compile_kernel : callable
        Compiles it, or reads it from the cache.
    compile_callee : callable
        Compiles what other kernels link; may return None.
    """

    def __init__(self, function: Callable[..., Any], compile_kernel: Callable[[], Any], compile_callee: Callable[[], Any]) -> None:
        self._make = compile_kernel
        self._make_part = compile_callee
        self._part: Any = None
        self._compiled: Any = None
        functools.update_wrapper(self, function)

    @property
    def compiled(self) -> Any:
        """Numba's dispatcher.

        Nothing is locked to see whether it was made: two threads may both make it, one of them from what the other one kept.
        """
        if self._compiled is None:
            with defer_interrupt():
                self._compiled = self._make()
        return self._compiled

    @property
    def _numba_type_(self) -> Any:
        """The attribute by which numba learns the type of what a kernel names."""
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
        """Travel to another process by name; it is compiled, or read, there."""
        return str(self.__qualname__)  # type: ignore[attr-defined]
