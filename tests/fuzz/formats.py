"""Complete files of every format, with number of samples, peak and interval, as input of the fuzz tests."""

from __future__ import annotations

import io
import re
import tempfile
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import obspy
import openpyxl

from seisblock.records import Record
from tests.readers import layouts, world
from tests.readers.files import JMA_HEADER, KNET_CSV, knet, tar

RNG = np.random.default_rng(11)
SAMPLES = 600
T = np.arange(SAMPLES) * 0.01
ROWS = [
    np.round(100 * np.exp(-(((T - 3) / s) ** 2)) * np.sin(2 * np.pi * f * T) + RNG.standard_normal(SAMPLES), 3)
    for s, f in ((1.0, 2.0), (1.2, 1.3), (0.8, 4.0))
]
"""Three components, gal."""


Rows = Sequence[np.ndarray]
Writer = Callable[[Rows], bytes]


@dataclass(frozen=True)
class Whole:
    """A file of one format.

    Parameters
    ----------
    data : bytes
    judge : callable
        Takes a spoilt file and the record read from it; returns how the file contradicts the record, or nothing.
    options : dict
        Of `read`.
    """

    data: bytes
    judge: Callable[[bytes, Record], str] = lambda data, record: ""
    options: dict[str, object] = field(default_factory=dict)


_VALUES = ("Sam", "Dur", "Max")
"""How the lines of a K-NET header begin that say how many samples follow, and how large."""


def judge_knet(data: bytes, record: Record) -> str:
    """Compare count and maximum with the header's."""
    text = data.decode("latin-1")
    rate, duration, maximum = (_number(line[18:].replace("Hz", "")) for line in text.splitlines()[10:15] if line[:3] in _VALUES)
    if duration is None or rate is None or maximum is None:
        return "a header that is no number was believed"
    if round(duration * rate) != record.samples:
        return f"{record.samples} samples where the header states {duration * rate:g}"
    row = 100 * record.components[0].acceleration
    peak = float(np.abs(row - row.mean()).max())
    return f"a peak of {peak:.4f} where the header says {maximum:g}" if abs(peak - maximum) > 0.0012 else ""


def judge_knet_csv(data: bytes, record: Record) -> str:
    """Compare count and interval with the header's."""
    lines = [line.lstrip("#").strip() for line in data.decode("latin-1").splitlines()]
    mapping = {name: _number(lines[lines.index(name) + 1]) for name in ("SamplingFrequency(Hz)", "DurationTime(s)") if name in lines[:-1]}
    duration, rate = mapping.get("DurationTime(s)"), mapping.get("SamplingFrequency(Hz)")
    if duration is None:
        return "a duration that is no number was believed"
    if round(duration / record.dt) != record.samples:
        return f"{record.samples} samples where the header states {duration / record.dt:g}"
    return f"{record.dt} s where the header says {rate} Hz" if rate and abs(1 / rate - record.dt) > 1e-6 else ""


def judge_at2(data: bytes, record: Record) -> str:
    """Compare the count with NPTS."""
    stated = re.search(rb"NPTS\s*=\s*(\d+)", data, re.IGNORECASE)
    return "" if stated and int(stated[1]) == record.samples else f"{record.samples} samples, NPTS is another number"


_PROMISES = rb"(?:NDATA:|NO. OF POINTS =|Number of points)\s*(\d+)|(\d+) (?: acceleration pts|POINTS OF INSTRUMENT)"


def judge_promised(data: bytes, record: Record) -> str:
    """Compare the count with the one that the header of the first component promises."""
    stated = re.search(_PROMISES, data, re.IGNORECASE)
    result = record.samples if stated is None else int(stated[1] or stated[2])
    return "" if result == record.samples else f"{record.samples} samples where the header states {result}"


