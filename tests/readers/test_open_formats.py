"""CSMIP, COSMOS, SMC, ESM, GeoNet, CWA: peaks of the headers, siblings, azimuths, places; rejection of other contents."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest

from seisblock.core.errors import ComponentError, RecordError, RecordFormatError, UnitError
from seisblock.readers import read, read_all
from seisblock.readers.discover import iter_records
from seisblock.readers.options import ReadOptions
from seisblock.records import motion_of
from seisblock.records.site import format_local_time, get_earthquake, get_site
from seisblock.samples import list_samples
from tests.fuzz.formats import ROWS, WRITERS
from tests.readers import layouts

OPEN = ("csmip-v1", "csmip-v2", "cosmos", "smc", "esm", "geonet-v1", "geonet-v2", "cwa")
DIGIT = {
    "csmip-v1": 1e-5,
    "csmip-v2": 5.1e-6,
    "cosmos": 1e-6,
    "smc": 6e-5,
    "esm": 1e-6,
    "geonet-v1": 5.1e-5,
    "geonet-v2": 5.1e-5,
    "cwa": 5.1e-6,
}
"""Half a unit of the last digit that each format prints of these samples, m/s^2."""


def write_text_file(tmp_path, text, name="record"):
    """Return a file that holds a text."""
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("kind", OPEN)
def test_samples_reproduce_header_peak(kind, tmp_path):
    """Every sample to its last digit, the vertical up, no doubt; another peak in the header is one."""
    path = tmp_path / "record"
    path.write_bytes(WRITERS[kind](ROWS))
    record = read(path)
    assert record.doubts == ()
    holding = list(record.components)
    rows = ROWS if len(holding) == 3 else ROWS[:1]
    if kind.startswith("csmip"):
        rows = [ROWS[1], ROWS[0], ROWS[2]]  # 90 degrees come first in the file
    for component, row in zip(holding, rows, strict=True):
        np.testing.assert_allclose(component.acceleration, row / 100.0, atol=DIGIT[kind], rtol=0)
    assert (record.dt, record.samples) == (0.01, 600)
    assert record.start in (datetime(2020, 1, 2, 3, 4, 5, 250_000, tzinfo=UTC), datetime(2020, 1, 2, 3, 4, 5, 200_000, tzinfo=UTC))


@pytest.mark.parametrize(
    ("kind", "peak"),
    [
        ("csmip-v1", b".102"),
        ("csmip-v2", b"100.011"),
        ("cosmos", b"100.011"),
        ("smc", b"1.0001000E+02"),
        ("esm", b"100.011000"),
        ("geonet-v1", b"1000.1 mm/s/s"),
        ("cwa", b"100.011~"),
    ],
)
def test_wrong_header_peak_is_flagged(kind, peak, tmp_path):
    """A changed digit of the header's peak is flagged with the peak of the samples."""
    path = tmp_path / "record"
    data = WRITERS[kind](ROWS)
    assert peak in data, kind
    path.write_bytes(data.replace(peak, peak.replace(b"1", b"2", 1), 1))
    assert [doubt.kind for doubt in read(path).doubts] == ["header"]


@pytest.mark.parametrize("kind", OPEN)
def test_station_and_earthquake_are_read(kind, tmp_path):
    """Code, name in its own script, coordinates, epicentre, magnitude, origin, and the clock of California."""
    path = tmp_path / "record"
    path.write_bytes(WRITERS[kind](ROWS))
    record = read(path)
    site, earthquake = get_site(record), get_earthquake(record)
    assert site.name == {"esm": "Δοκιμή", "smc": "Synthetic, 1 Test Street", "cosmos": "Test Town - City Hall"}.get(
        kind, "TEST TOWN - CITY HALL" if kind.startswith("csmip") else "Test Town Hall"
    )
    assert None not in (site.latitude_deg, site.longitude_deg, earthquake.latitude_deg, earthquake.longitude_deg)
    assert earthquake.magnitude in (6.1, 4.8, 4.6)
    assert earthquake.depth_km in (9.0, 10.0, 12.0, 15.0)
    assert earthquake.origin_time in (datetime(2020, 1, 2, 3, 4, tzinfo=UTC), datetime(2020, 1, 2, 3, 4, 0, 500_000, tzinfo=UTC))
    if kind.startswith("csmip"):
        assert format_local_time(record, record.start) == "2020-01-01 19:04:05 PST"
        assert (site.latitude_deg, site.longitude_deg) == (35.908, -120.458)
    if kind.startswith("geonet"):
        assert (site.latitude_deg, site.longitude_deg) == (-42.52, 172.83)


