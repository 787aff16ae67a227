"""MiniSEED and SAC with StationXML: units, instruments, directions, sensors, siblings; streams and events of ObsPy."""

from __future__ import annotations

import io
import json
import zipfile
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import obspy
import pytest

from seisblock.core.errors import ComponentError, KindError, ParameterError, RecordError, RecordFormatError, UnitError
from seisblock.readers import read, read_all
from seisblock.readers.discover import iter_records
from seisblock.readers.options import ReadOptions
from seisblock.readers.read import read_source
from seisblock.records import Component, Record
from seisblock.records.site import get_site
from seisblock.samples import sample_path
from tests.readers.stations import COUNTS_PER_UNIT, DT, START, channel, counts, inventory, trace, write_station


def test_read_miniseed_removes_sensitivity_as_obspy_does(tmp_path):
    """One file stands for its siblings; ObsPy's own remove_sensitivity is the reference, to the bit."""
    north, *_ = write_station(tmp_path, stages=True)
    record = read(north)
    assert (record.network, record.station, record.location) == ("XX", "TST", "00")
    assert record.codes == ("NS", "EW", "UD")
    assert record.channels == {"NS": "HNN", "EW": "HNE", "UD": "HNZ"}
    assert record.seed_id == "XX.TST.00.HN?"
    for code, letter in (("NS", "N"), ("EW", "E"), ("UD", "Z")):
        reference = trace(f"HN{letter}").remove_sensitivity(obspy.read_inventory(str(tmp_path / "XX.TST.xml")))
        np.testing.assert_array_equal(record.component(code).acceleration, reference.data)
    assert record.metadata["station_latitude_deg"] == 35.5
    assert any("4e+05" in entry or "400000" in entry for entry in record.history)


def test_read_miniseed_without_response_names_the_stationxml(tmp_path):
    """No guess of a unit is invited."""
    north, *_ = write_station(tmp_path, xml=False)
    with pytest.raises(UnitError, match=r"counts, .*net=XX&sta=TST&level=response") as error:
        read(north)
    assert "units" not in str(error.value)


def test_velocity_channel_is_rejected_unless_differentiate(tmp_path):
    """A unit is no consent; the derivative is obspy's."""
    paths = write_station(tmp_path, ("BHN", "BHE", "BHZ"), units="M/S", sensitivity=6e8, stages=True)
    for options in ({}, {"units": "mm/s2"}, {"inventory": tmp_path / "XX.TST.xml"}):
        with pytest.raises(UnitError, match=r"XX\.TST\.00\.BHN is a velocity channel|omit `units`"):
            read(paths[0], **options)
    (tmp_path / "XX.TST.xml").rename(tmp_path / "response.txt")
    for options in ({}, {"units": "gal"}):
        with pytest.raises(UnitError, match=r"XX\.TST\.00\.BHN is a velocity channel"):
            read(paths[0], **options)
    record = read(paths[0], differentiate=True, inventory=tmp_path / "response.txt")
    reference = obspy.read(str(paths[1]))[0].remove_sensitivity(obspy.read_inventory(str(tmp_path / "response.txt"))).differentiate()
    np.testing.assert_allclose(record.component("EW").acceleration, reference.data, rtol=1e-12)
    assert any("differentiated" in entry for entry in record.history)
    for unit, per_metre in {"kine": 100.0, "cm/s": 100.0, "M/S": 1.0, "mm/s": 1e3, "um/s": 1e6, "nm/s": 1e9, "in/s": 1.0 / 0.0254}.items():
        stated = read(paths[0], differentiate=True, units=unit)
        np.testing.assert_allclose(stated.component("NS").acceleration, np.gradient(counts("N") / per_metre, DT), rtol=1e-12)
    with pytest.raises(UnitError, match="unknown velocity unit 'gal'"):
        read(paths[0], differentiate=True, units="gal")


@pytest.mark.parametrize(
    ("units", "factor"), [("M/S**2", 1.0), ("m/s^2", 1.0), ("nm/s**2", 1e-9), ("CM/S**2", 0.01), ("mm/sec**2", 1e-3), ("G", 9.80665)]
)
def test_input_units_are_obeyed(units, factor, tmp_path):
    """Whatever the unit, the factor is that of the StationXML."""
    record = read(write_station(tmp_path, units=units)[0])
    np.testing.assert_allclose(record.component("NS").acceleration, counts("N") / COUNTS_PER_UNIT * factor, rtol=1e-14)


