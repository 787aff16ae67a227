"""Distribution: bounds of dependencies, and wheels that are the same whenever and wherever they are built."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from gettext import GNUTranslations
from importlib.metadata import version
from pathlib import Path

import pytest

from tests.lowest_versions import lowest_versions

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
CATALOGUE = "seisblock/locale/ja/LC_MESSAGES/seisblock.mo"


def release(text):
    """Return the numbers of a version."""
    return tuple(int(number) for number in re.findall(r"\d+", text)[:3])


def copy_sources(folder):
    """Copy what a wheel is built from, without files that an earlier build left."""
    for name in ("seisblock", "sample_records"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__", "*.mo"))
    for name in ("pyproject.toml", "hatch_build.py", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, folder)
    return folder


def build_wheel(folder, **environment):
    """Build the wheel of a copy of the sources; return its path."""
    inherited = {key: value for key, value in os.environ.items() if key != "SOURCE_DATE_EPOCH"}
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder / "wheel")]
    result = subprocess.run(command, cwd=folder, env=inherited | environment, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    (path,) = (folder / "wheel").glob("*.whl")
    return path


def test_each_dependency_has_a_lower_bound_that_the_installed_version_meets():
    for name, lowest in lowest_versions("test").items():
        assert release(lowest) <= release(version(name)), name


@pytest.mark.parametrize("extra", sorted(EXTRAS.keys() - {"test", "docs", "map"}))
def test_the_test_extra_asks_for_the_versions_of_the_other_extras(extra):
    assert set(EXTRAS[extra]) <= set(EXTRAS["test"])


def test_numba_is_capped_at_the_next_minor_version():
    """`seisblock._jit` subclasses private parts of numba, which may change in any minor version."""
    (requirement,) = (line for line in PROJECT["dependencies"] if line.startswith("numba"))
    limit = re.fullmatch(r"numba>=\d+\.\d+,<(\d+\.\d+)", requirement)[1]
    assert release(version("numba")) < release(limit)


def test_wheel_does_not_depend_on_place_and_time_of_the_build(tmp_path):
    """The time zone changes the date that Babel writes by default; the second copy is private to its owner."""
    paths = []
    for zone in ("UTC", "Asia/Tokyo"):
        folder = copy_sources(tmp_path / zone.replace("/", "-"))
        if paths:
            for path in folder.rglob("*"):
                path.chmod(0o700 if path.is_dir() else 0o600)
        paths.append(build_wheel(folder, TZ=zone))
    first, second = ({name: archive.read(name) for name in archive.namelist()} for archive in map(zipfile.ZipFile, paths))
    assert CATALOGUE in first
    assert [name for name in first if first[name] != second.get(name)] == []
    digests = {hashlib.sha256(path.read_bytes()).hexdigest() for path in paths}
    assert len(digests) == 1


def test_wheel_is_dated_by_source_date_epoch(tmp_path):
    path = build_wheel(copy_sources(tmp_path / "sources"), SOURCE_DATE_EPOCH="1700000000")
    with zipfile.ZipFile(path) as archive:
        assert archive.getinfo(CATALOGUE).date_time == (2023, 11, 14, 22, 13, 20)
        with archive.open(CATALOGUE) as stream:
            assert GNUTranslations(stream).info()["pot-creation-date"] == "2023-11-14 22:13+0000"
