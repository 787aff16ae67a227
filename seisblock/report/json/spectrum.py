"""JSON documents of ``seisblock spectrum``: block sizes and slendernesses, or friction coefficients."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any

import numpy as np
from msgspec import UNSET, Meta, Struct, UnsetType

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.core.typing import FloatArray
from seisblock.models.rock.options import RockOptions
from seisblock.output.json.entries import parameters_type, to_parameters
from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.records import Motion
from seisblock.references import papers
from seisblock.studies.respond.mode_map import MODES_BY_SEVERITY, ModeMap
from seisblock.studies.rocking.spectrum import RockingSpectrum
from seisblock.studies.sliding import SlidePoint

ROCKING_PARAMETERS = parameters_type(
    "RockingParameters",
    RockOptions,
    exclude=("initial",),
    extra={
        "kind": Annotated[str, Meta(description="``rocking`` or ``overturning``.")],
        "inset": Annotated[EdgeWear, Meta(description="Edge wear.")],
    },
)


class SlidingParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

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
    """Result of one direction: axes, and matrices with a row per size and a column per slenderness.

    Parameters
    ----------
    component : str
    size_m, frequency_parameter_rad_s : list of float
        2R, and p of the same blocks.
    slenderness_rad, height_over_width : list of float
        alpha, and H/B of the same blocks.
    max_rotation_ratio : matrix of float
        Peak tilt over alpha.
    overturned : matrix of bool
    azimuths_deg : list of float
        With --component all-azimuths: directions; tilts are then maxima over them, and overturned means in any of them.
    overturning_rate : matrix of float
        Share of directions with overturning.
    worst_azimuth_deg : matrix of float
        Direction of the first overturning, or of the largest tilt.
    """

    component: str
    size_m: list[float]
    frequency_parameter_rad_s: list[float]
    slenderness_rad: list[float]
    height_over_width: list[float]
    max_rotation_ratio: list[list[float]]
    overturned: list[list[bool]]
    azimuths_deg: list[float] | UnsetType = UNSET
    overturning_rate: list[list[float]] | UnsetType = UNSET
    worst_azimuth_deg: list[list[float]] | UnsetType = UNSET


class SlidingResult(Result, frozen=True, kw_only=True):
    """Result of one direction.

    Parameters
    ----------
    component : str
    mu : list of float
    max_slip_m, residual_slip_m : list of float
        At each friction; null if friction does not hold the object at rest.
    """

    component: str
    mu: list[float]
    max_slip_m: list[float | None]
    residual_slip_m: list[float | None]


class ModesParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    kind : str
        ``modes``.
    gravity_m_s2 : float
    restitution : float
        Poisson's, of an impact at one corner.
    vertical : bool
        Whether the vertical component acts.
    inset : Inset
        Edge wear.
    """

    kind: str
    gravity_m_s2: float
    restitution: float
    vertical: bool
    inset: EdgeWear


class InitiationEntry(Struct, frozen=True, kw_only=True):
    """Closed-form limits of the motion that begins from rest.

    Parameters
    ----------
    acceleration_ratio : float or None
        Largest horizontal acceleration over the weight per unit mass, abs(a)/(g + a_y); a block rests throughout if neither mu nor b/h
        is below it; null if the downward ground acceleration exceeds gravity.
    time_s : float
        Time of this maximum.
    friction_to_rock : list of float or None
        Friction that the corner of each row's block needs if that comes as a jump: with less it slides while it rocks, or slides; null
        for a block that does not rock.
    """

    acceleration_ratio: float | None
    time_s: float
    friction_to_rock: list[float | None]


class ModesResult(Result, frozen=True, kw_only=True):
    """Result of one direction: axes, and matrices with a row per block and a column per friction.

    Parameters
    ----------
    component : str
    mu : list of float
        Static and kinetic.
    size_m, b_over_h : list of float
        2R, and half of the base that is left over the height of the centre of gravity, of each row's block.
    mode : matrix of str
        Most severe mode: rest, slide, rock, slide-rock, flight, overturned.
    max_rotation_ratio : matrix of float
        Peak tilt over alpha.
    slip_path_m, final_displacement_m : matrix of float
        Slip path length, and signed residual displacement.
    initiation : InitiationEntry
    """

    component: str
    mu: list[float]
    size_m: list[float]
    b_over_h: list[float]
    mode: list[list[str]]
    max_rotation_ratio: list[list[float]]
    slip_path_m: list[list[float]]
    final_displacement_m: list[list[float]]
    initiation: InitiationEntry


ROCKING = DocumentSchema("spectrum", ROCKING_PARAMETERS, RockingResult, name="rocking")
SLIDING = DocumentSchema("spectrum", SlidingParameters, SlidingResult, name="sliding")
MODES = DocumentSchema("spectrum", ModesParameters, ModesResult, name="modes")


def document(spectra: Sequence[tuple[Motion, RockingSpectrum]], kind: str, options: RockOptions, inset: EdgeWear) -> Document:
    """Return the document of rocking spectra, one per direction."""
    entries = (
        (
            motion.record,
            fill(
                RockingResult,
                spectrum,
                component=motion.name,
                height_over_width=(1 / np.tan(spectrum.slenderness_rad)).tolist(),
                azimuths_deg=_to_list(spectrum.azimuths_deg),
                overturning_rate=_to_list(spectrum.overturning_rate),
                worst_azimuth_deg=_to_list(spectrum.worst_azimuth_deg),
            ),
        )
        for motion, spectrum in spectra
    )
    return ROCKING.document(to_parameters(ROCKING_PARAMETERS, options, kind=kind, inset=inset), entries, citations=papers("rocking"))


def _to_list(values: FloatArray | None) -> Any:
    return UNSET if values is None else values.tolist()


def sliding_document(curves: Sequence[tuple[Motion, Sequence[SlidePoint]]], *, gravity: float, vertical: bool) -> Document:
    """Return the document of sliding spectra, one per direction."""
    entries = (
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
    return SLIDING.document(parameters, entries, citations=papers("sliding"))


def modes_document(
    maps: Sequence[tuple[Motion, ModeMap]], *, gravity: float, restitution: float, inset: EdgeWear, vertical: bool
) -> Document:
    """Return the document of mode maps, one per direction."""
    entries = (
        (
            motion.record,
            fill(
                ModesResult,
                mode_map,
                component=motion.name,
                mode=[[MODES_BY_SEVERITY[index] for index in row] for row in mode_map.governing],
                initiation=InitiationEntry(
                    acceleration_ratio=mode_map.loading if math.isfinite(mode_map.loading) else None,
                    time_s=mode_map.loading_time_s,
                    friction_to_rock=[None if math.isnan(value) else value for value in mode_map.friction_to_rock.tolist()],
                ),
            ),
        )
        for motion, mode_map in maps
    )
    parameters = ModesParameters(kind="modes", gravity_m_s2=gravity, restitution=restitution, vertical=vertical, inset=inset)
    return MODES.document(parameters, entries, citations=papers("all modes"))
