"""The figure of a pile distinguishes its stones, follows each until it falls, and has no text over its curves."""

import functools

import numpy as np
import pytest

from seisblock import Pile, PileStone, load_pile, motion_of, read, solve_stack
from seisblock.core.i18n import use_locale
from seisblock.models.stack.animate import stack_animation
from seisblock.models.stack.stone_falls import describe_falls
from seisblock.output.figures.solver import response_figure
from seisblock.records import crop, scale
from tests.report.long_record import response

MAXIMUM = 13
"""Stones of a pagoda, the highest pile that is seen in a cemetery."""


@functools.cache
def tower(count):
    """Return what a weak second of a record does to so many stones, one on the other."""
    sizes = [(f"stone {i}", 0.6 - 0.03 * i, f"stone {i - 1}" if i else "ground") for i in range(count)]
    stones = tuple(PileStone(name, wide, wide, 0.1, on=below) for name, wide, below in sizes)
    return solve_stack(Pile("tower", stones, mu=0.6), motion_of(scale(crop(read("synthetic_jma.csv"), 25.0, 26.0), 0.2), "NS"))


def panel_of(result, quantity):
    """Return the panel of a quantity."""
    return next(panel for panel in response_figure([result]).axes if panel.get_ylabel().startswith(quantity))


@pytest.mark.parametrize("quantity", ["tilt", "slip"])
def test_stones_have_distinct_line_styles(quantity):
    """A stone is distinct from the twelve others, in the figure as in the animation."""
    result = tower(MAXIMUM)
    lines = [line for line in panel_of(result, quantity).get_lines() if line.get_label().startswith("stone")]
    assert len({(line.get_color(), str(line._unscaled_dash_pattern)) for line in lines}) == len(lines) == MAXIMUM
    strip = next(strip for strip in stack_animation(result, np.linspace(0.0, 1.0, 5)).strips if strip.label.startswith(quantity))
    assert len({(line.colour, line.dashes) for line in strip.lines}) == MAXIMUM


@pytest.mark.parametrize(("count", "columns"), [(1, 1), (3, 3), (5, 5), (6, 3), (8, 4), (11, 4), (12, 4)])
def test_legend_rows_are_balanced(count, columns):
    """Six names stand three and three, not five and one."""
    (key,) = (item for item in (panel.get_legend() for panel in response_figure([tower(count)]).axes[2:]) if item is not None)
    assert len(key.get_texts()) == count
    assert key._ncols == columns


@pytest.mark.parametrize("language", ["en", "ja"])
def test_fall_text_is_clear_of_curves_and_legend(language):
    """The sentence stands above the panel of the tilts, within its width, and the key elsewhere."""
    solution = solve_stack(load_pile("lantern"), motion_of(crop(read("synthetic_jma.csv"), 24.0, 28.0), "NS"))
    with use_locale(language):
        figure, sentence = response_figure([solution, solution]), describe_falls(solution)
        figure.canvas.draw()
    texts = [text for panel in figure.axes for text in (panel.title, panel._left_title) if plain(text.get_text()) == plain(sentence)]
    assert len(texts) == 2
    renderer = figure.canvas.get_renderer()
    for text in texts:
        box, panel = text.get_window_extent(renderer), text.axes.get_window_extent(renderer)
        assert box.y0 > panel.y1
        assert box.x1 <= panel.x1
        keys = (axis.get_legend() for axis in figure.axes)
        assert not [key for key in keys if key is not None and key.get_window_extent(renderer).overlaps(box)]


def plain(text):
    """Return a text without its blanks and ends of lines."""
    return "".join(text.split())


def test_curves_of_fallen_stone_end_at_fall():
    """Film and figure draw its tilt until its fall, its slip until 0.2 s before, and the figure lays nothing over the dashed lines."""
    solution = response("stack")
    (fell,) = (stone for stone in solution.outcome.stones if stone.state == "fallen")
    panels = response_figure([solution]).axes
    for quantity, before in (("tilt", 0.0), ("slip", 0.2)):
        film_lines = next(
            strip for strip in stack_animation(solution, np.linspace(50.0, 60.0, 20)).strips if strip.label.startswith(quantity)
        ).lines
        panel = next(panel for panel in panels if panel.get_ylabel().startswith(quantity))
        figure_line = next(line for line in panel.get_lines() if line.get_label() == fell.name)
        for time, values in ((film_lines[0].time, film_lines[0].values), figure_line.get_data()):
            value = np.asarray(time)[np.isfinite(values)]
            assert fell.fell_at_s - before - 0.05 < value.max() <= fell.fell_at_s - before
    assert plain(describe_falls(solution)) in [plain(panel.get_title(loc="left")) for panel in panels]
    assert not [text for panel in panels for text in panel.texts], "nothing lies over the curves and the dashed lines of the falls"
