"""Files, bundles and names: file sets, and rejected combinations."""

from __future__ import annotations

import bz2
import gzip
import io
import lzma
import pickle
import tarfile
import zipfile
from pathlib import Path

import numpy as np
import obspy
import pytest

from seisblock.core.errors import ComponentError, InputError, ParameterError, RecordError, RecordFormatError, RecordNotFoundError, UnitError
from seisblock.readers import read, read_all
from seisblock.readers.discover import iter_records
from seisblock.readers.options import ReadOptions
from seisblock.samples import sample_path
from tests.readers.files import JMA_BODY, JMA_HEADER, knet, tar


def station_files(station, **options):
    names = (("NS", "N-S"), ("EW", "E-W"), ("UD", "U-D"))
    return {f"{station}0410231756.{code}": knet(station=station, direction=direction, **options).encode() for code, direction in names}


def make_zip(files):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return buffer.getvalue()


def test_nested_bundle_requires_station(tmp_path):
    """A .tar of .tar.gz with plots among them, as NIED sends it: the stations are listed, one is taken."""
    plots = {"a.ps.gz": gzip.compress(b"%!PS"), "b.png": b"\x89PNG"}
    inner = tar({**station_files("NIG019"), **plots, **station_files("NIG017", time="2004/10/23 17:56:25")}, mode="w:gz")
    outer = tmp_path / "20041023175600.tar"
    outer.write_bytes(tar({"20041023175600.knt.tar.gz": inner, "20041023175600.all.img.tar.gz": tar(plots, mode="w:gz")}))
    with pytest.raises(ComponentError, match="NIG019, NIG017"):
        read(outer)
    with pytest.raises(ComponentError, match="no station 'TKY001'; available: NIG019, NIG017"):
        read(outer, station="TKY001")
    record = read(outer, station="nig017")
    assert (record.station, record.codes) == ("NIG017", ("NS", "EW", "UD"))
    assert record.source == str(outer)


@pytest.mark.parametrize(("suffix", "pack"), [("gz", gzip.compress), ("bz2", bz2.compress), ("xz", lzma.compress)])
def test_other_compression_formats_are_unpacked(suffix, pack, tmp_path):
    """A bundle, and a lone file; one that was cut is damaged."""
    bundle, single = tmp_path / f"event.knt.tar.{suffix}", tmp_path / f"mine.csv.{suffix}"
    bundle.write_bytes(tar(station_files("NIG019"), mode=f"w:{suffix}"))
    assert read(bundle).codes == ("NS", "EW", "UD")
    plain = "time,EW (gal)\n" + "".join(f"{0.01 * k:.2f},{k % 7}\n" for k in range(400))
    single.write_bytes(pack(plain.encode()))
    assert read(single).samples == 400
    single.write_bytes(pack(plain.encode())[:-20])
    with pytest.raises(RecordFormatError, match=r"archive damaged; download it again\Z"):
        read(single)


def test_encrypted_zip_is_not_called_damaged(tmp_path):
    """Bit 0 of the flags of a member marks a password; the message quotes no exception of Python."""
    plain = make_zip({"mine.csv": b"time,EW (gal)\n0.00,1\n"})
    data = bytearray(plain)
    data[6] |= 1
    data[plain.index(b"PK\x01\x02") + 8] |= 1
    path = tmp_path / "mine.zip"
    path.write_bytes(data)
    with pytest.raises(RecordFormatError, match=r"archive encrypted or compressed by an unknown method; unpack it first\Z"):
        read(path)


def test_zip_with_folders_gives_its_record(tmp_path):
    """A zip with subfolders and a note in it gives its one record; so does a lone .gz."""
    path = tmp_path / "mine.zip"
    path.write_bytes(make_zip({"a/readme.txt": b"hello, this is a note", **{f"a/b/{k}": v for k, v in station_files("NIG019").items()}}))
    assert read(path).codes == ("NS", "EW", "UD")
    lone = tmp_path / "jma.csv.gz"
    lone.write_bytes(gzip.compress((JMA_HEADER + JMA_BODY).encode("cp932")))
    assert read(lone).format == "JMA-CSV"


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (make_zip({"readme.txt": b"nothing here"}), "contents: readme.txt"),
        (make_zip({"plot.png": b"x"}), "plots only"),
        (gzip.compress(bytes(range(256)))[:100], "damaged"),
        (make_zip(station_files("NIG019"))[:-200], "damaged"),
    ],
    ids=["no record", "plots only", "gzip cut short", "zip cut short"],
)
def test_bundle_without_record_or_damaged_is_rejected(tmp_path, data, says):
    """The error of a bundle without a record lists its contents or states the damage."""
    path = tmp_path / "bundle"
    path.write_bytes(data)
    with pytest.raises(RecordFormatError) as caught:
        read(path)
    assert says in str(caught.value)


