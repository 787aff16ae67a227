"""What a body is called in a sentence that is told in any language."""

from __future__ import annotations

from seisblock.words import Said, plain_text, said


def said_name(name: str) -> Said:
    """Return the name of a body as a value of what is said: told where it is one of ours, made harmless where a file gave it.

    Parameters
    ----------
    name : str

    Examples
    --------
    >>> from seisblock.words import speaking, tell
    >>> with speaking("ja"):
    ...     tell("{name}", name=said_name("gravestone"))
    '墓石'
    """
    return said(plain_text(name))
