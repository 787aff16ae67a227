"""Frames of an animation for raster formats."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.text import Text
from PIL import Image

from seisblock.core.i18n import gettext
from seisblock.output.animation.animation import Animation
from seisblock.output.animation.artists import Artist2D, Artist3D, SceneArtist
from seisblock.output.animation.render import AnimationOptions, render
from seisblock.output.animation.scene2d import Scene2D
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.text.wrap import display_width

MAX_LABEL_COLUMNS = 12
"""Width of a one-line axis label; longer labels are split in two lines."""

CURSOR: dict[str, Any] = {"color": "0.1", "linewidth": 1.2, "clip_on": False, "marker": "v", "markersize": 5, "markevery": [1]}
"""Style of the time cursor; not clipped, so that its head is complete at the edges of the panel."""


@dataclass(frozen=True, eq=False)
class AnimationFigure:
    """Figure of an animation: scenes above, a panel per strip below, a clock, and a time cursor in every panel."""

    film: Animation
    fig: style.StyledFigure
    actors: Sequence[SceneArtist]
    panels: Sequence[Axes]
    clock: Text
    cursors: Sequence[Any]

    @property
    def moving(self) -> list[Any]:
        """Artists redrawn in every frame."""
        return [*(artist for actor in self.actors for artist in actor.artists), self.clock, *self.cursors]

    def show(self, index: int, speed_text: str) -> None:
        """Move the figure to frame `index`, with `speed_text` beside the clock."""
        time = float(self.film.time[index])
        for actor in self.actors:
            actor.place(index, time)
        self.clock.set_text(f"{time:.3f} s   {speed_text}   {self.film.phase_at(time)}")
        for cursor in self.cursors:
            cursor.set_xdata([time, time])


def animation_frames(film: Animation, speed: float, options: AnimationOptions) -> Iterator[Image.Image]:
    """Yield the frames of an animation.

    Parameters
    ----------
    film : Animation
        Built for the times of these frames.
    speed : float
        Playback speed over real time.
    options : AnimationOptions
        Units and progress callback.
    """
    figure, speed_text = build_figure(film, gal=options.gal), format_speed(speed)

    def draw(index: int) -> None:
        figure.show(index, speed_text)
        if options.progress is not None:
            options.progress(index + 1, film.time.size)

    return render(figure.fig, figure.moving, draw, film.time.size)


def build_figure(film: Animation, *, gal: bool = True) -> AnimationFigure:
    """Return the figure of an animation: scene to scale, close-up beside it, curves below."""
    strips, scene = film.panels, film.scene
    tall = 3.0 if isinstance(scene, Scene2D) else 4.4
    fig = style.StyledFigure(8.0, 0.6 + tall + 1.15 * len(strips), dpi=100)
    fig.set_title(film.heading)
    heights = (tall + 0.6, *([1.0] * len(strips)))
    grid = fig.add_gridspec(1 + len(strips), 2, height_ratios=heights, width_ratios=(1.35, 1.0))
    has_close_up = isinstance(scene, Scene2D) and scene.close is not None
    scene_axes = fig.add_subplot(grid[0, 0] if has_close_up else grid[0, :])
    scene_axes.set_title(film.title, fontsize=9, loc="left", pad=20, parse_math=False)
    actors: list[SceneArtist] = [
        Artist2D(scene_axes, scene, moving=True, gal=gal) if isinstance(scene, Scene2D) else Artist3D(scene_axes, scene, gal=gal)
    ]
    if isinstance(scene, Scene2D) and has_close_up:
        actors.append(Artist2D(fig.add_subplot(grid[0, 1]), scene, moving=False, gal=gal))
    panels: list[Axes] = []
    for index in range(len(strips)):
        panels.append(fig.add_subplot(grid[1 + index, :], sharex=panels[0] if panels else None))
        _draw_strip(panels[-1], film, index)
    if film.note:
        scene_axes.annotate(film.note, (0.0, 0.0), (0.0, -4.0), "axes fraction", "offset points", va="top", fontsize=8, color="0.35")
    clock = scene_axes.annotate(" ", (0.0, 1.0), (0.0, 5.0), "axes fraction", "offset points", va="bottom", fontsize=9)
    cursors = [panel.axvline(film.time[0], **CURSOR) for panel in panels]
    return AnimationFigure(film, fig, actors, panels, clock, cursors)


def format_speed(speed: float) -> str:
    """Return the playback speed as text."""
    if abs(speed - 1.0) < 1e-9:
        return gettext("real time")
    return gettext("{times:g} × real time", times=speed) if speed > 1.0 else gettext("1/{times:g} × real time", times=1 / speed)


def _draw_strip(axis: Axes, film: Animation, index: int) -> None:
    """Draw one strip with thresholds and phases; only the last has labels on the time axis."""
    strip, last = film.panels[index], index + 1 == len(film.panels)
    style.style_axes(axis)
    style.shade_phases(axis, film.visible_phases, dict(film.colours), names=index == 0, direction=film.direction)
    for line in strip.lines:
        line_kwargs: dict[str, Any] = {"linestyle": (0, line.dashes)} if line.dashes else {}
        draw_curve(axis, line.time, line.values, color=line.colour, label=line.name or None, **line_kwargs)
    style.draw_thresholds(axis, strip.levels)
    axis.set_xlim(film.time[0], film.time[-1])
    low, high = strip.range_over(float(film.time[0]), float(film.time[-1]))
    margin = 0.08 * (high - low)
    axis.set_ylim(low - margin, high + margin)
    axis.tick_params(labelbottom=last)
    style.label_axes(
        axis,
        gettext("t (s)") if last else "",
        strip.label if display_width(strip.label) <= MAX_LABEL_COLUMNS else style.split_in_two(strip.label),
    )
    style.add_legend(axis)