def judge_cwa(data: bytes, record: Record) -> str:
    """Compare count and extremes with the header's."""
    stated = re.search(rb"RecordLength\(sec\):\s*([\d.]+)", data)
    if stated and abs(float(stated[1]) / record.dt - record.samples) > 2.0:
        return f"{record.samples} samples where the header states {float(stated[1])} s"
    for letter, code in zip("UNE", ("UD", "NS", "EW"), strict=True):
        text = re.search(rf"AmplitudeMAX. {letter}:\s*([\d.]+)~\s*(-[\d.]+)\s".encode(), data)
        row = 100 * record.component(code).acceleration
        if text and max(abs(row.max() - float(text[1])), abs(row.min() - float(text[2]))) > 0.0012:
            return f"{code}: extremes are not the header's"
    return ""


def judge_jma(data: bytes, record: Record) -> str:
    """JMA ends each line and publishes whole seconds."""
    seconds = record.samples * record.dt
    if abs(seconds - round(seconds)) > 0.3 * record.dt:
        return f"{record.samples} samples are not a whole number of seconds"
    return "" if data.endswith((b"\n", b"\r", b",")) or not data.rstrip(b" ,\t") else "no line end after the last line"


def judge_clock(data: bytes, record: Record) -> str:
    """Every line of numbers is a sample, at an even time."""
    rows = [row for line in data.decode("latin-1").splitlines()[1:] if (row := _numbers(line))]
    times = [row[0] for row in rows]
    if len(rows) != record.samples:
        return f"{record.samples} samples from {len(rows)} lines"
    steps = np.diff(times)
    return "uneven times were believed" if steps.size and np.abs(steps - np.median(steps)).max() > 2e-6 else ""


def judge_moments(data: bytes, record: Record) -> str:
    """Every line that begins with a moment is a sample, at an even time."""
    lines = [line for line in data.decode("latin-1").splitlines() if re.match(r"\s*2020", line)]
    seconds = [_number(line.split(",")[0][-6:]) or 0.0 for line in lines]
    if len(lines) != record.samples:
        return f"{record.samples} samples from {len(lines)} lines"
    steps = np.diff(seconds)
    return "uneven times were believed" if steps.size and np.abs(steps - np.median(steps)).max() > 2e-6 else ""


def judge_sac(data: bytes, record: Record) -> str:
    """Compare the extremes with the header's: 32-bit words 1 and 2, in mm/s^2."""
    values = 1e3 * np.array([record.components[0].acceleration.min(), record.components[0].acceleration.max()])
    orders = [np.frombuffer(data[4:12], f"{order}f4").astype(float) for order in "<>"]
    nearby = any(np.allclose(text, values, rtol=0.0, atol=2e-5 * np.abs(values).max()) for text in orders)
    return "" if nearby or any(-12345.0 in text for text in orders) else f"extremes {values} are not the header's"


def judge_slist(data: bytes, record: Record) -> str:
    """Compare the counts with the header's."""
    stated = [int(n) for n in re.findall(rb"TIMESERIES[^,\n]*,\s*(\d+)\s*samples", data)]
    times = [re.sub(rb"\D", b"", time) for time in re.findall(rb"^\s*(\d{4}-\S*)", data, re.MULTILINE)]
    if times != sorted(set(times)):
        return "times out of order were believed"
    return "" if stated == [record.samples] * len(stated) else f"{record.samples} samples, the headers state {stated}"


