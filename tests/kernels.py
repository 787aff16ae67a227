"""Every kernel that Python calls, compiled before it is wanted; ``python -m tests.kernels`` does it while nothing else is to be done."""

import importlib
import pkgutil

from seisblock._jit.lazy import LazyKernel

ROOMS = ("seisblock.dynamics", "seisblock.models.respond", "seisblock.models.jump", "seisblock.models.stack")
ROOMS += ("seisblock.models.slide", "seisblock.models.rock", "seisblock.models.uplift", "seisblock.measures", "seisblock.records")
"""Where kernels are, in such an order that two workers who take turns have as much to compile."""


def named_by(kernel):
    """Return the kernels that a kernel calls, which it holds."""
    code = kernel.__wrapped__.__code__
    return {id(kernel.__wrapped__.__globals__.get(name)) for name in code.co_names}


def compile_all(*, share: int = 0, of: int = 1) -> None:
    """Compile each kernel that no other kernel calls, or one share of so many, into the cache; those that are there are read."""
    for name in ROOMS[share::of]:
        found = pkgutil.walk_packages(importlib.import_module(name).__path__, f"{name}.")
        values = [value for module in found for value in vars(importlib.import_module(module.name)).values()]
        kernels = {id(value): value for value in values if isinstance(value, LazyKernel)}
        parts = set().union(*map(named_by, kernels.values()))
        for key in kernels.keys() - parts:
            _ = kernels[key].compiled


if __name__ == "__main__":
    compile_all()