def test_input_units_of_other_quantities_are_rejected(tmp_path):
    """Pressure, displacement and volts are neither accelerations nor velocities."""
    for units in ("PA", "M", "V", "RAD/S"):
        paths = write_station(tmp_path, units=units)
        with pytest.raises(UnitError, match=f"measures {units}, neither acceleration nor velocity"):
            read(paths[0], differentiate=True)


@pytest.mark.parametrize(("units", "factor"), [("M", 1.0), ("cm", 0.01)])
@pytest.mark.parametrize("zeros", [0, 1, 2, 3])
def test_accelerometer_stated_for_displacement_is_read(zeros, units, factor, tmp_path):
    """With two zeros at 0 the response is flat to acceleration: the sensitivity per metre at 1 Hz is divided by (2 pi Hz)^2."""
    trace("HNN").write(str(tmp_path / "a.mseed"), "MSEED")
    metadata = channel("HNN", units=units, stages=True, sensitivity=COUNTS_PER_UNIT * (2.0 * np.pi) ** 2)
    metadata.response.response_stages[0].zeros = [0j] * zeros
    inventory(metadata).write(str(tmp_path / "a.xml"), "STATIONXML")
    if zeros == 2:
        record = read(tmp_path / "a.mseed")
        np.testing.assert_allclose(record.component("NS").acceleration, counts("N") / COUNTS_PER_UNIT * factor, rtol=1e-12)
    else:
        with pytest.raises(UnitError, match=f"measures {units}, neither acceleration nor velocity"):
            read(tmp_path / "a.mseed")


def test_unit_of_user_precedes_unknown_unit_of_processed_samples(tmp_path):
    """Files of programs that converted the samples state units such as ``acc``: `units` was of no use."""
    trace("HNN", data=counts("N") * 1.5e-3).write(str(tmp_path / "a.mseed"), "MSEED")
    inventory(channel("HNN", units="acc", sensitivity=1.0)).write(str(tmp_path / "a.xml"), "STATIONXML")
    with pytest.raises(UnitError, match="measures acc"):
        read(tmp_path / "a.mseed")
    record = read(tmp_path / "a.mseed", units="gal")
    np.testing.assert_allclose(record.component("NS").acceleration, counts("N") * 1.5e-5, rtol=1e-12)


def test_input_units_decide_against_channel_code(tmp_path):
    """A velocity behind HN? is refused; an acceleration behind HH? is read."""
    with pytest.raises(UnitError, match="HNN is a velocity channel"):
        read(write_station(tmp_path, units="M/S")[0])
    assert read(write_station(tmp_path, ("HHN", "HHE", "HHZ"))[0]).channels["EW"] == "HHE"


def test_orientation_is_that_of_the_stationxml(tmp_path):
    """Azimuths of HN1 and HN2, a vertical that is positive down, a negative sensitivity."""
    for code in ("HN1", "HN2", "HNZ"):
        trace(code).write(str(tmp_path / f"XX.TST.00.{code}.mseed"), "MSEED")
    station = inventory(channel("HN1", azimuth=30.0), channel("HN2", azimuth=120.0, sensitivity=-COUNTS_PER_UNIT), channel("HNZ", dip=90.0))
    station.write(str(tmp_path / "xx.xml"), "STATIONXML")
    record = read(tmp_path / "XX.TST.00.HN2.mseed")
    assert record.codes == ("30", "120", "UD")
    assert [c.azimuth_deg for c in record.components] == [30.0, 120.0, None]
    for code, letter, sign in (("30", "1", 1), ("120", "2", -1), ("UD", "Z", -1)):
        np.testing.assert_allclose(record.component(code).acceleration, sign * counts(letter) / COUNTS_PER_UNIT, rtol=1e-14)
    assert record.doubts == () or {flag.kind for flag in record.doubts} == {"offset"}


@pytest.mark.parametrize(("azimuth", "is_noted"), [(94.9, False), (95.1, True), (270.0, True)])
def test_azimuth_against_channel_code_is_noted(azimuth, is_noted, tmp_path):
    """SEED's N and E are within 5 degrees of north and east."""
    paths = write_station(tmp_path, ("HNN", "HNE"), xml=False)
    inventory(channel("HNN"), channel("HNE", azimuth=azimuth)).write(str(tmp_path / "a.xml"), "STATIONXML")
    record = read(paths[0])
    assert any("not that of the channel code" in entry for entry in record.history) == is_noted
    assert record.components[1].azimuth_deg == azimuth


