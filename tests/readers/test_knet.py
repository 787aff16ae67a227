"""K-NET and KiK-net: the header's own maximum is the oracle; counts, offset, delay, sensors and siblings."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import obspy
import pytest

from seisblock.core.errors import ComponentError, RecordError, RecordFormatError, UnitError
from seisblock.readers import read, read_all
from seisblock.samples import sample_path
from tests.readers.files import KIK_CSV, KNET_CSV, kik_net, knet

OBSPY_FILE = Path(obspy.__file__).parent / "io" / "nied" / "tests" / "data" / "test.knet"


def deviation_gal(component):
    return 100.0 * np.abs(component.acceleration - component.acceleration.mean()).max()


@pytest.mark.parametrize("source", [OBSPY_FILE, "synthetic_knet.NS", "synthetic_knet.EW", "synthetic_knet.knt.tar.gz"])
def test_knet_samples_reproduce_header_maximum(source):
    """max|a - mean| is the header's Max. Acc. to 0.001 gal: scale factor applied, all samples there."""
    record = read(source)
    text = record.metadata["header_max_gal"]
    assert set(text) == set(record.codes)
    for component in record.components:
        assert deviation_gal(component) == pytest.approx(text[component.code], abs=0.001)
    assert "warnings" not in record.metadata


def test_knet_start_time_and_offset_of_obspy_file():
    """The first sample is 15 s before the record time, JST - 9 h; the offset of the counts is kept and flagged."""
    record = read(OBSPY_FILE)
    assert record.start == datetime(1996, 8, 10, 18, 12, 24, tzinfo=UTC)
    assert (record.station, record.codes, record.dt, record.samples) == ("AKT013", ("EW",), 0.01, 5900)
    assert record.metadata["carries_offset"] is True
    assert record.metadata["offset_gal"]["EW"] == pytest.approx(-4.293, abs=1e-3)
    # the first count in the file is -18205
    assert record.components[0].acceleration[0] == -18205 * 2000 / (8388608 * 100)
    trace = obspy.read(str(OBSPY_FILE))[0]
    np.testing.assert_allclose(record.components[0].acceleration, trace.data * trace.stats.calib, rtol=1e-15)


def test_knet_component_file_gives_all_components(tmp_path):
    """Any of the three files gives all three, in the order NS, EW, UD, with one digest."""
    for code, direction in (("NS", "N-S"), ("EW", "E-W"), ("UD", "U-D")):
        (tmp_path / f"NIG0190410231756.{code}").write_text(knet(direction=direction))
    records = [read(tmp_path / f"NIG0190410231756.{code}") for code in ("NS", "EW", "UD")]
    assert {r.codes for r in records} == {("NS", "EW", "UD")}
    assert len({r.sha256 for r in records}) == 1
    assert records[1].source == str(tmp_path / "NIG0190410231756.EW")
    in_any_order = read_all([tmp_path / f"NIG0190410231756.{code}" for code in ("UD", "NS", "EW")])
    assert [r.codes for r in in_any_order] == [("NS", "EW", "UD")]


def test_knet_sample_equals_jma_sample_plus_offset():
    """Both layouts hold the same motion: equal to half a count and half a JMA digit, but for the offset."""
    knet_record, jma = read("synthetic_knet"), read("synthetic_jma")
    for component in knet_record.components:
        offset = component.acceleration - jma.component(component.code).acceleration
        assert abs(offset.mean()) > 0.05
        assert np.ptp(offset) < 2e-5
    assert knet_record.start == jma.start


