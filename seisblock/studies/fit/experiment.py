"""What was seen: a block stood on the ground, the ground shook, and the block fell or stood; again and again, under many shakings."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from seisblock import checks
from seisblock.errors import ParameterError
from seisblock.measures.baseline import ground_history
from seisblock.measures.peaks import peak_acceleration, peak_velocity
from seisblock.records import Motion
from seisblock.records.given import check_motion
from seisblock.typing import FloatArray, IntArray
from seisblock.words import noted

FELL, MOVED = noted("fell"), noted("moved")


@dataclass(frozen=True, eq=False)
class Observed:
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
        check_motion(self.motion)
        checks.not_negative("the weight of an outcome", self.weight)
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

    outcomes: tuple[Observed, ...]
    kind: str
    shakings: tuple[Observed, ...]
    shaking: IntArray
    record: IntArray

    @property
    def happened(self) -> FloatArray:
        """1 where it fell, or moved, else 0, (n,)."""
        return np.array([float(each.happened) for each in self.outcomes])

    @property
    def weights(self) -> FloatArray:
        """How often each outcome counts, (n,)."""
        return np.array([each.weight for each in self.outcomes])

    @property
    def records(self) -> int:
        """How many records there are."""
        return int(self.record.max()) + 1

    def counted(self, chosen: slice | IntArray = slice(None)) -> tuple[FloatArray, FloatArray]:
        """Return how often each shaking made it happen, and how often it did not, (shakings,) each, among some outcomes."""
        size, of = len(self.shakings), self.shaking[chosen]
        happened, weights = self.happened[chosen], self.weights[chosen]
        counts = [np.bincount(of, each, size).astype(np.float64) for each in (weights * happened, weights * (1.0 - happened))]
        return counts[0], counts[1]


def experiment_of(outcomes: Iterable[Observed], kind: str = FELL) -> Experiment:
    """Return the experiment that some outcomes make.

    Raises
    ------
    KindError, ParameterError
        If there are none of them, or none counts, or they are of another kind.
    """
    given = tuple(checks.instance(each, Observed) for each in outcomes)
    if kind not in (FELL, MOVED):
        raise ParameterError("an outcome is that a block fell or moved, not {kind!r}", kind=str(kind)[:100])
    if not any(each.weight for each in given):
        raise ParameterError("there is no outcome to learn from: {count} were given, and none has a weight", count=len(given))
    # not by equality: a motion is told from another by what it is, not by its numbers
    different: dict[tuple[int, float], Observed] = {}
    for each in given:
        different.setdefault((id(each.motion), each.scale), replace(each, weight=1.0))
    places = {key: k for k, key in enumerate(different)}
    names: dict[str | int, int] = {}
    record = [names.setdefault(each.record or k, len(names)) for k, each in enumerate(given)]
    shaking = [places[id(each.motion), each.scale] for each in given]
    still = tuple(replace(each, motion=without_silence(each.motion)) for each in different.values())
    return Experiment(given, kind, still, np.array(shaking), np.array(record))


def without_silence(motion: Motion) -> Motion:
    """Return a motion without the samples of exactly nothing before and after it: what stands waits, what still rocks is known."""
    shakes = np.flatnonzero(motion.acceleration.any(axis=0))
    first, last = (max(int(shakes[0]) - 1, 0), int(shakes[-1]) + 2) if shakes.size else (0, 2)
    if first == 0 and last >= motion.samples:
        return motion
    return Motion(motion.acceleration[:, first:last], motion.dt, name=motion.name, start_s=motion.start_s + first * motion.dt)


def kinds_in(experiment: Experiment) -> tuple[float, float]:
    """Return the weight of the outcomes that happened, and of those that did not."""
    happened, not_happened = experiment.counted()
    return float(happened.sum()), float(not_happened.sum())


def peaks_of(experiment: Experiment) -> tuple[FloatArray, FloatArray]:
    """Return the peak acceleration, m/s^2, and velocity, m/s, of the ground of each outcome, (n,)."""
    found: dict[int, tuple[float, float]] = {}
    for each in experiment.outcomes:
        if id(each.motion) not in found:
            along = each.motion.horizontal
            history = ground_history(along, each.motion.dt)
            found[id(each.motion)] = peak_acceleration(along)[0], peak_velocity(history, each.motion.dt)
    rows = np.array([[abs(each.scale) * peak for peak in found[id(each.motion)]] for each in experiment.outcomes])
    return rows[:, 0], rows[:, 1]


def check_folds(folds: int, experiment: Experiment) -> int:
    """Return into how many parts the records are dealt, or refuse it."""
    found = checks.whole("the number of folds", folds, least=2)
    if found > experiment.records:
        raise ParameterError(
            "{folds} folds need as many records, and there are {records}: ask for at most that many",
            folds=found,
            records=experiment.records,
        )
    return found


def dealt(records: int, folds: int, seed: int) -> IntArray:
    """Return which fold each record is in, (records,): dealt like cards, so that folds differ by one at most."""
    places: IntArray = np.random.default_rng(seed).permutation(records)
    return places % folds
