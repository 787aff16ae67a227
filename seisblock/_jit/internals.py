"""Private parts of numba 0.61 to 0.68 for faster compilation: callees are optimised once, equal calls typed once, few passes run.

Numba optimises the library of a kernel again in each caller, and tries ten templates for each ``+``. Here callees stay LLVM modules that
are optimised in the kernel called from Python (``respond``: 11 s instead of 20 s). Typing once saves 40 % of the rest, the short list of
passes 13 %, items of arrays and loops in few instructions 16 % (``stack``: 21 %).
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import numba.np.linalg
from numba import _dynfunc
from numba.core import codegen, compiler, ir, types
from numba.core.compiler_lock import global_compiler_lock
from numba.core.compiler_machinery import register_pass
from numba.core.typed_passes import AnnotateTypes, IRLegalization, NativeLowering, NoPythonBackend, NopythonTypeInference
from numba.core.untyped_passes import FixupArgs, GenericRewrites, TranslateByteCode

from seisblock._jit.lowering import KernelLower


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
    """LLVM module for linking into kernels, neither optimised nor executable by itself."""

    def finalize(self) -> None:
        """Note the libraries to link, those of all callees, and skip linking, optimisation and code generation."""
        self._raise_if_finalized()
        linked = dict.fromkeys(self._linking_libraries)
        for library in self._linking_libraries:
            linked |= dict.fromkeys(getattr(library, "with_callees", ()))
        self.with_callees = [self, *linked]
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class KernelLowering(NativeLowering):  # type: ignore[misc]
    """Numba's lowering pass with :class:`KernelLower`."""

    _name = "kernel_lowering"

    @property
    def lowering_class(self) -> Any:
        """Class that lowers a kernel."""
        return KernelLower


@register_pass(mutates_CFG=True, analysis_only=False)
class CalleeLowering(KernelLowering):
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
        context.insert_user_function(stub, result.fndesc, state.library.with_callees)
        state["cr"] = result._replace(cfunc=stub)
        return True


@register_pass(mutates_CFG=True, analysis_only=False)
class ConstantGlobals(GenericRewrites):  # type: ignore[misc]
    """Numba's rewrites before type inference, after global numbers have become constants.

    The type of a constant, unlike that of a global, does not exclude a later assignment of another number to the variable.
    """

    _name = "constant_globals"

    def run_pass(self, state: Any) -> bool:
        """Replace the global numbers and rewrite the function."""
        for block in state.func_ir.blocks.values():
            for statement in block.find_insts(ir.Assign):
                if isinstance(statement.value, ir.Global) and isinstance(statement.value.value, int | float):
                    statement.value = ir.Const(statement.value.value, statement.value.loc)
        return bool(super().run_pass(state))


class KernelCompiler(compiler.CompilerBase):  # type: ignore[misc]
    """Numba compiler with the passes that kernels need: numba analyses the whole function again after each of its passes.

    Static single assignment, which LLVM does anyway, would multiply the variables: a variable of a kernel has one type.
    """

    lowering: Any = KernelLowering

    def define_pipelines(self) -> list[Any]:
        """Return the passes; only memory that is reference-counted needs ``IRLegalization``, which ends the life of each variable."""
        manager = compiler.PassManager("kernel")
        passes = [TranslateByteCode, FixupArgs, ConstantGlobals, NopythonTypeInference]
        passes += [IRLegalization] if self.state.flags.nrt else []
        for step in [*passes, AnnotateTypes, self.lowering, NoPythonBackend]:
            manager.add_pass(step)
        manager.finalize()
        return [manager]


class CalleeCompiler(KernelCompiler):
    """Compiler with :class:`CalleeLowering` in place of native lowering."""

    lowering = CalleeLowering


_signatures: dict[Any, Any] = {}


@contextlib.contextmanager
def fast_compilation() -> Iterator[None]:
    """Compile kernels without repeated work inside the block; other threads do not compile meanwhile.

    The types of equal calls are inferred once per process.
    """
    infer = types.Function.get_call_type

    def infer_once(self: Any, context: Any, *arguments: Any, **options: Any) -> Any:
        if options or len(arguments) != 2:  # arguments of an unknown version
            return infer(self, context, *arguments, **options)
        key = id(self), tuple(arguments[0]), tuple(arguments[1].items())
        if key not in _signatures:
            _signatures[key] = infer(self, context, *arguments), self  # the id stays unique only while the object is alive
        return _signatures[key][0]

    with global_compiler_lock:
        types.Function.get_call_type = infer_once  # type: ignore[method-assign]
        try:
            yield
        finally:
            types.Function.get_call_type = infer  # type: ignore[method-assign]
