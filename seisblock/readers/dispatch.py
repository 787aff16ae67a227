"""From one file to the parts in it: the format's reader is found and called."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from seisblock.errors import ParameterError, RecordFormatError, UnitError
from seisblock.readers.budget import Budget, budget
from seisblock.readers.bundle import members_of
from seisblock.readers.detect import BUNDLE, OBSPY, format_of
from seisblock.readers.formats.at2 import read_at2
from seisblock.readers.formats.cosmos import read_cosmos
from seisblock.readers.formats.csmip import read_csmip
from seisblock.readers.formats.cwa import read_cwa
from seisblock.readers.formats.esm import read_esm
from seisblock.readers.formats.generic import read_generic
from seisblock.readers.formats.geonet import read_geonet
from seisblock.readers.formats.jma_csv import read_jma_csv
from seisblock.readers.formats.knet import read_knet
from seisblock.readers.formats.knet_csv import read_knet_csv
from seisblock.readers.formats.plain_csv import read_plain_csv
from seisblock.readers.formats.smc import read_smc
from seisblock.readers.naming import normal_unit
from seisblock.readers.source import Blob
from seisblock.records import Record
from seisblock.words import said

_SELF_DESCRIBING: dict[str, Callable[[Blob], Record | list[Record]]] = {
    "JMA-CSV": read_jma_csv,
    "KNET": read_knet,
    "KNET-CSV": read_knet_csv,
    "CWA": read_cwa,
    "GEONET": read_geonet,
    "COSMOS": read_cosmos,
    "CSMIP": read_csmip,
    "SMC": read_smc,
    "ESM": read_esm,
    "AT2": read_at2,
}
_SPELLINGS = {
    "JMA": "JMA-CSV",
    "JMACSV": "JMA-CSV",
    "KIKNET": "KNET",
    "KNETCSV": "KNET-CSV",
    "K-NET": "KNET",
    "KIK-NET": "KNET",
    "CWB": "CWA",
}


@dataclass(frozen=True)
class Options:
    """What the caller says about files that do not say it themselves."""

    format: str | None = None
    units: str | None = None
    dt: float | None = None
    station: str | None = None
    level: str | None = None
    budget: Budget = field(default_factory=budget)


def parts_of(blob: Blob, options: Options) -> list[Record]:
    """Return the records, or single components, that a file or a bundle holds."""
    found = format_of(blob)
    if found == BUNDLE:
        return _of_bundle(blob, options)
    parts = _of_file(blob, found, options)
    options.budget.spend_samples(blob.name, sum(part.samples * len(part.components) for part in parts))
    return parts


def _of_file(blob: Blob, found: str, options: Options) -> list[Record]:
    """Return the records in one file, by the format it was found to be in or the one that the caller says."""
    kind = found if options.format is None else options.format.upper()
    kind = _SPELLINGS.get(kind, kind)
    if kind in _SELF_DESCRIBING:
        found_in = _SELF_DESCRIBING[kind](blob)
        return [_checked(part, options) for part in (found_in if isinstance(found_in, list) else [found_in])]
    if kind == "CSV":
        return [read_plain_csv(blob, units=options.units, dt=options.dt)]
    waveform = None if kind == OBSPY else kind.removeprefix(OBSPY + ":")
    return [_checked(part, options) for part in read_generic(blob, units=options.units, waveform=waveform)]


def _of_bundle(blob: Blob, options: Options) -> list[Record]:
    """Return the parts in a bundle; files in it that are no records are passed over."""
    members = members_of(blob, options.budget)
    parts: list[Record] = []
    for member in members:
        if format_of(member) == OBSPY and options.format is None and options.units is None:
            continue
        parts.extend(replace(part, metadata={**part.metadata, "bundle": blob.name}) for part in parts_of(member, options))
    if not parts:
        held = [m.basename for m in members[:8]] or said("nothing but plots")
        raise RecordFormatError(
            "{name}: no record in this bundle, only {held}: expected files of K-NET, KiK-net, JMA, AT2, CSMIP, COSMOS, SMC, ESM, GeoNet "
            "or CWA, or plain tables",
            name=blob.name,
            held=held,
        )
    return parts


def _checked(record: Record, options: Options) -> Record:
    """Return a record whose header agrees with the options."""
    stated = str(record.metadata.get("unit", ""))
    if options.units is not None and stated:
        wanted = normal_unit(options.units)
        if wanted is None:
            raise UnitError("unknown unit of acceleration {units!r}: give gal, m/s2 or g", units=options.units)
        if wanted != stated:
            raise UnitError(
                "{source} is in {stated} by its own header, the option says {units}: leave the option out",
                source=record.source,
                stated=stated,
                units=options.units,
            )
    if options.dt is not None and abs(options.dt - record.dt) > 1e-6:
        raise ParameterError(
            "{source}: its header says dt = {dt:g} s, the option says {options_dt:g} s: leave the option out",
            source=record.source,
            dt=record.dt,
            options_dt=options.dt,
        )
    return record
