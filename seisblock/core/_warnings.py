"""What is remarked to whoever calls from a program of his own: a warning of Python's, and none where the house calls itself."""

from __future__ import annotations

import sys
import warnings

_INTERNAL_PACKAGES = {"seisblock", "dataclasses", "copy"}
"""Packages that call for somebody else."""


def called_externally(depth: int) -> bool:
    """Return whether a function was called by another program than this one.

    Parameters
    ----------
    depth : int
        How many calls lie between that function's caller and this call: 1 where the function itself asks.
    """
    caller = str(sys._getframe(depth + 1).f_globals.get("__name__", ""))
    return caller.partition(".")[0] not in _INTERNAL_PACKAGES


def warn_external(text: str, depth: int) -> None:
    """Warn, with the line of the caller, as far away as for :func:`called_externally`.

    Parameters
    ----------
    text : str
        A sentence that was said.
    depth : int
    """
    warnings.warn(text, UserWarning, stacklevel=depth + 2)
