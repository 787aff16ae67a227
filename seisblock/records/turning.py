"""Ground acceleration towards any azimuth, from two horizontals of known direction."""

from __future__ import annotations

import math
from collections.abc import Callable

from seisblock.errors import ComponentError
from seisblock.records.record import Component, Record, sealed
from seisblock.typing import FloatArray
from seisblock.words import said


def oriented_pair(record: Record) -> tuple[Component, Component]:
    """Return two horizontals of known azimuth, from which any other direction follows.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> [component.code for component in oriented_pair(read("synthetic_jma.csv"))]
    ['NS', 'EW']
    """
    oriented = [c for c in record.horizontals if c.azimuth_deg is not None]
    if len(oriented) < 2:
        raise ComponentError(
            "{source}: turning to an azimuth needs two horizontal components of known direction; it has {codes}",
            source=record.source or said("record"),
            codes=record.codes,
        )
    return oriented[0], oriented[1]


def resolved(pair: tuple[Component, Component], azimuth_deg: float) -> FloatArray:
    """Return the acceleration towards an azimuth from two horizontals, which need not be orthogonal."""
    return mixed_towards(pair, azimuth_deg)(slice(None))


def mixed_towards(pair: tuple[Component, Component], azimuth_deg: float) -> Callable[[slice], FloatArray]:
    """Return what makes parts of the acceleration towards an azimuth from two horizontals."""
    first, second = pair
    # for exact axes keep the samples bit by bit: "numbers round-trip"
    for component in pair:
        if component.azimuth_deg == azimuth_deg % 360.0:
            return component.acceleration.__getitem__
    a, b, t = (math.radians(angle or 0.0) for angle in (first.azimuth_deg, second.azimuth_deg, azimuth_deg))
    span = math.sin(b - a)
    if abs(span) < 1e-6:
        raise ComponentError("the two horizontal components are parallel: no other direction follows from them")

    def mixed(part: slice) -> FloatArray:
        # north/east of the ground from its two projections, then projected on the azimuth
        found = first.acceleration[part] * (math.sin(b - t) / span)
        found += second.acceleration[part] * (math.sin(t - a) / span)
        return sealed(found)

    return mixed
