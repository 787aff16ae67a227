"""Suites of synthetic records for a magnitude and a distance, reproducible by seed."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import check_memory
from seisblock.core.typing import FloatArray
from seisblock.records.record import Component, Record

SHEAR_VELOCITY, DENSITY = 3500.0, 2800.0
"""Shear-wave velocity, m/s, and density, kg/m^3, of the rock at the source."""

STRESS_DROP = 1e7
"""Stress drop, Pa (100 bar)."""

RADIATION, FREE_SURFACE, PARTITION = 0.55, 2.0, 1.0 / math.sqrt(2.0)
"""Average radiation coefficient of shear waves, free-surface factor, and partition onto one horizontal component."""

QUALITY, QUALITY_POWER = 180.0, 0.45
"""Path attenuation Q = 180 f^0.45."""

KAPPA = 0.04
"""Near-surface attenuation kappa, s."""

SPREADING_CROSSOVER = 40e3
"""Distance beyond which geometrical spreading is that of surface waves, m."""

DURATION_PER_METRE = 0.05e-3
"""Increase of duration with distance, s/m."""

AMPLIFICATION_HZ = np.array([0.01, 0.09, 0.16, 0.51, 0.84, 1.25, 2.26, 3.17, 6.05, 16.60, 61.20])
AMPLIFICATION = np.array([1.00, 1.10, 1.18, 1.42, 1.58, 1.74, 2.06, 2.25, 2.58, 3.13, 4.00])
"""Amplification of generic rock at the frequencies AMPLIFICATION_HZ, Hz; linear in log frequency in between."""


@dataclass(frozen=True)
class PointSource:
    """Point source with Brune's single-corner spectrum and a site on generic rock, western North America.

    Parameters
    ----------
    magnitude : float, 1
        Moment magnitude.
    distance_m : float, m
        Shortest distance to the fault rupture.

    Raises
    ------
    ParameterError
        If the magnitude is not between 4 and 8.5, or the distance not between 1 and 300 km.

    Notes
    -----
    The parameters are those of western North America ([Campbell2003]_ table of source models), the amplification that of generic rock
    ([BooreJoyner1997]_ table of amplifications). ``effective_distance_m`` replaces the distance and limits the motion near
    large faults.

    Examples
    --------
    >>> source = PointSource(7.0, 20e3)
    >>> round(source.corner_hz, 4), round(source.duration_s, 1)
    (0.1124, 10.0)
    """

    magnitude: float
    distance_m: float

    def __post_init__(self) -> None:
        checks.in_interval("the magnitude", self.magnitude, "[4, 8.5]")
        checks.in_interval("the distance", self.distance_m, "[1e3, 3e5]", "m")

    @property
    def moment(self) -> float:
        """Seismic moment M0 = 10^(1.5 M + 9.05), N m ([HanksKanamori1979]_ definition of the moment magnitude)."""
        return float(10.0 ** (1.5 * self.magnitude + 9.05))

    @property
    def corner_hz(self) -> float:
        """Corner frequency 0.49 beta (stress drop/M0)^(1/3), Hz ([Boore2003]_ relation of Brune's model, in SI)."""
        return float(0.49 * SHEAR_VELOCITY * (STRESS_DROP / self.moment) ** (1.0 / 3.0))

    @property
    def effective_distance_m(self) -> float:
        """Distance of the point, sqrt(D^2 + h^2) with log10 h = -0.05 + 0.15 M, h in km, m ([AtkinsonSilva2000]_ relation)."""
        return math.hypot(self.distance_m, 1e3 * 10.0 ** (0.15 * self.magnitude - 0.05))

    @property
    def duration_s(self) -> float:
        """Duration of shaking, s: 1/corner at the source, plus 0.05 s per km ([Boore2003]_ method)."""
        return 1.0 / self.corner_hz + DURATION_PER_METRE * self.effective_distance_m

    def spectrum(self, frequency: FloatArray) -> FloatArray:
        """Return the Fourier amplitude of the acceleration of one horizontal component, (n,), m/s.

        Parameters
        ----------
        frequency : (n,) array, Hz
            Zero or more.

        Notes
        -----
        C M0 (2 pi f)^2/(1 + (f/fc)^2) G(R) exp(-pi f R/(Q beta)) A(f) exp(-pi kappa f) with C = 0.55 * 2 * 0.707/(4 pi rho beta^3)
        ([Boore2003]_ method: source, path, site). Proportional to f^2 at low frequency: the ground comes to rest.
        """
        f = np.asarray(frequency, dtype=np.float64)
        distance = self.effective_distance_m
        constant = RADIATION * FREE_SURFACE * PARTITION / (4.0 * math.pi * DENSITY * SHEAR_VELOCITY**3)
        source = constant * self.moment * (2.0 * math.pi * f) ** 2 / (1.0 + (f / self.corner_hz) ** 2)
        # body waves decay as 1/R, surface waves as 1/sqrt(R), continuous at the crossover
        spreading = 1.0 / distance if distance <= SPREADING_CROSSOVER else 1.0 / math.sqrt(SPREADING_CROSSOVER * distance)
        # pi f R/(Q beta) with Q = 180 f^0.45, and kappa
        attenuation = math.pi * distance / (QUALITY * SHEAR_VELOCITY) * f ** (1.0 - QUALITY_POWER) + math.pi * KAPPA * f
        amplification = np.interp(np.log(np.maximum(f, AMPLIFICATION_HZ[0])), np.log(AMPLIFICATION_HZ), AMPLIFICATION)
        return np.asarray(source * spreading * np.exp(-attenuation) * amplification)


DEFAULT_SUITE = "synthetic:M7:R20:40"
"""Suite used when no records are given."""

DT = 0.01
"""Sampling interval, s."""

ROUNDING_SCALE = 1e6
"""Inverse of the last digit of the samples, s^2/m: six decimals reproduce a record exactly."""

VERTICAL_RATIO = 2.0 / 3.0
"""Ratio of the vertical to a horizontal component."""

ENVELOPE_PEAK, ENVELOPE_TAIL = 0.2, 0.05
"""Time of the envelope's peak relative to the tail time, and envelope at the tail time."""

TAIL_TIME, CUTOFF_TIME = 2.0, 3.0
"""Tail time and end of the envelope, in durations."""

_PATTERN = re.compile(r"synthetic:M(?P<magnitude>[^:]+):R(?P<distance>[^:]+):(?P<count>[^:]+)", re.IGNORECASE)


def synthetic_suite(magnitude: float, distance_km: float, count: int, *, seed: int = 0) -> tuple[Record, ...]:
    """Return synthetic records of an earthquake at a rock site: three components each, 100 Hz.

    The two horizontal components have the same mean Fourier spectrum, the vertical component two thirds of it; all three are
    statistically independent. With one source, path and site, the variability is smaller than between earthquakes.

    Parameters
    ----------
    magnitude : float, 1
        Moment magnitude, 4 to 8.5.
    distance_km : float, km
        Shortest distance to the fault rupture, 1 to 300.
    count : int
        Number of records.
    seed : int
        Seed of the random generator; a longer suite begins with a shorter one.

    Returns
    -------
    tuple of Record

    Raises
    ------
    ParameterError
        If a number lies outside its range.

    Notes
    -----
    White noise under the envelope (t/T)^b exp(-c t/T), whose transform is multiplied by the spectrum of
    :class:`~seisblock.records.synthetic.suite.PointSource` ([Boore2003]_ method; [SaragoniHart1974]_ method for the envelope).
    Differs: the noise is normalised to unit mean power over the suite, not per record, so that the mean square of the spectra equals the
    target at each frequency. The vertical component has two thirds of the horizontal ones ([NewmarkHall1982]_ section on
    vertical motion). The sum of the samples, and so the final velocity, is zero within the rounding.

    Examples
    --------
    >>> from seisblock.records import synthetic_suite
    >>> records = synthetic_suite(7.0, 20.0, 2, seed=1)
    >>> [record.codes for record in records], records[0].dt
    ([('NS', 'EW', 'UD'), ('NS', 'EW', 'UD')], 0.01)
    >>> records[1].source
    'synthetic_M7_R20_002'
    """
    source = PointSource(magnitude, 1e3 * checks.in_interval("the distance", distance_km, "[1, 300]", "km"))
    checks.integer("the number of records", count, minimum=1)
    envelope, onset = _envelope(source)
    check_memory(N_("samples of synthetic records"), 3 * count * envelope.size, 8)
    # a discrete transform is the continuous one over the sampling interval
    target = source.spectrum(np.asarray(np.fft.rfftfreq(envelope.size, DT), dtype=np.float64)) / DT
    name = f"synthetic_M{magnitude:g}_R{distance_km:g}"
    entry = lazy_gettext(
        "synthetic (not recorded): noise with the spectrum of magnitude {magnitude:g} at {distance:g} km on rock, seed {seed}, "
        "starting at {before:.1f} s",
        magnitude=magnitude,
        distance=distance_km,
        seed=seed,
        before=onset,
    )
    records = []
    # a generator per record: a longer suite begins with a shorter one
    for number, rng in enumerate(np.random.default_rng(checks.seed(seed)).spawn(count), start=1):
        waves = _waveforms(rng.standard_normal((3, envelope.size)) * envelope, target)
        components = (Component("NS", waves[0]), Component("EW", waves[1]), Component("UD", waves[2]))
        records.append(
            Record(
                components,
                DT,
                station=f"SYN{number:03d}",
                source=f"{name}_{number:03d}",
                format="synthetic",
                history=(entry,),
                metadata={"magnitude": float(magnitude), "distance_km": float(distance_km), "synthetic": True},
            )
        )
    return tuple(records)


def parse_suite(text: str, *, seed: int = 0) -> tuple[Record, ...]:
    """Return the suite of a name such as ``synthetic:M7:R20:40``: magnitude, distance in km, number of records.

    Raises
    ------
    ParameterError
        If the name has another form, or a number lies outside its range.

    Examples
    --------
    >>> len(parse_suite("synthetic:M6.5:R30:3"))
    3
    """
    match = _PATTERN.fullmatch(text.strip())
    try:
        magnitude, distance, count = float(match["magnitude"]), float(match["distance"]), int(match["count"])  # type: ignore[index]
    except (TypeError, ValueError):
        raise ParameterError(
            "invalid suite {text!r}: expected magnitude, distance in km and number of records, for example {example}",
            text=text[:60],
            example=DEFAULT_SUITE,
        ) from None
    return synthetic_suite(magnitude, distance, count, seed=seed)


def _envelope(source: PointSource) -> tuple[FloatArray, float]:
    """Return the envelope of the noise, (n,), with unit sum of squares, and its start, s."""
    tail_time = TAIL_TIME * source.duration_s
    # envelope exponents from the position of its peak and its value at the tail time
    b = -ENVELOPE_PEAK * math.log(ENVELOPE_TAIL) / (1.0 + ENVELOPE_PEAK * (math.log(ENVELOPE_PEAK) - 1.0))
    # the zero-phase spectrum spreads the noise to times before the envelope begins
    onset = 1.0 + 1.0 / source.corner_hz
    seconds = math.ceil(2.0 * onset + CUTOFF_TIME * source.duration_s)
    t = (np.arange(round(seconds / DT)) * DT - onset) / tail_time
    # zero outside the envelope, where t**b is undefined or negligible
    t[(t < 0.0) | (t > CUTOFF_TIME / TAIL_TIME)] = 0.0
    shape = t**b * np.exp(-b / ENVELOPE_PEAK * t)
    return np.asarray(shape / math.sqrt(float(shape @ shape))), onset


def _waveforms(noise: FloatArray, target: FloatArray) -> FloatArray:
    """Return the accelerations of one record, (3, n), m/s^2, rounded to the digits written to files."""
    spectra = np.fft.rfft(noise) * target
    spectra[2] *= VERTICAL_RATIO
    # + 0.0 turns -0.0 into 0.0
    return np.asarray(np.round(ROUNDING_SCALE * np.fft.irfft(spectra, noise.shape[1])) / ROUNDING_SCALE + 0.0)
