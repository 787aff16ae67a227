"""Read limits: bytes, archive members, nesting and samples, counted in one budget per reading."""

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
    """Protocol of binary streams."""

    def read(self, size: int, /) -> bytes:
        """Return up to `size` bytes."""


@dataclass
class ReadBudget:
    """Counters of bytes, members and samples read, and their limits by the names of their environment variables."""

    limits: Mapping[str, int]
    bytes_read: int = field(default=0, init=False)
    members_read: int = field(default=0, init=False)
    samples_read: int = field(default=0, init=False)

    @property
    def remaining_bytes(self) -> int:
        """Bytes that may still be read or unpacked."""
        return self.limits["SEISBLOCK_READ_MIB"] * MIB - self.bytes_read

    def check_declared_size(self, name: str, count: int) -> None:
        """Raise if a declared size exceeds the remaining bytes, before reading."""
        # before reading: a declared size may be far beyond the memory
        if count > self.remaining_bytes:
            self._raise_exceeded(name, -(-count // MIB), "SEISBLOCK_READ_MIB", "MiB")

    def read(self, name: str, stream: Readable) -> bytes:
        """Return the content of a stream, read in chunks within the limit."""
        limited_reader = LimitedReader(name, stream, self)
        return b"".join(iter(lambda: limited_reader.read(_CHUNK_SIZE), b""))

    def check_bytes(self, name: str, count: int) -> None:
        """Count bytes read or unpacked."""
        self.bytes_read += count
        if self.remaining_bytes < 0:
            message = "{name}: larger than the limit of {limit} MiB; set {variable} to read more"
            raise RecordError(message, name=name, limit=self.limits["SEISBLOCK_READ_MIB"], variable="SEISBLOCK_READ_MIB")

    def check_member(self, name: str) -> None:
        """Count one member of an archive."""
        self.members_read += 1
        if self.members_read > self.limits["SEISBLOCK_READ_MEMBERS"]:
            self._raise_exceeded(name, self.members_read, "SEISBLOCK_READ_MEMBERS", N_("files"))

    def check_nesting(self, name: str, depth: int) -> None:
        """Raise if an archive is nested too deeply."""
        if depth > self.limits["SEISBLOCK_READ_NESTING"]:
            self._raise_exceeded(name, depth, "SEISBLOCK_READ_NESTING", N_("levels of nested archives"))

    def check_samples(self, name: str, count: int) -> None:
        """Count samples that were read."""
        self.samples_read += count
        if self.samples_read > self.limits["SEISBLOCK_READ_SAMPLES"]:
            self._raise_exceeded(name, self.samples_read, "SEISBLOCK_READ_SAMPLES", N_("samples"))

    def _raise_exceeded(self, name: str, count: int, variable: str, quantity: str) -> None:
        message = "{name}: {found} {what}, more than the limit of {limit}; set {variable} to read more"
        raise RecordError(message, name=name, found=count, what=lazy_gettext(quantity), limit=self.limits[variable], variable=variable)


@dataclass(frozen=True)
class LimitedReader:
    """Stream that counts the bytes read against a budget; `name` is the source in messages."""

    name: str
    stream: Readable
    budget: ReadBudget

    def read(self, size: int, /) -> bytes:
        """Return up to `size` bytes."""
        piece = self.stream.read(size)
        self.budget.check_bytes(self.name, len(piece))
        return piece


def new_budget() -> ReadBudget:
    """Return a new budget with limits from the environment; raise ParameterError if a variable is not a positive whole number."""
    return ReadBudget({variable: get_limit(variable) for variable in DEFAULT_LIMITS if variable.startswith(_PREFIX)})
