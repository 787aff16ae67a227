"""Body names in translated messages."""

from __future__ import annotations

from seisblock.core.i18n import Message, escape_control, lazy_gettext

TRANSLATED_NAMES = frozenset(
    (
        *("block", "bookcase", "boulder", "Chozu-sha", "chozusha", "column", "display case", "filing cabinet", "furniture", "gravestone"),
        *("lantern", "lateral filing cabinet", "machine", "machine on pads", "refrigerator", "server rack", "statue", "wagata"),
    )
)
"""Names of bundled bodies and of kinds of bodies."""


def body_name(name: str) -> Message:
    """Return a body name as a message value: translated if bundled; otherwise as it is, with control characters escaped.

    Parameters
    ----------
    name : str

    Examples
    --------
    >>> from seisblock.core.i18n import use_locale, gettext
    >>> with use_locale("ja"):
    ...     gettext("{name}", name=body_name("gravestone")), gettext(body_name("case"))
    ('墓石', 'case')
    >>> str(body_name("display_case"))
    'display case'
    """
    # names made by the program, such as that of a block of given sizes, are messages; the file of a bundled body is display_case.toml
    if isinstance(name, Message):
        return lazy_gettext(escape_control(name))
    if (bundled := name.replace("_", " ")) in TRANSLATED_NAMES:
        return lazy_gettext(bundled)
    return lazy_gettext("{name}", name=escape_control(name))
