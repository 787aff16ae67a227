"""How a jump is told: a table like the paper's, and a sentence per chain."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.present.directions import moved_by, side
from seisblock.present.scales import length_cell, length_unit, told_length
from seisblock.present.text.onset import ROCKS, onset
from seisblock.present.text.tables import answered, line, seconds, side_by_side, told_acceleration
from seisblock.results import Response
from seisblock.solvers.jump.chain import JUMPED, NO_JUMP, Chain
from seisblock.solvers.jump.solve import JumpOutcome
from seisblock.solvers.jump.tale import exceeds
from seisblock.words import noted, strung, tell

Jumps = Sequence[Response[JumpOutcome]]


_ROWS: tuple[tuple[str, str], ...] = (
    (noted("starts rocking (s)"), "rocking_start_s"),
    (noted("impact (s)"), "impact_s"),
    (noted("landing (s)"), "landing_s"),
    (noted("end (s)"), "end_s"),
    (noted("above threshold (s)"), "time_above_threshold_s"),
    (noted("rocking (s)"), "rocking_duration_s"),
    (noted("jump (s)"), "jump_duration_s"),
    (noted("rock-slide (s)"), "rock_slide_duration_s"),
)


_LENGTHS: tuple[tuple[str, str], ...] = (
    (noted("rise in jump ({unit})"), "max_rise_m"),
    (noted("jump distance ({unit})"), "jump_displacement_m"),
    (noted("rock-slide distance ({unit})"), "rock_slide_displacement_m"),
    (noted("total distance ({unit})"), "total_displacement_m"),
)


MOST_SHOWN = 6
"""Chains in the table: those that moved the block most, in the order of time."""


LEAST_TOLD = 0.005
"""Angular velocity that two decimals show, rad/s; one below it has a digit of its own."""


def tables(responses: Jumps, *, gal: bool, tenon: float | None) -> Iterator[Any]:
    """Yield, per component, what became of the block, and a table with a column per chain as in [Sugimoto2017]_ table 1."""
    for opening, part in answered(responses, lambda each: each.motion.record, lambda each: [line(verdict(each, gal=gal))]):
        yield from opening
        for response in part:
            yield from _details(response, gal=gal, tenon=tenon)


def _details(response: Response[JumpOutcome], *, gal: bool, tenon: float | None) -> Iterator[Any]:
    """Yield the table of one component, and what there is to say of it."""
    outcome = response.outcome
    shown = _shown(outcome.chains)
    if shown:
        title = tell(
            "{name}: {body}, rocks above {threshold}",
            name=response.motion.name,
            body=tell(response.body.name),
            threshold=told_acceleration(outcome.rocking_threshold_m_s2, gal=gal),
        )
        cells = _cells([outcome.chains[i] for i in shown], response.motion.name, gal=gal)
        yield side_by_side(title, [tell("chain"), *(str(i + 1) for i in shown)], cells)
    for sentence in sentences(response, tenon, gal=gal):
        yield line(sentence)
    yield line()


def _shown(chains: Sequence[Chain]) -> list[int]:
    """Return which chains the table shows."""
    by_size = sorted(range(len(chains)), key=lambda i: -abs(chains[i].total_displacement_m or math.inf))
    return sorted(by_size[:MOST_SHOWN])


def _cells(chains: Sequence[Chain], name: str, *, gal: bool) -> Iterator[list[str]]:
    """Yield the rows of the table."""
    yield [tell("direction"), *(side(name, chain.direction) for chain in chains)]
    for heading, key in _ROWS:
        yield [tell(heading), *(seconds(getattr(chain, key)) for chain in chains)]
    yield [tell("largest tilt (deg)"), *(f"{math.degrees(chain.max_rotation_rad):.2f}" for chain in chains)]
    yield [tell("impact velocity (rad/s)"), *(_or_dash(chain.impact_velocity_rad_s, "{:z.3f}") for chain in chains)]
    unit = length_unit((getattr(chain, key) for chain in chains for _, key in _LENGTHS), gal=gal)
    for heading, key in _LENGTHS:
        yield [tell(heading, unit=unit.name), *(length_cell(getattr(chain, key), unit) for chain in chains)]
    yield [tell("friction its landing needs"), *(_friction(chain.friction_needed_at_landing) for chain in chains)]


def _or_dash(value: float | None, form: str) -> str:
    """Return a number in a form, in which z leaves zero no sign, or a dash."""
    return "-" if value is None else form.format(value)


def _friction(needed: float | None) -> str:
    """Return P_x/P_y of a landing; where the ground would have to pull no friction would do."""
    return "-" if needed is None else f"{needed:.2f}" if math.isfinite(needed) else tell("none does")


def verdict(response: Response[JumpOutcome], *, gal: bool = True) -> str:
    """Return what became of the block in the end, and what friction that takes."""
    outcome, name = response.outcome, response.motion.name or "x"
    if not outcome.chains:
        gravity = response.options["gravity_m_s2"]
        share = outcome.rocking_threshold_m_s2 / gravity
        moves = onset(ROCKS, (share, share), response.motion, gravity=gravity, gal=gal)
        return tell("{name}: stays where it is; {onset}.", name=name, onset=moves)
    jumps = sum(chain.outcome == JUMPED for chain in outcome.chains)
    if outcome.outcome not in (JUMPED, NO_JUMP):
        text = noted("{name}: {outcome}, {moved} from where it stood, in chain {count} of motion.")
    elif jumps == 0:
        text = noted("{name}: rocked without jumping, in {count} chains of motion.")
    elif len(outcome.chains) == 1:
        text = noted("{name}: jumped, and in the end stands {moved} from where it stood.")
    else:
        text = noted("{name}: jumped {jumps} times in {count} chains of motion, and in the end stands {moved} from where it stood.")
    moved = moved_by(outcome.final_displacement_m, name, gal=gal)
    told = tell(text, name=name, outcome=tell(outcome.outcome), moved=moved, count=len(outcome.chains), jumps=jumps)
    return strung([told, *_held(response)])


def _held(response: Response[JumpOutcome]) -> Iterator[str]:
    """Yield what friction the answer rests on, where that is more than was given."""
    mu, needed = response.options["mu"], response.outcome.friction_needed_at_landing
    ratio = response.body.width / 2 / response.body.centroid_height
    if mu < ratio:
        text = noted("Rocking needs feet that are held: friction {mu:g} is below b/h, {ratio:.2f}, and would let them slide first.")
        yield tell(text, mu=mu, ratio=ratio)
    if needed is not None and exceeds(needed, mu):
        yield tell("Its landings need a friction of {needed}, mu is {mu:g}.", needed=_friction(needed), mu=mu)


def sentences(response: Response[JumpOutcome], tenon: float | None = None, *, gal: bool = True) -> Iterator[str]:
    """Yield what happened in words, one sentence per chain that the table shows."""
    chains, name = response.outcome.chains, response.motion.name
    shown = _shown(chains)
    for number, chain in ((i + 1, chains[i]) for i in shown):
        if chain.outcome == JUMPED and chain.total_displacement_m is not None:
            yield tell(
                "Chain {number}: jumped {moved}, after {rocking:.3f} s of rocking; the ground stayed above the threshold for "
                "{above:.3f} s.",
                number=number,
                moved=moved_by(chain.total_displacement_m, name, gal=gal),
                rocking=chain.rocking_duration_s,
                above=chain.time_above_threshold_s,
            )
        else:
            yield tell("Chain {number}: {outcome}.", number=number, outcome=tell(chain.outcome))
        if tenon is not None and chain.foot_rise_m is not None and chain.max_rise_m is not None:
            yield _hole(chain.foot_rise_m, chain.max_rise_m, tenon, gal=gal)
    if len(shown) < len(chains):
        least = max(abs(chain.total_displacement_m or 0.0) for i, chain in enumerate(chains) if i not in shown)
        yield tell(
            "{count} more chains moved it by no more than {least} each.", count=len(chains) - len(shown), least=told_length(least, gal=gal)
        )
    left = max((chain.end_angular_velocity_rad_s or 0.0 for chain in chains if chain.outcome == JUMPED), default=0.0)
    if left > 0.0 and response.outcome.landing == "paper":
        text = noted(
            "A chain ends when the tilt is back at zero: the paper's model ends here, and makes nothing of the angular velocity left, "
            "up to {most} rad/s."
        )
        yield tell(text, most=f"{left:.2f}" if left >= LEAST_TOLD else f"{left:.1g}")


def _hole(foot: float, centroid: float, tenon: float, *, gal: bool) -> str:
    """Return whether a tenon of a length left its hole, given how far the lowest foot and the centroid rose, all in m."""
    if foot > tenon:
        text = noted("The lowest foot rose {foot} (centroid {centroid}) against a tenon of {tenon}: it left its hole.")
    else:
        text = noted("The lowest foot rose {foot} (centroid {centroid}) against a tenon of {tenon}: it did not leave its hole.")
    unit = length_unit([foot, centroid, tenon], gal=gal)
    # as precise as the table, for two that are nearly alike are compared
    rose, middle, hole = (f"{length_cell(each, unit)} {unit.name}" for each in (foot, centroid, tenon))
    return tell(text, foot=rose, centroid=middle, tenon=hole)
