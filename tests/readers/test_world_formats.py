"""AFAD, UNAM, BHRC, CSMNC, RENADIC, USC, ASDF, telephones, Excel, archives of CESMD: units, peaks, directions, counts; damaged files."""

from __future__ import annotations

import io
import re
import zipfile
from datetime import UTC, datetime

import numpy as np
import obspy
import pytest

from seisblock.core.errors import InputError, RecordFormatError, UnitError
from seisblock.readers import read
from seisblock.readers.formats.at2 import at2_file_set
from seisblock.readers.uneven import resample_pairs
from tests.fuzz.formats import ROWS
from tests.readers import layouts, world
from tests.readers.stations import COUNTS_PER_UNIT, START, channel, counts, inventory
from tests.readers.world import DT, TENTH_G

START_TIME = datetime(2020, 1, 2, 3, 4, 5, 250000, tzinfo=UTC)
NORTH, EAST, UP = ROWS


def written(tmp_path, text, name="record.txt"):
    """Write a file and return its path."""
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode("cp1254"))
    return path


def assert_equal_gal(record, rows, atol):
    """Compare components, gal, with rows by code."""
    assert record.codes == tuple(rows)
    for code, row in rows.items():
        np.testing.assert_allclose(100 * record.component(code).acceleration, row, rtol=0, atol=atol)


def test_read_afad(tmp_path):
    """Three columns in gal, day first in the record time, peaks about the mean; a byte of another alphabet in the place."""
    record = read(written(tmp_path, world.afad(ROWS).replace("SYNTHETIC", "AYDİN")))
    assert_equal_gal(record, {"NS": NORTH, "EW": EAST, "UD": UP}, 1e-9)
    assert (record.dt, record.station, record.start) == (DT, "0000", START_TIME)
    assert record.metadata["magnitude"] == 6.5 and record.metadata["station_longitude_deg"] == 27.59223
    assert record.doubts == ()
    record = read(written(tmp_path, world.afad(ROWS).replace("37.87470N-27.59223E", "38N - 27.5E")))
    assert [record.metadata[f"station_{key}_deg"] for key in ("latitude", "longitude")] == [38.0, 27.5]


def test_read_unam(tmp_path):
    """Channels by bearing; the pre-event memory may begin on the day before, the record on the day after."""
    record = read(written(tmp_path, world.unam(ROWS)))
    assert_equal_gal(record, {"NS": NORTH, "EW": EAST, "UD": UP}, 6e-5)
    assert (record.dt, record.station, record.start) == (DT, "SYN1", START_TIME)
    assert record.metadata["event_longitude_deg"] == -98.6763 and record.metadata["magnitude"] == 7.1
    assert record.doubts == ()
    rotated = read(written(tmp_path, world.unam(ROWS, bearings="/V/N30E/S60E")))
    assert rotated.codes == ("30", "120", "UD")
    late = world.unam(ROWS, first="00:00:01").replace(": 03:04:00", ": 23:59:58")
    assert read(written(tmp_path, late)).start == datetime(2020, 1, 3, 0, 0, 1, tzinfo=UTC)


def test_read_bhrc(tmp_path):
    """L and T by their azimuths, g/10, the interval from duration and count."""
    record = read(written(tmp_path, world.bhrc(ROWS)))
    assert_equal_gal(record, {"324": NORTH, "54": EAST, "UD": UP}, 1e-4)
    assert (record.dt, record.station) == (DT, "9999")
    assert record.metadata["station_name"] == "Synthetic" and record.metadata["magnitude"] == 6.1
    assert record.doubts == ()
    assert [flag.kind for flag in read(written(tmp_path, world.bhrc(ROWS, end=False))).doubts] == ["cut"]


def test_read_renadic_with_even_times(tmp_path):
    """Pairs at even times are read as they are; a station without a number has none, places of zeros are no places."""
    record = read(written(tmp_path, world.renadic(ROWS)))
    assert not [key for key in record.metadata if "latitude" in key or "longitude" in key or "depth" in key]
    assert_equal_gal(record, {"NS": NORTH, "EW": EAST, "UD": UP}, 0.5e-3 * TENTH_G + 1e-9)
    assert (record.dt, record.station, record.history) == (DT, "", ())
    assert record.doubts == ()


