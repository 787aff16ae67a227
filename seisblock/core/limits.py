"""How much may be read, kept and computed at once, and the environment variables that lift each limit."""

from __future__ import annotations

import os

from seisblock.core.errors import InputError, ParameterError
from seisblock.core.i18n import lazy_gettext

MIB = 2**20

CHUNK_SIZE = 2**18
"""Samples that are worked on at a time: a day-long record needs no further memory of its size."""

DEFAULT_LIMITS = {
    "SEISBLOCK_READ_MIB": 1024,
    "SEISBLOCK_READ_MEMBERS": 20_000,
    "SEISBLOCK_READ_NESTING": 5,
    "SEISBLOCK_READ_SAMPLES": 200_000_000,
    "SEISBLOCK_CURVES_MIB": 1024,
    "SEISBLOCK_RUNS": 100_000,
    "SEISBLOCK_VALUES": 1_000_000,
    "SEISBLOCK_CELLS": 1_000_000,
    "SEISBLOCK_STONES": 1_000_000,
    "SEISBLOCK_BODIES": 100_000,
    "SEISBLOCK_PILE_STONES": 200,
    "SEISBLOCK_PILE_POINTS": 25,
    "SEISBLOCK_CHANGES_MIB": 512,
    "SEISBLOCK_TRANSFORM_MIB": 768,
    "SEISBLOCK_TRIANGLES": 3_000_000,
    "SEISBLOCK_CORNERS": 10_000,
}
"""The environment variables that lift a limit, and the limits without them: MiB read and unpacked, members of archives, archives within
archives, samples of all components; MiB of the curves of one answer; versions of one body and factors on one motion; values of one option;
combinations of one study; stones of a cemetery, bodies of a list, stones of a pile, each pair of which is looked at, and points along a
side of its joints; MiB of the changes of mode of one answer, 0.1 to 0.4 kB each; MiB of a record and of the transform of so many samples
that they cannot be transformed in parts; triangles of a scan, each of 0.5 to 0.9 kB, and corners of the base of a scanned body."""


def get_limit(variable: str) -> int:
    """Return a limit, from the environment where it stands there.

    Raises
    ------
    ParameterError
        If the variable is no positive whole number.
    """
    text = os.environ.get(variable, "")
    if text and not (text.isascii() and text.isdigit() and int(text) > 0):
        raise ParameterError("{variable} must be a positive whole number, found {text!r}", variable=variable, text=text[:40])
    return int(text) if text else DEFAULT_LIMITS[variable]


def check_limit(items: str, count: int, variable: str, *, source: str = "", error: type[InputError] = ParameterError) -> None:
    """Refuse more than may be computed at once.

    Parameters
    ----------
    items : str
        What there are so many of, as it follows the number.
    count : int
        How many are asked for.
    variable : str
        Of the limit.
    source : str
        The file that asks for them.
    error : class
        Raised instead of :class:`ParameterError`.

    Raises
    ------
    ParameterError
        If so; the message says how many are asked for, how many are allowed, and what lifts the limit.

    Examples
    --------
    >>> check_limit("versions", 10**9, "SEISBLOCK_RUNS")
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: 1000000000 versions, and 100000 are allowed: ask for fewer, or set SEISBLOCK_RUNS to allow more
    """
    maximum = get_limit(variable)
    if count > maximum:
        text = lazy_gettext(
            "{found} {what}, and {most} are allowed: ask for fewer, or set {variable} to allow more",
            found=count,
            what=lazy_gettext(items),
            most=maximum,
            variable=variable,
        )
        raise error(lazy_gettext("{where}: {text}", where=source, text=text) if source else text)


def check_curve_memory(samples: int, columns: int) -> None:
    """Refuse curves that would take more memory than they may.

    Raises
    ------
    ParameterError
        If so; the message says how much, and what lifts the limit.
    """
    size_mib, maximum = samples * columns * 8 // MIB, get_limit("SEISBLOCK_CURVES_MIB")
    if size_mib > maximum:
        raise ParameterError(
            "the curves of {samples} samples would take {found} MiB, and {most} may be taken: cut a window out of the record, or "
            "set {variable} to take more",
            samples=samples,
            found=size_mib,
            most=maximum,
            variable="SEISBLOCK_CURVES_MIB",
        )


def check_event_memory(count: int, event_bytes: int) -> None:
    """Refuse more changes of mode, of so many bytes each, than may be kept.

    Raises
    ------
    ParameterError
        If so; the message says how many there are, what they take, and what lifts the limit.
    """
    maximum = get_limit("SEISBLOCK_CHANGES_MIB")
    if count * event_bytes > maximum * MIB:
        raise ParameterError(
            "{count} changes of mode take {found} MiB, and {most} may be taken: cut a window out of the record, or set "
            "{variable} to take more",
            count=count,
            found=-(-count * event_bytes // MIB),
            most=maximum,
            variable="SEISBLOCK_CHANGES_MIB",
        )
