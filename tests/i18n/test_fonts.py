"""Figures are drawn in fonts that hold their letters, without a word from matplotlib, and never in the language of formulas."""

import logging
import warnings
from dataclasses import replace

import pytest
from click.testing import CliRunner
from matplotlib.font_manager import FontManager, fontManager

from seisblock.cli import main
from seisblock.core.i18n import use_locale
from seisblock.output.figures import fonts, style

SERIF = [entry for entry in fontManager.ttflist if entry.name == "DejaVu Serif" and entry.style == "normal"]


@pytest.fixture
def install_fonts(monkeypatch):
    """Pretend that only some fonts are there: entries of the list are what matplotlib knows of them."""
    fonts.japanese_font.cache_clear()

    def pretend(*entries):
        latin = [entry for entry in fontManager.ttflist if entry.name == fonts.LATIN]
        monkeypatch.setattr(fontManager, "ttflist", [*latin, *entries])
        fontManager._findfont_cached.cache_clear()

    yield pretend
    fonts.japanese_font.cache_clear()
    fontManager._findfont_cached.cache_clear()


def entry(family, weight):
    """Return a font of a family and weight; its file is one that is there."""
    return replace(SERIF[0], name=family, weight=weight)


def test_regular_weight_precedes_preferred_bold_family(install_fonts):
    """F5: with Noto Sans CJK in bold only, a figure is drawn in IPAGothic; with nothing else it is bold, by choice."""
    install_fonts(entry("Noto Sans CJK JP", 700), entry("IPAGothic", "normal"))
    assert fonts.japanese_font() == fonts.Typeface("IPAGothic", (400,))
    fonts.japanese_font.cache_clear()
    install_fonts(entry("Noto Sans CJK JP", "bold"))
    assert fonts.japanese_font() == fonts.Typeface("Noto Sans CJK JP", (700,))
    assert fonts.Typeface("x", (300, 700)).nearest("normal") == 300


@pytest.mark.parametrize("weights", [(400,), (700,), (400, 700), (250,)])
def test_matplotlib_emits_no_font_warning(weights, install_fonts, caplog, tmp_path):
    """F5: no line "findfont: failed to find font weight" and no warning, whatever weights there are and a text asks for."""
    install_fonts(*(entry("Noto Sans CJK JP", weight) for weight in weights))
    with use_locale("ja"), caplog.at_level(logging.INFO, "matplotlib"), warnings.catch_warnings():
        warnings.simplefilter("error")
        figure, (axis,) = style.new_figure(1, title="title")
        axis.plot([1, 2], [3, 4], label="name")
        axis.set_title("panel", fontweight="bold")
        style.add_legend(axis)
        style.save(figure, tmp_path / "figure.png")
    assert [record.message for record in caplog.records if "findfont" in record.message] == []
    assert {text.get_fontfamily()[0] for text in figure.findobj(fonts.Text)} == {"Noto Sans CJK JP"}


class BareSystem(FontManager):
    """Fonts of a system on which no font is installed."""

    def __init__(self):
        super().__init__()
        self.ttflist = [entry for entry in self.ttflist if entry.name == fonts.LATIN]


def test_extra_ja_font_is_used_without_system_font(install_fonts, monkeypatch, tmp_path):
    """The extra `ja`: a Japanese figure on a machine without Japanese fonts, and no word about them."""
    install_fonts()
    monkeypatch.setattr(fonts, "FontManager", BareSystem)
    assert fonts.japanese_font() == fonts.Typeface("IPAexGothic", (400,))
    answer = CliRunner().invoke(main, ["jump", "--component", "EW", "--lang", "ja", "--plot", str(tmp_path / "jump.png")])
    assert answer.exit_code == 0 and (tmp_path / "jump.png").is_file()
    assert "fonts-noto-cjk" not in answer.stderr


