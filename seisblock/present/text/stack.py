"""How a pile is told: what became of each stone."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.bodies.pile.stone import GROUND
from seisblock.present.directions import towards
from seisblock.present.scales import Unit, length_cell, length_unit
from seisblock.present.text.agreement import agreement_line
from seisblock.present.text.tables import NOTHING, answered, fixed, line, seconds, table
from seisblock.records import Motion
from seisblock.results import Response
from seisblock.solvers.stack.base import base_of
from seisblock.solvers.stack.outcome import StackOutcome, StoneFate
from seisblock.solvers.stack.solve import EDGES, RIGID
from seisblock.studies.agreement import Agreement
from seisblock.words import strung, tell

NOTICEABLE_TILT, NOTICEABLE_SLIP = 2e-3, 2e-4
"""What shows in a figure, rad and m."""


Stacks = Sequence[Response[StackOutcome]]


def tables(responses: Stacks, agreements: Sequence[Agreement | None], *, gal: bool = True) -> Iterator[Any]:
    """Yield the record, a row per stone, a sentence per run, and how far the models of the top stone are apart."""
    both = zip(responses, agreements, strict=True)
    for opening, part in answered(both, lambda each: each[0].motion.record, lambda each: [line(verdict(each[0]))]):
        yield from opening
        yield from (shown for each in part for shown in _details(*each, gal=gal))


def _details(response: Response[StackOutcome], found: Agreement | None, *, gal: bool) -> Iterator[Any]:
    """Yield the table of one run, its energies, and how far the models of the top stone are apart."""
    unit = length_unit((stone.residual_slip_m for stone in response.outcome.stones if stone.state != "fallen"), gal=gal)
    slip = tell("slip ({unit})", unit=unit.name)
    columns = [tell("stone"), tell("state"), tell("fell at (s)"), tell("max tilt (deg)"), slip, tell("turn (deg)")]
    title = tell("{name}: {what}", name=f"+x = {response.motion.name}", what=tell(response.body.name))
    yield table(title, columns, (_row(stone, unit) for stone in reversed(response.outcome.stones)))
    yield line(standing(response))
    if found is not None:
        top = tell("{stone}, {name}", stone=tell(response.body.names[-1]), name=response.motion.name)
        yield line(agreement_line(top, found))
    yield line()


def _row(stone: StoneFate, unit: Unit) -> list[str]:
    """Return what became of one stone; where a fallen one lies is no slip, and which way it faces no turn."""
    fell = stone.state == "fallen"
    return [
        tell(stone.name),
        tell(stone.state),
        seconds(stone.fell_at_s),
        fixed(math.degrees(stone.max_tilt_rad), 2),
        NOTHING if fell else length_cell(stone.residual_slip_m, unit),
        NOTHING if fell else fixed(math.degrees(stone.residual_turn_rad), 2),
    ]


def _fall(stone: StoneFate, motion: Motion) -> str:
    """Return in words when a stone fell, to which side, and where it came to lie."""
    where = {"stone": tell(stone.name), "side": towards(stone.fell_towards_deg or 0.0, motion), "time": stone.fell_at_s}
    if stone.fell_onto is None:
        return tell("{stone} fell at {time:.2f} s to {side}, and is still in the air.", **where)
    if stone.fell_onto == GROUND:
        return tell("{stone} fell at {time:.2f} s to {side}, onto the ground.", **where)
    return tell("{stone} fell at {time:.2f} s to {side}, onto {other}.", **where, other=tell(stone.fell_onto))


def verdict(response: Response[StackOutcome]) -> str:
    """Return what happened in words."""
    outcome = response.outcome
    if outcome.overturned_any and outcome.time_s is not None:
        falls = sorted((stone for stone in outcome.stones if stone.state == "fallen"), key=lambda stone: stone.fell_at_s or 0.0)
        return strung(_fall(stone, response.motion) for stone in falls)
    if moved := [tell(stone.name) for stone in outcome.stones if stone.state != "standing"]:
        return tell("Every stone stands; moved: {stones}.", stones=moved)
    return tell("Every stone stands where it was.")


def standing(response: Response[StackOutcome]) -> str:
    """Return in words on what the stones stand, and what that makes of the top stone."""
    found, points = base_of(response), response.options["points"]
    told = {"stone": tell(found.stone), "kept": found.restitution, "sharp": found.housner_ratio}
    law = tell("Rigid stones") if response.options["law"] == RIGID else tell("Stones that press on springs")
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
