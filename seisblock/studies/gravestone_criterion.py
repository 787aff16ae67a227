"""Study of the gravestone criterion: the smallest overturning H/B of the upper stone under sines, and the fit through the thresholds.

[Furukawa2009]_ section 3(3): sine bases of 100 to 1300 gal, 0.5 to 3 Hz and 20 s, 29 heights of the upper stone. Runs are independent,
parallel, and resumable.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.top_block import rigid_top
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.io.checkpoint import Checkpoint
from seisblock.core.typing import FloatArray, Progress
from seisblock.core.units import GAL, STANDARD_GRAVITY
from seisblock.criteria.gravestones import GravestoneFit
from seisblock.measures.summary import conventions_of, motion_peaks
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.models.stack.options import RIGID, SPRINGS
from seisblock.models.stack.solve import solve_stack
from seisblock.records.motion import Motion
from seisblock.studies.parallel import map_threads

FREQUENCIES_HZ = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)
PGAS = tuple(100.0 * GAL * i for i in range(1, 14))
RATIOS = tuple(1.25 + 0.1875 * i for i in range(29))
"""Height over width of the 29 upper stones, 10 to 52 sun in steps of 1.5 ([Furukawa2009]_ table 1)."""

DURATION_S = 20.0
SAMPLING_S = 0.005


@dataclass(frozen=True)
class Threshold:
    """Smallest overturning H/B of the upper stone under one sine.

    Parameters
    ----------
    frequency_hz, pga_m_s2 : float
    ratio : float or None
        Height over width; None without overturning.
    fallen : tuple of str
        Names of all fallen stones.
    """

    frequency_hz: float
    pga_m_s2: float
    ratio: float | None
    fallen: tuple[str, ...] = ()


@dataclass(frozen=True, repr=False)
class CriterionStudy(DisplayMixin):
    """Thresholds, the level a(f) of eq. (7) at each frequency, and the fit (8) through them.

    Parameters
    ----------
    thresholds : tuple of Threshold
    levels : dict of float to float, Hz to m/s^2
        Least squares of H/B = a(f)/PGA ([Furukawa2009]_ eq. (7)); without frequencies at which nothing fell.
    fit : GravestoneFit or None
        Least squares of eq. (8) through the levels; None with fewer than three.
    """

    thresholds: tuple[Threshold, ...]
    levels: dict[float, float]
    fit: GravestoneFit | None


def with_top(body: Pile, ratio: float) -> Pile:
    """Return the pile with an upper stone of height `ratio` times its width ([Furukawa2009]_ table 1)."""
    top = body.stones[-1]
    return replace(body, stones=(*body.stones[:-1], replace(top, height=ratio * top.width)))


def sine_base(frequency: float, pga: float, duration: float = DURATION_S) -> Motion:
    """Return a sine of ground acceleration along +x, Hz and m/s^2 ([Furukawa2009]_ section 3(3)a)."""
    time = SAMPLING_S * np.arange(round(duration / SAMPLING_S) + 1)
    return Motion.from_arrays(pga * np.sin(2.0 * math.pi * frequency * time), SAMPLING_S, name=f"sine {frequency:g} Hz")


def criterion_study(
    body: Pile,
    *,
    frequencies: Sequence[float] = FREQUENCIES_HZ,
    pgas: Sequence[float] = PGAS,
    ratios: Sequence[float] = RATIOS,
    law: str = SPRINGS,
    points: int = 5,
    contact: PileContact | None = None,
    gravity: float = STANDARD_GRAVITY,
    duration: float = DURATION_S,
    resume: Path | None = None,
    progress: Progress | None = None,
    workers: int | None = None,
) -> CriterionStudy:
    """Return the threshold of every sine and the fitted criterion ([Furukawa2009]_ section 3(3)).

    Heights are tried in rising order up to the first that falls, which is the paper's definition of the threshold.

    Parameters
    ----------
    body : Pile
        The height of its last stone varies.
    frequencies, pgas, ratios : sequences of float, Hz, m/s^2, 1
    law, points, contact, gravity
        As for :func:`~seisblock.models.stack.solve.solve_stack`.
    duration : float, s
    resume : path
        File with one line per finished sine; read if present, and extended.
    progress : callable
        Called with the number of finished sines and the total.
    workers : int
        Threads.

    Returns
    -------
    CriterionStudy

    Raises
    ------
    ParameterError
        If a list is empty.
    OutputError
        If `resume` is no checkpoint, belongs to another study or cannot be written.

    Examples
    --------
    >>> from seisblock.survey import criterion_study
    >>> from seisblock.bodies.pile.toml import load_pile
    >>> criterion_study(load_pile("wagata"), frequencies=(1.0,), pgas=(6.0,), ratios=(2.0, 4.0), points=2, duration=1.0).levels
    {1.0: 24.0}
    """
    checks.instance(body, Pile)
    if not (frequencies and pgas and ratios):
        raise ParameterError("the criterion study requires at least one frequency, one amplitude and one height")
    contact = PileContact() if contact is None and law == SPRINGS else contact
    cells = [(float(f), float(a)) for f in frequencies for a in pgas]
    sorted_ratios = sorted(float(ratio) for ratio in ratios)
    # the digest identifies pile and settings, so that a file of another study is rejected
    settings = [asdict(body), sorted_ratios, points, RIGID if contact is None else asdict(contact), gravity, duration]
    digest = hashlib.sha256(json.dumps(settings, sort_keys=True).encode()).hexdigest()[:16]
    finished: dict[tuple[float, float], Threshold] = {}
    checkpoint = None if resume is None else Checkpoint.open(resume, {"seisblock": "criterion study", "of": digest})
    if checkpoint is not None:
        for row in (row for key in checkpoint.places for row in checkpoint.rows(key)):
            cell = (row["frequency_hz"], row["pga_m_s2"])
            finished[cell] = Threshold(*cell, row["ratio"], tuple(row["fallen"]))
    missing = [cell for cell in cells if cell not in finished]

    def work(cell: tuple[float, float]) -> Threshold:
        return _find_threshold(
            body, sine_base(*cell, duration), cell, sorted_ratios, law=law, points=points, contact=contact, gravity=gravity
        )

    for count, threshold in enumerate(map_threads(work, missing, workers=workers), start=1):
        finished[threshold.frequency_hz, threshold.pga_m_s2] = threshold
        if checkpoint is not None:
            checkpoint.append((repr(threshold.frequency_hz), repr(threshold.pga_m_s2)), [asdict(threshold)])
        if progress is not None:
            progress(len(cells) - len(missing) + count, len(cells))
    thresholds = tuple(finished[cell] for cell in cells)
    levels = fit_levels(thresholds)
    return CriterionStudy(thresholds, levels, fit_criterion(levels))


def study_frequencies(study: CriterionStudy) -> list[float]:
    """Return the frequencies of a study, in order."""
    return list(dict.fromkeys(t.frequency_hz for t in study.thresholds))


def fit_levels(thresholds: Sequence[Threshold]) -> dict[float, float]:
    """Return a(f), m/s^2, of H/B = a(f)/PGA by least squares at each frequency ([Furukawa2009]_ eq. (7))."""
    levels = {}
    for frequency in dict.fromkeys(t.frequency_hz for t in thresholds):
        pairs = [(1.0 / t.pga_m_s2, t.ratio) for t in thresholds if t.frequency_hz == frequency and t.ratio is not None]
        if pairs:
            inverse, ratio = np.array(pairs).T
            levels[frequency] = float(inverse @ ratio / (inverse @ inverse))
    return levels


def fit_criterion(levels: dict[float, float]) -> GravestoneFit | None:
    """Return p, q, r of a(f) = p sqrt(1 + (f/q)^r) by least squares, or None with fewer than three levels ([Furukawa2009]_ eq. (8))."""
    from scipy.optimize import least_squares

    if len(levels) < 3:
        return None
    f, a = np.array(sorted(levels.items())).T

    def misfit(x: FloatArray) -> FloatArray:
        p, q, r = np.exp(x)
        return p * np.sqrt(1.0 + (f / q) ** r) - a

    best = least_squares(misfit, np.log([a.min(), 2.0, 4.0]))
    p, q, r = (float(value) for value in np.exp(best.x))
    return GravestoneFit(p, q, r, "least squares")


def record_thresholds(
    body: Pile,
    motion: Motion,
    *,
    pgas: Sequence[float] = PGAS,
    ratios: Sequence[float] = RATIOS,
    law: str = SPRINGS,
    points: int = 5,
    contact: PileContact | None = None,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
) -> tuple[Threshold, ...]:
    """Return the threshold of a motion scaled to each amplitude, along +x alone ([Furukawa2009]_ section 3(5), fig. 10).

    The frequency of the thresholds is the equivalent one, PGA/(2 pi PGV). Parameters as for :func:`criterion_study`.

    Raises
    ------
    ParameterError
        If the motion has no acceleration along +x.
    """
    peak, _, frequency = motion_peaks(motion.horizontal, motion.dt, conventions_of(motion.record))
    if frequency is None:
        raise ParameterError("the motion has no acceleration along its component and cannot be scaled; choose another component")

    def work(pga: float) -> Threshold:
        scaled_motion = Motion.from_arrays(motion.horizontal * (pga / peak), motion.dt, name=motion.name)
        return _find_threshold(
            body, scaled_motion, (frequency, pga), sorted(ratios), law=law, points=points, contact=contact, gravity=gravity
        )

    return tuple(map_threads(work, tuple(pgas), progress=progress))


def _find_threshold(
    body: Pile,
    motion: Motion,
    cell: tuple[float, float],
    sorted_ratios: Sequence[float],
    *,
    law: str,
    points: int,
    contact: PileContact | None,
    gravity: float,
) -> Threshold:
    """Return the threshold of one motion: the first ratio, in rising order, that falls."""
    for ratio in sorted_ratios:
        top = with_top(body, ratio)
        outcome = solve_stack(top, motion, law=law, points=points, contact=contact, gravity=gravity, stop_at_fall=True).outcome
        if outcome.overturned_any:
            return Threshold(*cell, ratio, outcome.overturned)
    return Threshold(*cell, None)


def rigid_levels(study: CriterionStudy, body: Pile, *, points: int, gravity: float = STANDARD_GRAVITY) -> dict[float, float]:
    """Return a(f) of the top stone as one rigid block over the sines of a study ([Furukawa2009]_ eq. (7))."""
    blocks = [(ratio, rigid_top(with_top(body, ratio), points)) for ratio in RATIOS]

    def work(threshold: Threshold) -> Threshold:
        """Return the smallest overturning ratio under the same sine."""
        motion = sine_base(threshold.frequency_hz, threshold.pga_m_s2)
        falls = (ratio for ratio, block in blocks if rock_verdict(block, motion, options=RockOptions(gravity=gravity)).overturned)
        return Threshold(threshold.frequency_hz, threshold.pga_m_s2, next(falls, None))

    return fit_levels(tuple(map_threads(work, study.thresholds)))
