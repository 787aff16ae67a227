"""What ``seisblock criteria`` answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, Struct

from seisblock.bodies.block import Restitution
from seisblock.criteria.card import Row
from seisblock.measures.frequency import EquivalentFrequency
from seisblock.present.documents.bodies import BlockEntry, block_entry
from seisblock.present.documents.entry import entry_of, entry_type
from seisblock.present.documents.kind import Document, Kind, Result
from seisblock.references import cited_in, papers
from seisblock.solvers.rock.outcome import RockOutcome
from seisblock.studies.agreement import Agreement
from seisblock.studies.criteria_card import Card


class CriteriaParameters(Struct, frozen=True, kw_only=True):
    """What was chosen.

    Parameters
    ----------
    restitution : float, two of them, or None
        Ratio of angular velocities at an impact, onto the right and onto the left corner; null: from the angular momentum.
    linear, vertical : bool
        Whether the equation is linear, and whether the vertical component acts.
    gravity_m_s2 : float
    block : BlockEntry
    velocity_highpass_hz : float or None
        Filter behind the PGV.
    """

    restitution: Restitution
    linear: bool
    vertical: bool
    gravity_m_s2: float
    block: BlockEntry
    velocity_highpass_hz: float | None


AGREEMENT = Annotated[Agreement | None, Meta(description="What other models of the same block say.")]
Simulated: Any = entry_type("Simulated", RockOutcome, beside={"agreement": AGREEMENT})


class CriteriaResult(Result, frozen=True, kw_only=True):
    """One direction.

    Parameters
    ----------
    component : str
        Direction of the record that is +x.
    pga_m_s2, pgv_m_s : float
    equivalent_frequency_hz : EquivalentFrequency
    criteria : list of Row
        Threshold and demand are in the unit that the row names.
    simulated : Simulated
        What ``seisblock rock`` answers.
    """

    component: str
    pga_m_s2: float
    pgv_m_s: float
    equivalent_frequency_hz: EquivalentFrequency
    criteria: tuple[Row, ...]
    simulated: Simulated


CRITERIA = Kind("criteria", CriteriaParameters, CriteriaResult)


def document(cards: Sequence[Card], options: Mapping[str, Any], *, gravity: float) -> Document:
    """Return the document of one card per direction."""
    first = cards[0]
    parameters = CriteriaParameters(
        **options, gravity_m_s2=gravity, block=block_entry(first.block), velocity_highpass_hz=first.velocity_highpass_hz
    )
    found = (
        (
            card.record,
            CriteriaResult(
                component=card.component,
                pga_m_s2=card.measures.pga_m_s2,
                pgv_m_s=card.measures.pgv_m_s,
                equivalent_frequency_hz=card.measures.equivalent_frequency_hz,
                criteria=card.rows,
                simulated=entry_of(Simulated, card.outcome, agreement=card.agreement),
            ),
        )
        for card in cards
    )
    cited = [*cited_in(row.where for card in cards for row in card.rows), *papers("rocking")]
    return CRITERIA.document(parameters, found, citations=cited, warnings=[text for card in cards for text in card.warnings])