def test_inclined_instrument_is_rejected(tmp_path):
    """Neither horizontal nor vertical."""
    paths = write_station(tmp_path, dip=-45.0)
    with pytest.raises(RecordFormatError, match="dip -45 degrees"):
        read(paths[0])


def test_epoch_of_the_record_is_used(tmp_path):
    """Three epochs with three sensitivities; none, or a change during the record, is an error."""
    paths = write_station(tmp_path, ("HNN",), xml=False)
    early, late = START - 86400, START + 86400
    epochs = [
        channel("HNN", sensitivity=1e5, end=early),
        channel("HNN", sensitivity=2e5, start=early, end=late),
        channel("HNN", sensitivity=3e5, start=late),
    ]
    inventory(*epochs).write(str(tmp_path / "a.xml"), "STATIONXML")
    np.testing.assert_allclose(read(paths[0]).component("NS").acceleration, counts("N") / 2e5, rtol=1e-14)
    inventory(epochs[0], epochs[2]).write(str(tmp_path / "a.xml"), "STATIONXML")
    with pytest.raises(UnitError, match="no epoch of the StationXML covers the record"):
        read(paths[0])
    inventory(channel("HNN", end=START + 1), channel("HNN", sensitivity=1e5, start=START + 1)).write(str(tmp_path / "a.xml"), "STATIONXML")
    with pytest.raises(UnitError, match="no epoch"):
        read(paths[0])
    inventory(channel("HNN"), channel("HNN", sensitivity=1e5)).write(str(tmp_path / "a.xml"), "STATIONXML")
    with pytest.raises(UnitError, match="2 epochs"):
        read(paths[0])


def test_sensitivity_that_is_zero_or_missing_is_rejected(tmp_path):
    """A division by it would be no acceleration."""
    with pytest.raises(UnitError, match="no usable sensitivity"):
        read(write_station(tmp_path, sensitivity=0.0)[0])


def test_several_sensors_require_location(tmp_path):
    """Two location codes, and two instruments of one location: refused with the list, selected by location or channel."""
    path = tmp_path / "all.mseed"
    stream = obspy.Stream([trace(f"{band}{c}", location=place) for place, band in (("00", "HN"), ("10", "HN"), ("", "EN")) for c in "NEZ"])
    stream.write(str(path), "MSEED")
    channels = [channel(t.stats.channel, location=t.stats.location, sensitivity=1e5 + 1e4 * len(t.stats.location)) for t in stream]
    inventory(*channels).write(str(tmp_path / "a.xml"), "STATIONXML")
    with pytest.raises(ComponentError, match=r"several sensors at TST: --\.EN, 00\.HN, 10\.HN; select one with `location`"):
        read(path)
    assert read(path, location="10").location == "10"
    assert read(path, location="--").channels["UD"] == "ENZ"
    assert read(path, location="EN").location == ""
    with pytest.raises(ComponentError, match="no sensor '20'"):
        read(path, location="20")
    with pytest.raises(ComponentError, match=r"several sensors at location 'HN': 00\.HN, 10\.HN"):
        read(path, location="HN")
    with pytest.raises(ComponentError, match="no location codes"):
        read("synthetic_jma.csv", location="00")


def test_siblings_are_cut_to_their_common_window(tmp_path):
    """Components that start up to a second apart are aligned by time; those that do not overlap are refused."""
    for code, lag, samples in (("HNN", 0.0, 3000), ("HNE", 0.5, 2990), ("HNZ", -0.25, 3000)):
        path = tmp_path / f"XX.TST.00.{code}.mseed"
        trace(code, start=START + lag, samples=samples).write(str(path), "MSEED")
    inventory(*(channel(f"HN{c}") for c in "NEZ")).write(str(tmp_path / "a.xml"), "STATIONXML")
    record = read(tmp_path / "XX.TST.00.HNE.mseed")
    assert record.samples == 2925
    assert record.start == datetime(2024, 1, 1, 7, 10, 10, 500000, tzinfo=UTC)
    np.testing.assert_allclose(record.component("NS").acceleration, counts("N")[50:2975] / COUNTS_PER_UNIT, rtol=1e-14)
    np.testing.assert_allclose(record.component("UD").acceleration, counts("Z")[75:3000] / COUNTS_PER_UNIT, rtol=1e-14)
    assert any("common window, 2925 samples" in entry for entry in record.history)
    trace("HNZ", start=START + 86400).write(str(tmp_path / "XX.TST.00.HNZ.mseed"), "MSEED")
    with pytest.raises(RecordError, match="start times differ"):
        read(tmp_path / "XX.TST.00.HNE.mseed")


