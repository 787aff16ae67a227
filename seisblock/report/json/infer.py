"""JSON documents of ``seisblock infer``: ground motion from stones, or scale factors from a displacement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Annotated, Any

from msgspec import Meta, Struct

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.output.json.bodies import TwoLayerEntry, two_layer_entry
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema
from seisblock.records import Record
from seisblock.references import papers
from seisblock.studies.survey.estimate import ShakingEstimate
from seisblock.studies.survey.joint import JointEstimate
from seisblock.studies.survey.scale_search import ScaleFactors
from seisblock.studies.survey.stones import Contingency, StoneResult, count_agreement
from seisblock.studies.survey.twist import FactorInterval, TwistEstimate

INTENSITY_OF_STONES = "6.97 - 2 log10(H/B) of the stones that fall, standard deviation 0.2"
INTENSITY_OF_VELOCITY = "2.68 + 1.72 log10 PGV (kine), standard deviation 0.21"
"""Relations of the JMA intensity: surveyors' rule, and the one of criterion rigid."""


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
    intensity: str = INTENSITY_OF_STONES


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


class TwistParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    object : str
        ``twist``.
    body : object
        Body; SI.
    twist_deg : float
        Observed residual twist.
    displacement_m : float or None
        Observed residual displacement.
    mu, vertical, gravity_m_s2
        Friction, whether the vertical component acts, gravity.
    limit : float
        Largest factor.
    confidence : float
        Probability of the intervals.
    seed : int
    prior : str
    """

    object: str = "twist"
    body: dict[str, Any]
    twist_deg: float
    displacement_m: float | None
    mu: float
    vertical: bool
    gravity_m_s2: float
    limit: float
    confidence: float
    seed: int
    prior: str = "flat in ln of the factor"


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
STONE_KEYS = {
    "each_stone": Annotated[
        list[StoneResult], Meta(description="Outcome of each stone of all cemeteries at the estimated shaking, for the first frequency.")
    ],
    "contingency": Annotated[Contingency | None, Meta(description="Numbers of marked stones by computed and observed outcome.")],
}
RESULT_KEYS = {
    "each_stone": Annotated[tuple[StoneResult, ...], Meta(description="Outcome of each stone of the group at the estimated shaking.")],
    "contingency": STONE_KEYS["contingency"],
}
STONES_RESULT = entry_type("StonesResult", ShakingEstimate, extra=RESULT_KEYS)
STONES = DocumentSchema("infer", StonesParameters, STONES_RESULT, CONTOUR_KEYS | STONE_KEYS, name="stones", version=2)

SCAN_KEYS = {"curve": Annotated[tuple[ScanPoint, ...], Meta(description="Displacement against scale factor.")]}
FACTORS_RESULT = entry_type("FactorsResult", ScaleFactors, exclude=("curve",), extra=SCAN_KEYS)
SLID = DocumentSchema("infer", SlidParameters, FACTORS_RESULT, name="slid", version=2)
JUMPED = DocumentSchema("infer", JumpedParameters, FACTORS_RESULT, name="jumped", version=2)

TWIST_RESULT = entry_type("TwistResult", TwistEstimate)
TWIST = DocumentSchema(
    "infer",
    TwistParameters,
    TWIST_RESULT,
    {"station_pga_m_s2": Annotated[FactorInterval | None, Meta(description="PGA from several candidate records; null for one.")]},
    name="twist",
)

RecordFactors = Sequence[tuple[Record | None, ScaleFactors]]


def stones_document(
    answers: Sequence[tuple[ShakingEstimate, tuple[StoneResult, ...]]],
    contour: Sequence[ShakingEstimate],
    parameters: StonesParameters,
    warnings: Sequence[str],
    joint: Sequence[JointEstimate] = (),
    at_places: Sequence[tuple[str, tuple[StoneResult, ...]]] = (),
) -> Document:
    """Return the document of the ground motion inferred from stones.

    Parameters
    ----------
    answers : sequence of (ShakingEstimate, stones)
    contour, parameters, warnings, joint
        Keys of the document.
    at_places : sequence of (place, stones)
        Outcome of each stone; the stones of several places have the place in their id.
    """
    stones_of_places = [
        stone if len(at_places) == 1 else replace(stone, id=f"{place} {stone.id}") for place, stones in at_places for stone in stones
    ]
    entries = (
        (None, to_entry(STONES_RESULT, estimate, each_stone=stones, contingency=count_agreement(stones))) for estimate, stones in answers
    )
    topic = "gravestones as blocks" if parameters.criterion == "rigid" else "gravestones as fitted"
    intensity = ("intensity of a velocity",) if parameters.criterion == "rigid" else ()
    return STONES.document(
        parameters,
        entries,
        citations=papers(topic, *intensity),
        warnings=warnings,
        contour=list(contour),
        joint=list(joint),
        each_stone=stones_of_places,
        contingency=count_agreement(stones_of_places),
    )


def slid_document(factors: RecordFactors, **options: Any) -> Document:
    """Return the document of the scale factors that reproduce a slip; `options` are the parameters."""
    return SLID.document(SlidParameters(**options), _factor_entries(factors), citations=papers("sliding"))


def jumped_document(factors: RecordFactors, block: TwoLayerBlock, contact: Contact, **options: Any) -> Document:
    """Return the document of the scale factors that reproduce a jump; `options` are the other parameters."""
    parameters = JumpedParameters(**options, block=two_layer_entry(block), contact=contact)
    return JUMPED.document(parameters, _factor_entries(factors), citations=papers("jump"))


def twist_document(
    results: Sequence[tuple[Record | None, TwistEstimate]], station: FactorInterval | None, *, body: Any, **options: Any
) -> Document:
    """Return the document of the factors that explain a twist; `options` are the other parameters."""
    parameters = TwistParameters(body=asdict(body), **options)
    entries = ((record, to_entry(TWIST_RESULT, estimate)) for record, estimate in results)
    return TWIST.document(parameters, entries, citations=papers("rigid body in space"), station_pga_m_s2=station)


def _factor_entries(factors: RecordFactors) -> Any:
    return (
        (record, to_entry(FACTORS_RESULT, factor, curve=tuple(ScanPoint(s, d) for s, d in zip(*factor.curve, strict=True))))
        for record, factor in factors
    )
