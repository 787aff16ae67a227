"""Ground acceleration towards any azimuth from two horizontals of known azimuth."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from seisblock.core.arrays import readonly
from seisblock.core.errors import ComponentError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.records.record import Component, Record


def oriented_pair(record: Record) -> tuple[Component, Component]:
    """Return the first two horizontals of known azimuth.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> [component.code for component in oriented_pair(read("synthetic_jma.csv"))]
    ['NS', 'EW']
    """
    oriented = [c for c in record.horizontals if c.azimuth_deg is not None]
    if len(oriented) < 2:
        raise ComponentError(
            "{source}: rotation requires two horizontal components of known azimuth; available: {codes}",
            source=record.source or lazy_gettext("record"),
            codes=record.codes,
        )
    return oriented[0], oriented[1]


def acceleration_at_azimuth(pair: tuple[Component, Component], azimuth_deg: float) -> FloatArray:
    """Return the acceleration towards an azimuth from two horizontals, not necessarily orthogonal, (n,), m/s^2."""
    return azimuth_projection(pair, azimuth_deg)(slice(None))


def azimuth_projection(pair: tuple[Component, Component], azimuth_deg: float) -> Callable[[slice], FloatArray]:
    """Return a function that gives slices of the acceleration towards an azimuth from two horizontals."""
    component_1, component_2 = pair
    # recorded directions return the samples themselves, without rounding errors of the projection
    for component in pair:
        if component.azimuth_deg == azimuth_deg % 360.0:
            return component.acceleration.__getitem__
    a, b, t = (math.radians(angle or 0.0) for angle in (component_1.azimuth_deg, component_2.azimuth_deg, azimuth_deg))
    span = math.sin(b - a)
    # the projection divides by the sine of the angle between the components
    if abs(span) < 1e-6:
        raise ComponentError("the two horizontal components are parallel and cannot be rotated")

    weights = math.sin(b - t) / span, math.sin(t - a) / span
    return partial(_weighted_sum, component_1.acceleration, component_2.acceleration, weights)


def _weighted_sum(first: FloatArray, second: FloatArray, weights: tuple[float, float], part: slice) -> FloatArray:
    """Return a slice of the weighted sum of two rows; the weights are north and east of both, projected on an azimuth."""
    total = first[part] * weights[0]
    total += second[part] * weights[1]
    return readonly(total)
