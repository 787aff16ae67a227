"""The pictures of a film, for formats that hold pictures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from PIL import Image

from seisblock.present.figures import canvas
from seisblock.present.figures.curves import curve
from seisblock.present.films.animation import Filming, stage
from seisblock.present.films.film import Film
from seisblock.words import tell

FLOOR, EDGE = "#c9ccd0", "0.2"


def film_frames(film: Film, speed: float, filming: Filming) -> Iterator[Image.Image]:
    """Yield the pictures: the scene true to scale, what is shown enlarged beside it, and the curves below.

    Parameters
    ----------
    film : Film
        For the times of these pictures.
    speed : float
        How many times faster than life it plays.
    filming : Filming
        Progress.
    """
    figure = canvas.Sheet(8.0, 4.2 + 1.15 * len(film.strips), dpi=100)
    figure.entitle(film.title)
    grid = figure.add_gridspec(1 + len(film.strips), 2, height_ratios=(3.6, *([1.0] * len(film.strips))), width_ratios=(1.35, 1.0))
    scene = figure.add_subplot(grid[0, 0] if film.close else grid[0, :])
    actors = [_Scene(scene, film, moving=True)]
    if film.close:
        actors.append(_Scene(figure.add_subplot(grid[0, 1]), film, moving=False))
    panels: list[Axes] = []
    for index, strip in enumerate(film.strips):
        panels.append(figure.add_subplot(grid[1 + index, :], sharex=panels[0] if panels else None))
        _strip(panels[-1], film, index, last=index + 1 == len(film.strips))
        canvas.label(panels[-1], y=strip.label)
    clock = scene.text(0.01, 0.985, " ", transform=scene.transAxes, va="top", fontsize=9)
    cursors = [panel.axvline(film.time[0], color="0.1", linewidth=1.0) for panel in panels]
    told = pace(speed)

    def draw(index: int) -> None:
        now = float(film.time[index])
        for actor in actors:
            actor.place(index)
        clock.set_text(f"{now:.3f} s   {tell(film.phase_at(now))}\n{told}")
        for cursor in cursors:
            cursor.set_xdata([now, now])
        if filming.progress is not None:
            filming.progress(index + 1, film.time.size)

    moving = [artist for actor in actors for artist in actor.artists]
    return stage(figure, [*moving, clock, *cursors], draw, film.time.size)


def pace(speed: float) -> str:
    """Say how fast a film plays."""
    if abs(speed - 1.0) < 1e-9:
        return tell("real time")
    return tell("{times:g} x real time", times=speed) if speed > 1.0 else tell("{times:g} x slower", times=1 / speed)


class _Scene:
    """The bodies on their ground in one panel, in a frame that stands still or in the ground's."""

    def __init__(self, axis: Axes, film: Film, *, moving: bool) -> None:
        self.film, self.moving = film, moving
        left, right, bottom, top = film.extent if moving or film.close is None else film.close
        axis.set_aspect("equal")
        axis.set_xlim(left, right)
        axis.set_ylim(bottom, top)
        if moving:
            axis.axis("off")
        else:
            canvas.dress(axis)
            canvas.label(axis, "x (m)", "z (m)")
            axis.set_title(tell("enlarged, seen from the ground"), fontsize=8, loc="left")
        self.floors = [Polygon(floor, facecolor=FLOOR, edgecolor="none") for floor in film.floors]
        self.ticks = axis.plot([], [], "|", color="0.45", markersize=6, clip_on=True)[0] if moving else None
        self.marks = _marks(left, right)
        self.level = float(film.floors[0][:, 1].max()) if film.floors else 0.0
        self.pieces = [
            (body, piece, Polygon(piece.corners, facecolor=piece.colour, edgecolor=EDGE, linewidth=1.1, alpha=0.92))
            for body in film.bodies
            for piece in body.pieces
        ]
        for shape in (*self.floors, *(shape for _, _, shape in self.pieces)):
            axis.add_patch(shape)
        self.trails = [(trail, axis.plot([], [], color=trail.colour, linewidth=1.2)[0]) for trail in film.trails]
        if not moving and film.trails:
            for trail, line in self.trails:
                line.set_label(trail.name)
            axis.legend(fontsize=7, frameon=False, loc="upper right", bbox_to_anchor=(1.0, 1.13), ncols=2, borderaxespad=0.0)

    @property
    def artists(self) -> Sequence[Any]:
        """What is drawn anew in each picture."""
        ticks = [self.ticks] if self.ticks is not None else []
        return [*self.floors, *ticks, *(patch for _, _, patch in self.pieces), *(line for _, line in self.trails)]

    def place(self, index: int) -> None:
        """Put everything where it is in a picture."""
        shift = np.array([float(self.film.shift[index]) if self.moving else 0.0, 0.0])
        for floor, patch in zip(self.film.floors, self.floors, strict=True):
            patch.set_xy(floor + shift)
        if self.ticks is not None:
            self.ticks.set_data(self.marks + shift[0], np.full(self.marks.size, self.level))
        for body, piece, patch in self.pieces:
            patch.set_xy(body.placed(piece.corners, index) + shift)
        for trail, line in self.trails:
            line.set_data(trail.x[: index + 1] + shift[0], trail.z[: index + 1])


def _marks(left: float, right: float) -> Any:
    """Return places of marks on the ground, without which one would not see it move."""
    width = right - left
    return np.arange(left - width, right + width, width / 12)


def _strip(axis: Axes, film: Film, index: int, *, last: bool) -> None:
    """Draw one curve with its thresholds and the phases."""
    strip = film.strips[index]
    canvas.dress(axis)
    canvas.shade(axis, film.seen, dict(film.colours))
    curve(axis, strip.time, strip.values, color=strip.colour)
    canvas.threshold(axis, strip.levels)
    axis.set_xlim(film.time[0], film.time[-1])
    inside = strip.values[(strip.time >= film.time[0]) & (strip.time <= film.time[-1])]
    low, high = float(np.min(inside, initial=0.0)), float(np.max(inside, initial=0.0))
    margin = 0.08 * (high - low) or 1.0
    axis.set_ylim(low - margin, high + margin)
    axis.tick_params(labelbottom=last)
    if last:
        canvas.label(axis, tell("t (s)"))
