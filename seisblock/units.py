"""Units: factors to SI, and quantities read from text."""

from seisblock.core.units import (
    ACCELERATION_UNITS,
    BU,
    GAL,
    KINE,
    LENGTH_UNITS,
    MASS_UNITS,
    SHAKU,
    STANDARD_GRAVITY,
    SUN,
    VELOCITY_UNITS,
    acceleration_unit,
    parse_acceleration,
    parse_length,
    parse_mass,
    unit_suffix,
)

__all__ = [
    "ACCELERATION_UNITS",
    "BU",
    "GAL",
    "KINE",
    "LENGTH_UNITS",
    "MASS_UNITS",
    "SHAKU",
    "STANDARD_GRAVITY",
    "SUN",
    "VELOCITY_UNITS",
    "acceleration_unit",
    "parse_acceleration",
    "parse_length",
    "parse_mass",
    "unit_suffix",
]
