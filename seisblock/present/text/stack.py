"""How a pile is told: what became of each stone."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.wear import worn_share
from seisblock.present.directions import towards
from seisblock.present.scales import Unit, length_cell, length_unit, told_length
from seisblock.present.text.agreement import agreement_line
from seisblock.present.text.falls import told_falls
from seisblock.present.text.tables import NOTHING, answered, fixed, line, seconds, table
from seisblock.records import Motion
from seisblock.results import Response
from seisblock.solvers.stack.base import base_of
from seisblock.solvers.stack.outcome import StackOutcome, StoneFate
from seisblock.solvers.stack.solve import EDGES, RIGID
from seisblock.studies.agreement import Agreement
from seisblock.studies.standing.pile_probability import PileProbability, StoneChance
from seisblock.words import Said, roughly, said, tell

NOTICEABLE_TILT, NOTICEABLE_SLIP = 2e-3, 2e-4
"""What shows in a figure, rad and m."""

TO_ALL_SIDES = 0.3
"""Below this :attr:`~seisblock.studies.standing.pile_probability.StoneChance.fell_alike_ratio` a mean direction tells nothing."""

Stacks = Sequence[Response[StackOutcome]]


def tables(responses: Stacks, extras: Sequence[Mapping[str, Any]], *, gal: bool = True) -> Iterator[Any]:
    """Yield what falls and how sure that is, the record, a row per stone, and how far the models of the top stone are apart."""
    both, several = zip(responses, extras, strict=True), len(responses) > 1
    for opening, part in answered(both, lambda each: each[0].motion.record, lambda each: _happened(*each, named=several, gal=gal)):
        yield from opening
        yield from (shown for each in part for shown in _details(*each, gal=gal))


def _happened(response: Response[StackOutcome], extra: Mapping[str, Any], *, named: bool, gal: bool) -> Iterator[Text]:
    """Yield what happened, under the name of its component where there are others, and in what share of the versions."""
    told = verdict(response)
    yield line(tell("{name}: {text}", name=response.motion.name or "x", text=told) if named else told)
    if "probability" in extra:
        yield line("  " + share(extra["probability"], gal=gal))


def _details(response: Response[StackOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Any]:
    """Yield the table of one run, on what the stones stand, what was varied, and how far the models of the top stone are apart."""
    found: Agreement | None = extra["agreement"]
    unit = length_unit((stone.residual_slip_m for stone in response.outcome.stones if stone.state != "fallen"), gal=gal)
    slip = tell("slip ({unit})", unit=unit.name)
    side = tell("to") if response.motion.azimuth_deg is None else tell("to (deg)")
    columns = [tell("stone"), tell("state"), tell("at (s)"), side, tell("tilt (deg)"), slip, tell("turn (deg)")]
    title = tell("{name}: {what}; tilt: the largest", name=f"+x = {response.motion.name}", what=tell(response.body.name))
    yield table(title, columns, (_row(stone, unit, response.motion) for stone in reversed(response.outcome.stones)))
    yield line(standing(response))
    if "probability" in extra:
        yield from _versions(extra["probability"], response.body, gal=gal)
    if found is not None:
        top = tell("{stone}, {name}", stone=tell(response.body.names[-1]), name=response.motion.name)
        yield line(agreement_line(top, found))
    yield line()


def _row(stone: StoneFate, unit: Unit, motion: Motion) -> list[str]:
    """Return what became of one stone; where a fallen one lies is no slip, and which way it faces no turn."""
    fell = stone.state == "fallen"
    return [
        tell(stone.name),
        tell(stone.state),
        seconds(stone.fell_at_s),
        _side(stone, motion),
        fixed(math.degrees(stone.max_tilt_rad), 2),
        NOTHING if fell else length_cell(stone.residual_slip_m, unit),
        NOTHING if fell else fixed(math.degrees(stone.residual_turn_rad), 2),
    ]


def _side(stone: StoneFate, motion: Motion) -> str:
    """Return to which azimuth a stone fell, or to which side of the record's axes where north is not known."""
    if stone.fell_towards_deg is None:
        return NOTHING
    return towards(stone.fell_towards_deg, motion) if stone.fell_azimuth_deg is None else f"{round(stone.fell_azimuth_deg) % 360}"


def verdict(response: Response[StackOutcome]) -> str:
    """Return what happened in words."""
    outcome = response.outcome
    if outcome.overturned_any:
        return told_falls(response)
    if moved := [tell(stone.name) for stone in outcome.stones if stone.state != "standing"]:
        return tell("Every stone stands; moved: {stones}.", stones=moved)
    return tell("Every stone stands where it was.")


