"""Animations are complete files of the type of their suffix and show the block at the solved positions."""

import subprocess
import sys
import types

import numpy as np
import pytest
from PIL import Image

from seisblock.bodies.block import Block
from seisblock.core.errors import OutputError
from seisblock.models.rock.animate import animate, corners
from seisblock.models.rock.solve import solve_rock
from seisblock.output.animation.render import MAX_FRAMES, frame_times, write_frames
from seisblock.output.io import atomic
from seisblock.output.io.atomic import find_ffmpeg
from seisblock.records import Motion


@pytest.fixture(scope="module")
def response():
    """Five seconds of rocking."""
    t = np.arange(501) * 0.01
    return solve_rock(Block(0.3, 0.9), Motion.from_arrays(3.4 * np.sin(2 * np.pi * 1.7 * t), 0.01, name="NS"))


def make_pictures(count):
    """Yield small pictures that differ."""
    for i in range(count):
        picture = Image.new("RGB", (31, 21), "white")
        picture.paste("red", (i, 0, i + 4, 21))
        yield picture


def test_gif_has_every_frame_at_true_speed(tmp_path):
    """Twenty pictures a second are 50 ms each."""
    write_frames(make_pictures(12), tmp_path / "a.gif")
    with Image.open(tmp_path / "a.gif") as image:
        assert image.n_frames == 12
        assert image.info["duration"] == 50
        assert image.info["loop"] == 0


def test_gif_stores_only_changes_between_frames(tmp_path):
    """A GIF stores unchanged regions once and reproduces every frame as drawn."""
    ground = np.random.default_rng(0).integers(0, 2, (60, 90)) * 255
    collected = []
    for i in range(20):
        picture = np.repeat(ground[:, :, None], 3, axis=2).astype(np.uint8)
        picture[:, 4 * i : 4 * i + 3] = (255, 0, 0)
        picture[i, :] = (0, 0, 255)
        collected.append(Image.fromarray(picture))
    write_frames(collected[:1] * 2, tmp_path / "still.gif")
    write_frames(collected, tmp_path / "moves.gif")
    with Image.open(tmp_path / "moves.gif") as image:
        assert image.n_frames == 20
        for index, picture in enumerate(collected):
            image.seek(index)
            np.testing.assert_array_equal(np.asarray(image.convert("RGB")), np.asarray(picture))
    still, moves = ((tmp_path / name).stat().st_size for name in ("still.gif", "moves.gif"))
    assert moves < 10 * still


@pytest.mark.skipif(find_ffmpeg() is None, reason="neither ffmpeg nor imageio-ffmpeg is installed")
def test_mp4_has_even_size_and_all_frames(tmp_path):
    """Odd sizes are cut to even ones, as the codec wants."""
    write_frames(make_pictures(9), tmp_path / "a.mp4")
    assert b"ftyp" in (tmp_path / "a.mp4").read_bytes()[:16]
    assert subprocess.run([find_ffmpeg(), "-v", "error", "-i", tmp_path / "a.mp4", "-f", "null", "-"], check=True).returncode == 0


def test_mp4_uses_bundled_ffmpeg(tmp_path, monkeypatch):
    """The package imageio-ffmpeg brings one along; where it lacks its program, it is as if it were not there."""
    package = types.SimpleNamespace(get_ffmpeg_exe=lambda: "its-own-ffmpeg")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(atomic, "find_spec", lambda name: package)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", package)
    assert find_ffmpeg() == "its-own-ffmpeg"

    def missing():
        raise RuntimeError("No ffmpeg exe could be found")

    package.get_ffmpeg_exe = missing
    assert find_ffmpeg() is None


def test_mp4_without_ffmpeg_raises_with_remedy(tmp_path, monkeypatch):
    """The message names the missing part and an alternative, and no file is left."""
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(atomic, "find_spec", lambda name: None)
    with pytest.raises(OutputError, match="ffmpeg not found"):
        write_frames(make_pictures(3), tmp_path / "a.mp4")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["a.avi", "a", "nowhere/a.gif"])
def test_animate_rejects_unknown_suffix_and_missing_directory(tmp_path, name):
    """Other suffixes and missing directories are errors of the user."""
    with pytest.raises(OutputError):
        write_frames(make_pictures(3), tmp_path / name)


def test_interrupted_animation_keeps_existing_file(tmp_path):
    """A failure half way keeps what was there and leaves nothing beside it."""
    (tmp_path / "a.gif").write_bytes(b"old")

    def broken():
        yield from make_pictures(2)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_frames(broken(), tmp_path / "a.gif")
    assert [path.name for path in tmp_path.iterdir()] == ["a.gif"]
    assert (tmp_path / "a.gif").read_bytes() == b"old"


@pytest.mark.slow
def test_five_seconds_of_rocking_give_100_different_frames(tmp_path, response):
    """Twenty pictures a second, and the block is elsewhere in a later one."""
    animate(response, tmp_path / "rock.gif")
    with Image.open(tmp_path / "rock.gif") as image:
        assert image.n_frames >= 95
        first = np.asarray(image.convert("RGB")).astype(int)
        image.seek(60)
        assert np.abs(np.asarray(image.convert("RGB")).astype(int) - first).max() > 100


def test_long_response_plays_faster_and_states_speed():
    """An hour has at most 1200 frames, and the speed is stated."""
    times, speed = frame_times(0.0, 3600.0)
    assert len(times) <= MAX_FRAMES
    assert speed == 64
    assert times[-1] == 3600.0


def test_rocking_block_pivots_at_corner_in_contact():
    """The right corner stays when it leans to +x, the left one when to -x."""
    block = Block(0.4, 1.0, centroid_offset=0.05)
    np.testing.assert_allclose(corners(block, 0.2)[1], [0.2, 0.0], atol=1e-15)
    np.testing.assert_allclose(corners(block, -0.2)[0], [-0.2, 0.0], atol=1e-15)
    assert corners(block, 0.2)[:, 1].min() > -1e-15
