"""Synthetic miniSEED and StationXML of stations, written for tests: no agency's numbers are in them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import obspy
from obspy.core.inventory import Channel, Inventory, Network, Site, Station
from obspy.core.inventory.response import InstrumentSensitivity, PolesZerosResponseStage, Response

START = obspy.UTCDateTime(2024, 1, 1, 7, 10, 10)
DT = 0.01
COUNTS_PER_UNIT = 4e5


def counts(letter: str, samples: int = 3000, *, scale: float = 1000.0) -> np.ndarray:
    """Return counts of a decaying motion, different in each component, on an offset."""
    t = DT * np.arange(samples)
    phase = {"N": 0.0, "E": 1.0, "Z": 2.0, "1": 0.0, "2": 1.0}[letter]
    wave = np.exp(-(((t - 10.0) / 4.0) ** 2)) * np.sin(2 * np.pi * (2.0 + 0.1 * phase) * t + phase)
    noise = np.random.default_rng(ord(letter)).standard_normal(samples)
    return np.rint(50 * scale * wave + noise * scale * 0.02 + 700 * (1 + phase)).astype(np.int32)


def trace(
    channel: str, *, network: str = "XX", station: str = "TST", location: str = "00", start: obspy.UTCDateTime = START, **values
) -> obspy.Trace:
    """Return a trace of counts."""
    header = {"network": network, "station": station, "location": location, "channel": channel, "delta": DT, "starttime": start}
    return obspy.Trace(values["data"] if "data" in values else counts(channel[-1], values.get("samples", 3000)), header)


def channel(
    code: str,
    *,
    location: str = "00",
    units: str = "M/S**2",
    sensitivity: float = COUNTS_PER_UNIT,
    azimuth: float | None = None,
    dip: float | None = None,
    start: obspy.UTCDateTime | None = None,
    end: obspy.UTCDateTime | None = None,
    stages: bool = False,
) -> Channel:
    """Return the metadata of a channel."""
    poles = PolesZerosResponseStage(
        1, sensitivity, 1.0, units, "COUNTS", "LAPLACE (RADIANS/SECOND)", 1.0, [], [-600 + 0j], normalization_factor=600.0
    )
    response = Response(
        instrument_sensitivity=InstrumentSensitivity(sensitivity, 1.0, units, "COUNTS"), response_stages=[poles] if stages else []
    )
    azimuth = {"N": 0.0, "E": 90.0, "Z": 0.0}.get(code[-1]) if azimuth is None else azimuth
    dip = (-90.0 if code[-1] == "Z" else 0.0) if dip is None else dip
    kwargs = {"azimuth": azimuth, "dip": dip, "sample_rate": 1 / DT, "response": response, "start_date": start, "end_date": end}
    return Channel(code, location, latitude=35.5, longitude=139.5, elevation=12.0, depth=0.0, **kwargs)


def inventory(*channels: Channel, network: str = "XX", station: str = "TST") -> Inventory:
    """Return the inventory of a station."""
    site = Station(station, 35.5, 139.5, 12.0, site=Site("synthetic"), channels=list(channels))
    return Inventory([Network(network, stations=[site])], source="synthetic")


def write_station(folder: Path, codes=("HNN", "HNE", "HNZ"), *, xml: bool = True, **options) -> list[Path]:
    """Write a miniSEED file for each channel, and the StationXML beside them; return the paths of the channels."""
    paths = [folder / f"XX.TST.00.{code}.mseed" for code in codes]
    for path, code in zip(paths, codes, strict=True):
        trace(code).write(str(path), "MSEED")
    if xml:
        inventory(*(channel(code, **options) for code in codes)).write(str(folder / "XX.TST.xml"), "STATIONXML")
    return paths
