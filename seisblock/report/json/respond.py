"""JSON document of ``seisblock respond``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, Struct, UnsetType

from seisblock.bodies.block import Block
from seisblock.core.results import Response
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.report.json.bodies import BlockEntry, block_entry
from seisblock.report.json.entries import COMPONENT_KEY, entry_type, to_outcome_entry
from seisblock.report.json.schema import Document, DocumentSchema
from seisblock.studies.respond.azimuths import RespondAzimuth
from seisblock.studies.respond.probability import Probability


class RespondParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

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
        Position and tilt at the first sample, and their rates; null: upright, at rest.
    settle_s : float
        Simulated time after the record.
    tenon_m : float
        Depth of the tenons of the feet; 0 without.
    further_points_m : list of pairs
        Further contact points of the body that end the motion at ground contact.
    block : BlockEntry
        Block of the first result.
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
    leading=COMPONENT_KEY,
    extra={
        "block": Annotated[BlockEntry, Meta(description="Equivalent block of a scan in this direction.")] | UnsetType,
        "probability": Annotated[Probability, Meta(description="Overturning probability; absent with --runs 0.")] | UnsetType,
        "directions": Annotated[list[RespondAzimuth], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
    },
)
RESPOND = DocumentSchema("respond", RespondParameters, RESPOND_RESULT)


def document(responses: Sequence[Response[RespondOutcome]], block: Block, extras: Sequence[Mapping[str, Any]]) -> Document:
    """Return the document of one run per direction, with probability and azimuth sweep."""
    return RESPOND.document(
        RespondParameters(**{**responses[0].options, "vertical": bool(responses[0].options["vertical"])}, block=block_entry(block)),
        (to_outcome_entry(RESPOND_RESULT, response, **extra) for response, extra in zip(responses, extras, strict=True)),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
    )
