"""A day-long record at 200 Hz fits into an ordinary machine: memory grows by so many bytes per sample and no more (FINDINGS R14)."""

from __future__ import annotations

import ctypes
import os
import sys
import tracemalloc
from pathlib import Path

import numpy as np
import obspy
import pytest

from seisblock.core.errors import ParameterError
from seisblock.measures import jma_intensity, measure
from seisblock.readers import read
from seisblock.readers._memory import trim_heap
from seisblock.records import Component, Record
from seisblock.records.process import highpass
from seisblock.samples import sample_path

SHORTER, LONGER = 2**19, 2**20
"""Samples of each of three components; pieces are smaller than these."""

BYTES_READ, BYTES_OF_A_TABLE, BYTES_MEASURED = 32.0, 42.0, 32.0
"""Of each sample of three components: what reading takes, 24 of which are the record itself, of a table with its times, and what measuring
takes besides; in a day 0.55 GB, 0.73 GB, and 0.55 GB above the record's 0.41 GB."""


@pytest.fixture(autouse=True)
def lower_long_limits(monkeypatch):
    """Let both lengths count as long."""
    for size in (
        "records.seismic_intensity.LONG_TRANSFORM",
        "measures.spectra.LONG_TRANSFORM",
        "records.qc_spikes.BLOCK",
        "records.qc_spikes.PIECE",
        "readers.source.LARGE_FILE_BYTES",
    ):
        monkeypatch.setattr(f"seisblock.{size}", 2**18)


def shaking(samples):
    """Return three components, m/s^2: a burst among noise of some counts of 1 mm/s^2."""
    rng = np.random.default_rng(samples)
    place = np.arange(samples)
    burst = 3000.0 * np.exp(-(((place - samples / 2) / 4000.0) ** 2)) * np.sin(0.0628 * place)
    return [np.rint(burst + rng.integers(-3, 4, samples)) / 1000.0 for _ in range(3)]


def per_sample(make, use, shorter=SHORTER, longer=LONGER):
    """Return how many bytes more a sample takes at the peak: the slope between two lengths, in which what does not grow cancels out."""
    use(make(2000))  # imports
    peaks = []
    for samples in (shorter, longer):
        arguments = make(samples)
        tracemalloc.start()
        try:
            assert use(arguments) is not None
            peaks.append(tracemalloc.get_traced_memory()[1])
        finally:
            tracemalloc.stop()
    return (peaks[1] - peaks[0]) / (longer - shorter)


def make_record(samples):
    """Return a record of three components."""
    return Record(tuple(Component(code, row) for code, row in zip(("NS", "EW", "UD"), shaking(samples), strict=True)), 0.005)


def test_memory_per_sample_of_reading(tmp_path):
    """A miniSEED file in integers: its samples once as they are, once in m/s^2."""

    def written(samples):
        stream = obspy.Stream()
        for letter, row in zip("NEZ", shaking(samples), strict=True):
            header = {"station": "DAY", "channel": f"HN{letter}", "delta": 0.005, "starttime": obspy.UTCDateTime(2020, 1, 1)}
            stream.append(obspy.Trace(np.rint(1000.0 * row).astype(np.int32), header))
        path = tmp_path / f"{samples}.mseed"
        stream.write(str(path), format="MSEED", encoding="STEIM2")
        return path

    assert per_sample(written, lambda path: read(path, units="mm/s2")) < BYTES_READ


def resident_bytes():
    """Return what the process holds of the machine's memory, bytes."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(sys.platform != "linux" or not hasattr(ctypes.CDLL(None), "malloc_trim"), reason="the heap of another library")
def test_trim_heap_returns_free_memory():
    """As ObsPy's decoder leaves it: 40 MB in small blocks, freed but for the topmost."""
    libc = ctypes.CDLL(None)
    libc.malloc.restype, libc.free.argtypes = ctypes.c_void_p, [ctypes.c_void_p]
    blocks = [libc.malloc(ctypes.c_size_t(2000)) for _ in range(20_000)]
    for block in blocks:
        ctypes.memset(block, 1, 2000)
    for block in blocks[:-1]:
        libc.free(block)
    holding = resident_bytes()
    trim_heap()
    arguments = holding - resident_bytes()
    libc.free(blocks[-1])
    assert arguments > 30e6


