"""Lowering of kernels from numba's intermediate representation to LLVM's."""

from __future__ import annotations

import operator
from typing import Any

from llvmlite import ir as llvm
from numba.core import cgutils, ir
from numba.core import types as numba_types
from numba.core.ir_utils import get_definition, guard
from numba.core.lowering import Lower
from numba.cpython.slicing import fix_index

types: Any = numba_types

_ARITHMETIC = {operator.add: "fadd", operator.sub: "fsub", operator.mul: "fmul"}
_TWO_NUMBERS = types.float64, types.float64


class KernelLower(Lower):  # type: ignore[misc]
    """Numba's lowering with a fifth of the LLVM instructions for items and rows of C-contiguous arrays and for loops over a range.

    Numba copies the descriptor of an array to memory for each item: to write, parse and optimise this takes longer than all arithmetic.
    """

    def extract_function_arguments(self) -> Any:
        """Return the arguments; store named tuples, whose addresses are passed on."""
        super().extract_function_arguments()
        tuples = (k for k, kind in enumerate(self.fndesc.argtypes) if _is_by_address(kind))
        self.function.tuples = {k: cgutils.alloca_once_value(self.builder, self.fnargs[k]) for k in tuples}
        return self.fnargs

    def loadvar(self, name: str) -> Any:
        """Load a variable, or a named tuple from the address that the function got."""
        address = self._tuple_address(name)
        return super().loadvar(name) if address is None else self.builder.load(address)

    def lower_getitem(self, resty: Any, expr: Any, value: Any, index: Any, signature: Any) -> Any:
        """Load an item or view a row; other containers and slices are left to numba."""
        address = self._address(value.name, index.name)
        if address is None:
            return super().lower_getitem(resty, expr, value, index, signature)
        array, size = self.typeof(value.name), self.context.get_constant(types.intp, 1)
        if not isinstance(resty, types.Array):
            return self.context.cast(self.builder, self.context.unpack_value(self.builder, array.dtype, address), array.dtype, resty)
        descriptor, view = self.loadvar(value.name), self.context.get_constant_undef(resty)
        for name in ("meminfo", "parent", "itemsize"):
            view = self._insert(resty, view, self._extract(array, descriptor, name), name)
        for axis in range(resty.ndim):
            for name in ("shape", "strides"):
                length = self._extract(array, descriptor, name, array.ndim - resty.ndim + axis)
                view = self._insert(resty, view, length, name, axis)
                size = self.builder.mul(size, length) if name == "shape" else size
        return self._insert(resty, self._insert(resty, view, size, "nitems"), address, "data")

    def lower_setitem(self, target_var: Any, index_var: Any, value_var: Any, signature: Any) -> Any:
        """Store an item; rows, slices and other containers are left to numba."""
        array, kind = self.typeof(target_var.name), self.typeof(value_var.name)
        address = self._address(target_var.name, index_var.name) if isinstance(kind, types.Number | types.Boolean) else None
        if address is None or len(_tuple_of(self.typeof(index_var.name))) < array.ndim:
            return super().lower_setitem(target_var, index_var, value_var, signature)
        value = self.context.cast(self.builder, self.loadvar(value_var.name), kind, array.dtype)
        return self.context.pack_value(self.builder, array.dtype, value, address)

    def lower_inst(self, inst: Any) -> Any:
        """Store an item of an array at constants, for which numba would first look for a special function; copy no argument."""
        if isinstance(inst, ir.Assign) and self._tuple_address(inst.target.name) is not None:
            return None
        if isinstance(inst, ir.StaticSetItem) and isinstance(self.typeof(inst.target.name), types.Array):
            return self.lower_setitem(inst.target, inst.index_var, inst.value, self.fndesc.calltypes[inst])
        return super().lower_inst(inst)

    def lower_expr(self, resty: Any, expr: Any) -> Any:
        """Add and multiply; read an array at constants; begin a loop over a range of step 1 and advance it."""
        builder, operation = self.builder, expr.op
        if operation == "binop" and expr.fn in _ARITHMETIC and self.fndesc.calltypes[expr].args == _TWO_NUMBERS:
            numbers = [self.context.cast(builder, self.loadvar(x.name), self.typeof(x.name), types.float64) for x in (expr.lhs, expr.rhs)]
            return self.context.cast(builder, getattr(builder, _ARITHMETIC[expr.fn])(*numbers), types.float64, resty)
        if operation == "getattr" and (address := self._tuple_address(expr.value.name)) is not None:
            field = self.typeof(expr.value.name).fields.index(expr.attr)
            return builder.load(cgutils.gep_inbounds(builder, address, 0, field))
        kind = self.typeof(expr.value.name) if operation in ("static_getitem", "getiter", "iternext", "pair_first", "pair_second") else None
        if isinstance(kind, types.Array):
            return self.lower_getitem(resty, expr, expr.value, expr.index_var, self.fndesc.calltypes[expr])
        definition = guard(get_definition, self.func_ir, expr.value) if isinstance(kind, types.RangeType) else None
        if isinstance(definition, ir.Expr) and len(definition.args) < 3:
            start, stop = (self._extract(kind, self.loadvar(expr.value.name), name) for name in ("start", "stop"))
            zero, steps = start.type(0), builder.sub(stop, start)
            steps = builder.select(builder.icmp_signed(">", steps, zero), steps, zero)
            iterator = self._insert(resty, self.context.get_constant_undef(resty), start.type(1), "step")
            for name, value in (("iter", start), ("count", steps)):
                iterator = self._insert(resty, iterator, cgutils.alloca_once_value(builder, value), name)
            return iterator
        if isinstance(kind, types.RangeIteratorType):
            iterator = self.loadvar(expr.value.name)
            place, count, step = (self._extract(kind, iterator, name) for name in ("iter", "count", "step"))
            value, steps = builder.load(place), builder.load(count)
            builder.store(builder.add(value, step), place)
            builder.store(builder.sub(steps, steps.type(1)), count)
            pair = self._insert(resty, self.context.get_constant_undef(resty), value, "first")
            return self._insert(resty, pair, builder.icmp_signed(">", steps, steps.type(0)), "second")
        if isinstance(kind, types.Pair) and isinstance(kind.first_type, types.Integer):
            return self._extract(kind, self.loadvar(expr.value.name), operation.removeprefix("pair_"))
        return super().lower_expr(resty, expr)

    def alloca_lltype(self, name: str, lltype: Any, datamodel: Any = None) -> Any:
        """Allocate a variable; numba would also ask LLVM for its size, for debuggers."""
        return cgutils.alloca_once(self.builder, lltype, name=name, zfill=False)

    def _tuple_address(self, name: str) -> Any:
        """Return the address of the argument, a named tuple, that a variable stands for; None for other variables."""
        definition = guard(get_definition, self.func_ir, name)
        return self.function.tuples.get(definition.index) if isinstance(definition, ir.Arg) else None

    def _extract(self, kind: Any, value: Any, name: str, *axis: int) -> Any:
        """Return a field of a structure, or one of its items."""
        return self.builder.extract_value(value, (self.context.data_model_manager[kind].get_field_position(name), *axis))

    def _insert(self, kind: Any, value: Any, field: Any, name: str, *axis: int) -> Any:
        """Return a structure with one field, or one of its items, replaced."""
        return self.builder.insert_value(value, field, (self.context.data_model_manager[kind].get_field_position(name), *axis))

    def _address(self, array_name: str, index_name: str) -> Any:
        """Return the address of an item or row of a C-contiguous array, None for anything else."""
        array, index = self.typeof(array_name), self.typeof(index_name)
        kinds = _tuple_of(index)
        if not (
            isinstance(array, types.Array) and array.layout == "C" and array.aligned and all(isinstance(k, types.Integer) for k in kinds)
        ):
            return None
        builder, descriptor, value = self.builder, self.loadvar(array_name), self.loadvar(index_name)
        offset = self.context.get_constant(types.intp, 0)
        for axis in range(array.ndim):
            size = self._extract(array, descriptor, "shape", axis)
            offset = builder.mul(offset, size) if axis else offset
            if axis < len(kinds):
                item = builder.extract_value(value, axis) if isinstance(index, types.BaseTuple) else value
                item = self.context.cast(builder, item, kinds[axis], types.intp)
                is_positive = isinstance(kinds[axis], types.IntegerLiteral) and kinds[axis].literal_value >= 0
                offset = builder.add(offset, item if is_positive or not kinds[axis].signed else fix_index(builder, item, size))
        return builder.gep(self._extract(array, descriptor, "data"), [offset])


