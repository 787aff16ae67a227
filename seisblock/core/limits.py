"""Limits of memory and computation, each adjustable by an environment variable."""

from __future__ import annotations

import os

from seisblock.core.errors import InputError, ParameterError
from seisblock.core.i18n import lazy_gettext

MIB = 2**20

CHUNK_SIZE = 2**18
"""Samples processed at a time, so that day-long records need no temporary arrays of their own size."""

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
"""Environment variables and default limits: MiB read and unpacked, members of archives, depth of nested archives, samples of all
components; MiB of the time histories of one result; samples and scale factors of one body; values of one option; combinations of one
study; stones of a cemetery, bodies of a list, stones of a pile (all pairs are tested for contact), contact points along a side of a
joint; MiB of the events of one result (0.1 to 0.4 kB each); MiB of a record and its transform where the transform cannot be split;
triangles of a scan (0.5 to 0.9 kB each) and corners of the base polygon of a scanned body."""


def get_limit(variable: str) -> int:
    """Return a limit: the value of the environment variable, else the default.

    Raises
    ------
    ParameterError
        If the variable is not a positive integer.
    """
    text = os.environ.get(variable, "")
    if text and not (text.isascii() and text.isdigit() and int(text) > 0):
        raise ParameterError("{variable} must be a positive integer, found {text!r}", variable=variable, text=text[:40])
    return int(text) if text else DEFAULT_LIMITS[variable]


def check_limit(items: str, count: int, variable: str, *, source: str = "", error: type[InputError] = ParameterError) -> None:
    """Raise an error if a count exceeds its limit.

    Parameters
    ----------
    items : str
        Name of the items, plural, printed after the number.
    count : int
        Number requested.
    variable : str
        Environment variable of the limit.
    source : str
        Name of the file that requests them, printed first.
    error : class
        Exception class instead of :class:`ParameterError`.

    Raises
    ------
    ParameterError
        If the limit is exceeded; the message states the count, the limit and the environment variable.

    Examples
    --------
    >>> check_limit("samples", 10**9, "SEISBLOCK_RUNS")
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: 1000000000 samples exceed the limit of 100000: reduce the number or raise SEISBLOCK_RUNS
    """
    maximum = get_limit(variable)
    if count > maximum:
        text = lazy_gettext(
            "{found} {what} exceed the limit of {most}: reduce the number or raise {variable}",
            found=count,
            what=lazy_gettext(items),
            most=maximum,
            variable=variable,
        )
        raise error(lazy_gettext("{where}: {text}", where=source, text=text) if source else text)


def check_curve_memory(samples: int, columns: int) -> None:
    """Raise an error if time histories would exceed their memory limit.

    Raises
    ------
    ParameterError
        If the limit is exceeded; the message states the memory needed and the environment variable.
    """
    size_mib, maximum = samples * columns * 8 // MIB, get_limit("SEISBLOCK_CURVES_MIB")
    if size_mib > maximum:
        raise ParameterError(
            "time histories of {samples} samples need {found} MiB, more than the limit of {most} MiB: select a shorter time window or "
            "raise {variable}",
            samples=samples,
            found=size_mib,
            most=maximum,
            variable="SEISBLOCK_CURVES_MIB",
        )


def check_event_memory(count: int, event_bytes: int) -> None:
    """Raise an error if the events of a trajectory exceed their memory limit.

    Raises
    ------
    ParameterError
        If the limit is exceeded; the message states the count, the memory needed and the environment variable.
    """
    maximum = get_limit("SEISBLOCK_CHANGES_MIB")
    if count * event_bytes > maximum * MIB:
        raise ParameterError(
            "{count} mode changes need {found} MiB, more than the limit of {most} MiB: select a shorter time window or raise {variable}",
            count=count,
            found=-(-count * event_bytes // MIB),
            most=maximum,
            variable="SEISBLOCK_CHANGES_MIB",
        )
