"""Plain tables: names, units, separators and times in common notations; numbers exactly as in the file."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.core.errors import InputError, ParameterError, RecordError, RecordFormatError, UnitError
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.readers import read
from seisblock.records import motion_of

ROWS = "0.00{0}1{0}2{0}3\n0.01{0}4{0}5{0}6\n0.02{0}7{0}8{0}9\n"


@pytest.fixture
def table(tmp_path):
    def write(text, encoding="utf-8"):
        path = tmp_path / "table.csv"
        path.write_bytes(text.encode(encoding))
        return path

    return write


@pytest.mark.parametrize(
    "header",
    [
        "time,NS (gal),EW (gal),UD (gal)",
        "Time (s),ns_gal,ew_gal,ud_gal",
        "t,N-S(gal),E-W(gal),U-D(gal)",
        "t[s],NS[cm/s^2],EW[cm/s2],UD[cm/s/s]",
        "time_s,NS_cm_s2,EW_cm_s2,UD_cm_s2",
        "時間(秒),南北(gal),東西(gal),上下(gal)",
        "時間,南北成分[ガル],東西成分[ガル],上下成分[ガル]",
        '"time","acc_NS (Gal)","acc_EW (Gal)","acc_UD (Gal)"',
        "TIME,North (gal),East (gal),Up (gal)",
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp932"])
def test_headings_accept_names_and_units_in_any_style(table, header, encoding):
    """The header names components and units; time gives dt; components come as NS, EW, UD in m/s^2."""
    record = read(table(header + "\n" + ROWS.format(","), encoding))
    assert record.codes == ("NS", "EW", "UD")
    assert record.dt == 0.01
    np.testing.assert_array_equal(record.component("EW").acceleration, [0.02, 0.05, 0.08])


@pytest.mark.parametrize(("separator", "end"), [(",", "\r\n"), (";", "\n"), ("\t", "\n"), (", ", "\n"), ("   ", "\r\n")])
def test_separators_comments_and_line_ends_are_accepted(table, separator, end):
    """Commas, semicolons, tabs and blanks separate; # starts a comment; CRLF and blank lines do no harm."""
    text = "# a comment\n" + separator.join(["time", "NS", "EW", "UD"]) + "\n# another\n\n" + ROWS.format(separator) + "\n"
    record = read(table(text.replace("\n", end)), units="m/s2")
    np.testing.assert_array_equal(record.component("UD").acceleration, [3.0, 6.0, 9.0])
    assert record.dt == 0.01


@pytest.mark.parametrize("per_line", [2, 3, 5, 8, 10])
@pytest.mark.parametrize("separator", [",", " "])
@pytest.mark.parametrize("ending", ["", "\n"])
def test_one_series_with_several_samples_per_line_is_one_component(table, per_line, separator, ending):
    """Samples of real motion, whatever the number in the last line; columns read downwards would be other, shorter motions."""
    samples = np.round(100.0 * read("hanmer_springs_2016").component("10").acceleration[9000:12001], 3)
    lines = [separator.join(f"{x:.3f}" for x in samples[i : i + per_line]) for i in range(0, samples.size, per_line)]
    record = read(table("\n".join(lines) + ending), units="gal", dt=0.005)
    assert (record.codes, record.samples, record.doubts) == (("ACC",), 3001, ())
    np.testing.assert_allclose(100.0 * record.components[0].acceleration, samples, atol=1e-9)
    assert f"{per_line} samples per line" in str(record.history[0])


@pytest.mark.parametrize("title", ["Some title of a wave", "Hachinohe NS 1968\nsecond line of title", "八戸港湾 EW 成分"])
@pytest.mark.parametrize("per_line", [1, 8])
def test_title_above_unnamed_numbers_is_no_header(table, title, per_line):
    """The message says where the numbers begin and what to do with the title; done, the file is read."""
    samples = np.round(100.0 * read("hanmer_springs_2016").component("10").acceleration[9000:9800], 3)
    numbers = "".join(" ".join(f"{x:.3f}" for x in row) + "\n" for row in samples.reshape(-1, per_line))
    line = title.count("\n") + 2
    with pytest.raises(RecordFormatError, match=rf"numbers begin in line {line}, below .*; begin the lines above with #\Z"):
        read(table(f"{title}\n{numbers}"), units="gal", dt=0.005)
    commented = "".join(f"# {text}\n" for text in title.split("\n"))
    assert read(table(commented + numbers), units="gal", dt=0.005).samples == 800


