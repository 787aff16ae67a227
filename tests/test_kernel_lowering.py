"""Items and rows of arrays, arithmetic, loops over a range and calls have the same results in a kernel as in Python."""

from typing import NamedTuple

import numpy as np
import pytest

from seisblock import _jit
from seisblock._jit.vectors import multiply_columns, subtract_product, subtract_row

_t = _jit.types()
CUBE = _t.Array(_t.float64, 3, "C")
ROW = _t.Array(_t.float64, 1, "C")
FLAGS = _t.Array(_t.boolean, 1, "C")
COUNTS = _t.Array(_t.int64, 2, "C")
COLUMNS = _t.Array(_t.float64, 2, "A")


class Parts(NamedTuple):
    cube: np.ndarray
    flags: np.ndarray
    is_heavy: bool
    sizes: tuple[float, float]


PARTS = _t.NamedTuple((CUBE, FLAGS, _t.boolean, _t.UniTuple(_t.float64, 2)), Parts)


@pytest.fixture(autouse=True)
def no_cache(monkeypatch):
    """Nothing is written to the cache."""
    monkeypatch.setattr(_jit.cache, "load_or_compile", lambda compile_kernel, function, variant="": compile_kernel(cache=False))


@pytest.fixture
def cube():
    return np.random.default_rng(5).normal(size=(3, 4, 5))


@pytest.mark.parametrize("index", [(0, 0, 0), (2, 3, 4), (-1, -4, 2), (1, -1, -5)])
def test_items_are_read_and_stored_at_positive_and_negative_indices(cube, index):
    @_jit.kernel(_t.float64(CUBE, _t.int64, _t.int32, _t.uint8))
    def double(a, i, j, k):
        a[i, j, k] *= 2.0
        a[-1, 0, k] = i
        a[0, -1, -1] += 3
        return a[i, j, k] + a[-1, 3, 4] - a[2, -2, 0]

    i, j, k = index[0], index[1], index[2] % 5
    other = cube.copy()
    other[i, j, k] *= 2.0
    other[-1, 0, k] = i
    other[0, -1, -1] += 3
    assert double(cube, i, j, k) == other[i, j, k] + other[-1, 3, 4] - other[2, -2, 0]
    assert (cube == other).all()


def test_rows_are_views_of_their_array(cube):
    @_jit.kernel(_t.float64(CUBE, _t.int64, _t.int64))
    def shift(a, i, j):
        plane, row, last = a[i], a[i, j], a[-1][0]
        row[1] = plane[j, 2] + plane.shape[1] * plane.size
        last[4] = row[3]
        plane[0] = 7.0
        return row.size + last.sum() + plane.strides[0] + plane[j].shape[0]

    other = cube.copy()
    plane, row, last = other[1], other[1, -2], other[-1, 0]
    row[1] = plane[-2, 2] + plane.shape[1] * plane.size
    last[4] = row[3]
    plane[0] = 7.0
    assert shift(cube, 1, -2) == pytest.approx(row.size + last.sum() + plane.strides[0] + plane[-2].shape[0], rel=1e-15)
    assert (cube == other).all()


def test_types_of_items_are_converted():
    @_jit.kernel(_t.float64(FLAGS, COUNTS, _t.int64))
    def mark(flags, counts, i):
        flags[i] = not flags[i]
        counts[i, 1] = flags[i]
        counts[0, 0] = 2.9
        return counts[i, 1] / 2 if flags[i] else -1.5

    flags, counts = np.array([True, False]), np.full((2, 2), 5)
    assert mark(flags, counts, 1) == 0.5
    assert flags.tolist() == [True, True]
    assert counts.tolist() == [[2, 5], [5, 1]]
    assert mark(flags, counts, 0) == -1.5
    assert counts.tolist() == [[2, 0], [5, 1]]


def test_strided_arrays_have_their_own_steps(cube):
    @_jit.kernel(_t.float64(COLUMNS, _t.int64))
    def second(a, i):
        a[i, 1] = a[-1, 0]
        return a[i][1] - a[i, -2]

    columns = cube[:, ::2, 1]
    assert second(columns, 1) == cube[2, 0, 1] - cube[1, 0, 1]
    assert cube[1, 2, 1] == cube[2, 0, 1]


