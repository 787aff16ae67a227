"""Traces of ObsPy as single-component records: unit, instrument and direction from a StationXML, else from user and channel code."""

from __future__ import annotations

import re
import tempfile
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields
from datetime import UTC
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from seisblock.core import units
from seisblock.core.errors import RecordFormatError, UnitError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._header import drop_missing
from seisblock.readers._header_check import qc_flag
from seisblock.readers.directions import Direction, direction_from_azimuth, parse_direction
from seisblock.readers.response import (
    ACCELERATION,
    VELOCITY,
    Inventories,
    Quantity,
    channel_orientation,
    differentiate,
    find_channel,
    input_quantity,
    remove_full_response,
    remove_sensitivity,
    require_response,
    response_hint,
)
from seisblock.readers.source import MAX_QUOTED_LENGTH, RawFile
from seisblock.readers.table.headers import normalize_unit
from seisblock.readers.table.parse import to_si_in_place
from seisblock.records import Component, QCFlag, Record

_SEED_CODE = re.compile(r"[FGDCESHBMLVUR]([A-Z])[ENZ123ABCTRUVWQL]")
ACCELEROMETERS, SEISMOMETERS = "NG", "HLP"
"""Instrument letters of SEED channel codes."""

_LETTERS = {"N": "NS", "E": "EW", "Z": "UD"}
_LETTER_AZIMUTHS = {"N": 0.0, "E": 90.0}
MAX_MISALIGNMENT_DEG = 5.0
"""Largest difference of the azimuth of a channel N or E from north or east, degrees, as in the SEED manual."""

VELOCITY_UNITS = {**units.VELOCITY_UNITS, "um/s": 1e-6, "nm/s": 1e-9}
"""Units of velocities to be differentiated, m/s."""

FileFlags = Callable[[bytes, Sequence[Any]], "Sequence[QCFlag]"]
"""``flags(data, traces)``: quality flags of a file of one format."""


@dataclass(frozen=True)
class WaveformOptions:
    """Options that apply to traces: unit of the samples, StationXML, consent to differentiate, way to remove the response.

    Its fields, `WAVEFORM_OPTIONS`, are the read options of each waveform format.
    """

    units: str | None = None
    inventory: Inventories = field(default_factory=Inventories)
    differentiate: bool = False
    response: str = "sensitivity"

    def __post_init__(self) -> None:
        require_response(self.response)


WAVEFORM_OPTIONS = tuple(option.name for option in fields(WaveformOptions))


class Conversion(NamedTuple):
    """Samples in m/s^2, with history, flags, unit as stated by the file or the options, and what was proved."""

    values: FloatArray
    history: tuple[str, ...] = ()
    flags: tuple[QCFlag, ...] = ()
    unit: str = ""
    proved: tuple[str, ...] = ()


def instrument_letter(channel: str) -> str:
    """Return the instrument letter of a SEED channel code; empty for other names.

    Examples
    --------
    >>> instrument_letter("HNE"), instrument_letter("BHZ"), instrument_letter("ACC")
    ('N', 'H', '')
    """
    match = _SEED_CODE.fullmatch(channel.upper())
    return match[1] if match else ""


def read_waveform_file(blob: RawFile, waveform: str, options: WaveformOptions, file_flags: FileFlags | None = None) -> list[Record]:
    """Return the components in a file of one waveform format of ObsPy.

    Raises
    ------
    RecordFormatError
        If ObsPy fails on the file.
    UnitError
        If the unit is missing, or the samples are no accelerations.
    """
    with tempfile.TemporaryDirectory(prefix="seisblock-") as directory:
        path = write_temporary(blob, directory)
        traces, warning_texts = read_traces(blob.name, path, waveform)
    flags = tuple(dict.fromkeys((*obspy_flags(warning_texts), *(file_flags(blob.data, traces) if file_flags else ()))))
    traces.reverse()
    # popped one by one, so that the samples of ObsPy are freed during conversion
    return [trace_to_record(blob.name, traces.pop(), waveform, options, flags) for _ in range(len(traces))]


