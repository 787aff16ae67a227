"""Instrument response: StationXML beside a record, physical units of its channels, sensitivity or full response removed by ObsPy."""

from __future__ import annotations

import io
import re
import warnings
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from seisblock.core.errors import ParameterError, RecordFormatError, UnitError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.readers.source import MAX_QUOTED_LENGTH, RawFile

RESPONSES = ("sensitivity", "full")
"""Ways to remove a response: division by the sensitivity, or deconvolution."""

ACCELERATION, VELOCITY = "acceleration", "velocity"

_PREFIXES = {"": 1.0, "C": 1e-2, "M": 1e-3, "U": 1e-6, "N": 1e-9}
_MOTION_UNIT = re.compile(r"([CMUN]?)M/(?:\(?(S)\)?|S(?:\*\*|\^)?2|\(S(?:\*\*|\^)2\)|S/S)")
_LENGTH_UNIT = re.compile(r"([CMUN]?)M")
_OTHER_UNITS = {"G": STANDARD_GRAVITY, "MG": 1e-3 * STANDARD_GRAVITY, "GAL": 1e-2, "CM/S2": 1e-2}

LOWEST_HZ, PERIODS = 0.05, 10.0
"""Lower end of the band of a full response: this frequency, or this number of periods in the record, whichever is higher."""

BAND_TAPER, UPPER_SHARES = 0.5, (0.8, 0.95)
"""Frequency at which the lower taper begins, relative to the lower end; ends of the band and of the upper taper, relative to Nyquist."""


class Quantity(NamedTuple):
    """Quantity of the input of an instrument, and its unit in SI units."""

    name: str
    factor: float


@dataclass(frozen=True)
class Inventories:
    """StationXML files, or an ObsPy inventory, from which responses are taken.

    `is_requested` is True for files that the user named, False for those found beside the record.
    """

    files: tuple[RawFile, ...] = ()
    inventory: Any = None
    is_requested: bool = False

    def load(self, network: str, station: str) -> Any:
        """Return the ObsPy inventory of the files that mention a station; None if there is none."""
        if self.inventory is not None:
            return self.inventory
        result = None
        for file in self.files:
            # a cheap test of the text, as a large StationXML takes seconds to parse
            if re.search(rb"""<Station\b[^>]*\bcode=["']%s["']""" % re.escape(station.encode()), file.data):
                loaded = read_station_xml(file)
                result = loaded if result is None else result + loaded
        return result


def is_station_xml(head: bytes) -> bool:
    """Return whether bytes begin a StationXML document."""
    return b"<FDSNStationXML" in head[:4096] or b":FDSNStationXML" in head[:4096]


def read_station_xml(file: RawFile) -> Any:
    """Return the ObsPy inventory in a StationXML file.

    Raises
    ------
    RecordFormatError
        If the file is not StationXML, or damaged.
    """
    import obspy

    if not is_station_xml(file.content[:4096]):
        raise RecordFormatError("{name}: not a StationXML file; expected the inventory of a station (level=response)", name=file.name)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return obspy.read_inventory(io.BytesIO(file.data), format="STATIONXML")
    except Exception as error:  # ObsPy's readers raise bare Exceptions
        reason = " ".join(str(error).split())[:MAX_QUOTED_LENGTH] or type(error).__name__
        raise RecordFormatError("{name}: ObsPy cannot read the StationXML ({why})", name=file.name, why=reason) from error


def parse_input_units(text: str) -> Quantity | None:
    """Return the quantity of input units in StationXML, None for units that are neither acceleration nor velocity.

    Examples
    --------
    >>> parse_input_units("M/S**2"), parse_input_units("nm/s^2").factor, parse_input_units("m/s").name, parse_input_units("PA")
    (Quantity(name='acceleration', factor=1.0), 1e-09, 'velocity', None)
    """
    key = re.sub(r"\s", "", text.upper()).replace("SEC", "S")
    if key in _OTHER_UNITS:
        return Quantity(ACCELERATION, _OTHER_UNITS[key])
    match = _MOTION_UNIT.fullmatch(key)
    if match is None:
        return None
    return Quantity(VELOCITY if match[2] else ACCELERATION, _PREFIXES[match[1]])


