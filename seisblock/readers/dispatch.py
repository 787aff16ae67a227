"""From one file to the parts in it: the format's reader is found and called."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from seisblock.errors import ParameterError, RecordFormatError, UnitError
from seisblock.readers.detect import OBSPY, format_of
from seisblock.readers.jma_csv import read_jma_csv
from seisblock.readers.naming import normal_unit
from seisblock.readers.plain_csv import read_plain_csv
from seisblock.readers.source import Blob
from seisblock.records import Record

_SELF_DESCRIBING: dict[str, Callable[[Blob], Record]] = {"JMA-CSV": read_jma_csv}
_SPELLINGS = {"JMA": "JMA-CSV", "JMACSV": "JMA-CSV", "JMA-CSV": "JMA-CSV", "CSV": "CSV"}


@dataclass(frozen=True)
class Options:
    """What the caller says about files that do not say it themselves."""

    format: str | None = None
    units: str | None = None
    dt: float | None = None
    station: str | None = None
    level: str | None = None


def parts_of(blob: Blob, options: Options) -> list[Record]:
    """Return the records, or single components, that a file holds."""
    kind = _SPELLINGS.get(options.format.upper(), options.format.upper()) if options.format else format_of(blob)
    if kind in _SELF_DESCRIBING:
        return [_checked(_SELF_DESCRIBING[kind](blob), options)]
    if kind == "CSV":
        return [read_plain_csv(blob, units=options.units, dt=options.dt)]
    raise RecordFormatError(f"{blob.name} is in no format that is known here: {OBSPY}")


def _checked(record: Record, options: Options) -> Record:
    """Return a record whose header agrees with the options."""
    stated = str(record.metadata.get("unit", ""))
    if options.units is not None and stated:
        wanted = normal_unit(options.units)
        if wanted is None:
            raise UnitError(f"unknown unit of acceleration {options.units!r}: give gal, m/s2 or g")
        if wanted != stated:
            raise UnitError(f"{record.source} is in {stated} by its own header, the option says {options.units}: leave the option out")
    if options.dt is not None and abs(options.dt - record.dt) > 1e-6:
        raise ParameterError(
            f"{record.source}: its header says dt = {record.dt:g} s, the option says {options.dt:g} s: leave the option out"
        )
    return record
