"""PySGM-jp, written by others, reads the JMA and K-NET samples to the same samples and the same start."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from PySGM import jma as pysgm_jma
from PySGM import nied as pysgm_nied

from seisblock.readers import read
from seisblock.samples import sample_path

JST = timedelta(hours=9)


def same(record, theirs):
    """Check samples, in gal, and the start, in JST."""
    started = datetime.strptime(theirs.header["record_time"], "%Y/%m/%d %H:%M:%S").replace(tzinfo=UTC)
    assert record.start + JST == started
    assert record.samples == theirs.header["ntim"]
    for code, values in (("NS", theirs.ns), ("EW", theirs.ew), ("UD", theirs.ud)):
        np.testing.assert_allclose(100.0 * record.component(code).acceleration, values, rtol=1e-13, atol=1e-13)


def test_jma_csv_equals_pysgm():
    """The JMA layout: PySGM-jp's own parser takes the synthetic file, so its layout is right, and agrees to round-off."""
    theirs = pysgm_jma.jma()
    theirs.csv_parse(str(sample_path("synthetic_jma.csv")))
    same(read("synthetic_jma.csv"), theirs)


def test_knet_ascii_equals_pysgm():
    """The K-NET layout: three files, offset kept by both, 15 s taken off by both."""
    theirs = pysgm_nied.nied()
    theirs.knet_parse(str(sample_path("synthetic_knet.NS")).removesuffix(".NS"))
    record = read("synthetic_knet")
    same(record, theirs)
    assert theirs.header["code"] == record.station
    assert record.metadata["header_max_gal"]["NS"] == pytest.approx(np.abs(theirs.ns - theirs.ns.mean()).max(), abs=1e-3)