def test_archive_with_stationxml_behind_the_records(tmp_path):
    """A zip of one station, read at once and as a source of a batch; a folder is found as one recording, too."""
    write_station(tmp_path)
    path = tmp_path / "station.zip"
    with zipfile.ZipFile(path, "w") as archive:
        for name in ("XX.TST.00.HNE.mseed", "XX.TST.00.HNN.mseed", "XX.TST.00.HNZ.mseed", "XX.TST.xml"):
            archive.write(tmp_path / name, name)
    reference = read(tmp_path / "XX.TST.00.HNN.mseed")
    (source,) = iter_records([str(path)], ReadOptions())
    for record in (read(path), read_source(source, ReadOptions())):
        assert record.codes == ("NS", "EW", "UD")
        np.testing.assert_array_equal(record.component("NS").acceleration, reference.component("NS").acceleration)
    path.unlink()
    (source,) = iter_records([str(tmp_path)], ReadOptions())
    assert len(source.files) == 3
    assert read_source(source, ReadOptions()).codes == ("NS", "EW", "UD")


def test_files_given_together_are_one_record(tmp_path):
    """As named on a command line, in any order, though they start a sample apart."""
    paths = write_station(tmp_path)
    trace("HNZ", start=START + 0.01).write(str(paths[2]), "MSEED")
    (record,) = read_all([str(path) for path in reversed(paths)])
    assert record.codes == ("NS", "EW", "UD") and record.samples == 2999


def test_two_networks_with_one_station_code_are_apart(tmp_path):
    """Selected by network and station."""
    path = tmp_path / "all.mseed"
    obspy.Stream([trace(f"HN{c}", network=n) for n in ("XX", "YY") for c in "NEZ"]).write(str(path), "MSEED")
    with pytest.raises(ComponentError, match=r"XX\.TST, YY\.TST"):
        read(path, units="gal")
    assert read(path, units="gal", station="YY.TST").network == "YY"
    with pytest.raises(ComponentError, match="several networks"):
        read(path, units="gal", station="TST")


