"""Lines of Japanese end between letters, never before a closing mark, and never beyond the terminal."""

import io
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len

from seisblock.output.text.tables import console, styled_line, table
from seisblock.output.text.wrap import _CLOSING_PUNCTUATION, break_positions, display_width, is_wide, wrap_text

TEXT = "記録の終了後に、北へ 12.5 cm 移動した（最大 14.0 cm）。計測震度は 6.57、最大加速度は 934 gal であった。"


@given(st.text(alphabet="ab1 .漢字かなー、。（）「」", max_size=60), st.integers(8, 40))
def test_wrapped_lines_fit_width(text, width):
    """Nothing is lost but blanks at the ends of lines, and a line is wider only where a single word is."""
    lines = wrap_text(text, width)
    assert "".join("".join(lines).split()) == "".join(text.split())
    for result in lines:
        assert display_width(result) <= width or not break_positions(result.strip(), width)


@pytest.mark.parametrize("width", range(12, 60))
def test_wrapped_lines_obey_kinsoku(width):
    """Kinsoku: commas, full stops and closing brackets stay with what they close."""
    assert all(result[0] not in _CLOSING_PUNCTUATION for result in wrap_text(TEXT, width))


def test_character_width_equals_rich():
    """The table of wide letters agrees with rich's for everything that a catalogue may hold; it holds no combining marks."""
    for start, end in ((0x20, 0x250), (0x370, 0x400), (0x2000, 0x2070), (0x3000, 0x3100), (0x3200, 0xA000), (0xFF01, 0xFF60)):
        letters = [chr(code) for code in range(start, end) if chr(code).isprintable() and not unicodedata.combining(chr(code))]
        assert [hex(ord(letter)) for letter in letters if display_width(letter) != cell_len(letter)] == []
    assert not is_wide("θ/α ² – ×")


def console_output(*parts, width=80):
    """Return what the console prints."""
    screen = console()
    screen.file, screen.width = io.StringIO(), width
    for part in parts:
        screen.print(part)
    return screen.file.getvalue()


def test_console_breaks_japanese_between_characters():
    """A sentence fills its lines except for unbreakable parts, at most a number with its unit and closing brackets."""
    lines = console_output(styled_line(TEXT * 2), width=40).splitlines()
    longest = cell_len(" 14.0 cm）。")
    assert all(40 - longest < cell_len(result) <= 40 for result in lines[:-1]), lines
    for width in range(20, 60):
        assert not any(result.startswith(" ") for result in console_output(styled_line(TEXT), width=width).splitlines()), width


@pytest.mark.parametrize("width", range(30, 60))
def test_wrapped_indented_sentence_is_complete(width):
    """Blanks at the head of a line take room, too: nothing is cut off at the edge of the terminal."""
    output = console_output(styled_line("  " + TEXT * 2), width=width)
    assert "".join(output.split()) == "".join((TEXT * 2).split())


@pytest.mark.parametrize("text", (TEXT * 2, "residual displacement of the stone above 1.0 cm " * 4))
@pytest.mark.parametrize("width", (30, 80))
def test_indent_stands_on_every_line_of_a_sentence(text, width):
    """Continuation lines of an indented sentence were flush with its headline."""
    lines = console_output(styled_line("  " + text), width=width).rstrip("\n").split("\n")
    assert len(lines) > 1
    assert all(line[:2] == "  " and line[2] != " " and display_width(line) <= width for line in lines)


def test_console_escapes_markup_and_control_characters():
    """R15: square brackets of a station are printed as they are, emoji codes too; escapes are spelt out, in titles, headings, cells."""
    hostile = "[red]A[/red] :warning: \x1b[31m"
    output = console_output(table(hostile, [hostile, "x"], [[hostile, 1.0]], caption=hostile), styled_line(hostile), width=120)
    assert output.count("[red]A[/red] :warning: \\x1b[31m") == 5 and "\x1b" not in output
