"""What ``seisblock spectrum`` answers: blocks of all sizes, or all frictions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from seisblock.bodies.block import Restitution
from seisblock.bodies.inset import Inset
from seisblock.present.documents.kind import Document, Kind, Result
from seisblock.records import Motion
from seisblock.references import papers
from seisblock.studies.rocking.spectra import RockingSpectrum
from seisblock.studies.sliding import SlidePoint


class RockingParameters(Struct, frozen=True, kw_only=True):
    """What was chosen.

    Parameters
    ----------
    kind : str
        ``rocking`` or ``overturning``.
    gravity_m_s2 : float
    restitution : float, two of them, or None
        Ratio of angular velocities at an impact; null: from the angular momentum.
    linear, vertical : bool
        Whether the equation is linear, and whether the vertical component acts.
    inset : Inset
        How far the edges are worn.
    """

    kind: str
    gravity_m_s2: float
    restitution: Restitution
    linear: bool
    vertical: bool
    inset: Inset


class SlidingParameters(Struct, frozen=True, kw_only=True):
    """What was chosen.

    Parameters
    ----------
    kind : str
        ``sliding``.
    gravity_m_s2 : float
    vertical : bool
        Whether the vertical component acts.
    """

    kind: str
    gravity_m_s2: float
    vertical: bool


class RockingResult(Result, frozen=True, kw_only=True):
    """One direction: axes, and matrices with a row per size and a column per slenderness.

    Parameters
    ----------
    component : str
    size_m, frequency_parameter_rad_s : list of float
        2R, and p of the same blocks.
    slenderness_rad, height_over_width : list of float
        alpha, and H/B of the same blocks.
    max_rotation_ratio : matrix of float
        Largest lean over alpha.
    overturned : matrix of bool
    """

    component: str
    size_m: list[float]
    frequency_parameter_rad_s: list[float]
    slenderness_rad: list[float]
    height_over_width: list[float]
    max_rotation_ratio: list[list[float]]
    overturned: list[list[bool]]


class SlidingResult(Result, frozen=True, kw_only=True):
    """One direction.

    Parameters
    ----------
    component : str
    mu : list of float
    max_slip_m, residual_slip_m : list of float
        At each of these frictions; null where friction does not hold at rest.
    """

    component: str
    mu: list[float]
    max_slip_m: list[float | None]
    residual_slip_m: list[float | None]


ROCKING = Kind("spectrum", RockingParameters, RockingResult, name="rocking")
SLIDING = Kind("spectrum", SlidingParameters, SlidingResult, name="sliding")


def document(spectra: Sequence[tuple[Motion, RockingSpectrum]], kind: str, options: Mapping[str, Any], *, gravity: float) -> Document:
    """Return the document of rocking spectra, one per direction."""
    found = (
        (
            motion.record,
            RockingResult(
                component=motion.name,
                size_m=each.size_m.tolist(),
                frequency_parameter_rad_s=each.frequency_parameter_rad_s.tolist(),
                slenderness_rad=each.slenderness_rad.tolist(),
                height_over_width=(1 / np.tan(each.slenderness_rad)).tolist(),
                max_rotation_ratio=each.max_rotation_ratio.tolist(),
                overturned=each.overturned.tolist(),
            ),
        )
        for motion, each in spectra
    )
    return ROCKING.document(RockingParameters(kind=kind, gravity_m_s2=gravity, **options), found, citations=papers("rocking"))


def sliding_document(curves: Sequence[tuple[Motion, Sequence[SlidePoint]]], *, gravity: float, vertical: bool) -> Document:
    """Return the document of slips against friction, one curve per direction."""
    found = (
        (
            motion.record,
            SlidingResult(
                component=motion.name,
                mu=[point.mu for point in points],
                max_slip_m=[point.max_slip_m for point in points],
                residual_slip_m=[point.residual_slip_m for point in points],
            ),
        )
        for motion, points in curves
    )
    parameters = SlidingParameters(kind="sliding", gravity_m_s2=gravity, vertical=vertical)
    return SLIDING.document(parameters, found, citations=papers("sliding"))
