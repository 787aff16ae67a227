"""JSON document of ``seisblock stack`` for a pile under a record: the response, its probability and the models of the top stone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, UnsetType

from seisblock.core.results import Response
from seisblock.models.stack.outcome import StackOutcome
from seisblock.output.json.schema import Document
from seisblock.output.json.solver import document as solver_document
from seisblock.output.json.solver import solver_schema
from seisblock.report.json.assessment import ASSESSMENT_KEY, entry_keys
from seisblock.studies.model_comparison import ModelComparison, compare_pile_models
from seisblock.studies.respond.pile_probability import PileProbability

AGREEMENT_KEY = Annotated[ModelComparison | None, Meta(description="Results of models of the top stone; null if the stone is restrained.")]
PROBABILITY_KEY = Annotated[PileProbability, Meta(description="Probabilities of falling stones; absent with --runs 0.")] | UnsetType
STACK = solver_schema(
    "stack", results={"agreement": AGREEMENT_KEY, "assessment": ASSESSMENT_KEY | UnsetType, "probability": PROBABILITY_KEY}
)


def document(responses: Sequence[Response[StackOutcome]], extras: Sequence[Mapping[str, Any]]) -> Document:
    """Return the document of one run per direction, with model comparison and probability."""
    return solver_document(responses, STACK, results=list(map(entry_keys, extras)))


def response_document(response: Response[Any]) -> Document:
    """Return the document of one response."""
    return document([response], [{"agreement": compare_pile_models(response)}])
