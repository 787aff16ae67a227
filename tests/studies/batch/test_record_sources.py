"""Records of a batch: names and patterns, each recording once, none lost silently."""

import errno
import gzip
import io
import os
import tarfile
import tracemalloc
import zipfile
from functools import partialmethod
from pathlib import Path

import numpy as np
import pytest

from seisblock.core.errors import RecordError, RecordFormatError, RecordNotFoundError
from seisblock.readers import discover, read, source
from seisblock.readers.discover import MemberBuffer, iter_records
from seisblock.readers.options import ReadOptions
from seisblock.readers.read import read_source
from seisblock.samples import sample_directory
from tests.studies.batch.conftest import run, write_record

KNET = [sample_directory() / f"synthetic_knet.{code}" for code in ("EW", "NS", "UD")]


def record_sources(*names, **message):
    """Return what some names stand for."""
    return list(iter_records([str(name) for name in names], ReadOptions(**message)))


def test_sources_list_each_recording_once(folder):
    """Each recording once, in the order in which it is first named, by whatever name."""
    (folder / "list.txt").write_text("# the two\nr3.csv\n\nr0.csv\n")
    (folder / "records" / "near.txt").write_text("r2.csv\n")
    names = [item.name for item in record_sources("records/r1.csv", "records/r[12].csv", "records", "@records/near.txt")]
    assert names == ["r1.csv", "r2.csv", "r0.csv", "r3.csv"]
    os.link("records/r0.csv", "other.csv")
    assert [item.path for item in record_sources("records/r0.csv", Path("records").resolve() / "r0.csv", "other.csv")] == [
        "records/r0.csv",
        "other.csv",
    ]
    with pytest.raises(RecordNotFoundError, match=r"no file matches the pattern"):
        record_sources("*.knt")
    with pytest.raises(RecordNotFoundError, match=r"cannot read gone.txt: No such file"):
        record_sources("@gone.txt")
    (folder / "empty.txt").write_text("# nothing\n")
    with pytest.raises(RecordNotFoundError, match=r"record list is empty"):
        record_sources("@empty.txt")
    (folder / "one.txt").write_text("@two.txt\n")
    (folder / "two.txt").write_text("r0.csv\n@one.txt\n")
    with pytest.raises(RecordNotFoundError, match=r"one.txt: the record list contains itself"):
        record_sources("@one.txt")


def test_folder_skips_files_that_are_not_records(folder):
    """Pictures, notes, hidden and empty files are ignored; with a given format only these are."""
    for name in ("records/photo.png", "records/notes.md", "records/.hidden.csv", "records/empty.csv"):
        (folder / name).write_bytes(b"" if "empty" in name else b"time,NS (gal)\n0,1\n0.01,2\n")
    (folder / "records" / "noise.bin").write_bytes(bytes(range(256)) * 8)
    assert [item.name for item in record_sources("records")] == [f"r{n}.csv" for n in range(4)]
    (folder / "nothing").mkdir()
    (folder / "nothing" / "photo.png").write_bytes(b"x")
    with pytest.raises(RecordNotFoundError, match=r"no record found in this folder \(1 other files\)"):
        record_sources("nothing")


def test_component_files_of_station_form_one_record(folder):
    """Named one by one, in a folder beside others, or one for all."""
    for path in KNET:
        (folder / path.name).write_bytes(path.read_bytes())
        (folder / path.name.replace("synthetic", "other")).write_bytes(path.read_bytes())
    pair = record_sources(*[item.name for item in KNET], "other_knet.EW", "other_knet.NS")
    assert [item.name for item in pair] == ["synthetic_knet.EW", "other_knet.EW"]
    assert [read_source(item, ReadOptions()).codes for item in pair] == [("NS", "EW", "UD"), ("NS", "EW")]
    (single,) = record_sources("synthetic_knet.NS")
    np.testing.assert_array_equal(
        read_source(single, ReadOptions()).component("NS").acceleration, read("synthetic_knet.NS").component("NS").acceleration
    )
    assert read_source(single, ReadOptions()).codes == ("NS", "EW", "UD")


def pack(path, members):
    """Write a zip or a tar.gz with some members, in their order."""
    if path.suffix == ".zip":
        with zipfile.ZipFile(path, "w") as archive:
            for name, data in members:
                archive.writestr(name, data)
    else:
        with tarfile.open(path, "w:gz", compresslevel=1) as archive:
            for name, data in members:
                info = tarfile.TarInfo(name)
                info.size = len(data)
                archive.addfile(info, io.BytesIO(data))
    return path


@pytest.mark.parametrize("suffix", [".zip", ".tar.gz"])
@pytest.mark.parametrize("order", ["by station", "by component"])
def test_each_station_of_bundle_is_a_record(folder, suffix, order):
    """However its members are sorted; a component that is missing is no reason to lose the others."""
    members = [
        (f"{station}1604160125.{path.suffix[1:]}", path.read_bytes().replace(b"SYN001", station.encode()))
        for station in ("AAA001", "BBB002")
        for path in KNET
    ]
    members = [*members, ("map.png", b"not a record"), ("CCC0031604160125.EW", KNET[0].read_bytes().replace(b"SYN001", b"CCC003"))]
    if order == "by component":
        members.sort(key=lambda item: item[0].rsplit(".", 1)[-1])
    bundle = pack(folder / f"event{suffix}", members)
    records = {entry.name[:6]: read_source(entry, ReadOptions()) for entry in record_sources(bundle)}
    assert {name: (record.station, record.codes) for name, record in records.items()} == {
        "AAA001": ("AAA001", ("NS", "EW", "UD")),
        "BBB002": ("BBB002", ("NS", "EW", "UD")),
        "CCC003": ("CCC003", ("EW",)),
    }


