"""A suite of synthetic records: as many as one likes of one magnitude at one distance, the same ones for one seed."""

from __future__ import annotations

import math
import re

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import check_limit
from seisblock.core.typing import FloatArray
from seisblock.records.record import Component, Record
from seisblock.records.synthetic.point_source import PointSource

DEFAULT_SUITE = "synthetic:M7:R20:40"
"""What stands for a suite where no records are named."""

DT = 0.01
"""Sampling interval, s."""

ROUNDING_SCALE = 1e6
"""One over the last digit of the samples, s^2/m: what is written with six decimals is the record to the last bit."""

VERTICAL_RATIO = 2.0 / 3.0
"""The vertical component over a horizontal one."""

ENVELOPE_PEAK, ENVELOPE_TAIL = 0.2, 0.05
"""When the envelope is highest, as a share of when it is told; and how high it is then."""

TAIL_TIME, CUTOFF_TIME = 2.0, 3.0
"""When that is, and how far the envelope is followed, in durations."""

_PATTERN = re.compile(r"synthetic:M(?P<magnitude>[^:]+):R(?P<distance>[^:]+):(?P<count>[^:]+)", re.IGNORECASE)


def synthetic_suite(magnitude: float, distance_km: float, count: int, *, seed: int = 0) -> tuple[Record, ...]:
    """Return synthetic records of an earthquake at a site of rock: three components each, 100 Hz.

    The two horizontal components have the same Fourier spectrum in the mean and know nothing of each other, nor of the vertical one, which
    has two thirds of it. One source, one path and one site: such records differ less than those of several earthquakes do.

    Parameters
    ----------
    magnitude : float, 1
        Moment magnitude, 4 to 8.5.
    distance_km : float, km
        To the fault's surface, 1 to 300.
    count : int
    seed : int
        Of the dice; a longer suite begins with a shorter one.

    Raises
    ------
    ParameterError
        If a number lies outside its range.

    Notes
    -----
    White noise under the envelope (t/T)^b exp(-c t/T), whose transform is multiplied by the spectrum of
    :class:`~seisblock.records.synthetic.point_source.PointSource` ([Boore2003]_ method; [SaragoniHart1974]_ method for the envelope).
    Differs: the noise is brought to the unit power that it has in the mean, not each record's to its own, so that the mean square of the
    spectra is the target's at each frequency. The vertical component has two thirds of the horizontal ones ([NewmarkHall1982]_ section on
    vertical motion). The sum of the samples, the last velocity, is zero within their last digit.

    Examples
    --------
    >>> records = synthetic_suite(7.0, 20.0, 2, seed=1)
    >>> [record.codes for record in records], records[0].dt
    ([('NS', 'EW', 'UD'), ('NS', 'EW', 'UD')], 0.01)
    >>> records[1].source
    'synthetic_M7_R20_002'
    """
    source = PointSource(magnitude, 1e3 * checks.in_interval("the distance", distance_km, "[1, 300]", "km"))
    checks.integer("the number of records", count, minimum=1)
    envelope, onset = _envelope(source)
    check_limit(N_("samples of synthetic records"), 3 * count * envelope.size, "SEISBLOCK_READ_SAMPLES")
    target = source.spectrum(np.asarray(np.fft.rfftfreq(envelope.size, DT), dtype=np.float64)) / DT
    name = f"synthetic_M{magnitude:g}_R{distance_km:g}"
    entry = lazy_gettext(
        "synthetic, no recording: noise with the spectrum of magnitude {magnitude:g} at {distance:g} km on rock, seed {seed}; the noise "
        "begins at {before:.1f} s",
        magnitude=magnitude,
        distance=distance_km,
        seed=seed,
        before=onset,
    )
    records = []
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
    """Return the suite that a name such as ``synthetic:M7:R20:40`` stands for: magnitude, distance in km, and how many records.

    Raises
    ------
    ParameterError
        If it is no such name, or a number lies outside its range.

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
            "{text!r} is no suite: expected magnitude, distance in km and how many, such as {example}",
            text=text[:60],
            example=DEFAULT_SUITE,
        ) from None
    return synthetic_suite(magnitude, distance, count, seed=seed)


def _envelope(source: PointSource) -> tuple[FloatArray, float]:
    """Return the envelope of the noise, (n,), its squares' sum one, and when it begins, s: the spectrum reaches back from there."""
    tail_time = TAIL_TIME * source.duration_s
    b = -ENVELOPE_PEAK * math.log(ENVELOPE_TAIL) / (1.0 + ENVELOPE_PEAK * (math.log(ENVELOPE_PEAK) - 1.0))
    onset = 1.0 + 1.0 / source.corner_hz
    seconds = math.ceil(2.0 * onset + CUTOFF_TIME * source.duration_s)
    t = (np.arange(round(seconds / DT)) * DT - onset) / tail_time
    t[(t < 0.0) | (t > CUTOFF_TIME / TAIL_TIME)] = 0.0
    shape = t**b * np.exp(-b / ENVELOPE_PEAK * t)
    return np.asarray(shape / math.sqrt(float(shape @ shape))), onset


def _waveforms(noise: FloatArray, target: FloatArray) -> FloatArray:
    """Return the waves of one record, (3, n), m/s^2, rounded to the digits that are written."""
    spectra = np.fft.rfft(noise) * target
    spectra[2] *= VERTICAL_RATIO
    return np.asarray(np.round(ROUNDING_SCALE * np.fft.irfft(spectra, noise.shape[1])) / ROUNDING_SCALE + 0.0)