def find_channel(inventory: Any, trace: Any) -> Any:
    """Return the ObsPy channel of a trace in an inventory, of the epoch that covers it; None if the inventory has no such channel.

    Raises
    ------
    UnitError
        If no epoch covers the whole trace, or epochs contradict each other.
    """
    stats = trace.stats
    channels = [
        channel
        for network in inventory
        if network.code == stats.network or not stats.network
        for station in network
        if station.code == stats.station
        for channel in station
        if channel.code == stats.channel and channel.location_code.replace("-", "") == stats.location.replace("-", "")
    ]
    if not channels:
        return None
    # instruments are exchanged: the sensitivity must be that of the recording
    matching = [
        channel
        for channel in channels
        if (channel.start_date is None or channel.start_date <= stats.starttime)
        and (channel.end_date is None or stats.endtime <= channel.end_date)
    ]
    if not matching:
        raise UnitError(
            "{channel}: no epoch of the StationXML covers the record ({start} to {end}); get the StationXML of that time",
            channel=trace.id,
            start=str(stats.starttime)[:19],
            end=str(stats.endtime)[:19],
        )
    if len({_channel_values(channel) for channel in matching}) > 1:
        raise UnitError(
            "{channel}: {count} epochs of the StationXML cover the record and differ; keep one", channel=trace.id, count=len(matching)
        )
    return matching[0]


def _channel_values(channel: Any) -> tuple[object, ...]:
    sensitivity = channel.response.instrument_sensitivity if channel.response else None
    return (channel.azimuth, channel.dip, sensitivity and (sensitivity.value, sensitivity.input_units))


def input_quantity(channel: Any, name: str) -> Quantity:
    """Return the quantity that the instrument of an ObsPy channel measures.

    Raises
    ------
    UnitError
        If the StationXML has no response, or its input units are neither acceleration nor velocity.
    """
    response = channel.response
    sensitivity = response.instrument_sensitivity if response else None
    text = (sensitivity.input_units if sensitivity else None) or (
        response.response_stages[0].input_units if response and response.response_stages else None
    )
    if text is None:
        raise UnitError("{channel}: the StationXML has no response; get it with level=response", channel=name)
    quantity = parse_input_units(str(text)) or _displacement_of_accelerometer(str(text), response)
    if quantity is None:
        message = "{channel}: the instrument measures {unit}, neither acceleration nor velocity; give the channel of an accelerometer"
        raise UnitError(message, channel=name, unit=str(text)[:40])
    return quantity


def _displacement_of_accelerometer(text: str, response: Any) -> Quantity | None:
    """Return the quantity of an accelerometer whose response is stated for displacement, None for other instruments.

    With two zeros at 0 the response is flat to acceleration; the sensitivity holds at its own frequency.
    """
    match = _LENGTH_UNIT.fullmatch(text.strip().upper())
    zeros = [zero for stage in response.response_stages for zero in getattr(stage, "zeros", ())]
    sensitivity = response.instrument_sensitivity
    if match is None or sensitivity is None or not sensitivity.frequency or [abs(zero) for zero in zeros] != [0.0, 0.0]:
        return None
    return Quantity(ACCELERATION, _PREFIXES[match[1]] * (2.0 * np.pi * sensitivity.frequency) ** 2)


def remove_sensitivity(values: FloatArray, channel: Any, quantity: Quantity, name: str) -> str:
    """Divide counts, (n,), by the sensitivity of a channel in place, to SI units; return a history entry."""
    sensitivity = channel.response.instrument_sensitivity
    value = None if sensitivity is None else sensitivity.value
    if value is None or not np.isfinite(value) or value == 0.0:
        raise UnitError("{channel}: no usable sensitivity in the StationXML (found {value})", channel=name, value=str(value))
    values /= value
    values *= quantity.factor
    return lazy_gettext(
        "{channel}: sensitivity of the StationXML removed, {value:.6g} counts per {unit}",
        channel=name,
        value=float(value),
        unit=sensitivity.input_units,
    )


