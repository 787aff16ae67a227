"""Emit ``UserWarning`` for callers outside the package only."""

from __future__ import annotations

import sys
import warnings

_INTERNAL_PACKAGES = {"seisblock", "dataclasses", "copy"}
"""Top-level modules whose frames do not count as an external caller."""


def called_externally(depth: int) -> bool:
    """Return True if the calling function was itself called from outside the package.

    Parameters
    ----------
    depth : int
        Number of stack frames between the caller examined and this call: 1 for the caller of the calling function.
    """
    caller = str(sys._getframe(depth + 1).f_globals.get("__name__", ""))
    return caller.partition(".")[0] not in _INTERNAL_PACKAGES


def warn_external(text: str, depth: int) -> None:
    """Issue a UserWarning that points at the line of the external caller.

    Parameters
    ----------
    text : str
        Message, a whole sentence.
    depth : int
        Number of stack frames, see :func:`called_externally`.
    """
    warnings.warn(text, UserWarning, stacklevel=depth + 2)
