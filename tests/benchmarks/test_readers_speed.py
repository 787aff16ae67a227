"""Reading is quick: a JMA file of 36 000 samples in under 0.15 s, a 20-minute record too."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from seisblock.readers import read
from seisblock.records import Component, Record
from seisblock.records.qc import run_qc
from tests.readers.files import JMA_HEADER, knet

BUDGET_S = 0.15


def rows(count):
    return np.round(np.random.default_rng(1).normal(scale=80.0, size=(count, 3)), 3)


@pytest.fixture
def long_jma(tmp_path):
    path = tmp_path / "jma.csv"
    body = "".join(f"{a:.3f},{b:.3f},{c:.3f}\r\n" for a, b, c in rows(36000))
    path.write_bytes((JMA_HEADER + body).encode("cp932"))
    return path


def test_read_jma_file_of_36000_samples(benchmark, long_jma):
    """Six minutes at 100 Hz, as JMA published for 2011-03-11, in under 0.15 s."""
    record = benchmark(read, long_jma)
    assert record.samples == 36000
    assert benchmark.stats is None or benchmark.stats.stats.median < BUDGET_S


def test_read_table_of_20_minutes(benchmark, tmp_path):
    """120 000 rows of time and three components with units, in under 0.6 s."""
    path = tmp_path / "long.csv"
    body = "".join(f"{i / 100:.2f},{a:.3f},{b:.3f},{c:.3f}\n" for i, (a, b, c) in enumerate(rows(120000)))
    path.write_text("time,NS (gal),EW (gal),UD (gal)\n" + body)
    record = benchmark(read, path)
    assert (record.samples, record.dt) == (120000, 0.01)
    assert benchmark.stats is None or benchmark.stats.stats.median < 4 * BUDGET_S


def test_read_knet_set_of_5_minutes(benchmark, tmp_path):
    """Three files of 30 000 counts through ObsPy, in under 0.3 s."""
    counts = [int(x) for x in 1e5 * rows(30000)[:, 0]]
    for code, direction in (("NS", "N-S"), ("EW", "E-W"), ("UD", "U-D")):
        (tmp_path / f"a.{code}").write_text(knet(counts, direction=direction))
    record = benchmark(read, tmp_path / "a.NS")
    assert record.codes == ("NS", "EW", "UD")
    assert benchmark.stats is None or benchmark.stats.stats.median < 2 * BUDGET_S


def test_check_day_long_component(benchmark):
    """24 h at 100 Hz, noise that exceeds every threshold of size, in under 0.9 s."""
    component = Component("EW", np.random.default_rng(1).normal(scale=0.1, size=8_640_000))
    record = benchmark(run_qc, Record([component], 0.01))
    assert not record.doubts
    assert benchmark.stats is None or benchmark.stats.stats.min < 6 * BUDGET_S


def test_text_readers_import_no_large_package():
    """JMA CSV, AT2 and plain tables are read without ObsPy, scipy, pandas or matplotlib."""
    code = (
        "import sys, seisblock; seisblock.read('synthetic_jma.csv'); seisblock.read('elcentro_1940_ns'); "
        "print([m for m in ('obspy', 'scipy', 'pandas', 'matplotlib', 'numba') if m in sys.modules])"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "[]"
