"""Friction coefficients of pairs of surfaces, with sources."""

from __future__ import annotations

from dataclasses import dataclass

from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, gettext


@dataclass(frozen=True)
class Surface:
    """Friction of a pair of surfaces.

    Parameters
    ----------
    mu, mu_kinetic : float
        Static and kinetic coefficient.
    source : str
        Citation with its locator.
    note : str
        Measured quantity and assumptions.
    """

    mu: float
    mu_kinetic: float
    source: str
    note: str = ""


SURFACES = {
    "granite/granite": Surface(0.438, 0.438, "[Furukawa2009]_ table 2", N_("kinetic value of gravestones; static value taken as equal")),
    "wood/stone": Surface(0.18, 0.17, "[Sugimoto2017]_ section 4.1", N_("ABS resin on steel, used in the paper for posts on stone")),
    "rubber/concrete": Surface(1.0, 0.7, "[Urone2022]_ table 5.1", N_("dry")),
    "wood/wood": Surface(0.5, 0.3, "[Urone2022]_ table 5.1"),
    "metal/wood": Surface(0.5, 0.3, "[Urone2022]_ table 5.1"),
    "steel/steel": Surface(0.6, 0.3, "[Urone2022]_ table 5.1", N_("dry")),
    "teflon/steel": Surface(0.04, 0.04, "[Urone2022]_ table 5.1"),
}
"""Friction by pair, in either order; measured values scatter by a third, which probabilities include."""

MATERIALS = (N_("granite"), N_("wood"), N_("stone"), N_("rubber"), N_("concrete"), N_("metal"), N_("steel"), N_("teflon"))
"""Materials of the pairs, for translation."""


def pair_name(pair: str) -> str:
    """Return a pair of surfaces in the language of the locale."""
    return "/".join(map(gettext, pair.split("/")))


def surface(pair: str) -> Surface:
    """Return the friction of a pair such as ``granite/granite``, in either order.

    Raises
    ------
    ParameterError
        If the pair is not in the table; the message lists the known pairs.

    Examples
    --------
    >>> surface("stone/wood").mu
    0.18
    """
    parts = [part.strip().lower() for part in pair.split("/")]
    for name in ("/".join(parts), "/".join(reversed(parts))):
        if name in SURFACES:
            return SURFACES[name]
    raise ParameterError(
        "no friction coefficient for the pair {pair!r}; available: {known}; or give the coefficient", pair=pair, known=list(SURFACES)
    )
