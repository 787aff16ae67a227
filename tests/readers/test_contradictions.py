"""Files that contradict their header are flagged or rejected in every format with redundant data (FINDINGS R7)."""

from __future__ import annotations

import re

import numpy as np
import pytest

from seisblock.core.errors import RecordError, RecordFormatError, UnitError
from seisblock.readers import read
from tests.fuzz.formats import FORMATS, MM, ROWS, WRITERS
from tests.readers.files import JMA_HEADER, KNET_CSV, knet

COUNTS = [int(x * 1577) + 900 for x in ROWS[0]]
"""One row as a K-NET file holds it."""


def doubts(tmp_path, data, **options):
    """Return the kinds and texts of the flags of a file."""
    path = tmp_path / "spoilt"
    path.write_bytes(data)
    flags = read(path, **options).doubts
    return {doubt.kind for doubt in flags}, " ".join(doubt.message for doubt in flags)


@pytest.mark.parametrize("kind", FORMATS)
def test_valid_files_of_every_format_have_no_flag(kind, tmp_path):
    """Noise of many small steps, and no doubt but those of the samples' kind."""
    kinds, _ = doubts(tmp_path, FORMATS[kind].data, **FORMATS[kind].options)
    assert kinds <= {"directions"}


@pytest.mark.parametrize("word", [1, 2, 56])
def test_sac_header_extremes_are_checked(word, tmp_path):
    """DEPMIN, DEPMAX and DEPMEN are words 1, 2 and 56."""
    data = bytearray(FORMATS["sac"].data)
    data[4 * word : 4 * word + 4] = np.float32(4321.0).tobytes()
    kinds, text = doubts(tmp_path, bytes(data), **MM)
    assert kinds == {"header"} and "4321" in text


def test_undefined_sac_header_is_not_checked(tmp_path):
    """-12345 is SAC's word for not known."""
    data = bytearray(FORMATS["sac"].data)
    for word in (1, 2, 56):
        data[4 * word : 4 * word + 4] = np.float32(-12345.0).tobytes()
    assert doubts(tmp_path, bytes(data), **MM)[0] == set()


def test_miniseed_integration_constant_is_checked(tmp_path):
    """Steim's own check, of which ObsPy only warns: a difference in the middle of the block moved all later samples."""
    data = bytearray(FORMATS["mseed"].data)
    data[300] ^= 1
    kinds, text = doubts(tmp_path, bytes(data), **MM)
    assert "header" in kinds and "integrity" in text


@pytest.mark.parametrize("change", [lambda rows: rows[::-1], lambda rows: [*rows[:-1], rows[-2]]])
def test_tspair_times_are_checked(change, tmp_path):
    """Lines in another order and a line that stands twice: ObsPy looks at the first time alone."""
    head, *rows = FORMATS["tspair"].data.decode().rstrip("\n").split("\n")
    assert doubts(tmp_path, "\n".join([head, *change(rows)]).encode(), **MM)[0] >= {"clock"}


def test_slist_count_is_checked(tmp_path):
    """SLIST: one number more than the header states."""
    kinds, text = doubts(tmp_path, FORMATS["slist"].data + b"1\n", **MM)
    assert "count" in kinds and "601" in text


def _rows(count=40):
    return [f"{0.137 * i:.3f},{-0.011 * i:.3f},{0.003 * i:.3f}" for i in range(count)]


def _lost(rows, at=17):
    """Take the decimal points out of a line."""
    return [row.replace(".", "") if i == at else row for i, row in enumerate(rows)]


