"""Wide answers on a terminal of 80 columns: whole numbers, in as many tables as needed."""

import io
import itertools
from dataclasses import replace

from rich.console import Console, Group

from seisblock.core.i18n import use_locale
from seisblock.models.jump.describe import describe as jump_verdict
from seisblock.output.templating import render_page
from seisblock.output.text.tables import side_by_side, styled_line, table
from seisblock.output.text.wrap import display_width
from seisblock.report.text.fragility import tables as fragility_tables
from seisblock.report.text.rock import tables as rock_tables
from tests.report.long_record import NAMES, fragilities, response


def terminal_lines(*parts, width=80):
    """Return the lines of a terminal of so many columns."""
    screen = Console(file=io.StringIO(), width=width, highlight=False, markup=False)
    for part in parts:
        screen.print(Group(part))
    return screen.file.getvalue().splitlines()


def test_wide_table_wraps_between_columns():
    """A column per direction goes on below; nothing is broken within a number, and the names of the rows are there each time."""
    solution = response("rock")
    with use_locale("en"):
        lines = terminal_lines(*rock_tables([solution] * 12, [{}] * 12, gal=True))
    assert max(map(display_width, lines)) <= 80
    peaks = [text.split()[2:] for text in lines if text.startswith(" PGA (gal)")]
    assert len(peaks) > 1
    assert list(itertools.chain.from_iterable(peaks)) == ["450.0"] * 12


def test_table_that_fits_is_not_split():
    """Nothing is cut that has room, and a column that has none is shown all the same."""
    created = side_by_side("", ["", *"abc"], [["row", 1.0, 2.0, 3.0]])
    assert [sum("row" in text for text in terminal_lines(created, width=width)) for width in (80, 26, 18)] == [1, 2, 3]


def test_numbers_are_not_split_from_units():
    """In both languages, on a terminal and on a page."""
    for text in (
        "a change of the record by less than 2 % changes it",
        "この記録は 2 % だけ変わると転倒する",
        "at rest it sinks by 3.88 mm.",
        "摩擦係数 ±20 %、反発係数 ±0.1、振幅 ±10 %",
    ):
        for width in range(9, 40):
            assert not [line for line in terminal_lines(styled_line(text), width=width) if line.lstrip().startswith(("%", "mm"))]
    assert "98\N{NO-BREAK SPACE}% (94\N{NO-BREAK SPACE}% to" in render_page("base.html", "98 % (94 % to 99 %)")


def test_tiny_jump_is_not_written_as_zero():
    """Only a jump of exactly zero is written as zero."""
    solution = response("jump")
    nearby = replace(solution, outcome=replace(solution.outcome, final_displacement_m=-4e-6))
    with use_locale("en"):
        assert "less than 0.1 cm to -NS" in jump_verdict(nearby)


def test_fragility_table_starts_with_first_and_last_body():
    """The body that falls first, and the one that falls last."""
    study = fragilities(names=NAMES, limits=("overturn",))
    first, *_, last = sorted(study.curves, key=lambda curve: curve.median)
    with use_locale("en"):
        lines = terminal_lines(*fragility_tables(study, gal=True), width=120)
    assert lines[0].startswith(f"lowest of 9: {first.body}, overturning: median PGV {100 * first.median:.3g} kine")
    assert lines[1].startswith(f"highest of 9: {last.body}, overturning: median PGV {100 * last.median:.3g} kine")


def test_wide_cells_are_right_aligned():
    """Words in Japanese and lengths with their units end where the numbers of their column end."""
    lines = terminal_lines(table("", ["", "NS"], [["結果", "ロッキング"], ["縁", "1.0 cm, 0.2 cm"], ["最大傾斜", "7.347"]]))
    ends = {display_width(line.rstrip()) for line in lines if line.rstrip().endswith(("ロッキング", "0.2 cm", "7.347"))}
    assert len(ends) == 1


def test_table_without_headings_begins_with_its_first_row():
    """`body` printed two blank lines and a rule above its list of properties."""
    first, *_ = (line for line in terminal_lines(table("", ["", ""], [["volume (m³)", 1.0]])) if line.strip())
    assert first.split()[0] == "volume"


def test_columns_move_together_before_cells_wrap():
    """At 80 columns the class of every station and object took two lines, with three blanks between the columns."""
    rows = table("", ["a", "b", "c"], [["first", "likely over", "3"]])
    lines = {width: [line.strip() for line in terminal_lines(rows, width=width)[3:] if line.strip()] for width in (25, 23, 21, 20)}
    assert lines == {
        25: ["first   likely over   3"],
        23: ["first  likely over  3"],
        21: ["first likely over 3"],
        20: ["first    likely  3", "over"],
    }
