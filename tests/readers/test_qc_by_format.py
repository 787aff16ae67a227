"""Quality checks in every format: the same motion, damaged in the same ways."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.core.errors import InputError
from seisblock.readers import read
from seisblock.records import Preparation
from tests.fuzz.formats import OPTIONS, ROWS, WRITERS

MIDDLE = 310
"""A sample in the strongest part of every component."""


def damage_each(change):
    """Make a damage of each component."""

    def damage(rows):
        items = [row.copy() for row in rows]
        for row in items:
            change(row)
        return items

    return damage


def _clip(row):
    row.clip(0.5 * row.min(), 0.5 * row.max(), out=row)


def _spike(row):
    row[MIDDLE] += 3000.0


def _gap(row):
    row[MIDDLE : MIDDLE + 25] = 0.0


def _hold(row):
    first = MIDDLE + int(np.flatnonzero(np.abs(row[MIDDLE:]) < 0.4 * np.abs(row).max())[0])
    row[first : first + 25] = row[first]


def _offset(row):
    row += 60.0


def _enlarge(row):
    row *= 70.0


CARRY_OFFSET = ("knet", "kiknet", "knet-csv", "tar", "tar.gz", "zip", "phone")
"""Formats of instruments whose offset is no defect: counts about a resting level, and gravity in a telephone."""

SAMPLES_DAMAGED = {"clipped": _clip, "spike": _spike, "held": _gap, "held too": _hold, "offset": _offset, "size": _enlarge}


def kinds_found(data, kind, tmp_path):
    """Return the kinds of doubt about a file, `refused` where it is."""
    path = tmp_path / "damaged"
    path.write_bytes(data)
    try:
        return {doubt.kind for doubt in read(path, **OPTIONS.get(kind, {})).doubts}
    except InputError:
        return {"refused"}


@pytest.mark.parametrize("damage", SAMPLES_DAMAGED)
@pytest.mark.parametrize("kind", WRITERS)
def test_sample_defects_are_flagged_in_every_format(kind, damage, tmp_path):
    """Flat peaks, lone spikes, gaps filled with zeros or the last value, offsets that are not the instrument's, more than 5 g."""
    data = WRITERS[kind](damage_each(SAMPLES_DAMAGED[damage])(ROWS))
    target = kinds_found(data, kind, tmp_path)
    assert bool(target & {damage.split()[0], "refused"}) != (damage == "offset" and kind in CARRY_OFFSET)


@pytest.mark.parametrize("kind", CARRY_OFFSET)
def test_offset_of_an_instrument_is_removed_and_named(kind, tmp_path):
    """It changes no sample of the prepared record, and the history gives its size."""
    records = []
    for name, rows in (("whole", ROWS), ("offset", damage_each(_offset)(ROWS))):
        (tmp_path / name).write_bytes(WRITERS[kind](rows))
        records.append(Preparation().apply(read(tmp_path / name)))
    full, offset = records
    assert any("mean" in str(step) for step in offset.history)
    for a, b in zip(full.components, offset.components, strict=True):
        # K-NET prints whole counts, its CSV hundredths of a gal
        np.testing.assert_allclose(a.acceleration, b.acceleration, rtol=0, atol=2e-4)


def _lines(change):
    """Make a damage of the lines of a text."""

    def damage(data):
        lines = data.splitlines(keepends=True)
        change(lines)
        return b"".join(lines)

    return damage


def _lose(lines):
    del lines[-90]


def _repeat(lines):
    lines.insert(-90, lines[-90])


LINES_DAMAGED = {
    "cut in the last number": lambda data: data.rstrip()[:-2],
    "cut in a number": lambda data: data[: data.find(b".", 2 * len(data) // 3) + 2] if b"." in data[-9:] else data[: 2 * len(data) // 3],
    "a line lost": _lines(_lose),
    "a line twice": _lines(_repeat),
    "the last line lost": _lines(list.pop),
}
SILENT = {("one column", "a line lost"), ("one column", "a line twice"), ("one column", "the last line lost")}
"""A column of bare numbers with a complete last line has no flag."""

BARE = {
    ("comma", "the last line lost"),
    ("blank", "the last line lost"),
    ("semicolon", "the last line lost"),
    ("clock", "the last line lost"),
    ("phone", "the last line lost"),
}
"""So does a table with a clock that ends with a whole line: it is a shorter record."""

TEXTS = sorted(set(WRITERS) - {"mseed", "sac", "tar", "tar.gz", "zip"})


@pytest.mark.parametrize("damage", LINES_DAMAGED)
@pytest.mark.parametrize("kind", TEXTS)
def test_line_defects_are_flagged_in_every_text_format(kind, damage, tmp_path):
    """A count against the header, a clock that stumbles, seconds that are not whole, an end without an end of line."""
    target = kinds_found(LINES_DAMAGED[damage](WRITERS[kind](ROWS)), kind, tmp_path)
    assert bool(target - {"directions"}) != ((kind, damage) in SILENT | BARE), target


@pytest.mark.parametrize("kind", ["mseed", "sac", "tar", "tar.gz", "zip"])
@pytest.mark.parametrize("share", [0.3, 0.6, 0.9, 0.99])
def test_truncated_binary_file_is_flagged(kind, share, tmp_path):
    """A truncated download is flagged; zeros after the last member of a tar are not."""
    data = WRITERS[kind](ROWS).rstrip(b"\0" if kind == "tar" else b"")
    assert kinds_found(data[: int(share * len(data))], kind, tmp_path) - {"directions"}


TWICE = {"jma": (b"NS,EW,UD", b"NS,NS,UD"), "knet-csv": (b",N-S(gal),E-W(gal)", b",N-S(gal),N-S(gal)"), "comma": (b"EW (gal)", b"NS (gal)"),
         "blank": (b"ew_gal", b"ns_gal"), "semicolon": (b"N80W", b"N10E")}  # fmt: skip


@pytest.mark.parametrize("kind", TWICE)
def test_duplicate_columns_are_rejected_in_every_format(kind, tmp_path):
    """None of them is believed."""
    data, (name, second) = WRITERS[kind](ROWS), TWICE[kind]
    assert name in data
    assert kinds_found(data.replace(name, second), kind, tmp_path) == {"refused"}


def test_jma_record_without_whole_seconds_is_flagged(tmp_path):
    """JMA publishes whole seconds: 599 samples at 100 Hz have lost one."""
    lines = WRITERS["jma"](ROWS).splitlines(keepends=True)
    assert kinds_found(b"".join(lines[:-1]), "jma", tmp_path) == {"count"}
    assert kinds_found(b"".join(lines), "jma", tmp_path) == set()
