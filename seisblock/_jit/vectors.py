"""Vectors of six numbers, the block of a rigid body, and of ten, the state of a block on springs: LLVM would take the numbers one by one.

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


def multiply_columns(matrix: Any, start: Any, state: Any, at: Any, load: Any, product: Any) -> None:
    """Write a constant column plus ten columns times numbers of a state from `at` on and six times a load, of ten rows each."""
    for i in range(10):
        sums = [matrix[start + i], 0.0]
        for k in range(16):
            sums[k % 2] += matrix[start + 10 * (k + 1) + i] * (state[at + k] if k < 10 else load[(k - 10) // 2, k % 2])
        product[at + i] = sums[0] + sums[1]


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

    @intrinsic  # type: ignore[no-redef,untyped-decorator]
    def multiply_columns(typing_context: Any, matrix: Any, start: Any, state: Any, at: Any, load: Any, product: Any) -> Any:
        """Write a constant column plus ten columns times numbers of a state from `at` on and six times a load, of ten rows each."""

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            index = ir.IntType(64)
            numbers, state, load, target = (
                context.make_array(signature.args[i])(context, builder, arguments[i]).data for i in (0, 2, 4, 5)
            )
            start, at = arguments[1], arguments[3]
            factors = [builder.load(builder.gep(state, [builder.add(at, index(k))])) for k in range(10)]
            factors += [builder.load(builder.gep(load, [index(k)])) for k in range(6)]
            # in lengths of the processor's vectors
            for first_row, rows in ((0, 8), (8, 2)):
                kind = ir.VectorType(ir.DoubleType(), rows)
                columns = []
                for k in range(17):
                    place = builder.gep(numbers, [builder.add(start, index(10 * k + first_row))])
                    columns.append(builder.load(builder.bitcast(place, kind.as_pointer()), align=8))
                sums = [columns[0], ir.Constant(kind, [0.0] * rows)]
                for k, factor in enumerate(factors):
                    first = builder.insert_element(ir.Constant(kind, ir.Undefined), factor, ir.IntType(32)(0))
                    spread = builder.shuffle_vector(first, first, ir.Constant(ir.VectorType(ir.IntType(32), rows), [0] * rows))
                    sums[k % 2] = builder.fadd(sums[k % 2], builder.fmul(columns[k + 1], spread))
                place = builder.gep(target, [builder.add(at, index(first_row))])
                builder.store(builder.fadd(*sums), builder.bitcast(place, kind.as_pointer()), align=8)
            return context.get_dummy_value()

        return types.void(matrix, types.intp, state, types.intp, load, product), generate
