"""JSON document of ``seisblock uplift --harmonic``; that of a record has the keys of the model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from msgspec import Struct

from seisblock.models.uplift.minima import UpliftMinimum
from seisblock.output.json.bodies import SpringBlockEntry, spring_block_entry
from seisblock.output.json.schema import Document, DocumentSchema, Result
from seisblock.output.json.solver import plain_schema
from seisblock.references import papers
from seisblock.studies.uplift_regions import UpliftRegion

RATIO_KEYS = {"alpha": "alpha", "gamma": "gamma", "beta": "beta", "damping": "damping", "phi": "phi_deg", "rho": "rho_deg"}
"""Keys of the parameters that may vary under harmonic motion."""


ScalarOrTuple = float | tuple[float, ...]


class HarmonicParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command; a list for each varied one.

    Parameters
    ----------
    alpha, gamma, beta, damping : float
        H/b, a/b, horizontal over vertical frequency, damping ratio of each mode.
    phi_deg, rho_deg : float
        Azimuth of the shaking from x towards y, and its angle from the vertical.
    corner : int or None
        Selected corner; null: the first to lift.
    block : SpringBlockEntry or None
        Null where several were combined.
    """

    alpha: ScalarOrTuple
    gamma: ScalarOrTuple
    beta: ScalarOrTuple
    damping: ScalarOrTuple
    phi_deg: ScalarOrTuple
    rho_deg: ScalarOrTuple
    corner: int | None
    block: SpringBlockEntry | None


class ModeEntry(Struct, frozen=True, kw_only=True):
    """One natural mode.

    Parameters
    ----------
    name : str
    frequency_hz, frequency_ratio, over_omega_v : float
        Its frequency, over that of the first rocking mode, and over the vertical one.
    """

    name: str
    frequency_hz: float
    frequency_ratio: float
    over_omega_v: float


class CurvePointEntry(Struct, frozen=True, kw_only=True):
    """One point of the uplift curve.

    Parameters
    ----------
    frequency_ratio : float
        theta/omega_1.
    acceleration_ratio : float or None
        Smallest A/g with uplift; null if there is none.
    """

    frequency_ratio: float
    acceleration_ratio: float | None


class HarmonicResult(Result, frozen=True, kw_only=True):
    """Result of one combination of parameters.

    Parameters
    ----------
    alpha, gamma, beta, damping, phi_deg, rho_deg : float
        As in the parameters.
    natural_frequencies_hz : six floats
    modes : list of ModeEntry
    minimum : UpliftMinimum
        The least A/g of all.
    minima : list of UpliftMinimum
    curve : list of CurvePointEntry
    """

    alpha: float
    gamma: float
    beta: float
    damping: float
    phi_deg: float
    rho_deg: float
    natural_frequencies_hz: tuple[float, ...]
    modes: tuple[ModeEntry, ...]
    minimum: UpliftMinimum
    minima: tuple[UpliftMinimum, ...]
    curve: tuple[CurvePointEntry, ...]


UPLIFT = plain_schema("uplift")
HARMONIC = DocumentSchema("uplift", HarmonicParameters, HarmonicResult, name="harmonic")


def harmonic_document(regions: Sequence[UpliftRegion]) -> Document:
    """Return the document of harmonic motion, one result per combination of parameters."""
    ratios = {key: tuple(sorted({region.ratios[name] for region in regions})) for name, key in RATIO_KEYS.items()}
    parameters = HarmonicParameters(
        **{key: values if len(values) > 1 else values[0] for key, values in ratios.items()},
        corner=regions[0].corner,
        block=spring_block_entry(regions[0].body) if len(regions) == 1 else None,
    )
    return HARMONIC.document(parameters, ((None, _harmonic_result(region)) for region in regions), citations=papers("uplift"))


def _harmonic_result(region: UpliftRegion) -> HarmonicResult:
    modes, vertical = region.modes, region.body.omega[2]
    ratios: dict[str, Any] = {key: region.ratios[name] for name, key in RATIO_KEYS.items()}
    return HarmonicResult(
        **ratios,
        natural_frequencies_hz=modes.frequencies_hz,
        modes=tuple(
            ModeEntry(name=name, frequency_hz=w / (2.0 * math.pi), frequency_ratio=w / modes.omega_1, over_omega_v=w / vertical)
            for name, w in zip(modes.names, modes.omega.tolist(), strict=True)
        ),
        minimum=region.minimum,
        minima=region.minima,
        curve=tuple(
            CurvePointEntry(frequency_ratio=r, acceleration_ratio=a)
            for r, a in zip(region.frequency_ratio.tolist(), region.acceleration_ratio.tolist(), strict=True)
        ),
    )
