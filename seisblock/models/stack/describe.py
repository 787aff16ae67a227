"""Text of a pile: outcome of each stone, and its contact model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.models.stack.joint_geometry import effective_base
from seisblock.models.stack.options import EDGES, RIGID
from seisblock.models.stack.outcome import StackOutcome, StoneOutcome, StoneState
from seisblock.models.stack.stone_falls import describe_falls
from seisblock.output.directions import direction_in_plane
from seisblock.output.text.tables import (
    DASH,
    format_fixed,
    format_seconds,
    table,
)
from seisblock.output.units_display import Unit, length_cell, length_unit
from seisblock.records import Motion

NOTICEABLE_TILT, NOTICEABLE_SLIP = 2e-3, 2e-4
"""Smallest tilt and slip visible in a figure, rad and m."""


StackResponses = Sequence[Response[StackOutcome]]


def stone_table(response: Response[StackOutcome], *, gal: bool) -> Any:
    """Return the table of one run, a row per stone, the top stone first."""
    unit = length_unit((stone.residual_slip_m for stone in response.outcome.stones if stone.state != StoneState.FALLEN), gal=gal)
    slip = gettext("slip ({unit})", unit=unit.name)
    side = gettext("to") if response.motion.azimuth_deg is None else gettext("to (deg)")
    columns = [gettext("stone"), gettext("state"), gettext("at (s)"), side, gettext("tilt (deg)"), slip, gettext("twist (deg)")]
    title = gettext("{name}: {what}; tilt: peak value", name=f"+x = {response.motion.name}", what=gettext(response.body.name))
    return table(title, columns, (_row(stone, unit, response.motion) for stone in reversed(response.outcome.stones)))


def _row(stone: StoneOutcome, unit: Unit, motion: Motion) -> list[str]:
    """Return the row of one stone; a fallen stone has neither slip nor twist."""
    has_fallen = stone.state == StoneState.FALLEN
    return [
        gettext(stone.name),
        gettext(stone.state),
        format_seconds(stone.fell_at_s),
        _fall_direction(stone, motion),
        format_fixed(math.degrees(stone.max_tilt_rad), 2),
        DASH if has_fallen else length_cell(stone.residual_slip_m, unit),
        DASH if has_fallen else format_fixed(math.degrees(stone.residual_turn_rad), 2),
    ]


def _fall_direction(stone: StoneOutcome, motion: Motion) -> str:
    """Return the azimuth of fall, or the direction along the axes of the record if north is unknown."""
    if stone.fell_towards_deg is None:
        return DASH
    return (
        direction_in_plane(stone.fell_towards_deg, motion) if stone.fell_azimuth_deg is None else f"{round(stone.fell_azimuth_deg) % 360}"
    )


def describe(response: Response[StackOutcome], *, gal: bool = True) -> str:
    """Return the outcome in a sentence, which holds no acceleration or length: `gal` is without effect."""
    del gal
    outcome = response.outcome
    if outcome.overturned_any:
        return describe_falls(response)
    if moved_stones := [gettext(stone.name) for stone in outcome.stones if stone.state != StoneState.STANDING]:
        return gettext("No stone falls; displaced: {stones}.", stones=moved_stones)
    return gettext("No stone moves.")


def base_text(response: Response[StackOutcome]) -> str:
    """Return the contact model and its effect on the top stone."""
    base, points = effective_base(response), response.options.points
    values = {"stone": gettext(base.stone), "kept": base.restitution, "sharp": base.housner_ratio}
    law = gettext("Rigid contact") if response.options.law == RIGID else gettext("Spring contact")
    if points == EDGES and base.width_ratio < 1.0:
        return gettext(
            "{law}, worn edges: {stone} rotates about lines at {share:.2f} of its half width; on rigid ground an "
            "impact retains {kept:.2f} of the angular velocity ({sharp:.2f} for sharp edges).",
            law=law,
            share=base.width_ratio,
            **values,
        )
    if points == EDGES and base.restitution <= 0.0:
        return gettext("{law} at the edges; {stone} is too stocky to continue rocking after an impact on rigid ground.", law=law, **values)
    if points == EDGES:
        return gettext(
            "{law} at the edges; on rigid ground an impact retains {kept:.2f} of the angular velocity of {stone}.", law=law, **values
        )
    return gettext(
        "{law}, {points} x {points} contact points per joint as in the paper: {stone} rotates about lines at "
        "{share:.2f} of its half width, and an impact retains {kept:.2f} of the angular velocity ({sharp:.2f} for edge "
        "contact).",
        law=law,
        points=points,
        share=base.width_ratio,
        **values,
    )
