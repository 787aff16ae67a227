"""Second stage of reading: bytes to components, by the registered format of the file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import cast

from seisblock.core.errors import ParameterError, UnitError
from seisblock.readers.options import ReadOptions
from seisblock.readers.registry import detect_format, find_format
from seisblock.readers.response import Inventories
from seisblock.readers.source import RawFile, normalize_text
from seisblock.readers.table.headers import normalize_unit
from seisblock.records import Record


def parse_file(blob: RawFile, options: ReadOptions, find_inventories: Callable[[], tuple[RawFile, ...]] = tuple) -> list[Record]:
    """Return the records, or single components, in a file of the detected format or of the format in the options.

    `find_inventories` returns the StationXML files beside the file; called for formats with a response only.

    Raise an InputError if the file is malformed, exceeds the limit of samples, or contradicts the options.
    """
    blob = normalize_text(blob)
    file_format = detect_format(blob) if options.format is None else find_format(options.format)
    if "inventory" in file_format.options and options.inventory is None:
        options = replace(options, inventory=Inventories(find_inventories()))
    result = file_format.parse(blob, **{key: getattr(options, key) for key in file_format.options})
    parts = result if isinstance(result, list) else [result]
    for part in parts:
        _check_options(part, options)
    # without a unit in the header, it is the one of the options
    proves = tuple(word for word in file_format.proves if word != "unit" or "units" not in file_format.options or options.units is None)
    parts = [
        replace(p, metadata={**p.metadata, "proved": (*proves, *cast("tuple[str, ...]", p.metadata.get("proved", ())))}) for p in parts
    ]
    options.budget.count_samples(blob.name, sum(part.samples * len(part.components) for part in parts))
    return parts


def _check_options(record: Record, options: ReadOptions) -> None:
    """Raise if the header of a record contradicts the options."""
    header_unit = str(record.metadata.get("unit", ""))
    if options.units is not None and header_unit:
        option_unit = normalize_unit(options.units)
        if option_unit is None:
            raise UnitError("unknown acceleration unit {units!r}: expected gal, m/s2 or g", units=options.units)
        if option_unit != header_unit:
            message = "{source}: header unit {stated} contradicts `units` {units}; omit `units`"
            raise UnitError(message, source=record.source, stated=header_unit, units=options.units)
    if options.dt is not None and abs(options.dt - record.dt) > 1e-6:
        message = "{source}: header dt {dt:g} s contradicts `dt` {options_dt:g} s; omit `dt`"
        raise ParameterError(message, source=record.source, dt=record.dt, options_dt=options.dt)