def _number(text: str) -> float | None:
    """Return a positive number, or None."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if 0 < value < np.inf else None


def _numbers(line: str) -> list[float]:
    """Return the numbers of a line, none when it holds anything else."""
    try:
        return [float(cell) for cell in re.split(r"[,\s;]+", line.strip()) if cell]
    except ValueError:
        return []


def _table(separator: str, header: str, form: str = "{:.3f}", unit: float = 1.0) -> Writer:
    """Return what writes a plain table of time and three components, in gal or a unit of so many."""

    def written(rows: Rows) -> bytes:
        lines = zip(T, *(row / unit for row in rows), strict=True)
        return (header + "\n" + "".join(separator.join([f"{t:.2f}", *map(form.format, line)]) + "\n" for t, *line in lines)).encode()

    return written


def _clock_table(rows: Rows) -> bytes:
    """Return a table with clock times and a line of units."""
    lines = zip(T, *rows, strict=True)
    body = "".join(f"2020-01-02T03:04:{5 + t:06.3f},{a:.3f},{b:.3f},{c:.3f}\n" for t, a, b, c in lines)
    return ("time,NS,EW,UD\n,gal,gal,gal\n" + body).encode()


def _obspy(waveform: str, count: int = 1) -> Writer:
    """Return what writes a file through ObsPy, so many components, counts of mm/s^2."""

    def written(rows: Rows) -> bytes:
        stream = obspy.Stream()
        for row, letter in list(zip(rows, "NEZ", strict=True))[:count]:
            header = {"station": "ABC", "channel": f"HN{letter}", "delta": 0.01, "starttime": obspy.UTCDateTime(2020, 1, 1)}
            data = (row * 10).astype(np.float32 if waveform == "SAC" else np.int32)
            stream.append(obspy.Trace(data, header=header))
        with tempfile.TemporaryDirectory() as directory:
            path = Path(directory) / "a"
            stream.write(str(path), format=waveform)
            return path.read_bytes()

    return written


def _knet_csv(rows: Rows) -> bytes:
    """Return NIED's CSV of six seconds."""
    head = KNET_CSV.split("2019/01/02 17:47:27.00")[0].replace("#60", "#6")
    times = [f"2019/01/02 17:47:{27 + t:05.2f},{t:.2f}" for t in T]
    return (head + "".join(f"{t},{a:.2f},{b:.2f},{c:.2f}\n" for t, a, b, c in zip(times, *rows, strict=True))).encode()


def _at2(rows: Rows) -> bytes:
    """Return an AT2 file."""
    cells = [f"{x / 980.665:15.7E}" for x in rows[0]]
    body = "".join("".join(cells[i : i + 5]) + "\n" for i in range(0, SAMPLES, 5))
    head = f"PEER\nEvent, 1/1/2000, Place, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  {SAMPLES}, DT=   .0100 SEC\n"
    return (head + body).encode()


