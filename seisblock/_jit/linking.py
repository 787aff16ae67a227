"""Callees as unoptimised LLVM modules, optimised once in the entry kernel.

Numba builds an optimised library of each kernel, with machine code and wrappers for Python and C. A caller links that library, optimises
it again and generates its machine code again, at each level of the call tree. Callees compiled here hold the LLVM module only, so that
all code is optimised once, in the kernel called from Python. Compile time of the ``respond`` kernels: 11 s instead of 20 s.
"""

from __future__ import annotations

from typing import Any

from numba import _dynfunc
from numba.core import codegen, compiler
from numba.core.compiler_machinery import register_pass
from numba.core.typed_passes import NativeLowering


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

    _name = "part_lowering"

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


class CalleeCompiler(compiler.CompilerBase):  # type: ignore[misc]
    """Numba compiler with :class:`CalleeLowering` in place of native lowering."""

    def define_pipelines(self) -> list[Any]:
        """Return numba's default passes with the lowering replaced."""
        manager = compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)
        manager.passes = [
            (CalleeLowering if compiler_pass is NativeLowering else compiler_pass, description)
            for compiler_pass, description in manager.passes
        ]
        manager.finalize()
        return [manager]
