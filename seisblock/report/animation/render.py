"""Pictures on one stage, written as .gif or .mp4."""

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
from seisblock.core.i18n import gettext
from seisblock.core.typing import Progress
from seisblock.report.io.atomic import atomic_write, check_animation, find_ffmpeg

FRAMES_PER_SECOND = 20
"""Default rate; a .gif counts in hundredths of a second, so 20, 25 and 50 play at true speed."""

TRANSPARENT = 128
"""Of the palette of a .gif, after its colours: what lets the picture before it show."""

MAX_FRAMES = 1200
"""A longer answer plays faster than it was, rather than filling the disk."""


@dataclass(frozen=True)
class AnimationOptions:
    """How an animation is wanted.

    Parameters
    ----------
    slow : float
        How many times slower than life it plays.
    progress : callable
    gal : bool
        Unit of accelerations: gal, else m/s^2.
    """

    slow: float = 1.0
    progress: Progress | None = None
    gal: bool = True


REAL_TIME = AnimationOptions()
"""As fast as life."""


def render(figure: Figure, moving: Sequence[Any], draw: Callable[[int], None], count: int) -> Iterator[Image.Image]:
    """Yield the pictures of a figure of which only some artists move.

    Parameters
    ----------
    figure : Figure
        Everything but `moving` is drawn once.
    moving : sequence of artists
        Drawn anew in each picture, in this order; each must belong to an axis or to the figure.
    draw : callable
        ``draw(i)`` sets the moving artists to picture i.
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


def frame_times(
    first: float, last: float, fps: int = FRAMES_PER_SECOND, *, slow: float = 1.0, max_frames: int = MAX_FRAMES
) -> tuple[list[float], float]:
    """Return the times of the pictures of a stretch, s, and how many times faster than life it plays (0.25: four times slower)."""
    speed = 1.0 / slow
    count = max(round((last - first) * fps / speed) + 1, 2)
    while count > max_frames:
        speed *= 2
        count = max(round((last - first) * fps / speed) + 1, 2)
    return [first + (last - first) * i / (count - 1) for i in range(count)], speed


def write_frames(frames: Iterable[Image.Image], path: Path | str, *, fps: int = FRAMES_PER_SECOND) -> None:
    """Write pictures as an animation, whole or not at all; the suffix decides the format.

    Parameters
    ----------
    frames : iterable of RGB images of one size
    path : path
        ``.gif`` (plays anywhere) or ``.mp4`` (needs ffmpeg, or the package imageio-ffmpeg).
    fps : int
        Pictures per second.

    Raises
    ------
    OutputError
        If the suffix is another, an .mp4 has no program that makes it, or the file cannot be written.
    """
    target = Path(path)
    writers = {".gif": _write_gif, ".mp4": _write_mp4}
    check_animation(target)
    writer = writers.get(target.suffix.lower())
    if writer is None:
        raise OutputError("cannot animate {target}: the name must end in {suffixes}", target=target, suffixes=list(writers))
    with atomic_write(target) as temporary:
        writer(frames, temporary, fps)


def _write_gif(frames: Iterable[Image.Image], path: Path, fps: int) -> None:
    """Write a GIF that repeats; one palette, from the first, the middle and the last picture, serves all."""
    pictures = list(frames)
    width, height = pictures[0].size
    samples = Image.new("RGB", (width, 3 * height))
    for row, index in enumerate((0, len(pictures) // 2, -1)):
        samples.paste(pictures[index], (0, row * height))
    palette = samples.quantize(TRANSPARENT, method=Image.Quantize.MEDIANCUT)
    first, *later = _frame_deltas([picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures])
    timing = {"duration": round(100 / fps) * 10, "loop": 0}
    first.save(path, format="GIF", save_all=True, append_images=later, optimize=False, transparency=TRANSPARENT, **timing)


def _frame_deltas(pictures: Sequence[Image.Image]) -> Iterator[Image.Image]:
    """Yield pictures of one palette of which each but the first is clear where the one before it shows the same: that packs well."""
    previous = None
    for picture in pictures:
        pixels = np.asarray(picture)
        change = Image.fromarray(pixels if previous is None else np.where(pixels == previous, np.uint8(TRANSPARENT), pixels), "P")
        change.putpalette([*(picture.getpalette() or [])[: 3 * TRANSPARENT], *[255] * (3 * (256 - TRANSPARENT))])
        yield change
        previous = pixels


def _write_mp4(frames: Iterable[Image.Image], path: Path, fps: int) -> None:
    """Pipe the pictures through ffmpeg."""
    program = find_ffmpeg() or "ffmpeg"
    pictures = iter(frames)
    first = next(pictures)
    width, height = (size - size % 2 for size in first.size)
    command = [
        program,
        "-y",
        "-loglevel",
        "error",
        "-f",
        "rawvideo",
        "-pix_fmt",
        "rgb24",
        "-s",
        f"{width}x{height}",
        "-r",
        str(fps),
        "-i",
        "-",
        "-an",
        "-c:v",
        "libx264",
        "-pix_fmt",
        "yuv420p",
        "-f",
        "mp4",
        str(path),
    ]
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
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))  # its last line is about something else
            reason = message.splitlines()[-1] if message else gettext("the file is not whole; is the disk full?")
            raise OutputError("ffmpeg could not write the animation: {reason}", reason=reason)


def _is_complete_mp4(path: Path) -> bool:
    """Whether the boxes of an MP4 fill the file exactly, the index among them: a player can open it."""
    size = path.stat().st_size
    at, kinds = 0, set()
    with path.open("rb") as stream:
        while at < size:
            stream.seek(at)
            box_header = stream.read(16)
            if len(box_header) < 8:
                return False
            length = int.from_bytes(box_header[:4], "big")
            if length == 1:
                length = int.from_bytes(box_header[8:16], "big")
            if length < 8:
                return False
            kinds.add(box_header[4:8])
            at += length
    return at == size and {b"ftyp", b"moov", b"mdat"} <= kinds