def write_temporary(blob: RawFile, directory: str) -> Path:
    """Write the bytes of a file into a directory and return the path; the suffix, which ObsPy may use, is kept."""
    suffix = "".join(c for c in Path(blob.basename).suffix[:12] if c.isalnum() or c == ".")
    path = Path(directory) / f"record{suffix}"
    path.write_bytes(blob.data)
    return path


def read_traces(name: str, path: Path, waveform: str) -> tuple[list[Any], list[str]]:
    """Return the traces of a file, contiguous pieces merged, and the warnings of ObsPy."""
    import obspy

    try:
        with warnings.catch_warnings(record=True) as warning_list:
            warnings.simplefilter("always", UserWarning)
            # merge joins contiguous pieces; gaps become masked samples, which are refused later
            stream = obspy.read(str(path), format=waveform).merge()
    except Exception as error:  # ObsPy's readers raise bare Exceptions
        # the temporary copy is no file of the user
        reason = " ".join(str(error).replace(str(path), name).split())[:MAX_QUOTED_LENGTH] or type(error).__name__
        raise RecordFormatError("{name}: ObsPy cannot read the file as {format} ({why})", name=name, format=waveform, why=reason) from error
    if not stream:
        raise RecordFormatError("{name}: no samples found by ObsPy", name=name)
    return list(stream), [str(warning.message) for warning in warning_list if issubclass(warning.category, UserWarning)]


def obspy_flags(warning_texts: Sequence[str]) -> list[QCFlag]:
    """Return flags for the warnings of ObsPy (integrity checks, incomplete last blocks)."""
    texts = [" ".join(text.split())[:MAX_QUOTED_LENGTH] for text in warning_texts]
    # one for each kind: ObsPy warns of every unreadable block
    kinds = {re.sub(r"\d+", "", text): text for text in reversed(texts)}
    return [qc_flag("ObsPy warning: {warning}", "header", warning=text) for text in reversed(kinds.values())]


def trace_to_record(
    name: str,
    trace: Any,
    waveform: str,
    options: WaveformOptions,
    flags: tuple[QCFlag, ...] = (),
    *,
    physical: Quantity | None = None,
) -> Record:
    """Return one trace as a single-component record.

    Parameters
    ----------
    name : str
        Source in messages.
    trace : obspy.Trace
        Its samples may be overwritten.
    waveform : str
        Format of ObsPy.
    options : WaveformOptions
    flags : tuple of QCFlag
        Quality flags of the file.
    physical : Quantity or None
        Quantity of samples whose response has been removed; None for samples as recorded.
    """
    stats = trace.stats
    _check_samples(name, trace)
    if physical is None and options.units is None and not options.inventory.is_requested:
        physical = evt_quantity(trace)
    channel = None if physical else _find_channel(trace, options.inventory)
    if channel is None and not physical and options.inventory.is_requested and options.units is None:
        message = "{name}: channel {channel} is not in the StationXML; give the StationXML of this station"
        raise UnitError(message, name=name, channel=trace.id)
    if channel is None:
        conversion = _convert_without_response(name, trace, waveform, options, physical)
    else:
        conversion = _convert_with_response(name, trace, channel, options)
    direction, direction_notes, has_orientation = _direction(trace, channel)
    values = conversion.values
    if direction.sign < 0:
        values = -values
    start = stats.starttime.datetime.replace(tzinfo=UTC) if stats.starttime.timestamp else None
    # a factor leaves the offset of the instrument
    has_offset = physical.factor != 1.0 if physical else channel is not None and options.response == "sensitivity"
    metadata = {
        "unit": conversion.unit,
        "channel": trace.id,
        "network": stats.network,
        "location": stats.location,
        "sensor": f"{stats.location}.{stats.channel[:2]}" if instrument_letter(stats.channel) else "",
        "channels": {direction.code: stats.channel} if stats.channel else None,
        "carries_offset": has_offset or None,
        "proved": (*conversion.proved, *(("sign",) if has_orientation else ())),
        **({} if channel is None or not (channel.latitude or channel.longitude) else _site(channel)),
    }
    return Record(
        (Component(direction.code, values, direction.azimuth_deg),),
        float(stats.delta),
        station=stats.station,
        # 1970-01-01 is ObsPy's default for files without a time
        start=start,
        source=name,
        format=f"OBSPY:{waveform}",
        history=(*conversion.history, *direction_notes),
        metadata=drop_missing(metadata),
        doubts=(*flags, *conversion.flags),
    )


