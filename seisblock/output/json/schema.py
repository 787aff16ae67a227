"""Document schemas: command, parameter type, result type and record entries."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import msgspec
import numpy as np
from msgspec import UNSET, Meta, Struct, UnsetType

from seisblock import __version__
from seisblock.output.json.units import split_unit
from seisblock.records import QCFlag, Record
from seisblock.records.floor import is_floor_motion
from seisblock.records.qc_report import RecordChecks, qc_summary, record_checks
from seisblock.records.site import Earthquake, epicentral_distance_km, format_local_time, get_earthquake, get_site
from seisblock.references import papers

Entry = TypeVar("Entry", bound=Struct)

NOTES_KEY = {"notes": Annotated[list[str], Meta(description="Origin of the records, and assumptions on the objects.")]}
"""Key of documents about many objects, beside their results."""


def fill(kind: type[Entry], *sources: Any, **values: Any) -> Entry:
    """Return an entry from values of its keys, and from the first object with an attribute of the name of another key, unit aside."""
    for key in kind.__struct_fields__:
        if key not in values:
            names = (key, split_unit(key)[0])
            value = next((getattr(source, name) for source in sources for name in names if hasattr(source, name)), UNSET)
            if value is not UNSET:
                values[key] = value.tolist() if isinstance(value, np.ndarray) else value
    return kind(**values)


class Document(Struct, frozen=True, kw_only=True, tag_field="schema", tag="seisblock"):
    """One document ready to be written.

    Its type is made by a :class:`DocumentSchema`; ``schema``, the first key, names the command and the version of the keys.
    """

    if TYPE_CHECKING:
        version: str
        record: Any
        parameters: Any
        results: list[Any]
        warnings: list[str]
        citations: list[str]

    @property
    def command(self) -> str:
        """Name of the command."""
        return str(type(self).__struct_config__.tag).split("/")[1]


class EarthquakeEntry(Struct, frozen=True, kw_only=True):
    """Earthquake of a record, as far as its file contains it.

    Parameters
    ----------
    origin_time : str or None
        ISO 8601, UTC.
    latitude_deg, longitude_deg : float or None
        Epicentre, degrees north and east.
    depth_km : float or None
    magnitude : float or None
    name : str
        Empty if not in the file.
    """

    origin_time: str | None
    latitude_deg: float | None
    longitude_deg: float | None
    depth_km: float | None
    magnitude: float | None
    name: str


def _record_earthquake(record: Record) -> EarthquakeEntry | None:
    earthquake = get_earthquake(record)
    return None if earthquake is None else earthquake_entry(earthquake)


def earthquake_entry(earthquake: Earthquake) -> EarthquakeEntry:
    """Return the entry of an earthquake."""
    return fill(EarthquakeEntry, earthquake, origin_time=earthquake.origin_time.isoformat() if earthquake.origin_time else None)


class RecordEntry(Struct, frozen=True, kw_only=True):
    """Identification of a record.

    Parameters
    ----------
    network, station, location : str
        Codes; network and location are empty if not in the file.
    station_name : str
        Empty if not in the file.
    latitude_deg, longitude_deg : float or None
        Of the station, degrees north and east.
    start : str or None
        Time of the first sample, ISO 8601, UTC.
    local_start : str
        The same in the local time of the network, with the time zone; empty if unknown.
    earthquake : Earthquake or None
    epicentral_distance_km : float or None
        From the epicentre to the station.
    dt_s : float
        Sampling interval.
    samples : int
    sha256 : str
        Of the file.
    format, source : str
        Name of the format and of the file.
    components : list of str
    offset_s : float
        Time of the first sample used, from the record's first.
    history : list of str
        Processing steps, in order.
    channels : list of str or None
        Names of the channels of the components; null if not in the file.
    azimuths_deg : list of float or None
        Azimuths of the components, clockwise from north; null if vertical or unknown.
    checks : RecordChecks
        What was proved and what was assumed, in the words count, peak, clock, unit, sign, instrument, repetition, earthquake.
    doubts : list of Doubt
        Quality flags; their messages are also among the warnings.
    """

    network: str
    station: str
    location: str
    station_name: str
    latitude_deg: float | None
    longitude_deg: float | None
    start: str | None
    local_start: str
    earthquake: EarthquakeEntry | None
    epicentral_distance_km: float | None
    dt_s: float
    samples: int
    sha256: str
    format: str
    source: str
    components: tuple[str, ...]
    offset_s: float
    history: tuple[str, ...]
    channels: tuple[str | None, ...]
    azimuths_deg: tuple[float | None, ...]
    checks: RecordChecks
    doubts: tuple[QCFlag, ...]


def record_entry(record: Record) -> RecordEntry:
    """Return the entry of a record."""
    site = get_site(record)
    return fill(
        RecordEntry,
        record,
        site,
        station_name=site.name,
        local_start=format_local_time(record, record.start),
        earthquake=_record_earthquake(record),
        epicentral_distance_km=epicentral_distance_km(record),
        start=record.start.isoformat() if record.start else None,
        source=Path(record.source).name if record.source else "",
        components=record.codes,
        history=tuple(record.history),
        channels=tuple(record.channels.get(code) for code in record.codes),
        azimuths_deg=tuple(c.azimuth_deg for c in record.components),
        checks=record_checks(record),
    )


class Result(Struct, frozen=True, kw_only=True):
    """One entry of ``results``."""

    record_index: Annotated[int, Meta(description="Index of the record, if there are several.")] | UnsetType = UNSET


def is_optional(kind: Any) -> bool:
    """Return whether a key of this type may be absent from documents."""
    return UnsetType in getattr(kind, "__args__", ())


RecordResult = tuple[Record | None, Result]
"""A result with its record."""


@dataclass(frozen=True)
class DocumentSchema:
    """Definition of one kind of document.

    Parameters
    ----------
    command : str
    parameters, result : type
        Parameters of the command, and one entry of ``results``.
    extra : mapping of str to type
        Further keys, between the results and the warnings.
    name : str
        Distinguishes several kinds of one command.
    version : int
        Incremented when a key is removed or changes name, unit or type; not when one is added.
    """

    command: str
    parameters: type[Struct]
    result: type[Result]
    extra: Mapping[str, Any] = field(default_factory=dict)
    name: str = ""
    version: int = 1

    @property
    def schema(self) -> str:
        """Value of the key ``schema``."""
        return f"seisblock/{self.command}/{self.version}"

    @cached_property
    def type(self) -> type[Document]:
        """Struct type of the document; its fields are the keys."""
        fields = {
            "version": Annotated[str, Meta(description="Version of seisblock.")],
            "record": Annotated[RecordEntry | list[RecordEntry] | None, Meta(description="Record, list of records, or null.")],
            "parameters": self.parameters,
            "results": list[self.result],  # type: ignore[name-defined]
            **self.extra,
            "warnings": Annotated[list[str], Meta(description="Warnings on the results.")],
            "citations": Annotated[list[str], Meta(description="Keys of the cited papers; seisblock cite prints them.")],
        }
        declared = [(key, kind, UNSET) if is_optional(kind) else (key, kind) for key, kind in fields.items()]
        name = "".join(part.capitalize() for part in f"{self.command}-{self.name}".replace("-", " ").split()) + "Document"
        document_type: Any = msgspec.defstruct(name, declared, bases=(Document,), tag=self.schema, frozen=True, kw_only=True)
        return document_type  # type: ignore[no-any-return]

    def document(
        self,
        parameters: Struct,
        results: Iterable[RecordResult],
        *,
        records: Sequence[Record] = (),
        citations: Sequence[str] = (),
        warnings: Iterable[str] = (),
        has_floor_motion: bool = False,
        **extra: Any,
    ) -> Document:
        """Return the document of results; with several records each result holds its record index.

        Parameters
        ----------
        parameters : Struct
            Parameters of the command.
        results : iterable of (Record or None, Result)
            In the requested order.
        records : sequence of Record
            Records without a result of their own.
        citations, warnings : sequences of str
            Duplicates are removed.
        has_floor_motion : bool
            Whether the motions are floor motions although no record is marked as one.
        beside
            Values of the extra keys.
        """
        pairs = list(results)
        records = list({id(record): record for record in (*(r for r, _ in pairs), *records) if record is not None}.values())
        index = {id(record): i for i, record in enumerate(records)} if len(records) > 1 else {}
        entries = [record_entry(record) for record in records]
        return self.type(
            version=__version__,
            record=entries[0] if len(entries) == 1 else entries or None,
            parameters=parameters,
            results=[msgspec.structs.replace(entry, record_index=index[id(r)]) if id(r) in index else entry for r, entry in pairs],
            warnings=list(dict.fromkeys([*qc_summary(records), *warnings])),
            citations=list(
                dict.fromkeys([*citations, *(papers("storey") if has_floor_motion or any(map(is_floor_motion, records)) else ())])
            ),
            **extra,
        )
