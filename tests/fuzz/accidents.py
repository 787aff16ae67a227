"""Random damage of files as by disks, editors, spreadsheets and networks: one to three kinds, seeded."""

from __future__ import annotations

import numpy as np

TEXT = [
    b"",
    b"\n",
    b",",
    b" ",
    b"nan",
    b"-1e999",
    b"1e300",
    b"\x00",
    b"\xff\xfe",
    b"#",
    b'"',
    b"=",
    b"0",
    b"x",
    b"-",
    b".",
    b"\x1b[31m",
    b"9" * 400,
]
HEAD = 700
"""Bytes that are met more often than their share: headers."""


def spoil(data: bytes, rng: np.random.Generator) -> bytes:
    """Return bytes after one to three accidents."""
    for _ in range(rng.integers(1, 4)):
        data = ACCIDENTS[rng.integers(len(ACCIDENTS))](data, rng)
    return data


def _place(data, rng):
    """Return a place, more often in the header than its length would have it."""
    return int(rng.integers(0, max(len(data), 1)) if rng.random() < 0.6 else rng.integers(0, min(max(len(data), 1), HEAD)))


def _lines(change):
    """Make an accident of lines."""

    def accident(data, rng):
        lines = data.split(b"\n")
        change(lines, int(rng.integers(0, len(lines))), rng)
        return b"\n".join(lines)

    return accident


def _lose_line(lines, i, rng):
    del lines[i]


def _repeat_line(lines, i, rng):
    lines.insert(i, lines[i])


def _swap_lines(lines, i, rng):
    j = int(rng.integers(0, len(lines)))
    lines[i], lines[j] = lines[j], lines[i]


def _blank_line(lines, i, rng):
    lines[i] = b""


def _cut(data, rng):
    return data[: _place(data, rng)]


def _lose(data, rng):
    i = _place(data, rng)
    return data[:i] + data[i + int(rng.integers(1, 40)) :]


def _insert(data, rng):
    i = _place(data, rng)
    return data[:i] + TEXT[rng.integers(len(TEXT))] + data[i:]


def _flip_bit(data, rng):
    i = _place(data, rng)
    return data[:i] + bytes([data[i] ^ (1 << int(rng.integers(8)))]) + data[i + 1 :] if data else data


def _change_digit(data, rng):
    places = [i for i in (_place(data, rng) for _ in range(30)) if data[i : i + 1].isdigit()]
    return data[: places[0]] + str(rng.integers(10)).encode() + data[places[0] + 1 :] if places else data


def _lose_point(data, rng):
    i = data.find(b".", _place(data, rng))
    return data if i < 0 else data[:i] + data[i + 1 :]


def _append_itself(data, rng):
    return data + data[-int(rng.integers(1, 400)) :]


ACCIDENTS = [
    _cut,
    _lose,
    _insert,
    _flip_bit,
    _change_digit,
    _change_digit,
    _lose_point,
    _append_itself,
    *map(_lines, (_lose_line, _repeat_line, _swap_lines, _blank_line)),
]