def _zip(name: str, data: bytes) -> bytes:
    """Return a zip of one file."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, data)
    return buffer.getvalue()


def _jma(rows: Rows) -> bytes:
    """Return a JMA CSV file."""
    return (JMA_HEADER + "".join(f"{a:.3f},{b:.3f},{c:.3f}\r\n" for a, b, c in zip(*rows, strict=True))).encode("cp932")


def _knet(row: int, **header: str) -> Writer:
    """Return what writes one component in the layout of K-NET, on an offset of 900 counts."""
    return lambda rows: knet([int(x * 1577) + 900 for x in rows[row]], duration="6", **header).encode()


_first = _knet(0)
WRITERS: dict[str, Writer] = {
    "jma": _jma,
    "knet": _first,
    "kiknet": _knet(1, direction="5", station="NGNH31"),
    "knet-csv": _knet_csv,
    "at2": _at2,
    "csmip-v1": lambda rows: layouts.csmip(rows, volume=1).encode(),
    "csmip-v2": lambda rows: layouts.csmip(rows).encode(),
    "cosmos": lambda rows: layouts.cosmos(rows[0]).encode(),
    "smc": lambda rows: layouts.smc(rows[0]).encode(),
    "esm": lambda rows: layouts.esm(rows[0]).encode(),
    "geonet-v1": lambda rows: layouts.geonet(rows).encode(),
    "geonet-v2": lambda rows: layouts.geonet(rows, volume=2).encode(),
    "cwa": lambda rows: layouts.cwa(rows).encode(),
    "comma": _table(",", "time,NS (gal),EW (gal),UD (gal)"),
    "blank": _table(" ", "t(s) ns_gal ew_gal ud_gal"),
    "semicolon": _table(";", "time;N10E (m/s2);N80W (m/s2);UD (m/s2)", "{:.5f}", 100.0),
    "clock": _clock_table,
    "one column": lambda rows: ("NS (gal)\n" + "".join(f"{x:.3f}\n" for x in rows[0])).encode(),
    "slist": _obspy("SLIST"),
    "tspair": _obspy("TSPAIR"),
    "mseed": _obspy("MSEED", 3),
    "sac": _obspy("SAC"),
    "tar": lambda rows: tar({"a.NS": _first(rows)}),
    "tar.gz": lambda rows: tar({"a.NS": _first(rows)}, mode="w:gz"),
    "zip": lambda rows: _zip("a/b.NS", _first(rows)),
}
"""What writes three components, gal, in each format that is read."""

MM = {"units": "mm/s2"}
JUDGES: dict[str, Callable[[bytes, Record], str]] = {
    "jma": judge_jma,
    "knet": judge_knet,
    "kiknet": judge_knet,
    "knet-csv": judge_knet_csv,
    "at2": judge_at2,
    "csmip-v1": judge_promised,
    "csmip-v2": judge_promised,
    "cosmos": judge_promised,
    "esm": judge_promised,
    "geonet-v1": judge_promised,
    "geonet-v2": judge_promised,
    "cwa": judge_cwa,
    "comma": judge_clock,
    "blank": judge_clock,
    "semicolon": judge_clock,
    "clock": judge_moments,
    "slist": judge_slist,
    "tspair": judge_slist,
    "sac": judge_sac,
    "tar": lambda data, record: judge_knet(data[data.find(b"Origin Time") :], record),
}
OPTIONS: dict[str, dict[str, object]] = {"one column": {"dt": 0.01}, **dict.fromkeys(("slist", "tspair", "mseed", "sac"), MM)}


def _phone(rows: Rows) -> bytes:
    """Return the table of phyphox, evenly sampled, with gravity."""
    head = '"Time (s)","Acceleration x (m/s^2)","Acceleration y (m/s^2)","Acceleration z (m/s^2)","Absolute acceleration (m/s^2)"'
    lines = zip(T, *(row / 100.0 for row in rows), strict=True)
    return (head + "\n" + "".join(f"{t:.9E},{x:.9E},{y:.9E},{z + 9.81:.9E},{9.81:.9E}\n" for t, x, y, z in lines)).encode()


def _xlsx(rows: Rows) -> bytes:
    """Return a workbook with a table."""
    workbook = openpyxl.Workbook()
    workbook.active.append(["time (s)", "NS (gal)", "EW (gal)", "UD (gal)"])
    for line in zip(T.tolist(), *(row.tolist() for row in rows), strict=True):
        workbook.active.append(line)
    buffer = io.BytesIO()
    workbook.save(buffer)
    return buffer.getvalue()


UNEVEN = np.cumsum(RNG.integers(3, 14, SAMPLES)) / 1000.0

WRITERS |= {
    "afad": lambda rows: world.afad(rows).encode(),
    "unam": lambda rows: world.unam(rows).encode(),
    "bhrc": lambda rows: world.bhrc(rows).encode(),
    "csmnc": lambda rows: world.csmnc(rows[1]).encode(),
    "renadic": lambda rows: world.renadic(rows).encode(),
    "usc v1": lambda rows: world.usc_v1(rows[0], UNEVEN, form="7.3f", margin=" ").encode(),
    "usc v2": lambda rows: world.usc_v2(rows[0]).encode(),
    "phone": _phone,
    "xlsx": _xlsx,
}
"""Formats of the open world."""

FORMATS = {kind: Whole(output(ROWS), JUDGES.get(kind, lambda data, record: ""), OPTIONS.get(kind, {})) for kind, output in WRITERS.items()}
