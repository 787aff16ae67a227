"""Exceptions of the package: one tree; each class is also the built-in exception that a caller would catch."""

from seisblock.core.errors import (
    BodyError,
    ComponentError,
    HazardError,
    InputError,
    KindError,
    OutputError,
    ParameterError,
    RecordError,
    RecordFormatError,
    RecordNotFoundError,
    SeisblockError,
    SolverError,
    UnitError,
)

__all__ = [
    "BodyError",
    "ComponentError",
    "HazardError",
    "InputError",
    "KindError",
    "OutputError",
    "ParameterError",
    "RecordError",
    "RecordFormatError",
    "RecordNotFoundError",
    "SeisblockError",
    "SolverError",
    "UnitError",
]