def _check_samples(name: str, trace: Any) -> None:
    """Raise for gaps, text and traces without an interval."""
    if np.ma.is_masked(trace.data):
        raise RecordFormatError(
            "{name}: channel {channel} has gaps, or overlaps with different samples; extract a window without them",
            name=name,
            channel=trace.id,
        )
    if trace.data.dtype.kind not in "iuf":
        raise RecordFormatError("{name}: channel {channel} contains text, not samples", name=name, channel=trace.id)
    if trace.data.size < 2 or not trace.stats.delta > 0:
        message = "{name}: channel {channel} is not a waveform ({count} samples, interval {dt} s)"
        raise RecordFormatError(message, name=name, channel=trace.id, count=trace.data.size, dt=trace.stats.delta)


def _find_channel(trace: Any, inventories: Inventories) -> Any:
    inventory = inventories.load(trace.stats.network, trace.stats.station)
    return None if inventory is None else find_channel(inventory, trace)


def _as_floats(trace: Any) -> FloatArray:
    """Return the samples as owned floats, which can be scaled in place."""
    return np.require(np.ma.getdata(trace.data), np.float64, ["C", "O", "W"])


def is_counts(values: FloatArray) -> bool:
    """Return whether all samples are whole numbers and not all zero."""
    return bool(values.any()) and bool((values == np.rint(values)).all())


def _convert_with_response(name: str, trace: Any, channel: Any, options: WaveformOptions) -> Conversion:
    """Return samples after removal of the response of a channel."""
    if options.units is not None and not options.inventory.is_requested and trace.data.dtype.kind == "f":
        # the user states the unit of samples that may have been processed
        return _convert_without_response(name, trace, "", options, None)
    quantity = input_quantity(channel, trace.id)
    if options.units is not None:
        message = "{name}: the StationXML of {channel} gives the unit ({unit}): omit `units`"
        raise UnitError(message, name=name, channel=trace.id, unit=channel.response.instrument_sensitivity.input_units)
    if quantity.name == VELOCITY and not options.differentiate:
        raise _velocity_error(name, trace)
    values = _as_floats(trace)
    if not options.inventory.is_requested and not is_counts(values) and values.any():
        raise processed_counts_error(name, trace)
    proved = ("unit", "instrument")
    if options.response == "full":
        values, entry = remove_full_response(trace, channel, trace.id)
        return Conversion(values, (entry,), proved=proved)
    history: tuple[str, ...] = (remove_sensitivity(values, channel, quantity, trace.id),)
    if quantity.name == VELOCITY:
        values, entry = differentiate(values, float(trace.stats.delta), trace.id)
        history += (entry,)
    return Conversion(values, history, proved=proved)


def processed_counts_error(name: str, trace: Any) -> UnitError:
    """Return the error of counts that were processed, by a response or by a filter."""
    message = (
        "{name}: samples of {channel} are not whole numbers, so the response may have been removed: give `units` if so, or the "
        "StationXML as `inventory` to remove it"
    )
    return UnitError(message, name=name, channel=trace.id)


def _velocity_error(name: str, trace: Any) -> UnitError:
    return UnitError(
        "{name}: {channel} is a velocity channel, not an accelerometer: give the accelerometer (HN?, EN?), or `differentiate` to "
        "compute accelerations from it",
        name=name,
        channel=trace.id,
    )


