"""How a jump is told: a table like the paper's, and a sentence per chain."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from rich.text import Text

from seisblock.present.text.tables import acceleration, acceleration_unit, record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.jump.chain import JUMPED, Chain
from seisblock.solvers.jump.solve import JumpOutcome

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


def tables(responses: Jumps, *, gal: bool, tenon: float | None) -> Iterator[Any]:
    """Yield the record, a table per component with a column per chain as in [Sugimoto2017]_ table 1, and a sentence per chain."""
    seen: set[int] = set()
    for response in responses:
        record = response.motion.record
        if record is not None and id(record) not in seen:
            seen.add(id(record))
            yield record_line(record)
        outcome = response.outcome
        threshold = acceleration(outcome.rocking_threshold_m_s2, gal=gal)
        title = f"{response.motion.name}: {response.body.name}, rocks above {threshold} {acceleration_unit(gal=gal)}"
        for first in range(0, len(outcome.chains), 6):
            part = outcome.chains[first : first + 6]
            yield table(title, ["chain", *(str(first + i + 1) for i in range(len(part)))], _cells(part))
        if not outcome.chains:
            yield Text(title, style="italic")
        for sentence in sentences(response, tenon):
            yield Text(sentence)
        yield Text()


def _cells(chains: Sequence[Chain]) -> Iterator[list[str]]:
    """Yield the rows of the table."""
    yield ["direction", *(chain.direction for chain in chains)]
    for heading, key in _ROWS:
        yield [heading, *(seconds(getattr(chain, key)) for chain in chains)]
    yield ["largest tilt (deg)", *(f"{math.degrees(chain.max_rotation_rad):.2f}" for chain in chains)]
    yield ["impact velocity (rad/s)", *(_or_dash(chain.impact_velocity_rad_s, "{:.3f}") for chain in chains)]
    for heading, key in _LENGTHS:
        yield [heading, *(_or_dash(getattr(chain, key), "{:.1f}", 1e3) for chain in chains)]


def _or_dash(value: float | None, form: str, factor: float = 1.0) -> str:
    """Return a number in a form, or a dash."""
    # adding zero after rounding turns -0.0 into 0.0
    return "-" if value is None else form.format(round(value * factor, 6) + 0.0)


def sentences(response: Response[JumpOutcome], tenon: float | None = None) -> Iterator[str]:
    """Yield what happened in words, one sentence per chain."""
    outcome = response.outcome
    if not outcome.chains:
        yield f"{response.motion.name}: the ground acceleration never exceeds the rocking threshold: the block stays where it is."
    for number, chain in enumerate(outcome.chains, start=1):
        told = f"Chain {number}: {chain.outcome}"
        if chain.outcome == JUMPED and chain.total_displacement_m is not None:
            told += (
                f" {chain.total_displacement_m * 1e3:+.0f} mm along {response.motion.name}, after {chain.rocking_duration_s:.3f} s of "
                f"rocking; the ground stayed above the threshold for {chain.time_above_threshold_s:.3f} s"
            )
        if tenon is not None and chain.foot_rise_m is not None and chain.max_rise_m is not None:
            out = chain.foot_rise_m > tenon
            told += (
                f"; the lowest foot rose {chain.foot_rise_m * 1e3:.1f} mm (centroid {chain.max_rise_m * 1e3:.1f} mm) against a tenon of "
                f"{tenon * 1e3:g} mm: it {'left' if out else 'did not leave'} its hole"
            )
        yield told + "."
