"""JSON document of ``seisblock overturn-rate``: rates of given motions, or the curve."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Annotated

from msgspec import Meta, Struct

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.edge_wear import DEFAULT_WEAR, EdgeWear
from seisblock.criteria.gravestones import GravestoneFit
from seisblock.measures import Conventions
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.records import Motion, Record
from seisblock.records._validation import vertical_acts
from seisblock.studies.survey.assessment import AssessmentMethod, CemeteryRate
from seisblock.studies.survey.overturning_rate import CurvePoint
from seisblock.studies.survey.stones import Contingency, StoneResult


class RateParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    cemetery : str
        File of the stones.
    stones, reinforced_stones, compared_with_reinforced_stones : int
        Number of stones, of those with dowels, and of those with dowels in the comparison.
    criterion : str
        ``furukawa``, ``rigid`` or ``simulate``.
    fit, fit_reinforced : GravestoneFit
        Parameters of eq. (8) without and with a dowel.
    inset : Inset or None
        Edge wear of the nominal stone, for criteria that use it.
    runs, seed : int or None
        Number of samples of each simulated stone, and their seed.
    stone_width_m : float
        Width of stones without a width in the file.
    gravity_m_s2 : float
    confidence : float
        Level of the interval of a rate.
    vertical : bool
        True if the vertical component acts on simulated stones.
    equivalent_frequency : str
        Definition of the frequency, or ``given``.
    velocity_highpass_hz, velocity_baseline : float or None, str
        Processing before PGV is computed.
    """

    cemetery: str
    stones: int
    reinforced_stones: int
    compared_with_reinforced_stones: int | None
    criterion: str
    fit: GravestoneFit
    fit_reinforced: GravestoneFit
    inset: EdgeWear | None
    runs: int | None
    seed: int | None
    stone_width_m: float
    gravity_m_s2: float
    confidence: float
    vertical: bool
    equivalent_frequency: str
    velocity_highpass_hz: float | None
    velocity_baseline: str


class CurveResult(Result, frozen=True, kw_only=True):
    """Rate against PGA without given motions."""

    curve: tuple[CurvePoint, ...]


CURVE_KEY = {"curve": Annotated[tuple[CurvePoint, ...], Meta(description="Rate against PGA at the requested frequencies.")]}
STONE_KEYS = {
    "each_stone": Annotated[
        tuple[StoneResult, ...], Meta(description="Outcome of each stone under both horizontals of the first record, or the first --pga.")
    ],
    "contingency": Annotated[Contingency | None, Meta(description="Numbers of surveyed stones by computed and observed outcome.")],
}
RATE_RESULT = entry_type("RateResult", CemeteryRate)
RATE = DocumentSchema("overturn-rate", RateParameters, RATE_RESULT, CURVE_KEY | STONE_KEYS, version=2)
CURVE_ALONE = DocumentSchema("overturn-rate", RateParameters, CurveResult, CURVE_KEY, name="curve", version=2)


def parameters_of(
    stones: Cemetery, dowelled: Cemetery | None, method: AssessmentMethod, *, motions: Iterable[Motion], frequency_kind: str
) -> RateParameters:
    """Return all parameters that determine the result."""
    rules = Conventions()
    return fill(
        RateParameters,
        rules,
        method,
        cemetery=stones.source,
        stones=stones.size,
        reinforced_stones=int(stones.reinforced.sum()),
        compared_with_reinforced_stones=None if dowelled is None else int(dowelled.reinforced.sum()),
        fit=method.fits[0],
        fit_reinforced=method.fits[1],
        inset=None if method.criterion == "furukawa" else method.inset or DEFAULT_WEAR,
        runs=method.runs if method.criterion == "simulate" else None,
        seed=method.seed if method.criterion == "simulate" else None,
        stone_width_m=method.width,
        vertical=vertical_acts(motions, method.vertical),
        equivalent_frequency=frequency_kind,
    )


def document(
    groups: Sequence[tuple[Record | None, Sequence[CemeteryRate]]],
    curve: Sequence[CurvePoint],
    parameters: RateParameters,
    *,
    citations: Sequence[str],
    warnings: Sequence[str],
) -> Document:
    """Return the document of rates, or of the curve without given motions."""
    points = tuple(curve)
    if not groups:
        return CURVE_ALONE.document(parameters, [(None, CurveResult(curve=points))], citations=citations, warnings=warnings, curve=points)
    entries = ((record, to_entry(RATE_RESULT, rate)) for record, rates in groups for rate in rates)
    record, rates = groups[0]
    first = rates[0] if record is None else rates[-1]
    return RATE.document(
        parameters,
        entries,
        citations=citations,
        warnings=warnings,
        curve=points,
        each_stone=first.each_stone,
        contingency=first.contingency,
    )
