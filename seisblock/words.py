"""Every text a person sees: said once, in English, and told in the language of whoever reads it.

Lower floors *say* (:func:`said`, or the template and the values of an error): what they give away reads as an English sentence, in
documents and tracebacks alike, and remembers what it was made of. The rooms above *tell* (:func:`tell`): the same template, looked
up in the catalogue of the language now spoken, with the same values. A vocabulary that travels as data is *noted* where it is
defined, so that it is in the catalogue when it is told.

Templates are those of :meth:`str.format`, with named fields. The catalogues are gettext's, ``locale/LANGUAGE/LC_MESSAGES/seisblock.po``,
compiled when a wheel is built; English loads none.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from pathlib import Path
from string import Formatter
from typing import Any
from unicodedata import category

LANGUAGES = ("en", "ja")

LOCALES = Path(__file__).with_name("locale")
"""Where the catalogues are."""

LOCALE_VARIABLES = ("LC_ALL", "LC_MESSAGES", "LANG")

_COMMAS = {"en": ", ", "ja": "、"}
"""What stands between the members of a list."""

_BLANKS = {"en": " ", "ja": ""}
"""What stands between two sentences."""

_SEAM = "\0"
"""Where a value begins and ends in a template, while it is filled in."""

_BETWEEN_WIDE = re.compile(rf"(?<=[\u3040-\u9fff]) (?={_SEAM}[\u3040-\u9fff])|(?<=[\u3040-\u9fff]{_SEAM}) (?=[\u3040-\u9fff])")
"""A blank between a template and a value: it parts Japanese from Latin letters and numbers, and goes where both are Japanese."""

MOST_SHOWN = 1200
"""Longest message, in letters."""

_asked: ContextVar[str | None] = ContextVar("language asked for", default=None)


class Said(str):
    """An English text that remembers its template and its values, so that it can be told in another language.

    It is a string like any other, and stays one in a document, a message or a comparison.

    Parameters
    ----------
    template : str
    values : mapping
        Of the template's fields; values that are themselves ``Said`` are told along with it, sequences are listed.
    """

    __slots__ = ("template", "values")
    template: str
    values: Mapping[str, Any]

    def __new__(cls, template: str, values: Mapping[str, Any]) -> Said:
        """Fill in the template."""
        text = super().__new__(cls, _filled(template, values, "en"))
        text.template, text.values = template, values
        return text

    def __reduce__(self) -> tuple[Any, ...]:
        """Travel to another process, or into a copy, whole."""
        return Said, (self.template, self.values)


def said(template: str, /, **values: Any) -> Said:
    """Return a text, in English, that can be told in any language.

    Parameters
    ----------
    template : str
        English, with a field in braces for each value; what was said already stays as it is.
    values : any
    """
    return template if isinstance(template, Said) and not values else Said(template, values)


def noted(word: str) -> str:
    """Return a word of a vocabulary as it is, and have it in the catalogues: it is data here, and told where somebody reads it."""
    return word


def tell(text: str, /, **values: Any) -> str:
    """Return a text in the language now spoken.

    Parameters
    ----------
    text : str
        A template, a text that was :func:`said`, or a word that was :func:`noted`; what no catalogue holds stays as it is.
    values : any
        Of the template's fields.
    """
    whole = text if isinstance(text, Said) and not values else Said(text, values)
    return _told(whole, language())


def listed(parts: Iterable[str]) -> str:
    """Return texts in a row, with what the language spoken puts between them.

    Parameters
    ----------
    parts : iterable of str
    """
    return _COMMAS[language()].join(parts)


def strung(sentences: Iterable[str]) -> str:
    """Return sentences one after the other, with a blank between them where the language spoken has one.

    Parameters
    ----------
    sentences : iterable of str
    """
    return _BLANKS[language()].join(sentences)


def percent(share: float, digits: str = ".0") -> str:
    """Return a share in per cent, with a blank before the sign as in all units; in templates a format that ends with ``%`` does the same.

    Parameters
    ----------
    share : float, 1
    digits : str
        How the number is written: decimals such as ``.0`` and ``.1``, or a format such as ``g``.

    Examples
    --------
    >>> percent(0.043), percent(0.043, ".1"), percent(0.05, "g"), tell("{level:g%} interval", level=0.9)
    ('4 %', '4.3 %', '5 %', '90 % interval')
    """
    return f"{format(100.0 * share, digits if digits[-1:].isalpha() else f'{digits}f')} %"


def roughly(share: float) -> str:
    """Return a share, told in whole per cent; neither 0 % nor 100 % where it is not quite.

    Parameters
    ----------
    share : float, 1

    Examples
    --------
    >>> roughly(0.0), roughly(0.004), roughly(0.43), roughly(0.998), roughly(1.0)
    ('0 %', 'less than 1 %', '43 %', 'more than 99 %', '100 %')
    """
    if 0.0 < share < 0.01:
        return tell("less than 1 %")
    if 0.99 < share < 1.0:
        return tell("more than 99 %")
    return percent(share)


def language(asked: str | None = None) -> str:
    """Return a language: the one asked for, else that of the block of :func:`speaking`, else Japanese in a Japanese locale, else English.

    Parameters
    ----------
    asked : "en", "ja" or None
    """
    wanted = asked or _asked.get()
    if wanted:
        return wanted
    chosen = next((os.environ[name] for name in LOCALE_VARIABLES if os.environ.get(name)), "")
    return "ja" if chosen.lower().startswith("ja") else "en"


@contextmanager
def speaking(asked: str | None) -> Iterator[None]:
    """Speak a language inside the block; None changes nothing.

    Parameters
    ----------
    asked : "en", "ja" or None
    """
    before = _asked.set(asked or _asked.get())
    try:
        yield
    finally:
        _asked.reset(before)


def plain_text(text: str) -> str:
    r"""Return a text from a file as one that a terminal prints and does not obey: what is no letter, sign or blank is spelt out.

    Parameters
    ----------
    text : str

    Examples
    --------
    >>> plain_text("K-NET\x1b[31m")
    'K-NET\\x1b[31m'
    >>> plain_text("米子市\u3000博労町")
    '米子市　博労町'
    """
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c == "\n" or category(c) == "Zs" else c.encode("unicode_escape").decode() for c in text)


def on_a_screen(text: str) -> str:
    """Return a message that fits a screen: the middle of one that quotes half a file is left out.

    Parameters
    ----------
    text : str
    """
    return text if len(text) <= MOST_SHOWN else f"{text[: MOST_SHOWN - 200]} ... {text[-150:]}"


def _told(text: Said, spoken: str) -> str:
    """Return a text that was said in a language."""
    return str(text) if spoken == "en" else _filled(_catalogue(spoken)(text.template), text.values, spoken)


def _filled(template: str, values: Mapping[str, Any], spoken: str) -> str:
    """Return a template with its values; without values nothing is a field."""
    if not values:
        return template
    text = _Filler(spoken).vformat(template, (), values)
    return _BETWEEN_WIDE.sub("", text).replace(_SEAM, "")


class _Filler(Formatter):
    """Fills in a template: texts that were said are told, those of files made harmless, sequences listed."""

    def __init__(self, spoken: str) -> None:
        self.spoken = spoken

    def get_field(self, field_name: str, args: Any, kwargs: Any) -> Any:
        """Return the value of a field as it is shown."""
        value, first = super().get_field(field_name, args, kwargs)
        return self._shown(value), first

    def format_field(self, value: Any, format_spec: str) -> str:
        """Return a value in a format, in which ``%`` writes a share as :func:`percent` does."""
        shown = percent(value, format_spec[:-1]) if format_spec.endswith("%") else str(super().format_field(value, format_spec))
        return shown if self.spoken == "en" else f"{_SEAM}{shown}{_SEAM}"

    def _shown(self, value: Any) -> Any:
        """Return a text or a sequence as text, anything else as it is."""
        if isinstance(value, Said):
            return _told(value, self.spoken)
        if isinstance(value, str):
            return plain_text(value)
        if isinstance(value, (list, tuple)):
            return _COMMAS[self.spoken].join(str(self._shown(part)) for part in value)
        return value


@cache
def _catalogue(spoken: str) -> Callable[[str], str]:
    """Return what translates a template: the compiled catalogue, or the written one where it is newer, as in a developer's tree."""
    folder = LOCALES / spoken / "LC_MESSAGES"
    compiled, written = folder / "seisblock.mo", folder / "seisblock.po"
    if written.is_file() and not (compiled.is_file() and compiled.stat().st_mtime > written.stat().st_mtime):
        entries = dict(_read(written))
        return lambda template: entries.get(template, template)
    from gettext import GNUTranslations

    with compiled.open("rb") as stream:
        # gettext answers an empty text with the head of the catalogue
        translate = GNUTranslations(stream).gettext
    return lambda template: translate(template) if template else ""


def _read(path: Path) -> Iterator[tuple[str, str]]:
    """Yield what a catalogue that is not compiled translates, and how."""
    from ast import literal_eval

    entry = {"msgid": "", "msgstr": ""}
    key = ""
    for line in [*path.read_text(encoding="utf-8").splitlines(), 'msgid ""']:
        if not line.startswith('"'):
            key, _, line = line.partition(" ")
            if key == "msgid":
                if entry["msgid"] and entry["msgstr"]:
                    yield entry["msgid"], entry["msgstr"]
                entry = {"msgid": "", "msgstr": ""}
        if key in entry:
            entry[key] += literal_eval(line)
