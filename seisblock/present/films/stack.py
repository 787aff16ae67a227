"""The pile in three dimensions, orthographic, on its moving ground, with tilts running below."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from PIL import Image

from seisblock.bodies.pile.pile import Pile
from seisblock.measures import ground_history
from seisblock.present.figures import canvas
from seisblock.present.figures.curves import curve
from seisblock.present.figures.stack import DASHES, SHADES, stretch
from seisblock.present.films.animation import REAL_TIME, Filming, animate, frame_times, stage
from seisblock.present.films.frames import pace
from seisblock.results import Response
from seisblock.solvers.stack.outcome import StackOutcome, rotated
from seisblock.typing import FloatArray
from seisblock.words import tell

AZIMUTH, ELEVATION = math.radians(-60.0), math.radians(16.0)
"""Where the viewer stands: from +x towards +y, and above the ground."""

STONE, LIGHT = np.array([0.80, 0.77, 0.72]), np.array([0.25, -0.55, 0.80])
_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
_CORNERS = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def view_axes() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the unit vectors to the right, upwards in the picture, and towards the viewer."""
    c, s, ce, se = math.cos(AZIMUTH), math.sin(AZIMUTH), math.cos(ELEVATION), math.sin(ELEVATION)
    return np.array([-s, c, 0.0]), np.array([-c * se, -s * se, ce]), np.array([c * ce, s * ce, se])


def ground_path(response: Response[StackOutcome]) -> FloatArray:
    """Return the displacement of the ground along, across and up, (3, samples), m, on the baseline of PGD; rows left out stay zero."""
    motion = response.motion
    acts = (True, bool(response.options["across"]), bool(response.options["vertical"]))
    still = np.zeros(motion.samples)
    rows = zip(acts, motion.acceleration, strict=True)
    return np.array([ground_history(row, motion.dt).displacement if act and row.any() else still for act, row in rows])


def animate_stack(response: Response[StackOutcome], path: Path | str, filming: Filming = REAL_TIME) -> None:
    """Draw a pile on its moving ground, true to scale and, unless told otherwise, in real time.

    Parameters
    ----------
    response : Response
        Of :func:`~seisblock.solvers.stack.solve.solve_stack`.
    path : path
        ``.gif``, ``.mp4`` (needs ffmpeg) or ``.html``.
    filming : Filming
        Speed and progress.
    """
    first, last = stretch(response, margin=1.5)
    times, speed = frame_times(first, last, slow=filming.slow)
    animate(_pictures(response, np.asarray(times), speed, filming), path)


def _pictures(response: Response[StackOutcome], times: FloatArray, speed: float, filming: Filming) -> Iterator[Image.Image]:
    """Yield the pictures at these times."""
    body: Pile = response.body
    figure = canvas.Sheet(7.0, 7.6, dpi=100)
    grid = figure.add_gridspec(2, 1, height_ratios=(3.6, 1.0))
    scene, below = figure.add_subplot(grid[0]), figure.add_subplot(grid[1])
    canvas.dress(below)
    for index, name in enumerate(reversed(body.names)):
        style: dict[str, Any] = {"color": SHADES[index % len(SHADES)], "linestyle": DASHES[index % len(DASHES)], "label": tell(name)}
        curve(below, response.time, np.degrees(response[f"{name}_tilt"]), **style)
    canvas.label(below, tell("t (s)"), tell("θ (deg)"))
    canvas.legend(below, ncols=7)
    below.set_xlim(times[0], times[-1])
    centres, quaternions = _on_frames(response, times)
    moved = np.array([np.interp(times, response.motion.time, row) for row in ground_path(response)]).T
    scene.set_aspect("equal")
    scene.axis("off")
    _frame(scene, body, centres + moved[:, None])
    floor = PolyCollection([], facecolors="0.90", edgecolors="0.75", linewidths=0.8)
    stones = PolyCollection([], linewidths=0.8)
    scene.add_collection(floor)
    scene.add_collection(stones)
    clock = scene.text(0.02, 0.98, " ", transform=scene.transAxes, va="top", fontsize=9)
    line = below.axvline(times[0], color="0.1", linewidth=1.0)
    told = pace(speed)
    fallen = {stone.name: stone.fell_at_s for stone in response.outcome.stones}

    def draw(index: int) -> None:
        now = float(times[index])
        floor.set_verts(_floor(body, moved[index]))
        faces, shades, edges = _pictured(body, centres[index] + moved[index], quaternions[index], fallen, now)
        stones.set_verts(faces)
        stones.set_facecolor(shades)
        stones.set_edgecolor(edges)
        clock.set_text(f"{now:.3f} s   +x = {response.motion.name or 'x'}\n{told}")
        line.set_xdata([now, now])
        if filming.progress is not None:
            filming.progress(index + 1, len(times))

    return stage(figure, [floor, stones, clock, line], draw, len(times))