def test_azimuths_are_kept(tmp_path):
    """N10E and N80W are the azimuths 10 and 280; along north they act as their projections."""
    record = read(write_text_file(tmp_path, layouts.geonet(ROWS)))
    assert [(c.code, c.azimuth_deg) for c in record.components] == [("10", 10.0), ("280", 280.0), ("UD", None)]
    first, second = (component.acceleration for component in record.horizontals)
    north = np.cos(np.radians(10)) * first + np.cos(np.radians(280)) * second
    np.testing.assert_allclose(motion_of(record, "0").horizontal, north, atol=1e-12)


def test_down_component_is_inverted(tmp_path):
    """Samples that are positive down are reversed, with a history entry."""
    for text in (
        layouts.smc(ROWS[0], vertical=180),
        layouts.cosmos(ROWS[0], azimuth=401),
        layouts.csmip(ROWS, names=("0 Deg", "90 Deg", "Down")),
    ):
        record = read(write_text_file(tmp_path, text))
        row = ROWS[2] if len(record.components) == 3 else ROWS[0]
        np.testing.assert_allclose(record.component("UD").acceleration, -row / 100.0, atol=6e-5)
        assert any("positive down" in line for line in record.history)


def test_volume_2_gives_accelerations_only(tmp_path):
    """Velocities and displacements of other lengths lie between the channels and are passed over; V1 in g and V2 in cm/s^2 agree."""
    first, two = (read(write_text_file(tmp_path, layouts.csmip(ROWS, volume=volume), f"v{volume}")) for volume in (1, 2))
    for code in ("NS", "EW", "UD"):
        np.testing.assert_allclose(first.component(code).acceleration, two.component(code).acceleration, atol=2e-5)


def test_single_channel_file_finds_other_components(tmp_path):
    """One letter of the name denotes the component; files of another station or time are not joined."""
    for letter, row in zip("NEZ", ROWS, strict=True):
        write_text_file(tmp_path, layouts.esm(row, stream=f"HN{letter}"), f"SY.SYN1..HN{letter}.D.20200102.030400.C.ACC.ASC")
    second = layouts.esm(ROWS[0], stream="HN1").replace("STATION_CODE: SYN1", "STATION_CODE: SYN2")
    write_text_file(tmp_path, second, "SY.SYN1..HN1.D.20200102.030400.C.ACC.ASC")
    record = read(tmp_path / "SY.SYN1..HNE.D.20200102.030400.C.ACC.ASC")
    assert record.codes == ("NS", "EW", "UD")
    for letter, azimuth, vertical, row in (("a", 360, 90, ROWS[0]), ("b", 0, 0, ROWS[2][:-1]), ("c", 270, 90, ROWS[1])):
        write_text_file(tmp_path, layouts.smc(row, azimuth=azimuth, vertical=vertical), f"0111{letter}.smc")
    record = read(tmp_path / "0111c.smc")
    assert (record.codes, record.samples) == (("NS", "270", "UD"), 599)
    assert "shortest" in record.history[0]
    for seed, azimuth, row in (("HNN", 360, ROWS[0]), ("HNE", 90, ROWS[1]), ("HNZ", 400, ROWS[2])):
        write_text_file(tmp_path, layouts.cosmos(row, azimuth=azimuth), f"SYN1--n.1.{seed}.--.acc.V2c")
    assert read(tmp_path / "SYN1--n.1.HNZ.--.acc.V2c").codes == ("NS", "EW", "UD")
    assert [len(recording.files) for recording in iter_records([str(tmp_path)], ReadOptions())] == [3, 4, 3]
    assert len(read_all(sorted(tmp_path.glob("*.smc")))) == 1