def test_station_option_selects_from_bundle(folder):
    """The others have no rows; capitals do not matter, as everywhere."""
    members = [
        (f"{station}1604160125.{path.suffix[1:]}", path.read_bytes().replace(b"SYN001", station.encode()))
        for station in ("AAA001", "BBB002")
        for path in KNET
    ]
    pack(folder / "event.zip", members)
    assert run("batch event.zip --station BBB002 --bodies gravestone --solver rock --out t.csv").exit_code == 0
    assert {line.split(",")[2] for line in Path("t.csv").read_text().splitlines()[1:]} == {"BBB002"}
    assert run("batch event.zip --station bbb002 --bodies gravestone --solver rock --out v.csv").exit_code == 0
    assert Path("v.csv").read_text() == Path("t.csv").read_text()
    assert run("batch event.zip --station ZZZ --bodies gravestone --solver rock --out u.csv").exit_code == 3


def test_damaged_bundle_keeps_earlier_records(folder):
    """A row of its own states the reason for the rest."""
    members = [(path.name, path.read_bytes()) for path in KNET] + [("z.csv", write_record(folder / "z.csv", 1).read_bytes())]
    bundle = pack(folder / "event.zip", members)
    data = bytearray(bundle.read_bytes())
    place = data.rfind(b"z.csv", 0, data.find(b"PK\x01\x02"))
    data[place + 200 : place + 400] = bytes(200)
    bundle.write_bytes(bytes(data))
    good, bad = record_sources(bundle)
    assert read_source(good, ReadOptions()).codes == ("NS", "EW", "UD")
    with pytest.raises(ValueError, match="damaged"):
        read_source(bad, ReadOptions())


def test_borehole_sensor_is_selectable(folder):
    """Six files are one station; without a word its surface."""
    for path in KNET:
        for sensor in "12":
            (folder / f"SYNH011604160125{path.suffix}{sensor}").write_bytes(path.read_bytes().replace(b"SYN001", b"SYNH01"))
    (station,) = record_sources(*sorted(str(item.name) for item in folder.glob("SYNH01*")))
    assert len(station.files) == 6


def members_of_stations(count, *, by_component):
    """Return members of so many stations of about 100 kB each, of one component after the other where asked for."""
    parts = [(path.suffix, path.read_bytes()) for path in KNET]
    all_cases = [(f"S{n:05d}1604160125{suffix}", data) for n in range(count) for suffix, data in parts]
    return sorted(all_cases, key=lambda item: item[0][-2:]) if by_component else all_cases


@pytest.mark.parametrize("suffix", [".zip", ".tar.gz"])
@pytest.mark.parametrize("by_component", [False, True])
def test_bundle_memory_is_independent_of_station_count(folder, monkeypatch, suffix, by_component):
    """Twenty-four stations take the memory of eight: what waits for the rest of its set, and a large archive, lie in files."""
    monkeypatch.setattr(source, "LARGE_FILE_BYTES", 2**16)
    monkeypatch.setattr(MemberBuffer, "__init__", partialmethod(MemberBuffer.__init__, in_memory=2**16))
    station = sum(path.stat().st_size for path in KNET)
    peaks = []
    for count in (8, 24):
        bundle = pack(folder / f"{count}{suffix}", members_of_stations(count, by_component=by_component))
        tracemalloc.start()
        try:
            assert sum(len(item.blobs) == 3 for item in iter_records([str(bundle)], ReadOptions())) == count
            peaks.append(tracemalloc.get_traced_memory()[1])
        finally:
            tracemalloc.stop()
    assert peaks[1] - peaks[0] < 16 * station / 4


def test_full_temporary_folder_is_reported(folder, monkeypatch):
    """Sets complete before the folder was full are computed."""
    bundle = pack(folder / "event.zip", members_of_stations(2, by_component=False))

    class Full(io.BytesIO):
        def write(self, data):
            if self.tell() > 0:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return super().write(data)

    monkeypatch.setattr(discover.tempfile, "SpooledTemporaryFile", lambda size: Full())
    *_, failed = record_sources(bundle)[:1]
    with pytest.raises(RecordError, match=r"cannot write a temporary file.*No space left"):
        read_source(failed, ReadOptions())


def test_truncated_bundle_keeps_earlier_records(folder):
    """An archive is unpacked as its members are taken; a spoilt header is damage, not its end, and the checksum at its end is looked at."""
    bundle = pack(folder / "event.tar.gz", members_of_stations(4, by_component=False))
    full = bundle.read_bytes()
    plain = gzip.decompress(full)
    header = plain.find(b"S00003")
    spoilt = plain[: header + 148] + b"999999" + plain[header + 154 :]
    lie = full[:-8] + bytes(4) + full[-4:]
    for data, good in ((full[: len(full) * 2 // 3], 2), (gzip.compress(spoilt, 1), 3), (spoilt, 3), (lie, 4)):
        bundle.write_bytes(data)
        *remaining, failed = [item for item in record_sources(bundle) if item.failure or len(item.blobs) == 3]
        assert [read_source(item, ReadOptions()).codes for item in remaining] == [("NS", "EW", "UD")] * len(remaining) and len(
            remaining
        ) >= good
        with pytest.raises(RecordFormatError, match=r"event.tar.gz: archive damaged; download it again"):
            read_source(failed, ReadOptions())
