"""JSON document of ``seisblock respond``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, UnsetType

from seisblock.bodies.block import Block
from seisblock.core.results import Response
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.report.json.bodies import BlockEntry, block_entry
from seisblock.report.json.entries import outcome_type, parameters_type, to_outcome_entry, to_parameters
from seisblock.report.json.schema import Document, DocumentSchema
from seisblock.studies.respond.azimuths import RespondAzimuth
from seisblock.studies.respond.probability import Probability

RESPOND_PARAMETERS = parameters_type(
    "RespondParameters",
    RespondOptions,
    exclude=("sensitivity",),
    extra={"block": Annotated[BlockEntry, Meta(description="Block of the first result.")]},
)
RESPOND_RESULT = outcome_type(
    "RespondResult",
    RespondOutcome,
    extra={
        "block": Annotated[BlockEntry, Meta(description="Equivalent block of a scan in this direction.")] | UnsetType,
        "probability": Annotated[Probability, Meta(description="Overturning probability; absent with --runs 0.")] | UnsetType,
        "directions": Annotated[list[RespondAzimuth], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
    },
)
RESPOND = DocumentSchema("respond", RESPOND_PARAMETERS, RESPOND_RESULT)


def document(responses: Sequence[Response[RespondOutcome]], block: Block, extras: Sequence[Mapping[str, Any]]) -> Document:
    """Return the document of one run per direction, with probability and azimuth sweep."""
    return RESPOND.document(
        to_parameters(RESPOND_PARAMETERS, responses[0].options, block=block_entry(block)),
        (to_outcome_entry(RESPOND_RESULT, response, **extra) for response, extra in zip(responses, extras, strict=True)),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
    )


def response_document(response: Response[Any]) -> Document:
    """Return the document of one response."""
    return document([response], response.body, [{}])
