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

from seisblock.present.wrap import is_wide
from seisblock.words import language, noted, speaking

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

PACKAGE = "matplotlib_fontja"
"""A package of the index that brings IPAexGothic, and needs no system's leave; only its file is used."""

MISSING = noted(
    "no font with Japanese letters was found: the figure is in English; install one, say fonts-noto-cjk, or pip install matplotlib-fontja"
)
"""What to say when there is none."""

BOXES = noted(
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
        return min(self.weights, key=lambda there: abs(there - _number(weight)))


def _number(weight: Any) -> int:
    """Return a weight as a number: matplotlib knows them by name, too."""
    return int(weight_dict.get(weight, weight))


@cache
def japanese_font() -> Typeface | None:
    """Return an installed family that holds Japanese, one of regular weight before one that is only bold; None when there is none.

    A font of the system comes before one that came with a package.
    """
    found = _face(fontManager)
    if found is None:
        # matplotlib keeps a list of the fonts it once saw; one installed since is found by looking again
        again = FontManager()
        for path in _packaged():
            again.addfont(path)
        found = _face(again)
        if found is not None:
            fontManager.ttflist += [entry for entry in again.ttflist if entry.name == found.family]
    return found


def _packaged() -> list[Path]:
    """Return the files of the fonts that a package brings; it is not imported, for that would change how everything is drawn."""
    package = importlib.util.find_spec(PACKAGE)
    return sorted(Path(package.origin).parent.glob("fonts/*.ttf")) if package and package.origin else []


def _face(manager: FontManager) -> Typeface | None:
    """Return the first of the families that a list of fonts holds."""
    weights: dict[str, set[int]] = {}
    for entry in manager.ttflist:
        if entry.name in FAMILIES and entry.style == "normal":
            weights.setdefault(entry.name, set()).add(_number(entry.weight))
    there = sorted(weights, key=lambda name: (REGULAR not in weights[name], FAMILIES.index(name)))
    return Typeface(there[0], tuple(sorted(weights[there[0]]))) if there else None


def drawable() -> str:
    """Return the language of figures: the one spoken, or English where no font holds its letters."""
    return "en" if language() != "en" and japanese_font() is None else language()


def has_letters(text: str) -> bool:
    """Return whether there is a font that holds the letters of a text."""
    return not is_wide(text) or japanese_font() is not None


def has_boxes(figure: Figure) -> bool:
    """Return whether a figure has letters that no font holds."""
    return not all(has_letters(text.get_text()) for text in figure.findobj(Text) if isinstance(text, Text))


def drawn(build: Callable[[], Figure]) -> Figure:
    """Return a figure, built in the language in which it can be drawn.

    Parameters
    ----------
    build : callable
        Returns the figure.
    """
    with speaking(drawable()):
        return build()


@contextmanager
def set_letters(figure: Figure, spoken: str) -> Iterator[None]:
    """Give every text of a figure a font that holds it, and take names for what they are: a dollar sign begins no formula.

    Inside the block matplotlib keeps to itself which weights a family lacks, the nearest has been chosen, and which letters.

    Parameters
    ----------
    figure : Figure
        Changed in place.
    spoken : "en" or "ja"
        In Japanese all letters are of one family; in English a Japanese name gets its own.
    """
    parts = figure.findobj()
    numbers = _numbers(axis for axis in parts if isinstance(axis, Axis))
    for text in (part for part in parts if isinstance(part, Text)):
        if id(text) not in numbers:
            text.set_parse_math(False)
        if spoken != "en" or is_wide(text.get_text()):
            face = japanese_font()
            if face is not None:
                text.set_fontfamily([face.family, LATIN])
                text.set_fontweight(face.nearest(text.get_fontweight()))
    remarks = logging.getLogger("matplotlib.font_manager")
    before = remarks.level
    remarks.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message="Glyph .* missing from font")
            yield
    finally:
        remarks.setLevel(before)


def _numbers(axes: Iterable[Axis]) -> set[int]:
    """Return which texts are the numbers along an axis: matplotlib writes powers of ten as formulas; names along an axis are none."""
    marks = [axis for axis in axes if not isinstance(axis.get_major_formatter(), (StrCategoryFormatter, FixedFormatter))]
    ticks = [tick for axis in marks for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks())]
    return {id(label) for tick in ticks for label in (tick.label1, tick.label2)} | {id(axis.get_offset_text()) for axis in marks}
