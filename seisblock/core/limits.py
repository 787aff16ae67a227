"""Limits of memory and of counts, checked before anything is allocated; two environment variables raise them."""

from __future__ import annotations

import os

from seisblock.core.errors import InputError, ParameterError
from seisblock.core.i18n import N_, lazy_gettext

MIB = 2**20

CHUNK_SIZE = 2**18
"""Samples processed at a time, so that day-long records need no temporary arrays of their own size."""

MEMORY_VARIABLE, FACTOR_VARIABLE = "SEISBLOCK_MEMORY_MIB", "SEISBLOCK_LIMIT_FACTOR"
"""Environment variables: memory of one reading, filter, list of events or table of time histories, MiB; factor of the limits below."""

DEFAULT_MEMORY_MIB = 1024

MAX_RUNS, MAX_CELLS, MAX_VALUES = 100_000, 1_000_000, 1_000_000
"""Samples, directions or scale factors of one body; combinations of one study; values of one option."""

MAX_STONES, MAX_BODIES = 1_000_000, 100_000
"""Gravestones of a cemetery; bodies of a list."""

MAX_PILE_STONES, MAX_JOINT_POINTS = 200, 25
"""Stones of a pile, all pairs of which are tested for contact; contact points along a side of a joint."""

MAX_TRIANGLES, MAX_BASE_CORNERS = 3_000_000, 10_000
"""Triangles of a scan (0.5 to 0.9 kB each); corners of the base polygon of a scanned body."""

MAX_ANALYTIC_SAMPLES = 20_000_000
"""Samples of an analytic motion."""

MAX_MEMBERS, MAX_NESTING = 20_000, 5
"""Files in an archive; depth of archives inside archives."""


def memory_limit() -> int:
    """Return the memory limit, MiB."""
    return _read_variable(MEMORY_VARIABLE, DEFAULT_MEMORY_MIB)


def count_limit(limit: int) -> int:
    """Return a limit of this module times the factor of the environment."""
    return limit * _read_variable(FACTOR_VARIABLE, 1)


def _read_variable(variable: str, default: int) -> int:
    """Return the value of an environment variable, which must be a positive integer."""
    text = os.environ.get(variable, "")
    if text and not (text.isascii() and text.isdigit() and int(text) > 0):
        raise ParameterError("{variable} must be a positive integer, found {text!r}", variable=variable, text=text[:40])
    return int(text) if text else default


def check_limit(items: str, count: int, limit: int, *, source: str = "", error: type[InputError] = ParameterError) -> None:
    """Raise an error if a count of items, named in the plural, exceeds its limit.

    Parameters
    ----------
    items : str
    count : int
    limit : int
        One of the limits of this module.
    source : str
        Name of the file that requests the items, printed first.
    error : class

    Examples
    --------
    >>> check_limit("samples", 10**9, MAX_RUNS)
    Traceback (most recent call last):
    seisblock.core.errors.ParameterError: 1000000000 samples exceed the limit of 100000: reduce the number or raise SEISBLOCK_LIMIT_FACTOR
    """
    _check(items, count, count_limit(limit), FACTOR_VARIABLE, source, error)


def check_file_size(size: int, source: str, error: type[InputError]) -> None:
    """Raise an error if a file has more bytes than the memory limit."""
    _check(N_("MiB in a file"), -(-size // MIB), memory_limit(), MEMORY_VARIABLE, source, error)


def _check(items: str, count: int, limit: int, variable: str, source: str, error: type[InputError]) -> None:
    if count > limit:
        text = lazy_gettext(
            "{found} {what} exceed the limit of {most}: reduce the number or raise {variable}",
            found=count,
            what=lazy_gettext(items),
            most=limit,
            variable=variable,
        )
        raise error(lazy_gettext("{where}: {text}", where=source, text=text) if source else text)


def check_memory(items: str, count: int, item_bytes: int) -> None:
    """Raise an error if items, named in the plural, would take more than the memory limit."""
    limit = memory_limit()
    if count * item_bytes > limit * MIB:
        raise ParameterError(
            "{count} {what} need {found} MiB, more than the limit of {most} MiB: reduce the number, for example by a shorter time window, "
            "or raise {variable}",
            count=count,
            what=lazy_gettext(items),
            found=-(-count * item_bytes // MIB),
            most=limit,
            variable=MEMORY_VARIABLE,
        )
