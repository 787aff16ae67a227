"""Limits of reading: archive bombs, devices and endless pipes are rejected, with the number and the variable that raises it."""

from __future__ import annotations

import bz2
import gzip
import io
import lzma
import os
import subprocess
import sys
import tarfile
import zipfile

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.core.errors import ParameterError, RecordError, RecordFormatError
from seisblock.readers import read, read_all
from tests.readers.files import JMA_BODY, JMA_HEADER, knet, tar


def sparse_tar(size):
    """Return a tar of 2 KB with one member that is a hole of so many bytes."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.PAX_FORMAT) as archive:
        info = tarfile.TarInfo("huge.csv")
        info.pax_headers = {
            "GNU.sparse.major": "1",
            "GNU.sparse.minor": "0",
            "GNU.sparse.name": "huge.csv",
            "GNU.sparse.realsize": str(size),
        }
        data = b"0\n".ljust(512, b"\0")
        info.size = len(data)
        archive.addfile(info, io.BytesIO(data))
    return buffer.getvalue()


def zip_of_zeros(size, level=9):
    """Return a zip of one member of so many zero bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=level) as archive:
        archive.writestr("huge.csv", b"0" * size)
    return buffer.getvalue()


@pytest.fixture
def set_limits(monkeypatch):
    """Return a function that sets the memory limit in the environment, and limits of counts in the module of the readers."""

    def limit(mib=None, **counts):
        if mib is not None:
            monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", str(mib))
        for name, value in counts.items():
            monkeypatch.setattr(f"seisblock.readers.limits.{name}", value)

    return limit


def assert_refused(path, says):
    """Check that a file is refused for its size."""
    with pytest.raises(RecordError) as caught:
        read(path)
    assert says in str(caught.value)
    assert not isinstance(caught.value, RecordFormatError)


def test_sparse_tar_member_is_skipped(tmp_path):
    """A sparse member of 12 GB in a tar of 2 KB is passed over."""
    path = tmp_path / "sparse.tar"
    path.write_bytes(sparse_tar(12_000_000_000))
    with pytest.raises(RecordFormatError, match="no record found in this archive"):
        read(path)


def test_declared_member_size_is_checked_first(tmp_path, set_limits):
    """A member that declares an excessive size is not unpacked; the message names size, limit and variable."""
    set_limits(mib=2)
    path = tmp_path / "large.zip"
    path.write_bytes(zip_of_zeros(5 * 2**20))
    assert_refused(path, "large.zip/huge.csv: 5 MiB, more than the limit of 2; set SEISBLOCK_MEMORY_MIB to read more")
    (tmp_path / "plain.csv").write_bytes(b"1\n" * 2**21)
    assert_refused(tmp_path / "plain.csv", "4 MiB, more than the limit of 2")


@pytest.mark.parametrize("packer", [gzip, bz2, lzma])
def test_unpacked_bytes_are_counted(packer, tmp_path, set_limits):
    """Unpacked bytes are counted, whatever size was declared."""
    set_limits(mib=1)
    path = tmp_path / "bomb.csv.gz"
    path.write_bytes(packer.compress(b"0" * 3 * 2**20))
    assert_refused(path, "larger than the limit of 1 MiB; set SEISBLOCK_MEMORY_MIB")


def test_nested_archives_share_one_limit(tmp_path, set_limits):
    """Four archives of 0.6 MiB each exceed 2 MiB together, however they are packed."""
    set_limits(mib=2)
    inner = {f"{i}.csv.gz": gzip.compress(b"%d\n" % i * 300_000) for i in range(4)}
    path = tmp_path / "many.tar"
    path.write_bytes(tar(inner))
    assert_refused(path, "the limit of 2 MiB")


def test_nesting_depth_and_member_count_are_limited(tmp_path, set_limits):
    """An archive in an archive in an archive, and more files than anyone packs."""
    set_limits(MAX_NESTING=3, MAX_MEMBERS=50)
    data = tar({"a.NS": knet().encode()})
    for depth in range(5):
        path = tmp_path / f"{depth}.tar"
        path.write_bytes(data)
        if depth < 3:
            assert read(path).samples == 200
        else:
            assert_refused(path, "4 levels of nested archives, more than the limit of 3; set SEISBLOCK_LIMIT_FACTOR")
        data = tar({"inner.tar": data})
    path = tmp_path / "crowd.tar"
    path.write_bytes(tar({f"{i}.txt": b"x" for i in range(60)}))
    assert_refused(path, "51 files, more than the limit of 50; set SEISBLOCK_LIMIT_FACTOR")


