"""One self-contained page: it opens without network, on a phone and on paper."""

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
"""What pages look like: HTML with fields; a text that is filled in cannot become a tag."""

NUMBER_UNIT_SPACE = re.compile(r"(?<=\d) (?=(?:%|mm|cm|m|s|Hz|gal|kine|kg|J)(?![\w/]))")
"""What may not be broken: the blank between a number and its unit, or its sign of per cent."""


def render_page(template: str, title: str, **values: Any) -> str:
    """Return a whole HTML document in the language spoken.

    Parameters
    ----------
    template : str
        Name of a file among :data:`TEMPLATES`.
    title : str
        Plain text, as is every text among the values.
    values : any
        The template's fields; of every page ``subtitles``, lines below the title, and ``foot``, after the program's version.
    """
    return _environment().get_template(template).render(title=title, lang=get_locale(), **values)


@cache
def _environment() -> Environment:
    """Return the templates, ready to be filled in."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
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
    """Return a text that commands nothing, whose numbers stay on one line with their units; what is no text as it is."""
    return NUMBER_UNIT_SPACE.sub("\N{NO-BREAK SPACE}", escape_control(value)) if type(value) is str else value
