"""Units of document keys by their suffix."""

from __future__ import annotations

UNITS = {
    "_years": "years",
    "_per_s2": "1/s^2",
    "_per_s": "1/s",
    "_rad_s": "rad/s",
    "_m_s2": "m/s^2",
    "_m_s": "m/s",
    "_n_m3": "N/m^3",
    "_n_m": "N/m",
    "_kg_m3": "kg/m^3",
    "_kg_m2": "kg m^2",
    "_m3": "m^3",
    "_m2": "m^2",
    "_kg": "kg",
    "_rad": "rad",
    "_deg": "deg",
    "_hz": "Hz",
    "_pa": "Pa",
    "_mm": "mm",
    "_km": "km",
    "_m": "m",
    "_n": "N",
    "_j": "J",
    "_s": "s",
}
"""Key suffixes, longer before shorter, and their units."""


def split_unit(key: str) -> tuple[str, str]:
    """Return a key without its unit suffix, and the unit; empty without one.

    Examples
    --------
    >>> split_unit("pga_m_s2"), split_unit("pga_interval_m_s2"), split_unit("rate")
    (('pga', 'm/s^2'), ('pga_interval', 'm/s^2'), ('rate', ''))
    """
    for ending, unit in UNITS.items():
        if key.endswith(ending):
            return key.removesuffix(ending), unit
    return key, ""
