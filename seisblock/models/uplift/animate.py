"""Animation of a block on corner springs, motion magnified, with record and uplift of the corners below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from seisblock.bodies.spring_block import CORNER_SIGNS, SpringBlock
from seisblock.core.i18n import N_, gettext, join_list
from seisblock.core.results import Phase, Response
from seisblock.core.typing import FloatArray
from seisblock.models.uplift.constants import ALL_CORNERS
from seisblock.models.uplift.model import contact_name
from seisblock.models.uplift.outcome import UpliftOutcome
from seisblock.models.uplift.plot import LIFTED_COLOUR, motion_interval
from seisblock.output.animation.animation import Animation, Line, Strip, ground_strip, sample_at
from seisblock.output.animation.render import REAL_TIME, AnimationOptions
from seisblock.output.animation.scene3d import FRAMES_PER_RAD, Scene3D, Solid, Spring, ground_path
from seisblock.output.animation.writers import write_animation
from seisblock.output.figures.heading import motions_heading
from seisblock.output.units_display import length_unit

MAX_LEAN, MAX_RISE = 0.15, 0.15
"""Largest drawn tilt, rad, and rise over the height; smaller motions are magnified up to these by a round factor."""

SPRING_LENGTH = 0.16
"""Drawn free height of a spring over the height of the block."""

COLOURS = ("#c0392b", "#1f5a8c", "#7d7d7d", "#b8860b")
DASHES: tuple[tuple[float, ...], ...] = ((), (6, 2), (2, 1.5), (6, 2, 1, 2))
"""Dash patterns of the corners."""

IN_AIR = N_("corner uplift")
BEYOND = N_("uplift beyond the range of the model")


def animate(response: Response[UpliftOutcome], path: Path | str, options: AnimationOptions = REAL_TIME) -> None:
    """Write the animation of a block on springs, see :func:`seisblock.output.animation.writers.write_animation`."""
    write_animation(
        lambda times: uplift_animation(response, times, gal=options.gal), motion_interval(response), path, options, rate=FRAMES_PER_RAD
    )


def uplift_animation(response: Response[UpliftOutcome], times: FloatArray, *, gal: bool = True) -> Animation:
    """Return the animation of a block on springs for the times of its frames, (n,), s."""
    body: SpringBlock = response.body
    motion, outcome = response.motion, response.outcome
    factor = magnification(response)
    note = gettext("motion on the springs magnified {factor:g} times; +x = {name}", factor=factor, name=motion.name or "x")
    disp_unit = length_unit((corner.max_uplift_m for corner in outcome.corners), gal=gal)
    lines = tuple(
        Line(response.time, response[f"uplift_{i + 1}"] / disp_unit.size, COLOURS[i], gettext("corner {number}", number=i + 1), DASHES[i])
        for i in range(len(CORNER_SIGNS))
    )
    return Animation(
        title=f"{body.width:g} × {body.depth:g} × {body.height:g} m",
        heading=motions_heading([motion]),
        direction=motion.name,
        note=note if outcome.within_model else join_list([note, gettext(BEYOND)]),
        time=times,
        scene=_scene(response, times, factor),
        strips=(ground_strip(motion, gal=gal), Strip(gettext("u ({unit})", unit=disp_unit.name), lines, (0.0,))),
        phases=_airborne_phases(response),
        colours={IN_AIR: LIFTED_COLOUR},
    )


def magnification(response: Response[UpliftOutcome]) -> float:
    """Return the magnification of the motion on the springs: 1, 2, 5, 10 ..., or below 1 for large motions."""
    rise = max(float(np.abs(response[f"uplift_{i + 1}"]).max()) for i in range(len(CORNER_SIGNS)))
    max_factor = min(MAX_LEAN / max(response.outcome.max_rotation_rad, 1e-12), MAX_RISE * response.body.height / max(rise, 1e-12))
    decade = 10.0 ** math.floor(math.log10(max_factor))
    return decade * max(step for step in (1.0, 2.0, 5.0) if step * decade <= max_factor)


def _scene(response: Response[UpliftOutcome], times: FloatArray, factor: float) -> Scene3D:
    """Return block and springs with magnified motion relative to the ground."""
    body: SpringBlock = response.body
    dx, dy, dz, tilt, tilt_across = (
        factor * sample_at(times, response.time, response[name])
        for name in ("displacement", "displacement_across", "displacement_up", "rotation", "rotation_across")
    )
    # positive tilts to +x and +y are rotations about +y and -x
    turns = Rotation.from_rotvec(np.column_stack([-tilt_across, tilt, np.zeros_like(tilt)]))
    free = SPRING_LENGTH * body.height
    centre = np.column_stack([dx, dy, free + 0.5 * body.height + dz])
    corners = [np.array([x * body.width / 2, y * body.depth / 2, -body.height / 2]) for x, y in CORNER_SIGNS]
    tops = [centre + turns.apply(corner) for corner in corners]
    for i, top in enumerate(tops):
        # height of the corner from its uplift, since a magnified rotation has a spurious second-order rise
        top[:, 2] = free + factor * sample_at(times, response.time, response[f"uplift_{i + 1}"])
    springs = tuple(Spring(corner * [1.0, 1.0, 0.0], top, free) for corner, top in zip(corners, tops, strict=True))
    solid = Solid((body.width, body.depth, body.height), centre, np.roll(turns.as_quat(), 1, axis=1))
    motion = response.motion
    ground = ground_path(motion, (True, True, bool(response.options.vertical)), times)
    return Scene3D(ground, (solid,), 1.1 * max(body.width, body.depth), springs)


def _airborne_phases(response: Response[UpliftOutcome]) -> tuple[Phase, ...]:
    """Return the phases with at least one corner uplifted, adjacent ones merged."""
    lifts: list[Phase] = []
    for phase in response.phases:
        if phase.name == contact_name(ALL_CORNERS):
            continue
        continues = bool(lifts) and lifts[-1].end_s == phase.start_s
        start = lifts.pop().start_s if continues else phase.start_s
        lifts.append(Phase(IN_AIR, start, phase.end_s))
    return tuple(lifts)
