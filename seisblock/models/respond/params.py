"""Validated inputs of full-response runs: rigid body, contact parameters and initial state, of one run and of batches."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import BlockArray
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core._display import DisplayMixin
from seisblock.core.arrays import as_readonly
from seisblock.core.checks import fraction, in_interval, non_negative
from seisblock.core.checks import gravity as check_gravity
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.i18n import N_
from seisblock.core.typing import FloatArray
from seisblock.dynamics import Model
from seisblock.models.respond import constants
from seisblock.models.respond.constants import (
    GAP_LEFT,
    GAP_RIGHT,
    NO_MODE,
    OMEGA,
    RATE_LEFT,
    RATE_RIGHT,
    SPEED,
    START,
    STATES,
    TENON_OFFSET,
    THETA,
    X,
)
from seisblock.models.respond.model import model_with_points
from seisblock.records import Motion
from seisblock.records._validation import Gain, vertical_gain

MAX_IMPACTS, MAX_IMPACTS_PER_SECOND = 500_000, 20_000.0
"""Limit of impacts, and its increase per second of motion, above which a run is abandoned as endless bouncing.

Each return to rest takes tens to hundreds of decreasing rebounds; strong shaking causes up to 10 000 impacts per second at a
restitution of 0.3 to 0.9."""

SMALL_RATE = 1e-12
"""v_z over sqrt(g R): rebound velocity at which bouncing ends."""

FLAT_SHARE = 100.0
"""The same for both corners together in a run that sets bodies flat, over SMALL_RATE."""

JAM_WARNING_RATIO = 0.999
"""Ratio of kinetic friction to Painleve's limit from which the cone guard is active."""

CONTACT_TOLERANCE = 1e-12
"""Gap over R below which a corner of the initial state is in contact; rate over sqrt(g R) below which its rate is zero."""

Body = Block | TwoLayerBlock
Initial = Sequence[float] | None


@dataclass(frozen=True)
class RigidBody:
    """Free-standing rigid body in the plane of the motion.

    Parameters
    ----------
    right, left : float, m
        Horizontal distances b2 and b1 from the right and the left lower corner to the centre of gravity.
    height : float, m
        Height h of the centre of gravity above the base.
    gyration_squared : float, m^2
        Squared radius of gyration about the centre of gravity.
    mass : float, kg
    name : str
    """

    right: float
    left: float
    height: float
    gyration_squared: float
    mass: float
    name: str

    def __post_init__(self) -> None:
        if not (self.right > 0.0 and self.left > 0.0):
            raise BodyError(
                "{name}: the centre of gravity must lie above the base: horizontal distances {left:g} m from the left corner and "
                "{right:g} m from the right corner must both be positive",
                name=self.name,
                left=self.left,
                right=self.right,
            )

    @property
    def radii(self) -> tuple[float, float]:
        """Distances from the right and the left corner to the centre of gravity, m."""
        return math.hypot(self.right, self.height), math.hypot(self.left, self.height)

    @property
    def slendernesses(self) -> tuple[float, float]:
        """Overturning angles alpha about the right and the left corner, rad."""
        return math.atan2(self.right, self.height), math.atan2(self.left, self.height)

    @property
    def friction_limit(self) -> float:
        """Painleve's limit of kinetic friction: the minimum 2 sqrt(kappa (1 + kappa)), kappa = k^2/R^2 (derived here)."""
        # the corner with the longer radius has the smaller kappa and reaches the limit first
        largest = max(self.radii)
        kappa = self.gyration_squared / (largest * largest)
        return 2.0 * math.sqrt(kappa * (1.0 + kappa))


def rigid_body(body: Body) -> RigidBody:
    """Return a block, or a two-layer block as one rigid body, in the form of the model ([Sugimoto2017]_ eqs. (1), (3), (7b))."""
    if isinstance(body, TwoLayerBlock):
        half = body.width / 2
        return RigidBody(half, half, body.centroid_height, body.centroid_inertia / body.mass, body.mass, body.name)
    right, left = body.arms
    return RigidBody(right, left, body.centre, body.gyration_squared, body.total_mass, body.name)


