"""How a pile is told: what became of each stone."""

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
from seisblock.models.stack.outcome import StackOutcome, StoneOutcome
from seisblock.models.stack.solve import EDGE_POINTS, RIGID
from seisblock.records import Motion
from seisblock.report.directions import direction_in_plane
from seisblock.report.text.agreement import agreement_line
from seisblock.report.text.stone_falls import describe_falls
from seisblock.report.text.tables import DASH, format_fixed, format_seconds, group_answers, styled_line, table
from seisblock.report.units_display import Unit, format_length, length_cell, length_unit
from seisblock.studies.model_comparison import ModelComparison
from seisblock.studies.respond.pile_probability import PileProbability, StoneProbability

NOTICEABLE_TILT, NOTICEABLE_SLIP = 2e-3, 2e-4
"""What shows in a figure, rad and m."""

MIN_CONCENTRATION = 0.3
"""Below this :attr:`~seisblock.studies.respond.pile_probability.StoneProbability.fell_alike_ratio` a mean direction tells nothing."""

StackResponses = Sequence[Response[StackOutcome]]


def tables(responses: StackResponses, extras: Sequence[Mapping[str, Any]], *, gal: bool = True) -> Iterator[Any]:
    """Yield what falls and how sure that is, the record, a row per stone, and how far the models of the top stone are apart."""
    pairs, has_components = zip(responses, extras, strict=True), len(responses) > 1
    for heading, part in group_answers(
        pairs, lambda pair: pair[0].motion.record, lambda pair: _summary(*pair, with_name=has_components, gal=gal)
    ):
        yield from heading
        yield from (block for pair in part for block in _details(*pair, gal=gal))


def _summary(response: Response[StackOutcome], extra: Mapping[str, Any], *, with_name: bool, gal: bool) -> Iterator[Text]:
    """Yield what happened, under the name of its component where there are others, and in what share of the versions."""
    text = verdict(response)
    yield styled_line(gettext("{name}: {text}", name=response.motion.name or "x", text=text) if with_name else text)
    if "probability" in extra:
        yield styled_line("  " + probability_sentence(extra["probability"], gal=gal))


