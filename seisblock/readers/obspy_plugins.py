"""ObsPy waveform plug-ins (entry points) for the formats read by this package.

Functions ``is_NAME`` and ``read_NAME`` exist for each registered format, for example ``is_at2`` and ``read_at2``. Samples of the streams
are accelerations in m/s^2 and ``stats.calib`` is 1; ObsPy's own K-NET reader gives counts and a ``calib`` to m/s^2, so that
``data * calib`` is in m/s^2 for all of them. Further header entries are in ``stats.NAME``, for example ``stats.at2``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias

from seisblock.readers.registry import HEAD_BYTES, Format, list_formats
from seisblock.readers.source import RawFile
from seisblock.records import Record

_Source: TypeAlias = "str | Path | BinaryIO"


@cache
def __getattr__(name: str) -> Callable[..., Any]:
    """Return the function ``is_NAME`` or ``read_NAME`` of a plug-in."""
    actions = {"is": _is_format, "read": _read_stream}
    action, _, stem = name.partition("_")
    for file_format in list_formats() if action in actions else ():
        if file_format.plugin and stem == file_format.name.lower().replace("-", "_"):
            return partial(actions[action], file_format)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def _is_format(file_format: Format, filename: _Source) -> bool:
    """Return whether a file begins as one of this format."""
    return file_format.matches is not None and file_format.matches(_read_head(filename))


def _read_stream(file_format: Format, filename: _Source, **_: Any) -> Any:
    """Return an ObsPy Stream, m/s^2, of a file, without removal of an offset; start 1970-01-01 if the format has no time.

    Raises
    ------
    RecordFormatError
        If the file is malformed or has no evenly sampled acceleration.
    """
    if isinstance(filename, (str, Path)):
        blob = RawFile(str(filename), Path(filename).read_bytes())
    else:
        blob = RawFile(str(getattr(filename, "name", "stream")), filename.read())
    result = file_format.parse(blob)
    return _to_stream(result if isinstance(result, list) else [result], file_format.obspy_name.lower())


def _read_head(filename: _Source) -> bytes:
    """Return the first bytes of a file; the position of a stream is restored."""
    if isinstance(filename, (str, Path)):
        try:
            with Path(filename).open("rb") as file:
                return file.read(HEAD_BYTES)
        except OSError:
            return b""
    position = filename.tell()
    try:
        return filename.read(HEAD_BYTES)
    finally:
        filename.seek(position)


def _to_stream(records: Sequence[Record], key: str) -> Any:
    from obspy import Stream, Trace, UTCDateTime

    traces = []
    for record in records:
        # as in the names of KiK-net files
        sensor = {"borehole": "1", "surface": "2"}.get(str(record.metadata.get("level", "")), "")
        header_fields = {k: UTCDateTime(v) if k == "origin_time" else v for k, v in record.metadata.items() if k != "unit"}
        for component in record.components:
            direction = {} if component.azimuth_deg is None else {"azimuth_deg": component.azimuth_deg}
            header: dict[str, Any] = {"station": record.station, "channel": component.code + sensor, "delta": record.dt}
            header[key] = {**header_fields, **direction, "unit": "m/s2"}
            if record.start is not None:
                header["starttime"] = UTCDateTime(record.start)
            # the samples of a record are read-only, those of a trace are changed in place by obspy
            traces.append(Trace(component.acceleration.copy(), header=header))
    return Stream(traces)