def remove_full_response(trace: Any, channel: Any, name: str) -> tuple[FloatArray, str]:
    """Return the acceleration, m/s^2, (n,), of a trace of counts after deconvolution by ObsPy, and a history entry with its band.

    Raises
    ------
    UnitError
        If the StationXML has no stages, or ObsPy cannot evaluate them.
    """
    stats = trace.stats
    nyquist_hz = 0.5 / stats.delta
    # below this band a deconvolution amplifies noise and drift
    low_hz = max(LOWEST_HZ, PERIODS / (stats.npts * stats.delta))
    high_hz, end_hz = (share * nyquist_hz for share in UPPER_SHARES)
    if not channel.response.response_stages:
        raise UnitError("{channel}: the StationXML has only a sensitivity; omit `response`", channel=name)
    if low_hz >= high_hz:
        raise ParameterError("{channel}: record too short for the full response; omit `response`", channel=name)
    copy = trace.copy()
    copy.stats.response = channel.response
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            # a water level would hide a frequency at which the instrument records nothing; the band excludes it
            # instead
            copy.remove_response(output="ACC", pre_filt=(BAND_TAPER * low_hz, low_hz, high_hz, end_hz), water_level=None)
    except Exception as error:  # ObsPy raises bare Exceptions
        reason = " ".join(str(error).split())[:MAX_QUOTED_LENGTH] or type(error).__name__
        raise UnitError("{channel}: ObsPy cannot remove the response ({why})", channel=name, why=reason) from error
    entry = lazy_gettext(
        "{channel}: full response removed between {low:.3g} and {high:.3g} Hz (mean removed, 5 % taper at both ends)",
        channel=name,
        low=low_hz,
        high=high_hz,
    )
    return np.require(copy.data, np.float64, ["C", "O", "W"]), entry


def differentiate(values: FloatArray, dt: float, name: str) -> tuple[FloatArray, str]:
    """Return the derivative of a velocity, m/s, (n,), by central differences as in ObsPy, and a history entry."""
    entry = lazy_gettext("{channel}: velocity differentiated to acceleration (central differences)", channel=name)
    return np.gradient(values, dt), entry


class Orientation(NamedTuple):
    """Direction of positive samples: azimuth, degrees, None if vertical; sign to be applied."""

    azimuth_deg: float | None
    sign: float


MAX_TILT_DEG = 5.0
"""Largest deviation of an instrument from horizontal or vertical, degrees."""


def channel_orientation(channel: Any, name: str) -> Orientation | None:
    """Return the orientation of an ObsPy channel by azimuth and dip; None if the StationXML does not state it.

    Raises
    ------
    RecordFormatError
        If the instrument is neither horizontal nor vertical.
    """
    dip, azimuth = channel.dip, channel.azimuth
    if dip is None:
        return None
    # SEED: dip -90 is up
    if abs(abs(dip) - 90.0) <= MAX_TILT_DEG:
        return Orientation(None, 1.0 if dip < 0.0 else -1.0)
    if abs(dip) > MAX_TILT_DEG:
        message = "{channel}: dip {dip:g} degrees in the StationXML: neither horizontal nor vertical; rotate the channels first"
        raise RecordFormatError(message, channel=name, dip=float(dip))
    return None if azimuth is None else Orientation(float(azimuth), 1.0)


def response_hint(network: str, station: str) -> str:
    """Return how to get the StationXML of a station, for messages."""
    query = "&".join(f"{key}={code}" for key, code in (("net", network), ("sta", station)) if code)
    return lazy_gettext("fdsnws/station/1/query?{query}&level=response of its data center", query=query)


def require_response(response: str) -> str:
    """Return a way to remove the response; raise ParameterError for an unknown one."""
    if response not in RESPONSES:
        raise ParameterError("unknown `response` {response!r}: expected sensitivity or full", response=response)
    return response
