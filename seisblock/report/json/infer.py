"""JSON documents of ``seisblock infer``: ground motion from stones, or scale factors from a displacement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any

from msgspec import Meta, Struct

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.records import Record
from seisblock.references import papers
from seisblock.report.json.bodies import TwoLayerEntry, two_layer_entry
from seisblock.report.json.entries import entry_type, to_entry
from seisblock.report.json.schema import Document, DocumentSchema
from seisblock.studies.survey.estimate import ShakingEstimate
from seisblock.studies.survey.joint import JointEstimate
from seisblock.studies.survey.scale_search import ScaleFactors


class StonesParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    cemetery : str
        File of the stones.
    stones, unknown_stones : int
        Number of stones, and of those with unknown outcome.
    rate : str or None
        Number fallen and total, if given as counts.
    confidence : float
        Level of the intervals.
    common_error_ln_pga, stone_error_ln_pga : float
        Standard deviations in ln PGA, of a cemetery and of each stone.
    bias_ln_pga, frequency_error_ln_f : float
        Bias of the PGA relative to the criterion; standard deviation of a given frequency.
    criterion, prior, intensity : str
        Criterion, prior and intensity relation of the estimate.
    inset : Inset or None
        Edge wear, for criteria that use it.
    """

    cemetery: str
    stones: int
    rate: str | None
    unknown_stones: int
    confidence: float
    common_error_ln_pga: float
    stone_error_ln_pga: float
    bias_ln_pga: float
    frequency_error_ln_f: float
    criterion: str
    inset: EdgeWear | None
    prior: str = "flat in ln PGA, and in ln f over 0.5 to 3 Hz where no frequency is given"
    intensity: str = "2.68 + 1.72 log10 PGV (kine), standard deviation 0.21"


class SlidParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    observed_m : float
        Observed slip.
    object : str
        ``slid``.
    largest : bool
        Whether the maximum rather than the residual slip is compared.
    mu, mu_kinetic : float
        Static and kinetic friction; null: one friction.
    vertical : bool
        Whether the vertical component acts.
    gravity_m_s2 : float
    limit, steps : float, int
        Largest factor, and steps of the scan up to it.
    """

    observed_m: float
    object: str = "slid"
    largest: bool
    mu: float
    mu_kinetic: float | None
    vertical: bool
    gravity_m_s2: float
    limit: float
    steps: int


Windows = tuple[tuple[float | None, float | None], ...]


class JumpedParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    observed_m : float
        Observed displacement of the block.
    object : str
        ``jumped``.
    block : TwoLayerEntry
    contact : Contact
    flight_only, first : bool
        Whether only the flight, and only the first chain of motion, is compared.
    windows_s : list of pairs
        Time windows of the start of a chain; empty: the entire record.
    drop_m : float
        Height of the floor above the ground.
    spin, landing : str
        Rules of the impact and of the landing.
    gravity_m_s2 : float
    limit, steps : float, int
        Largest factor, and steps of the scan up to it.
    """

    observed_m: float
    object: str = "jumped"
    block: TwoLayerEntry
    contact: Contact
    flight_only: bool
    first: bool
    windows_s: Windows
    drop_m: float
    spin: str
    landing: str
    gravity_m_s2: float
    limit: float
    steps: int


@dataclass(frozen=True)
class ScanPoint:
    """Displacement at one scale factor."""

    scale: float
    displacement_m: float


CONTOUR_KEYS = {
    "contour": Annotated[list[ShakingEstimate], Meta(description="Estimates by frequency.")],
    "joint": Annotated[list[JointEstimate], Meta(description="Joint estimates of several cemeteries by frequency; empty for one.")],
}
STONES_RESULT = entry_type("StonesResult", ShakingEstimate)
STONES = DocumentSchema("infer", StonesParameters, STONES_RESULT, CONTOUR_KEYS, name="stones", version=2)

SCAN_KEYS = {"curve": Annotated[tuple[ScanPoint, ...], Meta(description="Displacement against scale factor.")]}
FACTORS_RESULT = entry_type("FactorsResult", ScaleFactors, exclude=("curve",), extra=SCAN_KEYS)
SLID = DocumentSchema("infer", SlidParameters, FACTORS_RESULT, name="slid", version=2)
JUMPED = DocumentSchema("infer", JumpedParameters, FACTORS_RESULT, name="jumped", version=2)

RecordFactors = Sequence[tuple[Record | None, ScaleFactors]]


def stones_document(
    estimates: Sequence[ShakingEstimate],
    contour: Sequence[ShakingEstimate],
    parameters: StonesParameters,
    warnings: Sequence[str],
    joint: Sequence[JointEstimate] = (),
) -> Document:
    """Return the document of the ground motion inferred from stones."""
    entries = ((None, to_entry(STONES_RESULT, estimate)) for estimate in estimates)
    stones = "gravestones as blocks" if parameters.criterion == "rigid" else "gravestones as fitted"
    citations = papers(stones, "intensity of a velocity")
    return STONES.document(parameters, entries, citations=citations, warnings=warnings, contour=list(contour), joint=list(joint))


def slid_document(factors: RecordFactors, **options: Any) -> Document:
    """Return the document of the scale factors that reproduce a slip; `options` are the parameters."""
    return SLID.document(SlidParameters(**options), _factor_entries(factors), citations=papers("sliding"))


def jumped_document(factors: RecordFactors, block: TwoLayerBlock, contact: Contact, **options: Any) -> Document:
    """Return the document of the scale factors that reproduce a jump; `options` are the other parameters."""
    parameters = JumpedParameters(**options, block=two_layer_entry(block), contact=contact)
    return JUMPED.document(parameters, _factor_entries(factors), citations=papers("jump"))


def _factor_entries(factors: RecordFactors) -> Any:
    return (
        (record, to_entry(FACTORS_RESULT, factor, curve=tuple(ScanPoint(s, d) for s, d in zip(*factor.curve, strict=True))))
        for record, factor in factors
    )
