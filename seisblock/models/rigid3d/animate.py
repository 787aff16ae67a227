"""Animation of a body in three dimensions, with record, tilt and twist below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from seisblock.bodies.convex import convex_body
from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.models.rigid3d.plot import motion_interval, twist_history
from seisblock.output.animation.animation import Animation, Line, Strip, ground_strip
from seisblock.output.animation.render import REAL_TIME, AnimationOptions
from seisblock.output.animation.scene3d import FRAMES_PER_RAD, Scene3D, Solid, ground_path
from seisblock.output.animation.writers import write_animation
from seisblock.output.figures.heading import motions_heading
from seisblock.output.figures.style import ACCENT, SECOND


def animate(response: Response[Rigid3dOutcome], path: Path | str, options: AnimationOptions = REAL_TIME) -> None:
    """Write the animation of a body, see :func:`seisblock.output.animation.writers.write_animation`."""
    span = motion_interval(response)
    write_animation(lambda times: rigid3d_animation(response, times, gal=options.gal), span, path, options, rate=FRAMES_PER_RAD)


def rigid3d_animation(response: Response[Rigid3dOutcome], times: FloatArray, *, gal: bool = True) -> Animation:
    """Return the animation of the hull of a body for the times of its frames, (n,), s."""
    body, motion, options = convex_body(response.body), response.motion, response.options
    centre = np.array([np.interp(times, response.time, response[axis]) for axis in "xyz"]).T
    turn = np.array([np.interp(times, response.time, response[f"q{axis}"]) for axis in "wxyz"]).T
    extents = np.ptp(body.points, axis=0)
    size = (float(extents[0]), float(extents[1]), float(extents[2]))
    fell = response.outcome.overturning_time_s
    solid = Solid(
        size,
        centre,
        turn / np.linalg.norm(turn, axis=1, keepdims=True),
        math.inf if fell is None else fell,
        hull=body.points - np.array(body.centre),
    )
    return Animation(
        title=gettext(body.name),
        heading=motions_heading([motion]),
        direction=motion.name,
        note=f"+x = {motion.name or 'x'}",
        time=times,
        scene=Scene3D(ground_path(motion, (True, bool(options.across), bool(options.vertical)), times), (solid,), 1.1 * max(size[:2])),
        strips=(
            ground_strip(motion, gal=gal),
            Strip(gettext("tilt (deg)"), (Line(response.time, np.degrees(response["tilt"]), ACCENT, ""),)),
            Strip(gettext("twist (deg)"), (Line(response.time, twist_history(response), SECOND, ""),)),
        ),
    )
