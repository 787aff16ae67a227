"""How much one reading may take: bytes, members of archives, nesting, samples. One budget is passed down and spent by whoever reads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from seisblock.core.errors import RecordError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import DEFAULT_LIMITS, MIB, get_limit

_CHUNK_SIZE = MIB
_PREFIX = "SEISBLOCK_READ_"


class Readable(Protocol):
    """Whatever gives bytes piece by piece."""

    def read(self, size: int, /) -> bytes:
        """Return so many bytes, fewer at the end."""


@dataclass
class ReadBudget:
    """What is left of what one reading may take; spent, never refilled.

    Parameters
    ----------
    limits : mapping of str to int
        By the names of the environment variables that set them.
    """

    limits: Mapping[str, int]
    bytes_read: int = field(default=0, init=False)
    members_read: int = field(default=0, init=False)
    samples_read: int = field(default=0, init=False)

    @property
    def remaining_bytes(self) -> int:
        """Bytes that may still be read or unpacked."""
        return self.limits["SEISBLOCK_READ_MIB"] * MIB - self.bytes_read

    def check_declared_size(self, name: str, count: int) -> None:
        """Refuse a file or a member that says itself that it is too large, before it is read."""
        if count > self.remaining_bytes:
            self._raise_exceeded(name, -(-count // MIB), "SEISBLOCK_READ_MIB", "MiB")

    def read(self, name: str, stream: Readable) -> bytes:
        """Return what a stream holds, read piece by piece and no further than the budget goes."""
        limited_reader = LimitedReader(name, stream, self)
        return b"".join(iter(lambda: limited_reader.read(_CHUNK_SIZE), b""))

    def check_bytes(self, name: str, count: int) -> None:
        """Count bytes that were read or unpacked."""
        self.bytes_read += count
        if self.remaining_bytes < 0:
            raise RecordError(
                "{name}: larger than the limit of {limit} MiB; set {variable} to read more",
                name=name,
                limit=self.limits["SEISBLOCK_READ_MIB"],
                variable="SEISBLOCK_READ_MIB",
            )

    def check_member(self, name: str) -> None:
        """Count one member of an archive."""
        self.members_read += 1
        if self.members_read > self.limits["SEISBLOCK_READ_MEMBERS"]:
            self._raise_exceeded(name, self.members_read, "SEISBLOCK_READ_MEMBERS", N_("files"))

    def check_nesting(self, name: str, depth: int) -> None:
        """Refuse an archive that lies too deep in others."""
        if depth > self.limits["SEISBLOCK_READ_NESTING"]:
            self._raise_exceeded(name, depth, "SEISBLOCK_READ_NESTING", N_("levels of nested archives"))

    def check_samples(self, name: str, count: int) -> None:
        """Count samples that were read."""
        self.samples_read += count
        if self.samples_read > self.limits["SEISBLOCK_READ_SAMPLES"]:
            self._raise_exceeded(name, self.samples_read, "SEISBLOCK_READ_SAMPLES", N_("samples"))

    def _raise_exceeded(self, name: str, count: int, variable: str, quantity: str) -> None:
        """Say what was found, what is allowed, and what lifts it."""
        raise RecordError(
            "{name}: {found} {what}, more than the limit of {limit}; set {variable} to read more",
            name=name,
            found=count,
            what=lazy_gettext(quantity),
            limit=self.limits[variable],
            variable=variable,
        )


@dataclass(frozen=True)
class LimitedReader:
    """A stream of which every byte is paid for as it is read.

    Parameters
    ----------
    name : str
        What messages call it.
    stream : Readable
    budget : Budget
    """

    name: str
    stream: Readable
    budget: ReadBudget

    def read(self, size: int, /) -> bytes:
        """Return so many bytes, fewer at the end."""
        piece = self.stream.read(size)
        self.budget.check_bytes(self.name, len(piece))
        return piece


def new_budget() -> ReadBudget:
    """Return a fresh budget, its limits from the environment where they stand there.

    Raises
    ------
    ParameterError
        If a variable is no positive whole number.
    """
    return ReadBudget({variable: get_limit(variable) for variable in DEFAULT_LIMITS if variable.startswith(_PREFIX)})
