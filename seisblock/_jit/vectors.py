"""Vectors of six numbers, the block of a rigid body: operations that LLVM would carry out one number after another.

Each number is rounded as in the loops that stand for them without compilation.
"""

from __future__ import annotations

from typing import Any

from seisblock import _jit


def subtract_product(left: Any, right: Any, block: Any) -> None:
    """Subtract L^T R of two 6 x 6 blocks, row after row, from a third."""
    for i in range(6):
        for q in range(6):
            subtract_row(left[6 * q + i], right, 6 * q, block, 6 * i)


def subtract_row(factor: Any, source: Any, start: int, target: Any, at: int) -> None:
    """Subtract a multiple of six numbers of one array from six of another."""
    for j in range(6):
        target[at + j] -= factor * source[start + j]


if _jit.ENABLED:
    from llvmlite import ir  # type: ignore[import-untyped]
    from numba.core import types as numba_types
    from numba.extending import intrinsic

    types: Any = numba_types
    VECTOR = ir.VectorType(ir.DoubleType(), 6)

    def _row(context: Any, builder: Any, kind: Any, array: Any, at: Any) -> Any:
        """Return the address of six numbers of an array as a vector."""
        return builder.bitcast(builder.gep(context.make_array(kind)(context, builder, array).data, [at]), VECTOR.as_pointer())

    def _minus(builder: Any, vector: Any, factor: Any, other: Any) -> Any:
        """Return a vector less a multiple of another."""
        first = builder.insert_element(ir.Constant(VECTOR, ir.Undefined), factor, ir.IntType(32)(0))
        factors = builder.shuffle_vector(first, first, ir.Constant(ir.VectorType(ir.IntType(32), 6), [0] * 6))
        return builder.fsub(vector, builder.fmul(factors, other))

    @intrinsic  # type: ignore[no-redef,untyped-decorator]
    def subtract_product(typing_context: Any, left: Any, right: Any, block: Any) -> Any:
        """Subtract L^T R of two 6 x 6 blocks, row after row, from a third."""

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            first, second, third = zip(signature.args, arguments, strict=True)
            numbers = context.make_array(first[0])(context, builder, first[1]).data
            rows = [builder.load(_row(context, builder, *second, ir.IntType(32)(6 * q)), align=8) for q in range(6)]
            for i in range(6):
                address = _row(context, builder, *third, ir.IntType(32)(6 * i))
                result = builder.load(address, align=8)
                for q in range(6):
                    factor = builder.load(builder.gep(numbers, [ir.IntType(32)(6 * q + i)]))
                    result = _minus(builder, result, factor, rows[q])
                builder.store(result, address, align=8)
            return context.get_dummy_value()

        return types.void(left, right, block), generate

    @intrinsic  # type: ignore[no-redef,untyped-decorator]
    def subtract_row(typing_context: Any, factor: Any, source: Any, start: Any, target: Any, at: Any) -> Any:
        """Subtract a multiple of six numbers of one array from six of another."""

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            factor, source, start, target, at = arguments
            address = _row(context, builder, signature.args[3], target, at)
            other = builder.load(_row(context, builder, signature.args[1], source, start), align=8)
            builder.store(_minus(builder, builder.load(address, align=8), factor, other), address, align=8)
            return context.get_dummy_value()

        return types.void(types.float64, source, types.intp, target, types.intp), generate
