"""Kernels that other kernels call are parts of these: typed and lowered once, optimised once, whatever the depth of the calls."""

import numpy as np
import pytest
from numba.core.types import functions
from numba.core.typing.typeof import typeof

from seisblock import _jit
from seisblock._jit.linking import UnoptimizedLibrary
from seisblock._jit.typing_cache import memoize_typing

_t = _jit.types()
SIGNATURE = _t.float64(_t.float64, _t.float64)


@pytest.fixture
def chain(tmp_path, monkeypatch):
    """Three kernels, each of which calls the one before it, and a fourth that calls two; nothing of them is kept."""
    monkeypatch.setattr(_jit.cache, "cache_directory", lambda: tmp_path / "kernels")
    monkeypatch.setattr(_jit.cache, "_disabled", True)
    monkeypatch.setattr(_jit.cache, "_writable", lambda: True)
    monkeypatch.setattr(_jit, "_without_linking", False)

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


def answer(a, b):
    """Return what the last of them answers."""
    lean = [(p + q) * 0.5 if p > q else p - q for p, q in ((a, b), (b, a))]
    return sum(lean) * lean[0]


CASES = np.random.default_rng(3).uniform(-1.0, 1.0, (20, 2)).tolist()


def test_callees_stay_unoptimised(chain):
    """Of the two within there is a part and nothing whole; the answer is Python's."""
    lean, rock, fall = chain
    assert [fall(a, b) for a, b in CASES] == [answer(a, b) for a, b in CASES]
    for kernel in (lean, rock):
        assert kernel._compiled is None
        assert type(kernel._part.overloads[SIGNATURE.args].library) is UnoptimizedLibrary
    assert fall._part is None
    # a part may be called from Python as well, and is then compiled for it
    assert lean(1.0, 0.5) == 0.75


def test_compiled_kernel_is_linked_without_recompilation(chain):
    """A kernel that Python called before is not compiled a second time for those that call it."""
    lean, _, fall = chain
    assert lean(1.0, 0.5) == 0.75
    assert fall(0.3, -0.2) == answer(0.3, -0.2)
    assert lean._part is None


def test_unknown_numba_compiles_kernels_whole(chain, monkeypatch):
    """Where parts cannot be made, kernels answer as before."""

    def unlike(self):
        raise AttributeError("_final_module")

    monkeypatch.setattr(UnoptimizedLibrary, "finalize", unlike)
    lean, rock, fall = chain
    assert [fall(a, b) for a, b in CASES] == [answer(a, b) for a, b in CASES]
    assert _jit._without_linking
    assert all(kernel._compiled is not None and kernel._part is None for kernel in (lean, rock, fall))


def test_typing_is_memoized_per_compilation(monkeypatch):
    """While one kernel is compiled; one that is compiled within asks for itself, and outside all is as it was."""
    from numba.core.registry import cpu_target

    context = cpu_target.typing_context
    context.refresh()
    asked = []
    tried = functions.utils.order_by_target_specificity

    def counted(*how, **more):
        asked.append(how)
        return tried(*how, **more)

    monkeypatch.setattr(functions.utils, "order_by_target_specificity", counted)
    add = context.resolve_value_type(np.add)

    def ask():
        return str(add.get_call_type(context, (typeof(1.0), typeof(1)), {}))

    with memoize_typing():
        said = {ask(), ask()}
        assert len(asked) == 1
        with memoize_typing():
            said |= {ask(), ask()}
        assert len(asked) == 2
        said |= {ask()}
        assert len(asked) == 2
    said |= {ask(), ask()}
    assert len(asked) == 4
    assert said == {"(float64, int64) -> float64"}