def _convert_without_response(name: str, trace: Any, waveform: str, options: WaveformOptions, physical: Quantity | None) -> Conversion:
    """Return samples in the unit given by the user, or as they are if `physical`."""
    stats = trace.stats
    quantity_name, flags = (physical.name, ()) if physical else _stated_quantity(name, trace, waveform)
    if quantity_name == VELOCITY and not options.differentiate:
        raise _velocity_error(name, trace)
    if options.response == "full" and not physical:
        message = "{name}: the full response requires the StationXML of {channel}; give `inventory`"
        raise UnitError(message, name=name, channel=trace.id)
    is_integer = trace.data.dtype.kind in "iu" or (waveform == "STREAM" and is_counts(trace.data))
    history: tuple[str, ...] = ()
    values = _as_floats(trace)
    if physical:
        unit = "m/s2" if physical.factor == 1.0 else ""
        values *= physical.factor
        if physical.factor != 1.0:
            message = "{channel}: calibration factor {factor:g} of the file applied"
            history = (lazy_gettext(message, channel=trace.id, factor=physical.factor),)
    elif options.units is None:
        raise _missing_unit_error(name, trace, waveform, is_integer=is_integer)
    elif quantity_name == VELOCITY:
        factor = VELOCITY_UNITS.get(options.units.strip().lower())
        if factor is None:
            message = "unknown velocity unit {units!r}: expected {known}"
            raise UnitError(message, units=options.units, known=list(VELOCITY_UNITS))
        values *= factor
        unit = ""
    else:
        known_unit = normalize_unit(options.units)
        if known_unit is None:
            raise UnitError("unknown acceleration unit {units!r}: expected gal, m/s2 or g", units=options.units)
        unit, values = known_unit, to_si_in_place(values, known_unit)
        if is_integer and waveform == "MSEED":
            message = "{channel}: whole numbers (usually counts) taken in {unit}, as given by `units`; a StationXML gives their unit"
            history = (lazy_gettext(message, channel=trace.id, unit=known_unit),)
        if stats.calib != 1.0:
            message = "{channel}: calibration factor {factor:g} of the file not applied; samples taken in the unit given by `units`"
            flags = (*flags, qc_flag(message, "calibration", channel=trace.id, factor=stats.calib))
    if quantity_name == VELOCITY:
        values, entry = differentiate(values, float(stats.delta), trace.id)
        history = (*history, entry)
    has_factor = physical is not None and physical.factor != 1.0
    proved = (*(("unit",) if has_factor else ()), *(("instrument",) if instrument_letter(stats.channel) in tuple(ACCELEROMETERS) else ()))
    return Conversion(values, history, flags, unit, proved)


_EVT_ACCELEROMETERS = frozenset({1, *range(10, 17), 20, 32, 39})
"""Sensor types in the header of Kinemetrics recorders that are accelerometers: unnamed ones, FBA, EpiSensor, CMG-5."""


def evt_quantity(trace: Any) -> Quantity | None:
    """Return the quantity of an accelerometer in a file of a Kinemetrics recorder (K2, Etna), None for other traces.

    The calibration factor of ObsPy, from range and sensitivity in the header, gives m/s^2. It is 1 if it was applied already, or stays in
    the trace: the largest and smallest count in the header tell counts from accelerations.
    """
    header = trace.stats.get("kinemetrics_evt")
    if header is None or header.chan_sensortype not in _EVT_ACCELEROMETERS:
        return None
    calib = float(trace.stats.calib)
    has_counts = is_counts(trace.data) or np.ptp(trace.data) > calib**0.5 * (header.maxpeak - header.minpeak)
    return Quantity(ACCELERATION, calib if has_counts else 1.0)


