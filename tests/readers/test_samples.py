"""The bundled samples: found by name, true to their manifest, made again by their script."""

from __future__ import annotations

import hashlib
import json
import zipfile
from pathlib import Path

import numpy as np
import pytest

from seisblock.core.errors import RecordError, RecordNotFoundError
from seisblock.readers import read
from seisblock.samples import DEFAULT_SAMPLE, list_samples, sample_path
from tests import make_sample_records as maker

RECORDS = [s for s in list_samples() if s.kind == "record"]


@pytest.mark.parametrize("sample", list_samples(), ids=lambda s: s.name)
def test_manifest_lists_every_sample(sample):
    """Name, origin, licence and digest are there, and the digest is that of the file."""
    assert sample.origin
    assert sample.licence
    assert sample.description
    assert hashlib.sha256(sample_path(sample.name).read_bytes()).hexdigest() == sample.sha256


def test_sample_directory_has_listed_files_only():
    """Every file is in the manifest, and all of them take less than 1.5 MB."""
    directory = sample_path().parent
    files = {p.name: p.stat().st_size for p in directory.iterdir() if p.is_file()}
    assert set(files) - {"MANIFEST.toml", "NOTICE"} == {s.name for s in list_samples()}
    assert sum(files.values()) < 1_500_000


def test_sample_is_found_by_name_and_stem():
    """A name that is no file but a sample's means that sample; so does its stem."""
    assert sample_path("synthetic_jma") == sample_path("synthetic_jma.csv") == sample_path(DEFAULT_SAMPLE)
    assert read("elcentro_1940_ns").sha256 == read("elcentro_1940_ns.csv").sha256
    with pytest.raises(RecordNotFoundError, match=r"synthetic_jma\.csv"):
        sample_path("nothing")


def test_synthetic_motion_contains_fitted_intervals():
    """NS holds the stretches a and c, EW holds b until d takes over, to the file's 0.001 gal."""
    record = read("synthetic_jma.csv")
    document = json.loads(maker.RECONSTRUCTED.read_text())
    for key, stop in {"NS_a": None, "NS_c": None, "EW_b": 60, "EW_d": None}.items():
        first = round(document[key]["t0"] * 100)
        expected = np.array(document[key]["values"][:stop])
        holding = record.component(key[:2]).acceleration[first : first + expected.size]
        np.testing.assert_array_equal(holding, expected, err_msg=key)


def test_synthetic_motion_exceeds_threshold_in_fitted_intervals_only():
    """No horizontal sample outside the stretches reaches 4.6 m/s^2; the ground ends at rest; UD peaks at 531.3 gal."""
    record = read("synthetic_jma.csv")
    for code, stretches in maker.stretches().items():
        free = record.component(code).acceleration.copy()
        for stretch in stretches:
            free[stretch.first : stretch.first + stretch.values.size] = 0.0
        velocity = np.cumsum(record.component(code).acceleration) * record.dt
        assert abs(velocity[-1]) < 0.01
        if code == "UD":
            assert np.abs(free).max() == pytest.approx(5.313, abs=1e-9)
        else:
            assert np.abs(free).max() < 4.6
            assert np.abs(velocity).max() < {"NS": 1.2, "EW": 2.5}[code]


def test_samples_equal_script_output():
    """The seeded script gives the bundled bytes again, but for the last digit that another processor may round otherwise."""
    created = maker.make()
    for name, (data, _) in created.items():
        bundled = sample_path(name).read_bytes()
        if name.endswith(".gz"):
            continue  # the bundle holds the three files, compressed by whichever zlib is here
        assert abs(len(bundled) - len(data)) <= 8
    repeat = [line.split(b",") for line in created["synthetic_jma.csv"][0].splitlines()[7:]]
    first = [line.split(b",") for line in sample_path("synthetic_jma.csv").read_bytes().splitlines()[7:]]
    np.testing.assert_allclose(np.array(repeat, dtype=float), np.array(first, dtype=float), rtol=0, atol=0.0021)


def test_local_file_precedes_sample_of_same_name(tmp_path: Path, monkeypatch):
    """A file in the directory takes precedence over a bundled sample of the same name."""
    monkeypatch.chdir(tmp_path)
    Path("synthetic_jma.csv").write_text("time,NS (gal)\n0,1\n0.01,2\n0.02,3\n")
    assert read("synthetic_jma.csv").codes == ("NS",)


@pytest.mark.parametrize("sample", RECORDS, ids=lambda s: s.name)
def test_strict_accepts_every_bundled_record(sample):
    assert read(sample.name).doubts == ()


def test_archive_of_recordings_without_station_names_its_files():
    """Twelve recordings of one component are no record of twelve components: the message names the remedy."""
    with pytest.raises(RecordError, match=r"12 recordings of component EW .* \(pulse_01.csv, .*pulse_12.csv\): give each file separately"):
        read("pulses.zip")


def test_archive_of_two_recordings_without_station_is_rejected(tmp_path):
    path = tmp_path / "two.zip"
    with zipfile.ZipFile(sample_path("pulses.zip")) as source, zipfile.ZipFile(path, "w") as target:
        for name in sorted(source.namelist())[:2]:
            target.writestr(name, source.read(name))
    with pytest.raises(RecordError, match="2 recordings of component EW"):
        read(path)
