"""Which language a command line is answered in: its own ``--lang``, else that of the locale; click's own words too."""

from __future__ import annotations

import gettext
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise

from seisblock.words import LANGUAGES, LOCALES, language, speaking

DOMAIN = "seisblock"


def asked_in(arguments: Sequence[str]) -> str | None:
    """Return the language that a command line asks for, so that its errors are told in it too."""
    chosen = [value for name, value in pairwise(arguments) if name == "--lang"]
    chosen += [name.partition("=")[2] for name in arguments if name.startswith("--lang=")]
    return next((name for name in chosen if name in LANGUAGES), None)


@contextmanager
def answering(arguments: Sequence[str]) -> Iterator[None]:
    """Speak the language of a command line inside the block, and have click, which asks gettext, speak it as well."""
    with speaking(asked_in(arguments)):
        before, variable = gettext.textdomain(), os.environ.get("LANGUAGE")
        gettext.bindtextdomain(DOMAIN, str(LOCALES))
        gettext.textdomain(DOMAIN)
        os.environ["LANGUAGE"] = language()
        try:
            yield
        finally:
            gettext.textdomain(before)
            if variable is None:
                del os.environ["LANGUAGE"]
            else:
                os.environ["LANGUAGE"] = variable