def test_components_without_names_stay_components(table):
    """Of one station, or copies of each other; a cut last line is an error."""
    real = [100.0 * component.acceleration[9000:10000] for component in read("hanmer_springs_2016").components]
    for columns in (real, real[:2], [real[0], real[0]], [real[0], 0.9 * real[0], 0.5 * real[0]]):
        lines = [",".join(f"{x:.3f}" for x in row) for row in zip(*columns, strict=True)]
        record = read(table("\n".join(lines) + "\n"), units="gal", dt=0.005)
        assert (record.codes, record.samples) == (tuple(f"C{i + 1}" for i in range(len(columns))), 1000)
        with pytest.raises(RecordFormatError, match="line 1000"):
            read(table("\n".join([*lines[:-1], "1.0"])), units="gal", dt=0.005)


def test_columns_between_vertical_bars_are_read(table):
    """The file was refused; a resultant ``|a|`` beside blanks is none of them."""
    head = "time (s) | NS (gal) | EW (gal) | UD (gal)\n"
    for text in (head + ROWS.format(" | "), head.replace(" | ", "|") + ROWS.format("|").replace(".", ",")):
        rows = [c.acceleration.tolist() for c in read(table(text)).components]
        assert rows == [[0.01, 0.04, 0.07], [0.02, 0.05, 0.08], [0.03, 0.06, 0.09]]
    record = read(table("t ax ay |a|\n" + ROWS.format(" ")), units="gal")
    assert record.codes == ("X", "Y") and "|a|" in record.history[0]


@pytest.mark.parametrize("first", ["sep=;", "\ufeffSEP=;", '"sep=;"'])
def test_separator_line_of_excel_is_skipped(table, first):
    """The column names below it were not accepted."""
    record = read(table(f"{first}\ntime (s);NS (gal);EW (gal);UD (gal)\n" + ROWS.format(";").replace(".", ",")))
    assert (record.codes, record.dt, record.samples) == (("NS", "EW", "UD"), 0.01, 3)


def test_stated_separator_decides(table):
    """Vertical bars beside decimal commas, and names with a semicolon: the separator was guessed although the first line states it."""
    record = read(table("sep=|\ntime (s)|NS (gal)\n0,00|1,5\n0,01|2,5\n0,02|3,5\n"))
    assert record.component("NS").acceleration.tolist() == [0.015, 0.025, 0.035]
    record = read(table("sep=,\ntime (s),NS; raw (gal)\n0.00,1.5\n0.01,2.5\n0.02,3.5\n"))
    assert record.components[0].acceleration.tolist() == [0.015, 0.025, 0.035]


def test_decimal_commas_with_semicolons_are_accepted(table):
    """A spreadsheet of the continent: semicolons and decimal commas."""
    record = read(table("time;NS (g)\n0,00;0,5\n0,02;-0,25\n0,04;1\n"))
    np.testing.assert_array_equal(record.component("NS").acceleration, np.array([0.5, -0.25, 1.0]) * STANDARD_GRAVITY)
    assert record.dt == 0.02


def test_heading_in_comment_is_used(table):
    """As pyslammer writes its header behind #: names and units are taken from there."""
    record = read(table("\ufeff# Time Series: somewhere\n# Time (s),Acceleration (g's)\n0.0,4.6e-4\n0.005,2e-4\n"))
    assert record.codes == ("ACC",)
    assert record.dt == 0.005
    assert record.components[0].acceleration[0] == 4.6e-4 * STANDARD_GRAVITY


@pytest.mark.parametrize(
    "head",
    [
        "time,NS,EW,UD\ns,gal,gal,gal",
        "Time,N-S,E-W,U-D\n(sec),(cm/s2),(cm/s2),(cm/s2)",
        "時刻,南北,東西,上下\n秒,gal,gal,gal",
        "t,NS (gal),EW,UD\n,gal,gal,gal",
        "time,NS成分,EW成分,UD成分\n[s],[gal],[gal],[gal]",
        "sec;NS;EW;UD\ns;gal;gal;gal",
        "time NS EW UD\n# a comment\n(s) (gal) (gal) (gal)",
        ",NS (gal),EW (gal),UD (gal)",
        ",NS,EW,UD\ns,gal,gal,gal",
    ],
)
def test_unit_line_and_unnamed_time_column_are_accepted(table, head):
    """The second line may hold the units; a first column without a name that climbs is the time."""
    record = read(table(head + "\n" + ROWS.format(next((c for c in ";," if c in head), " "))))
    assert (record.codes, record.dt) == (("NS", "EW", "UD"), 0.01)
    np.testing.assert_array_equal(record.component("EW").acceleration, [0.02, 0.05, 0.08])
    assert any("first column" in line for line in record.history) == (head == ",NS (gal),EW (gal),UD (gal)")