def _versions(found: PileProbability, pile: Pile, *, gal: bool) -> Iterator[Any]:
    """Yield in what share of the versions each stone falls and moves, and what was varied."""
    columns = [tell("stone"), tell("falls (%)"), tell("95 % interval"), tell("falls to (deg)"), tell("moves (%)")]
    far = told_length(found.moved_m, gal=gal)
    yield line()
    yield table(
        tell("{runs} plausible versions; moves: more than {far}, or falls", runs=found.runs, far=far),
        columns,
        map(_chance, reversed(found.stones)),
    )
    yield line(varied(found, pile), "dim")


def _chance(chance: StoneChance) -> list[str]:
    """Return how often one stone falls, and to what azimuth, of +x where north is not known; nothing where it falls to all sides."""
    mean = chance.fell_towards_deg if chance.fell_azimuth_deg is None else chance.fell_azimuth_deg
    known = mean is not None and chance.fell_alike_ratio is not None and chance.fell_alike_ratio >= TO_ALL_SIDES
    low, high = (fixed(100.0 * end, 0) for end in chance.interval)
    share, moved = fixed(100.0 * chance.overturned, 1), fixed(100.0 * chance.moved, 1)
    return [tell(chance.name), share, f"{low}–{high}", fixed(mean % 360.0, 0) if known and mean is not None else NOTHING, moved]


def share(found: PileProbability, *, gal: bool = True) -> str:
    """Return in how many versions a stone falls or moves, as a sentence; never as if it were the pile's own probability."""
    fallen = round(found.overturned * found.runs)
    low, high = found.interval
    if fallen == 0:
        falls = tell("no stone falls in any of {runs} plausible versions", runs=found.runs)
    elif fallen == found.runs:
        falls = tell("a stone falls in all {runs} plausible versions", runs=found.runs)
    else:
        falls = tell(
            "a stone falls in {fallen} of {runs} plausible versions, {share} ({low} to {high})",
            fallen=fallen,
            runs=found.runs,
            share=roughly(found.overturned),
            low=roughly(low),
            high=roughly(high),
        )
    far = told_length(found.moved_m, gal=gal)
    if found.moved in (0.0, 1.0):
        moves = tell("in all, one moves more than {far}", far=far) if found.moved else tell("none moves more than {far}", far=far)
    else:
        moves = tell("in {share} one moves more than {far}", share=roughly(found.moved), far=far)
    if not found.left_out_count:
        return tell("{falls}; {moves}.", falls=falls, moves=moves)
    return tell(
        "{falls}; {moves}; {count} of {asked} versions created energy and are left out.",
        falls=falls,
        moves=moves,
        count=found.left_out_count,
        asked=found.runs + found.left_out_count,
    )


def varied(found: PileProbability, pile: Pile) -> str:
    """Return what was varied, and of what the share is."""
    by = found.versions
    size = said("size ±{share}", share=roughly(by.size))
    return tell(
        "of this model's scatter alone: {shape}, friction of each joint ±{mu}, amplitude ±{amplitude}, direction ±{azimuth:g} degrees",
        shape=said("{parts}", parts=[size, _worn(pile, by.inset)] if by.inset else [size]),
        mu=roughly(by.mu),
        amplitude=roughly(by.amplitude),
        azimuth=by.azimuth_deg,
    )


def _worn(pile: Pile, tolerance: float) -> Said:
    """Return how the insets of the stones of samples vary."""
    if not any(worn_share(stone) for stone in pile.stones):
        return said("sharp edges")
    return said("worn edges ±{share} of their inset", share=roughly(tolerance))


def standing(response: Response[StackOutcome]) -> str:
    """Return in words on what the stones stand, and what that makes of the top stone."""
    found, points = base_of(response), response.options["points"]
    told = {"stone": tell(found.stone), "kept": found.restitution, "sharp": found.housner_ratio}
    law = tell("Rigid stones") if response.options["law"] == RIGID else tell("Stones that press on springs")
    if points == EDGES and found.width_ratio < 1.0:
        return tell(
            "{law} on worn edges: {stone} turns about lines at {share:.2f} of its half width, and an impact leaves, on firm ground, "
            "{kept:.2f} of its angular velocity; on sharp edges {sharp:.2f}.",
            law=law,
            share=found.width_ratio,
            **told,
        )
    if points == EDGES and found.restitution <= 0.0:
        return tell("{law} on their edges; on firm ground, {stone} is so squat that an impact ends its rocking.", law=law, **told)
    if points == EDGES:
        return tell("{law} on their edges; an impact leaves {stone}, on firm ground, {kept:.2f} of its angular velocity.", law=law, **told)
    return tell(
        "{law} at {points} x {points} points a joint, as in the paper: {stone} turns about lines at {share:.2f} of its half width, as if "
        "it were so much narrower, and an impact leaves {kept:.2f} of its angular velocity; on its edges {sharp:.2f}.",
        law=law,
        points=points,
        share=found.width_ratio,
        **told,
    )