def test_zero_of_an_unset_clock_is_no_time(tmp_path):
    """Recorders whose clock was never set print 1980-01-01 00:00."""
    text = world.renadic(ROWS).replace("01/02/2020 3:04:00", "01/01/1980 0:00:00").replace("1/02/2020 3:04:05.000", "1/1/1980 0:00:00.000")
    record = read(written(tmp_path, text))
    assert (record.codes, record.start) == (("NS", "EW", "UD"), None)
    assert "origin_time" not in record.metadata


def test_uneven_pairs_keep_every_value(tmp_path):
    """A film record: interpolated at the printed millisecond, linear in between, with its largest interval and band in the history."""
    times = np.round(np.cumsum(np.random.default_rng(3).choice([0.004, 0.009, 0.013], NORTH.size)), 3)
    times -= times[0]
    record = read(written(tmp_path, world.renadic(ROWS, times=times)))
    assert record.dt == 0.001
    places = np.rint(times / 0.001).astype(int)
    np.testing.assert_allclose(100 * record.component("NS").acceleration[places], NORTH, rtol=0, atol=0.5e-3 * TENTH_G + 1e-9)
    assert any("largest interval 0.013 s" in entry and "38.5 Hz" in entry for entry in record.history)
    assert record.doubts == ()
    between = np.interp(0.001 * np.arange(record.samples), times, 100 * record.component("NS").acceleration[places])
    np.testing.assert_allclose(100 * record.component("NS").acceleration, between, atol=1e-9)


def test_resample_pairs_rejects_times_that_decrease():
    """A line in the wrong place; times that never increase; times in another unit."""
    values = [np.arange(5.0)]
    with pytest.raises(RecordFormatError, match="followed by an earlier time"):
        resample_pairs("a", np.array([0.0, 0.1, 0.05, 0.2, 0.3]), values, 1e-3)
    with pytest.raises(RecordFormatError, match="followed by an earlier time"):
        resample_pairs("a", np.zeros(5), values, 1e-3)
    with pytest.raises(RecordFormatError, match="too many"):
        resample_pairs("a", np.array([0.0, 1e4, 3e4, 7e4, 9e7]), values, 1e-3)


@pytest.mark.parametrize("volume", [1, 2])
def test_read_usc(volume, tmp_path):
    """Volume 1 in pairs, volume 2 with velocities and displacements behind; three files are one record."""
    for letter, name, row in (("a", "N00W", NORTH), ("b", "N90E", EAST), ("c", "DOWN", UP)):
        text = world.usc_v1(row, DT * np.arange(row.size), name=name) if volume == 1 else world.usc_v2(row, name=name, sign=-1.0)
        written(tmp_path, text, f"000m00xx.s0{letter}")
    record = read(tmp_path / "000m00xx.s0b")
    atol = 0.5e-3 * TENTH_G + 1e-9 if volume == 1 else 6e-4
    assert_equal_gal(record, {"NS": NORTH, "EW": EAST, "UD": -UP}, atol)
    assert (record.dt, record.station) == (DT, "0061")
    assert record.metadata["station_name"] == "SYNTHETIC STATION" and record.metadata["station_longitude_deg"] == pytest.approx(-118.22528)
    assert record.metadata["origin_time"] == datetime(2020, 1, 2, 3, 4, tzinfo=UTC)
    assert record.doubts == ()


@pytest.mark.parametrize(("form", "margin"), [("8.3f", ""), ("7.3f", ""), ("7.3f", " ")])
def test_read_usc_volume_1_takes_each_width(form, margin, tmp_path):
    """Fields of seven or eight characters, behind a blank column in some files."""
    text = world.usc_v1(NORTH, DT * np.arange(NORTH.size), form=form, margin=margin)
    record = read(written(tmp_path, text))
    np.testing.assert_allclose(100 * record.components[0].acceleration, NORTH, atol=0.5e-3 * TENTH_G + 1e-9)


def test_read_usc_volume_2_takes_the_unit_of_the_peak(tmp_path):
    """Older files state none above the samples; without either, none is guessed."""
    text = world.usc_v2(NORTH, states_unit=False)
    np.testing.assert_allclose(100 * read(written(tmp_path, text)).components[0].acceleration, NORTH, atol=6e-4)
    with pytest.raises(InputError):
        read(written(tmp_path, text.replace("CMS/SEC/SEC", "")))


