"""Which language a command line is answered in: its own ``--lang``, else that of the locale; click's own words too."""

from __future__ import annotations

import gettext
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise

from seisblock.core.i18n import LANGUAGES, LOCALE_DIR, get_locale, use_locale

DOMAIN = "seisblock"


def requested_locale(arguments: Sequence[str]) -> str | None:
    """Return the language that a command line asks for, so that its errors are told in it too."""
    values = [value for name, value in pairwise(arguments) if name == "--lang"]
    values += [name.partition("=")[2] for name in arguments if name.startswith("--lang=")]
    return next((name for name in values if name in LANGUAGES), None)


@contextmanager
def use_cli_locale(arguments: Sequence[str]) -> Iterator[None]:
    """Speak the language of a command line inside the block, and have click, which asks gettext, speak it as well."""
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