@dataclass(frozen=True, repr=False)
class RespondParams(DisplayMixin):
    """Parameters of a run apart from the ground motion.

    Parameters
    ----------
    rigid_body : RigidBody
    mu, mu_kinetic : float, 1
        Static and kinetic friction coefficient; kinetic friction acts inside impacts.
    restitution : float, 1
        Poisson's coefficient of restitution of an impact at one corner.
    rocking_restitution : float or None
        Ratio of angular velocities in a rocking impact; None: impact law.
    gravity : float, m/s^2
    tenon : float, m
        Engagement depth of the tenons under the feet; 0: no tenons.
    further_points : tuple of (float, float), m
        Points of the body, to +x of the centre of gravity and above it, that end the motion on contact with the ground.
    rocking_share : float
        Ratio of angular velocities in a rocking impact over Housner's ratio, used without `rocking_restitution`; 1: impact law.
    sets_flat : bool
        True in the repetition of a run whose impacts do not end: FLAT_SHARE acts.
    """

    rigid_body: RigidBody
    mu: float
    mu_kinetic: float
    restitution: float = 0.0
    rocking_restitution: float | None = None
    gravity: float = 9.80665
    tenon: float = 0.0
    further_points: tuple[tuple[float, float], ...] = ()
    rocking_share: float = 1.0
    sets_flat: bool = False

    def __post_init__(self) -> None:
        non_negative(N_("the friction coefficient mu"), self.mu)
        non_negative(N_("the kinetic friction coefficient"), self.mu_kinetic)
        if self.mu_kinetic > self.mu:
            raise ParameterError("`mu_kinetic` must not exceed `mu`, found {found:g} above {mu:g}", found=self.mu_kinetic, mu=self.mu)
        in_interval(N_("`restitution`"), self.restitution, "[0, 1)")
        if self.rocking_restitution is not None:
            fraction(N_("`rocking_restitution` (ratio of angular velocities)"), self.rocking_restitution)
        in_interval(N_("`rocking_share` (ratio to Housner's restitution)"), self.rocking_share, "(0, 1]")
        check_gravity(self.gravity)
        non_negative(N_("`tenon` (length)"), self.tenon, "m")
        for point in self.further_points:
            if len(point) != 2 or not all(math.isfinite(value) for value in point):
                raise ParameterError(
                    "each entry of `further_points` must be two lengths in m (to +x of the centre of gravity, above it), found {found}",
                    found=str(point),
                )
            if not point[1] > -self.rigid_body.height:
                raise ParameterError(
                    "each entry of `further_points` must lie above the base, which is {height:g} m below the centre of gravity, "
                    "found {found}",
                    height=self.rigid_body.height,
                    found=str(point),
                )

    @property
    def small_rate(self) -> float:
        """Rebound velocity v_z below which bouncing ends, m/s."""
        return SMALL_RATE * math.sqrt(self.gravity * max(self.rigid_body.radii))

    @property
    def can_jam(self) -> bool:
        """True where kinetic friction reaches Painleve's limit ([GenotBrogliato1999]_)."""
        return self.mu_kinetic >= self.rigid_body.friction_limit

    @property
    def model(self) -> Model:
        """Engine model with one guard per further point."""
        return model_with_points(len(self.further_points))

    @property
    def first_mode(self) -> int:
        """Mode at the first sample."""
        return START + TENON_OFFSET if self.tenon > 0.0 else START

    @cached_property
    def _constants(self) -> FloatArray:
        """Parameter vector without what depends on the motion: runs that only differ in it share this."""
        body = self.rigid_body
        # a negative value encodes a share of Housner's ratio, see ``constants``: one parameter serves both laws
        ratio = NO_MODE * self.rocking_share if self.rocking_restitution is None else self.rocking_restitution
        row = [
            self.gravity, 0.0, self.mu, self.mu_kinetic, self.restitution, ratio, body.right, body.left, body.height, body.gyration_squared,
            self.tenon, float(self.mu_kinetic >= JAM_WARNING_RATIO * body.friction_limit), 0.0, self.small_rate,
            FLAT_SHARE * self.small_rate if self.sets_flat else 0.0,
            0.0,
        ]  # fmt: skip
        return as_readonly(row + [value for point in self.further_points for value in point])

    def parameters(self, dt: float, *, duration_s: float = 0.0, ground_at_rest: bool = False) -> FloatArray:
        """Return the parameter vector of the model, (16 + 2 n_points,), for a run of `duration_s` seconds."""
        row = self._constants.copy()
        row[constants.DT], row[constants.GROUND_AT_REST] = dt, ground_at_rest
        row[constants.MAX_IMPACTS] = MAX_IMPACTS + MAX_IMPACTS_PER_SECOND * duration_s
        return row

    def state(self, initial: Initial) -> FloatArray:
        """Return the initial state, (15,): upright and at rest, or from `initial` (x, y, theta and their rates)."""
        y = np.zeros(len(STATES))
        if initial is None:
            return y
        if len(initial) != 6 or not all(math.isfinite(value) for value in initial):
            raise ParameterError(
                "`initial` must be six finite numbers (x_G, y_G, theta and their rates), found {found}", found=str(tuple(initial))
            )
        x, height, theta, x_rate, rise, omega = (float(value) for value in initial)
        if not abs(theta) < math.pi / 2:
            raise ParameterError("the initial tilt must lie between -pi/2 and pi/2 rad, found {found:g} rad", found=theta)
        y[X], y[THETA], y[SPEED], y[OMEGA] = x, theta, x_rate, omega
        size = max(self.rigid_body.radii)
        rate_tolerance = CONTACT_TOLERANCE * math.sqrt(self.gravity * size)
        for xi, gap_row, rate_row in ((-self.rigid_body.left, GAP_LEFT, RATE_LEFT), (self.rigid_body.right, GAP_RIGHT, RATE_RIGHT)):
            rx = xi * math.cos(theta) - self.rigid_body.height * math.sin(theta)
            gap = height - xi * math.sin(theta) - self.rigid_body.height * math.cos(theta)
            rate = rise - rx * omega
            if gap < -CONTACT_TOLERANCE * size:
                raise ParameterError(
                    "{name}: a lower corner of the initial state lies {depth:.3g} m below the ground",
                    name=self.rigid_body.name,
                    depth=-gap,
                )
            # exact zeros decide the first mode: round-off of the given state must not turn contact into a flight of 1e-17 m
            y[gap_row] = gap if gap > CONTACT_TOLERANCE * size else 0.0
            y[rate_row] = rate if abs(rate) > rate_tolerance + CONTACT_TOLERANCE * (abs(rise) + abs(rx * omega)) else 0.0
        for point_x, point_y in self.further_points:
            if height - point_x * math.sin(theta) + point_y * math.cos(theta) <= 0.0:
                raise ParameterError("{name}: a further point of the initial state lies below the ground", name=self.rigid_body.name)
        return y


