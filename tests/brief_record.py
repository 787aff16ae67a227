"""The bundled record cut to its strong motion, for tests that do not depend on its length."""

from seisblock.samples import sample_path

HEADER_LINES, RATE_HZ = 7, 100
SHAKING_S = 25, 28
"""The strongest shaking, which overturns gravestones and lets two-layer blocks jump."""


def brief_record() -> bytes:
    """Return the file of the bundled record, JMA layout, cut to these seconds."""
    lines = sample_path("synthetic_jma.csv").read_bytes().splitlines(keepends=True)
    begin, end = (HEADER_LINES + RATE_HZ * second for second in SHAKING_S)
    return b"".join(lines[:HEADER_LINES] + lines[begin:end])
