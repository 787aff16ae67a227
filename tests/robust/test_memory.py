"""A day-long record at 200 Hz fits into an ordinary machine: memory grows by so many bytes per sample and no more (FINDINGS R14)."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import obspy
import pytest

from seisblock.errors import ParameterError
from seisblock.readers import read, sample_path
from seisblock.records.process import highpass

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ru_maxrss is in KiB")

MEASURE = """
import resource, sys
from seisblock.cli import main
try:
    main(["measure", sys.argv[1], "--units", "mm/s2", "--quiet", "--json"])
except SystemExit as end:
    print(end.code or 0, 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr)
"""

SHORTER, LONGER = 1_500_000, 3_000_000
"""Samples of each of three components: two hours and four at 200 Hz; below a million, pieces are not yet smaller than the whole."""

BYTES = 90.0
"""Of each sample of three components, 24 of which are the record itself: 1.5 GB for a day; it was 294."""


def written(path, samples):
    """Write a miniSEED of three components: a burst of shaking among noise of some counts."""
    dice = np.random.default_rng(samples)
    place = np.arange(samples)
    burst = 3000.0 * np.exp(-(((place - samples / 2) / 4000.0) ** 2)) * np.sin(0.0628 * place)
    stream = obspy.Stream()
    for letter in "NEZ":
        header = {"station": "DAY", "channel": f"HN{letter}", "delta": 0.005, "starttime": obspy.UTCDateTime(2020, 1, 1)}
        stream.append(obspy.Trace((burst + dice.integers(-3, 4, samples)).astype(np.int32), header))
    stream.write(str(path), format="MSEED", encoding="STEIM2")
    return path


def test_memory_per_sample_of_measure(tmp_path):
    """The slope between two lengths, in processes of their own: what imports and buffers cost cancels out."""
    peaks = []
    for samples in (SHORTER, LONGER):
        path = written(tmp_path / f"{samples}.mseed", samples)
        done = subprocess.run([sys.executable, "-c", MEASURE, str(path)], capture_output=True, text=True, check=True)
        code, peak = done.stderr.splitlines()[-1].split()
        assert code == "0"
        peaks.append(float(peak))
    assert (peaks[1] - peaks[0]) / (LONGER - SHORTER) < BYTES


def test_a_corner_that_would_take_gigabytes_is_refused():
    """A high-pass of 1e-6 Hz pads by a month: refused with the number and the corner that is possible."""
    with pytest.raises(ParameterError, match=r"samples of padding .* choose a corner of"):
        highpass(read(sample_path("synthetic_jma.csv")), 1e-6)
