"""Kernels called by other kernels are linked unoptimised and optimised once, in the kernel that Python calls."""

import re
import subprocess
import sys
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numba
import numpy as np
import pytest
from numba.core.base import BaseContext
from numba.core.types import functions
from numba.core.typing.typeof import typeof

from seisblock import _jit
from seisblock._jit import internals
from seisblock._jit.internals import UnoptimizedLibrary, fast_compilation

_t = _jit.types()
SIGNATURE = _t.float64(_t.float64, _t.float64)
EMPTY, FULL = 3, 7


@pytest.fixture
def chain(monkeypatch):
    """Three kernels, each of which calls the one before it; the third calls both. Nothing is written to the cache."""
    monkeypatch.setattr(_jit.cache, "load_or_compile", lambda compile_kernel, function: compile_kernel(cache=False))

    @_jit.kernel(SIGNATURE)
    def lean(a, b):
        return (a + b) * 0.5 if a > b else a - b

    @_jit.kernel(SIGNATURE, inline=True)
    def rock(a, b):
        return lean(a, b) + lean(b, a)

    @_jit.kernel(SIGNATURE)
    def fall(a, b):
        return rock(a, b) * lean(a, b)

    return lean, rock, fall


def expected(a, b):
    """Return the result of the last kernel, computed by Python."""
    lean = [(p + q) * 0.5 if p > q else p - q for p, q in ((a, b), (b, a))]
    return sum(lean) * lean[0]


CASES = np.random.default_rng(3).uniform(-1.0, 1.0, (20, 2)).tolist()


def test_kernel_links_unoptimised_callees(chain):
    lean, rock, fall = chain
    assert [fall(a, b) for a, b in CASES] == [expected(a, b) for a, b in CASES]
    for kernel in (lean, rock):
        assert kernel._compiled is None
        assert type(kernel._callee.overloads[SIGNATURE.args].library) is UnoptimizedLibrary
    assert fall._callee is None
    # a callee can be called from Python as well, and is then compiled for it
    assert lean(1.0, 0.5) == 0.75


class Pair(NamedTuple):
    """Two arrays, as the layout of a pile has them."""

    first: np.ndarray
    second: np.ndarray


VECTOR = _t.Array(_t.float64, 1, "C")
PAIR = _t.NamedUniTuple(VECTOR, 2, Pair)


def kernels_of_tuples(kernel):
    """Return a kernel that passes named tuples on: its argument, one that it makes, one of two, one that is an argument no longer."""

    @kernel(_t.float64(PAIR, PAIR))
    def fill(pair, other):
        pair.first[0] += 1.0
        return 10.0 * pair.first[0] + other.second[0] + pair.second[1]

    @kernel(_t.float64(PAIR, PAIR, _t.boolean))
    def outer(pair, other, is_swapped):
        swapped = Pair(pair.second, other.first)
        selected = pair if is_swapped else other
        alias = pair
        result = fill(pair, other) + 1e2 * fill(swapped, pair) + 1e4 * fill(selected, alias) + 1e6 * fill(pair, pair)
        other = swapped
        return result + 1e8 * fill(other, pair) + 1e10 * len(pair.first)

    @kernel(_t.float64(PAIR, PAIR, _t.boolean))
    def entry(pair, other, is_swapped):
        return outer(pair, other, is_swapped) + fill(other, pair)

    return fill, entry


@pytest.mark.parametrize("is_swapped", [False, True])
def test_kernels_pass_named_tuples_by_address(monkeypatch, is_swapped):
    """Results as in Python, whatever tuple a variable stands for; the callee gets addresses, not the fields of the arrays."""
    monkeypatch.setattr(_jit.cache, "load_or_compile", lambda compile_kernel, function: compile_kernel(cache=False))
    (fill, entry), (_, plain) = kernels_of_tuples(_jit.kernel), kernels_of_tuples(lambda _: lambda function: function)
    actual, expected = np.arange(8.0).reshape(4, 2), np.arange(8.0).reshape(4, 2)
    assert entry(Pair(*actual[:2]), Pair(*actual[2:]), is_swapped) == plain(Pair(*expected[:2]), Pair(*expected[2:]), is_swapped)
    assert (actual == expected).all()
    library = fill._callee.overloads[PAIR, PAIR].library
    (function,) = (f for f in library._final_module.functions if not f.is_declaration and "fill" in f.name)
    assert [str(argument.type) for argument in function.arguments] == ["ptr"] * 4


