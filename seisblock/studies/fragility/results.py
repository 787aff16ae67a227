"""Results of a fragility study: curves, counts, dispersion, goodness of fit and efficiency."""

from __future__ import annotations

from dataclasses import dataclass, field

from seisblock.core._display import DisplayMixin, PlotMixin
from seisblock.records import Record, Storey
from seisblock.studies.fragility.intensity import IntensityMeasure
from seisblock.studies.fragility.lognormal import Lognormal


@dataclass(frozen=True)
class FragilityLevel:
    """Counts at one level.

    Parameters
    ----------
    im : float
        Intensity, in the unit of the curve; in cloud analysis, that of one motion.
    runs, exceeding : int
        Runs, and those that exceed the limit.
    """

    im: float
    runs: int
    exceeding: int


@dataclass(frozen=True)
class Dispersion:
    """Decomposition of the dispersion: record to record, and parameters of the body.

    Parameters
    ----------
    beta_record_to_record, beta_parameter : float, 1
        Standard deviations of ln(capacity) among motions for one body, and of the median among the samples of the body.
    beta_sum : float, 1
        Square root of the sum of squares, comparable with beta of all runs together.
    versions, without_curve : int
        Samples of the body, and those without a curve.
    """

    beta_record_to_record: float
    beta_parameter: float
    beta_sum: float
    versions: int
    without_curve: int


@dataclass(frozen=True)
class Goodness:
    """Goodness of fit of a lognormal.

    Parameters
    ----------
    statistic : str
        ``ks``: largest distance between the shares and the curve; ``cumulated residuals``: largest cumulated difference of counts and
        expectation, in the order of the intensity, over the root of the number of runs.
    distance_ratio : float, 1
        Value of the statistic.
    probability : float, 1
        Probability of a distance as large for a sample of the fitted curve, fitted in turn.
    deviance_ratio : float or None, 1
        Deviance over the degrees of freedom; None without counts at levels. Runs share their motions, so no table applies.
    fits : bool
        True if that probability is at least 5 %.
    """

    statistic: str
    distance_ratio: float
    probability: float
    deviance_ratio: float | None
    fits: bool


@dataclass(frozen=True)
class Sufficiency:
    """Sufficiency of a measure: the slope of its residuals against another property.

    Parameters
    ----------
    against : str
        ``ln(pgv/pga)`` or ``magnitude``.
    slope_ratio : float, 1
        Change of ln(capacity) per unit of the property.
    probability : float, 1
        Probability of a slope as steep by chance.
    """

    against: str
    slope_ratio: float
    probability: float


@dataclass(frozen=True)
class Efficiency:
    """Efficiency of an intensity measure.

    Parameters
    ----------
    im, unit : str
    median : float
        In that unit.
    beta : float, 1
        The smaller, the fewer motions are required.
    sufficiency : tuple of Sufficiency
    """

    im: str
    unit: str
    median: float
    beta: float
    sufficiency: tuple[Sufficiency, ...]


Interval = tuple[float, float]


@dataclass(frozen=True, repr=False)
class Fragility(DisplayMixin):
    """Fragility curve of one body and one limit state.

    Parameters
    ----------
    body, limit : str
    im, unit : str
        Intensity measure, and the unit of its values.
    method : str
        ``stripes``, ``ida`` or ``cloud``.
    median : float or None, in `unit`
        None without a curve; `problem` gives the reason.
    beta : float or None, 1
    median_interval : (float, float) or None, in `unit`
        Bootstrap over records.
    beta_interval : (float, float) or None, 1
        Likewise.
    bootstrap_lost_count : int
        Bootstrap samples without a curve.
    median_alone : float or None, in `unit`
    beta_alone : float or None, 1
        Separate fit of the limit, if several limits share one beta.
    records, motions : int
        Motions are components of records.
    non_monotone_records, non_monotone_motions : int
        Records and motions that exceed the limit at a level and not at a higher one, for most samples of the body.
    censored_motions : int
        Motions without exceedance at any level.
    levels : tuple of FragilityLevel
    dispersion : Dispersion or None
        None without samples of the body.
    goodness : Goodness or None
    measures : tuple of Efficiency
        Compared measures, this one first.
    problem : str or None
        Reason for a missing curve.
    no_answer : int
        Stopped runs, left out of the counts and of the fit.
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


@dataclass(frozen=True, eq=False, repr=False)
class FragilityStudy(PlotMixin):
    """Fragility curves of some bodies and limit states over one suite of records.

    Parameters
    ----------
    curves : tuple of Fragility
        Body by body, limit by limit in order of severity.
    measure : IntensityMeasure
        Abscissa of the curves.
    solver, method : str
    confidence : float, 1
        Level of the intervals.
    bands : tuple
        For each curve, for figures: intensities, and lower and upper end of the probability there; None if there is none.
    factors : (float, float), 1
        Smallest and largest factor on a motion.
    records : tuple of Record
        With their processing applied.
    notes : tuple of str
        Warnings and notes.
    floor : Storey or None
        Floor under the bodies; the intensities are those of the ground.
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
