"""JSON document of ``seisblock criteria``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from msgspec import Meta, Struct

from seisblock.criteria.compare import CriterionResult, count_agreeing
from seisblock.measures.frequency import EquivalentFrequency
from seisblock.measures.shaking import BodyShaking
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.outcome import RockOutcome
from seisblock.output.json.bodies import BlockEntry, block_entry
from seisblock.output.json.entries import entry_type, parameters_type, to_entry, to_parameters
from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.references import find_citations, papers
from seisblock.report.json.peaks import peak_schema
from seisblock.studies.criteria_comparison import CriteriaComparison
from seisblock.studies.model_comparison import ModelComparison

CRITERIA_PARAMETERS = parameters_type(
    "CriteriaParameters",
    RockOptions,
    exclude=("initial",),
    extra={
        "block": BlockEntry,
        "velocity_highpass_hz": Annotated[float | None, Meta(description="Filter behind the PGV.")],
    },
)
AGREEMENT_KEY = Annotated[ModelComparison | None, Meta(description="Results of other models of the same block.")]
SIMULATED: Any = entry_type("Simulated", RockOutcome, extra={"agreement": AGREEMENT_KEY})


class RespondEntry(Struct, frozen=True, kw_only=True):
    """Full response of the body as in ``seisblock respond``.

    Parameters
    ----------
    mu : float
    friction_known : bool
        False if unknown; non-sliding feet are then assumed.
    outcome : str
        As text.
    overturned : bool
    overturned_towards : str or None
        ``+x`` or ``-x``.
    overturning_time_s : float or None
    max_rotation_ratio : float
        Peak tilt over alpha.
    slip_path_m, final_displacement_m : float
        Slip path length, and signed residual displacement.
    criteria_agree : bool
        Whether more than half of the criteria, each counted once, agree on overturning.
    """

    mu: float
    friction_known: bool
    outcome: str
    overturned: bool
    overturned_towards: str | None
    overturning_time_s: float | None
    max_rotation_ratio: float
    slip_path_m: float
    final_displacement_m: float
    criteria_agree: bool


def _respond_entry(card: CriteriaComparison) -> RespondEntry | None:
    if card.governing is None:
        return None
    response = card.governing.response
    right, count = count_agreeing(card.rows, response.outcome.overturned)
    return fill(RespondEntry, response.outcome, card.governing, response.options, criteria_agree=2 * right > count)


class CriteriaResult(Result, frozen=True, kw_only=True):
    """Result of one direction.

    Parameters
    ----------
    component : str
        Direction of the record that is +x.
    pga_m_s2, pgv_m_s : float
    equivalent_frequency_hz : EquivalentFrequency
    criteria : list of Row
        Threshold and demand in the unit of the row.
    simulated : Simulated
        Result as in ``seisblock rock``.
    respond : RespondEntry or None
        Result as in ``seisblock respond``.
    shaking : BodyShaking
        Shaking of the motion, and the time above the rocking threshold of the block.
    """

    component: str
    pga_m_s2: float
    pgv_m_s: float
    equivalent_frequency_hz: EquivalentFrequency
    criteria: tuple[CriterionResult, ...]
    simulated: SIMULATED
    respond: RespondEntry | None
    shaking: BodyShaking


CRITERIA = DocumentSchema("criteria", CRITERIA_PARAMETERS, CriteriaResult)
CRITERIA_PEAKS = peak_schema("criteria")


def document(cards: Sequence[CriteriaComparison], options: RockOptions) -> Document:
    """Return the document of the criteria comparisons of each direction."""
    first = cards[0]
    parameters = to_parameters(
        CRITERIA_PARAMETERS, options, block=block_entry(first.block), velocity_highpass_hz=first.velocity_highpass_hz
    )
    entries = (
        (
            card.record,
            fill(
                CriteriaResult,
                card,
                card.measures,
                criteria=card.rows,
                simulated=to_entry(SIMULATED, card.outcome, agreement=card.agreement),
                respond=_respond_entry(card),
            ),
        )
        for card in cards
    )
    cited = [*find_citations(row.where for card in cards for row in card.rows), *papers("rocking", "all modes")]
    return CRITERIA.document(parameters, entries, citations=cited, warnings=[text for card in cards for text in card.warnings])
