"""Which font holds Japanese, and which letters a figure can therefore be written in."""

from __future__ import annotations

import importlib.util
import logging
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from matplotlib.axis import Axis
from matplotlib.category import StrCategoryFormatter
from matplotlib.figure import Figure
from matplotlib.font_manager import FontManager, fontManager, weight_dict
from matplotlib.text import Text
from matplotlib.ticker import FixedFormatter

from seisblock.core.i18n import N_, get_locale, use_locale
from seisblock.report.text.wrap import is_wide

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

REGULAR = 400
LATIN = "DejaVu Sans"
"""The family that comes with matplotlib; it holds what mathematics a label needs."""

FONT_PACKAGE = "matplotlib_fontja"
"""A package of the index that brings IPAexGothic, and needs no system's leave; only its file is used."""

NO_FONT = N_(
    "no font with Japanese letters was found: the figure is in English; install one, say fonts-noto-cjk, or pip install matplotlib-fontja"
)
"""What to say when there is none."""

MISSING_GLYPHS = N_(
    "no font with Japanese letters was found: names in Japanese are boxes in the figure; install one, say fonts-noto-cjk, or pip install "
    "matplotlib-fontja"
)
"""What to say when a figure in English has names that no font holds."""


@dataclass(frozen=True)
class Typeface:
    """A family that holds Japanese, and the weights in which it is there: asking for another one makes matplotlib complain."""

    family: str
    weights: tuple[int, ...]

    def nearest(self, weight: Any) -> int:
        """Return the weight that is there and comes nearest to one asked for."""
        return min(self.weights, key=lambda value: abs(value - _weight_number(weight)))


def _weight_number(weight: Any) -> int:
    """Return a weight as a number: matplotlib knows them by name, too."""
    return int(weight_dict.get(weight, weight))


@cache
def japanese_font() -> Typeface | None:
    """Return an installed family that holds Japanese, one of regular weight before one that is only bold; None when there is none.

    A font of the system comes before one that came with a package.
    """
    typeface = _find_typeface(fontManager)
    if typeface is None:
        # matplotlib keeps a list of the fonts it once saw; one installed since is found by looking again
        manager = FontManager()
        for path in _packaged_fonts():
            manager.addfont(path)
        typeface = _find_typeface(manager)
        if typeface is not None:
            fontManager.ttflist += [entry for entry in manager.ttflist if entry.name == typeface.family]
    return typeface


def _packaged_fonts() -> list[Path]:
    """Return the files of the fonts that a package brings; it is not imported, for that would change how everything is drawn."""
    package = importlib.util.find_spec(FONT_PACKAGE)
    return sorted(Path(package.origin).parent.glob("fonts/*.ttf")) if package and package.origin else []


def _find_typeface(manager: FontManager) -> Typeface | None:
    """Return the first of the families that a list of fonts holds."""
    weights: dict[str, set[int]] = {}
    for entry in manager.ttflist:
        if entry.name in FAMILIES and entry.style == "normal":
            weights.setdefault(entry.name, set()).add(_weight_number(entry.weight))
    families = sorted(weights, key=lambda name: (REGULAR not in weights[name], FAMILIES.index(name)))
    return Typeface(families[0], tuple(sorted(weights[families[0]]))) if families else None


def drawable_locale() -> str:
    """Return the language of figures: the one spoken, or English where no font holds its letters."""
    return "en" if get_locale() != "en" and japanese_font() is None else get_locale()


def can_render(text: str) -> bool:
    """Return whether there is a font that holds the letters of a text."""
    return not is_wide(text) or japanese_font() is not None


def has_missing_glyphs(figure: Figure) -> bool:
    """Return whether a figure has letters that no font holds."""
    return not all(can_render(text.get_text()) for text in figure.findobj(Text) if isinstance(text, Text))


def build_localized(build: Callable[[], Figure]) -> Figure:
    """Return a figure, built in the language in which it can be drawn.

    Parameters
    ----------
    build : callable
        Returns the figure.
    """
    with use_locale(drawable_locale()):
        return build()


@contextmanager
def use_fonts(figure: Figure, locale: str) -> Iterator[None]:
    """Give every text of a figure a font that holds it, and take names for what they are: a dollar sign begins no formula.

    Inside the block matplotlib keeps to itself which weights a family lacks, the nearest has been chosen, and which letters.

    Parameters
    ----------
    figure : Figure
        Changed in place.
    locale : "en" or "ja"
        In Japanese all letters are of one family; in English a Japanese name gets its own.
    """
    parts = figure.findobj()
    numbers = _tick_labels(axis for axis in parts if isinstance(axis, Axis))
    for text in (part for part in parts if isinstance(part, Text)):
        if id(text) not in numbers:
            text.set_parse_math(False)
        if locale != "en" or is_wide(text.get_text()):
            typeface = japanese_font()
            if typeface is not None:
                text.set_fontfamily([typeface.family, LATIN])
                text.set_fontweight(typeface.nearest(text.get_fontweight()))
    remarks = logging.getLogger("matplotlib.font_manager")
    level = remarks.level
    remarks.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message="Glyph .* missing from font")
            yield
    finally:
        remarks.setLevel(level)


def _tick_labels(axes: Iterable[Axis]) -> set[int]:
    """Return which texts are the numbers along an axis: matplotlib writes powers of ten as formulas; names along an axis are none."""
    marks = [axis for axis in axes if not isinstance(axis.get_major_formatter(), (StrCategoryFormatter, FixedFormatter))]
    ticks = [tick for axis in marks for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks())]
    return {id(label) for tick in ticks for label in (tick.label1, tick.label2)} | {id(axis.get_offset_text()) for axis in marks}
