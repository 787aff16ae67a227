"""Two-layer rigid block: a light lower layer below a heavy upper layer."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.toml import (
    check_keys,
    check_kind,
    get_length,
    get_lengths,
    get_masses,
    get_number,
    get_subtable,
    get_text,
    read_body_toml,
)
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.options import option
from seisblock.core.units import STANDARD_GRAVITY, warn_large_lengths

_POSITIVE_FIELDS = {
    "width": (lazy_gettext("width"), "m"),
    "depth": (lazy_gettext("depth"), "m"),
    "upper_height": (lazy_gettext("upper height"), "m"),
    "lower_height": (lazy_gettext("lower height"), "m"),
    "upper_mass": (lazy_gettext("upper mass"), "kg"),
    "lower_mass": (lazy_gettext("lower mass"), "kg"),
}
_CONTACT_KEYS = ("mu", "mu_kinetic", "restitution_x", "restitution_y")


@dataclass(frozen=True, repr=False)
class TwoLayerBlock(DisplayMixin):
    """Two homogeneous layers of one width, rigidly joined ([Sugimoto2017]_ section 3.1, fig. 5).

    Parameters
    ----------
    width, depth : float, m
        B along the motion and W across it.
    upper_height, lower_height : float, m
        h1 and h2.
    upper_mass, lower_mass : float, kg
        m1 and m2.
    name : str
    side : str or None
        ``short`` or ``long``, the side along the motion of a body with both; None for a body with one width.

    Raises
    ------
    BodyError
        If a size or mass is not positive.

    Warns
    -----
    UserWarning
        If a length exceeds 20 m, which was probably meant in cm or mm.
    """

    width: float
    depth: float
    upper_height: float
    lower_height: float
    upper_mass: float
    lower_mass: float
    name: str = N_("two-layer block")
    side: str | None = None

    def __post_init__(self) -> None:
        for key, (label, unit) in _POSITIVE_FIELDS.items():
            checks.positive("{name}: {what}", getattr(self, key), unit, error=BodyError, name=self.name, what=label)
        warn_large_lengths(self.name, width=self.width, depth=self.depth, upper_height=self.upper_height, lower_height=self.lower_height)

    @property
    def height(self) -> float:
        """H = h1 + h2, m ([Sugimoto2017]_ fig. 5)."""
        return self.upper_height + self.lower_height

    @property
    def mass(self) -> float:
        """Mass m = m1 + m2, kg ([Sugimoto2017]_ eq. (3b))."""
        return self.upper_mass + self.lower_mass

    @property
    def centroid_height(self) -> float:
        """y_G, m ([Sugimoto2017]_ eq. (1b))."""
        upper = self.upper_mass * (2 * self.height - self.upper_height)
        return (upper + self.lower_mass * self.lower_height) / (2 * self.mass)

    @property
    def radius(self) -> float:
        """R, from a lower corner to the centroid, m ([Sugimoto2017]_ eq. (3c))."""
        return math.hypot(self.width / 2, self.centroid_height)

    @property
    def slenderness(self) -> float:
        """Angle alpha between the block's side and R, rad ([Sugimoto2017]_ eq. (3d))."""
        return math.atan2(self.width / 2, self.centroid_height)

    @property
    def corner_inertia(self) -> float:
        """I_O about a lower corner, kg m^2 ([Sugimoto2017]_ eq. (3e))."""
        upper_radius = math.hypot(self.width, 2 * self.height - self.upper_height) / 2
        lower_radius = math.hypot(self.width, self.lower_height) / 2
        half_diagonal = math.hypot(self.width, self.upper_height) / 2
        return self.upper_mass * (half_diagonal**2 / 3 + upper_radius**2) + 4 / 3 * self.lower_mass * lower_radius**2

    @property
    def centroid_inertia(self) -> float:
        """I_G about the centroid, kg m^2 ([Sugimoto2017]_ eq. (7b))."""
        return self.corner_inertia - self.mass * self.radius**2

    @property
    def width_moment(self) -> float:
        """Second moment of mass along the width about the centroid, m B^2/12, kg m^2 (derived here)."""
        return self.mass * self.width**2 / 12

    @property
    def height_moment(self) -> float:
        """Second moment of mass along the height about the centroid, sum m_i (h_i^2/12 + (y_i - y_G)^2), kg m^2 (derived here)."""
        y = self.centroid_height
        upper = self.upper_height**2 / 12 + (self.height - self.upper_height / 2 - y) ** 2
        lower = self.lower_height**2 / 12 + (self.lower_height / 2 - y) ** 2
        return self.upper_mass * upper + self.lower_mass * lower

    def as_block(self) -> Block:
        """Return the block as one homogeneous rigid block with the same base, mass, centre and inertia."""
        return Block(
            self.width,
            self.height,
            self.depth,
            self.mass,
            centroid_height=self.centroid_height,
            centroid_inertia=self.centroid_inertia,
            name=self.name,
        )

    def rocking_threshold(self, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the ground acceleration at which rocking starts, g x_G/y_G, m/s^2 ([Sugimoto2017]_ eq. (2))."""
        return gravity * (self.width / 2) / self.centroid_height


@dataclass(frozen=True, repr=False)
class Contact(DisplayMixin):
    """Friction and restitution between a block and the ground.

    Parameters
    ----------
    mu : float
        Coefficient of static friction, zero or more.
    mu_kinetic : float or None
        Coefficient of kinetic friction, 0 to `mu`; default `mu`.
    restitution_x, restitution_y : float
        Ratios of velocities at the impact, horizontal and vertical, 0 to 1 ([Sugimoto2017]_ eq. (6)); defaults from [Sugimoto2017]_
        section 4, impacts of a plastic on steel.

    Raises
    ------
    ParameterError
        If a coefficient lies outside its range.

    Examples
    --------
    >>> Contact(mu=0.18).kinetic
    0.18
    """

    mu: float = field(
        metadata=option(
            N_("Static friction coefficient of the foot that landed. [default: value of the body, else required]"),
            "--mu",
            unit="1",
            kind="friction",
            section="Body",
        )
    )
    mu_kinetic: float | None = field(
        default=None,
        metadata=option(
            N_("Kinetic friction coefficient. [default: value of the body, else as --mu]"),
            "--mu-kinetic",
            unit="1",
            kind="friction",
            section="Body",
            document=float,
        ),
    )
    restitution_x: float = field(
        default=0.95,
        metadata=option(
            N_("Ratio of horizontal velocities at the impact, 0 to 1. [default: value of the body, else 0.95]"),
            "--restitution-x",
            unit="1",
            section="Body",
        ),
    )
    restitution_y: float = field(
        default=0.85,
        metadata=option(
            N_("Ratio of vertical velocities at the impact, 0 to 1. [default: value of the body, else 0.85]"),
            "--restitution-y",
            unit="1",
            section="Body",
        ),
    )

    def __post_init__(self) -> None:
        checks.non_negative("the static friction coefficient `mu`", self.mu)
        checks.non_negative("the kinetic friction coefficient", self.kinetic)
        checks.fraction("restitution x", self.restitution_x)
        checks.fraction("restitution y", self.restitution_y)
        if self.kinetic > self.mu:
            raise ParameterError(
                "kinetic friction {kinetic:g} must not exceed static friction {static:g}", kinetic=self.kinetic, static=self.mu
            )

    @property
    def kinetic(self) -> float:
        """Kinetic friction coefficient, given or the static one."""
        return self.mu if self.mu_kinetic is None else self.mu_kinetic


def two_layer_from_table(table: Mapping[str, Any], side: str = "short") -> TwoLayerBlock:
    """Return the block described by a TOML table, moving along one of its sides.

    Parameters
    ----------
    table : mapping
        ``kind = "two-layer"``, ``heights`` = [h1, h2], ``masses`` = [m1, m2], and either ``width`` and ``depth`` or
        ``short`` and ``long``, the two sides in plan.
    side : "short" or "long"
        Side along the motion, for a table with both.

    Raises
    ------
    BodyError
        If an entry is missing or of the wrong type.
    """
    check_kind(table, "two-layer")
    upper_height, lower_height = get_lengths(table, "heights", 2)
    upper_mass, lower_mass = get_masses(table, "masses", 2)
    name = get_text(table, "name", str(table.get("source", "two-layer block")))
    if "width" in table:
        width, depth = get_length(table, "width"), get_length(table, "depth")
        return TwoLayerBlock(width, depth, upper_height, lower_height, upper_mass, lower_mass, name)
    if side not in ("short", "long"):
        raise BodyError("{name}: side must be short or long, found {side!r}", name=name, side=side)
    width = get_length(table, side)
    depth = get_length(table, "long" if side == "short" else "short")
    name = (
        lazy_gettext("{name}, short side", name=lazy_gettext(name))
        if side == "short"
        else lazy_gettext("{name}, long side", name=lazy_gettext(name))
    )
    return TwoLayerBlock(width, depth, upper_height, lower_height, upper_mass, lower_mass, name, side)


def contact_from_table(table: Mapping[str, Any]) -> Mapping[str, float]:
    """Return friction and restitution of a preset, empty if it has none."""
    values = get_subtable(table, "contact")
    check_keys(values, _CONTACT_KEYS)
    return {key: value for key in _CONTACT_KEYS if (value := get_number(values, key)) is not None}


def base_from_table(table: Mapping[str, Any]) -> dict[str, float]:
    """Return height of the base above the ground and length of the tenons, m, of a preset (``drop``, ``tenon``), as far as it has them."""
    return {key: get_length(table, key) for key in ("drop", "tenon") if key in table}


def load_two_layer(name: str | Path, *, side: str = "short") -> TwoLayerBlock:
    """Return the two-layer block of a TOML file or a bundled one such as ``chozusha``.

    Parameters
    ----------
    name : str or Path
        ``kind = "two-layer"``, see :func:`two_layer_from_table`.
    side : "short" or "long"
        Side along the motion, for a file with both.

    Returns
    -------
    TwoLayerBlock

    Raises
    ------
    BodyError
        If there is no such body, an entry is missing, or the kind is another.

    Examples
    --------
    >>> load_two_layer("chozusha", side="long").width
    2.5
    """
    return two_layer_from_table(read_body_toml(name), side)


def load_contact(name: str | Path) -> Contact:
    """Return friction and restitution of a two-layer block in a TOML file or a bundled body.

    Parameters
    ----------
    name : str or Path
        TOML file or bundled name, with a table ``contact`` of ``mu`` and the other parameters of :class:`Contact`.

    Returns
    -------
    Contact

    Raises
    ------
    BodyError
        If there is no such body, or it has no friction.

    Examples
    --------
    >>> load_contact("chozusha").mu
    0.18
    """
    table = read_body_toml(name)
    values = contact_from_table(table)
    if "mu" not in values:
        raise BodyError("friction required: {name} defines none; use Contact(mu=...)", name=table.get("name", name))
    return Contact(**values)
