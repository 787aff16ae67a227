"""Forty kinds of damage to a table of recorded motion: the share that is refused or flagged, and false alarms on sound tables."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.core.errors import InputError
from seisblock.readers import read, read_all

DT = 0.005


def _base():
    """Return the strong part of a recorded motion, (n, 3), gal, rounded to 0.001 gal."""
    record = read("shafter_1989.zip")
    return np.round(100.0 * np.array([c.acceleration for c in record.components]).T[:4000], 3)


def _replace(rows, start, values, column=0):
    out = rows.copy()
    out[start : start + len(values), column] = values
    return out


def _scaled(rows, start, count, factor):
    return _replace(rows, start, factor * rows[start : start + count, 0])


def _cut(rows, start, count):
    """Remove samples without a trace in the times."""
    return np.delete(rows, np.arange(start, start + count), axis=0)


def _clipped(rows, low, high):
    out, peak = rows.copy(), np.abs(rows[:, 0]).max()
    out[:, 0] = np.clip(out[:, 0], low * peak, high * peak)
    return out


def _added(rows, values):
    return rows + np.column_stack([values, 0.0 * values, 0.0 * values])


SAMPLES = {
    "20 samples overwritten by earlier ones": lambda r, i: _replace(r, i, r[i - 300 : i - 280, 0]),
    "1 s overwritten by earlier samples": lambda r, i: _replace(r, i, r[i - 400 : i - 200, 0]),
    "1 s overwritten in all components": lambda r, i: np.concatenate([r[:i], r[i - 200 : i], r[i + 200 :]]),
    "1 s inserted twice": lambda r, i: np.concatenate([r[:i], r[i - 200 : i], r[i:]]),
    "file appended to itself": lambda r, i: np.concatenate([r, r]),
    "zeros for 0.25 s": lambda r, i: _replace(r, i, np.zeros(50)),
    "zeros for 2 s": lambda r, i: _replace(r, i, np.zeros(400)),
    "value held for 0.25 s": lambda r, i: _replace(r, i, np.full(50, r[i, 0])),
    "value held for 1 s": lambda r, i: _replace(r, i, np.full(200, r[i, 0])),
    "value held to the end": lambda r, i: _replace(r, i, np.full(len(r) - i, r[i, 0])),
    "clipped at half the peak": lambda r, i: _clipped(r, -0.5, 0.5),
    "clipped on one side at 0.6 of the peak": lambda r, i: _clipped(r, -9.0, 0.6 * r[:, 0].max() / np.abs(r[:, 0]).max()),
    "all minus signs lost": lambda r, i: np.abs(r),
    "minus signs of a component lost": lambda r, i: _replace(r, 0, np.abs(r[:, 0])),
    "minus signs lost for 1 s": lambda r, i: _replace(r, i, np.abs(r[i : i + 200, 0])),
    "spike of three peaks": lambda r, i: _replace(r, i, [3.0 * np.abs(r).max()]),
    "spike of half the peak": lambda r, i: _replace(r, i, [r[i, 0] + 0.5 * np.abs(r).max()]),
    "spike at the start": lambda r, i: _replace(r, 0, [np.abs(r).max()]),
    "decimal point of a sample lost": lambda r, i: _replace(r, (k := i + int(np.abs(r[i : i + 200, 0]).argmax())), [1000.0 * r[k, 0]]),
    "sentinel 9999 in a sample": lambda r, i: _replace(r, i, [9999.0]),
    "sentinel -999 in ten samples": lambda r, i: _replace(r, i, np.full(10, -999.0)),
    "offset of a fifth of the peak": lambda r, i: _added(r, np.full(len(r), 0.2 * np.abs(r[:, 0]).max())),
    "step of the peak": lambda r, i: _added(r, np.abs(r[:, 0]).max() * (np.arange(len(r)) >= i)),
    "0.5 s lost": lambda r, i: _cut(r, i, 100),
    "polarity reversed for 1 s": lambda r, i: _scaled(r, i, 200, -1.0),
    "ten times too large for 1 s": lambda r, i: _scaled(r, i, 200, 10.0),
    "component given twice": lambda r, i: _replace(r, 0, r[:, 1]),
    "unit g given as m/s2 twice": lambda r, i: r * 981.0,
    "samples not finite": lambda r, i: _replace(r, i, np.full(3, np.nan)),
}


def _table(rows, *, head="time,NS (gal),EW (gal),UD (gal)", times=None):
    times = DT * np.arange(len(rows)) if times is None else times
    return "\n".join([head, *(f"{t:.9g}," + ",".join(f"{x:.3f}" for x in row) for t, row in zip(times, rows, strict=True))]) + "\n"


def _lines(rows, change):
    lines = _table(rows).splitlines()
    change(lines)
    return "\n".join(lines) + "\n"


def _set(lines, k, text):
    lines[k] = text


TEXTS = {
    "times in milliseconds": lambda r: _table(r, times=5.0 * np.arange(len(r))),
    "sample numbers for times": lambda r: _table(r, times=np.arange(len(r))),
    "times in days": lambda r: _table(r, times=45000.0 + DT / 86400.0 * np.arange(len(r))),
    "a line lost": lambda r: _lines(r, lambda lines: lines.pop(1500)),
    "two lines exchanged": lambda r: _lines(r, lambda lines: lines.insert(1500, lines.pop(1600))),
    "a line twice": lambda r: _lines(r, lambda lines: lines.insert(1500, lines[1500])),
    "a word for a number": lambda r: _lines(r, lambda lines: _set(lines, 1500, "7.495,n.a.,1.0,2.0")),
    "a row too short": lambda r: _lines(r, lambda lines: _set(lines, 1500, "7.495,1.0")),
    "a row too long": lambda r: _lines(r, lambda lines: _set(lines, 1500, "7.495,1.0,2.0,3.0,4.0")),
    "unknown unit": lambda r: _table(r, head="time,NS (furlong),EW (furlong),UD (furlong)"),
    "two columns of one name": lambda r: _table(r, head="time,NS (gal),NS (gal),UD (gal)"),
}

STARTS = (1000, 1700, 2400)
"""Samples at which damage begins: before the strong motion, in it, and after its peak."""

MISSED = {
    "minus signs lost for 1 s": 2,
    "0.5 s lost": 1,
    "polarity reversed for 1 s": 1,
    "ten times too large for 1 s": 1,
}
"""Damage without a flag, of three places each: where the motion is weak, the seams are no larger than its steps."""


def _verdict(directory, text):
    """Return "refused", the kinds of flags, or "clean"."""
    path = directory / "table.csv"
    path.write_text(text)
    try:
        (record,) = read_all([path])
    except InputError:
        return "refused"
    return ", ".join(sorted({flag.kind for flag in record.doubts})) or "clean"


@pytest.mark.slow
def test_damage_of_forty_kinds_is_refused_or_flagged(tmp_path):
    rows = _base()
    assert len(SAMPLES) + len(TEXTS) == 40
    verdicts = {name: [_verdict(tmp_path, _table(damage(rows, start))) for start in STARTS] for name, damage in SAMPLES.items()}
    verdicts |= {name: [_verdict(tmp_path, damage(rows))] for name, damage in TEXTS.items()}
    missed = {name: kinds.count("clean") for name, kinds in verdicts.items() if "clean" in kinds}
    assert all(count <= MISSED.get(name, 0) for name, count in missed.items()), missed
    # 93 of 98
    assert 1.0 - sum(missed.values()) / sum(map(len, verdicts.values())) >= 0.94


@pytest.mark.slow
def test_lost_minus_signs_of_a_second_are_found_in_half_of_the_places(tmp_path):
    """Any component, anywhere in the record; slow swings cross zero too rarely within a second to be noticed."""
    rows = _base()
    found = 0
    for column in range(3):
        for start in range(600, 3600, 200):
            damaged = _replace(rows, start, np.abs(rows[start : start + 200, column]), column)
            found += "sign" in _verdict(tmp_path, _table(damaged))
    # 25 of 45
    assert found >= 24


SOUND = {
    "as recorded": lambda r: r,
    "reversed polarity": lambda r: -r,
    "scaled": lambda r: 0.37 * r,
    "every second sample": lambda r: np.repeat(r[::2], 1, axis=0),
    "first 10 s": lambda r: r[:2000],
    "rounded to 0.1 gal": lambda r: np.round(r, 1),
    "components exchanged": lambda r: r[:, ::-1],
    "zeros before": lambda r: np.concatenate([np.zeros((400, 3)), r]),
}


@pytest.mark.parametrize("kind", SOUND)
def test_sound_table_has_no_flag(tmp_path, kind):
    assert _verdict(tmp_path, _table(SOUND[kind](_base()))) == "clean"
