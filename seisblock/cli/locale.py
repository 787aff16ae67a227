"""Locale of a command line: ``--lang``, else the environment; applied to click's messages, too."""

from __future__ import annotations

import gettext
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise

from seisblock.core.i18n import LANGUAGES, LOCALE_DIR, get_locale, use_locale

DOMAIN = "seisblock"


def requested_locale(arguments: Sequence[str]) -> str | None:
    """Return the locale of ``--lang`` before the line is parsed, so that parse errors are translated."""
    values = [value for name, value in pairwise(arguments) if name == "--lang"]
    values += [name.partition("=")[2] for name in arguments if name.startswith("--lang=")]
    return next((name for name in values if name in LANGUAGES), None)


@contextmanager
def use_cli_locale(arguments: Sequence[str]) -> Iterator[None]:
    """Use the locale of a command line inside the context, also for click's gettext messages."""
    with use_locale(requested_locale(arguments)):
        previous_domain, variable = gettext.textdomain(), os.environ.get("LANGUAGE")
        gettext.bindtextdomain(DOMAIN, str(LOCALE_DIR))
        gettext.textdomain(DOMAIN)
        os.environ["LANGUAGE"] = get_locale()
        try:
            yield
        finally:
            gettext.textdomain(previous_domain)
            if variable is None:
                del os.environ["LANGUAGE"]
            else:
                os.environ["LANGUAGE"] = variable
