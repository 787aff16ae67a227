"""Records from and to streams of ObsPy, in memory."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import KindError, UnitError
from seisblock.readers.assemble import assemble
from seisblock.readers.event import apply_event, load_event
from seisblock.readers.response import ACCELERATION, VELOCITY, Inventories, Quantity
from seisblock.readers.waveforms import (
    ACCELEROMETERS,
    SEISMOMETERS,
    WaveformOptions,
    evt_quantity,
    instrument_letter,
    is_counts,
    processed_counts_error,
    trace_to_record,
)
from seisblock.records import Component, Record
from seisblock.records.qc import run_qc

STATS_KEY = "seisblock"
"""Key of the trace header with the direction and the processing history of a record."""

_OUTPUT = re.compile(r"output=['\"]?(DEF|ACC|VEL|DISP)")


def is_obspy(source: object) -> bool:
    """Return whether an object is a Stream or Trace of ObsPy; ObsPy is not loaded."""
    kind = type(source)
    return kind.__module__.startswith("obspy.core") and kind.__name__ in ("Stream", "Trace")


def record_from_obspy(
    stream: Any,
    inventory: Any = None,
    event: Any = None,
    *,
    units: str | None = None,
    station: str | None = None,
    location: str | None = None,
    differentiate: bool = False,
    response: str = "sensitivity",
) -> Record:
    """Return the record of an ObsPy Stream or Trace; see :meth:`seisblock.records.Record.from_obspy`."""
    if not is_obspy(stream):
        raise KindError("expected an ObsPy Stream or Trace, found {found}", found=checks.type_name(stream))
    traces = [stream] if type(stream).__name__ == "Trace" else list(stream)
    if not traces:
        raise KindError("expected an ObsPy Stream with traces, found an empty one")
    from obspy import Stream

    # copies: merging and scaling change traces in place
    copies = [trace.copy() for trace in traces]
    # only where needed, as merging sorts the traces
    merged = Stream(copies).merge() if len({trace.id for trace in copies}) < len(copies) else copies
    inventories = Inventories() if inventory is None else Inventories(inventory=inventory, is_requested=True)
    options = WaveformOptions(units, inventories, differentiate, response)
    parts = [_to_part(trace, options) for trace in merged]
    record = assemble("ObsPy stream", parts, station=station, location=location)
    return run_qc(apply_event(record, None if event is None else load_event(event)))


def _to_part(trace: Any, options: WaveformOptions) -> Record:
    """Return one trace as a single-component record; a trace written by :func:`record_to_obspy` keeps direction and history."""
    header = trace.stats.get(STATS_KEY)
    if header is not None:
        component = Component(header["code"], trace.data, header["azimuth_deg"])
        part = trace_to_record("ObsPy stream", trace, "STREAM", options, physical=Quantity(ACCELERATION, 1.0))
        return replace(
            part,
            components=(component,),
            history=tuple(header["history"]),
            metadata={**part.metadata, **dict(header["metadata"])},
        )
    attached = getattr(trace.stats, "response", None)
    physical = None if options.inventory.is_requested or options.units is not None else _processed_quantity(trace)
    if physical is None and attached is not None and not options.inventory.is_requested and options.units is None:
        # the response attached by a FDSN client has no azimuth and dip
        options = replace(options, inventory=Inventories(inventory=_attached_inventory(trace), is_requested=True))
    part = trace_to_record("ObsPy stream", trace, "STREAM", options, physical=physical)
    if physical is not None and ("remove_sensitivity" in _processing(trace) or "knet" in trace.stats):
        # a factor leaves the offset of the instrument
        return replace(part, metadata={**part.metadata, "carries_offset": True})
    return part


def _processing(trace: Any) -> str:
    """Return what ObsPy did to a trace."""
    return " ".join(trace.stats.get("processing", []))


def _processed_quantity(trace: Any) -> Quantity | None:
    """Return the quantity of samples in SI units by the processing of ObsPy; None for counts.

    Floating-point samples without a response are accelerations, m/s^2, of an accelerometer, as ObsPy returns them after removal.
    """
    processing = _processing(trace)
    letter = instrument_letter(trace.stats.channel)
    by_code = VELOCITY if letter in SEISMOMETERS and letter else ACCELERATION
    match = _OUTPUT.search(processing) if "remove_response" in processing else None
    if "remove_response" in processing:
        output = match[1] if match else "VEL"
        if output == "DISP":
            raise UnitError("{channel}: displacements (remove_response with output='DISP'); use output='ACC'", channel=trace.id)
        return Quantity({"ACC": ACCELERATION, "VEL": VELOCITY}.get(output, by_code), 1.0)
    if "remove_sensitivity" in processing:
        return Quantity(by_code, 1.0)
    unit = _plugin_unit(trace)
    if unit == "m/s2":
        return Quantity(ACCELERATION, 1.0)
    if "kinemetrics_evt" in trace.stats:
        return evt_quantity(trace)
    has_response = getattr(trace.stats, "response", None) is not None
    is_accelerometer = not letter or letter in ACCELEROMETERS
    if trace.data.dtype.kind != "f" or not trace.data.size or has_response or not is_accelerometer:
        return None
    if "knet" in trace.stats:
        return Quantity(ACCELERATION, _knet_factor(trace))
    encoding = str(trace.stats.get("mseed", {}).get("encoding", "FLOAT"))
    if encoding.startswith("FLOAT"):
        return Quantity(ACCELERATION, 1.0)
    # counts of a file, made floating-point numbers by a filter
    if not is_counts(trace.data):
        raise processed_counts_error("ObsPy stream", trace)
    return None


def _knet_factor(trace: Any) -> float:
    """Return the factor to m/s^2 of a trace of ObsPy's K-NET reader: the calibration factor, or 1 if it was applied already.

    ObsPy keeps the factor, of about 1e-6, after it is applied; the peak in the header, gal, tells counts from accelerations.
    """
    calib, peak = float(trace.stats.calib), float(np.ptp(trace.data)) * 100.0
    return calib if peak * calib**0.5 > float(trace.stats.knet.get("accmax", 0.0)) else 1.0


def _plugin_unit(trace: Any) -> str:
    """Return the unit that a plug-in of this package stated in the header of a trace; empty for other traces."""
    waveform = str(trace.stats.get("_format", "")).lower()
    header: Any = trace.stats.get(waveform) if waveform else None
    return str(header.get("unit", "")) if hasattr(header, "get") else ""


def _attached_inventory(trace: Any) -> Any:
    """Return an inventory with the response attached to a trace; coordinates 0, 0 are unknown ones."""
    from obspy.core.inventory import Channel, Inventory, Network, Station

    stats = trace.stats
    coordinates = {"latitude": 0.0, "longitude": 0.0, "elevation": 0.0}
    channel = Channel(stats.channel, stats.location, depth=0.0, response=stats.response, **coordinates)
    station = Station(stats.station, channels=[channel], **coordinates)
    return Inventory([Network(stats.network, stations=[station])], source=STATS_KEY)


def record_to_obspy(record: Record) -> Any:
    """Return a record as an ObsPy Stream; see :meth:`seisblock.records.Record.to_obspy`."""
    from obspy import Stream, Trace, UTCDateTime

    traces = []
    for component in record.components:
        header: dict[str, Any] = {
            "network": record.network,
            "station": record.station,
            "location": record.location,
            "channel": record.channels.get(component.code, component.code),
            "delta": record.dt,
            STATS_KEY: {
                "code": component.code,
                "azimuth_deg": component.azimuth_deg,
                "unit": "m/s2",
                "history": list(record.history),
                "metadata": dict(record.metadata),
                "format": record.format,
                "source": record.source,
            },
        }
        if record.start is not None:
            # cropping moves the first sample
            header["starttime"] = UTCDateTime(record.start) + record.offset_s
        # the samples of a record are read-only, those of a trace are changed in place by obspy
        traces.append(Trace(component.acceleration.copy(), header=header))
    return Stream(traces)