@pytest.mark.parametrize("name", ["", "index", "No", "No.", "番号"])
def test_index_column_is_ignored_and_reported(table, name):
    """The index column of pandas and a column of row numbers are noted and not taken for the time."""
    record = read(table(f"{name},NS (gal),UD (gal)\n" + "".join(f"{i},{i % 7},{i % 5}\n" for i in range(60))), dt=0.01)
    assert record.codes == ("NS", "UD")
    assert record.history == (f"column '{name or 'index'}' ignored: line number",)
    with pytest.raises(ParameterError, match="`dt`"):
        read(table(f"{name},NS (gal)\n0,1\n1,2\n2,3\n"))


@pytest.mark.parametrize(
    ("form", "start", "clock"),
    [
        ("2024-01-01T{}", "2024-01-01T23:59:59.750000+00:00", None),
        ("2024/1/1 {}", "2024-01-01T23:59:59.750000+00:00", None),
        ("2024-01-01T{}Z", "2024-01-01T23:59:59.750000+00:00", None),
        ("2024-01-01 {}+09:00", "2024-01-01T14:59:59.750000+00:00", "JST"),
        ("{}", None, None),
    ],
)
def test_clock_times_give_interval_and_start(table, form, start, clock):
    """Dates and times give interval and start, past midnight, too; without a zone they are UTC, with a note."""
    seconds = [86399.75 + 0.005 * i for i in range(100)]
    cells = [f"{int(s // 3600) % 24:02d}:{int(s // 60) % 60:02d}:{s % 60:06.3f}" for s in seconds]
    days = [
        form.format(cell) if s < 86400 else form.replace("01-01", "01-02").replace("/1/1", "/1/2").format(cell)
        for s, cell in zip(seconds, cells, strict=True)
    ]
    record = read(table("time,NS (gal),UD (gal)\n" + "".join(f"{day},{i},1\n" for i, day in enumerate(days))))
    assert (record.dt, record.samples, record.codes) == (0.005, 100, ("NS", "UD"))
    assert (record.start.isoformat() if record.start else None) == start
    assert record.metadata.get("clock") == clock
    assert any("UTC" in line for line in record.history) == (start is not None and "Z" not in form and clock is None)
    assert "first_time_s" not in record.metadata


def test_date_that_stays_past_midnight_is_located(tmp_path):
    """Fractions of a second before the first time were subtracted: "usual step -0.01 s" for one step back by a day."""
    rows = [f"2024-01-01 {'23:59:59' if i < 50 else '00:00:00'}.{(50 + i) % 100:02d},{i % 7}" for i in range(150)]
    path = tmp_path / "midnight.csv"
    path.write_text("time,NS (gal)\n" + "\n".join(rows))
    with pytest.raises(RecordFormatError, match=r"step from 0\.99 to -86399 s, usual step 0\.01 s"):
        read(path)


def test_mg_and_fortran_exponents_are_read(table):
    """``mg`` is a thousandth of g, in a name, in a line of units and as an option; ``1.5D-03`` is 1.5e-3."""
    for text, options in (
        ("time,NS (mg)\n0,100\n0.01,-250\n", {}),
        ("time,ns_mg\n0,100\n0.01,-250\n", {}),
        ("time,NS\ns,mg\n0,100\n0.01,-250\n", {}),
        ("time NS\n0 100\n0.01 -250\n", {"units": "mg"}),
        ("time NS_g\n0.00D+00  1.0D-01\n0.10D-01  -.25D0\n", {}),
        ("0.0D0 0.1D0\n1.0D-2 -2.5D-1\n2.0D-2 0.D0\n", {"units": "g"}),
    ):
        np.testing.assert_allclose(read(table(text), **options).components[0].acceleration[:2], [0.980665, -2.4516625], rtol=1e-15)


def test_south_west_and_down_are_converted(table):
    """South is azimuth 180, west 270, and down is turned: north is minus south, east minus west, up minus down."""
    record = read(table("time,S (gal),W (gal),D (gal)\n" + ROWS.format(",")))
    assert [(c.code, c.azimuth_deg) for c in record.components] == [("180", 180.0), ("270", 270.0), ("UD", None)]
    np.testing.assert_allclose(motion_of(record, "0").horizontal, [-0.01, -0.04, -0.07], rtol=1e-12)
    np.testing.assert_allclose(motion_of(record, "90").horizontal, [-0.02, -0.05, -0.08], rtol=1e-12)
    np.testing.assert_array_equal(record.vertical.acceleration, [-0.03, -0.06, -0.09])
    assert "positive down" in record.history[0]


