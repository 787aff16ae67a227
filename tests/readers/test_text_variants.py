"""Text files as editors, mail programs and old computers leave them are read as they were, in every format."""

from __future__ import annotations

import re

import numpy as np
import pytest

from seisblock.readers import read
from tests.fuzz.formats import FORMATS

TEXTS = [kind for kind in FORMATS if kind not in ("sac", "mseed", "xlsx", "tar", "tar.gz", "zip")]

VARIANTS = {
    "CR LF": lambda data: re.sub(rb"\r?\n", b"\r\n", data),
    "CR": lambda data: re.sub(rb"\r?\n", b"\r", data),
    "byte order mark": lambda data: b"\xef\xbb\xbf" + data.removeprefix(b"\xef\xbb\xbf"),
    "UTF-16": lambda data: data.removeprefix(b"\xef\xbb\xbf").decode().encode("utf-16"),
    "DOS end of file": lambda data: data + b"\x1a",
    "blank lines": lambda data: data + b"\n\n\n",
    "no line end": lambda data: data.rstrip(b"\r\n"),
    "blanks at line ends": lambda data: re.sub(rb"(\r?\n)", rb"  \1", data),
    "no blanks at line ends": lambda data: re.sub(rb"[ \t]+(\r?\n)", rb"\1", data),
}


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
