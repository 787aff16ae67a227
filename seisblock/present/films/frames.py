"""The pictures of a film, for formats that hold pictures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.text import Text
from PIL import Image

from seisblock.present.figures import canvas
from seisblock.present.figures.curves import curve
from seisblock.present.films.animation import Filming, stage
from seisblock.present.films.film import Film
from seisblock.present.films.plane import Plane
from seisblock.present.films.scenes import Actor, PlaneActor, SpaceActor
from seisblock.present.wrap import columns
from seisblock.words import tell

MOST_COLUMNS = 12
"""Of a label as high as its strip; a longer one has two lines."""

CURSOR: dict[str, Any] = {"color": "0.1", "linewidth": 1.2, "clip_on": False, "marker": "v", "markersize": 5, "markevery": [1]}
"""Whole, and with a head, where the film begins and ends, too: there it stands on the edge of its strip."""


@dataclass(frozen=True, eq=False)
class Stage:
    """A film's figure: scenes above, a panel per strip below, a clock and a cursor in each panel."""

    film: Film
    sheet: canvas.Sheet
    actors: Sequence[Actor]
    panels: Sequence[Axes]
    clock: Text
    cursors: Sequence[Any]

    @property
    def moving(self) -> list[Any]:
        """What is drawn anew in each picture."""
        return [*(artist for actor in self.actors for artist in actor.artists), self.clock, *self.cursors]

    def show(self, index: int, told: str) -> None:
        """Set everything to a picture, with what is told beside the clock."""
        now = float(self.film.time[index])
        for actor in self.actors:
            actor.place(index, now)
        self.clock.set_text(f"{now:.3f} s   {told}   {self.film.phase_at(now)}")
        for cursor in self.cursors:
            cursor.set_xdata([now, now])


def film_frames(film: Film, speed: float, filming: Filming) -> Iterator[Image.Image]:
    """Yield the pictures.

    Parameters
    ----------
    film : Film
        For the times of these pictures.
    speed : float
        How many times faster than life it plays.
    filming : Filming
        Progress.
    """
    made, told = set_up(film, gal=filming.gal), pace(speed)

    def draw(index: int) -> None:
        made.show(index, told)
        if filming.progress is not None:
            filming.progress(index + 1, film.time.size)

    return stage(made.sheet, made.moving, draw, film.time.size)


def set_up(film: Film, *, gal: bool = True) -> Stage:
    """Return a film's figure: the scene true to scale, what is shown enlarged beside it, in cm or in m, and the curves below."""
    strips, scene = film.panels, film.scene
    tall = 3.0 if isinstance(scene, Plane) else 4.4
    sheet = canvas.Sheet(8.0, 0.6 + tall + 1.15 * len(strips), dpi=100)
    sheet.entitle(film.heading)
    heights = (tall + 0.6, *([1.0] * len(strips)))
    grid = sheet.add_gridspec(1 + len(strips), 2, height_ratios=heights, width_ratios=(1.35, 1.0))
    beside = isinstance(scene, Plane) and scene.close is not None
    above = sheet.add_subplot(grid[0, 0] if beside else grid[0, :])
    above.set_title(film.title, fontsize=9, loc="left", pad=20, parse_math=False)
    actors: list[Actor] = [
        PlaneActor(above, scene, moving=True, gal=gal) if isinstance(scene, Plane) else SpaceActor(above, scene, gal=gal)
    ]
    if isinstance(scene, Plane) and beside:
        actors.append(PlaneActor(sheet.add_subplot(grid[0, 1]), scene, moving=False, gal=gal))
    panels: list[Axes] = []
    for index in range(len(strips)):
        panels.append(sheet.add_subplot(grid[1 + index, :], sharex=panels[0] if panels else None))
        _strip(panels[-1], film, index)
    if film.note:
        above.annotate(film.note, (0.0, 0.0), (0.0, -4.0), "axes fraction", "offset points", va="top", fontsize=8, color="0.35")
    clock = above.annotate(" ", (0.0, 1.0), (0.0, 5.0), "axes fraction", "offset points", va="bottom", fontsize=9)
    cursors = [panel.axvline(film.time[0], **CURSOR) for panel in panels]
    return Stage(film, sheet, actors, panels, clock, cursors)


def pace(speed: float) -> str:
    """Say how fast a film plays."""
    if abs(speed - 1.0) < 1e-9:
        return tell("real time")
    return tell("{times:g} x real time", times=speed) if speed > 1.0 else tell("{times:g} x slower", times=1 / speed)


def _strip(axis: Axes, film: Film, index: int) -> None:
    """Draw one strip with its thresholds and the phases; the last has the clock's axis."""
    strip, last = film.panels[index], index + 1 == len(film.panels)
    canvas.dress(axis)
    canvas.shade(axis, film.seen, dict(film.colours), names=index == 0, direction=film.direction)
    for line in strip.lines:
        style: dict[str, Any] = {"linestyle": (0, line.dashes)} if line.dashes else {}
        curve(axis, line.time, line.values, color=line.colour, label=line.name or None, **style)
    canvas.threshold(axis, strip.levels)
    axis.set_xlim(film.time[0], film.time[-1])
    low, high = strip.range_over(float(film.time[0]), float(film.time[-1]))
    margin = 0.08 * (high - low)
    axis.set_ylim(low - margin, high + margin)
    axis.tick_params(labelbottom=last)
    canvas.label(axis, tell("t (s)") if last else "", strip.label if columns(strip.label) <= MOST_COLUMNS else canvas.in_two(strip.label))
    canvas.legend(axis)
