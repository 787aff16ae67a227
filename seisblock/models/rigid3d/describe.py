"""Text in three dimensions: a sentence per direction of +x, and a table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from seisblock.bodies.body_name import body_name
from seisblock.bodies.convex import ConvexBody
from seisblock.bodies.scan.polygon import convex_hull, interior_distance
from seisblock.core.i18n import N_, Message, gettext, lazy_gettext
from seisblock.core.results import Response
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.models.rigid3d.params import GAP_SHARE
from seisblock.output.text.tables import format_number, table
from seisblock.output.units_display import Unit, format_length, length_cell, length_unit

HEADINGS = tuple(map(N_, ("+x", "fall (s)", "azimuth (deg)", "tilt (deg)", "twist (deg)", "x ({unit})", "y ({unit})", "rest (s)")))

MIN_ANGLE_DEG = 5e-5
"""Angle below which a body has neither tilt nor twist, degrees: the table rounds it to 0."""


def outcome_table(responses: Sequence[Response[Rigid3dOutcome]], *, gal: bool = True) -> Any:
    """Return the table of fall, tilt, twist and place, a row per direction of +x."""
    caption = gettext("azimuth of the fall; largest tilt; twist and y counter-clockwise of +x, seen from above")
    unit = length_unit((value for item in responses for value in item.outcome.final_displacement_m), gal=gal)
    headings = [gettext(heading, unit=unit.name) for heading in HEADINGS]
    return table(gettext("Three dimensions"), headings, [_row(item, unit) for item in responses], caption=caption)


def describe(response: Response[Rigid3dOutcome], *, gal: bool = True) -> str:
    """Return the result in one sentence."""
    return gettext("{name}: {verdict}.", name=response.motion.name or "x", verdict=verdict(response, gal=gal))


def verdict(response: Response[Rigid3dOutcome], *, gal: bool = True) -> str:
    """Return the result: overturning with its direction, or tilt, displacement and twist of a body that stands."""
    outcome = response.outcome
    if outcome.overturned:
        template = N_("overturns towards azimuth {azimuth:.0f}° at {time:.2f} s")
        if response.motion.azimuth_deg is None:
            template = N_("overturns {azimuth:.0f}° clockwise from +x at {time:.2f} s")
        return lazy_gettext(template, azimuth=outcome.fell_azimuth_deg, time=outcome.overturning_time_s)
    if not outcome.moved:
        return lazy_gettext("remains at rest")
    return lazy_gettext(
        "does not overturn: largest tilt {tilt:.2g}°, residual displacement {length}, twist {twist:.2g}°",
        tilt=clean_angle(math.degrees(outcome.max_tilt_rad)),
        length=format_length(math.hypot(*outcome.final_displacement_m), gal=gal),
        twist=clean_angle(outcome.twist_deg),
    )


def clean_angle(angle_deg: float) -> float:
    """Return an angle, degrees; round-off counts as 0.

    Examples
    --------
    >>> clean_angle(-0.5), clean_angle(-1e-17)
    (-0.5, 0.0)
    """
    return angle_deg if abs(angle_deg) >= MIN_ANGLE_DEG else 0.0


def contact_summary(body: ConvexBody, *, gal: bool = True) -> Message:
    """Return on how many vertices a scanned body stands, and how near the sides of contact and support polygon are to the centre."""
    points, centre = body.points, np.array(body.centre)
    size = float(np.linalg.norm(points - centre, axis=1).max())
    touching = points[points[:, 2] <= points[:, 2].min() + GAP_SHARE * size, :2]
    reaches = [interior_distance(polygon, centre[:2]) for polygon in (convex_hull(touching), body.support_polygon)]
    unit = length_unit(reaches, gal=gal)
    return lazy_gettext(
        "{name}: stands on {count} of {all} hull vertices; nearest side to the centre of gravity {contact} (contacts), {support} (support "
        "polygon, decides overturning)",
        name=body_name(body.name),
        count=len(touching),
        all=len(points),
        contact=format_length(max(reaches[0], 0.0), unit),
        support=format_length(reaches[1], unit),
    )


def _row(response: Response[Rigid3dOutcome], unit: Unit) -> list[str]:
    outcome = response.outcome
    values = (
        outcome.overturning_time_s,
        outcome.fell_azimuth_deg,
        clean_angle(math.degrees(outcome.max_tilt_rad)),
        clean_angle(outcome.twist_deg),
    )
    place = [length_cell(value, unit) for value in outcome.final_displacement_m]
    return [response.motion.name or "x", *map(format_number, values), *place, format_number(outcome.end_s if outcome.settled else None)]