def _on_frames(response: Response[StackOutcome], times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return centres and quaternions of the stones at the times of the pictures, (frames, stones, 3) and (frames, stones, 4)."""
    names = response.body.names
    centres = np.array([[np.interp(times, response.time, response[f"{name}_{axis}"]) for axis in "xyz"] for name in names])
    turns = np.array([[np.interp(times, response.time, response[f"{name}_q{axis}"]) for axis in "wxyz"] for name in names])
    turns = turns / np.linalg.norm(turns, axis=1, keepdims=True)
    return np.moveaxis(centres, -1, 0), np.moveaxis(turns, -1, 0)


def _frame(scene: Axes, body: Pile, centres: FloatArray) -> None:
    """Set limits that hold the pile wherever it goes, but not a stone that rolls far away."""
    right, up, _ = view_axes()
    tall = max(centre[2] + 0.5 * stone.height for centre, stone in zip(body.centres(), body.stones, strict=True))
    reach = 1.4 * max(max(stone.width, stone.depth) for stone in body.stones)
    across, high = centres @ right, centres @ up
    wide = 1.2 * tall
    scene.set_xlim(max(float(across.min()) - reach, -wide), min(float(across.max()) + reach, wide))
    scene.set_ylim(max(float(high.min()) - reach, -0.6 * tall), min(float(high.max()) + reach, 1.5 * tall))


def _floor(body: Pile, moved: FloatArray) -> list[FloatArray]:
    """Return the patch of ground under the pile, drawn where the ground has moved to."""
    right, up, _ = view_axes()
    half = 1.1 * max(max(stone.width, stone.depth) for stone in body.stones)
    patch = np.array([(x * half, y * half, 0.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]) + moved
    return [np.column_stack([patch @ right, patch @ up])]


def _pictured(
    body: Pile, centres: FloatArray, quaternions: FloatArray, fallen: dict[str, float | None], time: float
) -> tuple[list[FloatArray], list[FloatArray], list[str]]:
    """Return the faces that the viewer sees, from the farthest to the nearest, their shades and the colours of their edges."""
    right, up, ahead = view_axes()
    seen = []
    for i, stone in enumerate(body.stones):
        corners = centres[i] + rotated(quaternions[i], _CORNERS * np.array(stone.size))
        fell = fallen[stone.name]
        edge = canvas.ACCENT if fell is not None and time >= fell else "0.25"
        for face in _FACES:
            points = corners[list(face)]
            normal = np.cross(points[1] - points[0], points[2] - points[1])
            normal = normal / np.linalg.norm(normal)
            if normal @ ahead > 1e-9:
                shade = np.clip(STONE * (0.72 + 0.32 * float(normal @ LIGHT)), 0.0, 1.0)
                seen.append((float(points.mean(axis=0) @ ahead), np.column_stack([points @ right, points @ up]), shade, edge))
    seen.sort(key=lambda entry: entry[0])
    return [face for _, face, _, _ in seen], [shade for _, _, shade, _ in seen], [edge for _, _, _, edge in seen]
