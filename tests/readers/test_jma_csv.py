"""JMA CSV: every variant of the header, exact numbers, and the flag of the known defect."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest

from seisblock.core.errors import RecordFormatError, UnitError
from seisblock.readers import read
from seisblock.samples import sample_path
from tests.readers.files import JMA_BODY, JMA_HEADER, KOBE


def write(directory, text, encoding="cp932"):
    path = directory / "record.csv"
    path.write_bytes(text.encode(encoding))
    return path


@pytest.mark.parametrize("encoding", ["cp932", "utf-8", "utf-8-sig", "utf-16"])
def test_jma_header_of_2000_is_read_in_any_encoding(tmp_path, encoding):
    """Station, epicentre and start (JST to UTC) come out the same from Shift-JIS and from re-encoded files."""
    record = read(write(tmp_path, JMA_HEADER + JMA_BODY, encoding))
    assert (record.station, record.metadata["station_name"]) == ("EA0", "米子市博労町(旧)".replace("(", "（").replace(")", "）"))
    assert record.start == datetime(2000, 10, 6, 4, 30, 10, tzinfo=UTC)
    assert record.format == "JMA-CSV"
    assert record.dt == 0.01
    assert record.codes == ("NS", "EW", "UD")
    assert record.metadata["event_latitude_deg"] == 35.2733
    assert record.metadata["magnitude"] == 7.3
    assert abs((record.metadata["origin_time"] - datetime(2000, 10, 6, 4, 30, 17, 900000, tzinfo=UTC)).total_seconds()) < 0.01
    assert "station_latitude_deg" not in record.metadata  # 0.0000 means unknown
    assert "carries_offset" not in record.metadata


def test_jma_header_with_zeros_has_no_epicentre(tmp_path):
    """An event that was not located is written as zeros; a depth of 0 beside an epicentre is a depth."""
    located = "35.2733,133.3483,  9,7.3"
    assert located in JMA_HEADER
    record = read(write(tmp_path, JMA_HEADER.replace(located, "0.0000,0.0000,  0,0.0") + JMA_BODY))
    assert not {"event_latitude_deg", "event_depth_km", "magnitude"} & record.metadata.keys()
    shallow = read(write(tmp_path, JMA_HEADER.replace(located, "35.2733,133.3483,  0,7.3") + JMA_BODY))
    assert shallow.metadata["event_depth_km"] == 0.0


def test_gal_convert_to_m_s2_exactly(tmp_path):
    """306.21 gal is the double nearest to 3.0621 m/s^2, as if written in m/s^2."""
    record = read(write(tmp_path, JMA_HEADER + JMA_BODY))
    np.testing.assert_array_equal(record.component("NS").acceleration, [-0.00018, 0.00306, 3.0621])
    np.testing.assert_array_equal(record.component("EW").acceleration, [0.0, -0.12345, 0.005])
    np.testing.assert_array_equal(record.component("UD").acceleration, [-0.00017, 0.01001, -0.071])


def test_jma_header_of_1995_is_read(tmp_path):
    """The form of 1995 is read: 1995 not 2095, 50 Hz, cells after the third ignored because they are blank."""
    record = read(write(tmp_path, KOBE))
    assert record.start == datetime(1995, 1, 16, 20, 47, 31, tzinfo=UTC)
    assert record.dt == 0.02
    assert record.station == "193"
    assert record.metadata["station_latitude_deg"] == 34.6967
    np.testing.assert_array_equal(record.component("EW").acceleration, [0.0003, 0.0225])


def test_jma_columns_are_found_by_name(tmp_path):
    """Columns in another order, keys in other case and spacing, give the same components."""
    text = JMA_HEADER.replace(" NS,EW,UD", "UD,NS,EW").replace("SAMPLING RATE= 100Hz ", "Sampling Rate = 100Hz").replace("UNIT  =", "Unit=")
    record = read(write(tmp_path, text + "3,1,2\r\n6,4,5\r\n"))
    assert record.codes == ("NS", "EW", "UD")
    np.testing.assert_array_equal(record.component("NS").acceleration, [0.01, 0.04])
    np.testing.assert_array_equal(record.component("UD").acceleration, [0.03, 0.06])


def test_jma_format_is_detected_by_content(tmp_path):
    """The synthetic sample copied to any other name is the same record."""
    for name in ("record.csv", "record.txt", "record"):
        (tmp_path / name).write_bytes(sample_path("synthetic_jma.csv").read_bytes())
        assert read(tmp_path / name).sha256 == read("synthetic_jma.csv").sha256


@pytest.mark.parametrize(
    ("text", "error", "says"),
    [
        (JMA_HEADER[:60], RecordFormatError, "header incomplete"),
        (JMA_HEADER.split(" UNIT")[0], RecordFormatError, "header incomplete: 4 lines"),
        (JMA_HEADER, RecordFormatError, "no samples"),
        (JMA_HEADER.replace("gal(cm/s/s)", "volt"), UnitError, "line 5: unknown unit 'volt'"),
        (JMA_HEADER.replace("100Hz", "fast") + JMA_BODY, RecordFormatError, "line 4"),
        (JMA_HEADER.replace("2000 10 06", "2000 13 06") + JMA_BODY, RecordFormatError, "line 6"),
        (JMA_HEADER + "1,2,3\r\n1,nan,3\r\n", RecordFormatError, "line 9: expected a finite number in column EW, found 'nan'"),
        (JMA_HEADER + "1,2,3\r\n1,,3\r\n", RecordFormatError, "line 9: empty cell in column EW"),
        (JMA_HEADER + "1,2,3\r\n1,2\r\n", RecordFormatError, "line 9: empty cell in column UD"),
        (JMA_HEADER + "1,2,3\r\n\r\n1,2,x3\r\n", RecordFormatError, "line 10: expected a number in column UD, found 'x3'"),
        (JMA_HEADER + "1,2,3\r\n1,234,2,3\r\n", RecordFormatError, "line 9: expected 3 cells, found 4"),
    ],
)
def test_damaged_jma_file_is_rejected_with_line(tmp_path, text, error, says):
    """Each damage is refused with one sentence that names the file and, where there is one, the line."""
    text = text.replace("gal(cm/s/s)", "volt") + JMA_BODY if "volt" in text else text
    with pytest.raises(error) as caught:
        read(write(tmp_path, text))
    assert says in str(caught.value)
    assert "record.csv" in str(caught.value)


def test_overwritten_jma_samples_are_flagged_and_kept(tmp_path):
    """Half a second overwritten by samples 2 s later gives two flagged steps; smooth records are not flagged."""
    lines = sample_path("synthetic_jma.csv").read_bytes().decode("cp932").split("\r\n")
    assert read("synthetic_jma.csv").doubts == ()
    lines[7 + 3000 : 7 + 3050] = lines[7 + 3200 : 7 + 3250]
    record = read(write(tmp_path, "\r\n".join(lines)))
    flags = [doubt for doubt in record.doubts if doubt.component == "NS"]
    assert [doubt.kind for doubt in flags] == ["repetition", "jump"]
    # the original of the piece comes after it
    assert "1 interval(s) repeat earlier samples exactly (from 32.00 s, up to 0.5 s, as those 2 s before)" in flags[0].message
    assert "1 isolated step(s) (at 30.00 s)" in flags[1].message and "2015-12-04" in flags[1].message
    ns = record.component("NS").acceleration
    np.testing.assert_array_equal(ns[3000:3050], ns[3200:3250])


@pytest.mark.parametrize(
    ("spoil", "kinds"),
    [
        (lambda text: text, []),
        (lambda text: text[:-2], ["cut"]),
        (lambda text: text[:-5], ["cut"]),
        (lambda text: "\r\n".join(text.split("\r\n")[:-8]) + "\r\n", ["count"]),
        (lambda text: "\r\n".join(text.split("\r\n")[:3000] + text.split("\r\n")[3001:]), ["count"]),
        (lambda text: text[: text.index("\r\n", len(text) // 2) - 1], ["cut", "count"]),
    ],
    ids=["whole", "no line end", "cut in the last number", "seven lines short", "line missing", "half"],
)
def test_truncated_jma_file_is_flagged(tmp_path, spoil, kinds):
    """JMA ends every line and publishes whole seconds: deviations are flagged."""
    full = sample_path("synthetic_jma.csv").read_bytes().decode("cp932")
    assert [doubt.kind for doubt in read(write(tmp_path, spoil(full))).doubts if doubt.kind in ("cut", "count")] == kinds
