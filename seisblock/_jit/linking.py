"""Kernels that only other kernels call: compiled as parts of these.

Numba makes a library of each kernel, optimised, with machine code, and with wrappers by which Python and C call it. A kernel that calls it
links that library, optimises it once more and makes machine code of it once more, at each depth. A part has what its callers link and
nothing else: all is optimised once, in the kernel that Python calls.
"""

from __future__ import annotations

from typing import Any

from numba import _dynfunc
from numba.core import codegen, compiler
from numba.core.compiler_machinery import register_pass
from numba.core.typed_passes import NativeLowering


class UnoptimizedLibrary(codegen.JITCodeLibrary):  # type: ignore[misc]
    """Code that others link; it is neither optimised as a whole nor run."""

    def finalize(self) -> None:
        """Link what it calls, and leave it at that."""
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class CalleeLowering(NativeLowering):  # type: ignore[misc]
    """Write the code of a part, and nothing by which it could be run."""

    _name = "part_lowering"

    def run_pass(self, state: Any) -> bool:
        """Lower a kernel; numba's functions know it by a function without an address, which nobody calls."""
        context, flags = state.targetctx, state.flags
        state.library = UnoptimizedLibrary(context.codegen(), state.func_id.func_qualname)
        flags.no_compile = flags.no_cpython_wrapper = flags.no_cfunc_wrapper = True
        super().run_pass(state)
        state.library.finalize()
        result = state["cr"]
        module, name = result.fndesc.lookup_module(), result.fndesc.qualname
        stub = _dynfunc.make_function(module, name, "a part of other kernels", 0, result.env, (state.library,))
        context.insert_user_function(stub, result.fndesc, [state.library])
        state["cr"] = result._replace(cfunc=stub)
        return True


class CalleeCompiler(compiler.CompilerBase):  # type: ignore[misc]
    """Numba's compiler with its last step but one exchanged."""

    def define_pipelines(self) -> list[Any]:
        """Return numba's passes."""
        manager = compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)
        manager.passes = [
            (CalleeLowering if compiler_pass is NativeLowering else compiler_pass, description)
            for compiler_pass, description in manager.passes
        ]
        manager.finalize()
        return [manager]
