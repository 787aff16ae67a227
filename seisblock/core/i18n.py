"""Translatable messages (gettext) with lazy translation.

Libraries create a :class:`Message` (:func:`lazy_gettext`, or the template and values of an error): an English string, used as such in
documents and tracebacks, that keeps its template and values. Reports and the command line translate it with :func:`gettext` into the
active language. Strings that are data are marked for extraction by :func:`N_` at their definition.

Templates are those of :meth:`str.format`, with named fields. The catalogues are gettext's, ``locale/LANGUAGE/LC_MESSAGES/seisblock.po``,
compiled when a wheel is built; English loads none.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from enum import StrEnum
from functools import cache
from pathlib import Path
from string import Formatter
from typing import Any
from unicodedata import category

LANGUAGES = ("en", "ja")

LOCALE_DIR = Path(__file__).parents[1] / "locale"
"""Folder of the catalogues."""

LOCALE_VARIABLES = ("LC_ALL", "LC_MESSAGES", "LANG")

_LIST_SEPARATORS = {"en": ", ", "ja": "、"}
"""Separator of the items of a list, by language."""

_CLAUSE_SEPARATORS = {"en": "; ", "ja": "、"}
"""Separator of the steps of a processing history, by language."""

_VALUE_MARK = "\0"
"""Marker around each formatted value, removed after the adjustment of blanks."""

_CJK_SPACE = re.compile(rf"(?<=[\u3040-\u9fff]) (?={_VALUE_MARK}[\u3040-\u9fff])|(?<=[\u3040-\u9fff]{_VALUE_MARK}) (?=[\u3040-\u9fff])")
"""Blank between template and value: kept between Japanese and Latin text, removed between two Japanese parts."""

MAX_MESSAGE_LENGTH = 400
"""Maximum length of a message, characters."""

_locale: ContextVar[str | None] = ContextVar("locale", default=None)


class Message(str):
    """English string that keeps its template and values for later translation.

    Parameters
    ----------
    template : str
    values : mapping
        Values of the template's fields; a ``Message`` among them is translated, too, and sequences are joined as lists.
    """

    __slots__ = ("template", "values")
    template: str
    values: Mapping[str, Any]

    def __new__(cls, template: str, values: Mapping[str, Any]) -> Message:
        """Format the English text."""
        text = super().__new__(cls, _format(template, values, "en"))
        text.template, text.values = template, values
        return text

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy template and values."""
        return Message, (self.template, self.values)


def lazy_gettext(template: str, /, **values: Any) -> Message:
    """Return an English message that can be translated later.

    Parameters
    ----------
    template : str
        English text with a field in braces for each value; a ``Message`` without values is returned unchanged.
    values : any
        Values of the fields.
    """
    return template if isinstance(template, Message) and not values else Message(template, values)


def N_(word: str) -> str:
    """Mark a string for extraction (gettext ``N_``) and return it unchanged."""
    return word


class Term(StrEnum):
    """Enumeration of outcomes or modes whose values, marked by :func:`N_`, are data; a member shows as the plain string.

    Examples
    --------
    >>> class End(Term):
    ...     STILL_MOVING = N_("still moving")
    >>> End.STILL_MOVING, End.STILL_MOVING == "still moving", End("still moving").name
    ('still moving', True, 'STILL_MOVING')
    """

    def __repr__(self) -> str:
        return repr(self.value)


def gettext(text: str, /, **values: Any) -> str:
    """Translate a message into the active language.

    Parameters
    ----------
    text : str
        Template, :class:`Message`, or string marked by :func:`N_`; a text without a translation is returned in English.
    values : any
        Values of the template's fields.
    """
    message = text if isinstance(text, Message) and not values else Message(text, values)
    return _translate(message, get_locale())


def join_list(parts: Iterable[str]) -> str:
    """Join texts with the list separator of the active language.

    Parameters
    ----------
    parts : iterable of str
    """
    return _LIST_SEPARATORS[get_locale()].join(parts)


def join_alternatives(words: Iterable[str]) -> str:
    """Return words as alternatives, to be translated later: ``.png, .svg or .pdf``.

    Parameters
    ----------
    words : iterable of str

    Examples
    --------
    >>> print(join_alternatives([".png", ".svg", ".pdf"]), join_alternatives([".html"]))
    .png, .svg or .pdf .html
    """
    *first, last = words
    return lazy_gettext("{words} or {last}", words=first, last=last) if first else last


def join_clauses(clauses: Iterable[str]) -> str:
    """Join clauses, which may hold commas, with the clause separator of the active language.

    Parameters
    ----------
    clauses : iterable of str
    """
    return _CLAUSE_SEPARATORS[get_locale()].join(clauses)


