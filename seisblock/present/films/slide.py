"""Sliding as a film: the object on its shaking base, level or sloping, with the record and the slip below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.present.figures.heading import heading_of
from seisblock.present.figures.slide import COLOURS
from seisblock.present.films.animation import Filming
from seisblock.present.films.film import Film, Line, Strip, at, ground_strip, stretch, titled
from seisblock.present.films.plane import Body, Piece, Plane, Trail, ground_shift, rectangle
from seisblock.present.films.projector import animate_film
from seisblock.present.scales import Unit, length_unit, told_length
from seisblock.present.text.slide import setting
from seisblock.results import Response
from seisblock.solvers.slide.solve import SlideOutcome
from seisblock.typing import FloatArray
from seisblock.words import tell

SMALLEST = 0.05
"""Least width at which the object is drawn, m: the model gives it none, so it is drawn half as wide as it slides far."""


def animate_slide(response: Response[SlideOutcome], path: Path | str, filming: Filming) -> None:
    """Write the film of a slide, see :func:`seisblock.present.films.projector.animate_film`."""
    span = stretch(response.phases, COLOURS, float(response.motion.time[0]), float(response.motion.time[-1]))
    animate_film(lambda times: slide_film(response, times, gal=filming.gal), span, path, filming)


def slide_film(response: Response[SlideOutcome], times: FloatArray, *, gal: bool = True) -> Film:
    """Return the film of a slide for the times of its pictures, (n,), s."""
    base: SlidingBase = response.body
    motion = response.motion
    slip = at(times, response.time, response["displacement"])
    x, z, turn = place(base, slip)
    path = place(base, response["displacement"])[:2]
    size = max(0.5 * float(np.ptp(slip)), SMALLEST)
    block = Piece(rectangle(-size, size, 0.0, 1.2 * size), "#b5a58a")
    limit = base.mu * float(response.options["gravity_m_s2"])
    far = length_unit([response.outcome.max_slip_m], gal=gal)
    level = not base.slope_deg and not response.options["vertical"]
    return Film(
        title=titled(setting(response), _fate(response.outcome, far)),
        heading=heading_of([motion]),
        direction=motion.name,
        time=times,
        scene=Plane(
            shift=ground_shift(motion, times),
            bodies=(Body((block,), x, z, turn),),
            floors=(_floor(base, float(np.abs(slip).max()) + 4.0 * size),),
            trails=(Trail(tell("object"), response.time, *path),),
        ),
        strips=(
            ground_strip(motion, (-limit, limit) if level else (), gal=gal),
            Strip(tell("x − z ({unit})", unit=far.name), (Line(response.time, response["displacement"] / far.size),)),
        ),
        phases=response.phases,
        colours=COLOURS,
    )


def _fate(outcome: SlideOutcome, far: Unit) -> str:
    """Return what becomes of the object, in few words."""
    return tell("slides up to {most}", most=told_length(outcome.max_slip_m, far)) if outcome.slips else tell("does not slide")


def place(base: SlidingBase, slip: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return where an object is that has slid so far along its base: x, z, m, and its turn, rad, (n,).

    Downhill is +x on a positive slope; beyond the foot of the slope the path is level.
    """
    down = math.copysign(1.0, base.slope_deg)
    angle = abs(base.angle)
    foot = math.inf if base.slope_length is None else base.slope_length
    on_slope = np.minimum(down * slip, foot)
    beyond = down * slip - on_slope
    x = down * (on_slope * math.cos(angle) + beyond)
    return x, -on_slope * math.sin(angle), np.where(beyond > 0.0, 0.0, base.angle)


def _floor(base: SlidingBase, reach: float) -> FloatArray:
    """Return the outline of the base, as far as the object gets and further."""
    down = math.copysign(1.0, base.slope_deg)
    ends = [-down * 3.0 * reach, *([] if base.slope_length is None else [down * base.slope_length]), down * 3.0 * reach]
    if base.slope_length is not None:
        ends[-1] = down * (base.slope_length + 3.0 * reach)
    x, z, _ = place(base, np.array(ends))
    deep = float(z.min()) - 2.0 * reach
    return np.array([*zip(x, z, strict=True), (x[-1], deep), (x[0], deep)])