def test_figure_without_font_is_english_with_one_warning(tmp_path, monkeypatch):
    """The figure is still written, and printed texts stay Japanese."""
    monkeypatch.setattr(fonts, "japanese_font", lambda: None)
    answer = CliRunner().invoke(main, ["jump", "--component", "EW", "--lang", "ja", "--plot", str(tmp_path / "jump.svg")])
    assert answer.exit_code == 0 and (tmp_path / "jump.svg").is_file()
    assert sum("fonts-noto-cjk" in line for line in answer.stderr.splitlines()) == 1
    assert "ロッキング" in answer.stdout
    with use_locale("ja"):
        assert fonts.drawable_locale() == "en"
        assert fonts.build_localized(lambda: style.new_figure(1, title=fonts.get_locale())[0]).locale == "en"


def test_japanese_name_on_english_figure_uses_japanese_font():
    """Letters that DejaVu lacks are looked for; the others stay as they are."""
    if fonts.japanese_font() is None:
        pytest.skip("no Japanese font is installed")
    figure, (axis,) = style.new_figure(1, title="観測点 熊本")
    axis.set_xlabel("t (s)")
    figure.canvas.draw()
    assert figure._suptitle.get_fontfamily()[0] == fonts.japanese_font().family
    assert axis.xaxis.label.get_fontfamily() == ["sans-serif"]


NAME = r"A$B_{$\frac$C^"


def test_dollar_sign_starts_no_mathtext(tmp_path):
    """R15: station, file and stone names are drawn as they are: in titles, legends, notes and along an axis."""
    figure, (axis,) = style.new_figure(1, title=NAME)
    axis.barh([NAME, "b"], [1.0, 2.0], label=NAME)
    axis.set_title(NAME)
    axis.text(0.5, 0.5, NAME)
    axis.set_xscale("log")
    style.label_axes(axis, NAME, NAME)
    style.add_legend(axis)
    style.save(figure, tmp_path / "figure.svg")
    assert axis.get_yticklabels()[0].get_text() == NAME


def test_powers_of_ten_on_axes_stay_mathtext():
    """Powers of ten written by matplotlib stay mathtext."""
    figure, (axis,) = style.new_figure(1)
    axis.loglog([1, 1e6], [1, 1e6])
    figure.canvas.draw()
    label = axis.get_xticklabels()[0]
    assert label.get_text().startswith("$") and label.get_parse_math()


def test_record_name_with_dollar_is_drawn(tmp_path):
    """R15, from the command line: a record whose name is half a formula is measured and drawn."""
    rows = "\n".join(f"{0.01 * i:.2f},{(-1) ** i * 12.5},{i % 7}" for i in range(400))
    record = tmp_path / "a$b_{.csv"
    record.write_text(f"time,NS (gal),EW (gal)\n{rows}\n", encoding="utf-8")
    answer = CliRunner().invoke(main, ["measure", str(record), "--plot", str(tmp_path / "out.png")])
    assert answer.exit_code == 0, answer.stderr
    assert (tmp_path / "out.png").stat().st_size > 10_000


def test_missing_glyphs_give_one_warning(install_fonts, monkeypatch, tmp_path, recwarn):
    """A figure in English with a Japanese name of a stone: one sentence, and no warning of matplotlib's for each letter."""
    monkeypatch.setattr(fonts, "FONT_PACKAGE", "no_such_package_of_fonts")
    monkeypatch.setattr(fonts, "FontManager", lambda: fontManager)
    install_fonts()
    pile = tmp_path / "pile.toml"
    pile.write_text('kind = "pile"\n[[stone]]\nname = "竿"\nwidth = "25cm"\ndepth = "25cm"\nheight = "70cm"\n', encoding="utf-8")
    result = CliRunner().invoke(main, ["stack", "--window", "24:25", "--stones", str(pile), "--plot", str(tmp_path / "out.png")])
    assert result.exit_code == 0
    assert "Japanese names appear as boxes in the figure" in " ".join(result.stderr.split())
    assert [str(warning.message) for warning in recwarn if "Glyph" in str(warning.message)] == []
