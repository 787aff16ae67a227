"""Every kernel, compiled before it is wanted; ``python -m tests.kernels`` does it while nothing else is to be done."""

import importlib
import pkgutil

from seisblock._jit.on_demand import OnDemand

ROOMS = ("seisblock.dynamics", "seisblock.solvers.respond", "seisblock.solvers.jump", "seisblock.solvers.stack")
ROOMS += ("seisblock.solvers.slide", "seisblock.solvers.rock", "seisblock.solvers.uplift", "seisblock.measures", "seisblock.records")
"""Where kernels are, in such an order that two workers who take turns have as much to compile."""


def compile_all(*, share: int = 0, of: int = 1) -> None:
    """Compile each kernel, or one share of so many, into the cache; those that are there are read."""
    for name in ROOMS[share::of]:
        for module in pkgutil.walk_packages(importlib.import_module(name).__path__, f"{name}."):
            for value in list(vars(importlib.import_module(module.name)).values()):
                _ = value.compiled if isinstance(value, OnDemand) else None


if __name__ == "__main__":
    compile_all()