def test_names_from_south_to_north_and_from_west_to_east_have_azimuths(table):
    """They were columns without a unit or axes of unknown azimuth."""
    for header in ("SN (gal),WE (gal)", "S-N (gal),W-E (gal)"):
        record = read(table(f"time,{header},UD (gal)\n" + ROWS.format(",")))
        assert [(c.code, c.azimuth_deg) for c in record.components] == [("NS", 0.0), ("EW", 90.0), ("UD", None)]


def test_euc_jp_is_read(table):
    """EUC-JP is read where it cannot be Shift-JIS."""
    assert read(table("時間(s),南北(gal),東西(gal),上下(gal)\n" + ROWS.format(","), "euc_jp")).codes == ("NS", "EW", "UD")


def test_even_first_column_without_heading_is_time(table):
    """Of two columns of numbers the evenly increasing one is the time, with a history entry; one column needs dt."""
    record = read(table("0.00 0.1\n0.02 0.2\n0.04 -0.1\n"), units="g")
    assert record.codes == ("ACC",)
    assert record.dt == 0.02
    assert "time" in record.history[0]
    with pytest.raises(ParameterError, match="`dt`"):
        read(table("0.1\n0.2\n-0.1\n"), units="g")
    assert read(table("0.1\n0.2\n-0.1\n"), units="g", dt=0.01).samples == 3


def test_other_quantities_are_ignored_and_reported(table):
    """Beside NS and EW an index, a velocity and a note do not matter; their text is not read, and each is named."""
    record = read(table("index,time,NS (gal),EW (gal),vel (cm/s),note\n1,0,1,2,9,a\n2,0.01,3,4,9,b\n"))
    assert record.codes == ("NS", "EW")
    assert record.history == (
        "column 'index' ignored: line number",
        "column 'vel (cm/s)' ignored: velocity values",
        "column 'note' ignored: remarks",
    )


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(-50, 50, allow_subnormal=False), min_size=2, max_size=30))
def test_samples_of_17_digits_round_trip(tmp_path_factory, values):
    """Samples of 17 digits in m/s^2 reach the solver bit by bit."""
    path = tmp_path_factory.mktemp("exact") / "a.csv"
    path.write_text("NS (m/s2)\n" + "".join(f"{v!r}\n" for v in values))
    np.testing.assert_array_equal(read(path, dt=0.01).component("NS").acceleration, values)
    path.write_text("NS (m/s2)\n" + "".join(f"{v:.17g}\n" for v in values))
    np.testing.assert_array_equal(read(path, dt=0.01).component("NS").acceleration, values)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(-2_000_000, 2_000_000), min_size=2, max_size=30))
def test_gal_with_three_decimals_convert_exactly(tmp_path_factory, thousandths):
    """A gal value of three decimals becomes the double nearest to its hundredth."""
    path = tmp_path_factory.mktemp("exact") / "a.csv"
    path.write_text("NS (gal)\n" + "".join(f"{v / 1000:.3f}\n" for v in thousandths))
    np.testing.assert_array_equal(read(path, dt=0.01).component("NS").acceleration, [float(f"{v}e-5") for v in thousandths])


@pytest.mark.parametrize("dt", [0.01, 0.02, 0.005, 1 / 128, 1 / 300, 0.03])
def test_interval_is_rounded_to_printed_digits(table, dt):
    """Times with six decimals give the interval 0.02, not 0.020000000000000004."""
    text = "time,NS (gal)\n" + "".join(f"{i * dt:.6f},1\n" for i in range(6000))
    assert read(table(text)).dt == dt


def test_uneven_time_is_rejected_beyond_rounding(table):
    """A time 1e-5 s off its place is refused with the place; 5e-7 s off is rounding."""
    even = [i * 0.01 for i in range(100)]
    for shift, accepted in ((5e-7, True), (1e-5, False), (5e-3, False)):
        times = [*even[:50], even[50] + shift, *even[51:]]
        path = table("time,NS (gal)\n" + "".join(f"{t:.9f},1\n" for t in times))
        if accepted:
            assert read(path).dt == 0.01
        else:
            with pytest.raises(RecordFormatError, match=r"uneven time column: step from 0\.(49|5)"):
                read(path)
    with pytest.raises(RecordFormatError, match="does not increase"):
        read(table("time,NS (gal)\n0,1\n0,1\n0,2\n"))