def test_reading_long_record_returns_memory(tmp_path, monkeypatch):
    """Memory of a day-long file is released after reading; a short file is left alone."""
    collected = []
    monkeypatch.setattr(sys.modules["seisblock.readers.read"], "trim_heap", lambda: collected.append(samples))
    monkeypatch.setattr(sys.modules["seisblock.readers.read"], "_TRIM_SAMPLES", 1000)
    for samples in (1000, 1001):
        path = tmp_path / f"{samples}.mseed"
        obspy.Trace(np.arange(samples, dtype=np.int32), {"station": "DAY", "channel": "HNN", "delta": 0.005}).write(str(path), "MSEED")
        read(path, units="gal")
    assert collected == [1001]


def test_memory_per_sample_of_a_table(tmp_path, monkeypatch):
    """A plain table with its times: four columns, and nothing of the text, which stays in the file."""
    for name, value in {"source.LARGE_FILE_BYTES": 2**14, "lines.CHUNK_LINES": 2**8, "table.parse.CHUNK_SIZE": 2**12}.items():
        monkeypatch.setattr(f"seisblock.readers.{name}", value)
    for name in ("BLOCK", "PIECE"):
        monkeypatch.setattr(f"seisblock.records.qc_spikes.{name}", 2**12)

    def written(samples):
        path = tmp_path / f"{samples}.csv"
        rows = zip(0.005 * np.arange(samples), *shaking(samples), strict=True)
        path.write_text(
            "time (s),NS (m/s2),EW (m/s2),UD (m/s2)\n" + "".join(",".join(f"{value:.3f}" for value in row) + "\n" for row in rows)
        )
        return path

    assert per_sample(written, read, 2**14, 2**15) < BYTES_OF_A_TABLE


@pytest.mark.slow
def test_memory_per_sample_of_measure():
    """Above the record itself; the transform of a whole component, of the intensity, is what takes most."""
    assert per_sample(make_record, measure) < BYTES_MEASURED


@pytest.mark.parametrize("samples", [2**18, 2**18 + 5, 3**11 * 5, 2 * 131101], ids=str)
def test_intensity_is_independent_of_transform_order(samples, monkeypatch):
    """As a table of as many lines as columns, of a few columns, of one (no divisor) and at once: to the round-off."""
    record = make_record(samples)
    in_pieces = jma_intensity(record)
    monkeypatch.setattr("seisblock.records.seismic_intensity.LONG_TRANSFORM", 2**21)
    monkeypatch.setattr("seisblock.records.seismic_intensity.CHUNK_SIZE", 2**21)
    assert in_pieces == pytest.approx(jma_intensity(record), rel=1e-13)


def test_highpass_with_excessive_padding_is_rejected():
    """A high-pass of 1e-6 Hz pads by a month: refused with the number and the corner that is possible."""
    with pytest.raises(ParameterError, match=r"samples of padding .* choose a corner of"):
        highpass(read(sample_path("synthetic_jma.csv")), 1e-6)


def test_intensity_of_prime_length_beyond_limit_is_none(monkeypatch):
    """A prime number of samples has one long transform: beyond the limit no intensity, and a reason with a remedy that works."""
    samples = 2**18 + 3  # a prime
    result = make_record(samples)
    full = jma_intensity(result)
    monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", "45")
    assert full is not None and jma_intensity(result) is None
    reason = "filtering 262147 samples needs 46 MiB, more than the limit of 45 MiB: shorten the record by one or two samples"
    assert any(reason in warning for warning in measure(result).warnings)
    shorter = Record(tuple(Component(c.code, c.acceleration[:-3]) for c in result.components), result.dt)
    assert jma_intensity(shorter) == pytest.approx(full, abs=1e-3)
    monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", "46")
    assert jma_intensity(result) == full