@pytest.mark.parametrize("make", [layouts.csmip, None], ids=["CSMIP", "COSMOS"])
def test_structure_locations_are_selected_as_stations(make, tmp_path):
    """Channels of a building are no record together: each place is one, and the refusal lists them."""
    rows = [ROWS[0], ROWS[1], ROWS[2], 2.0 * ROWS[0], 2.0 * ROWS[1]]
    places = ("Location: Free field", "Location: Free field", "Location: Free field", "Location: Roof, west", "Location: Roof, west")
    names = ("360 Deg", "90 Deg", "Up", "360 Deg", "90 Deg")
    if make is None:
        azimuths = (360, 90, 400, 360, 90)
        directions = zip(rows, azimuths, places, strict=True)
        text = "".join(layouts.cosmos(row, azimuth=azimuth, structure=10, place=place[10:]) for row, azimuth, place in directions)
    else:
        text = make(rows, names=names, places=places)
    path = write_text_file(tmp_path, text)
    with pytest.raises(ComponentError, match=r"2 stations; select one with `station`: .*Free field, .*Roof, west"):
        read(path)
    code = "SYN1" if make is None else "00001"
    ground, roof = read(path, station=f"{code} free field"), read(path, station=f"{code} Roof, west")
    assert (ground.codes, roof.codes) == (("NS", "EW", "UD"), ("NS", "EW"))
    np.testing.assert_allclose(roof.component("NS").acceleration, 2.0 * ground.component("NS").acceleration, atol=1e-4)
    assert get_site(roof).name.endswith("Roof, west")
    assert [record.station for record in read_all([path], station="all")] == [f"{code} Free field", f"{code} Roof, west"]


def test_structure_channels_without_location_use_numbers(tmp_path):
    """Two channels in one direction at no place are two stations."""
    path = write_text_file(tmp_path, layouts.csmip([ROWS[0], ROWS[1]], names=("90 Deg", "90 Deg")))
    with pytest.raises(ComponentError, match="00001 channel 1, 00001 channel 2"):
        read(path)
    assert read(path, station="00001 channel 2").codes == ("EW",)


V1_HEAD = layouts.csmip(ROWS, volume=1).split(" POINTS OF ACCEL")[0].rsplit("\n", 1)[0] + "\n"
UNEVEN = V1_HEAD + "".join(f"{0.01 * i:7.3f}{x:7.3f}" * 1 + ("\n" if i % 5 == 4 else "") for i, x in enumerate(np.zeros(50)))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (UNEVEN, "expected samples in g/10"),
        ("FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\nEARTHQUAKE\n", "expected samples in g/10"),
        ("RESPONSE AND FOURIER AMPLITUDE SPECTRA\nCORRECTED ACCELEROGRAM\n", "response spectra .volume 3.: use volume 2"),
        (layouts.cosmos(ROWS[0], title="Raw acceleration counts", level=0, unit=50), "raw counts .volume 0.: use volume 1 or 2"),
        (layouts.cosmos(ROWS[0], title="Velocity data"), "velocity: use the acceleration file"),
        (layouts.cosmos(ROWS[0], unit=3), "unevenly sampled pairs of time and acceleration: use volume 2"),
        (layouts.smc(ROWS[0], title="3 VELOCITY"), "velocity: use the corrected accelerogram"),
        (layouts.smc(ROWS[0], title="*"), "raw counts.: use the corrected accelerogram"),
        (layouts.esm(ROWS[0], data="VELOCITY"), "header states VELOCITY: use the acceleration file"),
    ],
)  # fmt: skip
def test_files_without_even_accelerations_are_rejected(text, says, tmp_path):
    """One sentence names the content of the file and the file to use instead."""
    with pytest.raises(RecordFormatError, match=says):
        read(write_text_file(tmp_path, text))


def test_non_acceleration_units_are_rejected(tmp_path):
    """Volts in COSMOS, and samples of CSMIP in an unknown unit, are rejected."""
    with pytest.raises(UnitError, match="unknown acceleration unit"):
        read(write_text_file(tmp_path, layouts.cosmos(ROWS[0], unit=51)))
    with pytest.raises(UnitError, match="'volts'"):
        read(write_text_file(tmp_path, layouts.csmip(ROWS, volume=1).replace("UNITS: G)", "UNITS: volts)")))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (layouts.geonet(ROWS).replace("Component N80W", "Component    "), "line 99: expected a component such as N10E or Up"),
        (layouts.geonet(ROWS).replace("  0.0050  0.0100", "  0.0050  0.0000"), "line 23: expected a sampling interval above 0 s, found 0"),
        (layouts.geonet(ROWS).replace("units of 1.00", "units of 0.00"), "line 11: expected samples in units of mm/s/s, found 'Raw"),
        (layouts.smc(ROWS[0]).replace("|synthetic", "synthetic"), "line 28: expected one of 1 comment lines"),
        (layouts.esm(ROWS[0]).replace("NDATA: 600", "NDATA: many"), "expected the number of samples, found 'many'"),
        (layouts.cosmos(ROWS[0]).replace("(8F10.5)", "(8F11.5)"), "expected 8 numbers of 11 characters each"),
        (layouts.csmip(ROWS).replace("CHAN  2: 360", "CHAM  2: 360"), "expected a station or a channel"),
    ],
)  # fmt: skip
def test_invalid_headers_are_rejected_with_line(text, says, tmp_path):
    """The line, what was expected, what was found."""
    with pytest.raises(RecordError, match=says):
        read(write_text_file(tmp_path, text))


