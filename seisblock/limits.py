"""How much may be read, unpacked and kept, and the environment variables that lift each limit."""

from __future__ import annotations

import os

from seisblock.errors import ParameterError

MIB = 2**20

LIMITS = {
    "SEISBLOCK_READ_MIB": 1024,
    "SEISBLOCK_READ_MEMBERS": 20_000,
    "SEISBLOCK_READ_NESTING": 5,
    "SEISBLOCK_READ_SAMPLES": 200_000_000,
    "SEISBLOCK_CURVES_MIB": 1024,
}
"""The environment variables that lift a limit, and the limits without them: MiB read and unpacked, members of archives, archives within
archives, samples of all components; MiB of the curves of one answer."""


def limit(variable: str) -> int:
    """Return a limit, from the environment where it stands there.

    Raises
    ------
    ParameterError
        If the variable is no positive whole number.
    """
    text = os.environ.get(variable, "")
    if text and not (text.isascii() and text.isdigit() and int(text) > 0):
        raise ParameterError("{variable} must be a positive whole number, found {text!r}", variable=variable, text=text[:40])
    return int(text) if text else LIMITS[variable]


def check_curves(samples: int, columns: int) -> None:
    """Refuse curves that would take more memory than they may.

    Raises
    ------
    ParameterError
        If so; the message says how much, and what lifts the limit.
    """
    found, most = samples * columns * 8 // MIB, limit("SEISBLOCK_CURVES_MIB")
    if found > most:
        raise ParameterError(
            "the curves of {samples} samples would take {found} MiB, and {most} may be taken: cut a window out of the record, or "
            "set {variable} to take more",
            samples=samples,
            found=found,
            most=most,
            variable="SEISBLOCK_CURVES_MIB",
        )
