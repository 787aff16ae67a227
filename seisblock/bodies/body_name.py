"""Body names in translated messages."""

from __future__ import annotations

from seisblock.core.i18n import Message, escape_control, lazy_gettext


def body_name(name: str) -> Message:
    """Return a body name as a message value: translated if bundled, with control characters escaped otherwise.

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
