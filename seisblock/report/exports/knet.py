"""Records in K-NET ASCII format: three files of integer counts per record."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import datetime, timedelta, timezone
from pathlib import Path

import numpy as np

from seisblock.core.errors import OutputError
from seisblock.core.units import GAL
from seisblock.output.io.atomic import make_folder, write_text
from seisblock.records import Component, Record

JAPAN = timezone(timedelta(hours=9))
UNKNOWN_TIME = datetime(2000, 1, 1, tzinfo=JAPAN)
"""Start of records without time: the format requires one."""

DELAY = timedelta(seconds=15)
"""Offset of ``Record Time`` in the header from the first sample."""

MAX_COUNTS = 9_999_999
"""Largest count: seven digits and a sign fit the column of eight characters."""

MAX_DECIMALS = 4
"""Decimals of the finest count, gal."""

COUNTS_PER_LINE = 8

DIRECTIONS = {"NS": "N-S", "EW": "E-W", "UD": "U-D"}


def write_knet(folder: Path, records: Sequence[Record]) -> list[Path]:
    """Write records in K-NET ASCII format, three files each, into a folder that is created if needed; return the files.

    A count is 1e-4 gal; for components above 999 gal it is the smallest power of ten that keeps counts within seven digits. The format
    requires whole seconds (the record is padded with zeros), a start time and coordinates (2000-01-01 and zeros if unknown).

    Raises
    ------
    OutputError
        If a component is not NS, EW or UD, the sampling rate is not an integer, or a file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from seisblock.records.synthetic.suite import synthetic_suite
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path.name for path in write_knet(Path(folder), synthetic_suite(6.0, 30.0, 1))]
    ['SYN0010001010000.NS', 'SYN0010001010000.EW', 'SYN0010001010000.UD']
    """
    make_folder(folder)
    paths = []
    for record in records:
        for name, text in _component_files(record):
            write_text(folder / name, text)
            paths.append(folder / name)
    return paths


def _component_files(record: Record) -> Iterator[tuple[str, str]]:
    """Yield name and content of each file of a record."""
    rate = round(1.0 / record.dt)
    if set(record.codes) - set(DIRECTIONS) or abs(rate * record.dt - 1.0) > 1e-9:
        raise OutputError(
            "{name}: K-NET format requires the components NS, EW, UD and an integer sampling rate in Hz; found {codes} at `dt` {dt:g} s",
            name=record.source,
            codes=record.codes,
            dt=record.dt,
        )
    start = (UNKNOWN_TIME if record.start is None else record.start).astimezone(JAPAN)
    for component in record.components:
        yield f"{record.station}{start:%y%m%d%H%M}.{component.code}", _file_text(record, component, rate, start)


def _file_text(record: Record, component: Component, rate: int, start: datetime) -> str:
    """Return the content of the file of one component."""
    gal = component.acceleration / GAL
    decimals = MAX_DECIMALS
    while decimals > 0 and float(np.abs(gal).max()) * 10**decimals > MAX_COUNTS:
        decimals -= 1
    # whole seconds, rounded up
    seconds = -(-gal.size // rate)
    counts = np.zeros(seconds * rate, dtype=np.int64)
    counts[: gal.size] = np.rint(gal * 10**decimals)
    metadata = record.metadata
    values = {
        "Origin Time": f"{start:%Y/%m/%d %H:%M:%S}",
        "Lat.": f"{metadata.get('event_latitude_deg', 0.0):.4f}",
        "Long.": f"{metadata.get('event_longitude_deg', 0.0):.4f}",
        "Depth. (km)": f"{metadata.get('event_depth_km', 0):g}",
        "Mag.": f"{metadata.get('magnitude', 0.0):.1f}",
        "Station Code": record.station,
        "Station Lat.": f"{metadata.get('station_latitude_deg', 0.0):.4f}",
        "Station Long.": f"{metadata.get('station_longitude_deg', 0.0):.4f}",
        "Station Height(m)": f"{metadata.get('station_height_m', -9999):g}",
        "Record Time": f"{start + DELAY:%Y/%m/%d %H:%M:%S}",
        "Sampling Freq(Hz)": f"{rate}Hz",
        "Duration Time(s)": f"{seconds}",
        "Dir.": DIRECTIONS[component.code],
        "Scale Factor": f"1(gal)/{10**decimals}",
        "Max. Acc. (gal)": f"{np.abs(counts - counts.mean()).max() / 10**decimals:.3f}",
        "Last Correction": f"{start:%Y/%m/%d %H:%M:%S}",
        "Memo.": "synthetic, no recording" if metadata.get("synthetic") else "",
    }
    lines = [f"{label:<18}{value}" for label, value in values.items()]
    lines += ["".join(f"{count:8d} " for count in counts[i : i + COUNTS_PER_LINE].tolist()) for i in range(0, counts.size, COUNTS_PER_LINE)]
    return "\n".join(lines) + "\n"
