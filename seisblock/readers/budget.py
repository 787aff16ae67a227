"""How much one reading may take: bytes, members of archives, nesting, samples. One budget is passed down and spent by whoever reads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from seisblock.errors import RecordError
from seisblock.limits import LIMITS, MIB, limit
from seisblock.words import noted, said

_CHUNK = MIB
_PREFIX = "SEISBLOCK_READ_"


class Readable(Protocol):
    """Whatever gives bytes piece by piece."""

    def read(self, size: int, /) -> bytes:
        """Return so many bytes, fewer at the end."""


@dataclass
class Budget:
    """What is left of what one reading may take; spent, never refilled.

    Parameters
    ----------
    limits : mapping of str to int
        By the names of the environment variables that set them.
    """

    limits: Mapping[str, int]
    bytes_spent: int = field(default=0, init=False)
    members_spent: int = field(default=0, init=False)
    samples_spent: int = field(default=0, init=False)

    @property
    def bytes_left(self) -> int:
        """Bytes that may still be read or unpacked."""
        return self.limits["SEISBLOCK_READ_MIB"] * MIB - self.bytes_spent

    def announce_bytes(self, name: str, count: int) -> None:
        """Refuse a file or a member that says itself that it is too large, before it is read."""
        if count > self.bytes_left:
            self._refuse(name, -(-count // MIB), "SEISBLOCK_READ_MIB", "MiB")

    def read(self, name: str, stream: Readable) -> bytes:
        """Return what a stream holds, read piece by piece and no further than the budget goes."""
        metered = Metered(name, stream, self)
        return b"".join(iter(lambda: metered.read(_CHUNK), b""))

    def spend_bytes(self, name: str, count: int) -> None:
        """Count bytes that were read or unpacked."""
        self.bytes_spent += count
        if self.bytes_left < 0:
            raise RecordError(
                "{name} holds more than the {limit} MiB that may be read: set {variable} to read more",
                name=name,
                limit=self.limits["SEISBLOCK_READ_MIB"],
                variable="SEISBLOCK_READ_MIB",
            )

    def spend_member(self, name: str) -> None:
        """Count one member of an archive."""
        self.members_spent += 1
        if self.members_spent > self.limits["SEISBLOCK_READ_MEMBERS"]:
            self._refuse(name, self.members_spent, "SEISBLOCK_READ_MEMBERS", noted("files"))

    def check_nesting(self, name: str, depth: int) -> None:
        """Refuse an archive that lies too deep in others."""
        if depth > self.limits["SEISBLOCK_READ_NESTING"]:
            self._refuse(name, depth, "SEISBLOCK_READ_NESTING", noted("archives within archives"))

    def spend_samples(self, name: str, count: int) -> None:
        """Count samples that were read."""
        self.samples_spent += count
        if self.samples_spent > self.limits["SEISBLOCK_READ_SAMPLES"]:
            self._refuse(name, self.samples_spent, "SEISBLOCK_READ_SAMPLES", noted("samples"))

    def _refuse(self, name: str, found: int, variable: str, what: str) -> None:
        """Say what was found, what is allowed, and what lifts it."""
        raise RecordError(
            "{name}: {found} {what}, and {limit} may be read: set {variable} to read more",
            name=name,
            found=found,
            what=said(what),
            limit=self.limits[variable],
            variable=variable,
        )


@dataclass(frozen=True)
class Metered:
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
    budget: Budget

    def read(self, size: int, /) -> bytes:
        """Return so many bytes, fewer at the end."""
        piece = self.stream.read(size)
        self.budget.spend_bytes(self.name, len(piece))
        return piece


def budget() -> Budget:
    """Return a fresh budget, its limits from the environment where they stand there.

    Raises
    ------
    ParameterError
        If a variable is no positive whole number.
    """
    return Budget({variable: limit(variable) for variable in LIMITS if variable.startswith(_PREFIX)})
