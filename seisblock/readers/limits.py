"""Limits of one read against decompression bombs: bytes, archive members, nesting and samples."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from seisblock.core.errors import RecordError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import FACTOR_VARIABLE, MAX_MEMBERS, MAX_NESTING, MEMORY_VARIABLE, MIB, count_limit, memory_limit

_SAMPLE_BYTES = 8


class Readable(Protocol):
    """Protocol of binary streams."""

    def read(self, size: int, /) -> bytes:
        """Return up to `size` bytes."""


@dataclass
class ReadBudget:
    """Counters of what has been read; each method that counts raises RecordError beyond the limit."""

    limit_mib: int = field(default_factory=memory_limit)
    bytes_read: int = field(default=0, init=False)
    members_read: int = field(default=0, init=False)
    samples_read: int = field(default=0, init=False)

    def check_declared_size(self, name: str, count: int) -> None:
        """Check a declared size, which may be far beyond the memory, before reading."""
        if self.bytes_read + count > self.limit_mib * MIB:
            _raise_exceeded(name, -(-count // MIB), self.limit_mib, MEMORY_VARIABLE, "MiB")

    def read(self, name: str, stream: Readable) -> bytes:
        """Return the content of a stream, read in chunks within the limit."""
        limited_reader = LimitedReader(name, stream, self)
        return b"".join(iter(lambda: limited_reader.read(MIB), b""))

    def count_bytes(self, name: str, count: int) -> None:
        """Count bytes read or unpacked."""
        self.bytes_read += count
        if self.bytes_read > self.limit_mib * MIB:
            raise RecordError(
                "{name}: larger than the limit of {limit} MiB; set {variable} to read more",
                name=name,
                limit=self.limit_mib,
                variable=MEMORY_VARIABLE,
            )

    def count_member(self, name: str) -> None:
        """Count one member of an archive."""
        self.members_read += 1
        if self.members_read > (limit := count_limit(MAX_MEMBERS)):
            _raise_exceeded(name, self.members_read, limit, FACTOR_VARIABLE, N_("files"))

    def check_nesting(self, name: str, depth: int) -> None:
        """Check the depth of an archive inside archives."""
        if depth > (limit := count_limit(MAX_NESTING)):
            _raise_exceeded(name, depth, limit, FACTOR_VARIABLE, N_("levels of nested archives"))

    def count_samples(self, name: str, count: int) -> None:
        """Count samples that were read."""
        self.samples_read += count
        if self.samples_read > (limit := self.limit_mib * MIB // _SAMPLE_BYTES):
            _raise_exceeded(name, self.samples_read, limit, MEMORY_VARIABLE, N_("samples"))


def _raise_exceeded(name: str, count: int, limit: int, variable: str, quantity: str) -> None:
    raise RecordError(
        "{name}: {found} {what}, more than the limit of {limit}; set {variable} to read more",
        name=name,
        found=count,
        what=lazy_gettext(quantity),
        limit=limit,
        variable=variable,
    )


@dataclass(frozen=True)
class LimitedReader:
    """Stream that counts the bytes read against a budget; its name stands in messages."""

    name: str
    stream: Readable
    budget: ReadBudget

    def read(self, size: int, /) -> bytes:
        """Return up to `size` bytes."""
        piece = self.stream.read(size)
        self.budget.count_bytes(self.name, len(piece))
        return piece


MAX_RESAMPLED = 20_000_000
"""Samples of a component after resampling of uneven times."""
