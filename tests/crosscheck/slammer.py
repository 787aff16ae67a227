"""Rigid sliding analyses of USGS SLAMMER: ``python -m tests.crosscheck.slammer SLAMMER_results.xlsx``.

The file is `tests/SLAMMER_results.xlsx` of the repository of pySLAMMER (GPL-3, hence not in this repository): displacements that SLAMMER
1.1 computed for the records that pySLAMMER ships, scaled to a PGA, in both polarities.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from seisblock import Motion, SlidingBase, solve_slide
from tests.crosscheck.test_slide import G, pyslammer_motion

Analysis = tuple[str, float, float]
"""Record, yield acceleration and PGA, g."""


def published(path: Path) -> dict[Analysis, tuple[float, float]]:
    """Return the displacements of SLAMMER in both polarities, cm; flexible analyses repeat the rigid ones."""
    import openpyxl

    rows = openpyxl.load_workbook(path, data_only=True).worksheets[0].iter_rows(values_only=True)
    names = next(rows)
    result = {}
    for values in rows:
        row = dict(zip(names, values, strict=True))
        record = f"{row['Earthquake']}_{row['Record']}".replace(" ", "_").replace(".", "").replace(",", "")
        result[record, row["ky (g)"], row["Scale"]] = row["Rigid Normal (cm)"], row["Rigid Inverse (cm)"]
    return result


def computed(record: str, yield_g: float, pga_g: float) -> tuple[float, float]:
    """Return one-way displacements in both polarities, cm."""
    acceleration, dt = pyslammer_motion(record)
    scaled = acceleration * pga_g / np.abs(acceleration).max()
    base = SlidingBase(yield_g, one_way=True)
    signs = -G, G
    normal, inverse = (100.0 * solve_slide(base, Motion.from_arrays(sign * scaled, dt)).outcome.residual_slip_m for sign in signs)
    return abs(normal), abs(inverse)


def finely_sampled(record: str, yield_g: float, pga_g: float) -> tuple[float, float]:
    """Return the displacements of pySLAMMER, cm, whose step is that of SLAMMER, on the record with 64 samples for one."""
    import pyslammer

    acceleration, dt = pyslammer_motion(record)
    samples = np.arange(acceleration.size)
    fine = np.interp(np.linspace(0.0, samples[-1], 64 * samples[-1] + 1), samples, acceleration * pga_g / np.abs(acceleration).max())
    motions = [pyslammer.GroundMotion(sign * fine, dt / 64, record) for sign in (1.0, -1.0)]
    normal, inverse = (100.0 * float(pyslammer.RigidAnalysis(ky=yield_g, ground_motion=motion).max_sliding_disp) for motion in motions)
    return normal, inverse


def main() -> None:
    """Print how many displacements agree, the slope of the regression line through the origin, and the effect of the time step."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    results = published(parser.parse_args().file)
    theirs, ours = np.array(list(results.values())), np.array([computed(*analysis) for analysis in results])
    for tolerance in (0.02, 0.05):
        close = np.abs(ours - theirs) <= tolerance * theirs
        print(f"{close.sum()} of {theirs.size} displacements within {tolerance:.0%}")
    print(f"slope {theirs.ravel() @ ours.ravel() / (theirs.ravel() @ theirs.ravel()):.4f}")
    close = np.abs(ours - theirs) <= 0.02 * theirs
    finer = np.array([values if close[k].all() else finely_sampled(*analysis) for k, (analysis, values) in enumerate(results.items())])
    agree = np.abs(ours - finer)[~close] <= 0.01 * finer[~close]
    print(f"of the {agree.size} beyond 2 % {agree.sum()} agree within 1 % with pySLAMMER on the record with 64 samples for one")
    for (record, *_), their, our, fine in zip(
        np.repeat(list(results), 2, axis=0)[~close.ravel()], theirs[~close], ours[~close], finer[~close], strict=True
    ):
        print(f"  {record:30} {their:9.5f} cm, here {our:9.5f}, pySLAMMER fine {fine:9.5f}")


if __name__ == "__main__":
    main()
