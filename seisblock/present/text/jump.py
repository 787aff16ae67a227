"""How a jump is told: a table like the paper's, and a sentence per chain."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from rich.text import Text

from seisblock.present.text.tables import acceleration, acceleration_unit, record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.jump.chain import JUMPED, NO_JUMP, Chain
from seisblock.solvers.jump.solve import JumpOutcome
from seisblock.solvers.jump.tale import exceeds

Jumps = Sequence[Response[JumpOutcome]]


_ROWS: tuple[tuple[str, str], ...] = (
    ("starts rocking (s)", "rocking_start_s"),
    ("impact (s)", "impact_s"),
    ("landing (s)", "landing_s"),
    ("end (s)", "end_s"),
    ("above threshold (s)", "time_above_threshold_s"),
    ("rocking (s)", "rocking_duration_s"),
    ("jump (s)", "jump_duration_s"),
    ("rock-slide (s)", "rock_slide_duration_s"),
)


_LENGTHS: tuple[tuple[str, str], ...] = (
    ("rise in jump (mm)", "max_rise_m"),
    ("jump distance (mm)", "jump_displacement_m"),
    ("rock-slide distance (mm)", "rock_slide_displacement_m"),
    ("total distance (mm)", "total_displacement_m"),
)


MOST_SHOWN = 6
"""Chains in the table: those that moved the block most, in the order of time."""


def tables(responses: Jumps, *, gal: bool, tenon: float | None) -> Iterator[Any]:
    """Yield, per component, what became of the block, and a table with a column per chain as in [Sugimoto2017]_ table 1."""
    seen: set[int] = set()
    for response in responses:
        record = response.motion.record
        if record is not None and id(record) not in seen:
            seen.add(id(record))
            yield record_line(record)
        outcome = response.outcome
        yield Text(verdict(response))
        shown = _shown(outcome.chains)
        if shown:
            threshold = acceleration(outcome.rocking_threshold_m_s2, gal=gal)
            title = f"{response.motion.name}: {response.body.name}, rocks above {threshold} {acceleration_unit(gal=gal)}"
            yield table(title, ["chain", *(str(i + 1) for i in shown)], _cells([outcome.chains[i] for i in shown]))
        for sentence in sentences(response, tenon):
            yield Text(sentence)
        yield Text()


def _shown(chains: Sequence[Chain]) -> list[int]:
    """Return which chains the table shows."""
    by_size = sorted(range(len(chains)), key=lambda i: -abs(chains[i].total_displacement_m or math.inf))
    return sorted(by_size[:MOST_SHOWN])


def _cells(chains: Sequence[Chain]) -> Iterator[list[str]]:
    """Yield the rows of the table."""
    yield ["direction", *(chain.direction for chain in chains)]
    for heading, key in _ROWS:
        yield [heading, *(seconds(getattr(chain, key)) for chain in chains)]
    yield ["largest tilt (deg)", *(f"{math.degrees(chain.max_rotation_rad):.2f}" for chain in chains)]
    yield ["impact velocity (rad/s)", *(_or_dash(chain.impact_velocity_rad_s, "{:.3f}") for chain in chains)]
    for heading, key in _LENGTHS:
        yield [heading, *(_or_dash(getattr(chain, key), "{:.1f}", 1e3) for chain in chains)]
    yield ["friction its landing needs", *(_friction(chain.friction_needed_at_landing) for chain in chains)]


def _or_dash(value: float | None, form: str, factor: float = 1.0) -> str:
    """Return a number in a form, or a dash."""
    # adding zero after rounding turns -0.0 into 0.0
    return "-" if value is None else form.format(round(value * factor, 6) + 0.0)


def _friction(needed: float | None) -> str:
    """Return P_x/P_y of a landing; where the ground would have to pull no friction would do."""
    return "-" if needed is None else f"{needed:.2f}" if math.isfinite(needed) else "none does"


def verdict(response: Response[JumpOutcome]) -> str:
    """Return what became of the block in the end, and what friction that takes."""
    outcome, name = response.outcome, response.motion.name or "x"
    if not outcome.chains:
        return f"{name}: the ground acceleration never exceeds the rocking threshold: the block stays where it is."
    count = len(outcome.chains)
    after = f"after {count} chains of motion" if count > 1 else "after one chain of motion"
    if outcome.outcome in (JUMPED, NO_JUMP):
        jumps = sum(chain.outcome == JUMPED for chain in outcome.chains)
        did = f"{'jumped' if jumps == 1 else f'jumped {jumps} times'}" if jumps else "rocked without jumping"
        ends = f"{name}: {did}, and in the end stands {_signed(outcome.final_displacement_m)} from where it stood, {after}"
    else:
        ends = f"{name}: {outcome.outcome}, {_signed(outcome.final_displacement_m)} from where it stood, {after}"
    return f"{ends}{_held(response)}."


def _signed(length: float) -> str:
    """Return a displacement in mm, + in the component's positive direction."""
    return f"{round(length * 1e3) + 0:+d} mm"


def _held(response: Response[JumpOutcome]) -> str:
    """Return what friction the answer rests on, where that is more than was given."""
    mu, outcome = response.options["mu"], response.outcome
    told = []
    ratio = response.body.width / 2 / response.body.centroid_height
    if mu < ratio:
        told.append(f"rocking needs feet that are held: friction {mu:g} is below b/h, {ratio:.2f}, and would let them slide first")
    needed = outcome.friction_needed_at_landing
    if exceeds(needed, mu):
        told.append(f"its landings need a friction of {_friction(needed)}, mu is {mu:g}")
    return "".join(f"; {text}" for text in told)


def sentences(response: Response[JumpOutcome], tenon: float | None = None) -> Iterator[str]:
    """Yield what happened in words, one sentence per chain that the table shows."""
    chains = response.outcome.chains
    shown = _shown(chains)
    for index in shown:
        chain = chains[index]
        told = f"Chain {index + 1}: {chain.outcome}"
        if chain.outcome == JUMPED and chain.total_displacement_m is not None:
            told += (
                f" {_signed(chain.total_displacement_m)} along {response.motion.name}, after {chain.rocking_duration_s:.3f} s of "
                f"rocking; the ground stayed above the threshold for {chain.time_above_threshold_s:.3f} s"
            )
        if tenon is not None and chain.foot_rise_m is not None and chain.max_rise_m is not None:
            out = chain.foot_rise_m > tenon
            told += (
                f"; the lowest foot rose {chain.foot_rise_m * 1e3:.1f} mm (centroid {chain.max_rise_m * 1e3:.1f} mm) against a tenon of "
                f"{tenon * 1e3:g} mm: it {'left' if out else 'did not leave'} its hole"
            )
        yield told + "."
    if len(shown) < len(chains):
        least = max(abs(chain.total_displacement_m or 0.0) for i, chain in enumerate(chains) if i not in shown)
        yield f"{len(chains) - len(shown)} more chains, none of which moved it by more than {least * 1e3:.1f} mm."
    left = [chain.end_angular_velocity_rad_s or 0.0 for chain in chains if chain.outcome == JUMPED]
    if left and response.outcome.landing == "paper":
        yield (
            "A chain ends when the tilt is back at zero: the paper's model ends here, and makes nothing of the angular velocity left, "
            f"up to {max(left):.2f} rad/s."
        )
