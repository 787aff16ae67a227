"""Exception hierarchy; each class also derives from the matching built-in exception."""

from __future__ import annotations

from typing import Any

from seisblock.core.i18n import N_, Message, lazy_gettext, truncate


class SeisblockError(Exception):
    """Base class of all errors raised by seisblock.

    Parameters
    ----------
    message : str
        Template with named fields, or a :class:`~seisblock.core.i18n.Message`. It states the fault, the place, the expected and the
        actual value, and the remedy.
    values : any
        Values of the fields; a :class:`~seisblock.core.i18n.Message` among them is translated, too.
    """

    exit_code = 3

    def __init__(self, message: str, /, **values: Any) -> None:
        self.message = message if isinstance(message, Message) and not values else lazy_gettext(message, **values)
        super().__init__(truncate(self.message))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle with the template, so that the message can be translated in another process."""
        return type(self), (self.message,)


class InputError(SeisblockError, ValueError):
    """Invalid input."""


class ParameterError(InputError):
    """Parameter outside the range of validity of a model."""


class KindError(ParameterError, TypeError):
    """Value of the wrong type."""


class UnitError(InputError):
    """Unknown or missing unit."""


class RecordError(InputError):
    """Record that cannot be read or lacks the requested data."""


class RecordNotFoundError(RecordError, FileNotFoundError):
    """Neither a file nor a bundled sample of that name exists."""


class RecordFormatError(RecordError):
    """File whose content violates its format."""


class ComponentError(RecordError, LookupError):
    """Component, station or level missing from a record."""


class BodyError(InputError):
    """Incomplete or contradictory description of a body."""


class HazardError(InputError):
    """Incomplete or contradictory hazard curve."""


class OutputError(SeisblockError, OSError):
    """Output file that cannot be written."""


class SolverError(SeisblockError, ArithmeticError):
    """Solver that stopped without a valid result."""

    exit_code = 4


SYSTEM_MESSAGES = (
    N_("File name too long"),
    N_("Input/output error"),
    N_("Is a directory"),
    N_("No space left on device"),
    N_("No such file or directory"),
    N_("Not a directory"),
    N_("Permission denied"),
    N_("Read-only file system"),
)
"""Most common operating system messages on file access, marked for translation."""


def os_error_text(error: OSError) -> Message:
    """Return the reason of an operating system error as a translatable message, without the file name.

    Parameters
    ----------
    error : OSError
    """
    # an OutputError is an OSError, too: keep its own translatable message
    return error.message if isinstance(error, OutputError) else lazy_gettext(error.strerror or str(error))
