"""Kernels of the package; ``python -m tests.kernels`` compiles those that Python calls into the cache."""

import importlib
import pkgutil

from seisblock._jit import LazyKernel

KERNEL_PACKAGES = ("seisblock.dynamics", "seisblock.models.respond", "seisblock.models.jump", "seisblock.models.stack")
KERNEL_PACKAGES += ("seisblock.models.rigid3d", "seisblock.models.slide", "seisblock.models.rock", "seisblock.models.uplift")
KERNEL_PACKAGES += ("seisblock.measures", "seisblock.records")
"""Packages with kernels, in an order that gives two workers equal shares."""


def all_kernels(package: str) -> list[LazyKernel]:
    """Return the kernels of a package."""
    modules = pkgutil.walk_packages(importlib.import_module(package).__path__, f"{package}.")
    values = [value for module in modules for value in vars(importlib.import_module(module.name)).values()]
    return list({id(value): value for value in values if isinstance(value, LazyKernel)}.values())


def callees(kernel: LazyKernel) -> set[int]:
    """Return the identities of the kernels that a kernel calls and holds."""
    function = kernel._function
    return {id(function.__globals__.get(name)) for name in function.__code__.co_names}


def compile_all(*, share: int = 0, of: int = 1) -> None:
    """Compile each kernel that no other kernel calls, or one share of so many, into the cache; cached ones are loaded."""
    for name in KERNEL_PACKAGES[share::of]:
        kernels = all_kernels(name)
        calls = set().union(*map(callees, kernels))
        for kernel in kernels:
            if id(kernel) not in calls:
                _ = kernel.compiled


if __name__ == "__main__":
    compile_all()
