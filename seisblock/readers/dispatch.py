"""Selection of the reader for a file or for the members of an archive."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from seisblock.core.errors import ParameterError, RecordFormatError, UnitError
from seisblock.core.i18n import lazy_gettext
from seisblock.readers.archive import list_members
from seisblock.readers.detect import ARCHIVE, OBSPY, detect_format
from seisblock.readers.formats.at2 import read_at2
from seisblock.readers.formats.cosmos import read_cosmos
from seisblock.readers.formats.csmip import read_csmip
from seisblock.readers.formats.cwa import read_cwa
from seisblock.readers.formats.esm import read_esm
from seisblock.readers.formats.geonet import read_geonet
from seisblock.readers.formats.jma_csv import read_jma_csv
from seisblock.readers.formats.knet import read_knet
from seisblock.readers.formats.knet_csv import read_knet_csv
from seisblock.readers.formats.obspy import read_obspy
from seisblock.readers.formats.plain_csv import read_plain_csv
from seisblock.readers.formats.smc import read_smc
from seisblock.readers.limits import ReadBudget
from seisblock.readers.source import RawFile
from seisblock.readers.table.headers import normalize_unit
from seisblock.records import Record

_READERS: dict[str, Callable[[RawFile], Record | list[Record]]] = {
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
_ALIASES = {
    "JMA": "JMA-CSV",
    "JMACSV": "JMA-CSV",
    "KIKNET": "KNET",
    "KNETCSV": "KNET-CSV",
    "K-NET": "KNET",
    "KIK-NET": "KNET",
    "CWB": "CWA",
}


@dataclass(frozen=True)
class ReadOptions:
    """Options for files that lack information in their headers."""

    format: str | None = None
    units: str | None = None
    dt: float | None = None
    station: str | None = None
    level: str | None = None
    budget: ReadBudget = field(default_factory=ReadBudget)


def read_parts(blob: RawFile, options: ReadOptions) -> list[Record]:
    """Return the records, or single components, in a file or an archive."""
    format_name = detect_format(blob)
    if format_name == ARCHIVE:
        return _read_archive(blob, options)
    parts = _read_file(blob, format_name, options)
    options.budget.count_samples(blob.name, sum(part.samples * len(part.components) for part in parts))
    return parts


def _read_file(blob: RawFile, format_name: str, options: ReadOptions) -> list[Record]:
    """Return the records in one file by the detected format or the format option."""
    kind = format_name if options.format is None else options.format.upper()
    kind = _ALIASES.get(kind, kind)
    if kind in _READERS:
        records = _READERS[kind](blob)
        return [_check_options(part, options) for part in (records if isinstance(records, list) else [records])]
    if kind == "CSV":
        return [read_plain_csv(blob, units=options.units, dt=options.dt)]
    waveform = None if kind == OBSPY else kind.removeprefix(OBSPY + ":")
    return [_check_options(part, options) for part in read_obspy(blob, units=options.units, waveform=waveform)]


def _read_archive(blob: RawFile, options: ReadOptions) -> list[Record]:
    """Return the parts in an archive; members that are not records are skipped."""
    members = list_members(blob, options.budget)
    parts: list[Record] = []
    for member in members:
        if detect_format(member) == OBSPY and options.format is None and options.units is None:
            continue
        parts.extend(replace(part, metadata={**part.metadata, "bundle": blob.name}) for part in read_parts(member, options))
    if not parts:
        member_names = [m.basename for m in members[:8]] or lazy_gettext("plots only")
        raise RecordFormatError(
            "{name}: no record found in this archive (contents: {held}); expected K-NET, KiK-net, JMA, AT2, CSMIP, COSMOS, SMC, "
            "ESM, GeoNet or CWA files, or plain tables",
            name=blob.name,
            held=member_names,
        )
    return parts


def _check_options(record: Record, options: ReadOptions) -> Record:
    """Return the record, after a check of its header against the options."""
    header_unit = str(record.metadata.get("unit", ""))
    if options.units is not None and header_unit:
        option_unit = normalize_unit(options.units)
        if option_unit is None:
            raise UnitError("unknown acceleration unit {units!r}: expected gal, m/s2 or g", units=options.units)
        if option_unit != header_unit:
            raise UnitError(
                "{source}: header unit {stated} contradicts `units` {units}; omit `units`",
                source=record.source,
                stated=header_unit,
                units=options.units,
            )
    if options.dt is not None and abs(options.dt - record.dt) > 1e-6:
        raise ParameterError(
            "{source}: header dt {dt:g} s contradicts `dt` {options_dt:g} s; omit `dt`",
            source=record.source,
            dt=record.dt,
            options_dt=options.dt,
        )
    return record