def test_missing_directory_and_empty_paths_are_rejected(tmp_path):
    """Each has its class; a missing one lists the samples and is a FileNotFoundError too."""
    with pytest.raises(RecordNotFoundError, match="no such file or bundled sample") as caught:
        read(tmp_path / "nothing.csv")
    assert isinstance(caught.value, FileNotFoundError)
    with pytest.raises(RecordError, match="no record found in this folder"):
        read(tmp_path)
    for content in (b"", b"\r\n \n"):
        (tmp_path / "empty.csv").write_bytes(content)
        with pytest.raises(RecordError, match="empty file"):
            read(tmp_path / "empty.csv")
    with pytest.raises(RecordNotFoundError):
        read("a\x00b")
    with pytest.raises(RecordNotFoundError):
        read("x" * 5000)
    with pytest.raises(ParameterError, match="no record given"):
        read([])


NOISE = np.random.default_rng(0).bytes(5000)


@pytest.mark.parametrize("data", [bytes(range(256)) * 40, b"\x00" * 4096, b"\xff\xfe\x00", NOISE, b"\x89PNG\r\n\x1a\n\x00"])
def test_binary_files_are_rejected(tmp_path, data):
    """Whatever the bytes, the answer is one sentence of ours."""
    path = tmp_path / "binary.csv"
    path.write_bytes(data)
    for options in ({}, {"units": "gal"}, {"format": "CSV", "units": "gal"}, {"format": "KNET"}, {"format": "JMA-CSV"}, {"format": "AT2"}):
        with pytest.raises(InputError) as caught:
            read(path, **options)
        assert "binary.csv" in str(caught.value)


class Bomb:
    """A pickle that would run code."""

    def __reduce__(self):
        return exec, ("raise SystemExit('a pickle was run')",)


def test_pickles_are_never_loaded(tmp_path):
    """No pickle: ObsPy would unpickle a file to see what it is; a record is data, so here it stays closed."""
    path = tmp_path / "evil.csv"
    path.write_bytes(pickle.dumps(Bomb()))
    for options in ({}, {"units": "gal"}, {"format": "PICKLE", "units": "gal"}, {"format": "OBSPY:PICKLE"}):
        with pytest.raises(InputError):
            read(path, **options)


def test_counts_without_station_name_formats_that_state_their_scale(tmp_path):
    """WIN, as NIED offers it (kwin) beside K-NET ASCII: no unit is to be guessed."""
    path = Path(obspy.__file__).parent / "io" / "win" / "tests" / "data" / "10030302.00"
    if not path.exists():
        pytest.skip("ObsPy without its test data")
    with pytest.raises(UnitError, match="with counts, without scale factor and station code: download the same record as K-NET ASCII"):
        read(path)
    archive = tmp_path / "20160416.kwin.tar.gz"
    with tarfile.open(archive, "w:gz") as bundle:
        bundle.add(path, "20160416.win")
    with pytest.raises(UnitError, match=r"20160416\.win: WIN file with counts, without scale factor"):
        read(archive)
    (source,) = iter_records([str(archive)], ReadOptions())
    assert "WIN file with counts" in str(source.failure)