@pytest.mark.parametrize(("start", "stop"), [(0, 4), (3, 3), (5, -2), (-3, 2)])
@pytest.mark.parametrize("step", [1, 2, -1, -3])
def test_loops_over_a_range_have_the_values_of_python(start, stop, step):
    @_jit.kernel(_t.int64(_t.int64, _t.int64, _t.int64, _t.Array(_t.int64, 1, "C")))
    def walk(start, stop, step, seen):
        n = 0
        for i in range(start, stop):
            if i == 1:
                continue
            for j in range(i):
                seen[n] = 10 * i + j
                n += 1
                if j == 2:
                    break
        for i in range(start, stop, step):
            seen[n] = i
            n += 1
        steps = range(start) if step > 0 else range(start, 0, -1)
        for i in steps:
            seen[n] = -i
            n += 1
        return n

    seen, expected = np.zeros(60, dtype=np.int64), []
    n = walk(start, stop, step, seen)
    for i in range(start, stop):
        expected += [10 * i + j for j in range(min(i, 3)) if i != 1]
    expected += [*range(start, stop, step), *(-i for i in (range(start) if step > 0 else range(start, 0, -1)))]
    assert seen[:n].tolist() == expected


@pytest.mark.parametrize("inline", [False, True])
def test_kernels_pass_arrays_and_tuples_to_each_other_and_return_them(cube, inline):
    @_jit.kernel(_t.Tuple((CUBE, _t.boolean, _t.UniTuple(_t.float64, 2)))(PARTS, _t.boolean, _t.int8), inline=inline)
    def turn(parts, flag, count):
        parts.cube[0, 0, 0] = parts.sizes[1] - count
        return parts.cube, flag and not parts.is_heavy, (parts.sizes[1], parts.sizes[0])

    @_jit.kernel(_t.void(FLAGS, _t.boolean))
    def mark(flags, flag):
        flags[1] = flag

    @_jit.kernel(_t.float64(PARTS, _t.int64))
    def total(parts, count):
        first, flag, sizes = turn(parts, parts.flags[0], count)
        mark(parts.flags, not flag)
        _, flag, sizes = turn(Parts(first, parts.flags, True, sizes), flag, 1)
        return first[0, 0, 0] + (10.0 if flag else 20.0) + 100.0 * sizes[0]

    flags = np.array([True, False])
    assert total(Parts(cube, flags, False, (3.0, 5.0)), 2) == (3.0 - 1) + 20.0 + 100.0 * 3.0
    assert cube[0, 0, 0] == 2.0
    assert flags.tolist() == [True, False]


def test_an_error_in_a_called_kernel_is_raised():
    @_jit.kernel(_t.int64(_t.int64))
    def count(step):
        n = 0
        for i in range(0, 6, step):
            n += i
        return n

    @_jit.kernel(_t.int64(_t.int64))
    def count_twice(step):
        return count(2) + count(step)

    assert count_twice(3) == 6 + 3
    with pytest.raises(ValueError, match="must not be zero"):
        count_twice(0)


def test_a_kernel_that_python_has_called_is_called_by_kernels(cube):
    @_jit.kernel(_t.float64(CUBE, _t.int64))
    def corner(a, i):
        return a[i, 0, 0] * 2 - 1

    @_jit.kernel(_t.float64(CUBE, _t.int64))
    def corners(a, i):
        return corner(a, i) + corner(a, i + 1)

    assert corner(cube, 0) == cube[0, 0, 0] * 2 - 1
    assert corners(cube, 0) == cube[0, 0, 0] * 2 - 1 + cube[1, 0, 0] * 2 - 1


@pytest.mark.kernel
def test_vectors_of_six_are_rounded_as_loops():
    rng = np.random.default_rng(3)
    left, right, block = rng.normal(size=(3, 40))

    @_jit.kernel(_t.void(*[ROW] * 3))
    def subtract(left, right, block):
        subtract_product(left, right, block)
        subtract_row(left[0], right, 2, block, 34)

    expected = block.copy()
    for i in range(6):
        for q in range(6):
            expected[6 * i : 6 * i + 6] -= left[6 * q + i] * right[6 * q : 6 * q + 6]
    expected[34:40] -= left[0] * right[2:8]
    subtract(left, right, block)
    assert (block == expected).all()


@pytest.mark.kernel
def test_columns_of_ten_are_multiplied_as_in_loops():
    """Even and odd terms are added apart, in this order, with the constant column first."""
    rng = np.random.default_rng(4)
    matrix, state, load, product = rng.normal(size=180), rng.normal(size=20), rng.normal(size=(3, 2)), np.zeros(20)

    @_jit.kernel(_t.void(ROW, ROW, _t.Array(_t.float64, 2, "C"), ROW))
    def multiply(matrix, state, load, product):
        multiply_columns(matrix, 5, state, 8, load, product)

    columns, factors = matrix[5:175].reshape(17, 10), np.concatenate([state[8:18], load.ravel()])
    even, odd = columns[0].copy(), np.zeros(10)
    for k in range(0, 16, 2):
        even, odd = even + columns[k + 1] * factors[k], odd + columns[k + 2] * factors[k + 1]
    multiply(matrix, state, load, product)
    assert (product[8:18] == even + odd).all()
    assert not product[:8].any()
    assert not product[18:].any()
