"""Rendering of self-contained HTML pages from Jinja templates."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock import __version__
from seisblock.core.i18n import escape_control, get_locale, gettext

if TYPE_CHECKING:
    from jinja2 import Environment

TEMPLATES = Path(__file__).with_name("templates")
"""Folder of the templates; inserted text is HTML-escaped."""

NUMBER_UNIT_SPACE = re.compile(r"(?<=\d) (?=(?:%|mm|cm|m|s|Hz|gal|kine|kg|J)(?![\w/]))")
"""Space between a number and its unit or per cent sign, replaced by a no-break space."""


def render_page(template: str, title: str, **values: Any) -> str:
    """Return an HTML document in the language of the locale.

    Parameters
    ----------
    template : str
        Name of a file in :data:`TEMPLATES`.
    title : str
        Plain text, as all text values are.
    values : any
        Fields of the template; every page has ``subtitles`` (lines below the title) and ``foot`` (after the program version).
    """
    return make_environment().get_template(template).render(title=title, lang=get_locale(), **values)


@cache
def make_environment(folder: Path = TEMPLATES) -> Environment:
    """Return the Jinja environment of a folder of templates, which may use those of :data:`TEMPLATES`."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader((folder, TEMPLATES)),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=_finalize,
    )
    environment.globals |= {"gettext": gettext, "version": __version__, "subtitles": (), "foot": ""}
    environment.policies["json.dumps_kwargs"] = {"ensure_ascii": False, "separators": (",", ":")}
    return environment


def _finalize(value: Any) -> Any:
    """Escape control characters and join numbers to their units; values other than plain ``str`` pass unchanged."""
    return NUMBER_UNIT_SPACE.sub("\N{NO-BREAK SPACE}", escape_control(value)) if type(value) is str else value
