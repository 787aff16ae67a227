"""Font selection for figures with Japanese text."""

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
from seisblock.output.text.wrap import is_wide

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
"""Font families with Japanese glyphs, in order of preference."""

REGULAR = 400
LATIN = "DejaVu Sans"
"""Font family distributed with matplotlib, with the mathematical symbols of the labels."""

FONT_PACKAGE = "matplotlib_fontja"
"""Python package with IPAexGothic; only its font file is used."""

NO_FONT = N_("no Japanese font found, figure in English: install e.g. fonts-noto-cjk, or run pip install matplotlib-fontja")
"""Warning without Japanese font, in Japanese locale."""

MISSING_GLYPHS = N_(
    "no Japanese font found, Japanese names appear as boxes in the figure: install e.g. fonts-noto-cjk, or run pip install "
    "matplotlib-fontja"
)
"""Warning without Japanese font, for a figure in English with Japanese names."""


@dataclass(frozen=True)
class Typeface:
    """A font family and its installed weights; matplotlib warns about any other weight."""

    family: str
    weights: tuple[int, ...]

    def nearest(self, weight: Any) -> int:
        """Return the installed weight nearest to a requested one."""
        return min(self.weights, key=lambda value: abs(value - _weight_number(weight)))


def _weight_number(weight: Any) -> int:
    """Return a weight as a number; matplotlib also accepts names."""
    return int(weight_dict.get(weight, weight))


@cache
def japanese_font() -> Typeface | None:
    """Return an installed Japanese font family, preferably with regular weight, or None.

    System fonts take precedence over those of :data:`FONT_PACKAGE`.
    """
    typeface = _find_typeface(fontManager)
    if typeface is None:
        # matplotlib caches its font list; a new manager finds fonts installed since
        manager = FontManager()
        for path in _packaged_fonts():
            manager.addfont(path)
        typeface = _find_typeface(manager)
        if typeface is not None:
            fontManager.ttflist += [entry for entry in manager.ttflist if entry.name == typeface.family]
    return typeface


def _packaged_fonts() -> list[Path]:
    """Return the font files of :data:`FONT_PACKAGE` without importing the package, which would change the default font."""
    package = importlib.util.find_spec(FONT_PACKAGE)
    return sorted(Path(package.origin).parent.glob("fonts/*.ttf")) if package and package.origin else []


def _find_typeface(manager: FontManager) -> Typeface | None:
    """Return the preferred family among the fonts of a manager, or None."""
    weights: dict[str, set[int]] = {}
    for entry in manager.ttflist:
        if entry.name in FAMILIES and entry.style == "normal":
            weights.setdefault(entry.name, set()).add(_weight_number(entry.weight))
    families = sorted(weights, key=lambda name: (REGULAR not in weights[name], FAMILIES.index(name)))
    return Typeface(families[0], tuple(sorted(weights[families[0]]))) if families else None


def drawable_locale() -> str:
    """Return the locale of figures: the current one, or English without a Japanese font."""
    return "en" if get_locale() != "en" and japanese_font() is None else get_locale()


def can_render(text: str) -> bool:
    """Return True if a font has the glyphs of a text."""
    return not is_wide(text) or japanese_font() is not None


def has_missing_glyphs(figure: Figure) -> bool:
    """Return True if a figure has text without glyphs."""
    return not all(can_render(text.get_text()) for text in figure.findobj(Text) if isinstance(text, Text))


def build_localized(build: Callable[[], Figure]) -> Figure:
    """Return a figure built in :func:`drawable_locale`.

    Parameters
    ----------
    build : callable
        Returns the figure.
    """
    with use_locale(drawable_locale()):
        return build()


def set_fonts(figure: Figure, locale: str) -> None:
    """Set the font of every text of a figure, and disable mathtext in names (dollar signs).

    Parameters
    ----------
    figure : Figure
        Changed in place.
    locale : "en" or "ja"
        In Japanese all text has the Japanese family; in English only Japanese names.
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


@contextmanager
def use_fonts(figure: Figure, locale: str) -> Iterator[None]:
    """Set the fonts of a figure; inside the block matplotlib's warnings on missing weights and glyphs are suppressed.

    Parameters
    ----------
    figure : Figure
        Changed in place.
    locale : "en" or "ja"
    """
    set_fonts(figure, locale)
    logger = logging.getLogger("matplotlib.font_manager")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message="Glyph .* missing from font")
            yield
    finally:
        logger.setLevel(level)


def _tick_labels(axes: Iterable[Axis]) -> set[int]:
    """Return the ids of numeric tick labels, whose powers of ten are mathtext; categorical labels are excluded."""
    numeric = [axis for axis in axes if not isinstance(axis.get_major_formatter(), (StrCategoryFormatter, FixedFormatter))]
    ticks = [tick for axis in numeric for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks())]
    return {id(label) for tick in ticks for label in (tick.label1, tick.label2)} | {id(axis.get_offset_text()) for axis in numeric}
