"""How much may be read, kept and computed at once, and the environment variables that lift each limit."""

from __future__ import annotations

import os

from seisblock.errors import InputError, ParameterError
from seisblock.words import said

MIB = 2**20

AT_A_TIME = 2**18
"""Samples that are worked on at a time: a day-long record needs no further memory of its size."""

LIMITS = {
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


def check_budget(what: str, found: int, variable: str, *, where: str = "", error: type[InputError] = ParameterError) -> None:
    """Refuse more than may be computed at once.

    Parameters
    ----------
    what : str
        What there are so many of, as it follows the number.
    found : int
        How many are asked for.
    variable : str
        Of the limit.
    where : str
        The file that asks for them.
    error : class
        Raised instead of :class:`ParameterError`.

    Raises
    ------
    ParameterError
        If so; the message says how many are asked for, how many are allowed, and what lifts the limit.

    Examples
    --------
    >>> check_budget("versions", 10**9, "SEISBLOCK_RUNS")
    Traceback (most recent call last):
    seisblock.errors.ParameterError: 1000000000 versions, and 100000 are allowed: ask for fewer, or set SEISBLOCK_RUNS to allow more
    """
    most = limit(variable)
    if found > most:
        text = said(
            "{found} {what}, and {most} are allowed: ask for fewer, or set {variable} to allow more",
            found=found,
            what=said(what),
            most=most,
            variable=variable,
        )
        raise error(said("{where}: {text}", where=where, text=text) if where else text)


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


def check_changes(count: int, each: int) -> None:
    """Refuse more changes of mode, of so many bytes each, than may be kept.

    Raises
    ------
    ParameterError
        If so; the message says how many there are, what they take, and what lifts the limit.
    """
    most = limit("SEISBLOCK_CHANGES_MIB")
    if count * each > most * MIB:
        raise ParameterError(
            "{count} changes of mode take {found} MiB, and {most} may be taken: cut a window out of the record, or set "
            "{variable} to take more",
            count=count,
            found=-(-count * each // MIB),
            most=most,
            variable="SEISBLOCK_CHANGES_MIB",
        )
