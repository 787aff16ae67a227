"""Every text a person sees: said once, in English, and told in the language of whoever reads it.

Lower floors *say* (:func:`lazy_gettext`, or the template and the values of an error): what they give away reads as an English sentence, in
documents and tracebacks alike, and remembers what it was made of. The rooms above *tell* (:func:`gettext`): the same template, looked
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

LOCALE_DIR = Path(__file__).parents[1] / "locale"
"""Where the catalogues are."""

LOCALE_VARIABLES = ("LC_ALL", "LC_MESSAGES", "LANG")

_LIST_SEPARATORS = {"en": ", ", "ja": "、"}
"""What stands between the members of a list."""

_SENTENCE_SEPARATORS = {"en": " ", "ja": ""}
"""What stands between two sentences."""

_VALUE_MARK = "\0"
"""Where a value begins and ends in a template, while it is filled in."""

_CJK_SPACE = re.compile(rf"(?<=[\u3040-\u9fff]) (?={_VALUE_MARK}[\u3040-\u9fff])|(?<=[\u3040-\u9fff]{_VALUE_MARK}) (?=[\u3040-\u9fff])")
"""A blank between a template and a value: it parts Japanese from Latin letters and numbers, and goes where both are Japanese."""

MAX_MESSAGE_LENGTH = 1200
"""Longest message, in letters."""

_locale: ContextVar[str | None] = ContextVar("language asked for", default=None)


class Message(str):
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

    def __new__(cls, template: str, values: Mapping[str, Any]) -> Message:
        """Fill in the template."""
        text = super().__new__(cls, _format(template, values, "en"))
        text.template, text.values = template, values
        return text

    def __reduce__(self) -> tuple[Any, ...]:
        """Travel to another process, or into a copy, whole."""
        return Message, (self.template, self.values)


def lazy_gettext(template: str, /, **values: Any) -> Message:
    """Return a text, in English, that can be told in any language.

    Parameters
    ----------
    template : str
        English, with a field in braces for each value; what was said already stays as it is.
    values : any
    """
    return template if isinstance(template, Message) and not values else Message(template, values)


def N_(word: str) -> str:
    """Return a word of a vocabulary as it is, and have it in the catalogues: it is data here, and told where somebody reads it."""
    return word


def gettext(text: str, /, **values: Any) -> str:
    """Return a text in the language now spoken.

    Parameters
    ----------
    text : str
        A template, a text that was :func:`lazy_gettext`, or a word that was :func:`N_`; what no catalogue holds stays as it is.
    values : any
        Of the template's fields.
    """
    message = text if isinstance(text, Message) and not values else Message(text, values)
    return _translate(message, get_locale())


def join_list(parts: Iterable[str]) -> str:
    """Return texts in a row, with what the language spoken puts between them.

    Parameters
    ----------
    parts : iterable of str
    """
    return _LIST_SEPARATORS[get_locale()].join(parts)


def join_sentences(sentences: Iterable[str]) -> str:
    """Return sentences one after the other, with a blank between them where the language spoken has one.

    Parameters
    ----------
    sentences : iterable of str
    """
    return _SENTENCE_SEPARATORS[get_locale()].join(sentences)


def format_percent(share: float, digits: str = ".0") -> str:
    """Return a share in per cent, with a blank before the sign as in all units; in templates a format that ends with ``%`` does the same.

    Parameters
    ----------
    share : float, 1
    digits : str
        How the number is written: decimals such as ``.0`` and ``.1``, or a format such as ``g``.

    Examples
    --------
    >>> format_percent(0.043), format_percent(0.043, ".1"), format_percent(0.05, "g"), gettext("{level:g%} interval", level=0.9)
    ('4 %', '4.3 %', '5 %', '90 % interval')
    """
    return f"{format(100.0 * share, digits if digits[-1:].isalpha() else f'{digits}f')} %"


def format_share(share: float) -> str:
    """Return a share, told in whole per cent; neither 0 % nor 100 % where it is not quite.

    Parameters
    ----------
    share : float, 1

    Examples
    --------
    >>> format_share(0.0), format_share(0.004), format_share(0.43), format_share(0.998), format_share(1.0)
    ('0 %', 'less than 1 %', '43 %', 'more than 99 %', '100 %')
    """
    if 0.0 < share < 0.01:
        return gettext("less than 1 %")
    if 0.99 < share < 1.0:
        return gettext("more than 99 %")
    return format_percent(share)


def get_locale(locale: str | None = None) -> str:
    """Return a language: the one asked for, else that of the block of :func:`use_locale`, else Japanese in a Japanese locale, else English.

    Parameters
    ----------
    locale : "en", "ja" or None
    """
    code = locale or _locale.get()
    if code:
        return code
    system_locale = next((os.environ[name] for name in LOCALE_VARIABLES if os.environ.get(name)), "")
    return "ja" if system_locale.lower().startswith("ja") else "en"


@contextmanager
def use_locale(locale: str | None) -> Iterator[None]:
    """Speak a language inside the block; None changes nothing.

    Parameters
    ----------
    locale : "en", "ja" or None
    """
    token = _locale.set(locale or _locale.get())
    try:
        yield
    finally:
        _locale.reset(token)


def escape_control(text: str) -> str:
    r"""Return a text from a file as one that a terminal prints and does not obey: what is no letter, sign or blank is spelt out.

    Parameters
    ----------
    text : str

    Examples
    --------
    >>> escape_control("K-NET\x1b[31m")
    'K-NET\\x1b[31m'
    >>> escape_control("米子市\u3000博労町")
    '米子市　博労町'
    """
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c == "\n" or category(c) == "Zs" else c.encode("unicode_escape").decode() for c in text)


def truncate(text: str) -> str:
    """Return a message that fits a screen: the middle of one that quotes half a file is left out.

    Parameters
    ----------
    text : str
    """
    return text if len(text) <= MAX_MESSAGE_LENGTH else f"{text[: MAX_MESSAGE_LENGTH - 200]} ... {text[-150:]}"


def _translate(text: Message, locale: str) -> str:
    """Return a text that was said in a language."""
    return str(text) if locale == "en" else _format(_load_catalogue(locale)(text.template), text.values, locale)


def _format(template: str, values: Mapping[str, Any], locale: str) -> str:
    """Return a template with its values; without values nothing is a field."""
    if not values:
        return template
    text = _MessageFormatter(locale).vformat(template, (), values)
    return _CJK_SPACE.sub("", text).replace(_VALUE_MARK, "")


class _MessageFormatter(Formatter):
    """Fills in a template: texts that were said are told, those of files made harmless, sequences listed."""

    def __init__(self, locale: str) -> None:
        self.locale = locale

    def get_field(self, field_name: str, args: Any, kwargs: Any) -> Any:
        """Return the value of a field as it is shown."""
        value, used_key = super().get_field(field_name, args, kwargs)
        return self._to_text(value), used_key

    def format_field(self, value: Any, format_spec: str) -> str:
        """Return a value in a format, in which ``%`` writes a share as :func:`format_percent` does."""
        text = format_percent(value, format_spec[:-1]) if format_spec.endswith("%") else str(super().format_field(value, format_spec))
        return text if self.locale == "en" else f"{_VALUE_MARK}{text}{_VALUE_MARK}"

    def _to_text(self, value: Any) -> Any:
        """Return a text or a sequence as text, anything else as it is."""
        if isinstance(value, Message):
            return _translate(value, self.locale)
        if isinstance(value, str):
            return escape_control(value)
        if isinstance(value, (list, tuple)):
            return _LIST_SEPARATORS[self.locale].join(str(self._to_text(part)) for part in value)
        return value


@cache
def _load_catalogue(locale: str) -> Callable[[str], str]:
    """Return what translates a template: the compiled catalogue, or the written one where it is newer, as in a developer's tree."""
    folder = LOCALE_DIR / locale / "LC_MESSAGES"
    mo_path, po_path = folder / "seisblock.mo", folder / "seisblock.po"
    if po_path.is_file() and not (mo_path.is_file() and mo_path.stat().st_mtime > po_path.stat().st_mtime):
        entries = dict(_read_po(po_path))
        return lambda template: entries.get(template, template)
    from gettext import GNUTranslations

    with mo_path.open("rb") as stream:
        # gettext answers an empty text with the head of the catalogue
        translate = GNUTranslations(stream).gettext
    return lambda template: translate(template) if template else ""


def _read_po(path: Path) -> Iterator[tuple[str, str]]:
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