@pytest.mark.parametrize(("dt", "printed"), [(0.01, "{:.0f}"), (0.01, "{:.1f}"), (0.005, "{:.2f}")])
def test_too_coarse_times_are_rejected_by_cause(table, dt, printed):
    """Most of 30 lines repeat the time before: the error names the column, not a missing line."""
    text = "time,NS (gal)\n" + "".join(f"{printed.format(i * dt)},{i % 7}.5\n" for i in range(30))
    with pytest.raises(
        RecordFormatError, match=r"too few digits in the time column: \d+ of 30 times repeat the previous line .* remove the column"
    ):
        read(table(text))


@pytest.mark.parametrize(
    ("text", "options", "error", "says"),
    [
        ("time,NS,EW\n0,1,2\n0.01,3,4\n", {}, UnitError, "'NS' has no unit"),
        ("time,NS (V)\n0,1\n0.01,3\n", {}, UnitError, "unknown unit 'V'"),
        ("time,NS\n0,1\n0.01,3\n", {"units": "furlong"}, UnitError, "'furlong'"),
        ("time,NS (gal)\n0,1\n0.01,3\n", {"units": "g"}, UnitError, "contradicts `units` g; omit `units`"),
        ("NS (gal)\n1\n2\n", {}, ParameterError, "no time column"),
        ("time,NS (gal)\n0,1\n0.01,3\n", {"dt": 0.02}, ParameterError, "0.01 s contradicts `dt` 0.02 s"),
        ("NS (gal)\n1\n2\n", {"dt": -0.02}, RecordError, "must be positive"),
        ("time,NS (gal),EW (gal)\n", {}, RecordFormatError, "no samples"),
        ("time,NS (gal)\n0,1\n0.01,x\n", {}, RecordFormatError, "line 3: expected a number in column NS (gal), found 'x'"),
        (
            "# c\ntime,NS (gal)\n\n0,1\n# d\n0.01,NaN\n",
            {},
            RecordFormatError,
            "line 6: expected a finite number in column NS (gal), found 'NaN'",
        ),
        ("time,NS (gal)\n0,1\n0.01,\n0.02,1\n", {}, RecordFormatError, "line 3: empty cell in column NS (gal)"),
        ("time,NS (gal),EW (gal)\n0,1,2\n0.01,1\n", {}, RecordFormatError, "line 3: empty cell in column EW (gal)"),
        ("time,NS (gal)\n0,1\n0.01,2,7\n", {}, RecordFormatError, "line 3: expected 2 cells, found 3"),
        ("time,NS (gal)\n0,1\n", {}, RecordFormatError, "at least 2 samples"),
        ("time (s)\n0\n0.01\n", {}, RecordFormatError, "no acceleration column: expected at least one, found time (s)"),
        ("time,NS (gal),N-S (gal)\n0,1,1\n0.01,2,2\n", {}, RecordFormatError, "several columns for NS"),
        ("time,NS (gal),EW (gal),foo\n0,1,2,3\n0.01,2,3,4\n", {}, RecordFormatError, "unknown column 'foo': expected a direction"),
        ("time (PST),NS (gal)\n0,1\n0.01,2\n", {}, UnitError, "unknown time unit 'PST'"),
        ("abc def\n", {}, RecordFormatError, "unknown file format (begins with 'abc def'); expected AFAD"),
        ("# only\n# comments\n", {}, RecordFormatError, "unknown file format (begins with '# only')"),
        (
            "Station: X\nDate: 2024\n\ntime (s),NS (gal)\n0,1\n0.01,2\n",
            {},
            RecordFormatError,
            "column names found in line 4 ('time (s),NS (gal)'), below 'Station: X'; remove the lines above",
        ),
        ("S,E,D\ngal,gal,kg\n1,2,3\n2,3,4\n", {"dt": 0.01}, UnitError, "column 'S' has no unit"),
        (",NS (gal)\n1,1\n3,2\n4,2\n", {"dt": 0.01}, RecordFormatError, "unknown column ''"),
        ("time,NS (gal)\n16:10:00.00,1\n16:10:00.01,2\n16:10:60.02,3\n", {}, RecordFormatError, "line 4: expected a number in column time"),
        (
            "time,NS (gal)\n2024-02-30T00:00:00,1\n2024-03-01T00:00:01,2\n",
            {},
            RecordFormatError,
            "line 2: expected a number in column time",
        ),
        ("time,NS (gal)\n16:10:00.00,1\n16:10:00.01,2\n16:10:00.03,3\n", {}, RecordFormatError, "uneven time column"),
    ],
)
def test_invalid_table_is_rejected_in_one_sentence(table, text, options, error, says):
    """Each mistake has its class, its line and its remedy, in one sentence."""
    with pytest.raises(error) as caught:
        read(table(text), **options)
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


