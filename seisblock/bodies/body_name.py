"""What a body is called in a sentence that is told in any language."""

from __future__ import annotations

from seisblock.core.i18n import Message, escape_control, lazy_gettext


def body_name(name: str) -> Message:
    """Return the name of a body as a value of what is said: told where it is one of ours, made harmless where a file gave it.

    Parameters
    ----------
    name : str

    Examples
    --------
    >>> from seisblock.core.i18n import use_locale, gettext
    >>> with use_locale("ja"):
    ...     gettext("{name}", name=body_name("gravestone"))
    '墓石'
    """
    return lazy_gettext(escape_control(name))
