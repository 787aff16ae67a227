"""A suite of synthetic records: as many as one likes of one magnitude at one distance, the same ones for one seed."""

from __future__ import annotations

import math
import re

import numpy as np

from seisblock import checks
from seisblock.errors import ParameterError
from seisblock.limits import check_budget
from seisblock.records.record import Component, Record
from seisblock.records.synthetic.point_source import PointSource
from seisblock.typing import FloatArray
from seisblock.words import noted, said

DEFAULT_SUITE = "synthetic:M7:R20:40"
"""What stands for a suite where no records are named."""

DT = 0.01
"""Sampling interval, s."""

QUANTUM = 1e6
"""One over the last digit of the samples, s^2/m: what is written with six decimals is the record to the last bit."""

VERTICAL = 2.0 / 3.0
"""The vertical component over a horizontal one."""

EARLY, LATE = 0.2, 0.05
"""When the envelope is highest, as a share of when it is told; and how high it is then."""

TOLD_AT, FOLLOWED_TO = 2.0, 3.0
"""When that is, and how far the envelope is followed, in durations."""

_SPELLING = re.compile(r"synthetic:M(?P<magnitude>[^:]+):R(?P<distance>[^:]+):(?P<count>[^:]+)", re.IGNORECASE)


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
    source = PointSource(magnitude, 1e3 * checks.within("the distance", distance_km, "[1, 300]", "km"))
    checks.whole("the number of records", count, least=1)
    shape, before = _envelope(source)
    check_budget(noted("samples of synthetic records"), 3 * count * shape.size, "SEISBLOCK_READ_SAMPLES")
    target = source.spectrum(np.asarray(np.fft.rfftfreq(shape.size, DT), dtype=np.float64)) / DT
    name = f"synthetic_M{magnitude:g}_R{distance_km:g}"
    did = said(
        "synthetic, no recording: noise with the spectrum of magnitude {magnitude:g} at {distance:g} km on rock, seed {seed}; the noise "
        "begins at {before:.1f} s",
        magnitude=magnitude,
        distance=distance_km,
        seed=seed,
        before=before,
    )
    found = []
    for number, dice in enumerate(np.random.default_rng(checks.seed(seed)).spawn(count), start=1):
        waves = _waves(dice.standard_normal((3, shape.size)) * shape, target)
        components = (Component("NS", waves[0]), Component("EW", waves[1]), Component("UD", waves[2]))
        found.append(
            Record(
                components,
                DT,
                station=f"SYN{number:03d}",
                source=f"{name}_{number:03d}",
                format="synthetic",
                history=(did,),
                metadata={"magnitude": float(magnitude), "distance_km": float(distance_km), "synthetic": True},
            )
        )
    return tuple(found)


def named_suite(text: str, *, seed: int = 0) -> tuple[Record, ...]:
    """Return the suite that a name such as ``synthetic:M7:R20:40`` stands for: magnitude, distance in km, and how many records.

    Raises
    ------
    ParameterError
        If it is no such name, or a number lies outside its range.

    Examples
    --------
    >>> len(named_suite("synthetic:M6.5:R30:3"))
    3
    """
    told = _SPELLING.fullmatch(text.strip())
    try:
        magnitude, distance, count = float(told["magnitude"]), float(told["distance"]), int(told["count"])  # type: ignore[index]
    except (TypeError, ValueError):
        raise ParameterError(
            "{text!r} is no suite: expected magnitude, distance in km and how many, such as {example}",
            text=text[:60],
            example=DEFAULT_SUITE,
        ) from None
    return synthetic_suite(magnitude, distance, count, seed=seed)


def _envelope(source: PointSource) -> tuple[FloatArray, float]:
    """Return the envelope of the noise, (n,), its squares' sum one, and when it begins, s: the spectrum reaches back from there."""
    told = TOLD_AT * source.duration_s
    b = -EARLY * math.log(LATE) / (1.0 + EARLY * (math.log(EARLY) - 1.0))
    before = 1.0 + 1.0 / source.corner_hz
    seconds = math.ceil(2.0 * before + FOLLOWED_TO * source.duration_s)
    t = (np.arange(round(seconds / DT)) * DT - before) / told
    t[(t < 0.0) | (t > FOLLOWED_TO / TOLD_AT)] = 0.0
    shape = t**b * np.exp(-b / EARLY * t)
    return np.asarray(shape / math.sqrt(float(shape @ shape))), before


def _waves(noise: FloatArray, target: FloatArray) -> FloatArray:
    """Return the waves of one record, (3, n), m/s^2, rounded to the digits that are written."""
    spectra = np.fft.rfft(noise) * target
    spectra[2] *= VERTICAL
    return np.asarray(np.round(QUANTUM * np.fft.irfft(spectra, noise.shape[1])) / QUANTUM + 0.0)