def test_kik_net_default_is_surface_sensor(tmp_path):
    """A .tar of six files gives the surface, --level borehole the borehole; a file of one sensor stands for that sensor."""
    from tests.readers.files import tar

    stem = kik_net(tmp_path)
    bundle = tmp_path / "20001006.kik.tar.gz"
    bundle.write_bytes(tar({p.name: p.read_bytes() for p in sorted(tmp_path.glob("NGNH31*"))}, mode="w:gz"))
    surface, borehole = read(bundle), read(bundle, level="borehole")
    assert surface.format == "KIKNET"
    assert surface.codes == borehole.codes == ("NS", "EW", "UD")
    assert "surface" in surface.history[0]
    assert "borehole" in borehole.history[0]
    assert surface.component("NS").acceleration[0] == 400 * 3920 / (6182761 * 100)
    assert borehole.component("UD").acceleration[0] == 300 * 3920 / (6182761 * 100)
    assert read(f"{stem}.EW2").component("NS").acceleration[0] == surface.component("NS").acceleration[0]
    assert read(f"{stem}.EW1").component("NS").acceleration[0] == borehole.component("NS").acceleration[0]
    assert read(f"{stem}.EW2", level="borehole").component("NS").acceleration[0] == borehole.component("NS").acceleration[0]
    with pytest.raises(ComponentError, match="borehole"):
        read("synthetic_knet", level="borehole")
    with pytest.raises(ComponentError, match="roof"):
        read(bundle, level="roof")


def test_knet_header_variants_are_accepted(tmp_path):
    """``Station Lon.`` and ``Max Acc. (gal)`` are read as well, an empty correction raises no IndexError."""
    text = knet().replace("Station Long.     ", "Station Lon.      ").replace("Max. Acc. (gal)   ", "Max Acc. (gal)    ")
    text = text.replace("Last Correction   2004/10/23 17:56:00", "Last Correction   ").replace("Mag.".ljust(18) + "6.8", "Mag.")
    path = tmp_path / "a.NS"
    path.write_text(text)
    record = read(path)
    assert record.samples == 200
    assert record.metadata["station_longitude_deg"] == 138.79
    assert "magnitude" not in record.metadata


def test_wrong_knet_header_maximum_is_flagged(tmp_path):
    """A record whose peak differs from the header is read and flagged."""
    path = tmp_path / "a.NS"
    path.write_text(knet(maximum="99.9"))
    flags = read(path).doubts
    assert [doubt.kind for doubt in flags if doubt.kind != "offset"] == ["header"]
    assert "99.9" in flags[0].message


@pytest.mark.parametrize(
    ("text", "kind", "says"),
    [
        (knet([1000 + i % 37 for i in range(210)], duration="2"), "count", "header states 200 samples, file contains 210"),
        (knet(duration="2x"), "header", "Duration Time '2x' is not a number"),
        (knet(maximum="-.-"), "header", "Max. Acc. '-.-' is not a number"),
    ],
)
def test_unverifiable_knet_header_is_flagged(tmp_path, text, kind, says):
    """Too many samples, and a duration or a maximum that cannot be read, do not pass in silence."""
    path = tmp_path / "a.NS"
    path.write_text(text)
    assert any(doubt.kind == kind and says in doubt.message for doubt in read(path).doubts)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (knet().partition("Sampling")[0], "line 11: expected 'Sampling Freq(Hz)', found the end of the file: K-NET header (17 lines)"),
        (knet([]), "no samples"),
        (knet(duration="60"), "states 6000 samples (60 s at 100 Hz), file contains 200"),
        (knet().replace("1037", " abc"), "line 18: expected counts, found 'abc'"),
        (knet().replace("1037", " nan"), "line 18: expected counts, found 'nan'"),
        (knet(direction="N45E"), "line 13: expected a direction"),
        (knet(**{"Scale Factor": "1000"}), "line 14: expected a scale factor"),
        (knet(**{"Record Time": "yesterday"}), "line 10: expected a time"),
        (knet(**{"Sampling Freq(Hz)": "0Hz"}), "line 11: expected a sampling frequency"),
    ],
)
def test_damaged_knet_file_is_rejected_with_line(tmp_path, text, says):
    """Truncated headers, missing samples and text among the counts each get one sentence."""
    path = tmp_path / "a.NS"
    path.write_text(text)
    with pytest.raises(RecordFormatError) as caught:
        read(path)
    assert says in str(caught.value)


