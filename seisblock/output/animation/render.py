"""Rendering of frames and writing of GIF and MP4 files."""

from __future__ import annotations

import errno
import os
import subprocess
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from seisblock.core.errors import OutputError
from seisblock.core.i18n import gettext, join_alternatives
from seisblock.core.typing import Progress
from seisblock.output.io.atomic import atomic_write, check_animation, find_ffmpeg

FRAMES_PER_SECOND = 20
"""Default frame rate, 1/s; GIF times are in 0.01 s, hence 20, 25 and 50 are exact."""

TRANSPARENT = 128
"""Palette index of transparent pixels in a GIF, after the colours."""

MAX_FRAMES = 1200
"""Frames of an animation at most; longer responses are played faster."""


@dataclass(frozen=True)
class AnimationOptions:
    """Options of an animation.

    Parameters
    ----------
    slow : float
        Slow-motion factor.
    progress : callable
    gal : bool
        Accelerations in gal if true, else m/s².
    probability : str
        Overturning probability of the body for the title; empty without samples.
    """

    slow: float = 1.0
    progress: Progress | None = None
    gal: bool = True
    probability: str = ""


REAL_TIME = AnimationOptions()
"""Default options: real time."""


def render(figure: Figure, moving: Sequence[Any], draw: Callable[[int], None], count: int) -> Iterator[Image.Image]:
    """Yield the frames of a figure of which only some artists move.

    Parameters
    ----------
    figure : Figure
        All artists except `moving` are drawn once.
    moving : sequence of artists
        Redrawn in every frame, in this order; must belong to axes or to the figure.
    draw : callable
        ``draw(i)`` moves these artists to frame i.
    count : int
    """
    canvas = FigureCanvasAgg(figure)
    for artist in moving:
        artist.set_animated(True)
    canvas.draw()
    empty = canvas.copy_from_bbox(figure.bbox)  # type: ignore[no-untyped-call]
    for index in range(count):
        draw(index)
        canvas.restore_region(empty)  # type: ignore[no-untyped-call]
        for artist in moving:
            artist.draw(canvas.renderer)
        yield Image.frombuffer("RGBA", canvas.get_width_height(), bytes(canvas.buffer_rgba())).convert("RGB")


def frame_times(first: float, last: float, *, slow: float = 1.0, max_frames: int = MAX_FRAMES) -> tuple[list[float], float]:
    """Return the times of the frames of an interval, s, and the playback speed over real time."""
    speed = 1.0 / slow
    count = max(round((last - first) * FRAMES_PER_SECOND / speed) + 1, 2)
    # doubling keeps a simple ratio to real time
    while count > max_frames:
        speed *= 2
        count = max(round((last - first) * FRAMES_PER_SECOND / speed) + 1, 2)
    return [first + (last - first) * i / (count - 1) for i in range(count)], speed


def write_frames(frames: Iterable[Image.Image], path: Path | str) -> None:
    """Write frames as an animation atomically, in the format of the suffix.

    Parameters
    ----------
    frames : iterable of RGB images of one size
    path : path
        ``.gif`` or ``.mp4`` (requires ffmpeg or the package imageio-ffmpeg).

    Raises
    ------
    OutputError
        If the suffix is not supported, ffmpeg is missing for .mp4, or the file cannot be written.
    """
    target = Path(path)
    writers = {".gif": _write_gif, ".mp4": _write_mp4}
    check_animation(target)
    writer = writers.get(target.suffix.lower())
    if writer is None:
        raise OutputError(
            "cannot save the animation as {target}: the name must end in {suffixes}", target=target, suffixes=join_alternatives(writers)
        )
    with atomic_write(target) as temporary:
        writer(frames, temporary)


def _write_gif(frames: Iterable[Image.Image], path: Path) -> None:
    """Write a looping GIF with one palette, from the first, middle and last frame."""
    pictures = list(frames)
    width, height = pictures[0].size
    samples = Image.new("RGB", (width, 3 * height))
    for row, index in enumerate((0, len(pictures) // 2, -1)):
        samples.paste(pictures[index], (0, row * height))
    # one palette for all frames, which the transparent deltas require
    palette = samples.quantize(TRANSPARENT, method=Image.Quantize.MEDIANCUT)
    first, *later = _frame_deltas([picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures])
    timing = {"duration": round(100 / FRAMES_PER_SECOND) * 10, "loop": 0}
    first.save(path, format="GIF", save_all=True, append_images=later, optimize=False, transparency=TRANSPARENT, **timing)


def _frame_deltas(pictures: Sequence[Image.Image]) -> Iterator[Image.Image]:
    """Yield frames with pixels unchanged from the previous frame made transparent, which compresses better."""
    previous = None
    for picture in pictures:
        pixels = np.asarray(picture)
        change = Image.fromarray(pixels if previous is None else np.where(pixels == previous, np.uint8(TRANSPARENT), pixels), "P")
        change.putpalette([*(picture.getpalette() or [])[: 3 * TRANSPARENT], *[255] * (3 * (256 - TRANSPARENT))])
        yield change
        previous = pixels


def _write_mp4(frames: Iterable[Image.Image], path: Path) -> None:
    """Encode frames with ffmpeg through a pipe."""
    program = find_ffmpeg() or "ffmpeg"
    pictures = iter(frames)
    first = next(pictures)
    # yuv420p requires even dimensions
    width, height = (size - size % 2 for size in first.size)
    source = f"-f rawvideo -pix_fmt rgb24 -s {width}x{height} -r {FRAMES_PER_SECOND} -i -"
    target = "-an -c:v libx264 -pix_fmt yuv420p -f mp4"
    command = [program, *f"-y -loglevel error {source} {target}".split(), str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdin is not None and process.stderr is not None
        try:
            for picture in (first, *pictures):
                process.stdin.write(picture.crop((0, 0, width, height)).tobytes())
            process.stdin.close()
        except BrokenPipeError:
            pass
        message = process.stderr.read().decode(errors="replace").strip()
        if process.wait() != 0 or message or not _is_complete_mp4(path):
            if os.strerror(errno.ENOSPC) in message:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))  # the last line of ffmpeg does not name it
            reason = message.splitlines()[-1] if message else gettext("incomplete file (disk full?)")
            raise OutputError("ffmpeg failed to write the animation: {reason}", reason=reason)


def _is_complete_mp4(path: Path) -> bool:
    """Return True if the boxes of an MP4, index included, fill the file exactly."""
    size = path.stat().st_size
    at, kinds = 0, set()
    with path.open("rb") as stream:
        while at < size:
            stream.seek(at)
            box_header = stream.read(16)
            if len(box_header) < 8:
                return False
            length = int.from_bytes(box_header[:4], "big")
            # length 1: 64-bit length after the type
            if length == 1:
                length = int.from_bytes(box_header[8:16], "big")
            if length < 8:
                return False
            kinds.add(box_header[4:8])
            at += length
    return at == size and {b"ftyp", b"moov", b"mdat"} <= kinds