def _details(response: Response[StackOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Any]:
    """Yield the table of one run, on what the stones stand, what was varied, and how far the models of the top stone are apart."""
    agreement: ModelComparison | None = extra["agreement"]
    unit = length_unit((stone.residual_slip_m for stone in response.outcome.stones if stone.state != "fallen"), gal=gal)
    slip = gettext("slip ({unit})", unit=unit.name)
    side = gettext("to") if response.motion.azimuth_deg is None else gettext("to (deg)")
    columns = [gettext("stone"), gettext("state"), gettext("at (s)"), side, gettext("tilt (deg)"), slip, gettext("turn (deg)")]
    title = gettext("{name}: {what}; tilt: the largest", name=f"+x = {response.motion.name}", what=gettext(response.body.name))
    yield table(title, columns, (_row(stone, unit, response.motion) for stone in reversed(response.outcome.stones)))
    yield styled_line(base_text(response))
    if "probability" in extra:
        yield from _version_tables(extra["probability"], response.body, gal=gal)
    if agreement is not None:
        top = gettext("{stone}, {name}", stone=gettext(response.body.names[-1]), name=response.motion.name)
        yield styled_line(agreement_line(top, agreement))
    yield styled_line()


def _row(stone: StoneOutcome, unit: Unit, motion: Motion) -> list[str]:
    """Return what became of one stone; where a fallen one lies is no slip, and which way it faces no turn."""
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
    """Return to which azimuth a stone fell, or to which side of the record's axes where north is not known."""
    if stone.fell_towards_deg is None:
        return DASH
    return (
        direction_in_plane(stone.fell_towards_deg, motion) if stone.fell_azimuth_deg is None else f"{round(stone.fell_azimuth_deg) % 360}"
    )


def verdict(response: Response[StackOutcome]) -> str:
    """Return what happened in words."""
    outcome = response.outcome
    if outcome.overturned_any:
        return describe_falls(response)
    if moved_stones := [gettext(stone.name) for stone in outcome.stones if stone.state != "standing"]:
        return gettext("Every stone stands; moved: {stones}.", stones=moved_stones)
    return gettext("Every stone stands where it was.")


def _version_tables(probability: PileProbability, pile: Pile, *, gal: bool) -> Iterator[Any]:
    """Yield in what share of the versions each stone falls and moves, and what was varied."""
    columns = [gettext("stone"), gettext("falls (%)"), gettext("95 % interval"), gettext("falls to (deg)"), gettext("moves (%)")]
    length = format_length(probability.moved_m, gal=gal)
    yield styled_line()
    yield table(
        gettext("{runs} plausible versions; moves: more than {far}, or falls", runs=probability.runs, far=length),
        columns,
        map(_chance_row, reversed(probability.stones)),
    )
    yield styled_line(variation_text(probability, pile), "dim")


def _chance_row(chance: StoneProbability) -> list[str]:
    """Return how often one stone falls, and to what azimuth, of +x where north is not known; nothing where it falls to all sides."""
    mean = chance.fell_towards_deg if chance.fell_azimuth_deg is None else chance.fell_azimuth_deg
    has_direction = mean is not None and chance.fell_alike_ratio is not None and chance.fell_alike_ratio >= MIN_CONCENTRATION
    low, high = (format_fixed(100.0 * end, 0) for end in chance.interval)
    share, moved_share = format_fixed(100.0 * chance.overturned, 1), format_fixed(100.0 * chance.moved, 1)
    return [
        gettext(chance.name),
        share,
        f"{low}–{high}",
        format_fixed(mean % 360.0, 0) if has_direction and mean is not None else DASH,
        moved_share,
    ]


def probability_sentence(probability: PileProbability, *, gal: bool = True) -> str:
    """Return in how many versions a stone falls or moves, as a sentence; never as if it were the pile's own probability."""
    fall_count = round(probability.overturned * probability.runs)
    low, high = probability.interval
    if fall_count == 0:
        falls = gettext("no stone falls in any of {runs} plausible versions", runs=probability.runs)
    elif fall_count == probability.runs:
        falls = gettext("a stone falls in all {runs} plausible versions", runs=probability.runs)
    else:
        falls = gettext(
            "a stone falls in {fallen} of {runs} plausible versions, {share} ({low} to {high})",
            fallen=fall_count,
            runs=probability.runs,
            share=format_share(probability.overturned),
            low=format_share(low),
            high=format_share(high),
        )
    length = format_length(probability.moved_m, gal=gal)
    if probability.moved in (0.0, 1.0):
        moves = (
            gettext("in all, one moves more than {far}", far=length)
            if probability.moved
            else gettext("none moves more than {far}", far=length)
        )
    else:
        moves = gettext("in {share} one moves more than {far}", share=format_share(probability.moved), far=length)
    if not probability.left_out_count:
        return gettext("{falls}; {moves}.", falls=falls, moves=moves)
    return gettext(
        "{falls}; {moves}; {count} of {asked} versions created energy and are left out.",
        falls=falls,
        moves=moves,
        count=probability.left_out_count,
        asked=probability.runs + probability.left_out_count,
    )


def variation_text(probability: PileProbability, pile: Pile) -> str:
    """Return what was varied, and of what the share is."""
    versions = probability.versions
    size = lazy_gettext("size ±{share}", share=format_share(versions.size))
    return gettext(
        "of this model's scatter alone: {shape}, friction of each joint ±{mu}, amplitude ±{amplitude}, direction ±{azimuth:g} degrees",
        shape=lazy_gettext("{parts}", parts=[size, _wear_text(pile, versions.inset)] if versions.inset else [size]),
        mu=format_share(versions.mu),
        amplitude=format_share(versions.amplitude),
        azimuth=versions.azimuth_deg,
    )


def _wear_text(pile: Pile, tolerance: float) -> Message:
    """Return how the insets of the stones of samples vary."""
    if not any(worn_share(stone) for stone in pile.stones):
        return lazy_gettext("sharp edges")
    return lazy_gettext("worn edges ±{share} of their inset", share=format_share(tolerance))


def base_text(response: Response[StackOutcome]) -> str:
    """Return in words on what the stones stand, and what that makes of the top stone."""
    base, points = effective_base(response), response.options["points"]
    values = {"stone": gettext(base.stone), "kept": base.restitution, "sharp": base.housner_ratio}
    law = gettext("Rigid stones") if response.options["law"] == RIGID else gettext("Stones that press on springs")
    if points == EDGE_POINTS and base.width_ratio < 1.0:
        return gettext(
            "{law} on worn edges: {stone} turns about lines at {share:.2f} of its half width, and an impact leaves, on firm ground, "
            "{kept:.2f} of its angular velocity; on sharp edges {sharp:.2f}.",
            law=law,
            share=base.width_ratio,
            **values,
        )
    if points == EDGE_POINTS and base.restitution <= 0.0:
        return gettext("{law} on their edges; on firm ground, {stone} is so squat that an impact ends its rocking.", law=law, **values)
    if points == EDGE_POINTS:
        return gettext(
            "{law} on their edges; an impact leaves {stone}, on firm ground, {kept:.2f} of its angular velocity.", law=law, **values
        )
    return gettext(
        "{law} at {points} x {points} points a joint, as in the paper: {stone} turns about lines at {share:.2f} of its half width, as if "
        "it were so much narrower, and an impact leaves {kept:.2f} of its angular velocity; on its edges {sharp:.2f}.",
        law=law,
        points=points,
        share=base.width_ratio,
        **values,
    )