@dataclass(frozen=True, eq=False)
class RespondBatchParams:
    """Parameters of m runs; each row equals a :class:`~seisblock.models.respond.params.RespondParams` bit by bit.

    Parameters
    ----------
    blocks : BlockArray
    mu, mu_kinetic, restitution : (m,) arrays, 1
    rocking : (m,) array, 1
        With `rocking_given` the ratio of angular velocities in a rocking impact, else the share of Housner's ratio, at most 1.
    rocking_given : bool
        True where `rocking` replaces the impact law.
    gravity, tenon : float, m/s^2; float, m
        Common to all rows.

    Raises
    ------
    ParameterError
        If a number lies outside its range.
    """

    blocks: BlockArray
    mu: FloatArray
    mu_kinetic: FloatArray
    restitution: FloatArray
    rocking: FloatArray
    rocking_given: bool
    gravity: float
    tenon: float

    def __post_init__(self) -> None:
        is_valid = (self.mu < np.inf) & (self.mu_kinetic >= 0.0) & (self.mu_kinetic <= self.mu)
        is_valid &= (self.restitution >= 0.0) & (self.restitution < 1.0)
        is_valid &= (self.rocking >= 0.0) & (self.rocking <= 1.0)
        # argmin is the first invalid row, or row 0: its RespondParams raises the message for it and for the common values
        self.row_params(int(np.argmin(is_valid)))

    def __len__(self) -> int:
        return len(self.blocks)

    def __getitem__(self, index: slice) -> RespondBatchParams:
        """Return a slice of the rows."""
        return replace(
            self,
            blocks=self.blocks[index],
            mu=self.mu[index],
            mu_kinetic=self.mu_kinetic[index],
            restitution=self.restitution[index],
            rocking=self.rocking[index],
        )

    def row_params(self, row: int) -> RespondParams:
        """Return the parameters of one row, with unit mass and an empty name."""
        right, left, height, gyration = (float(column[row]) for column in self.blocks.columns)
        rocking = float(self.rocking[row])
        return RespondParams(
            RigidBody(right, left, height, gyration, 1.0, ""),
            float(self.mu[row]),
            float(self.mu_kinetic[row]),
            float(self.restitution[row]),
            rocking if self.rocking_given else None,
            self.gravity,
            self.tenon,
            rocking_share=1.0 if self.rocking_given else rocking,
        )

    def parameters(self, dt: float, *, duration_s: float = 0.0, ground_at_rest: bool = False) -> FloatArray:
        """Return the parameter vectors of the model, (m, 16)."""
        table = np.tile(self.row_params(0).parameters(dt, duration_s=duration_s, ground_at_rest=ground_at_rest), (len(self), 1))
        largest = self.blocks.radii.max(axis=1)
        kappa = self.blocks.gyration_squared / (largest * largest)
        limit = 2.0 * np.sqrt(kappa * (1.0 + kappa))
        table[:, constants.MU : constants.RESTITUTION + 1] = np.column_stack([self.mu, self.mu_kinetic, self.restitution])
        table[:, constants.ROCKING_RESTITUTION] = self.rocking if self.rocking_given else -self.rocking
        table[:, constants.ARM_RIGHT : constants.GYRATION + 1] = np.column_stack(self.blocks.columns)
        table[:, constants.NEAR_JAM] = self.mu_kinetic >= JAM_WARNING_RATIO * limit
        table[:, constants.SMALL_RATE] = SMALL_RATE * np.sqrt(self.gravity * largest)
        return table

    def states(self, initial: Initial) -> FloatArray:
        """Return the initial states, (1 or m, 15): upright and at rest, or from `initial` for all rows."""
        return np.array([self.row_params(row).state(initial) for row in range(1 if initial is None else len(self))])


def motion_gains(motion: Motion, vertical: Gain | None) -> tuple[float, float, float]:
    """Return the gains of the motion's three rows; `vertical` None: vertical motion acts if the record has any."""
    return 1.0, 0.0, vertical_gain(motion, vertical)
