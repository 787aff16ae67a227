"""What one record did to what might have stood at its station, in the worst of all directions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.library import along
from seisblock.bodies.scan.body import ScannedBody
from seisblock.errors import ParameterError
from seisblock.measures.baseline import ground_history
from seisblock.measures.frequency import pga_pgv_frequency
from seisblock.records import Record, motion_of
from seisblock.records.given import Factor
from seisblock.records.process import towards
from seisblock.references import papers
from seisblock.studies.azimuths import STEP_DEG
from seisblock.studies.cemetery.judgement import Method, overturned
from seisblock.studies.cemetery.rate import rate_of
from seisblock.studies.cemetery.shaking import Shaking
from seisblock.studies.standing.azimuths import respond_directions
from seisblock.studies.standing.probability import MOVED_M, respond_probability


@dataclass(frozen=True)
class StationEffect:
    """What happened at a station; a body has no rate, a cemetery only that.

    Parameters
    ----------
    azimuth_deg : float or None
        The worst direction, clockwise from north.
    rate : float or None
        Share of the stones that fall.
    overturned : bool or None
    probability : float or None
        Share of the plausible versions of body and shaking that fall; None where it was not asked for.
    max_slip_m : float or None
        Furthest displacement of the body from where it stood.
    """

    azimuth_deg: float | None = None
    rate: float | None = None
    overturned: bool | None = None
    probability: float | None = None
    max_slip_m: float | None = None

    @property
    def severity(self) -> tuple[float, ...]:
        """What sorts stations, the larger the worse: the share that falls, the verdict, the displacement."""
        share = self.rate if self.probability is None else self.probability
        return (-1.0 if share is None else share, float(self.overturned or False), self.max_slip_m or 0.0)


class WhatStands(Protocol):
    """What is asked of each station: its effect, its name, and the papers behind it."""

    @property
    def name(self) -> str:
        """What stands there."""

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the papers relied on."""

    def under(self, record: Record) -> StationEffect:
        """Return what a record does to it."""


@dataclass(frozen=True)
class StandingBody:
    """A free-standing body, followed by ``respond`` in every direction; the worst is followed once more in plausible versions.

    Parameters
    ----------
    body : Block or ScannedBody
    options : mapping
        ``mu``, ``mu_kinetic``, ``restitution``, ``rocking_restitution``, ``tenon``, ``gravity``, ``settle_s`` of ``solve_respond``.
    vertical : bool, float or None, 1
        Whether the vertical motion acts; None: where a record has it.
    runs, seed : int
        Versions behind the probability, 0 for none, and their seed.
    step_deg : float
        Degrees between directions.
    """

    body: Block | ScannedBody
    options: Mapping[str, Any]
    vertical: Factor | None = None
    runs: int = 0
    seed: int = 0
    step_deg: float = STEP_DEG

    @property
    def name(self) -> str:
        """What stands there."""
        return self.body.name

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the papers relied on."""
        return papers("all modes")

    def under(self, record: Record) -> StationEffect:
        """Return what a record does to the body in the worst direction."""
        worst = respond_directions(self.body, record, vertical=self.vertical, step_deg=self.step_deg, **self.options)[0]
        share = None
        if self.runs:
            motion = motion_of(record, f"{worst.azimuth_deg:g}")
            block = along(self.body, motion)
            assert isinstance(block, Block)
            share = respond_probability(
                block, motion, vertical=self.vertical, runs=self.runs, seed=self.seed, moved_m=MOVED_M, **self.options
            ).overturned
        return StationEffect(worst.azimuth_deg, None, worst.overturned, share, worst.max_displacement_m)


@dataclass(frozen=True)
class StandingStones:
    """A cemetery, judged by PGA and equivalent frequency in every direction.

    Parameters
    ----------
    cemetery : Cemetery
    method : Method
        How a stone is judged; by a criterion that needs no motion.
    step_deg : float
        Degrees between directions.
    """

    cemetery: Cemetery
    method: Method = field(default_factory=Method)
    step_deg: float = STEP_DEG

    def __post_init__(self) -> None:
        if self.method.criterion == "simulate":
            raise ParameterError("stations are judged by a criterion, furukawa or rigid: leave the simulation out")

    @property
    def name(self) -> str:
        """What stands there."""
        return self.cemetery.name

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the papers relied on."""
        return self.method.citations

    def under(self, record: Record) -> StationEffect:
        """Return which share falls in the direction in which most do; of equal shares, that of the larger PGA."""
        rows = [towards(record, azimuth).acceleration for azimuth in (0.0, 90.0)]
        north, east = (ground_history(row, record.dt) for row in rows)
        worst = (-1.0, 0.0, 0.0)
        for azimuth in np.arange(0.0, 180.0, self.step_deg).tolist():
            cosine, sine = np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))
            pga = float(np.abs(cosine * rows[0] + sine * rows[1]).max())
            pgv = float(np.abs(cosine * north.velocity + sine * east.velocity).max())
            frequency = pga_pgv_frequency(pga, pgv)
            if frequency is not None and pga > 0.0:
                falls = overturned(self.cemetery, Shaking(pga, frequency), self.method)
                worst = max(worst, (rate_of(falls).rate, pga, azimuth))
        return StationEffect(worst[2] if worst[0] >= 0.0 else None, max(worst[0], 0.0))
