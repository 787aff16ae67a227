"""The block rocking on its shaking ground, with the record running below."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from seisblock.bodies.block import Block
from seisblock.present import canvas
from seisblock.present.animation import FRAMES_PER_SECOND, animate, frame_times, stage
from seisblock.present.rock import draw_ground, draw_lean, stretch
from seisblock.results import Response
from seisblock.solvers.rock_outcome import RockOutcome
from seisblock.typing import FloatArray


def animate_rocking(response: Response[RockOutcome], path: Path | str, *, fps: int = FRAMES_PER_SECOND) -> None:
    """Draw a rocking block, true to scale and, unless it says otherwise, in real time.

    Parameters
    ----------
    response : Response
        Of :func:`~seisblock.solvers.rock.solve_rock`.
    path : path
        ``.gif``, ``.mp4`` or ``.html``.
    fps : int
        Pictures per second.
    """
    block: Block = response.body
    first, last = stretch(response)
    times, speed = frame_times(first, last, fps)
    figure = Figure(figsize=(7.2, 6.8), dpi=100, layout="constrained")
    grid = figure.add_gridspec(3, 1, height_ratios=(2.3, 1.0, 1.0))
    scene, above = figure.add_subplot(grid[0]), figure.add_subplot(grid[1])
    below = figure.add_subplot(grid[2], sharex=above)
    for axis in (above, below):
        canvas.dress(axis)
    draw_ground(above, response, gal=True)
    draw_lean(below, response)
    above.set_xlim(first, last)
    reach = 1.08 * math.hypot(block.width, block.height)
    scene.set_aspect("equal")
    scene.set_xlim(-1.6 * reach, 1.6 * reach)
    scene.set_ylim(-0.12 * block.height, 1.1 * reach)
    scene.axis("off")
    scene.fill_between([-1.6 * reach, 1.6 * reach], -0.12 * block.height, 0.0, color="0.8", linewidth=0)
    shape = Polygon(corners(block, 0.0), facecolor="#d9d3c7", edgecolor="0.2", linewidth=1.2, closed=True)
    scene.add_patch(shape)
    (centre,) = scene.plot([], [], "o", color=canvas.ACCENT, markersize=4)
    clock = scene.text(0.02, 0.98, "", transform=scene.transAxes, va="top", fontsize=9, family="monospace")
    lines = [axis.axvline(first, color="0.1", linewidth=1.0) for axis in (above, below)]
    slower = "" if speed == 1 else f"\n{speed:g} x real time"
    lean = np.interp(times, response.time, response["rotation"])

    def draw(index: int) -> None:
        theta = float(lean[index])
        shape.set_xy(corners(block, theta))
        centre.set_data(*([value] for value in centre_of(block, theta)))
        clock.set_text(f"t {times[index]:7.2f} s\nθ {math.degrees(theta):+7.2f}°{slower}")
        for line in lines:
            line.set_xdata([times[index], times[index]])

    animate(stage(figure, [shape, centre, clock, *lines], draw, len(times)), path, fps=fps)


def corners(block: Block, theta: float) -> FloatArray:
    """Return the corners of the leaning block, (4, 2), m, from the middle of its base at rest."""
    half = block.width / 2
    at_rest = np.array([[-half, 0.0], [half, 0.0], [half, block.height], [-half, block.height]])
    return _turned(at_rest, block, theta)


def centre_of(block: Block, theta: float) -> tuple[float, float]:
    """Return where the centre of gravity of the leaning block is, m."""
    x, z = _turned(np.array([[block.centroid_offset, block.centre]]), block, theta)[0]
    return float(x), float(z)


def _turned(points: FloatArray, block: Block, theta: float) -> FloatArray:
    """Turn points about the corner in contact: the right one when the lean is positive."""
    pivot = np.array([math.copysign(block.width / 2, theta), 0.0])
    cosine, sine = math.cos(theta), math.sin(theta)
    x, z = (points - pivot).T
    return np.column_stack([x * cosine + z * sine, z * cosine - x * sine]) + pivot
