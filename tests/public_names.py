"""Public names of the package: those at its top, and those of its public subpackages with a dot."""

import inspect

import seisblock

PUBLIC_PACKAGES = sorted(name for name in seisblock.__all__ if inspect.ismodule(getattr(seisblock, name)))


def public_objects() -> dict[str, object]:
    """Return every public object but modules by its shortest public name (``read``, ``fragility.run_fragility``)."""
    objects = {name: getattr(seisblock, name) for name in seisblock.__all__ if name not in PUBLIC_PACKAGES}
    for package in PUBLIC_PACKAGES:
        module = getattr(seisblock, package)
        objects |= {f"{package}.{name}": getattr(module, name) for name in module.__all__ if name not in objects}
    return objects


PUBLIC = public_objects()