def test_line_of_the_count_is_named_in_usc_volume_2(tmp_path):
    text = world.usc_v2(NORTH).replace("600 POINTS OF ACC", "1 POINTS OF ACC")
    line = 1 + next(i for i, row in enumerate(text.splitlines()) if "1 POINTS OF ACC" in row)
    with pytest.raises(RecordFormatError, match=f"line {line}\\b"):
        read(written(tmp_path, text))


@pytest.mark.parametrize("quantities", ["ACC", "ACC VEL"])
def test_read_usc_volume_2_without_displacements(quantities, tmp_path):
    """Some files end with the accelerations or with the velocities."""
    record = read(written(tmp_path, world.usc_v2(NORTH, quantities=quantities)))
    np.testing.assert_allclose(100 * record.components[0].acceleration, NORTH, atol=6e-4)
    assert record.doubts == ()


def test_companions_of_records_are_named(tmp_path):
    """StationXML and QuakeML in place of a record, the latter in one line beyond the limit of Python's CSV reader."""
    quakeml = '<?xml version="1.0"?><q:quakeml xmlns:q="http://quakeml.org/xmlns/quakeml/1.2" x="' + "a," * 100_000 + '"></q:quakeml>'
    for text, says in ((quakeml, "QuakeML of an earthquake"), ("<?xml version='1.0'?><FDSNStationXML/>", "StationXML of a station")):
        with pytest.raises(RecordFormatError, match=says):
            read(written(tmp_path, text, "x.xml"))


DAMAGED = {
    "afad": (world.afad(ROWS), "NUMBER OF DATA          : 600", "NUMBER OF DATA          : 601", "count"),
    "afad peak": (world.afad(ROWS), "(N-S) ", "(N-S) 1", "header"),
    "unam": (world.unam(ROWS), "/600/600/600", "/600/601/600", "count"),
    "unam peak": (world.unam(ROWS), "ACEL. MAX.(Gal), C1-C6                 : /", "ACEL. MAX.(Gal), C1-C6                 : /1", "header"),
    "usc count": (world.usc_v2(NORTH), "   600  INSTRUMENT", "   599  INSTRUMENT", "count"),
    "usc peak": (world.usc_v2(NORTH), "PEAK ACCELERATION = ", "PEAK ACCELERATION = 1", "header"),
    "renadic peak": (world.renadic(ROWS), "MAX  =  ", "MAX  =  1", "header"),
}


@pytest.mark.parametrize("case", DAMAGED)
def test_contradictions_of_the_header_are_flagged(case, tmp_path):
    """Count and peak against the samples."""
    text, old, new, kind = DAMAGED[case]
    assert old in text
    assert kind in {flag.kind for flag in read(written(tmp_path, text.replace(old, new))).doubts}


@pytest.mark.parametrize("layout", ["afad", "unam", "bhrc", "renadic", "usc_v1", "usc_v2"])
@pytest.mark.parametrize("damage", ["cut", "letters", "nan", "header only"])
def test_damaged_files_are_rejected_or_flagged(layout, damage, tmp_path):
    """One sentence or a flag, never a traceback and never a silent record."""
    writers = {"usc_v1": lambda: world.usc_v1(NORTH, DT * np.arange(NORTH.size)), "usc_v2": lambda: world.usc_v2(NORTH)}
    lines = writers.get(layout, lambda: getattr(world, layout)(ROWS))().splitlines(keepends=True)
    place = int(0.25 * len(lines))
    if damage == "cut":
        lines = lines[: int(0.3 * len(lines))]
    elif damage == "header only":
        lines = lines[:11]
    else:
        lines[place] = lines[place][:-4] + ("x1\n" if damage == "letters" else "nan\n")
    try:
        record = read(written(tmp_path, "".join(lines)))
    except InputError as error:
        assert len(str(error).replace(str(tmp_path), "")) < 400
    else:
        assert {flag.kind for flag in record.doubts} & {"count", "cut", "header"}


def test_archive_with_several_volumes(tmp_path):
    """A CESMD download: spectra are skipped and volume 2 is preferred to volume 1, with a note."""
    path = tmp_path / "station.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("A.V3", "RESPONSE AND FOURIER AMPLITUDE SPECTRA\nUNCORRECTED ACCELEROGRAM DATA\n")
        archive.writestr("A.V1", layouts.csmip(ROWS, volume=1))
        archive.writestr("A.V2", layouts.csmip(ROWS))
    record = read(path)
    assert record.metadata["volume"] == "V2"
    assert any("volume 2 used" in entry for entry in record.history)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("A.V3", "RESPONSE AND FOURIER AMPLITUDE SPECTRA\n")
    with pytest.raises(RecordFormatError, match="response spectra"):
        read(path)


