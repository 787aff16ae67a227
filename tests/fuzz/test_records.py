"""Files of every format, spoilt in every way that disks, editors and networks know: a record, or one sentence, and no silent nonsense.

``pytest tests/fuzz --fuzz 100`` spoils a hundred times as many; ``--fuzz-from`` begins at another seed.
"""

from __future__ import annotations

import time

import numpy as np
import pytest

from seisblock.core.errors import InputError
from seisblock.readers import read
from tests.fuzz.accidents import spoil
from tests.fuzz.formats import FORMATS

pytestmark = pytest.mark.slow

VALUES = 60
SEALED = {"zip", "tar.gz", "xlsx"}
"""Checksums tell of almost all accidents."""

SLOWEST_S = 10.0
LONGEST_MESSAGE = 1500
TALLER = 5.0
"""A peak that grew by more than this has a sample in it that anyone would see."""


@pytest.mark.parametrize("kind", FORMATS)
def test_damaged_record_gives_record_or_one_error(kind, seeds, tmp_path):
    """A record that its file does not contradict, or one sentence of ours, in a moment."""
    full = FORMATS[kind]
    path = tmp_path / "spoilt"
    path.write_bytes(full.data)
    before = read(path, **full.options)
    settled = {doubt.kind for doubt in before.doubts}
    peak = max(float(np.abs(c.acceleration).max()) for c in before.components)
    met = {"refused": 0, "doubted": 0, "believed": 0}
    for seed in seeds(VALUES):
        data = spoil(full.data, np.random.default_rng((seed, len(kind))))
        path.write_bytes(data)
        start = time.process_time()
        try:
            record = read(path, **full.options)
        except InputError as error:
            assert "spoilt" in str(error), seed
            assert "\n" not in str(error) and len(str(error)) < LONGEST_MESSAGE, seed
            met["refused"] += 1
            continue
        finally:
            assert time.process_time() - start < SLOWEST_S, seed
        if {doubt.kind for doubt in record.doubts} - settled:
            met["doubted"] += 1
            continue
        met["believed"] += 1
        assert (reason := full.judge(data, record)) == "", (seed, reason)
        taller = max(float(np.abs(c.acceleration).max()) for c in record.components) / peak
        assert taller < TALLER, (seed, f"the peak grew by a factor of {taller:g} without a word")
    assert met["refused"] > 0, met
    assert met["believed"] + met["doubted"] > 0 or kind in SEALED, met
