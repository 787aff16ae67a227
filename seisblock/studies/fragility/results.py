"""What a study of fragility answers: curves, what they rest on, and how far they are to be trusted."""

from __future__ import annotations

from dataclasses import dataclass, field

from seisblock.core._display import PlotMixin
from seisblock.records import Record, Storey
from seisblock.studies.fragility.intensity import IntensityMeasure
from seisblock.studies.fragility.lognormal import Lognormal


@dataclass(frozen=True)
class FragilityLevel:
    """What happened at one level.

    Parameters
    ----------
    im : float
        Intensity, in the unit of the curve; of a method that scales nothing, that of one motion.
    runs, exceeding : int
        Runs, and those that passed the limit.
    """

    im: float
    runs: int
    exceeding: int


@dataclass(frozen=True)
class Dispersion:
    """Where the scatter of a curve comes from: the motions, and what is not known of the body.

    Parameters
    ----------
    beta_record_to_record, beta_parameter : float, 1
        Standard deviations of ln(intensity at which it happens): among motions for one body, and of the median among the versions.
    beta_sum : float, 1
        The root of the sum of their squares, to be compared with beta of all runs together.
    versions, without_curve : int
        Versions of the body, and those of them from which no curve follows.
    """

    beta_record_to_record: float
    beta_parameter: float
    beta_sum: float
    versions: int
    without_curve: int


@dataclass(frozen=True)
class Goodness:
    """How well a lognormal fits.

    Parameters
    ----------
    statistic : str
        ``ks``: largest distance between the shares and the curve; ``cumulated residuals``: the largest sum of what happened less what was
        expected, in the order of the intensity, over the root of the number of runs.
    distance_ratio : float, 1
        Its value.
    probability : float, 1
        That a sample of the fitted curve, fitted in its turn, lies as far from its own curve.
    deviance_ratio : float or None, 1
        Deviance over the degrees of freedom; None where nothing was counted at levels. Runs share their motions, so that it has no table.
    fits : bool
        Whether that probability is 5 % or more.
    """

    statistic: str
    distance_ratio: float
    probability: float
    deviance_ratio: float | None
    fits: bool


@dataclass(frozen=True)
class Sufficiency:
    """Whether a measure says all that matters: the slope of what it leaves unexplained.

    Parameters
    ----------
    against : str
        ``ln(pgv/pga)`` or ``magnitude``.
    slope_ratio : float, 1
        Change of ln(intensity at which it happens) with it, one to one or for each unit of magnitude.
    probability : float, 1
        That a slope as steep comes by chance.
    """

    against: str
    slope_ratio: float
    probability: float


@dataclass(frozen=True)
class Efficiency:
    """How well one intensity measure tells when it happens.

    Parameters
    ----------
    im, unit : str
    median : float
        In that unit.
    beta : float, 1
        The smaller, the fewer motions are needed.
    sufficiency : tuple of Sufficiency
    """

    im: str
    unit: str
    median: float
    beta: float
    sufficiency: tuple[Sufficiency, ...]


Interval = tuple[float, float]


@dataclass(frozen=True)
class Fragility:
    """One curve: a body, and a limit.

    Parameters
    ----------
    body, limit : str
    im, unit : str
        Measure of intensity, and the unit of its values.
    method : str
        ``stripes``, ``ida`` or ``cloud``.
    median : float or None, in `unit`
        None where no curve follows; `problem` says why.
    beta : float or None, 1
    median_interval : (float, float) or None, in `unit`
        Of the bootstrap over records.
    beta_interval : (float, float) or None, 1
        The same.
    bootstrap_lost_count : int
        Samples of the bootstrap from which no curve followed.
    median_alone : float or None, in `unit`
    beta_alone : float or None, 1
        Of the limit fitted by itself, where several limits share one beta.
    records, motions : int
        Motions are components of records.
    non_monotone_records, non_monotone_motions : int
        In which it happened at a level, and not at a higher one; to most versions of the body, where there are several.
    censored_motions : int
        In which it happened at no level.
    levels : tuple of FragilityLevel
    dispersion : Dispersion or None
        None without versions of the body.
    goodness : Goodness or None
    measures : tuple of Efficiency
        The measures that were compared, this one first.
    problem : str or None
        Why there is no curve.
    no_answer : int
        Runs that were given up; they are left out of the counts and of the fit.
    """

    body: str
    limit: str
    im: str
    unit: str
    method: str
    records: int
    motions: int
    non_monotone_records: int
    non_monotone_motions: int
    censored_motions: int
    levels: tuple[FragilityLevel, ...]
    median: float | None = None
    beta: float | None = None
    median_interval: Interval | None = None
    beta_interval: Interval | None = None
    bootstrap_lost_count: int = 0
    median_alone: float | None = None
    beta_alone: float | None = None
    dispersion: Dispersion | None = None
    goodness: Goodness | None = None
    measures: tuple[Efficiency, ...] = ()
    problem: str | None = None
    no_answer: int = 0

    @property
    def curve(self) -> Lognormal | None:
        """The lognormal, or None."""
        return None if self.median is None or self.beta is None else Lognormal(self.median, self.beta)


@dataclass(frozen=True, eq=False)
class FragilityStudy(PlotMixin):
    """The curves of some bodies and limits over one suite of records.

    Parameters
    ----------
    curves : tuple of Fragility
        Body by body, limit by limit in the order in which they are passed.
    measure : IntensityMeasure
        What the curves are drawn over.
    solver, method : str
    confidence : float, 1
        Level of the intervals.
    bands : tuple
        For each curve, for figures: intensities, and the lower and the upper end of the probability there; None where there is none.
    factors : (float, float), 1
        Smallest and largest factor on a motion.
    records : tuple of Record
        As they were used.
    notes : tuple of str
        What is to be known before believing the numbers.
    floor : Storey or None
        On which the bodies stand; the intensities are those of the ground under it.
    """

    curves: tuple[Fragility, ...]
    measure: IntensityMeasure
    solver: str
    method: str
    confidence: float
    bands: tuple[tuple[tuple[float, float, float], ...] | None, ...]
    factors: Interval
    records: tuple[Record, ...]
    notes: tuple[str, ...] = field(default=())
    floor: Storey | None = None