def test_empty_line_in_single_column_is_flagged(table):
    """In one column without a clock an empty line may be a lost sample; with a clock, or at the end, it is nothing."""
    flags = read(table("NS (gal)\n1\n2\n\n-3\n\n"), dt=0.01).doubts
    assert [doubt.kind for doubt in flags] == ["line"]
    assert "1 empty line(s) among the samples (first: line 4)" in flags[0].message
    assert read(table("time,NS (gal)\n0,1\n\n0.01,-1\n")).doubts == ()


def test_truncated_last_line_is_flagged(table):
    """A last line that is shorter than all others and has no end looks cut; one that only lacks its end does not."""
    rows = "".join(f"{i / 100:.2f},{(-1) ** i * 1.25:.4f}\n" for i in range(20))
    assert [doubt.kind for doubt in read(table("time,NS (gal)\n" + rows[:-4])).doubts] == ["cut"]
    assert [doubt.kind for doubt in read(table("time,NS (gal)\n" + rows[:-1])).doubts] == []


def test_missing_interval_is_reported_before_reading(tmp_path):
    """A day-long table fails at its header at once, whatever its last line."""
    path = tmp_path / "day.csv"
    path.write_text("NS (gal),EW (gal)\n1,2\n3,4\n5,x\n")
    with pytest.raises(ParameterError, match="no time column"):
        read(path)
    with pytest.raises(RecordFormatError, match="line 4"):
        read(path, dt=0.01)


def test_huge_number_is_rejected_without_numpy_warning(table):
    """A damaged exponent: the decimals of 1e307 cannot be counted, and no ground moves like that."""
    with pytest.raises(InputError, match="beyond any ground acceleration"):
        read(table("NS (gal)\n1.5\n1e307\n2.5\n"), dt=0.01)


@pytest.mark.parametrize("zone", ["JST", "日本時間"])
def test_time_zone_in_heading_is_used(table, zone):
    """``time (JST)`` over times without a zone: the start is nine hours earlier in UTC; seconds stay seconds."""
    rows = "".join(f"2024-01-01 00:00:10.{i:02d},{i},{-i}\n" for i in range(5))
    record = read(table(f"時刻({zone}),NS (gal),EW (gal)\n{rows}"))
    assert record.start.isoformat() == "2023-12-31T15:00:10+00:00"
    assert record.metadata["clock"] == "JST"
    assert record.history == ()
    assert read(table("time (hh:mm:ss),NS (gal)\n16:10:10.0,1\n16:10:10.1,2\n16:10:10.2,1\n")).dt == pytest.approx(0.1)


@pytest.mark.parametrize("heading", ["日時", "時刻 (s)"])
def test_times_below_a_japanese_heading_are_in_jst(table, heading):
    """They were taken as UTC: the start was nine hours late, and the clock shown that of another zone."""
    rows = "".join(f"2024-01-01 00:00:10.{i:02d},{i},{-i}\n" for i in range(5))
    record = read(table(f"{heading},NS (gal),EW (gal)\n{rows}"))
    assert (record.start.isoformat(), record.metadata["clock"]) == ("2023-12-31T15:00:10+00:00", "JST")
    assert record.history == ("times taken as JST (Japanese heading without a time zone)",)
    stated = "".join(f"2024-01-01 00:00:10.{i:02d}Z,{i},{-i}\n" for i in range(5))
    assert read(table(f"{heading},NS (gal),EW (gal)\n{stated}")).start.isoformat() == "2024-01-01T00:00:10+00:00"


def test_unit_line_may_have_gaps_and_other_units(table):
    """A dash is no unit; a line of centimetres is one of units all the same, and not the names of the columns."""
    rows = "1,0.00,1,2\n2,0.01,5,3\n3,0.02,1,2\n"
    record = read(table(f"No,time,NS,EW\n-,s,gal,gal\n{rows}"))
    assert [component.code for component in record.components] == ["NS", "EW"]
    with pytest.raises(RecordFormatError, match=r"no acceleration column: .* NS \(cm\)"):
        read(table(f"No,time,NS,EW\n-,s,cm,cm\n{rows}"))


