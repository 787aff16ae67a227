"""Make sample_records/aoyama.csv again: ``python -m tests.make_aoyama``.

The survey of 100 stones at Aoyama behind figs. 14 and 15 of Furukawa et al. (2009) was never printed as numbers. What is
printed are the rates that table 6 reads off its cumulative distribution, which pin the number of stones above eight ratios H/B. The
stones below the lowest of them are a guess: wagata stones are mostly 2.2 to 2.8 times as high as wide.
"""

from __future__ import annotations

import hashlib
import tomllib

import numpy as np

from seisblock.samples import MANIFEST, sample_directory
from tests.make_sample_records import manifest

NAME = "aoyama.csv"

PINNED = {2.84: 35, 3.35: 20, 3.61: 10, 3.84: 10, 4.27: 8, 5.03: 5, 5.27: 4, 5.76: 2}
"""H/B thresholds of table 6, from eqs. (9) and (10), and how many of 100 stones lie above; the first four are rounded to 5."""

STRETCHES = (
    (1.30, 2.20, 12),
    (2.20, 2.50, 24),
    (2.50, 2.79, 29),  # not pinned
    (2.89, 3.05, 7),
    (3.05, 3.31, 8),
    (3.39, 3.58, 10),
    (3.90, 4.22, 2),
    (4.35, 4.95, 3),
    (5.15, 5.15, 1),
    (5.45, 5.65, 2),
    (5.95, 6.35, 2),
)
"""Ranges of H/B, clear of the thresholds by more than their rounding, and how many stones lie in each."""

WIDTHS_SUN = (8.0, 8.0, 9.0, 8.0, 7.0, 8.0, 10.0, 8.0, 9.0, 6.0)
"""Widths of wagata stones, in turn; 8 sun is the stone of table 1."""

SLENDER_FROM = 3.9
"""From this ratio on stones are 5 to 7 sun wide: wider ones would stand more than 1.3 m high on their pile."""

HEADER = """\
# Top stones (sao) of 100 gravestones at Aoyama cemetery, Tokyo. RECONSTRUCTED, not measured.
# The survey of Furukawa, Otsuka, Miwa and Ono (2009), figs. 14 and 15, is not published as numbers. The rates of their table 6 give
# the share of stones above H/B 2.84, 3.35, 3.61, 3.84, 4.27, 5.03, 5.27 and 5.76 as 0.35, 0.20, 0.10, 0.10, 0.08, 0.05, 0.04, 0.02
# (the first four rounded to 0.05), and this file has them. Below 2.84 nothing is known: those 65 stones, and all widths, are a guess.
# Made by tests/make_aoyama.py. 1 sun = 30.3 mm; none of the stones is reinforced.
"""


def ratios() -> list[float]:
    """Return 100 ratios, spread evenly over each stretch."""
    return [float(value) for low, high, count in STRETCHES for value in low + (high - low) * (np.arange(count) + 0.5) / count]


def make() -> str:
    """Return the file's text: heights to a tenth of a sun, in an order that mixes slender and stout."""
    rows = []
    for index, ratio in enumerate(ratios()):
        width = WIDTHS_SUN[index % 10] if ratio < SLENDER_FROM else (6.0, 5.0, 7.0)[index % 3]
        height = round(ratio * width, 1)
        rows.append((round(height / width, 4), height, width))
    order = [(37 * i) % 100 for i in range(100)]
    lines = [f"{i},{rows[k][0]:.4f},{rows[k][1]:.1f},{rows[k][2]:.0f}" for i, k in enumerate(order, start=1)]
    return HEADER + "stone,height_over_width,height (sun),width (sun)\n" + "\n".join(lines) + "\n"


def main() -> None:
    """Write the file and its entry in the manifest."""
    data = make().encode()
    (sample_directory() / NAME).write_bytes(data)
    path = sample_directory() / MANIFEST
    about: dict[str, object] = {
        "kind": "cemetery",
        "description": "100 gravestones of Aoyama cemetery, reconstructed from published overturning rates",
        "origin": "tests/make_aoyama.py: reconstructed, NOT measured; fractions above eight values of H/B from table 6 of "
        "Furukawa et al. (2009), the rest assumed",
        "licence": "MIT, as seisblock",
    }
    before = path.read_text(encoding="utf-8")
    text = manifest({NAME: (data, about)}, before)
    remaining = [entry["name"] for entry in tomllib.loads(before)["sample"] if entry["name"] != NAME]
    head, *entries = text.split("\n[[sample]]\n")
    mapping = {tomllib.loads(entry)["name"]: entry for entry in entries}
    ordered = [mapping[name].rstrip("\n") + "\n" for name in (*remaining, NAME)]
    path.write_text("\n[[sample]]\n".join([head, *ordered]), encoding="utf-8")
    print(f"{NAME}: {hashlib.sha256(data).hexdigest()}")


if __name__ == "__main__":
    main()
