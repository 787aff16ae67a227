"""What can go wrong, one tree; each class is also the builtin a naive caller would catch."""

from __future__ import annotations

from typing import Any

from seisblock.core.i18n import N_, Message, lazy_gettext, truncate


class SeisblockError(Exception):
    """Root of every error that seisblock raises on purpose.

    Parameters
    ----------
    message : str
        What, where, expected, found and the remedy: a template with a field for each value, or a text that was said.
    values : any
        Of the template's fields; another error's ``said`` among them is told along with it.
    """

    exit_code = 3

    def __init__(self, message: str, /, **values: Any) -> None:
        self.message = message if isinstance(message, Message) and not values else lazy_gettext(message, **values)
        super().__init__(truncate(self.message))

    def __reduce__(self) -> tuple[Any, ...]:
        """Travel to another process with what was said."""
        return type(self), (self.message,)


class InputError(SeisblockError, ValueError):
    """Something the user gave cannot be used."""


class ParameterError(InputError):
    """A number or an option lies outside what the model admits."""


class KindError(ParameterError, TypeError):
    """A value is of another kind than the call takes."""


class UnitError(InputError):
    """A unit is unknown, or a number that needs one came without."""


class RecordError(InputError):
    """A record cannot be read or does not hold what is asked of it."""


class RecordNotFoundError(RecordError, FileNotFoundError):
    """No file, and no bundled sample, of that name."""


class RecordFormatError(RecordError):
    """The file is there, but it is not what its format promises."""


class ComponentError(RecordError, LookupError):
    """The record has no such component, station or level."""


class BodyError(InputError):
    """The description of a body is incomplete or contradicts itself."""


class HazardError(InputError):
    """A hazard curve is incomplete or contradicts itself."""


class OutputError(SeisblockError, OSError):
    """An output file cannot be written."""


class SolverError(SeisblockError, ArithmeticError):
    """A solver gave up: the answer would not be one."""

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
"""What systems say most when they refuse a file."""


def os_error_text(error: OSError) -> Message:
    """Return why the system refused, without the file's name, so that it can be told.

    Parameters
    ----------
    error : OSError
    """
    return lazy_gettext(error.strerror or str(error))
