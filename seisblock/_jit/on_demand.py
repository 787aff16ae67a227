"""A compiled kernel that is compiled where it is defined, but read from the cache only when somebody calls it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba.core.caching import FunctionCache, NullCache
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import CPUDispatcher
from numba.core.typeinfer import register_dispatcher

from seisblock._jit import cache


class OnDemand(CPUDispatcher):  # type: ignore[misc]
    """A kernel of one signature; one that is kept in the cache is read when Python calls it, or a kernel that is being compiled.

    Most kernels are called by other kernels alone, which hold their machine code already: a process that finds all of them in the
    cache reads only those few that it calls.
    """

    _declared: Any = None
    """The one signature; None in a kernel that came from another process, which brings it along compiled."""

    @classmethod
    def of(cls, function: Callable[..., Any], signature: Any, options: dict[str, Any], say: Callable[[str], None]) -> OnDemand:
        """Return a kernel, compiled or yet to be read; `options` are numba's, `say` is told what takes a while and why."""
        made = cls(function, targetoptions={"nopython": True, "boundscheck": None, **options})
        made._declared, made._say = signature, say
        if not cache.is_kept(function):
            with register_dispatcher(made):
                made._load()
        return made

    def compile(self, sig: Any) -> Any:
        """Compile, or read what an earlier process compiled; the declared signature, whatever was asked for."""
        if self._declared is None:
            return super().compile(sig)
        self._load()
        return self.overloads[self._declared.args].entry_point

    def _load(self) -> None:
        """Compile, once, with the help of the cache as far as it goes."""
        with global_compiler_lock:
            if self._can_compile and self._declared is not None:
                cache.guarded(self._compiled, self.py_func, self._say)
                self.disable_compile()

    def _compiled(self, cached: bool) -> OnDemand:
        """Compile for the declared signature, with a cache or without."""
        self._cache = FunctionCache(self.py_func) if cached else NullCache()
        super().compile(self._declared)
        return self

    def _compile_for_args(self, *args: Any, **kws: Any) -> Any:
        """Return what answers the first call from Python; arguments that do not fit are refused as at every later call."""
        if self._declared is None:
            return super()._compile_for_args(*args, **kws)
        entry = self.compile(self._declared)
        if not self.typingctx.install_possible_conversions([self.typeof_pyval(each) for each in args], self._declared.args):
            self._explain_matching_error(*args)
        return entry

    def _reduce_states(self) -> dict[str, Any]:
        """Travel to another process with the signature."""
        self._load()
        return dict(super()._reduce_states())
