"""Private parts of numba 0.61 to 0.68 for faster compilation: callees are optimised once, and equal calls are typed once.

Numba optimises the library of a kernel again in each caller, and tries ten templates for each ``+``. Here callees stay LLVM modules that
are optimised in the kernel called from Python (``respond``: 11 s instead of 20 s); typing once saves 15 to 25 % of the rest.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import numba.np.linalg
from numba import _dynfunc
from numba.core import codegen, compiler, types
from numba.core.compiler_lock import global_compiler_lock
from numba.core.compiler_machinery import register_pass
from numba.core.typed_passes import NativeLowering


def import_array_functions() -> None:
    """Import numba's array functions, which load all of ``scipy.linalg`` (0.2 s) only to learn that SciPy is installed.

    Functions that call BLAS check it again when they are compiled.
    """
    check = numba.np.linalg.ensure_blas
    numba.np.linalg.ensure_blas = lambda: None
    try:
        from numba.np import arraymath
    finally:
        numba.np.linalg.ensure_blas = check
    arraymath.ensure_blas = check


import_array_functions()


class UnoptimizedLibrary(codegen.JITCodeLibrary):  # type: ignore[misc]
    """LLVM module for linking into callers, neither optimised nor executable by itself."""

    def finalize(self) -> None:
        """Link the callees and skip optimisation and code generation."""
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class CalleeLowering(NativeLowering):  # type: ignore[misc]
    """Lowering pass without machine code and wrappers."""

    _name = "callee_lowering"

    def run_pass(self, state: Any) -> bool:
        """Lower a kernel and register a stub with address 0, by which numba identifies the callee."""
        context, flags = state.targetctx, state.flags
        state.library = UnoptimizedLibrary(context.codegen(), state.func_id.func_qualname)
        flags.no_compile = flags.no_cpython_wrapper = flags.no_cfunc_wrapper = True
        super().run_pass(state)
        state.library.finalize()
        result = state["cr"]
        module, name = result.fndesc.lookup_module(), result.fndesc.qualname
        stub = _dynfunc.make_function(module, name, "callee of other kernels", 0, result.env, (state.library,))
        context.insert_user_function(stub, result.fndesc, [state.library])
        state["cr"] = result._replace(cfunc=stub)
        return True


class KernelCompiler(compiler.CompilerBase):  # type: ignore[misc]
    """Numba compiler without the passes that change no kernel: after each of them numba analyses the whole function again."""

    unused = "WithLifting", "InlineInlinables", "InlineOverloads", "LiteralUnroll", "NopythonRewrites", "RewriteDynamicRaises"

    def define_pipelines(self) -> list[Any]:
        """Return numba's default passes without the unused ones."""
        manager = compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)
        manager.passes = [(self.replace(step), text) for step, text in manager.passes if step.__name__ not in self.unused]
        manager.finalize()
        return [manager]

    def replace(self, step: Any) -> Any:
        """Return the pass to be run for one of numba's."""
        return step


class CalleeCompiler(KernelCompiler):
    """Compiler with :class:`CalleeLowering` in place of native lowering."""

    def replace(self, step: Any) -> Any:
        """Return the pass to be run for one of numba's."""
        return CalleeLowering if step is NativeLowering else step


@contextlib.contextmanager
def memoize_typing() -> Iterator[None]:
    """Infer the types of equal calls once inside the block; other threads do not compile meanwhile."""
    infer, memory = types.Function.get_call_type, {}

    def infer_once(self: Any, context: Any, *arguments: Any, **options: Any) -> Any:
        if options or len(arguments) != 2:  # arguments of an unknown version
            return infer(self, context, *arguments, **options)
        key = id(self), tuple(arguments[0]), tuple(arguments[1].items())
        if key not in memory:
            memory[key] = infer(self, context, *arguments), self  # the id stays unique only while the object is alive
        return memory[key][0]

    with global_compiler_lock:
        types.Function.get_call_type = infer_once  # type: ignore[method-assign]
        try:
            yield
        finally:
            types.Function.get_call_type = infer  # type: ignore[method-assign]
