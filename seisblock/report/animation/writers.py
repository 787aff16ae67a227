"""The projector: from a film to a file, pictures or a page."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from seisblock.report.animation import render
from seisblock.report.animation.animation import BuildAnimation
from seisblock.report.animation.frames import animation_frames
from seisblock.report.animation.html import animation_html
from seisblock.report.animation.render import AnimationOptions
from seisblock.report.io.atomic import check_animation, write_text

MAX_GIF_FRAMES = 600
"""Pictures of a .gif, which holds of each what is new in it: some 2 to 4 MB."""

HTML_RATE, MAX_HTML_FRAMES = 250.0, 12000
"""Moments a second that a page holds, so that slow motion stays smooth, and at most how many."""


def write_animation(
    build: BuildAnimation, span: tuple[float, float], path: Path | str, options: AnimationOptions, *, rate: float = HTML_RATE
) -> None:
    """Write a film; the suffix decides the format.

    Parameters
    ----------
    build : callable
        Returns the film for the times of its pictures.
    span : (float, float), s
        First and last time shown.
    path : path
        ``.gif``, ``.mp4`` (needs ffmpeg, or the package imageio-ffmpeg), or ``.html`` (one page that draws the film itself, at any size and
        speed).
    options : Filming
        Speed and progress.
    rate : float, 1/s
        Moments that a page holds; fewer where there are many bodies.

    Raises
    ------
    OutputError
        If the suffix is another, ffmpeg is missing for .mp4, or the file cannot be written.
    """
    target = Path(path)
    check_animation(target)
    if target.suffix.lower() == ".html":
        count = int(min(max((span[1] - span[0]) * rate, 2), MAX_HTML_FRAMES)) + 1
        write_text(target, animation_html(build(np.linspace(*span, count)), options))
        return
    max_frames = MAX_GIF_FRAMES if target.suffix.lower() == ".gif" else render.MAX_FRAMES
    times, speed = render.frame_times(*span, slow=options.slow, max_frames=max_frames)
    film = build(np.asarray(times))
    render.write_frames(animation_frames(film, speed, options), target)
