"""Text files as editors, mail programs and old computers leave them are read as they were, in every format."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.readers import read
from tests.fuzz.formats import FORMATS
from tests.readers.format_trials import BINARY, VARIANTS

TEXTS = [kind for kind in FORMATS if kind not in BINARY]


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("kind", TEXTS)
def test_variants_of_text_files_are_read_alike(kind, variant, tmp_path):
    """Samples, interval, start and flags; files with bytes that are no UTF-8 are not re-encoded."""
    if (kind, variant) == ("jma", "no line end"):
        pytest.skip("files of JMA end with a line end: without it, the last number may be incomplete")
    example, path = FORMATS[kind], tmp_path / "record"
    path.write_bytes(example.data)
    expected = read(path, **example.options)
    try:
        path.write_bytes(VARIANTS[variant](example.data))
    except UnicodeDecodeError:
        return
    record = read(path, **example.options)
    assert (record.codes, record.dt, record.start, record.doubts) == (expected.codes, expected.dt, expected.start, expected.doubts)
    for component, other in zip(record.components, expected.components, strict=True):
        np.testing.assert_array_equal(component.acceleration, other.acceleration)
