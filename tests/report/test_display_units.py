"""Units are chosen in one place: what one command shows in cm none shows in mm or m."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from seisblock.core.results import Histories
from seisblock.output import units_display
from seisblock.output.figures.solver import response_figure
from seisblock.output.units_display import TEXT_DECIMALS, format_length, length_cell, length_unit
from tests.lengths import all_but_slow
from tests.report.long_record import response
from tests.report.test_every_animation import FILMS, film
from tests.report.test_every_figure import visible_texts

ROOM = Path(units_display.__file__).parent
MASK = re.compile(r"(?:\((?:mm|cm|gal|kine|m/s²)\)|\} ?(?:mm|cm|gal|kine|m/s²)(?![\w/]))")
"""A unit written out behind a number or in a heading."""

AS_GIVEN = {"text/samples.py", "json/infer.py", "figures/style.py", "html/report.py"}
"""Peaks in the unit of a list, a formula as a paper prints it, the example of a doctest, gravity in SI as it is given."""


def test_units_are_defined_in_units_display_only():
    """Every other text of this room takes its unit from there."""
    text = {str(path.relative_to(ROOM)) for path in ROOM.rglob("*.py") if MASK.search(path.read_text(encoding="utf-8"))}
    mapping = {name for name in text if not name.startswith("exports/")}  # files in the layouts of others have their units
    assert mapping - {"units_display.py"} <= AS_GIVEN


@pytest.mark.parametrize(
    ("lengths", "unit"),
    [
        ((0.00994, -0.002), "mm"),
        ((9.994,), "cm"),
        ((0.1, -118.681), "m"),
        ((0.00995,), "cm"),
        ((-0.0101, 0.001), "cm"),
        ((0.0, None), "cm"),
        ((), "cm"),
    ],
)
def test_length_unit_is_mm_below_one_cm(lengths, unit):
    """Below 1 cm, as it would be written: mm; nothing at all is no centimetre. In SI always m."""
    assert length_unit(lengths, gal=True).name == unit
    assert length_unit(lengths, gal=False).name == "m"


def test_format_length_uses_decimals_of_unit():
    """Each unit has its decimals; zero has no sign, and an unknown value is a dash."""
    assert [format_length(item) for item in (0.21534, 0.0047, -1e-9, 0.0)] == ["21.5 cm", "4.70 mm", "0.00 mm", "0.0 cm"]
    unit = length_unit([0.2], gal=True)
    assert [length_cell(item, unit) for item in (0.21534, -1e-9, None)] == ["21.53", "0.00", "-"]
    assert format_length(0.21534, gal=False) == "0.215 m" and set(TEXT_DECIMALS) == {"mm", "cm", "m"}


@pytest.mark.parametrize("model", all_but_slow(FILMS, {"slide", "rock", "jump"}))
def test_figure_and_animation_use_same_units(model):
    """Panels of a figure and strips of its animation use the same units; with SI no other unit remains."""
    for gal, expected in ((True, {"gal", "kine", "cm", "mm"}), (False, {"m/s²", "m/s", "m"})):
        figure = response_figure([response(model)], gal=gal)
        panels = units_in(text.get_text() for text in visible_texts(figure))
        strips = units_in(strip.label for strip in film(model, 2, gal=gal).strips)
        assert strips <= panels | {"gal", "m/s²"} and strips <= expected and panels <= expected | {"m"}


def units_in(texts):
    """Return the units of lengths, velocities and accelerations that stand in brackets."""
    return set(re.findall(r"\((mm|cm|m|gal|kine|m/s|m/s²)\)", " ".join(texts)))


def test_slide_figure_of_small_slip_uses_mm():
    """Plotted values have the unit of the axis: a hundredth of the slip in cm."""
    solution = response("slide")
    scaled = [
        replace(channel, values=0.01 * channel.values) if channel.name == "displacement" else channel for channel in solution.channels
    ]
    small = replace(
        solution,
        make_histories=lambda: Histories(solution.time, tuple(scaled)),
        outcome=replace(solution.outcome, max_slip_m=0.01 * solution.outcome.max_slip_m),
    )
    (axis,) = [axis for axis in response_figure([small]).axes if axis.get_ylabel() == "x − z (mm)"]
    highest = max(np.nanmax(np.abs(line.get_ydata())) for line in axis.get_lines())
    assert highest == pytest.approx(1e3 * np.abs(small["displacement"]).max(), rel=1e-6)