def test_kernel_links_a_complete_callee_as_it_is(chain):
    """A kernel that Python has called is not compiled a second time."""
    lean, _, fall = chain
    assert lean(1.0, 0.5) == 0.75
    assert fall(0.3, -0.2) == expected(0.3, -0.2)
    assert lean._callee is None


@pytest.mark.parametrize("short", [(0, 60), (0, 69), (1, 0)])
def test_kernels_are_compiled_completely_with_an_untested_numba(chain, monkeypatch, short):
    monkeypatch.setattr(numba, "version_info", numba.version_info._replace(short=short))
    lean, rock, fall = chain
    assert [fall(a, b) for a, b in CASES] == [expected(a, b) for a, b in CASES]
    assert all(kernel._compiled is not None and kernel._callee is None for kernel in (lean, rock, fall))


def test_tested_versions_of_numba_are_those_of_the_dependency():
    project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text("utf-8"))["project"]
    (bounds,) = (re.findall(r"\d+\.\d+", line) for line in project["dependencies"] if line.startswith("numba"))
    lowest, limit = (tuple(map(int, bound.split("."))) for bound in bounds)
    assert f"{lowest} <= numba.version_info.short < {limit}" in Path(_jit.__file__).read_text("utf-8")


@pytest.fixture
def inferences(monkeypatch):
    """List that grows by one for each type inference of numba."""
    calls = []
    original = functions.utils.order_by_target_specificity

    def count(*arguments, **options):
        calls.append(arguments)
        return original(*arguments, **options)

    monkeypatch.setattr(functions.utils, "order_by_target_specificity", count)
    return calls


def infer(**options):
    """Return the signature of the sum of a float and an integer."""
    from numba.core.registry import cpu_target

    context = cpu_target.typing_context
    context.refresh()
    return str(context.resolve_value_type(np.add).get_call_type(context, (typeof(1.0), typeof(1)), {}, **options))


def test_fast_compilation_infers_a_signature_once(inferences, monkeypatch):
    monkeypatch.setattr(internals, "_signatures", {})
    infer()
    del inferences[:]
    with fast_compilation():
        signatures = {infer(), infer()}
        with fast_compilation():
            signatures |= {infer(), infer()}
        signatures |= {infer()}
        assert len(inferences) == 1
    signatures |= {infer(), infer()}
    assert len(inferences) == 3
    with fast_compilation():
        signatures |= {infer()}
    assert len(inferences) == 3
    assert signatures == {"(float64, int64) -> float64"}


def test_fast_compilation_restores_numba():
    """The user's own kernels are compiled by numba alone."""
    method = _t.Function.get_call_type
    with pytest.raises(ValueError, match="inside"), fast_compilation():
        assert _t.Function.get_call_type is not method
        raise ValueError("inside")
    assert _t.Function.get_call_type is method


def test_compilation_looks_for_extensions_once_per_function(chain, monkeypatch):
    """Numba would do so at each element of an array."""
    refreshes = []
    original = BaseContext.refresh
    monkeypatch.setattr(BaseContext, "refresh", lambda self: (refreshes.append(1), original(self))[1])

    @_jit.kernel(_t.float64(_t.Array(_t.float64, 1, "C")))
    def total(a):
        return a[0] + a[1] + a[2] + a[3]

    assert total(np.arange(4.0)) == 6.0
    assert len(refreshes) <= 4


