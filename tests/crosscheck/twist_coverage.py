"""Coverage of the interval of ``infer --twist``: ``python -m tests.crosscheck.twist_coverage``.

Each case draws a stone, friction and a synthetic record (none of the package's tests), a factor log-uniform between rest and overturning,
and the true stone around the nominal one; the residual twist, read with the error of a survey, is inverted. Objects that overturn, do not
move, or whose reading is below a degree are not surveyed. Nine in ten intervals of 90 % should hold the factor.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.stats import binomtest

from seisblock import Block, Motion, motion_of
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.records import synthetic_suite
from seisblock.studies.sampling import ParameterVariation, draw_samples, rigid3d_outcomes
from seisblock.studies.survey.twist import LEAST_FACTOR, MIN_TWIST_ERROR_DEG, TWIST_ERROR, infer_twist

MIN_TWIST_DEG = 1.0
"""Smallest twist that is surveyed, degrees."""
LIMIT = 3.0
"""Largest factor of the prior."""
WINDOW_S = 10.0
"""Strong part of the record that is used, s."""
FACTORS = 8
"""Factors that are tried at once to find one that twists the object."""


@dataclass(frozen=True)
class Case:
    """True and read twist, true factor, the interval and its median; None without an interval."""

    true_deg: float
    twist_deg: float
    scale: float
    bounds: tuple[float, float] | None
    median: float | None

    @property
    def is_covered(self) -> bool:
        """True if the interval holds the factor."""
        return self.bounds is not None and self.bounds[0] <= self.scale <= self.bounds[1]


def strong_part(motion: Motion) -> Motion:
    """Return the window around the largest acceleration."""
    peak = int(np.argmax(np.abs(motion.horizontal)))
    count = round(WINDOW_S / motion.dt)
    first = max(peak - count // 3, 0)
    return Motion(np.ascontiguousarray(motion.acceleration[:, first : first + count]), motion.dt, motion.name, 0.0, motion.record)


def coverage_cases(number: int, seed: int, runs: int, *, displacement: bool = False) -> Iterator[Case]:
    """Yield cases until `number` objects were surveyed."""
    rng = np.random.default_rng(seed)
    done = 0
    while done < number:
        width = float(rng.uniform(0.2, 0.5))
        block = Block(width, width * float(rng.uniform(1.8, 3.5)), width * float(rng.uniform(0.7, 1.4)))
        record = synthetic_suite(float(rng.choice([6.0, 6.5, 7.0])), float(rng.uniform(8.0, 30.0)), 1, seed=int(rng.integers(1 << 30)))[0]
        motion = strong_part(motion_of(record, "NS"))
        peak = float(np.abs(motion.acceleration[:2]).max())
        # the record is scaled so that factors of the prior reach from rest to overturning
        factor = 1.2 * 9.80665 * width / block.height / peak
        motion = Motion(factor * motion.acceleration, motion.dt, motion.name, 0.0, motion.record)
        options = Rigid3dOptions(mu=float(rng.uniform(0.3, 0.8)), settle_s=5.0)
        scales = LEAST_FACTOR * (LIMIT / LEAST_FACTOR) ** rng.uniform(size=FACTORS)
        draws = draw_samples(FACTORS, int(rng.integers(1 << 30)))
        outcomes = rigid3d_outcomes(block, motion, options, draws, ParameterVariation(amplitude=0.0), scales=scales)
        for scale, outcome in zip(scales.tolist(), outcomes, strict=True):
            if outcome is None or outcome.overturned or not outcome.moved:
                continue
            twist = abs(outcome.twist_deg)
            measured = abs(twist + max(TWIST_ERROR * twist, MIN_TWIST_ERROR_DEG) * float(rng.normal()))
            if not MIN_TWIST_DEG <= measured <= 180.0:
                continue
            place = math.hypot(*outcome.final_displacement_m) if displacement else None
            estimate = infer_twist(
                block, motion, options, measured, displacement_m=place, limit=LIMIT, runs=runs, seed=int(rng.integers(1 << 30))
            )
            interval = estimate.scale
            done += 1
            yield Case(
                twist,
                measured,
                scale,
                None if interval is None else (interval.low, interval.high),
                None if interval is None else interval.median,
            )
            break


def main() -> None:
    """Print every case and the coverage."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=60)
    parser.add_argument("--seed", type=int, default=41)
    parser.add_argument("--runs", type=int, default=300)
    parser.add_argument("--displacement", action="store_true", help="with the residual displacement, read without error")
    arguments = parser.parse_args()
    results = []
    for case in coverage_cases(arguments.cases, arguments.seed, arguments.runs, displacement=arguments.displacement):
        results.append(case)
        print(case, case.is_covered, flush=True)
    answered = [case for case in results if case.bounds is not None]
    hits = sum(case.is_covered for case in answered)
    low, high = binomtest(hits, len(answered)).proportion_ci(0.9)
    below = sum(case.bounds is not None and case.scale < case.bounds[0] for case in answered)
    print(f"{len(answered)} of {len(results)} have an interval; {hits} hold the factor ({low:.2f} to {high:.2f}), {below} lie below it")


if __name__ == "__main__":
    main()
