"""What was seen: a block stood on the ground, the ground shook, and the block fell or stood; again and again, under many shakings."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.typing import FloatArray, IntArray
from seisblock.measures.baseline import ground_history
from seisblock.measures.peaks import peak_acceleration, peak_velocity
from seisblock.records import Motion
from seisblock.records._validation import validate_motion

FELL, MOVED = N_("fell"), N_("moved")


@dataclass(frozen=True, eq=False)
class Observation:
    """One outcome: what shook, and whether the block fell, or moved.

    Parameters
    ----------
    motion : Motion
    happened : bool
    weight : float, 1
        How often the outcome counts.
    scale : float, 1
        Factor on the motion.
    record : str
        Outcomes of one record are held out together; each is one of its own where this is empty.
    """

    motion: Motion
    happened: bool
    weight: float = 1.0
    scale: float = 1.0
    record: str = ""

    def __post_init__(self) -> None:
        validate_motion(self.motion)
        checks.non_negative("the weight of an outcome", self.weight)
        checks.finite("the factor on a motion", self.scale)


@dataclass(frozen=True, eq=False)
class Experiment:
    """Outcomes, and the different shakings among them: each is followed once, however often it was repeated.

    Parameters
    ----------
    outcomes : tuple of Observed
    kind : str
        ``fell`` or ``moved``.
    shakings : tuple of Observed
        One of each motion at each factor.
    shaking : (n,) array of int
        Which of them each outcome is of.
    record : (n,) array of int
        Which record each outcome is of.
    """

    outcomes: tuple[Observation, ...]
    kind: str
    shakings: tuple[Observation, ...]
    shaking: IntArray
    record: IntArray

    @property
    def happened(self) -> FloatArray:
        """1 where it fell, or moved, else 0, (n,)."""
        return np.array([float(outcome.happened) for outcome in self.outcomes])

    @property
    def weights(self) -> FloatArray:
        """How often each outcome counts, (n,)."""
        return np.array([outcome.weight for outcome in self.outcomes])

    @property
    def records(self) -> int:
        """How many records there are."""
        return int(self.record.max()) + 1

    def outcome_counts(self, rows: slice | IntArray = slice(None)) -> tuple[FloatArray, FloatArray]:
        """Return how often each shaking made it happen, and how often it did not, (shakings,) each, among some outcomes."""
        size, shaking_rows = len(self.shakings), self.shaking[rows]
        happened, weights = self.happened[rows], self.weights[rows]
        counts = [
            np.bincount(shaking_rows, row_weights, size).astype(np.float64)
            for row_weights in (weights * happened, weights * (1.0 - happened))
        ]
        return counts[0], counts[1]


def make_experiment(outcomes: Iterable[Observation], kind: str = FELL) -> Experiment:
    """Return the experiment that some outcomes make.

    Raises
    ------
    KindError, ParameterError
        If there are none of them, or none counts, or they are of another kind.
    """
    observations = tuple(checks.instance(outcome, Observation) for outcome in outcomes)
    if kind not in (FELL, MOVED):
        raise ParameterError("an outcome is that a block fell or moved, not {kind!r}", kind=str(kind)[:100])
    if not any(outcome.weight for outcome in observations):
        raise ParameterError("there is no outcome to learn from: {count} were given, and none has a weight", count=len(observations))
    # not by equality: a motion is told from another by what it is, not by its numbers
    distinct: dict[tuple[int, float], Observation] = {}
    for outcome in observations:
        distinct.setdefault((id(outcome.motion), outcome.scale), replace(outcome, weight=1.0))
    shaking_index = {key: k for k, key in enumerate(distinct)}
    names: dict[str | int, int] = {}
    record = [names.setdefault(outcome.record or k, len(names)) for k, outcome in enumerate(observations)]
    shaking = [shaking_index[id(outcome.motion), outcome.scale] for outcome in observations]
    trimmed_shakings = tuple(replace(outcome, motion=trim_zeros(outcome.motion)) for outcome in distinct.values())
    return Experiment(observations, kind, trimmed_shakings, np.array(shaking), np.array(record))


def trim_zeros(motion: Motion) -> Motion:
    """Return a motion without the samples of exactly nothing before and after it: what stands waits, what still rocks is known."""
    nonzero = np.flatnonzero(motion.acceleration.any(axis=0))
    first, last = (max(int(nonzero[0]) - 1, 0), int(nonzero[-1]) + 2) if nonzero.size else (0, 2)
    if first == 0 and last >= motion.samples:
        return motion
    return Motion(motion.acceleration[:, first:last], motion.dt, name=motion.name, start_s=motion.start_s + first * motion.dt)


def outcome_weights(experiment: Experiment) -> tuple[float, float]:
    """Return the weight of the outcomes that happened, and of those that did not."""
    happened, not_happened = experiment.outcome_counts()
    return float(happened.sum()), float(not_happened.sum())


def ground_peaks(experiment: Experiment) -> tuple[FloatArray, FloatArray]:
    """Return the peak acceleration, m/s^2, and velocity, m/s, of the ground of each outcome, (n,)."""
    peaks: dict[int, tuple[float, float]] = {}
    for outcome in experiment.outcomes:
        if id(outcome.motion) not in peaks:
            acceleration = outcome.motion.horizontal
            history = ground_history(acceleration, outcome.motion.dt)
            peaks[id(outcome.motion)] = peak_acceleration(acceleration)[0], peak_velocity(history, outcome.motion.dt)
    rows = np.array([[abs(outcome.scale) * peak for peak in peaks[id(outcome.motion)]] for outcome in experiment.outcomes])
    return rows[:, 0], rows[:, 1]


def check_folds(folds: int, experiment: Experiment) -> int:
    """Return into how many parts the records are dealt, or refuse it."""
    count = checks.integer("the number of folds", folds, minimum=2)
    if count > experiment.records:
        raise ParameterError(
            "{folds} folds need as many records, and there are {records}: ask for at most that many",
            folds=count,
            records=experiment.records,
        )
    return count


def assign_folds(records: int, folds: int, seed: int) -> IntArray:
    """Return which fold each record is in, (records,): dealt like cards, so that folds differ by one at most."""
    order: IntArray = np.random.default_rng(seed).permutation(records)
    return order % folds
