"""Which font holds Japanese, and a figure told in Japanese with it."""

from __future__ import annotations

from functools import cache

from matplotlib.axis import Axis
from matplotlib.category import StrCategoryFormatter
from matplotlib.figure import Figure
from matplotlib.font_manager import FontManager, fontManager
from matplotlib.text import Text

from seisblock.present.words import translate

FAMILIES = (
    "Noto Sans CJK JP",
    "Noto Sans JP",
    "Source Han Sans JP",
    "Source Han Sans",
    "IPAexGothic",
    "IPAPGothic",
    "IPAGothic",
    "BIZ UDPGothic",
    "Hiragino Sans",
    "Hiragino Kaku Gothic ProN",
    "Hiragino Maru Gothic Pro",
    "YuGothic",
    "Yu Gothic",
    "Meiryo",
    "MS Gothic",
    "TakaoPGothic",
    "TakaoGothic",
    "VL PGothic",
    "VL Gothic",
    "Droid Sans Japanese",
    "Noto Sans CJK SC",
    "IPAexMincho",
    "IPAMincho",
)
"""Families that hold Japanese, the most readable on a figure first."""

MISSING = "no font with Japanese letters was found: the figure is in English; install one, for example fonts-noto-cjk or fonts-ipafont"
"""What to say when there is none."""


@cache
def japanese_font() -> str | None:
    """Return the name of an installed family that holds Japanese, or None."""
    installed = {entry.name for entry in fontManager.ttflist}
    found = next((name for name in FAMILIES if name in installed), None)
    if found is None:
        # matplotlib keeps a list of the fonts it once saw; one installed since is found by looking again
        again = {entry.name: entry for entry in FontManager().ttflist}
        found = next((name for name in FAMILIES if name in again), None)
        if found is not None:
            fontManager.ttflist.append(again[found])
    return found


def speak(figure: Figure, lang: str) -> bool:
    """Translate every text of a figure; return whether that was possible.

    Parameters
    ----------
    figure : Figure
        Changed in place, once.
    lang : "en" or "ja"
    """
    if lang == "en":
        return True
    family = japanese_font()
    if family is None:
        return False
    for axes in figure.axes:
        _name_categories(axes.xaxis, lang)
        _name_categories(axes.yaxis, lang)
    for text in figure.findobj(Text):
        assert isinstance(text, Text)
        words = text.get_text()
        text.set_text(translate(words, lang))
        text.set_fontfamily([family, "DejaVu Sans"])
    return True


def _name_categories(axis: Axis, lang: str) -> None:
    """Translate the names along an axis of categories, which are written anew whenever it is drawn."""
    if isinstance(axis.get_major_formatter(), StrCategoryFormatter):
        names = [label.get_text() for label in axis.get_ticklabels()]
        axis.set_ticks(axis.get_ticklocs(), labels=[translate(name, lang) for name in names])
