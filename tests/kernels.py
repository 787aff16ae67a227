"""Kernels of the package; ``python -m tests.kernels`` compiles those that Python calls or passes by pointer into the cache."""

import importlib
import pkgutil
from collections.abc import Iterator
from types import ModuleType

from seisblock._jit import LazyKernel
from seisblock.dynamics import hybrid
from seisblock.dynamics.ensemble import Observer
from seisblock.dynamics.model import Model
from seisblock.models.stack.chamfered_box import edge_edge_chamfered, separating_axis_chamfered
from seisblock.models.stack.chamfered_faces import face_manifold_chamfered
from seisblock.models.stack.face_overlap import face_overlap_points
from seisblock.models.stack.hulls import shape_kernels

KERNEL_PACKAGES = ("seisblock.dynamics", "seisblock.models.respond", "seisblock.models.jump", "seisblock.models.stack")
KERNEL_PACKAGES += ("seisblock.models.rigid3d", "seisblock.models.slide", "seisblock.models.rock", "seisblock.models.uplift")
KERNEL_PACKAGES += ("seisblock.measures", "seisblock.records")
"""Packages with kernels, in an order that gives two workers equal shares."""

SHAPE_KERNELS = (separating_axis_chamfered, edge_edge_chamfered, face_manifold_chamfered, face_overlap_points)
"""Kernels that a pile holds as pointers."""


def modules_of(package: str) -> Iterator[ModuleType]:
    """Yield the modules of a package."""
    for module in pkgutil.walk_packages(importlib.import_module(package).__path__, f"{package}."):
        yield importlib.import_module(module.name)


def all_kernels(package: str) -> list[LazyKernel]:
    """Return the kernels of a package."""
    values = [value for module in modules_of(package) for value in vars(module).values()]
    return list({id(value): value for value in values if isinstance(value, LazyKernel)}.values())


def callees(kernel: LazyKernel) -> set[int]:
    """Return the identities of the kernels that a kernel calls and holds."""
    function = kernel._function
    return {id(function.__globals__.get(name)) for name in function.__code__.co_names}


def passed_by_pointer(package: str) -> dict[int, tuple[Model | Observer, tuple[object, ...]]]:
    """Return the models and observers of a package with the kernels that the engine calls by pointer."""
    values = [value for module in modules_of(package) for value in vars(module).values()]
    models = {id(value): (value, (value.series, value.reset, value.skip)) for value in values if isinstance(value, Model)}
    return models | {id(value): (value, (value.observe,)) for value in values if isinstance(value, Observer)}


def compile_all(*, share: int = 0, of: int = 1) -> None:
    """Compile what Python calls or passes by pointer, or one share of so many, into the cache; cached kernels are loaded."""
    by_pointer = {id(kernel) for name in KERNEL_PACKAGES for _, kernels in passed_by_pointer(name).values() for kernel in kernels}
    by_pointer |= set(map(id, SHAPE_KERNELS))
    for name in KERNEL_PACKAGES[share::of]:
        for value, _ in passed_by_pointer(name).values():
            _ = value.pointers if isinstance(value, Model) else value.pointer
        if name == "seisblock.models.stack":
            shape_kernels(has_worn=True, has_round=True)
        kernels = all_kernels(name)
        calls = by_pointer.union({id(hybrid.advance)}, *map(callees, kernels))
        for kernel in kernels:
            if id(kernel) not in calls:
                _ = kernel.compiled


if __name__ == "__main__":
    compile_all()