def test_knet_components_of_unequal_length_or_start_are_rejected(tmp_path):
    """A short sibling, or one of another recording, is no part of the record."""
    (tmp_path / "a.NS").write_text(knet())
    (tmp_path / "a.EW").write_text(knet([1] * 100, direction="E-W"))
    with pytest.raises(RecordError, match="NS 200, EW 100"):
        read(tmp_path / "a.NS")
    (tmp_path / "a.EW").write_text(knet(direction="E-W", time="2004/10/23 17:56:21"))
    with pytest.raises(RecordError, match="start times differ"):
        read([tmp_path / "a.NS", tmp_path / "a.EW"])
    assert len(read_all([tmp_path / "a.NS", tmp_path / "a.EW"])) == 2


def test_knet_csv_keeps_offset_and_start_time(tmp_path):
    """NIED's CSV: the time of the first row is the start, without 15 s; the offset is kept and flagged."""
    path = tmp_path / "download.csv"
    path.write_text(KNET_CSV)
    record = read(path)
    assert (record.format, record.station, record.codes, record.dt) == ("KNET-CSV", "FKS005", ("NS", "EW", "UD"), 0.01)
    assert record.start == datetime(2019, 1, 2, 8, 47, 27, tzinfo=UTC)
    assert record.metadata["carries_offset"] is True
    assert record.metadata["magnitude"] == 3.8
    np.testing.assert_array_equal(record.component("NS").acceleration, [-0.1856, -0.186, -0.1863])
    with pytest.raises(UnitError, match="header unit gal contradicts"):
        read(path, units="g")


def test_knet_csv_duration_is_checked(tmp_path):
    """A header of 60 s with three samples is flagged, as is a duration that is no number."""
    path = tmp_path / "download.csv"
    for text, says in ((KNET_CSV, "states 6000 samples, file contains 3"), (KNET_CSV.replace("#60", "#6O"), "'6O' is not a number")):
        path.write_text(text)
        assert any(says in doubt.message for doubt in read(path).doubts)
    path.write_text(KNET_CSV.replace("#60", "#0.03"))
    assert not [doubt for doubt in read(path).doubts if doubt.kind in ("count", "header")]


def test_kik_net_csv_has_two_sensors(tmp_path):
    """Columns 4 to 6 are the surface, the default; 1 to 3 the borehole."""
    path = tmp_path / "download.csv"
    path.write_text(KIK_CSV)
    assert read(path).component("NS").acceleration[0] == 0.04
    assert "surface" in read(path).history[0]
    assert read(path, level="borehole").component("UD").acceleration[0] == 0.03


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (KNET_CSV.split("#Time")[0], "header incomplete"),
        ("".join(KNET_CSV.partition("26.10\n#Time,RelativeTime(s),N-S(gal),E-W(gal),U-D(gal)\n")[:2]), "no samples"),
        (KNET_CSV.replace("-18.60,-1.38", "-18.60,--"), "line 18: expected a number in column E-W(gal), found '--'"),
        (KNET_CSV.replace(",0.02,", ",0.03,"), "uneven"),
        (KNET_CSV.replace("#100\n", "#200\n"), "200 Hz"),
    ],
)
def test_damaged_knet_csv_is_rejected(tmp_path, text, says):
    """Cut headers, text cells and uneven times are named."""
    path = tmp_path / "download.csv"
    path.write_text(text)
    with pytest.raises(RecordFormatError) as caught:
        read(path)
    assert says in str(caught.value)


def test_knet_bundle_equals_its_files():
    """The bundle gives what its three files give, sample by sample."""
    first, second = read(sample_path("synthetic_knet.UD")), read("synthetic_knet.knt.tar.gz")
    for code in first.codes:
        np.testing.assert_array_equal(first.component(code).acceleration, second.component(code).acceleration)