def test_euc_jp_and_shift_jis_are_distinguished(table):
    """A heading in EUC-JP is read as it was written, and one in Shift-JIS, be it in half-width kana, too."""
    rows = "0.00,1,2,3\n0.01,4,5,-6\n0.02,1,2,3\n"
    for head in ("経過時間(s),NS方向(gal),EW方向(gal),UD方向(gal)", "時刻(s),南北成分(gal),東西成分(gal),上下成分(gal)"):
        for encoding in ("euc_jp", "cp932"):
            assert read(table(f"{head}\n{rows}", encoding)).codes == ("NS", "EW", "UD"), (head, encoding)
    assert read(table(f"time,NS (gal),EW (gal),ﾁｸﾊﾞﾝ(gal)\n{rows}", "cp932")).codes[2] == "チクバン"


@pytest.mark.parametrize("moment", ["0001-01-01T00:00:00", "9999-12-31T23:59:58", "0900-01-01T00:00:00"])
def test_clock_beyond_calendar_is_rejected(table, moment):
    """A damaged year is a cell that is no time, and no overflow."""
    rows = "".join(f"{moment}.{i:02d}-09:00,{i}\n" for i in range(4))
    with pytest.raises(InputError):
        read(table(f"time (JST),NS (gal)\n{rows}"))


@pytest.mark.parametrize(("dt", "accepted"), [(0.01, True), (0.0100009, True), (0.0100011, False), (0.02, False)])
def test_interval_option_must_agree_with_time_column(table, dt, accepted):
    """An interval that differs by more than a microsecond contradicts the column of times."""
    path = table("time (s),NS (gal)\n" + "".join(f"{0.01 * i:.2f},{i % 7}\n" for i in range(60)))
    if accepted:
        assert read(path, dt=dt).dt == 0.01
    else:
        with pytest.raises(ParameterError, match=r"interval of the time column .* contradicts `dt`"):
            read(path, dt=dt)


@pytest.mark.parametrize(
    ("header", "row"),
    [("time (ms),NS (gal)", "{t},{a},5"), ("NS (gal),EW (gal)", '"{a},5","{a},2"'), ("time (s) NS (gal)", "0.{t:03} {a} 5")],
)
def test_row_with_more_cells_than_names_is_refused(table, header, row):
    """Commas of decimals split every number in two: the first cells were read, 12,5 gal as 12, and 0,2 of the next column as 5."""
    rows = [row.format(t=10 * i, a=i % 7) for i in range(40)]
    with pytest.raises(RecordFormatError, match=r"line 2: expected 2 cells, found [34]"):
        read(table("\n".join([header, *rows, ""])), dt=None if "time" in header else 0.01)


def test_blank_cells_beyond_names_are_accepted(table):
    """Trailing commas, as a spreadsheet writes them, are no cells; a number there is one, in whatever line."""
    rows = [f"{i / 100:.2f},{i % 7},,," for i in range(40)]
    assert read(table("\n".join(["time,NS (gal)", *rows, ""]))).samples == 40
    rows[30] = "0.30,2,,8,"
    with pytest.raises(RecordFormatError, match="line 32: expected 2 cells"):
        read(table("\n".join(["time,NS (gal)", *rows, ""])))


@pytest.mark.parametrize("separator", [".", ","])
def test_separators_of_thousands_are_refused(table, separator):
    """Whole numbers of a spreadsheet, 998 and 1.014: the largest were read as the smallest."""
    cells = [f"{v:,}".replace(",", separator) for v in (1500, 20, 998, -1014, 3, 0, 512)]
    with pytest.raises(RecordFormatError, match=r"whole numbers up to 998 with 1\.500: separators of thousands\?"):
        read(table("\n".join(["NS (mm/s2);EW (mm/s2)", *(f"{cell};1" for cell in cells), ""])), dt=0.01)


@pytest.mark.parametrize("values", [(998, 0.5, 1.5), (998, 100.25, 512), (499, 1.014, 3), (1001, 1.014, 998), (998, 1.0145, 3)])
def test_decimals_beside_whole_numbers_are_no_thousands(table, values):
    """Below 1, above 100, without numbers near a thousand, beyond it or with four decimals, a point is a decimal point."""
    record = read(table("\n".join(["NS (mm/s2)", *(f"{value:g}" for value in values), ""])), dt=0.01)
    np.testing.assert_allclose(record.component("NS").acceleration, np.array(values) / 1000.0, rtol=1e-15)