def test_variable_of_a_kernel_may_be_assigned_two_global_numbers(chain):
    @_jit.kernel(_t.int64(_t.int64))
    def status(n):
        result = EMPTY
        if n > 0:
            result = FULL
        return result

    assert (status(0), status(1)) == (EMPTY, FULL)


def test_fast_compilation_passes_unknown_keywords_on_to_numba(monkeypatch):
    """A future numba may call its method with more arguments."""
    received = []

    def original(self, context, args, kws, **options):
        received.append(options)
        return "(float64, int64) -> float64"

    monkeypatch.setattr(_t.Function, "get_call_type", original)
    with fast_compilation():
        assert {infer(depth=1), infer(depth=1)} == {"(float64, int64) -> float64"}
    assert received == [{"depth": 1}, {"depth": 1}]


def test_two_threads_compile_a_kernel_once(chain, monkeypatch):
    """The thread that comes later waits for the kernel of the first one."""
    compiled = []

    def load(compile_kernel, function, variant=""):
        compiled.append(function.__name__)
        time.sleep(0.1)
        return compile_kernel(cache=False)

    monkeypatch.setattr(_jit.cache, "load_or_compile", load)
    _, _, fall = chain
    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda case: fall(*case), CASES))
    assert results == [expected(a, b) for a, b in CASES]
    assert compiled == ["fall"]


def test_kernel_by_pointer_is_compiled_without_its_call_from_python(chain, monkeypatch):
    """Conversion of arguments from Python is a third of the code of a loop with many arrays, and of no use to a pointer."""
    monkeypatch.setattr(_jit.cache, "load_or_compile", lambda compile_kernel, function, variant: compile_kernel(cache=False))
    _, _, fall = chain
    pointer = _jit.function_pointer(fall, SIGNATURE)
    call = numba.njit(_t.float64(_t.FunctionType(SIGNATURE), _t.float64, _t.float64))(lambda function, a, b: function(a, b))
    assert [call(pointer, a, b) for a, b in CASES] == [expected(a, b) for a, b in CASES]
    (code,) = fall.exported.inspect_llvm().values()
    assert "@_ZN7cpython" not in code
    assert fall._compiled is None


def test_kernel_by_pointer_that_is_never_called_is_not_compiled(chain):
    """A pile of sharp boxes holds pointers to the kernels of worn and of round stones."""
    _, _, fall = chain
    pointer = _jit.function_pointer(fall, SIGNATURE, is_called=False)
    choose = numba.njit(_t.float64(_t.FunctionType(SIGNATURE), _t.boolean))(
        lambda function, is_called: function(1.0, 2.0) if is_called else -1.0
    )
    assert choose(pointer, False) == -1.0
    assert fall._compiled is None and fall._exported is None


def test_pile_of_sharp_boxes_compiles_no_kernel_of_other_shapes():
    """These are a sixth of the kernels of a pile."""
    script = """
from seisblock.bodies.pile.toml import load_pile
from seisblock.models.stack.arrays import pile_arrays
from tests.kernels import SHAPE_KERNELS
_ = pile_arrays(load_pile("wagata"), None, 2).layout
assert [kernel._exported for kernel in SHAPE_KERNELS] == [None] * 4
"""
    subprocess.run([sys.executable, "-c", script], check=True, timeout=300)


def test_kernels_load_no_blas_and_leave_it_to_other_code():
    """A kernel runs without ``scipy.linalg``; a product of matrices compiled by the user afterwards finds it."""
    script = """
import sys
import numpy as np
from seisblock.models.rock.expansion import sine_cosine
assert sine_cosine(0.0) == (0.0, 1.0)
assert "scipy.linalg" not in sys.modules
import numba
assert (numba.njit(lambda a, b: a @ b)(np.eye(2), 2.0 * np.eye(2)) == 2.0 * np.eye(2)).all()
assert "scipy.linalg" in sys.modules
"""
    subprocess.run([sys.executable, "-c", script], check=True, timeout=300)
