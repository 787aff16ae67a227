"""Models pass their functions to compiled loops as pointers, which is quick and survives a journey to another process."""

import pickle
import subprocess
import sys

import numpy as np
import pytest

from seisblock._jit import ENABLED, function_pointer
from seisblock.dynamics import integrate
from seisblock.dynamics.model_api import SERIES
from seisblock.dynamics.polynomial import evaluate
from seisblock.records import Motion
from tests.dynamics.toy_models import BALL

STILL = Motion.from_arrays(np.zeros(301), 0.01)


@pytest.mark.skipif(not ENABLED, reason="nothing is compiled")
def test_function_pointer_behaves_like_its_kernel():
    """A function pointer called from Python equals the kernel and shows its signature."""
    created = function_pointer(BALL.series, SERIES)
    room = np.zeros((2, 4)), np.zeros((1, 4)), np.zeros((2, 4)), np.zeros((1, 4))
    for function, c, g in ((BALL.series, *room[:2]), (created, *room[2:])):
        assert function(0, np.array([1.0, 2.0]), np.zeros((3, 2)), np.array([9.8, 0.5, 0.1]), 3, c, g) == 2
    np.testing.assert_array_equal(room[0], room[2])
    assert created.signature() == SERIES


def test_kernel_is_pickled_by_name():
    """It is itself again where it arrives, described as the function that it is."""
    assert pickle.loads(pickle.dumps(evaluate)) is evaluate
    assert evaluate.__name__ == "evaluate" and "polynomial" in evaluate.__doc__


def test_used_model_can_be_pickled():
    """Addresses are not taken along: the other process finds its own, and the same answer."""
    first = integrate(BALL, STILL, [9.8, 0.7, 1e-3], [1.0, 0.0], 0)
    script = (
        "import pickle, sys, numpy as np\n"
        "from seisblock.dynamics import integrate; from seisblock.records import Motion\n"
        "model = pickle.loads(sys.stdin.buffer.read())\n"
        "there = integrate(model, Motion.from_arrays(np.zeros(301), 0.01), [9.8, 0.7, 1e-3], [1.0, 0.0], 0)\n"
        "print(repr(there.end_time), there.n_events)"
    )
    result = subprocess.run([sys.executable, "-c", script], input=pickle.dumps(BALL), capture_output=True, check=True)
    assert result.stdout.decode().split() == [repr(first.end_time), str(first.n_events)]
