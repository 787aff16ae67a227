"""Tables of accelerometer apps: phyphox, Physics Toolbox, Sensor Logger; interpolated at their mean rate, as telephones sample unevenly.

Layouts, from the documentation of the apps: phyphox ``"Time (s)","Acceleration x (m/s^2)",...,"Absolute acceleration (m/s^2)"``; Physics
Toolbox ``time,gFx,gFy,gFz,TgF`` in g; Sensor Logger ``time,seconds_elapsed,z,y,x`` in m/s^2, its ``time`` in ns since 1970.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, datetime
from typing import NamedTuple

import numpy as np

from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._header_check import qc_flag
from seisblock.readers.lines import read_lines
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.checks import flag_truncated_end
from seisblock.readers.table.parse import parse_columns, to_si
from seisblock.readers.table.sampling import half_last_digits
from seisblock.readers.uneven import resample_pairs
from seisblock.records import Component, QCFlag, Record
from seisblock.records.qc_spikes import find_spikes_and_jumps


class _App(NamedTuple):
    """Names of the columns of an app: time, s, axes; unit of the accelerations."""

    app: str
    time: str
    axes: Mapping[str, str]
    unit: str


MAX_JITTER, EVEN_JITTER, MAX_ODD_SHARE = 0.45, 0.1, 0.01
"""Deviation of an interval from the median, as a ratio, due to a lost or repeated line, and of even ones; largest share of the former."""

_AXES = ("x", "y", "z")
_APPS = (
    *(
        _App("phyphox", "time (s)", {axis: f"{kind} {axis} (m/s^2)" for axis in _AXES}, "m/s2")
        for kind in ("acceleration", "linear acceleration")
    ),
    _App("Physics Toolbox", "time", {axis: f"gf{axis}" for axis in _AXES}, "g"),
    _App("Sensor Logger", "seconds_elapsed", dict(zip(_AXES, _AXES, strict=True)), "m/s2"),
)
_CODES = {"x": "X", "y": "Y", "z": "UD"}
"""Codes of the axes of a telephone that lies on its back."""


def is_phone(head: bytes) -> bool:
    """Return whether the first line has the column names of an app."""
    return _find_app(head.lstrip(b"\xef\xbb\xbf").split(b"\n", 1)[0].decode("utf-8", "replace")) is not None


def _split(line: str) -> tuple[list[str], str]:
    """Return the names in a header line, in lower case, and the separator."""
    separator = next((mark for mark in ("\t", ";", ",") if mark in line), ",")
    names = [cell.strip().strip('"').strip().lower() for cell in line.strip("\r\n\ufeff ").split(separator)]
    return [re.sub(r"m/s(?:²|2)", "m/s^2", name) for name in names], separator


def _find_app(line: str) -> _App | None:
    names, _ = _split(line)
    return next((app for app in _APPS if app.time in names and all(name in names for name in app.axes.values())), None)


def read_phone(blob: RawFile) -> Record:
    """Return the record in the table of an accelerometer app.

    Notes
    -----
    Gravity, which the apps do not remove, is an offset of one axis, removed with the mean by default. Uneven samples are interpolated
    linearly at the mean rate.
    """
    lines = read_lines(blob)
    names, separator = _split(lines[0])
    app = _find_app(lines[0]) or _APPS[0]
    columns = {name: names.index(name) for name in (app.time, *app.axes.values())}
    body: Sequence[str] = lines[1:]
    if separator != "," and any("," in line for line in body[:3]):
        body = [line.replace(",", ".") for line in body]
    times, *rows = parse_columns(blob.name, body, 2, columns, len(names), separator)
    printed = [line.split(separator)[columns[app.time]] for line in body[:1000] if line.strip()]
    resolution = 2.0 * float(half_last_digits(printed).min())
    mean = float(times[-1] - times[0]) / max(times.size - 1, 1)
    start_s, dt, samples, history = resample_pairs(blob.name, times, rows, resolution, dt=_round_interval(mean))
    # interpolation spreads a spike over several samples
    flags = [*_flag_end(body, separator), *_flag_intervals(times), *(_flag_spikes(app, times, rows) if history else ())]
    components = [Component(_CODES[axis], to_si(row, app.unit)) for axis, row in zip(app.axes, samples, strict=True)]
    return Record(
        tuple(components),
        dt,
        start=_start(names, body, separator) if app.app == "Sensor Logger" else None,
        source=blob.name,
        format=FORMAT.name,
        history=(lazy_gettext("table of {app}: axes of the telephone, z as vertical", app=app.app), *history),
        metadata={"unit": app.unit, "carries_offset": True, **({"first_time_s": start_s} if start_s else {})},
        doubts=tuple(flags),
    )


def _flag_end(body: Sequence[str], separator: str) -> Iterator[QCFlag]:
    """Yield a flag if the last line has no line end, and fewer cells than the first or a last number that is cut."""
    if body and body[-1].strip() and body[-1].count(separator) < body[0].count(separator):
        yield qc_flag("no line end after the last line: file probably truncated, last number incomplete", "cut")
    else:
        yield from flag_truncated_end(body, separator)


def _flag_intervals(times: FloatArray) -> Iterator[QCFlag]:
    """Yield a flag if few intervals differ from all others, which are even; telephones that sample unevenly prove nothing."""
    steps = np.diff(times)
    if not steps.size or (dt := float(np.median(steps))) <= 0.0:
        return
    deviations = np.abs(steps / dt - 1.0)
    is_odd = deviations > MAX_JITTER
    if 0 < is_odd.sum() <= MAX_ODD_SHARE * steps.size and (deviations[~is_odd] <= EVEN_JITTER).all():
        message = "{count} interval(s) (the first at {time:.4g} s) differ from all others, {dt:.4g} s: lines lost or repeated"
        yield qc_flag(message, "clock", count=int(is_odd.sum()), time=float(times[int(is_odd.argmax())]), dt=dt)


def _flag_spikes(app: _App, times: FloatArray, rows: Sequence[FloatArray]) -> Iterator[QCFlag]:
    """Yield flags for isolated spikes of the samples as recorded."""
    for axis, row in zip(app.axes, rows, strict=True):
        spikes, _ = find_spikes_and_jumps(to_si(row, app.unit))
        if spikes.size:
            message = "{component}: {count} isolated spike(s) (the first at {time:.4g} s) in samples as recorded"
            yield qc_flag(message, "spike", component=_CODES[axis], count=spikes.size, time=float(times[spikes[0]]))


def _round_interval(mean: float) -> float:
    """Return the interval of the nearest whole number of samples per second."""
    return 1.0 / round(1.0 / mean) if 0.0 < mean < 0.5 else mean


def _start(names: Sequence[str], body: Sequence[str], separator: str) -> datetime | None:
    """Return the time of the first sample from nanoseconds since 1970."""
    cell = body[0].split(separator)[names.index("time")].strip() if "time" in names else ""
    return datetime.fromtimestamp(int(cell) / 1e9, UTC) if re.fullmatch(r"1\d{18}", cell) else None


FORMAT = register(
    Format(
        name="PHONE",
        title=N_("a table of an accelerometer app"),
        parse=read_phone,
        matches=is_phone,
        proves=("unit", "clock"),
        plugin=False,
    )
)
