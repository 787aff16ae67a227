"""Dataset of a fit: outcomes of shaking tests, grouped by shaking and by record."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.typing import FloatArray, IntArray
from seisblock.measures.summary import conventions_of, motion_peaks
from seisblock.records import Motion
from seisblock.records._validation import validate_motion

FELL, MOVED = N_("fell"), N_("moved")


@dataclass(frozen=True, eq=False, repr=False)
class Observation(DisplayMixin):
    """One outcome: the motion, and whether the block fell or moved.

    Parameters
    ----------
    motion : Motion
    happened : bool
        True if the block fell, or moved.
    weight : float, 1
        Weight of the outcome.
    scale : float, 1
        Factor on the motion.
    record : str
        Outcomes of one record are held out together; an empty name makes its own record.
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
    """Outcomes and their distinct shakings: each shaking is simulated once, however often it was repeated.

    Parameters
    ----------
    outcomes : tuple of Observation
    kind : str
        ``fell`` or ``moved``.
    shakings : tuple of Observation
        One of each motion at each factor.
    shaking : (n,) array of int
        Index of the shaking of each outcome.
    record : (n,) array of int
        Index of the record of each outcome.
    """

    outcomes: tuple[Observation, ...]
    kind: str
    shakings: tuple[Observation, ...]
    shaking: IntArray
    record: IntArray

    @property
    def happened(self) -> FloatArray:
        """1 if the block fell, or moved, else 0, (n,)."""
        return np.array([float(outcome.happened) for outcome in self.outcomes])

    @property
    def weights(self) -> FloatArray:
        """Weights of the outcomes, (n,)."""
        return np.array([outcome.weight for outcome in self.outcomes])

    @property
    def records(self) -> int:
        """Number of records."""
        return int(self.record.max()) + 1

    def outcome_counts(self, rows: slice | IntArray = slice(None)) -> tuple[FloatArray, FloatArray]:
        """Return the weights of the positive and of the negative outcomes of each shaking, (shakings,) each, among some outcomes."""
        size, shaking_rows = len(self.shakings), self.shaking[rows]
        occurrences, weights = self.happened[rows], self.weights[rows]
        counts = [
            np.bincount(shaking_rows, row_weights, size).astype(np.float64)
            for row_weights in (weights * occurrences, weights * (1.0 - occurrences))
        ]
        return counts[0], counts[1]


def make_experiment(outcomes: Iterable[Observation], kind: str = FELL) -> Experiment:
    """Return the experiment of some outcomes.

    Raises
    ------
    KindError, ParameterError
        If there is no outcome with a weight, or one of another kind.
    """
    observations = tuple(checks.instance(outcome, Observation) for outcome in outcomes)
    if kind not in (FELL, MOVED):
        raise ParameterError("unknown kind of outcome {kind!r}; expected fell or moved", kind=str(kind)[:100])
    if not any(outcome.weight for outcome in observations):
        raise ParameterError(
            "the fit requires an outcome with a positive weight; {count} outcomes given, none with a weight", count=len(observations)
        )
    # by identity: comparing all samples of all motions would be slow
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
    """Return a motion without leading and trailing zeros: the block rests before, and free rocking after it is known."""
    # one zero on either side is kept, so that the linear interpolation to the first sample stays
    nonzero = np.flatnonzero(motion.acceleration.any(axis=0))
    first, last = (max(int(nonzero[0]) - 1, 0), int(nonzero[-1]) + 2) if nonzero.size else (0, 2)
    if first == 0 and last >= motion.samples:
        return motion
    return Motion(motion.acceleration[:, first:last], motion.dt, name=motion.name, start_s=motion.start_s + first * motion.dt)


def outcome_weights(experiment: Experiment) -> tuple[float, float]:
    """Return the weights of the positive and of the negative outcomes."""
    positive, negative = experiment.outcome_counts()
    return float(positive.sum()), float(negative.sum())


def ground_peaks(experiment: Experiment) -> tuple[FloatArray, FloatArray]:
    """Return the peak ground acceleration, m/s^2, and velocity, m/s, of each outcome, (n,)."""
    peaks: dict[int, tuple[float, float]] = {}
    for outcome in experiment.outcomes:
        if id(outcome.motion) not in peaks:
            acceleration = outcome.motion.horizontal
            pga, pgv, _ = motion_peaks(acceleration, outcome.motion.dt, conventions_of(outcome.motion.record))
            peaks[id(outcome.motion)] = pga, pgv
    rows = np.array([[abs(outcome.scale) * peak for peak in peaks[id(outcome.motion)]] for outcome in experiment.outcomes])
    return rows[:, 0], rows[:, 1]


def check_folds(folds: int, experiment: Experiment) -> int:
    """Return the number of folds of the records, at most one per record."""
    count = checks.integer("the number of folds", folds, minimum=2)
    if count > experiment.records:
        raise ParameterError(
            "{folds} folds require at least as many records, found {records}; reduce `folds`",
            folds=count,
            records=experiment.records,
        )
    return count


def assign_folds(records: int, folds: int, seed: int) -> IntArray:
    """Return the fold of each record, (records,): a random permutation, so that sizes differ by at most one."""
    order: IntArray = np.random.default_rng(seed).permutation(records)
    return order % folds
