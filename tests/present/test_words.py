"""Figures and films speak Japanese when the locale or the option asks, and say so when they cannot."""

import pytest
from click.testing import CliRunner
from matplotlib.figure import Figure

from seisblock.cli import main
from seisblock.present.figures import fonts
from seisblock.present.words import LABELS, PHRASES, translate


def test_labels_are_replaced_whole_and_phrases_inside():
    """Numbers, symbols and what no table holds stay; parts of words and of formulas are left alone."""
    assert translate("t (s)", "ja") == "時刻 t (s)"
    assert translate("NS: Chozu-sha, short side", "ja") == "NS: 手水舎, 短辺方向"
    assert translate("interest rates, blocks", "ja") == "interest rates, blocks"
    assert translate(r"$\theta/\omega_1$", "ja") == r"$\theta/\omega_1$"
    assert translate("t (s)", "en") == "t (s)"


def test_no_translation_is_empty_or_left_english():
    """Every entry holds something that is not ASCII, but labels of bare symbols."""
    for english, japanese in {**LABELS, **PHRASES}.items():
        assert japanese.strip() and (not japanese.isascii() or japanese == english)


def test_a_figure_speaks_with_a_font_that_has_the_letters():
    """Texts are translated and get the family found, with another behind it."""
    if fonts.japanese_font() is None:
        pytest.skip("no Japanese font is installed")
    figure = Figure()
    axis = figure.subplots()
    axis.set_xlabel("t (s)")
    assert fonts.speak(figure, "ja")
    assert axis.get_xlabel() == "時刻 t (s)"
    assert axis.xaxis.label.get_fontfamily()[0] == fonts.japanese_font()


def test_without_a_font_the_figure_is_english_and_one_line_says_so(tmp_path, monkeypatch):
    """The figure is written all the same."""
    monkeypatch.setattr(fonts, "japanese_font", lambda: None)
    answer = CliRunner().invoke(main, ["jump", "--component", "EW", "--lang", "ja", "--plot", str(tmp_path / "jump.svg")])
    assert answer.exit_code == 0 and (tmp_path / "jump.svg").is_file()
    assert [line for line in answer.stderr.splitlines() if line.startswith("no font")] == [fonts.MISSING]