def test_end_mark_of_a_station_channel_is_complete(tmp_path):
    """Two spellings of the end of today's files."""
    text = layouts.csmip(ROWS)
    for mark in ("End of data for channel", "End of Data for Station Channel"):
        assert read(written(tmp_path, text.replace("END OF DATA FOR CHANNEL", mark).replace("End of data for channel", mark))).doubts == ()


@pytest.mark.parametrize(("channels", "stated", "kinds"), [(3, 3, set()), (3, 4, set()), (3, 5, {"cut"}), (2, 3, {"cut"}), (2, 4, {"cut"})])
def test_spare_channel_of_a_recorder_is_no_truncation(channels, stated, kinds, tmp_path):
    """Recorders of the free field have four channels, of which a sensor needs three; any other missing channel is a loss."""
    lines = layouts.csmip(ROWS, volume=1).replace("(3 Chns of", f"({stated} Chns of").splitlines(keepends=True)
    ends = [i for i, line in enumerate(lines) if line.startswith("/&")]
    record = read(written(tmp_path, "".join(lines[: ends[channels - 1] + 1])))
    assert {flag.kind for flag in record.doubts} == kinds
    assert any("channels of the recorder" in entry for entry in record.history) == ((channels, stated) == (3, 4))


def test_peer_names_of_broadband_stations(tmp_path):
    """BHZ.00 is the vertical; BHN.00 and BHE.00 are its siblings."""
    head = "PEER NGA STRONG MOTION DATABASE RECORD\nEvent, 10/20/2011, CCM, {}\n"
    head += "ACCELERATION TIME HISTORY IN UNITS OF G\nNPTS= 600, DT= 0.01 SEC\n"
    for letter, row in zip("NEZ", ROWS, strict=True):
        body = "".join(f"{x / 980.665:16.7E}\n" for x in row)
        written(tmp_path, head.format(f"BH{letter}00") + body, f"RSN1_EV_IU.CCM.BH{letter}.00.AT2")
    record = read(tmp_path / "RSN1_EV_IU.CCM.BHZ.00.AT2")
    assert_equal_gal(record, {"NS": NORTH, "EW": EAST, "UD": UP}, 1e-4)
    assert at2_file_set("RSN1_A_IU.CCM.BH1.00.AT2").component == "BH1"


def write_asdf(path, traces, *, xml=None, tag="raw_recording", file_format="ASDF"):
    """Write traces of one station and its StationXML."""
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as file:
        file.attrs["file_format"] = np.bytes_(file_format)
        group = file.create_group("Waveforms/XX.TST")
        for trace in traces:
            data = group.create_dataset(f"{trace.id}__a__b__{tag}", data=trace.data)
            data.attrs["sampling_rate"], data.attrs["starttime"] = trace.stats.sampling_rate, trace.stats.starttime.ns
        if xml is not None:
            buffer = io.BytesIO()
            xml.write(buffer, "STATIONXML")
            group["StationXML"] = np.frombuffer(buffer.getvalue(), np.int8)


def test_read_asdf(tmp_path):
    """Response from the StationXML of the file; waveforms as recorded beside processed ones."""
    from tests.readers.stations import trace

    traces = [trace(f"HN{c}") for c in "NEZ"]
    path = tmp_path / "a.h5"
    write_asdf(path, traces, xml=inventory(*(channel(f"HN{c}") for c in "NEZ")))
    record = read(path)
    assert (record.network, record.station, record.location, record.codes) == ("XX", "TST", "00", ("NS", "EW", "UD"))
    np.testing.assert_allclose(record.component("EW").acceleration, counts("E") / COUNTS_PER_UNIT, rtol=1e-14)
    assert obspy.UTCDateTime(record.start) == START
    write_asdf(path, traces)
    with pytest.raises(UnitError, match="response is missing"):
        read(path)
    write_asdf(path, [])
    with pytest.raises(RecordFormatError, match="no waveforms in this ASDF file"):
        read(path)
    write_asdf(path, traces, file_format="other")
    with pytest.raises(RecordFormatError, match="not ASDF"):
        read(path)
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    with pytest.raises(RecordFormatError):
        read(path)