def join_sentences(sentences: Iterable[str]) -> str:
    """Join sentences as the active language does.

    Japanese results are noun phrases without a full stop; where another sentence follows, each gets one.

    Parameters
    ----------
    sentences : iterable of str

    Examples
    --------
    >>> with use_locale("ja"):
    ...     join_sentences(["転倒確率 36 %", "静止します。", "残留変位なし"])
    '転倒確率 36 %。静止します。残留変位なし'
    """
    if get_locale() == "en":
        return " ".join(sentences)
    *first, last = [*sentences] or [""]
    return "".join([*(text if text.endswith("。") else f"{text}。" for text in first if text), last])


def format_percent(share: float, digits: str = ".0") -> str:
    """Format a ratio in per cent, with a blank before the sign (ISO 80000-1).

    Template formats that end with ``%`` do the same.

    Parameters
    ----------
    share : float, 1
    digits : str
        Number of decimals, such as ``.0`` and ``.1``, or a format such as ``g``.

    Examples
    --------
    >>> format_percent(0.043), format_percent(0.043, ".1"), format_percent(0.05, "g"), gettext("{level:g%} interval", level=0.9)
    ('4 %', '4.3 %', '5 %', '90 % interval')
    """
    return f"{format(100.0 * share, digits if digits[-1:].isalpha() else f'{digits}f')} %"


def format_share(share: float) -> str:
    """Format a ratio in whole per cent; values just above 0 and just below 1 are not rounded to 0 % and 100 %.

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
    """Return the active language.

    It is the argument, else that of :func:`use_locale`, else ``ja`` in a Japanese environment, else ``en``.

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
    """Set the language inside the block; None keeps the current one.

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
    r"""Escape control characters of a text from a file, so that a terminal does not interpret them.

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
    """Shorten an overlong message by leaving out its middle.

    Parameters
    ----------
    text : str
    """
    return text if len(text) <= MAX_MESSAGE_LENGTH else f"{text[: MAX_MESSAGE_LENGTH - 165]} ... {text[-160:]}"


def _translate(text: Message, locale: str) -> str:
    return str(text) if locale == "en" else _format(_load_catalogue(locale)(text.template), text.values, locale)


def _format(template: str, values: Mapping[str, Any], locale: str) -> str:
    """Format a template; without values, braces are literal."""
    if not values:
        return template
    text = _MessageFormatter(locale).vformat(template, (), values)
    return _CJK_SPACE.sub("", text).replace(_VALUE_MARK, "")


class _MessageFormatter(Formatter):
    """Formatter that translates messages, escapes control characters of strings and joins sequences."""

    def __init__(self, locale: str) -> None:
        self.locale = locale

    def get_field(self, field_name: str, args: Any, kwargs: Any) -> Any:
        value, used_key = super().get_field(field_name, args, kwargs)
        return self._to_text(value), used_key

    def format_field(self, value: Any, format_spec: str) -> str:
        """Format a value; ``%`` is handled by :func:`format_percent`."""
        text = format_percent(value, format_spec[:-1]) if format_spec.endswith("%") else str(super().format_field(value, format_spec))
        return text if self.locale == "en" else f"{_VALUE_MARK}{text}{_VALUE_MARK}"

    def _to_text(self, value: Any) -> Any:
        """Convert a string or a sequence to text; other values are returned unchanged."""
        if isinstance(value, Message):
            return _translate(value, self.locale)
        if isinstance(value, str):
            return escape_control(value)
        if isinstance(value, (list, tuple)):
            return _LIST_SEPARATORS[self.locale].join(str(self._to_text(part)) for part in value)
        return value


@cache
def _load_catalogue(locale: str) -> Callable[[str], str]:
    """Return the translation function: from the compiled catalogue, or from the .po file if that is newer (development)."""
    folder = LOCALE_DIR / locale / "LC_MESSAGES"
    mo_path, po_path = folder / "seisblock.mo", folder / "seisblock.po"
    if po_path.is_file() and not (mo_path.is_file() and mo_path.stat().st_mtime > po_path.stat().st_mtime):
        entries = dict(_read_po(po_path))
        return lambda template: entries.get(template, template)
    from gettext import GNUTranslations

    with mo_path.open("rb") as stream:
        # gettext translates the empty string to the header of the catalogue
        translate = GNUTranslations(stream).gettext
    return lambda template: translate(template) if template else ""


def _read_po(path: Path) -> Iterator[tuple[str, str]]:
    """Yield msgid and msgstr of the entries of a .po file."""
    from ast import literal_eval

    entry = {"msgid": "", "msgstr": ""}
    key = ""
    # the additional msgid completes the last entry
    for line in [*path.read_text(encoding="utf-8").splitlines(), 'msgid ""']:
        if not line.startswith('"'):
            key, _, line = line.partition(" ")
            if key == "msgid":
                if entry["msgid"] and entry["msgstr"]:
                    yield entry["msgid"], entry["msgstr"]
                entry = {"msgid": "", "msgstr": ""}
        if key in entry:
            entry[key] += literal_eval(line)