def test_sample_count_is_limited(tmp_path, set_limits):
    """More samples than are wanted are refused by their number."""
    set_limits(mib=1, _SAMPLE_BYTES=2**20 // 5)
    path = tmp_path / "a.csv"
    path.write_bytes((JMA_HEADER + JMA_BODY).encode("cp932"))
    assert_refused(path, "9 samples, more than the limit of 5; set SEISBLOCK_MEMORY_MIB")


@pytest.mark.parametrize("text", ["-1", "0", "lots", "1.5", "٣"])
def test_limit_variable_requires_integer(monkeypatch, text):
    """Anything else is named."""
    monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", text)
    with pytest.raises(ParameterError, match="SEISBLOCK_MEMORY_MIB must be a positive integer, found"):
        read("synthetic_jma.csv")


def test_devices_are_rejected():
    """/dev/zero and /dev/null are refused at once."""
    for device in ("/dev/zero", "/dev/null"):
        with pytest.raises(RecordError, match="is a device: give a file"):
            read(device)


def test_endless_pipe_is_read_up_to_limit(tmp_path, set_limits):
    """A pipe is read up to the limit."""
    set_limits(mib=1)
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen(
        [sys.executable, "-c", f"open({str(pipe)!r}, 'wb').write(b'0' * 9_000_000)"], stderr=subprocess.DEVNULL
    ) as writer:
        assert_refused(pipe, "larger than the limit of 1 MiB")
        writer.wait()


def test_zip_with_missing_byte_gives_record_or_input_error(tmp_path):
    """Every byte that may be missing from a zip gives one sentence or the record."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("a.NS", knet())
    full, path = buffer.getvalue(), tmp_path / "a.zip"
    for missing in [*range(60), *range(len(full) - 110, len(full))]:
        path.write_bytes(full[:missing] + full[missing + 1 :])
        try:
            read(path)
        except RecordError as error:
            assert "a.zip" in str(error)


def test_measure_reads_standard_input():
    """``seisblock measure -`` reads any format from stdin."""
    data = (JMA_HEADER + JMA_BODY).encode("cp932")
    result = CliRunner().invoke(main, ["measure", "-", "--json", "--quiet"], input=data)
    assert result.exit_code == 0, result.output
    assert '"source":"standard input"' in result.stdout.replace(": ", ":")
    empty = CliRunner().invoke(main, ["measure", "-"], input=b"")
    assert (empty.exit_code, "standard input: empty file" in empty.stderr) == (3, True)


def test_csv_to_stdout_writes_table_only():
    """``--csv -`` writes the table to stdout and nothing else; what would also go there is refused."""
    completed = CliRunner().invoke(main, ["measure", "synthetic_jma", "--csv", "-", "--quiet", "--component", "NS"])
    assert completed.stdout.splitlines()[0] == "time_s,NS_acceleration_m_s2,NS_velocity_m_s,NS_displacement_m"
    assert len(completed.stdout.splitlines()) == 6001
    for words in (["--json"], ["--plot", "-"]):
        result = CliRunner().invoke(main, ["measure", "synthetic_jma", "--csv", "-", *words])
        assert result.exit_code == 3
        assert "writes to stdout, which takes one output: omit" in result.stderr


def test_station_all_gives_record_per_station(tmp_path):
    """``--station all`` gives a record for each station; one record of several stations is refused."""
    files = {}
    for station, time in (("NIG019", "2004/10/23 17:56:20"), ("NIG017", "2004/10/23 17:56:25")):
        for code, direction in (("NS", "N-S"), ("EW", "E-W"), ("UD", "U-D")):
            files[f"{station}.{code}"] = knet(station=station, direction=direction, time=time).encode()
    path = tmp_path / "event.tar"
    path.write_bytes(tar({"event.knt.tar.gz": tar(files, mode="w:gz")}))
    records = read_all([path], station="all")
    assert [(r.station, r.codes) for r in records] == [("NIG019", ("NS", "EW", "UD")), ("NIG017", ("NS", "EW", "UD"))]
    result = CliRunner().invoke(main, ["measure", str(path), "--station", "all", "--json", "--quiet"])
    assert result.stdout.count('"record_index"') == 6
    with pytest.raises(RecordError, match="2 stations, but one record is needed"):
        read(path, station="all")