def phone_table(app):
    """Return the table of an app, sampled every 9 to 11 ms, and its times."""
    rng = np.random.default_rng(8)
    times = np.cumsum(0.01 + rng.uniform(-0.001, 0.001, 800))
    wave = np.column_stack([np.sin(2 * np.pi * f * times) for f in (1.0, 2.0, 1.5)]) + np.array([0.0, 0.0, 9.81])
    if app == "phyphox":
        head = '"Time (s)","Acceleration x (m/s^2)","Acceleration y (m/s^2)","Acceleration z (m/s^2)","Absolute acceleration (m/s^2)"'
        rows = [f"{t:.9E},{x:.9E},{y:.9E},{z:.9E},{np.hypot(x, z):.9E}" for t, (x, y, z) in zip(times, wave, strict=True)]
    elif app == "toolbox":
        head = "time,gFx,gFy,gFz,TgF"
        rows = [f"{t:.6f},{x / 9.80665:.9f},{y / 9.80665:.9f},{z / 9.80665:.9f},1.0" for t, (x, y, z) in zip(times, wave, strict=True)]
    else:
        head = "time,seconds_elapsed,z,y,x"
        rows = [f"{1700000000_000000000 + int(t * 1e9)},{t:.9f},{z},{y},{x}" for t, (x, y, z) in zip(times, wave, strict=True)]
    return head + "\n" + "\n".join(rows) + "\n"


@pytest.mark.parametrize("app", ["phyphox", "toolbox", "logger"])
def test_read_tables_of_accelerometer_apps(app, tmp_path):
    """Three axes, no absolute acceleration; uneven times at the mean rate; gravity is an offset."""
    record = read(written(tmp_path, phone_table(app), "phone.csv"))
    assert record.codes == ("X", "Y", "UD") and record.dt == pytest.approx(0.01)
    assert record.metadata["carries_offset"] is True
    x = record.component("X").acceleration
    first = record.metadata["first_time_s"]
    np.testing.assert_allclose(x, np.sin(2 * np.pi * (first + record.time)), atol=2e-3)
    assert record.component("UD").acceleration.mean() == pytest.approx(9.81, abs=0.05)
    assert any("largest interval" in entry for entry in record.history)
    assert (record.start is not None) == (app == "logger")


def write_xlsx(path, rows, *, sheets=1):
    """Write a workbook with the same rows in each sheet."""
    openpyxl = pytest.importorskip("openpyxl")
    workbook = openpyxl.Workbook()
    for number in range(sheets):
        sheet = workbook.active if number == 0 else workbook.create_sheet()
        for row in rows:
            sheet.append(row)
    workbook.save(path)


