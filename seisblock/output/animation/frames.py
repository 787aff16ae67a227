"""Frames of an animation for raster formats."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Polygon
from matplotlib.text import Text
from matplotlib.ticker import FuncFormatter
from PIL import Image

from seisblock.core.i18n import gettext
from seisblock.core.typing import FloatArray
from seisblock.output.animation.animation import Animation
from seisblock.output.animation.render import AnimationOptions, render
from seisblock.output.animation.scene2d import Box, Scene2D
from seisblock.output.animation.scene3d import Scene3D, project, view_axes
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.text.wrap import display_width
from seisblock.output.units_display import Unit, length_unit

FLOOR, EDGE = "#c9ccd0", "0.2"

BAR_LENGTHS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
"""Lengths of the scale bar, m."""

COILS, COIL_WIDTH = 5, 0.35
"""Coils of a spring, and its drawn width over its free height."""


class SceneArtist(Protocol):
    """Artist of a scene in a panel."""

    @property
    def artists(self) -> Sequence[Any]:
        """Artists redrawn in every frame."""

    def place(self, index: int, time: float) -> None:
        """Move the artists to frame `index` at `time`, s."""


class Artist2D:
    """Side view of bodies on the ground, in a fixed frame (`moving`) or in the frame of the ground."""

    def __init__(self, axis: Axes, scene: Scene2D, *, moving: bool, gal: bool = True) -> None:
        self.scene, self.moving = scene, moving
        left, right, bottom, top = scene.extent if moving or scene.close is None else scene.close
        axis.set_aspect("equal")
        axis.set_xlim(left, right)
        axis.set_ylim(bottom, top)
        if moving:
            _hide_axes(axis)
            self.bar = _scale_bar(axis, (left, right, bottom, top), gal=gal)
        else:
            self.bar = []
            style.style_axes(axis)
            _format_axes(axis, length_unit([right - left], gal=gal))
            axis.set_title(gettext("close-up, relative to the ground"), fontsize=8, loc="left")
        self.floors = [Polygon(floor, facecolor=FLOOR, edgecolor="none") for floor in scene.floors]
        self.ticks = axis.plot([], [], "|", color="0.45", markersize=6, clip_on=True)[0] if moving else None
        self.marks = _ground_marks(left, right)
        self.level = float(scene.floors[0][:, 1].max()) if scene.floors else 0.0
        self.pieces = [
            (body, piece, Polygon(piece.corners, facecolor=piece.colour, edgecolor=EDGE, linewidth=1.1, alpha=0.92))
            for body in scene.bodies
            for piece in body.pieces
        ]
        for shape in (*self.floors, *(shape for _, _, shape in self.pieces)):
            axis.add_patch(shape)
        self.trails = [(trail, axis.plot([], [], color=trail.colour, linewidth=1.2)[0]) for trail in scene.trails]
        self.key: list[Any] = []
        if not moving and scene.trails:
            for trail, line in self.trails:
                inside = (left < trail.x) & (trail.x < right) & (bottom < trail.z) & (trail.z < top)
                line.set_label(trail.name if inside.any() else None)
            self.key = [axis.legend(fontsize=7, framealpha=0.85, edgecolor="none", loc="upper right")]

    @property
    def artists(self) -> Sequence[Any]:
        """Artists redrawn in every frame."""
        ticks = [self.ticks] if self.ticks is not None else []
        return [*self.floors, *ticks, *(patch for _, _, patch in self.pieces), *(line for _, line in self.trails), *self.key, *self.bar]

    def place(self, index: int, time: float) -> None:
        """Move the artists to frame `index` at `time`, s."""
        shift = np.array([float(self.scene.shift[index]) if self.moving else 0.0, 0.0])
        for floor, patch in zip(self.scene.floors, self.floors, strict=True):
            patch.set_xy(floor + shift)
        if self.ticks is not None:
            self.ticks.set_data(self.marks + shift[0], np.full(self.marks.size, self.level))
        for body, piece, patch in self.pieces:
            patch.set_xy(body.corners_at(piece.corners, index) + shift)
        for trail, line in self.trails:
            x, z = trail.until(time)
            line.set_data(x + shift[0], z)


class Artist3D:
    """Solids on a patch of ground in three dimensions."""

    def __init__(self, axis: Axes, scene: Scene3D, *, gal: bool = True) -> None:
        self.scene = scene
        left, right, bottom, top = scene.extent()
        axis.set_aspect("equal")
        _hide_axes(axis)
        axis.set_xlim(left, right)
        axis.set_ylim(bottom, top)
        self.bar = _scale_bar(axis, (left, right, bottom, top), gal=gal)
        self.floor = PolyCollection([], facecolors="0.90", edgecolors="0.75", linewidths=0.8)
        self.springs = LineCollection([], colors="0.35", linewidths=1.0)
        self.faces = PolyCollection([], linewidths=0.8)
        self.hidden, self.corners = (axis.scatter([], [], s=28, zorder=order, linewidths=0) for order in (0.5, 3))
        for collection in (self.floor, self.springs, self.faces):
            axis.add_collection(collection)

    @property
    def artists(self) -> Sequence[Any]:
        """Artists redrawn in every frame."""
        return [self.floor, self.springs, self.hidden, self.faces, self.corners, *self.bar]

    def place(self, index: int, time: float) -> None:
        """Move the artists to frame `index` at `time`, s."""
        scene, ground = self.scene, self.scene.ground_displacement[index]
        self.floor.set_verts([project(scene.floor(index))])
        faces = list(scene.faces(index, time))
        self.faces.set_verts([project(points) for points, _, _ in faces])
        self.faces.set_facecolor([shade for _, shade, _ in faces])
        self.faces.set_edgecolor([style.ACCENT if has_fallen else "0.25" for _, _, has_fallen in faces])
        coils = [_spring_line(spring.foot + ground, min(float(spring.top[index, 2]), spring.free), spring.free) for spring in scene.springs]
        self.springs.set_segments(coils)
        # the spring farthest from the viewer is hidden behind the block
        hidden_spring, *visible_springs = sorted(scene.springs, key=lambda spring: float(spring.foot @ view_axes()[2])) or (None,)
        for dots, springs in ((self.hidden, [hidden_spring] if hidden_spring else []), (self.corners, visible_springs)):
            dots.set_offsets(np.array([project(spring.top[index] + ground) for spring in springs]).reshape(-1, 2))
            dots.set_facecolor([style.ACCENT if spring.lifted[index] else "0.25" for spring in springs])


def _format_axes(axis: Axes, unit: Unit) -> None:
    """Label the axes of a panel, m, in a display unit."""
    style.label_axes(axis, f"x ({unit.name})", f"z ({unit.name})")
    formatter = FuncFormatter(lambda metres, _: f"{metres / unit.size:.6g}".replace("-", "\N{MINUS SIGN}"))
    axis.xaxis.set_major_formatter(formatter)
    axis.yaxis.set_major_formatter(formatter)


def _scale_bar(axis: Axes, box: Box, *, gal: bool) -> list[Any]:
    """Draw a labelled scale bar of round length in the lower right corner of a scene."""
    left, right, bottom, top = box
    length = max((candidate for candidate in BAR_LENGTHS if candidate < (right - left) / 3), default=BAR_LENGTHS[0])
    size, name = length_unit([length], gal=gal and length < 1.0)
    end, low = right - 0.02 * (right - left), bottom + 0.04 * (top - bottom)
    (line,) = axis.plot([end - length, end], [low, low], color="0.1", linewidth=1.6, solid_capstyle="butt")
    # beside the bar, since the ground marks are above it
    style: dict[str, Any] = {"xytext": (-3.0, 0.0), "textcoords": "offset points", "ha": "right", "va": "center_baseline"}
    return [line, axis.annotate(f"{length / size:g} {name}", (end - length, low), fontsize=8, **style)]


def _hide_axes(axis: Axes) -> None:
    """Hide frame, ticks and labels of a panel."""
    axis.axis("off")
    axis.set(xticks=[], yticks=[])


def _spring_line(foot: FloatArray, height: float, free: float) -> FloatArray:
    """Return the zigzag of a spring from its foot to a height, projected, (k, 2)."""
    low, high = project(foot + np.array([[0.0, 0.0, 0.0], [0.0, 0.0, height]]))
    share = np.linspace(0.0, 1.0, 2 * COILS + 2)
    aside = np.array([0.0, *(COIL_WIDTH * free * (0.5 if i % 2 else -0.5) for i in range(2 * COILS)), 0.0])
    return np.column_stack([low[0] + aside, low[1] + share * (high[1] - low[1])])


def _ground_marks(left: float, right: float) -> Any:
    """Return the positions of marks on the ground that make its motion visible, m."""
    width = right - left
    return np.arange(left - width, right + width, width / 12)


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
