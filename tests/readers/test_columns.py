"""Every column of a table is read, omitted by name, or rejected with the accepted forms."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.core.errors import InputError, RecordFormatError, UnitError
from seisblock.readers import read
from seisblock.readers.formats.knet_csv import read_knet_csv
from seisblock.readers.source import RawFile
from seisblock.readers.table.columns import parse_header
from seisblock.readers.table.sampling import sampling_interval
from seisblock.records import motion_of
from tests.readers.files import JMA_BODY, JMA_HEADER, KNET_CSV

T = np.arange(400) * 0.01
NORTH, EAST, UP = np.sin(7 * T), 0.6 * np.sin(11 * T + 0.3), 0.2 * np.sin(23 * T)


@pytest.fixture
def table(tmp_path):
    """Return a function that writes a table and returns its path."""

    def write(header, *rows, name="table.csv"):
        path = tmp_path / name
        columns = rows or (T, NORTH, EAST, UP)
        path.write_text(header + "\n" + "".join(",".join(f"{x:.17g}" for x in row) + "\n" for row in zip(*columns, strict=True)))
        return path

    return write


def codes(record):
    """Return code and azimuth of each component."""
    return [(c.code, c.azimuth_deg) for c in record.components]


@pytest.mark.parametrize(
    ("header", "expected"),
    [
        ("time,N10E,N80W,UD", [("10", 10.0), ("280", 280.0), ("UD", None)]),
        ("time,10,280,UD", [("10", 10.0), ("280", 280.0), ("UD", None)]),
        ("time,010°,100°,UD", [("10", 10.0), ("100", 100.0), ("UD", None)]),
        ("time,N30E,N120E,UD", [("30", 30.0), ("120", 120.0), ("UD", None)]),
        ("time,S45W,S45E,up", [("225", 225.0), ("135", 135.0), ("UD", None)]),
        ("time,0,90,UD", [("NS", 0.0), ("EW", 90.0), ("UD", None)]),
        ("time,X,Y,Z", [("X", None), ("Y", None), ("UD", None)]),
        ("time,acc_x,acc_y,acc_z", [("X", None), ("Y", None), ("UD", None)]),
        ("time,ax,ay,az", [("X", None), ("Y", None), ("UD", None)]),
        ("time,L,T,V", [("L", None), ("T", None), ("UD", None)]),
        ("t,L,T,V", [("L", None), ("T", None), ("UD", None)]),
        ("time,HNN,HNE,HNZ", [("NS", 0.0), ("EW", 90.0), ("UD", None)]),
        ("time,IU.ANMO.00.HN1,IU.ANMO.00.HN2,IU.ANMO.00.HNZ", [("HN1", None), ("HN2", None), ("UD", None)]),
        ("time,N/S,E/W,U/D", [("NS", 0.0), ("EW", 90.0), ("UD", None)]),
    ],
)
def test_three_named_columns_give_three_components(table, header, expected):
    """Azimuths, X/Y/Z, L/T/V, SEED codes, N/S: all three columns are read, with their samples and the azimuths they tell."""
    record = read(table(header), units="m/s2")
    assert codes(record) == expected
    for component, samples in zip(record.components, (NORTH, EAST, UP), strict=True):
        np.testing.assert_array_equal(component.acceleration, samples)


@pytest.mark.parametrize(
    "form",
    [
        "{}成分",
        "{}方向",
        "{}動",
        "{}動成分",
        "{}加速度",
        "加速度{}",
        "{}方向加速度",
        "{} 成分",
        "{}_component",
        "{} comp.",
        "Comp. {}",
        "direction: {}",
        "Acceleration {}",
        "{}-acc",
        "acc.{}",
    ],
)
@pytest.mark.parametrize(
    "names", [("NS", "EW", "UD"), ("南北", "東西", "上下"), ("南北", "東西", "鉛直"), ("N", "E", "Z"), ("N-S", "E-W", "U-D")]
)
@pytest.mark.parametrize("unit", ["(gal)", "[gal]", ""])
def test_vertical_is_found_within_longer_names(table, form, names, unit):
    """Whatever word for component, direction or acceleration stands around it, the vertical is the vertical."""
    header = ",".join(["経過時間(s)", *(form.format(name) + unit for name in names)])
    record = read(table(header), units=None if unit else "gal")
    assert codes(record) == [("NS", 0.0), ("EW", 90.0), ("UD", None)]
    assert record.doubts == ()


@pytest.mark.parametrize("name", ["合成", "3成分合成加速度", "水平合成", "Resultant", "vector sum"])
def test_resultant_of_components_is_no_component(table, name):
    """The vector sum beside the components is ignored with a note; 合成波 is a synthetic motion."""
    total = np.sqrt(NORTH**2 + EAST**2 + UP**2)
    record = read(table(f"時刻(s),NS(gal),EW(gal),UD(gal),{name}(gal)", T, NORTH, EAST, UP, total))
    assert (record.codes, record.doubts) == (("NS", "EW", "UD"), ())
    assert any(name in note for note in map(str, record.history))
    assert read(table("時刻(s),合成波(gal)", T, NORTH)).samples == T.size


@pytest.mark.parametrize("unit", ["cm·s⁻²", "cm/s²", "cm/s\uff72", "cm s\u22122"])
def test_unit_with_raised_digits_is_gal(table, unit):
    """Raised minus and dot, and a raised 2 of Latin-1, which in Shift-JIS is the half-width katakana i."""
    record = read(table(f"time (s),NS ({unit}),EW ({unit}),UD ({unit})"))
    np.testing.assert_allclose(record.component("NS").acceleration, NORTH / 100.0)


def test_numbered_component_is_not_an_azimuth(table):
    """``component 1`` and ``comp 2`` are channels, not the azimuths 1 and 2; the words alone are names."""
    assert codes(read(table("time,component 1 (gal),comp 2 (gal),UD (gal)"))) == [("COMPONENT 1", None), ("COMP 2", None), ("UD", None)]
    assert codes(read(table("time,成分 (gal)", T, NORTH))) == [("成分", None)]


def test_column_t_with_acceleration_unit_is_transverse(table):
    """``L,T,V (gal)``: T is transverse, and the single unit applies to all columns, with a note."""
    record = read(table("L,T,V (gal)", NORTH, EAST, UP), dt=0.01)
    assert codes(record) == [("L", None), ("T", None), ("UD", None)]
    np.testing.assert_allclose(record.component("T").acceleration, EAST / 100, rtol=1e-15)
    assert record.history == ("unit gal of 'V (gal)' also used for 'L', 'T'",)
    with pytest.raises(UnitError, match="'T' may be time or the transverse direction"):
        read(table("L,T,V", NORTH, EAST, UP), dt=0.01)


def test_column_t_beside_time_is_transverse(table):
    """``R`` and ``T`` are radial and transverse beside a time column; a table of velocities is rejected by its quantity."""
    record = read(table("time,R,T,Z"), units="m/s2")
    assert codes(record) == [("R", None), ("T", None), ("UD", None)]
    np.testing.assert_array_equal(record.component("T").acceleration, EAST)
    with pytest.raises(RecordFormatError, match=r"no acceleration column.*NS vel \(cm/s\)"):
        read(table("time,NS vel (cm/s),EW vel (cm/s),UD vel (cm/s)"))


@pytest.mark.parametrize("name", ["UD down (gal)", "Z_down (gal)", "Z[gal] down", "Vertical (gal) down positive", "UD-downward_gal"])
def test_down_as_a_word_is_not_dropped(name, table):
    """Before or after the unit: it was part of the name of a channel, or dropped."""
    record = read(table(f"time,NS (gal),EW (gal),{name}"))
    assert record.codes == ("NS", "EW", "UD")
    np.testing.assert_allclose(record.component("UD").acceleration, -UP / 100, rtol=1e-15)
    upward = read(table("time,NS (gal),EW (gal),up-down (gal)"))
    np.testing.assert_allclose(upward.component("UD").acceleration, UP / 100, rtol=1e-15)


def test_down_column_is_inverted_and_reported(table):
    """A column that is positive down becomes UD with the sign reversed, with a note."""
    record = read(table("time,NS (gal),EW (gal),DOWN (gal)"))
    np.testing.assert_allclose(record.component("UD").acceleration, -UP / 100, rtol=1e-15)
    assert "positive down" in record.history[0]


def test_component_azimuth_uses_column_azimuths(table):
    """``--component 37`` of a record of N10E and N80W is what north and east give towards 37 degrees."""
    angle = np.radians(10.0)
    first, second = NORTH * np.cos(angle) + EAST * np.sin(angle), NORTH * np.sin(angle) - EAST * np.cos(angle)
    record = read(table("time,N10E (m/s2),N80W (m/s2),UD (m/s2)", T, first, second, UP))
    north, east = np.cos(np.radians(37.0)), np.sin(np.radians(37.0))
    np.testing.assert_allclose(motion_of(record, "37").horizontal, NORTH * north + EAST * east, atol=1e-12)
    path = table("time,10,280,UD", T, first, second, UP, name="bare.csv")
    ran = CliRunner().invoke(main, ["measure", str(path), "--units", "m/s2", "--component", "37", "--json", "--quiet"])
    assert json.loads(ran.stdout)["results"][0]["pga_m_s2"] == pytest.approx(np.abs(NORTH * north + EAST * east).max(), rel=1e-12)


@pytest.mark.parametrize(
    ("header", "error", "says"),
    [
        ("time,NS (gal),N-S (gal),UD (gal)", RecordFormatError, "several columns for NS ('NS (gal)', 'N-S (gal)')"),
        ("time,NS (gal),0° (gal),UD (gal)", RecordFormatError, "several columns for NS"),
        ("Time,RelativeTime,NS (gal),EW (gal)", RecordFormatError, "several columns for time"),
        ("time,gal,gal,gal", RecordFormatError, "'gal' is not a name for column 2"),
        ("time,TRUE,EW (gal),UD (gal)", RecordFormatError, "'TRUE' is not a name for column 2"),
        ("time,NS (gal),EW (gal),pressure", RecordFormatError, "unknown column 'pressure'"),
        ("time,NS (gal),EW (gal),p (hPa)", UnitError, "unknown unit 'hPa'"),
        ("time,one,two,three", RecordFormatError, "unknown column 'one', 'two', 'three': expected a direction"),
        ("time,10,200,UD", RecordFormatError, "ambiguous column names '10', '200': write azimuths as a perpendicular pair"),
        ("0.01,1,x,3", RecordFormatError, "ambiguous column names '0.01', '1', '3'"),
        ("time,HHN,HHE,HHZ", UnitError, "velocity-sensor codes 'HHN', 'HHE', 'HHZ'"),
        ("time,NS (gal),EW (m/s2),UD", UnitError, "column 'UD' has no unit"),
    ],
)
def test_unknown_columns_are_rejected_by_name(table, header, error, says):
    """Twice the same, a unit for a name, a word that is no direction: named, with what would be understood."""
    with pytest.raises(error) as caught:
        read(table(header))
    assert says in str(caught.value)


def test_units_option_makes_unknown_columns_channels(table):
    """With `units`, columns without a direction are accelerations and keep their names."""
    assert codes(read(table("time,table,base,top"), units="gal")) == [("TABLE", None), ("BASE", None), ("TOP", None)]
    assert codes(read(table("time,sensor A (gal),sensor B (gal),c (gal)"))) == [("SENSOR A", None), ("SENSOR B", None), ("C", None)]


def test_jma_and_knet_csv_reject_unknown_columns(tmp_path):
    """A second NS, or a name that is none, in a JMA or K-NET CSV is refused."""
    path = tmp_path / "jma.csv"
    for names in (" NS,NS,UD", " NS,EW,UD,foo"):
        path.write_bytes((JMA_HEADER.replace(" NS,EW,UD", names) + JMA_BODY).encode("cp932"))
        with pytest.raises(RecordFormatError, match="line 7: expected the components NS, EW and UD once each"):
            read(path)
    for old, new in (("E-W(gal),U-D(gal)\n2019", "N-S(gal),U-D(gal)\n2019"), ("U-D(gal)\n2019", "W-D(gal)\n2019")):
        with pytest.raises(RecordFormatError, match="unknown or duplicate: expected N-S, E-W, U-D"):
            read_knet_csv(RawFile("k.csv", KNET_CSV.replace(old, new).encode()))


def test_plot_export_headings_give_time_and_units(table):
    """``Time [s] - Plot 0`` is the time, ``NS [gal] - Plot 1`` NS in gal."""
    record = read(table("Time [s] - Plot 0,NS [gal] - Plot 1,EW [gal] - Plot 1,UD [gal] - Plot 2"))
    assert (record.codes, record.dt) == (("NS", "EW", "UD"), 0.01)


@pytest.mark.parametrize("dt", [0.00125, 0.005, 1 / 128, 0.02, 1 / 300])
@pytest.mark.parametrize("form", ["{:.6g}", "{:.5e}", "{:.4f}", "{:.8f}"])
@pytest.mark.parametrize("first", [0.0, 37.25])
def test_coarsely_printed_times_are_even(dt, form, first):
    """Six significant digits, or four decimals, hide a clock of 800 Hz after 100 s; within the digits printed it is even."""
    items = [form.format(first + i * dt) for i in range(120_000)]
    assert sampling_interval("t", np.array([float(text) for text in items]), lambda: items) == pytest.approx(dt, rel=1e-12)


@pytest.mark.parametrize("form", ["{:.2f}", "{:.3f}", "{:.6g}"])
@pytest.mark.parametrize("spoil", ["missing", "twice"])
@pytest.mark.parametrize("row", [1, 500, 3000, 5998])
def test_missing_or_repeated_line_is_found_in_coarse_times(form, spoil, row):
    """However few digits are printed, a line that is missing or stands twice is refused, with its place."""
    items = [form.format(i * 0.01) for i in range(6000)]
    items[row : row + 1] = [] if spoil == "missing" else [items[row]] * 2
    with pytest.raises(InputError, match="line missing or duplicate"):
        sampling_interval("t", np.array([float(text) for text in items]), lambda: items)


@pytest.mark.parametrize("separator", [",", "\t", " "])
def test_times_of_six_digits_are_read(tmp_path, separator):
    """800 Hz around 100 s, written with %.6g: 99.9975, 99.9988, 100, 100.001 ..."""
    path = tmp_path / "six.txt"
    rows = [separator.join((f"{99.0 + i * 0.00125:.6g}", "1", "2")) for i in range(3000)]
    path.write_text("\n".join([separator.join(("time", "NS(gal)", "EW(gal)")), "# a comment", *rows]) + "\n")
    assert read(path).dt == 0.00125


@pytest.mark.parametrize(
    ("names", "codes"),
    [
        (["S (gal)", "W (gal)", "D (gal)"], ["180", "270", "UD"]),
        (["B (gal)", "C (gal)", "D (gal)"], ["B", "C", "D"]),
        (["D (gal)"], ["D"]),
        (["NS (gal)", "EW (gal)", "UD (gal)", "D (gal)"], ["NS", "EW", "UD", "D"]),
        (["成分1 (gal)", "成分2 (gal)"], ["成分1", "成分2"]),
        (["振動 (gal)", "上下動 (gal)", "UD成分"], None),
        (["振動 (gal)", "上下動 (gal)"], ["振動", "UD"]),
    ],
    ids=repr,
)
def test_single_letter_column_is_direction_beside_horizontals_only(names, codes):
    """``D`` is down beside two horizontals without a vertical, and else a channel; ``成分1`` is the first, and not one degree."""
    if codes is None:
        with pytest.raises(RecordFormatError, match="several columns for UD"):
            parse_header("table", names)
        return
    read = parse_header("table", names).columns
    assert [column.code for column in read] == codes
    assert all(column.azimuth_deg is None for column in read if column.code in ("D", "成分1", "成分2"))
