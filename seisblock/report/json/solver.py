"""JSON document of a solver, from its registration: options, body and outcome."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, is_dataclass
from functools import cache
from typing import Annotated, Any

from msgspec import Meta

from seisblock.core.registry import get_solver
from seisblock.core.results import Response
from seisblock.references import papers
from seisblock.report.json.entries import outcome_type, parameters_type, to_outcome_entry, to_parameters
from seisblock.report.json.schema import Document, DocumentSchema

BODY_KEY = {"body": Annotated[dict[str, Any], Meta(description="Body of the first result; SI.")]}


@cache
def solver_schema(name: str) -> DocumentSchema:
    """Return the document schema of a solver.

    Raises
    ------
    ParameterError
        If there is no solver of that name.
    """
    solver = get_solver(name)
    title = name.title().replace("_", "")
    parameters = parameters_type(f"{title}Parameters", solver.options, extra=BODY_KEY)
    return DocumentSchema(name, parameters, outcome_type(f"{title}Result", solver.outcome))


def document(responses: Sequence[Response[Any]]) -> Document:
    """Return the document of one run per direction."""
    first = responses[0]
    schema, solver = solver_schema(first.model), get_solver(first.model)
    body: Mapping[str, Any] = asdict(first.body) if is_dataclass(first.body) else {"value": first.body}  # type: ignore[arg-type]
    return schema.document(
        to_parameters(schema.parameters, first.options, body=body),
        (to_outcome_entry(schema.result, response) for response in responses),
        citations=[*papers(*solver.topics), *(key for response in responses for key in response.citations)],
        warnings=[text for response in responses for text in response.warnings],
    )


def response_document(response: Response[Any]) -> Document:
    """Return the document of one response."""
    return document([response])
