"""Suites of synthetic records for a magnitude and a distance, reproducible by seed."""

from __future__ import annotations

import math
import re

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import check_memory
from seisblock.core.typing import FloatArray
from seisblock.records.record import Component, Record
from seisblock.records.synthetic.point_source import PointSource

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
    :class:`~seisblock.records.synthetic.point_source.PointSource` ([Boore2003]_ method; [SaragoniHart1974]_ method for the envelope).
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