LAYOUTS = {
    "jma": lambda rows: (JMA_HEADER + "".join(row + "\r\n" for row in rows)).encode("cp932"),
    "table": lambda rows: ("time,NS (gal),EW (gal),UD (gal)\n" + "".join(f"{i / 100:.2f},{row}\n" for i, row in enumerate(rows))).encode(),
    "blanks": lambda rows: (
        "time NS_gal EW_gal UD_gal\n" + "".join(f"{i / 100:.2f} {row.replace(',', ' ')}\n" for i, row in enumerate(rows))
    ).encode(),
    "knet-csv": lambda rows: (
        KNET_CSV.split("2019/01/02 17:47:27.00")[0].replace("#60", "#1")
        + "".join(f"2019/01/02 17:47:{27 + i / 100:05.2f},{i / 100:.2f},{row}\n" for i, row in enumerate(rows))
    ).encode(),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_lost_decimal_point_is_flagged(layout, tmp_path):
    """A line without decimal points among 100 is flagged by its number."""
    rows = _rows(100)
    assert "point" not in doubts(tmp_path, LAYOUTS[layout](rows))[0]
    kinds, text = doubts(tmp_path, LAYOUTS[layout](_lost(rows)))
    assert "point" in kinds and re.search(r"3 number\(s\) without a decimal point \(first: -0187 in line \d+\)", text)


@pytest.mark.parametrize(("count", "lost", "flagged"), [(40, 1, True), (40, 2, False), (100, 2, True), (100, 3, False)])
def test_few_lines_without_decimal_points_are_flagged(count, lost, flagged, tmp_path):
    """One line, or 2 % of them: more belong to a program that prints whole numbers without a point."""
    rows = _rows(count)
    for k in range(lost):
        rows = _lost(rows, at=17 + 5 * k)
    assert ("point" in doubts(tmp_path, LAYOUTS["table"](rows))[0]) == flagged


def test_integers_in_float_table_are_not_flagged(tmp_path):
    """Programs that print 12 for 12.000 print 12.5 for 12.500, too."""
    rows = [f"{i / 100:g},{round(0.125 * i, 3):g}" for i in range(200)]
    assert "point" not in doubts(tmp_path, ("time,NS (gal)\n" + "\n".join(rows) + "\n").encode())[0]


@pytest.mark.parametrize(("rate", "duration"), [("1e999Hz", "2"), ("1e300Hz", "1e300"), ("100Hz", "1e400"), ("100Hz", "inf")])
def test_knet_header_with_invalid_numbers_is_flagged_or_rejected(rate, duration, tmp_path):
    """A rate or a duration that is no number, or one that no memory holds, is doubted or refused: never multiplied and believed."""
    path = tmp_path / "spoilt"
    path.write_text(knet(duration=duration, **{"Sampling Freq(Hz)": rate}))
    try:
        assert {doubt.kind for doubt in read(path).doubts} >= {"header"}
    except RecordError as error:
        assert "sampling" in str(error)


def test_knet_count_of_400_digits_is_rejected(tmp_path):
    """Refused with its line."""
    path = tmp_path / "spoilt"
    path.write_text(knet().replace("    1037 ", " " + "9" * 400 + " ", 1))
    with pytest.raises(RecordFormatError, match="line 18: expected counts"):
        read(path)


def test_jma_time_beyond_calendar_is_rejected(tmp_path):
    """The year 9999 ends in Japan nine hours before it does in Greenwich, the year 1 begins so: a sentence, no OverflowError."""
    path = tmp_path / "spoilt"
    header = JMA_HEADER.replace("2000 10 06 13 30 10", "9999 12 31 23 59 1e9")
    path.write_bytes((header + "1,2,3\r\n4,5,6\r\n").encode("cp932"))
    with pytest.raises(RecordFormatError, match="expected a time such as"):
        read(path)


@pytest.mark.parametrize(
    ("name", "changes", "text"),
    [
        ("NIG0990410231756.NS", {}, "file name (NIG099) and header (NIG019) disagree"),
        ("NIG0190410231756.EW", {}, "file name (EW) and header (NS) disagree"),
        ("any.NS", {"Record Time": "2003/10/23 17:56:20"}, "one of them is wrong"),
        ("any.NS", {"Record Time": "2004/10/23 19:56:20"}, "one of them is wrong"),
        ("any.NS", {"Station Lat.": "97.3054"}, "station coordinate 97.3054 degrees"),
        ("any.NS", {"Long.": "1388.70"}, "epicentre coordinate 1388.7 degrees"),
    ],
)
def test_knet_header_contradicting_file_name_is_flagged(name, changes, text, tmp_path):
    """Another component or station than the file is named for, another year than the earthquake's, a place beyond the pole."""
    (tmp_path / name).write_text(knet(COUNTS, duration="6", **changes))
    flags = read(tmp_path / name).doubts
    assert [doubt.kind for doubt in flags] == ["header"] and text in flags[0].message


@pytest.mark.parametrize("name", ["NIG0190410231756.NS", "nig0190410231756.ns", "renamed.NS", "a copy of it.txt"])
def test_knet_file_name_case_and_renaming_are_not_flagged(name, tmp_path):
    """Capitals are none of the file's doing, and other names say nothing."""
    (tmp_path / name).write_text(knet(COUNTS, duration="6"))
    assert read(tmp_path / name).doubts == ()


def knet_csv(change, tmp_path):
    """Return doubts about a K-NET CSV after a change of its lines."""
    return doubts(tmp_path, change(FORMATS["knet-csv"].data))


def test_knet_csv_with_differing_clocks_is_flagged(tmp_path):
    """A minute in one time of the day is another, or no time at all; the seconds beside it go on."""
    moved = knet_csv(lambda data: data.replace(b"17:47:28.50", b"17:48:28.50"), tmp_path)
    assert moved[0] == {"clock"} and "1 line(s), first at 1.50 s" in moved[1]
    assert knet_csv(lambda data: data.replace(b"17:47:28.50", b"17:4x:28.50"), tmp_path)[0] == {"clock"}


def test_knet_csv_in_another_unit_is_rejected(tmp_path):
    """It was read as gal whatever stood there."""
    with pytest.raises(UnitError, match="unit m/s2 in column 'E-W\\(m/s2\\)'"):
        knet_csv(lambda data: data.replace(b"E-W(gal)", b"E-W(m/s2)"), tmp_path)


def test_jma_header_with_two_units_is_rejected(tmp_path):
    """One gal is a cm/s/s."""
    with pytest.raises(UnitError, match="two units"):
        doubts(tmp_path, FORMATS["jma"].data.replace(b"gal(cm/s/s)", b"gal(m/s/s)"))


@pytest.mark.parametrize("column", ["NS (gal) [g]", "ns_gal (m/s2)"])
def test_column_with_two_units_is_rejected(column, tmp_path):
    """The last one was believed."""
    with pytest.raises(UnitError, match="two units, gal and"):
        doubts(tmp_path, FORMATS["comma"].data.replace(b"NS (gal)", column.encode()))


@pytest.mark.parametrize(("extra", "quantity"), [("NPTS=  500, ", "NPTS"), ("DT=   .0200 SEC, ", "DT")])
def test_at2_header_with_duplicate_entries_is_rejected(extra, quantity, tmp_path):
    """The first one was believed."""
    with pytest.raises(RecordFormatError, match="found several"):
        doubts(tmp_path, FORMATS["at2"].data.replace(f"{quantity}=".encode(), f"{extra}{quantity}=".encode()))


@pytest.mark.parametrize(
    ("comment", "kind"),
    [
        ("# dt = 0.005 s, npts = 600", "clock"),
        ("# sampling rate: 200 Hz", "clock"),
        ("# NPTS=6000, DT=0.01", "count"),
        ("# number of samples: 599", "count"),
        ("# unit: m/s^2", "header"),
    ],
)
def test_table_contradicting_its_comments_is_flagged(comment, kind, tmp_path):
    """Interval, count and unit above the numbers; with dt and npts the file is no AT2 for that."""
    kinds, text = doubts(tmp_path, comment.encode() + b"\n" + FORMATS["comma"].data)
    assert kinds == {kind} and "a comment" in text


@pytest.mark.parametrize("comment", ["# npts = 600, dt = 0.01", "# sampling rate: 100 Hz; unit: gal", "# dt = 10 ms, 2 m/s2 at most"])
def test_table_agreeing_with_its_comments_is_not_flagged(comment, tmp_path):
    """Nothing is doubted."""
    assert doubts(tmp_path, comment.encode() + b"\n" + FORMATS["comma"].data)[0] == set()


def test_dead_and_copied_channels_are_flagged(tmp_path):
    """Zeros while others shake; the samples of another component."""
    ns, ew, _ = ROWS
    dead = doubts(tmp_path, WRITERS["comma"]([ns, ew, 0.0 * ns]))
    assert dead[0] == {"held"} and "UD: all samples are 0" in dead[1]
    copied = doubts(tmp_path, WRITERS["comma"]([ns, ns, ew]))
    assert copied[0] == {"directions"} and "NS and EW are identical" in copied[1]
