"""Figures of the size, at the resolution and under the title asked for."""

import struct

import pytest
from click.testing import CliRunner

from seisblock.cli import main


@pytest.fixture
def draw_figure(tmp_path):
    def draw(*words):
        path = tmp_path / "f.png"
        result = CliRunner().invoke(main, ["slide", "elcentro_1940_ns", "--mu", "0.2", "--plot", str(path), *words])
        return result, struct.unpack(">II", path.read_bytes()[16:24]) if path.exists() else None

    return draw


@pytest.mark.parametrize(
    ("words", "pixels"),
    [
        ((), (8.5 * 200, 7.0 * 200)),
        (("--dpi", "100"), (850, 700)),
        (("--size", "18x12"), (18 / 2.54 * 200, 12 / 2.54 * 200)),
        (("--size", "5inx4in", "--dpi", "72"), (360, 288)),
        (("--size", "90x110mm", "--dpi", "72"), (9 / 2.54 * 72, 11 / 2.54 * 72)),
        (("--size", "90mmx110", "--dpi", "72"), (9 / 2.54 * 72, 11 / 2.54 * 72)),
        (("--size", "90mm×9cm"), (9 / 2.54 * 200, 9 / 2.54 * 200)),
    ],
)
def test_size_and_dpi_set_figure_dimensions(draw_figure, words, pixels):
    """200 dots per inch by default; centimetres unless a unit is given, which a bare side shares."""
    text, result = draw_figure(*words)
    assert text.exit_code == 0, text.output
    assert result == pytest.approx(pixels, abs=1)


@pytest.mark.parametrize(
    ("words", "message", "code"),
    [
        (("--size", "18"), "is not a width and a height, for example 18x12", 2),
        (("--size", "axb"), "a", 2),
        (("--size", "1x1"), "width and height of a figure must lie between 4 cm and 120 cm", 2),
        (("--size", "5mmx5mm"), "width and height of a figure must lie between 40 mm and 1200 mm", 2),
        pytest.param(("--size", "85mmx60mm"), "does not fit in 85 mm x 60 mm", 3, marks=pytest.mark.slow),
        (("--size", "100x100", "--dpi", "1200"), "reduce the size", 3),
        (("--dpi", "0"), "is not in the range", 2),
    ],
)
def test_size_rejects_invalid_and_huge_values(draw_figure, words, message, code):
    """A size that is none, and one that is larger than a picture can be."""
    text, result = draw_figure(*words)
    assert text.exit_code == code and result is None
    assert message in " ".join(text.stderr.split()) and "Traceback" not in text.output


def test_title_is_plain_text_and_requires_plot(tmp_path):
    """The line above the figure is the user's, not mathematics; without a figure there is nothing to put it on."""
    path = tmp_path / "f.svg"
    words = ["slide", "elcentro_1940_ns", "--mu", "0.2", "--title", "墓石 $x_1$ & co"]
    assert CliRunner().invoke(main, [*words, "--plot", str(path)]).exit_code == 0
    text = path.read_text(encoding="utf-8")
    assert "x_1" in text and "elcentro" not in text
    result = CliRunner().invoke(main, words)
    assert result.exit_code == 3 and "require --plot" in result.stderr


def test_figure_options_exist_only_where_effective():
    """F6: commands without an animation lack the option; the content of --csv is stated where it is no time history."""
    for command, film, history in (("slide", True, True), ("uplift", True, True), ("criteria", False, False), ("spectrum", False, False)):
        text = " ".join(CliRunner().invoke(main, [command, "--help-all"]).output.split())
        assert ("--animate" in text) == film and ("--slow " in text) == film
        assert ("Write the time histories" in text) == history
