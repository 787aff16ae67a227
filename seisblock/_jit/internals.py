"""Private parts of numba 0.62 to 0.68 for faster compilation: callees are optimised once, equal calls typed once, few passes run.

Numba optimises the library of a kernel again in each caller, and tries ten templates for each ``+``. Here callees stay LLVM modules that
are optimised in the kernel called from Python (``respond``: 11 s instead of 20 s). Typing once saves 40 % of the rest, the short list of
passes 13 %, items of arrays and loops in few instructions 16 % (``stack``: 21 %), whole arguments and fewer optimisations 20 %.
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterator
from typing import Any

import numba.np.linalg
from llvmlite import binding
from numba import _dynfunc
from numba.core import codegen, compiler, errors, ir, types
from numba.core.compiler_lock import global_compiler_lock
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.typed_passes import AnnotateTypes, NativeLowering, NoPythonBackend, NopythonTypeInference
from numba.core.untyped_passes import FixupArgs, TranslateByteCode

from seisblock._jit.lowering import CalleeLower, KernelLower, call_kernel


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


class KernelLibrary(codegen.JITCodeLibrary):  # type: ignore[misc]
    """Library of a kernel, optimised with fewer passes than numba's."""

    def _optimize_functions(self, module: Any) -> None:
        """Simplify each function before it is inlined into its callers; loops over a few axes are unrolled here."""
        module.data_layout = self._codegen._data_layout
        builder = self._pass_builder(1, unroll=True)
        for function in module.functions:
            if not function.is_declaration:
                builder.getFunctionPassManager().run(function, builder)

    def _optimize_final_module(self) -> None:
        """Inline and optimise; to unroll loops would take a third of the time and save none in use.

        Equal operations in a row become those of vectors, without a change of bits (``uplift``: 15 % faster, others as before).
        """
        builder = self._pass_builder(3, unroll=False)
        builder.getModulePassManager().run(self._final_module, builder)

    def _pass_builder(self, level: int, *, unroll: bool) -> Any:
        tuning = binding.create_pipeline_tuning_options(level)
        tuning.loop_unrolling, tuning.slp_vectorization = unroll, not unroll
        return binding.create_pass_builder(self._codegen._tm, tuning)


class UnoptimizedLibrary(KernelLibrary):  # type: ignore[misc]
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
    """Numba's lowering pass with :class:`KernelLower` and :class:`KernelLibrary`."""

    _name = "kernel_lowering"
    library: Any = KernelLibrary
    lowering_class: Any = KernelLower

    def run_pass(self, state: Any) -> bool:
        """Lower a kernel."""
        state.library = self.library(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return bool(super().run_pass(state))


@register_pass(mutates_CFG=True, analysis_only=False)
class CalleeLowering(KernelLowering):
    """Lowering pass without machine code and wrappers."""

    _name = "callee_lowering"
    library = UnoptimizedLibrary
    lowering_class = CalleeLower

    def run_pass(self, state: Any) -> bool:
        """Lower a kernel and register a stub with address 0, by which numba identifies the callee."""
        flags = state.flags
        flags.no_compile = flags.no_cpython_wrapper = flags.no_cfunc_wrapper = True
        super().run_pass(state)
        state.library.finalize()
        result = state["cr"]
        module, name = result.fndesc.lookup_module(), result.fndesc.qualname
        stub = _dynfunc.make_function(module, name, "callee of other kernels", 0, result.env, (state.library,))
        state.targetctx.insert_func_defn([(call_kernel(result.fndesc, state.library.with_callees), stub, result.fndesc.argtypes)])
        state["cr"] = result._replace(cfunc=stub)
        return True


@register_pass(mutates_CFG=False, analysis_only=False)
class ConstantRewrites(FunctionPass):  # type: ignore[misc]
    """Numba's rewrites of constants that kernels need: global numbers, and items at constant places.

    The type of a constant, unlike that of a global, does not exclude a later assignment of another number to the variable.
    """

    _name = "constant_rewrites"

    def __init__(self) -> None:
        FunctionPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        """Replace the statements."""
        function = state.func_ir
        bodies = [block.body for block in function.blocks.values()]
        for statement in itertools.chain(*bodies):
            value = getattr(statement, "value", None)
            if isinstance(value, ir.Global) and isinstance(value.value, int | float):
                statement.value = ir.Const(value.value, value.loc)
        for body in bodies:
            for place, statement in enumerate(body):
                item = statement.value if isinstance(statement, ir.Assign) else statement
                if isinstance(item, ir.SetItem) or (isinstance(item, ir.Expr) and item.op == "getitem"):
                    with contextlib.suppress(errors.ConstantInferenceError):
                        index = function.infer_constant(item.index)
                        if item is statement:
                            body[place] = ir.StaticSetItem(item.target, index, item.index, item.value, item.loc)
                        else:
                            statement.value = ir.Expr.static_getitem(item.value, index, item.index, item.loc)
        return True


class KernelCompiler(compiler.CompilerBase):  # type: ignore[misc]
    """Numba compiler with the passes that kernels need: numba analyses the whole function again after each of its passes.

    Static single assignment, which LLVM does anyway, would multiply the variables: a variable of a kernel has one type.
    """

    lowering: Any = KernelLowering

    def define_pipelines(self) -> list[Any]:
        """Return the passes; no variable is reference-counted, and none needs an end of its life."""
        manager = compiler.PassManager("kernel")
        for step in (TranslateByteCode, FixupArgs, ConstantRewrites, NopythonTypeInference, AnnotateTypes, self.lowering, NoPythonBackend):
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