class CalleeLower(KernelLower):
    """Lowering of a kernel that only kernels call: arrays are passed whole, named tuples of arrays by address.

    Numba passes each of their fields and puts them together again, which were 40 % of all LLVM instructions of ``stack``; tuples passed
    whole, 300 numbers, took a third of its time.
    """

    def setup_function(self, fndesc: Any) -> None:
        """Begin the function."""
        self.function = _declare(self.context, self.module, fndesc)
        self.entry_block = self.function.append_basic_block("entry")
        self.builder = llvm.IRBuilder(self.entry_block)
        self.call_helper = self.call_conv.init_call_helper(self.builder)

    def extract_function_arguments(self) -> Any:
        """Return the arguments, which follow the addresses of the result and of an exception."""
        self.fnargs = self.function.args[2:]
        self.function.tuples = {k: self.fnargs[k] for k, kind in enumerate(self.fndesc.argtypes) if _is_by_address(kind)}
        return self.fnargs


def call_kernel(fndesc: Any, libraries: Any) -> Any:
    """Return the implementation of calls of a kernel lowered by :class:`CalleeLower`, for numba's registry of functions."""

    def implementation(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        function = _declare(context, builder.module, fndesc)
        result = cgutils.alloca_once(builder, function.args[0].type.pointee)
        arguments = [
            _address(builder, value) if _is_by_address(kind) else value for kind, value in zip(fndesc.argtypes, arguments, strict=True)
        ]
        code = builder.call(function, [result, builder.function.args[1], *arguments])
        with cgutils.if_unlikely(builder, builder.icmp_signed("!=", code, code.type(0))):
            builder.ret(code)
        return context.get_returned_value(builder, fndesc.restype, builder.load(result))

    implementation.libs = tuple(libraries)  # type: ignore[attr-defined]
    return implementation


def _declare(context: Any, module: Any, fndesc: Any) -> Any:
    """Declare a kernel with arguments as :class:`CalleeLower` takes them."""
    plain = context.call_conv.get_function_type(fndesc.restype, ())
    kinds = [context.get_value_type(kind) for kind in fndesc.argtypes]
    passed = [kind.as_pointer() if _is_by_address(name) else kind for name, kind in zip(fndesc.argtypes, kinds, strict=True)]
    function = cgutils.get_or_insert_function(module, llvm.FunctionType(plain.return_type, [*plain.args, *passed]), fndesc.mangled_name)
    for argument, kind in zip(function.args[2:], fndesc.argtypes, strict=True):
        if _is_by_address(kind):
            argument.add_attribute("noalias")
    if fndesc.inline:
        function.attributes.add("alwaysinline")
    return function


def _is_by_address(kind: Any) -> bool:
    """Return True for named tuples, which have up to 300 fields."""
    return isinstance(kind, types.BaseNamedTuple)


def _address(builder: Any, value: Any) -> Any:
    """Return the address of a named tuple: that of an argument, or of a copy."""
    if isinstance(value, llvm.instructions.LoadInstr) and value.operands[0] in builder.function.tuples.values():
        return value.operands[0]
    return cgutils.alloca_once_value(builder, value)


def _tuple_of(index: Any) -> tuple[Any, ...]:
    """Return the types of an index, one per axis."""
    return tuple(index) if isinstance(index, types.BaseTuple) else (index,)
