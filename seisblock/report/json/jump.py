"""JSON document of ``seisblock jump``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from msgspec import Meta

from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.core.results import Response
from seisblock.models.jump.options import JumpOptions
from seisblock.models.jump.solve import JumpOutcome
from seisblock.report.json.bodies import TwoLayerEntry, two_layer_entry
from seisblock.report.json.entries import outcome_type, parameters_type, to_outcome_entry, to_parameters
from seisblock.report.json.schema import Document, DocumentSchema

JUMP_PARAMETERS = parameters_type(
    "JumpParameters",
    Contact,
    JumpOptions,
    exclude=("contact",),
    extra={
        "block": TwoLayerEntry,
        "tenon_m": Annotated[float | None, Meta(description="Depth of the tenon's hole.")],
    },
)
JUMP_RESULT = outcome_type("JumpResult", JumpOutcome)
JUMP = DocumentSchema("jump", JUMP_PARAMETERS, JUMP_RESULT, version=2)


def document(responses: Sequence[Response[JumpOutcome]], block: TwoLayerBlock, *, tenon: float | None) -> Document:
    """Return the document of one run per direction."""
    options: JumpOptions = responses[0].options
    contact = options.contact
    return JUMP.document(
        to_parameters(JUMP_PARAMETERS, contact, options, mu_kinetic=contact.kinetic, block=two_layer_entry(block), tenon_m=tenon),
        (to_outcome_entry(JUMP_RESULT, response) for response in responses),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
    )


def response_document(response: Response[Any]) -> Document:
    """Return the document of one response."""
    return document([response], response.body, tenon=None)