def test_read_xlsx(tmp_path):
    """A table with names and units, empty rows above; two tables and text are refused, a missing unit is asked for."""
    table = [
        ["time (s)", "NS (gal)", "UD(down)(gal)"],
        *([0.01 * i, float(a), float(b)] for i, (a, b) in enumerate(zip(NORTH, UP, strict=True))),
    ]
    path = tmp_path / "揺れ.xlsx"
    write_xlsx(path, [[], [None], *table])
    record = read(path)
    assert_equal_gal(record, {"NS": NORTH, "UD": -UP}, 1e-12)
    write_xlsx(path, [["熊本市役所, 2016/4/16"], [], [None, "gal"], *table])
    assert_equal_gal(read(path), {"NS": NORTH, "UD": -UP}, 1e-12)
    write_xlsx(path, table, sheets=2)
    with pytest.raises(RecordFormatError, match="2 sheets with a table"):
        read(path)
    write_xlsx(path, [["a", "b"]] * 5)
    with pytest.raises(InputError):
        read(path)
    write_xlsx(path, [["time (s)", "NS"], *([0.01 * i, float(a)] for i, a in enumerate(NORTH))])
    with pytest.raises(UnitError, match="no unit"):
        read(path)
    assert read(path, units="gal").samples == NORTH.size
    data = path.read_bytes()
    for damaged in (data[: len(data) // 2], data.replace(b"\n", b"\r"), data[:900] + bytes(60) + data[960:]):
        path.write_bytes(damaged)
        with pytest.raises(InputError):
            read(path)


def test_phone_table_that_is_cut_or_has_a_spike_is_flagged(tmp_path):
    """A last line of fewer cells; a spike, which interpolation would spread."""
    lines = phone_table("phyphox").splitlines()
    cut = "\n".join(lines[:-1]) + "\n" + ",".join(lines[-1].split(",")[:4])
    assert [flag.kind for flag in read(written(tmp_path, cut, "phone.csv")).doubts] == ["cut"]
    cells = lines[400].split(",")
    lines[400] = ",".join([cells[0], "9.9E+01", *cells[2:]])
    messages = [str(flag.message) for flag in read(written(tmp_path, "\n".join(lines) + "\n", "phone.csv")).doubts if flag.kind == "spike"]
    assert any("X: 1 isolated spike(s) (the first at" in message for message in messages)


def test_bhrc_with_two_channels_is_flagged(tmp_path):
    """Cut at the end of a channel."""
    text = world.bhrc(ROWS)
    assert "cut" in {flag.kind for flag in read(written(tmp_path, text[: text.index("COMP T3")])).doubts}


@pytest.mark.parametrize(
    ("heading", "code", "sign"),
    [
        ("UD(down)", "UD", -1),
        ("U-D(+down)", "UD", -1),
        ("Z (down +)", "UD", -1),
        ("Z-", "UD", -1),
        ("-UD", "UD", -1),
        ("NS(S+)", "NS", -1),
        ("NS (N+)", "NS", 1),
        ("EW(W)", "EW", -1),
        ("UD(up)", "UD", 1),
        ("UD(下向き正)", "UD", -1),
        ("上下(上が正)", "UD", 1),
        ("UD", "UD", 1),
        ("N-S", "NS", 1),
    ],
)
@pytest.mark.parametrize("unit", ["", " (gal)"])
def test_signs_in_column_names_are_obeyed(heading, code, sign, unit, tmp_path):
    """With the unit in the name, and with that of the option."""
    path = tmp_path / "a.csv"
    path.write_text(f"time (s),{heading}{unit}\n" + "".join(f"{0.01 * i:.2f},{x:.3f}\n" for i, x in enumerate(NORTH)), encoding="utf-8")
    record = read(path, units="gal")
    assert_equal_gal(record, {code: sign * NORTH}, 1e-9)


def test_brackets_that_are_neither_unit_nor_direction_are_rejected(tmp_path):
    """The text may be a sign or a filter."""
    path = tmp_path / "a.csv"
    path.write_text("time (s),NS (inverted) (gal)\n0.00,1\n0.01,2\n")
    with pytest.raises(RecordFormatError, match="'\\(inverted\\)'"):
        read(path)


def afad_esm(row: np.ndarray, letter: str, *, start: str = "2020/01/02 03:04:05.250000", data: str = "Acceleration") -> str:
    """Return one component as AFAD writes the layout of ESM since about 2020."""
    text = layouts.esm(row, stream=f"HN{letter}", data=data)
    changes = {
        "EVENT_DATE_YYYYMMDD": "2020/01/02",
        "EVENT_TIME_HHMMSS": "03:04:00.00000",
        "STATION_NAME": "",
        "LOCATION": "Synthetic_Merkez_Turkiye",
        "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS": start,
        "DURATION_S": "",
        "PGA_CM/S^2": f"{np.abs(np.round(row, 6)).max():.3f}",
        "TIME_PGA_S": "",
    }
    for key, value in changes.items():
        text = re.sub(rf"^{re.escape(key)}:.*$", f"{key}: {value}", text, flags=re.MULTILINE)
    return text.replace("USER5:", "DATA_CREATOR: AFAD\nUSER5:")


@pytest.mark.parametrize("start", ["2020/01/02 03:04:05.250000", "02/01/2020 03:04:05.250"])
def test_afad_files_in_the_layout_of_esm(tmp_path, start):
    """Components are joined by name; peaks have no sign, dates have slashes, LOCATION is the place."""
    rows = dict(zip("NEU", ROWS, strict=True))
    # the largest sample of one component is negative
    assert any(row[np.abs(row).argmax()] < 0.0 for row in rows.values())
    for letter, row in rows.items():
        code = {"U": "Z"}.get(letter, letter)
        written(tmp_path, afad_esm(row, code, start=start).encode(), f"20200102030400_0001_mp_RawAcc_{letter}.asc")
    record = read(tmp_path / "20200102030400_0001_mp_RawAcc_U.asc")
    assert (record.codes, record.doubts) == (("NS", "EW", "UD"), ())
    assert record.start == START_TIME
    assert record.metadata["origin_time"] == datetime(2020, 1, 2, 3, 4, tzinfo=UTC)
    assert (record.location, record.metadata["station_name"]) == ("", "Synthetic Merkez Turkiye")


@pytest.mark.parametrize("kind", ["afad", "esm", "cosmos", "smc", "csmnc"])
def test_velocities_beside_accelerations_in_an_archive_are_skipped(tmp_path, kind):
    """Downloads contain velocities, displacements or spectra of the same record; alone they are rejected."""
    row = ROWS[0]
    acceleration, velocity = {
        "afad": (afad_esm(row, "N"), afad_esm(row, "N", data="Velocity")),
        "esm": (layouts.esm(row, stream="HNN"), layouts.esm(row, stream="HNN", data="ACCELERATION RESPONSE SPECTRUM")),
        "cosmos": (layouts.cosmos(row), layouts.cosmos(row, title="Velocity data")),
        "smc": (layouts.smc(row), layouts.smc(row).replace("CORRECTED ACCELEROGRAM", "VELOCITY")),
        "csmnc": (world.csmnc(row), world.csmnc(row, quantity="VELOCITY")),
    }[kind]
    path = tmp_path / "download.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("a_vel.asc", velocity)
        archive.writestr("b_acc.asc", acceleration)
    record = read(path)
    assert len(record.components) == 1
    np.testing.assert_allclose(record.components[0].acceleration, row / 100.0, atol=1e-4)
    with pytest.raises(RecordFormatError):
        read(written(tmp_path, velocity.encode(), "a_vel.asc"))


def test_read_csmnc(tmp_path):
    """Three files numbered one after another are one record; the next three are another station's; clocks are Beijing time."""
    for number, (code, row) in enumerate((("EW", EAST), ("NS", NORTH), ("UD", UP)), 1):
        written(tmp_path, world.csmnc(row, code, number=number), f"ua000{number}.dat")
    written(tmp_path, world.csmnc(2.0 * EAST).replace("65SYN", "65OTH"), "ua0004.dat")
    for number in (1, 2, 3):
        record = read(tmp_path / f"ua000{number}.dat")
        assert_equal_gal(record, {"NS": NORTH, "EW": EAST, "UD": UP}, 6e-5)
        assert (record.dt, record.station, record.start) == (DT, "65SYN", START_TIME)
        assert record.doubts == ()
    assert record.metadata["origin_time"] == datetime(2020, 1, 2, 3, 4, tzinfo=UTC)
    assert (record.metadata["station_longitude_deg"], record.metadata["magnitude"]) == (77.599, 4.0)
    other = read(tmp_path / "ua0004.dat")
    assert (other.codes, other.station) == (("EW",), "65OTH")
    assert read(written(tmp_path, world.csmnc(EAST, recorder=""), "record.dat")).start is None


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("UNIT: CM/SEC/SEC", "UNIT: V", "expected acceleration and its unit"),
        ("COMP. EW", "COMP. LEFT", "expected a component such as EW, found 'LEFT'"),
        (f"OF:  {DT:.3f}", "OF:  0.000", "line 12: expected a sampling interval above 0 s"),
        (" -", " x", "line 17: expected a number"),
    ],
)
def test_damaged_csmnc_is_rejected(tmp_path, old, new, says):
    """One sentence with the line."""
    with pytest.raises(RecordFormatError, match=re.escape(says)):
        read(written(tmp_path, world.csmnc(EAST).replace(old, new)))


def test_contradictions_in_csmnc_are_flagged(tmp_path):
    """Count, peak and duration of the header against the samples."""
    text = world.csmnc(EAST)
    cut = "\n".join(text.split("\n")[:-4])
    assert {flag.kind for flag in read(written(tmp_path, cut)).doubts} >= {"count"}
    peak = re.search(r"PEAK VALUE: +(\S+)", text)[1]
    assert [flag.kind for flag in read(written(tmp_path, text.replace(peak, "99.999"))).doubts] == ["header"]
