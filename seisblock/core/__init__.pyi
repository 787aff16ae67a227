from . import errors, results, units

__all__ = ["errors", "results", "units"]