def test_adjacent_fixed_width_numbers_are_separated(tmp_path):
    """Samples of SMC stand without a blank between them; a lost character is found by the length of its line."""
    text = layouts.smc(ROWS[0])
    line = next(line for line in text.splitlines()[28:] if "-" in line[9:71].replace("E-", ""))
    path = write_text_file(tmp_path, text)
    assert read(path).samples == 600
    with pytest.raises(RecordFormatError, match="expected 8 numbers of 10 characters each"):
        read(write_text_file(tmp_path, text.replace(line, line[:30] + line[31:])))


@pytest.mark.parametrize(("name", "start"), [("hanmer_springs_2016", "2016-11-13T11:02:20"), ("shafter_1989", "1989-10-18T00:04:00")])
def test_bundled_recordings_reproduce_header_peak(name, start):
    """Hanmer Springs of GeoNet and Shafter of the USGS: no flag, and the peaks of the manifest."""
    record = read(name)
    text = next(sample.pga_gal for sample in list_samples() if sample.name.startswith(name))
    assert {code: 100.0 * float(np.abs(record.component(code).acceleration).max()) for code in record.codes} == pytest.approx(
        text, abs=5e-4
    )
    assert not any(doubt.kind == "header" for doubt in record.doubts)
    assert record.start.isoformat().startswith(start)
    assert len(record.horizontals) == 2 and record.vertical is not None


def test_read_cosmos_takes_an_integer_header_one_blank_short(tmp_path):
    """Integers are split without columns; a line with one number too few is rejected."""
    full = layouts.cosmos(ROWS[0])
    lines = full.splitlines()
    line = lines[next(index for index, line in enumerate(lines) if "Integer-header" in line) + 5]
    path = tmp_path / "a.V2c"
    path.write_text(full.replace(line, line.replace("    -999", "   -999", 1), 1))
    np.testing.assert_array_equal(read(path).components[0].acceleration, _read_text(tmp_path, full).components[0].acceleration)
    path.write_text(full.replace(line, line.rsplit(None, 1)[0], 1))
    with pytest.raises(RecordFormatError, match="expected 10 numbers of 8 characters"):
        read(path)


def _read_text(folder, text):
    (folder / "whole.V2c").write_text(text)
    return read(folder / "whole.V2c")


def test_uncorrected_smc_of_a_digital_recorder_is_read(tmp_path):
    """It states its rate: samples are even, as in a corrected file; they were refused as uneven."""
    path = tmp_path / "record.smc"
    path.write_text(layouts.smc(ROWS[0], title="1 UNCORRECTED ACCELEROGRAM"))
    record = read(path)
    np.testing.assert_allclose(100.0 * record.component("NS").acceleration, ROWS[0], rtol=6e-5)
    assert (record.dt, record.metadata["volume"], record.doubts) == (layouts.DT, "V1", ())
    path.write_text(layouts.smc(ROWS[0]))
    assert read(path).metadata["volume"] == "V2"


def test_uncorrected_smc_of_a_film_is_refused(tmp_path):
    """It has no rate, and pairs of time and acceleration."""
    path = tmp_path / "record.smc"
    text = layouts.smc(ROWS[0], title="1 UNCORRECTED ACCELEROGRAM")
    path.write_text(text.replace(f"{1.0 / layouts.DT:15.7E}", f"{1.7e38:15.7E}", 1))
    with pytest.raises(RecordFormatError, match="unevenly sampled accelerogram: use the corrected file"):
        read(path)
