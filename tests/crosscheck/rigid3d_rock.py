"""A scanned granite rock on a shaking table: ``python -m tests.crosscheck.rigid3d_rock DIR``.

DIR holds files made from the repository `virtual_shake_robot_pybullet` (GPL-3, hence not in this repository): the scan
``granite_rock_1.obj``, the outcomes ``granite_rock_1.csv`` (columns run, overturned) and the motions ``shake_table_motions.npz``
(``run011`` ...: acceleration of the table, m/s^2, dt 0.005 s). The table moves along +x of the scan.

Friction 0.6, plastic impacts and the hull of the scan are fixed in advance; nothing is fitted to the outcomes. ``--planar`` runs the
planar block of the scan, ``--mu`` and ``--restitution`` show what the choice matters.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from seisblock import Motion, solve_rigid3d, solve_rock
from seisblock.bodies import scan_body
from seisblock.core.typing import FloatArray

DT = 0.005
MU = 0.6
MASS = 353.8


@dataclass(frozen=True)
class Score:
    """Runs, those predicted right, missed overturns and false alarms."""

    runs: int
    missed: int
    false_alarms: int

    @property
    def accuracy(self) -> float:
        """Share of the runs that are right."""
        return 1.0 - (self.missed + self.false_alarms) / self.runs


def outcomes(folder: Path) -> dict[int, bool]:
    """Return whether the rock overturned in each run."""
    with (folder / "granite_rock_1.csv").open(encoding="utf-8") as file:
        return {int(row["run"]): row["overturned"] == "1" for row in csv.DictReader(file)}


def motions(folder: Path) -> dict[int, FloatArray]:
    """Return the acceleration of the table of each run, m/s^2."""
    with np.load(folder / "shake_table_motions.npz") as archive:
        return {int(name.removeprefix("run")): np.asarray(archive[name], dtype=np.float64) for name in archive.files}


def score(folder: Path, overturns: Callable[[Motion], bool], every: int = 4) -> Score:
    """Compare a predictor with every n-th run."""
    observed, shaking = outcomes(folder), motions(folder)
    runs = sorted(observed)[::every]
    missed = false_alarms = 0
    for run in runs:
        rows = np.zeros((3, shaking[run].size))
        rows[0] = shaking[run]
        predicted = overturns(Motion(rows, DT))
        missed += observed[run] and not predicted
        false_alarms += predicted and not observed[run]
    return Score(len(runs), missed, false_alarms)


def pgv(motion: Motion) -> float:
    """Return the largest velocity of the table, m/s."""
    return float(np.abs(np.cumsum(motion.horizontal) * motion.dt).max())


def main() -> None:
    """Print the score of the chosen model."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--every", type=int, default=4, help="every n-th run")
    parser.add_argument("--mu", type=float, default=MU)
    parser.add_argument("--restitution", type=float, default=0.0)
    parser.add_argument("--planar", action="store_true", help="the planar block of the scan")
    parser.add_argument("--flip", action="store_true", help="the table moves along -x")
    arguments = parser.parse_args()
    scan = scan_body(str(arguments.folder / "granite_rock_1.obj"))
    body = scan.body

    def overturns(motion: Motion) -> bool:
        if arguments.planar:
            return solve_rock(body.block_toward(body.facing), motion).outcome.overturned
        return solve_rigid3d(body, motion, mu=arguments.mu, restitution=arguments.restitution).outcome.overturned

    result = score(arguments.folder, overturns, arguments.every)
    print(f"{result.runs} runs: {result.accuracy:.3f} right, {result.missed} missed, {result.false_alarms} false alarms")


if __name__ == "__main__":
    main()