def _missing_unit_error(name: str, trace: Any, waveform: str, *, is_integer: bool) -> UnitError:
    stats = trace.stats
    if is_integer and stats.station:
        message = (
            "{name}: {channel} contains counts, and their instrument response is missing: put the StationXML of the station beside the "
            "file, or give it as `inventory` ({hint})"
        )
        return UnitError(message, name=name, channel=trace.id, hint=response_hint(stats.network, stats.station))
    if is_integer:
        # WIN of NIED and of Japanese networks
        message = (
            "{name}: {format} file with counts, without scale factor and station code: download the same record as K-NET ASCII, JMA CSV, "
            "or miniSEED with StationXML"
        )
        return UnitError(message, name=name, format=waveform)
    message = "{name}: {format} file without a sample unit: give the StationXML as `inventory`, or `units`, gal|m/s2|g"
    return UnitError(message, name=name, format=waveform)


_SAC_QUANTITIES = {6: "displacement", 7: VELOCITY, 8: ACCELERATION}
"""Quantity by the SAC entry ``IDEP``."""


def _stated_quantity(name: str, trace: Any, waveform: str) -> tuple[str, tuple[QCFlag, ...]]:
    """Return the quantity of samples without response, by channel code and SAC header, and a flag if these contradict each other."""
    letter = instrument_letter(trace.stats.channel)
    by_code = ACCELERATION if letter in ACCELEROMETERS else VELOCITY if letter in SEISMOMETERS else "other"
    if by_code == "other":
        message = "{name}: {channel} is neither an accelerometer nor a seismometer (instrument code {letter}); give the accelerometer (HN?)"
        raise UnitError(message, name=name, channel=trace.id, letter=letter)
    by_header = _SAC_QUANTITIES.get(int(trace.stats.sac.get("idep", 5))) if waveform == "SAC" and "sac" in trace.stats else None
    if by_header is None:
        return by_code, ()
    if by_header == "displacement":
        raise UnitError("{name}: {channel} contains displacements (IDEP); give accelerations", name=name, channel=trace.id)
    if letter and by_header != by_code:
        message = "{channel}: the SAC header states {quantity} (IDEP), the channel code another instrument"
        return by_header, (qc_flag(message, "header", channel=trace.id, quantity=lazy_gettext(by_header)),)
    return by_header, ()


def _direction(trace: Any, channel: Any) -> tuple[Direction, tuple[str, ...], bool]:
    """Return the direction of a trace, history entries, and whether its orientation is stated by azimuth and dip."""
    code = trace.stats.channel.upper()
    orientation = None if channel is None else channel_orientation(channel, trace.id)
    if orientation is not None:
        if orientation.azimuth_deg is None:
            return Direction("UD", sign=orientation.sign), (), True
        nominal = _LETTER_AZIMUTHS.get(code[-1:])
        # the difference of two azimuths, -180 to 180
        skew = 0.0 if nominal is None else (orientation.azimuth_deg - nominal + 180.0) % 360.0 - 180.0
        notes: tuple[str, ...] = ()
        if abs(skew) > MAX_MISALIGNMENT_DEG:
            # several networks name channels N and E whatever their azimuths
            message = "{channel}: azimuth {azimuth:g} degrees of the StationXML used, not that of the channel code"
            notes = (lazy_gettext(message, channel=trace.id, azimuth=orientation.azimuth_deg),)
        return direction_from_azimuth(orientation.azimuth_deg), notes, True
    direction = parse_direction(trace.stats.channel)
    if direction is None or direction.is_bare_number:
        direction = Direction(_LETTERS.get(code[-1:], code or "ACC"))
    return direction, (), False


def _site(channel: Any) -> dict[str, object]:
    """Return the coordinates of an ObsPy channel as metadata."""
    latitude, longitude, height = channel.latitude, channel.longitude, channel.elevation
    return {
        "station_latitude_deg": None if latitude is None else float(latitude),
        "station_longitude_deg": None if longitude is None else float(longitude),
        "station_height_m": None if height is None else float(height),
    }
