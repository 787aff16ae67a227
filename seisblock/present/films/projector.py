"""The projector: from a film to a file, pictures or a page."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from seisblock.present.files import check_film, write_text
from seisblock.present.films import animation
from seisblock.present.films.animation import Filming
from seisblock.present.films.film import Build
from seisblock.present.films.frames import film_frames
from seisblock.present.films.page import film_page

MOST_IN_GIF = 600
"""Pictures of a .gif, which holds of each what is new in it: some 2 to 4 MB."""

PAGE_RATE, MOST_MOMENTS = 250.0, 12000
"""Moments a second that a page holds, so that slow motion stays smooth, and at most how many."""


def animate_film(build: Build, span: tuple[float, float], path: Path | str, filming: Filming, *, rate: float = PAGE_RATE) -> None:
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
    filming : Filming
        Speed and progress.
    rate : float, 1/s
        Moments that a page holds; fewer where there are many bodies.

    Raises
    ------
    OutputError
        If the suffix is another, ffmpeg is missing for .mp4, or the file cannot be written.
    """
    target = Path(path)
    check_film(target)
    if target.suffix.lower() == ".html":
        count = int(min(max((span[1] - span[0]) * rate, 2), MOST_MOMENTS)) + 1
        write_text(target, film_page(build(np.linspace(*span, count)), filming))
        return
    most = MOST_IN_GIF if target.suffix.lower() == ".gif" else animation.MOST_FRAMES
    times, speed = animation.frame_times(*span, slow=filming.slow, most=most)
    film = build(np.asarray(times))
    animation.animate(film_frames(film, speed, filming), target)
