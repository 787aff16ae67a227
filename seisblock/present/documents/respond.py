"""What ``seisblock respond`` answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, Struct, UnsetType

from seisblock.bodies.block import Block
from seisblock.present.documents.bodies import BlockEntry, block_entry
from seisblock.present.documents.entry import COMPONENT, entry_type, outcome_of
from seisblock.present.documents.kind import Document, Kind
from seisblock.results import Response
from seisblock.solvers.respond.outcome import RespondOutcome
from seisblock.studies.standing.azimuths import AzimuthFate
from seisblock.studies.standing.probability import Probability


class RespondParameters(Struct, frozen=True, kw_only=True):
    """What was chosen.

    Parameters
    ----------
    mu, mu_kinetic : float
        Static and kinetic friction.
    restitution : float
        Poisson's, of an impact at one corner.
    rocking_restitution : float or None
        Ratio of angular velocities when the other corner comes down; null: from the impact itself.
    vertical : bool
        Whether the vertical component acts.
    gravity_m_s2 : float
    initial : six floats or None
        Place and lean at the first sample, and their rates; null: upright, at rest.
    settle_s : float
        How long it is followed after the record.
    tenon_m : float
        Depth of tenons that hold the feet; 0 without.
    further_points_m : list of pairs
        Points of the body that end the motion when they meet the ground.
    block : BlockEntry
        That of the first result.
    """

    mu: float
    mu_kinetic: float
    restitution: float
    rocking_restitution: float | None
    vertical: bool
    gravity_m_s2: float
    initial: list[float] | None
    settle_s: float
    tenon_m: float
    further_points_m: list[list[float]]
    block: BlockEntry


RESPOND_RESULT = entry_type(
    "RespondResult",
    RespondOutcome,
    before=COMPONENT,
    beside={
        "block": Annotated[BlockEntry, Meta(description="Of a scan: the block that it is in this direction.")] | UnsetType,
        "probability": Annotated[Probability, Meta(description="Share of plausible versions that fall; left out with --runs 0.")]
        | UnsetType,
        "directions": Annotated[list[AzimuthFate], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
    },
)
RESPOND = Kind("respond", RespondParameters, RESPOND_RESULT)


def document(responses: Sequence[Response[RespondOutcome]], block: Block, extras: Sequence[Mapping[str, Any]]) -> Document:
    """Return the document of one run per direction, with its probability and the directions that were looked in."""
    return RESPOND.document(
        RespondParameters(**{**responses[0].options, "vertical": bool(responses[0].options["vertical"])}, block=block_entry(block)),
        (outcome_of(RESPOND_RESULT, response, **extra) for response, extra in zip(responses, extras, strict=True)),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
    )
