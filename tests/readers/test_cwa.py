"""Text files of Taiwan's CWA: unit, order, rate, start and extremes of the header are all used."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest

from seisblock.core.errors import InputError, ParameterError, RecordError, UnitError
from seisblock.readers import read
from seisblock.records.seismic_intensity import jma_intensity
from seisblock.records.site import format_local_time, get_earthquake, get_site
from tests.fuzz.formats import ROWS
from tests.readers import layouts

FULL = layouts.cwa(ROWS)


@pytest.fixture
def file(tmp_path):
    """Return a function that writes a text and returns its path."""

    def write(text, encoding="utf-8"):
        path = tmp_path / "T129001.263"
        path.write_bytes(text.encode(encoding))
        return path

    return write


@pytest.mark.parametrize("event", [True, False])
def test_both_cwa_headers_are_read(file, event):
    """With the earthquake, in local time, and without it, in UTC: gal, U first in the file and vertical, to the header's extremes."""
    record = read(file(layouts.cwa(ROWS, event=event)))
    assert (record.codes, record.dt, record.samples, record.format) == (("NS", "EW", "UD"), 0.01, 600, "CWA")
    assert record.doubts == ()
    for component, row in zip(record.components, ROWS, strict=True):
        np.testing.assert_array_equal(component.acceleration, np.rint(row * 1e3) / 1e5)
    assert (record.station, record.start) == ("SYN1", datetime(2020, 1, 2, 3, 4, 5, 250_000, tzinfo=UTC))
    assert jma_intensity(record) > 3.0
    assert format_local_time(record, record.start) == ("2020-01-02 11:04:05 GMT+08" if event else "2020-01-02 03:04:05 UTC")
    if event:
        assert (get_site(record).name, get_site(record).place) == ("Test Town Hall", (22.86, 121.092))
        earthquake = get_earthquake(record)
        assert (earthquake.place, earthquake.depth_km, earthquake.magnitude) == ((24.14, 121.69), 10.0, 6.1)
        assert earthquake.origin_time == datetime(2020, 1, 2, 3, 4, tzinfo=UTC)
    else:
        assert get_earthquake(record) is None


def test_cwa_columns_follow_sequence_line(file):
    """``Time N(+); E(+); U(+)`` are north, east and up, by their letters and not by their places; blank lines and CR LF do no harm."""
    record = read(file(layouts.cwa(ROWS, sequence="Time N(+); E(+); U(+)").replace("#Stat", "\n#Stat").replace("\n", "\r\n")))
    for component, row in zip(record.components, ROWS, strict=True):
        np.testing.assert_array_equal(component.acceleration, np.rint(row * 1e3) / 1e5)


@pytest.mark.parametrize(
    ("old", "new", "kind", "says"),
    [
        (
            "RecordLength(sec):    6.000",
            "RecordLength(sec):   60.000",
            "count",
            "header duration 60.000 s differs from the duration of 600 samples, 6 s",
        ),
        ("RecordLength(sec):    6.000", "RecordLength(sec): six", "count", "header duration six s"),
        ("AmplitudeMAX. N:  100", "AmplitudeMAX. N:   10", "header", "NS: header range '10.011~"),
        ("AmplitudeMAX. U:", "AmplitudeMAX. U: x", "header", "UD: header range"),
    ],
)
def test_cwa_header_contradictions_are_flagged(file, old, new, kind, says):
    """Another length, another extreme, or none that can be read."""
    assert old in FULL
    (doubt,) = read(file(FULL.replace(old, new))).doubts
    assert doubt.kind == kind
    assert says in doubt.message


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("U(+)", "U(-)", r"line 20: expected the column sequence, as in 'Time U\(\+\); N\(\+\); E\(\+\)', found 'Time U\(-\)"),
        ("N(+)", "Q(+)", "expected the column sequence"),
        ("N(+)", "E(+)", "expected the column sequence"),
        ("gal. DC", "volt. DC", "line 16: expected an acceleration unit such as gal, found 'volt. DC"),
        ("SampleRate(Hz): 100", "SampleRate(Hz): 200", "header rate 200 Hz contradicts the time column"),
        ("SampleRate(Hz): 100", "SampleRate(Hz): no", "line 15: expected the number of samples per second, found 'no'"),
        ("#SampleRate", "#SampleRat", "CWA header line #SampleRate"),
        ("2020/01/02-11:04:05", "2020/13/02-11:04:05", "line 13: expected a time such as 1999/09/20-17:47:15.000"),
        ("\n     0.500", "\n     0.510", "uneven time column"),
        ("\n     0.500", "\n     0.5x0", "line 72: expected a number in column Time, found '0.5x0'"),
    ],
)  # fmt: skip
def test_cwa_unknown_entries_are_rejected_with_line(file, old, new, says):
    """A sign, a letter, a unit, a rate, a time."""
    assert old in FULL
    with pytest.raises(RecordError, match=says):
        read(file(FULL.replace(old, new)))


def test_options_contradicting_cwa_header_are_rejected(file):
    """Unit and interval of the header are used, as in every format that states them."""
    path = file(FULL)
    assert read(path, units="gal", dt=0.01, format="CWB").codes == ("NS", "EW", "UD")
    with pytest.raises(UnitError, match="header unit gal contradicts"):
        read(path, units="g")
    with pytest.raises(ParameterError, match=r"header dt 0\.01 s"):
        read(path, dt=0.02)


@pytest.mark.parametrize("share", [0.3, 0.5, 0.9])
def test_truncated_cwa_file_is_rejected_or_flagged(file, share):
    """Wherever it ends."""
    try:
        record = read(file(FULL[: int(share * len(FULL))]))
    except InputError:
        return
    assert "count" in {doubt.kind for doubt in record.doubts}


@pytest.mark.parametrize(("output", "start"), [("", None), ("2020-01-02T03:04:05.250", datetime(2020, 1, 2, 3, 4, 5, 250_000, tzinfo=UTC))])
def test_cwa_start_time_is_optional_or_iso(file, output, start):
    """An empty StartTime costs the start and not the record; one with a T is read as it stands."""
    text = layouts.cwa(ROWS, event=False).replace("2020/01/02-03:04:05.250", output)
    assert output in text and "2020/01/02-" not in text
    assert read(file(text)).start == start