def test_miniseed_requires_unit(tmp_path):
    """MiniSEED contains counts: refused without a response, read in a unit that the user states, three channels as NS, EW, UD."""
    stream = obspy.Stream()
    for channel in "ENZ":
        header = {"station": "ABC", "channel": f"HN{channel}", "delta": 0.01, "starttime": obspy.UTCDateTime(2020, 1, 1)}
        stream.append(obspy.Trace(np.arange(100, dtype=np.int32) * (1 + "ENZ".index(channel)), header=header))
    path = tmp_path / "a.mseed"
    stream.write(str(path), format="MSEED")
    with pytest.raises(UnitError, match=r"counts, and their instrument response is missing.*sta=ABC&level=response"):
        read(path)
    record = read(path, units="gal")
    assert (record.format, record.station, record.codes, record.dt) == ("OBSPY:MSEED", "ABC", ("NS", "EW", "UD"), 0.01)
    np.testing.assert_array_equal(record.component("NS").acceleration, np.arange(100) * 2 / 100)
    assert read(path, units="gal", format="OBSPY:MSEED").codes == record.codes
    with pytest.raises(ParameterError, match="unknown format 'NONSENSE'"):
        read(path, units="gal", format="nonsense")
    broken = obspy.Stream([stream[0].slice(endtime=stream[0].stats.starttime + 0.3), stream[0].slice(stream[0].stats.starttime + 0.6)])
    broken.write(str(path), format="MSEED")
    with pytest.raises(RecordFormatError, match="gaps"):
        read(path, units="gal")


@pytest.mark.parametrize("waveform", ["SLIST", "TSPAIR"])
def test_slist_and_tspair_counts_are_checked(tmp_path, waveform):
    """SLIST and TSPAIR state the number of samples: another number is flagged, unlike in ObsPy."""
    trace = obspy.Trace((np.sin(np.arange(300) * 0.2) * 1000).astype(np.int32), header={"station": "ABC", "channel": "HNZ", "delta": 0.01})
    path = tmp_path / "a.txt"
    obspy.Stream([trace]).write(str(path), format=waveform)
    assert read(path, units="mm/s2").doubts == ()
    path.write_text(path.read_text().replace(" 300 samples", " 301 samples"))
    assert [doubt.message for doubt in read(path, units="mm/s2").doubts] == ["_ABC__HNZ_: header states 301 samples, file contains 300"]


def test_gse_is_rejected(tmp_path):
    """Obspy's decoder of GSE2 ends the process on a damaged file: the format is named and left alone."""
    trace = obspy.Trace(np.arange(200, dtype=np.int32), header={"station": "ABC", "channel": "HNZ", "delta": 0.01})
    trace.stats.calib = 1.0
    path = tmp_path / "a.gse"
    obspy.Stream([trace]).write(str(path), format="GSE2")
    for options in ({}, {"units": "gal"}, {"units": "gal", "format": "GSE2"}, {"units": "gal", "format": "OBSPY:GSE2"}):
        with pytest.raises(RecordFormatError, match=r"GSE2? not supported .*; convert the record"):
            read(path, **options)


def test_several_files_give_records_in_order(tmp_path):
    """Files of different recordings stay apart, each read as if alone; a file named twice is refused."""
    (tmp_path / "a.csv").write_text("time,NS (gal)\n0,1\n0.01,2\n")
    records = read_all([sample_path(), tmp_path / "a.csv", "elcentro_1940_ns"])
    assert [r.format for r in records] == ["JMA-CSV", "CSV", "CSV"]
    assert [len(r.components) for r in records] == [3, 1, 1]
    with pytest.raises(ParameterError, match=r"a\.csv is given 2 times"):
        read_all([sample_path(), tmp_path / "a.csv", tmp_path / "a.csv"])
    first = read([tmp_path / "a.csv"])
    assert first.source == str(tmp_path / "a.csv")


def test_component_paths_together_give_one_record(tmp_path):
    """Paths given together are one record; the digest is that of the bytes in order."""
    import hashlib

    (tmp_path / "ns.csv").write_text("time,NS (gal)\n0,1\n0.01,2\n")
    (tmp_path / "ew.csv").write_text("time,EW (gal)\n0,1\n0.01,2\n")
    record = read([tmp_path / "ew.csv", tmp_path / "ns.csv"])
    assert record.codes == ("NS", "EW")
    assert record.sha256 == hashlib.sha256((tmp_path / "ew.csv").read_bytes() + (tmp_path / "ns.csv").read_bytes()).hexdigest()
    with pytest.raises(RecordError, match="without station and time"):
        read([tmp_path / "ns.csv", tmp_path / "ns.csv"])
