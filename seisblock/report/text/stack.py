"""Text report of a pile: outcome of each stone."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.pile.edge_wear import worn_share
from seisblock.bodies.pile.pile import Pile
from seisblock.core.i18n import Message, format_share, gettext, lazy_gettext
from seisblock.core.results import Response
from seisblock.models.stack.joint_geometry import effective_base
from seisblock.models.stack.options import EDGES, RIGID
from seisblock.models.stack.outcome import StackOutcome, StoneOutcome
from seisblock.records import Motion
from seisblock.report.directions import direction_in_plane
from seisblock.report.text.model_comparison import agreement_line
from seisblock.report.text.shaking import shaking_lines
from seisblock.report.text.stone_falls import describe_falls
from seisblock.report.text.tables import (
    DASH,
    format_fixed,
    format_range,
    format_seconds,
    format_share_interval,
    group_answers,
    styled_line,
    table,
)
from seisblock.report.units_display import Unit, format_length, length_cell, length_unit
from seisblock.studies.model_comparison import ModelComparison
from seisblock.studies.respond.pile_probability import PileProbability, StoneProbability

NOTICEABLE_TILT, NOTICEABLE_SLIP = 2e-3, 2e-4
"""Smallest tilt and slip visible in a figure, rad and m."""

MIN_CONCENTRATION = 0.3
"""Smallest resultant length (``StoneProbability.fell_alike_ratio``) for which a mean direction is printed."""

StackResponses = Sequence[Response[StackOutcome]]


def tables(responses: StackResponses, extras: Sequence[Mapping[str, Any]], *, gal: bool = True) -> Iterator[Any]:
    """Yield falls and their probability, a row per stone, and the model comparison of the top stone."""
    pairs, has_components = zip(responses, extras, strict=True), len(responses) > 1
    for heading, part in group_answers(
        pairs, lambda pair: pair[0].motion.record, lambda pair: _summary(*pair, with_name=has_components, gal=gal)
    ):
        yield from heading
        yield from (block for pair in part for block in _details(*pair, gal=gal))


def _summary(response: Response[StackOutcome], extra: Mapping[str, Any], *, with_name: bool, gal: bool) -> Iterator[Text]:
    text = describe(response)
    yield styled_line(gettext("{name}: {text}", name=response.motion.name or "x", text=text) if with_name else text)
    if "probability" in extra:
        yield styled_line("  " + probability_sentence(extra["probability"], gal=gal))


def _details(response: Response[StackOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Any]:
    """Yield the table of one run, the contact model, the varied parameters and the model comparison of the top stone."""
    agreement: ModelComparison | None = extra["agreement"]
    unit = length_unit((stone.residual_slip_m for stone in response.outcome.stones if stone.state != "fallen"), gal=gal)
    slip = gettext("slip ({unit})", unit=unit.name)
    side = gettext("to") if response.motion.azimuth_deg is None else gettext("to (deg)")
    columns = [gettext("stone"), gettext("state"), gettext("at (s)"), side, gettext("tilt (deg)"), slip, gettext("twist (deg)")]
    title = gettext("{name}: {what}; tilt: peak value", name=f"+x = {response.motion.name}", what=gettext(response.body.name))
    yield table(title, columns, (_row(stone, unit, response.motion) for stone in reversed(response.outcome.stones)))
    yield styled_line(base_text(response))
    if "probability" in extra:
        yield from _version_tables(extra["probability"], response.body, gal=gal)
    if agreement is not None:
        top = gettext("{stone}, {name}", stone=gettext(response.body.names[-1]), name=response.motion.name)
        yield styled_line(agreement_line(top, agreement))
    yield from shaking_lines([response], gal=gal)
    yield styled_line()


def _row(stone: StoneOutcome, unit: Unit, motion: Motion) -> list[str]:
    """Return the row of one stone; a fallen stone has neither slip nor twist."""
    has_fallen = stone.state == "fallen"
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


def describe(response: Response[StackOutcome]) -> str:
    """Return the outcome in a sentence."""
    outcome = response.outcome
    if outcome.overturned_any:
        return describe_falls(response)
    if moved_stones := [gettext(stone.name) for stone in outcome.stones if stone.state != "standing"]:
        return gettext("No stone falls; displaced: {stones}.", stones=moved_stones)
    return gettext("No stone moves.")


def _version_tables(probability: PileProbability, pile: Pile, *, gal: bool) -> Iterator[Any]:
    """Yield the share of samples in which each stone falls and moves, and the varied parameters."""
    columns = [gettext("stone"), gettext("falls (%)"), gettext("95 % interval"), gettext("falls to (deg)"), gettext("moves (%)")]
    length = format_length(probability.moved_m, gal=gal)
    yield styled_line()
    yield table(
        gettext("{runs} samples; moves: residual displacement above {far}, or falls", runs=probability.runs, far=length),
        columns,
        map(_chance_row, reversed(probability.stones)),
    )
    yield styled_line(variation_text(probability, pile), "dim")


def _chance_row(chance: StoneProbability) -> list[str]:
    """Return the row of one stone; fall direction from +x if north is unknown, a dash for scattered directions."""
    mean = chance.fell_towards_deg if chance.fell_azimuth_deg is None else chance.fell_azimuth_deg
    has_direction = mean is not None and chance.fell_alike_ratio is not None and chance.fell_alike_ratio >= MIN_CONCENTRATION
    low, high = (format_fixed(100.0 * end, 0) for end in chance.interval)
    share, moved_share = format_fixed(100.0 * chance.overturned, 1), format_fixed(100.0 * chance.moved, 1)
    return [
        gettext(chance.name),
        share,
        format_range(low, high),
        format_fixed(mean % 360.0, 0) if has_direction and mean is not None else DASH,
        moved_share,
    ]


def probability_sentence(probability: PileProbability, *, gal: bool = True) -> str:
    """Return the probability of a fall with its confidence interval, and the share of samples with displaced stones."""
    falls = gettext(
        "Probability of a fall {share} (95 % CI {interval}, {runs} samples)",
        share=format_share(probability.overturned),
        interval=format_share_interval(probability.interval),
        runs=probability.runs,
    )
    length = format_length(probability.moved_m, gal=gal)
    moves = gettext("fall or residual displacement above {far}: {share}", far=length, share=format_share(probability.moved))
    if not probability.left_out_count:
        return gettext("{falls}; {moves}.", falls=falls, moves=moves)
    return gettext(
        "{falls}; {moves}; {count} of {asked} samples omitted (energy created numerically).",
        falls=falls,
        moves=moves,
        count=probability.left_out_count,
        asked=probability.runs + probability.left_out_count,
    )


def variation_text(probability: PileProbability, pile: Pile) -> str:
    """Return the varied parameters."""
    versions = probability.versions
    size = lazy_gettext("size ±{share}", share=format_share(versions.size))
    return gettext(
        "Parameter variation only (model error not included): {shape}, friction of each joint ±{mu}, amplitude ±{amplitude}, "
        "azimuth ±{azimuth:g} degrees.",
        shape=lazy_gettext("{parts}", parts=[size, _wear_text(pile, versions.inset)] if versions.inset else [size]),
        mu=format_share(versions.mu),
        amplitude=format_share(versions.amplitude),
        azimuth=versions.azimuth_deg,
    )


def _wear_text(pile: Pile, tolerance: float) -> Message:
    if not any(worn_share(stone) for stone in pile.stones):
        return lazy_gettext("sharp edges")
    return lazy_gettext("edge wear ±{share}", share=format_share(tolerance))


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