@pytest.mark.parametrize(
    "text",
    [
        "time (s);NS (gal)\n0;0\n0,01;1,5\n0,02;-2,25\n",
        "time (s)  NS (gal)\n0,00  0,00\n0,01  1,50\n0,02  -2,25\n",
        "0,00  0,00\n0,01  1,50\n0,02  -2,25\n",
        "NS (gal)\n0,00\n1,50\n-2,25\n",
    ],
    ids=["zero first", "blanks", "blanks, no names", "one column"],
)
def test_decimal_commas_without_semicolons_or_after_zeros(table, text):
    """The first line of a spreadsheet is often 0;0; text files separate by blanks."""
    record = read(table(text), units=None if "gal" in text else "gal", dt=None if "0,01" in text else 0.01)
    np.testing.assert_array_equal(record.components[0].acceleration, [0.0, 0.015, -0.0225])


@pytest.mark.parametrize(("first", "flags"), [("0", 0), ("-0", 0), ("1", 1), ("10", 1)])
def test_zero_without_decimal_point_is_not_flagged(table, first, flags):
    """A spreadsheet writes 0 for 0.00; any other number without the point of its column has lost it."""
    rows = [f"{i / 100:.2f},{(i - 20) / 100:.2f}" for i in range(1, 60)]
    record = read(table("\n".join(["time (s),NS (gal)", f"0.00,{first}", *rows, ""])))
    assert sum(flag.kind == "point" for flag in record.doubts) == flags


@pytest.mark.parametrize("rows", [["0,05", "1,50", "-0,25"], ["0,01,0,5", "0,02,0,7", "0,03,0,1"]], ids=["one column", "two columns"])
def test_decimal_commas_between_commas_without_names_are_refused(table, rows):
    """05 and -0 are no numbers of a table: halves of 0,05 and -0,25 were read as two components."""
    with pytest.raises(RecordFormatError, match="decimal commas in a table separated by commas"):
        read(table("\n".join([*rows, ""])), units="gal", dt=0.01)


@pytest.mark.parametrize(
    ("header", "encoding"),
    [
        ("Tiempo;Aceleración N-S (gal);Aceleración E-O (gal);Aceleración Z (gal)", "cp1252"),
        ("Tempo (s);N-S (cm/s²);E-O (cm/s²);Verticale (cm/s²)", "utf-8"),
        ("Zeit;NS (gal);OW (gal);Vertikal (gal)", "utf-8"),
        ("Zaman (sn);K-G (gal);D-B (gal);Düşey (gal)", "cp1254"),
        ("时间(s);南北向(gal);东西向(gal);竖向(gal)", "gb18030"),
        ("時間(s);南北(gal);東西(gal);垂直(gal)", "big5"),
        ("Temps (s);Accélération NS (gal);Accélération EO (gal);Verticale (gal)", "cp1252"),
    ],
    ids=["Spanish", "Italian", "German", "Turkish", "Chinese", "Taiwanese", "French"],
)
def test_headings_of_other_languages(table, header, encoding):
    """Directions keep their meaning and the vertical is vertical, in the usual encodings."""
    rows = "0,00;1;2;3\n0,01;4;5;6\n0,02;7;8;9\n"
    record = read(table(header + "\n" + rows, encoding))
    assert record.codes == ("NS", "EW", "UD")
    np.testing.assert_array_equal(record.component("UD").acceleration, [0.03, 0.06, 0.09])


@pytest.mark.parametrize("name", ["X軸", "NS波", "南北", "上下(UD)", "東西成分"])
@pytest.mark.parametrize("encoding", ["cp932", "euc_jp", "utf-8"])
def test_japanese_headings_are_not_taken_for_others(table, name, encoding):
    """Bytes of Japanese beside Latin letters are no accented letters, nor Chinese."""
    if encoding == "euc_jp" and name in ("X軸", "NS波"):
        pytest.skip("no kanji of headings")
    record = read(table(f"時間(秒),{name}(gal)\n0.00,1\n0.01,4\n0.02,7\n", encoding))
    expected = {"X軸": "X軸", "NS波": "NS波", "南北": "NS", "上下(UD)": "UD", "東西成分": "EW"}
    assert record.codes == (expected[name],)


def test_long_runs_of_blanks_cost_no_time(table):
    """XML with indented lines was searched for numbers with decimal commas in exponential time."""
    text = "<?xml version='1.0'?>\n" + (" " * 200 + "<a href='b, c'>,</a>\n") * 50
    begin = time.process_time()
    with pytest.raises(RecordFormatError, match="unknown file format"):
        read(table(text))
    assert time.process_time() - begin < 10.0