def test_inventory_that_is_no_stationxml_is_rejected(tmp_path):
    """A missing, an empty and another file; a StationXML of another station; a damaged one."""
    path, *_ = write_station(tmp_path)
    (tmp_path / "other.xml").write_text("<html/>")
    with pytest.raises(RecordFormatError, match="not a StationXML"):
        read(path, inventory=tmp_path / "other.xml")
    with pytest.raises(FileNotFoundError):
        read(path, inventory=tmp_path / "none.xml")
    inventory(channel("HNN"), station="ABC").write(str(tmp_path / "abc.xml"), "STATIONXML")
    with pytest.raises(UnitError, match="not in the StationXML"):
        read(path, inventory=tmp_path / "abc.xml")
    text = (tmp_path / "XX.TST.xml").read_text()
    (tmp_path / "cut.xml").write_text(text[: len(text) // 2])
    with pytest.raises(RecordFormatError, match="ObsPy cannot read the StationXML"):
        read(path, inventory=tmp_path / "cut.xml")


def test_samples_that_are_no_counts_need_a_request(tmp_path):
    """SAC files after processing: a StationXML beside them is not applied unasked."""
    path = tmp_path / "XX.TST.00.HNN.SAC"
    trace("HNN", data=counts("N").astype(np.float32) * 1.5e-3).write(str(path), "SAC")
    inventory(channel("HNN")).write(str(tmp_path / "a.xml"), "STATIONXML")
    with pytest.raises(UnitError, match="not whole numbers"):
        read(path)
    stated = read(path, units="gal")
    assert stated.component("NS").acceleration.max() == pytest.approx(1.5e-5 * counts("N").max(), rel=1e-6)
    removed = read(path, inventory=tmp_path / "a.xml")
    assert removed.component("NS").acceleration.max() == pytest.approx(1.5e-3 * counts("N").max() / COUNTS_PER_UNIT, rel=1e-6)
    trace("HNN", data=counts("N").astype(np.float32)).write(str(path), "SAC")
    assert read(path).component("NS").acceleration.max() == pytest.approx(counts("N").max() / COUNTS_PER_UNIT, rel=1e-6)


def test_full_response_recovers_the_ground_motion(tmp_path):
    """A pole at 95 Hz makes the counts lag by 1.7 ms: the full response takes that out, the sensitivity does not."""
    t = DT * np.arange(6000)
    ground = np.exp(-(((t - 30.0) / 5.0) ** 2)) * np.sin(2 * np.pi * 4.0 * t)
    frequency = np.fft.rfftfreq(t.size, DT)
    through = np.fft.irfft(np.fft.rfft(ground) * 600.0 / (600.0 + 2j * np.pi * frequency), t.size)
    path = tmp_path / "XX.TST.00.HNN.mseed"
    trace("HNN", data=np.rint(COUNTS_PER_UNIT * through).astype(np.int32)).write(str(path), "MSEED")
    inventory(channel("HNN", stages=True)).write(str(tmp_path / "a.xml"), "STATIONXML")
    quick, full = (read(path, response=how).component("NS").acceleration for how in ("sensitivity", "full"))
    assert np.abs(quick - ground).max() > 0.03
    assert np.abs(full - ground).max() < 0.002
    assert any("between 0.167 and 40 Hz" in entry for entry in read(path, response="full").history)
    with pytest.raises(ParameterError, match="unknown `response`"):
        read(path, response="all")
    write_station(tmp_path)
    with pytest.raises(UnitError, match="only a sensitivity"):
        read(tmp_path / "XX.TST.00.HNE.mseed", response="full")


def test_sac_header_contradictions_are_flagged(tmp_path):
    """The end time against DELTA, on both sides of a tenth of an interval; the quantity against the channel code."""
    path = tmp_path / "a.sac"
    for excess, is_flagged in ((0.05, False), (0.2, True)):
        source = obspy.io.sac.SACTrace.from_obspy_trace(trace("HNN", data=counts("N").astype(np.float32)))
        source.write(str(path))
        data = bytearray(path.read_bytes())
        # word 6: E
        data[24:28] = np.float32((3000 - 1 + excess) * DT).tobytes()
        path.write_bytes(data)
        assert any("contradicts B, DELTA and NPTS" in flag.message for flag in read(path, units="mg").doubts) == is_flagged
    for quantity, error in (("ivel", "velocity channel"), ("idisp", "displacements")):
        source = obspy.io.sac.SACTrace.from_obspy_trace(trace("HNN", data=counts("N").astype(np.float32)))
        source.idep = quantity
        source.write(str(path))
        with pytest.raises(UnitError, match=error):
            read(path, units="mg")


def test_round_trip_through_obspy_is_exact():
    """Samples, codes, azimuths, interval, start and names, of a record from a file and of one in memory."""
    recording = Record.from_arrays({"37": np.arange(50.0), "127": np.arange(50.0) ** 2, "UD": -np.arange(50.0)}, 0.005, station="A")
    for record in (read("synthetic_jma.csv"), read("hanmer_springs_2016"), recording):
        copy = Record.from_obspy(record.to_obspy())
        assert (copy.codes, copy.dt, copy.start, copy.station, copy.network) == (
            record.codes,
            record.dt,
            record.start,
            record.station,
            record.network,
        )
        assert [c.azimuth_deg for c in copy.components] == [c.azimuth_deg for c in record.components]
        for first, second in zip(copy.components, record.components, strict=True):
            np.testing.assert_array_equal(first.acceleration, second.acceleration)
        assert copy.history == record.history


@pytest.mark.parametrize("is_applied", [False, True])
def test_from_obspy_reads_knet_of_obspy(is_applied):
    """ObsPy gives counts as floating-point numbers and a factor, which stays after it is applied; offset as from the file."""
    stream = obspy.read(str(sample_path("synthetic_knet.NS")), format="KNET", apply_calib=is_applied)
    record, reference = Record.from_obspy(stream), read("synthetic_knet.NS")
    np.testing.assert_allclose(record.component("NS").acceleration, reference.component("NS").acceleration, rtol=1e-12)
    assert record.carries_offset and not record.doubts
    assert any("calibration factor" in line for line in record.history) != is_applied


def test_from_obspy_refuses_filtered_counts(tmp_path):
    """Filters of ObsPy make floating-point numbers of the integers of a file; they are no accelerations."""
    obspy.Stream([trace("HNN")]).write(str(tmp_path / "a.mseed"), "MSEED")
    stream = obspy.read(str(tmp_path / "a.mseed"))
    copy = stream.copy()
    copy[0].data = copy[0].data.astype(float)
    with pytest.raises(UnitError, match="contains counts"):
        Record.from_obspy(copy)
    stream.detrend("demean").filter("highpass", freq=0.1)
    with pytest.raises(UnitError, match="not whole numbers, so the response may have been removed: give `units` if so, or the StationXML"):
        Record.from_obspy(stream)
    Record.from_obspy(stream, units="gal")
    Record.from_obspy(stream, inventory(channel("HNN")))


@pytest.mark.parametrize("event", [5, ["a"], [None]], ids=str)
def test_from_obspy_rejects_what_is_no_event(event):
    """In one sentence."""
    with pytest.raises(KindError, match="expected a QuakeML file or an ObsPy Event"):
        Record.from_obspy(obspy.Stream([trace("HNN")]), event=event, inventory=inventory(channel("HNN")))


def test_from_obspy_aligns_channels_by_time():
    """Channels of a data centre start at their own first samples, as in files."""
    stream = obspy.Stream([trace(f"HN{c}") for c in "NEZ"])
    stream[1].stats.starttime += 0.5 + 0.3 * DT
    record = Record.from_obspy(stream, units="gal")
    skip = round(0.5 / DT)
    assert record.samples == stream[0].stats.npts - skip
    np.testing.assert_array_equal(record.component("NS").acceleration, stream[0].data[skip:] / 100.0)
    assert [str(line) for line in record.history[:2]] == [
        f"components cut to their common window, {record.samples} samples",
        f"start times of components differ by up to {300 * DT:g} ms after alignment",
    ]


def test_from_obspy_requires_a_response_for_counts():
    """Integers are counts; an inventory, an attached response or ObsPy's own removal gives their unit; the stream stays as it was."""
    stream = obspy.Stream([trace(f"HN{c}") for c in "NEZ"])
    with pytest.raises(UnitError, match="contains counts"):
        Record.from_obspy(stream)
    station = inventory(*(channel(f"HN{c}", stages=True) for c in "NEZ"))
    reference = counts("E") / COUNTS_PER_UNIT
    by_inventory = Record.from_obspy(stream, station)
    np.testing.assert_allclose(by_inventory.component("EW").acceleration, reference, rtol=1e-14)
    np.testing.assert_allclose(read(stream, inventory=station).component("EW").acceleration, reference, rtol=1e-14)
    np.testing.assert_array_equal(stream[1].data, counts("E"))
    attached = stream.copy()
    attached.attach_response(station)
    np.testing.assert_allclose(Record.from_obspy(attached).component("EW").acceleration, reference, rtol=1e-14)
    attached.remove_sensitivity()
    np.testing.assert_allclose(Record.from_obspy(attached).component("EW").acceleration, reference, rtol=1e-14)
    np.testing.assert_allclose(read(attached[1]).component("EW").acceleration, reference, rtol=1e-14)
    # the offset of the instrument is treated as after a response from a file
    for item in attached:
        item.data = item.data + 0.5
    assert Record.from_obspy(attached).carries_offset and not Record.from_obspy(attached).doubts


def test_from_obspy_reads_the_processing_of_obspy():
    """Output of remove_response: acceleration is accepted, velocity needs consent, displacement is rejected."""
    seismometer = inventory(channel("HHN", units="M/S", stages=True))
    stream = obspy.Stream([trace("HHN")])
    acceleration = stream.copy().remove_response(seismometer, output="ACC")
    np.testing.assert_array_equal(Record.from_obspy(acceleration).component("NS").acceleration, acceleration[0].data)
    velocity = stream.copy().remove_response(seismometer, output="VEL")
    with pytest.raises(UnitError, match="velocity channel"):
        Record.from_obspy(velocity)
    derived = Record.from_obspy(velocity, differentiate=True)
    np.testing.assert_allclose(derived.component("NS").acceleration, np.gradient(velocity[0].data, DT), rtol=1e-12)
    with pytest.raises(UnitError, match="displacements"):
        Record.from_obspy(stream.copy().remove_response(seismometer, output="DISP"))


def test_from_obspy_rejects_other_objects_and_gaps():
    """Another type, an empty stream, a gap."""
    with pytest.raises(KindError, match="expected an ObsPy Stream or Trace, found"):
        Record.from_obspy([1.0, 2.0])
    with pytest.raises(KindError, match="empty"):
        Record.from_obspy(obspy.Stream())
    full = trace("HNN", data=counts("N") * 1.0)
    with pytest.raises(RecordFormatError, match="gaps"):
        Record.from_obspy(obspy.Stream([full.slice(endtime=START + 5), full.slice(START + 6)]))


@pytest.mark.parametrize(("step", "change", "is_read"), [(-10, 0, True), (-10, 50, False), (0, 0, True), (10, 0, False)])
def test_pieces_of_a_channel_are_joined_without_gaps_and_contradictions(step, change, is_read, tmp_path):
    """Overlaps of equal samples are joined; gaps, and overlaps of different ones, are rejected."""
    whole = trace("HNN")
    first, second = whole.copy(), whole.copy()
    first.data, second.data = whole.data[:1500], whole.data[1500 + step :].copy()
    second.stats.starttime = START + (1500 + step) * whole.stats.delta
    second.data[:10] += change
    inventory(channel("HNN")).write(str(tmp_path / "s.xml"), "STATIONXML")
    path = tmp_path / "x.mseed"
    obspy.Stream([second, first]).write(str(path), "MSEED")
    if is_read:
        np.testing.assert_allclose(read(path).components[0].acceleration, counts("N") / COUNTS_PER_UNIT, rtol=1e-14)
    else:
        with pytest.raises(RecordFormatError, match="has gaps, or overlaps with different samples"):
            read(path)


def test_damaged_miniseed_has_few_flags_and_names_the_file(tmp_path):
    """A lost sector gives one flag for each kind of warning; errors name the file, not its temporary copy."""
    path = tmp_path / "x.mseed"
    inventory(channel("HNN")).write(str(tmp_path / "s.xml"), "STATIONXML")
    trace("HNN").write(str(path), "MSEED", reclen=4096)
    data = path.read_bytes()
    path.write_bytes(data[:1024] + data[1536:])
    assert 1 <= len(read(path).doubts) <= 5
    path.write_bytes(data[:700])
    with pytest.raises(RecordFormatError) as error:
        read(path)
    assert str(error.value).count("x.mseed") >= 1 and "seisblock-" not in str(error.value)


def _quakeml(path, *origins):
    from obspy.core.event import Catalog, Event, Magnitude, Origin

    events = [
        Event(origins=[Origin(time=time, latitude=35.9, longitude=139.0, depth=12000.0)], magnitudes=[Magnitude(mag=6.2)])
        for time in origins
    ]
    Catalog(events).write(str(path), "QUAKEML")
    return Catalog(events)


def test_event_gives_magnitude_origin_and_distance(tmp_path):
    """QuakeML, an ObsPy Event, flat JSON and the feature of the USGS; one of two events by its time."""
    path, *_ = write_station(tmp_path)
    catalog = _quakeml(tmp_path / "event.qml", START - 8)
    flat = {"time": str(START - 8), "latitude": 35.9, "longitude": 139.0, "depth_km": 12.0, "magnitude": 6.2}
    (tmp_path / "event.json").write_text(json.dumps(flat))
    feature = {"properties": {"mag": 6.2, "time": 1000 * (START - 8).timestamp}, "geometry": {"coordinates": [139.0, 35.9, 12.0]}}
    (tmp_path / "usgs.json").write_text(json.dumps(feature))
    for event in (tmp_path / "event.qml", catalog[0], catalog, tmp_path / "event.json", str(tmp_path / "usgs.json")):
        metadata = read(path, event=event).metadata
        assert (metadata["magnitude"], metadata["event_depth_km"], metadata["event_latitude_deg"]) == (6.2, 12.0, 35.9)
        assert metadata["origin_time"] == datetime(2024, 1, 1, 7, 10, 2, tzinfo=UTC)
    _quakeml(tmp_path / "two.qml", START - 8, START - 7200)
    assert read(path, event=tmp_path / "two.qml").metadata["origin_time"].minute == 10
    _quakeml(tmp_path / "two.qml", START - 8, START - 60)
    with pytest.raises(RecordError, match="2 of 2 events match"):
        read(path, event=tmp_path / "two.qml")


def test_event_of_another_day_is_flagged(tmp_path):
    """A single event is taken, and its contradiction with the start of the record reported."""
    path, *_ = write_station(tmp_path)
    assert any("origin time" in flag.message for flag in read(path, event=_quakeml(tmp_path / "e.qml", START - 86400)).doubts)


@pytest.mark.parametrize("text", ["", "{}", "{", '{"time": "x", "latitude": 1, "longitude": 2}', "<a/>", '{"properties": 3}', "[1]"])
def test_event_file_without_event_is_rejected(text, tmp_path):
    """One sentence, whatever is wrong with it."""
    path = tmp_path / "event.json"
    path.write_text(text)
    with pytest.raises(RecordError):
        read("synthetic_jma.csv", event=path)


def test_miniseed_from_a_pipe_needs_an_inventory(tmp_path, monkeypatch):
    """The standard input has no folder."""
    path, *_ = write_station(tmp_path)

    class Pipe:
        def __init__(self):
            self.buffer = io.BytesIO(path.read_bytes())

    monkeypatch.setattr("sys.stdin", Pipe())
    with pytest.raises(UnitError, match="response is missing"):
        read("-")
    monkeypatch.setattr("sys.stdin", Pipe())
    assert read("-", inventory=tmp_path / "XX.TST.xml").codes == ("NS",)


@pytest.mark.parametrize(
    ("metadata", "name"),
    [
        ({"network": "CI", "channels": {"NS": "HNN", "EW": "HNE"}}, "CI.MIKB..HN?"),
        ({"network": "CI", "location": "00", "channels": {"NS": "HNN"}}, "CI.MIKB.00.HNN"),
        ({"network": "CI", "channels": {"NS": "HNN", "EW": "BNE"}}, "CI.MIKB..HNN,BNE"),
        ({"network": "CI"}, ""),
        ({"channels": {"NS": "HNN"}}, ""),
    ],
)
def test_seed_id_names_network_station_location_and_channels(metadata, name):
    """Empty where the file states no network or no channel."""
    codes = list(metadata.get("channels", {"NS": ""}))
    record = Record([Component(code, np.arange(3.0)) for code in codes], DT, station="MIKB", metadata=metadata)
    assert record.seed_id == name
    assert get_site(record).label == (name or "MIKB")


@pytest.mark.parametrize("name", ["BI008_MEMA-04823.evt", "BX456_MOLA-02351.evt", "STNA.20020722.044649.evt.gz"])
def test_counts_of_kinemetrics_recorders_are_accelerations_by_their_header(name):
    """The file was refused without `units`, and its stream was taken in m/s^2, count for count: 41 420 m/s^2."""
    path = Path(obspy.__file__).parent / "io" / "kinemetrics" / "tests" / "data" / name
    if not path.exists():
        pytest.skip("ObsPy without its test data")
    stream = obspy.read(path)
    expected = [trace.data * trace.stats.calib for trace in obspy.read(path)]
    calibrated, filtered = obspy.read(path, apply_calib=True), obspy.read(path).detrend("demean")
    for record in (read(path), Record.from_obspy(stream), Record.from_obspy(calibrated)):
        for component, values in zip(record.components, expected, strict=True):
            np.testing.assert_allclose(component.acceleration, values, rtol=1e-12)
    assert (record.start, record.dt) == (stream[0].stats.starttime.datetime.replace(tzinfo=UTC), stream[0].stats.delta)
    assert read(path).carries_offset and "calibration factor 1.1" in read(path).history[0]
    peaks = [np.abs(values - values.mean()).max() for values in expected]
    assert [np.abs(c.acceleration).max() for c in Record.from_obspy(filtered).components] == pytest.approx(peaks)


def test_seismometer_on_a_kinemetrics_recorder_is_no_accelerometer():
    """Its calibration factor gives no acceleration: a unit is required, as for other counts."""
    stream = obspy.Stream([obspy.Trace(np.arange(100.0), header={"station": "ABC", "channel": "0", "calib": 1e-6})])
    stream[0].stats.kinemetrics_evt = obspy.core.AttribDict(chan_sensortype=38, maxpeak=99, minpeak=0)
    with pytest.raises(UnitError):
        Record.from_obspy(stream)
