"""JSON document of ``seisblock rock``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, UnsetType

from seisblock.bodies.block import Block
from seisblock.core.results import Response
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.outcome import RockOutcome
from seisblock.report.json.bodies import BlockEntry, block_entry
from seisblock.report.json.entries import outcome_type, parameters_type, to_outcome_entry, to_parameters
from seisblock.report.json.schema import Document, DocumentSchema
from seisblock.studies.model_comparison import ModelComparison, compare_models
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.rocking.margin import Margin, flag_near_flip
from seisblock.studies.rocking.perturb import Perturbation

ROCK_PARAMETERS = parameters_type(
    "RockParameters",
    RockOptions,
    exclude=("initial",),
    extra={
        "block": Annotated[BlockEntry, Meta(description="Block of the first result.")],
        "margin_limit": Annotated[float | None, Meta(description="Largest factor of the search for margins; null without one.")],
        "mu": Annotated[float | None, Meta(description="Available friction; null if not given.")],
    },
)
ROCK_RESULT = outcome_type(
    "RockResult",
    RockOutcome,
    extra={
        "block": Annotated[BlockEntry, Meta(description="Equivalent block of a scan in this direction.")] | UnsetType,
        "agreement": Annotated[ModelComparison, Meta(description="Results of other models of the same block.")] | UnsetType,
        "friction_suffices": Annotated[bool, Meta(description="With --mu: whether the friction suffices for the motion.")] | UnsetType,
        "margin": Annotated[Margin, Meta(description="With --margin.")] | UnsetType,
        "directions": Annotated[list[RockAzimuth], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
        "perturbation": Annotated[Perturbation, Meta(description="With --perturb, or --margin.")] | UnsetType,
    },
)
ROCK = DocumentSchema("rock", ROCK_PARAMETERS, ROCK_RESULT)


def document(
    responses: Sequence[Response[RockOutcome]],
    block: Block,
    extras: Sequence[Mapping[str, Any]],
    *,
    margin_limit: float | None = None,
    mu: float | None = None,
) -> Document:
    """Return the document of one run per direction, with margin and perturbation."""
    return ROCK.document(
        to_parameters(ROCK_PARAMETERS, responses[0].options, block=block_entry(block), margin_limit=margin_limit, mu=mu),
        (to_outcome_entry(ROCK_RESULT, response, **extra) for response, extra in zip(responses, extras, strict=True)),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
    )


def response_document(response: Response[Any]) -> Document:
    """Return the document of one response."""
    agreement = compare_models(response.body, response.motion, options=response.options)
    return document([flag_near_flip(response)], response.body, [{"agreement": agreement}])
