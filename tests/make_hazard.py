"""Make sample_records/synthetic_hazard.csv again: ``python -m tests.make_hazard``."""

from __future__ import annotations

import hashlib

import numpy as np

from seisblock.samples import sample_directory

NAME = "synthetic_hazard.csv"

BRANCHES = (("often", 0.6, 0.08, 1.15, 0.55), ("rare", 0.4, 0.03, 1.05, 0.65))
"""Name, weight, annual frequency of 5 cm/s, power with which it falls there, and the velocity, m/s, at which it falls e times faster."""

LEVELS = (0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.3, 1.6, 2.0)
"""PGV, m/s."""

HEADER = """\
# The hazard of a site in a country of earthquakes. SYNTHETIC: no place has it. Made by tests/make_hazard.py.
# How often a peak ground velocity, in m/s, is exceeded, 1/year; two branches of a logic tree.
"""


def make() -> str:
    """Return the file's text."""
    v = np.array(LEVELS)
    lines = ["branch,weight,pgv_m_s,annual_rate"]
    for name, weight, first, power, bend in BRANCHES:
        rates = first * (v / v[0]) ** -power * np.exp(-(v - v[0]) / bend)
        lines += [f"{name},{weight:g},{level:g},{rate:.3e}" for level, rate in zip(LEVELS, rates, strict=True)]
    return HEADER + "\n".join(lines) + "\n"


def main() -> None:
    """Write the file; its digest belongs into MANIFEST.toml."""
    data = make().encode()
    (sample_directory() / NAME).write_bytes(data)
    print(f"{NAME}: {hashlib.sha256(data).hexdigest()}")


if __name__ == "__main__":
    main()
