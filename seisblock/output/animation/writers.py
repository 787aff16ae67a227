"""Writing of animations to files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from seisblock.core.i18n import join_list
from seisblock.output.animation import render
from seisblock.output.animation.animation import Animation, BuildAnimation
from seisblock.output.animation.frames import animation_frames
from seisblock.output.animation.html import animation_html
from seisblock.output.animation.render import AnimationOptions
from seisblock.output.io.atomic import check_animation, write_text

MAX_GIF_FRAMES = 600
"""Frames of a GIF at most (2 to 4 MB)."""

HTML_RATE, MAX_HTML_FRAMES = 250.0, 12000
"""Frames per second of an HTML page, enough for smooth slow motion, and frames at most."""


def write_animation(
    build: BuildAnimation, span: tuple[float, float], path: Path | str, options: AnimationOptions, *, rate: float = HTML_RATE
) -> None:
    """Write an animation in the format of the suffix.

    Parameters
    ----------
    build : callable
        Returns the animation for the times of its frames.
    span : (float, float), s
        First and last time.
    path : path
        ``.gif``, ``.mp4`` (requires ffmpeg or the package imageio-ffmpeg), or ``.html`` (self-contained page, any size and speed).
    options : AnimationOptions
        Speed, units and progress callback.
    rate : float, 1/s
        Frames per second of a page; fewer for many bodies.

    Raises
    ------
    OutputError
        If the suffix is not supported, ffmpeg is missing for .mp4, or the file cannot be written.
    """
    target = Path(path)
    check_animation(target)
    if target.suffix.lower() == ".html":
        count = int(min(max((span[1] - span[0]) * rate, 2), MAX_HTML_FRAMES)) + 1
        write_text(target, animation_html(_titled(build(np.linspace(*span, count)), options), options))
        return
    max_frames = MAX_GIF_FRAMES if target.suffix.lower() == ".gif" else render.MAX_FRAMES
    times, speed = render.frame_times(*span, slow=options.slow, max_frames=max_frames)
    film = _titled(build(np.asarray(times)), options)
    render.write_frames(animation_frames(film, speed, options), target)


def _titled(film: Animation, options: AnimationOptions) -> Animation:
    """Return an animation with the overturning probability in its title."""
    return replace(film, title=join_list([film.title, options.probability])) if options.probability else film
