"""JSON document of a solver, from its registration: options, body and outcome."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, is_dataclass
from functools import cache
from typing import Annotated, Any

from msgspec import Meta

from seisblock.core.registry import get_solver
from seisblock.core.results import Response
from seisblock.output.json.entries import outcome_type, parameters_type, to_outcome_entry, to_parameters
from seisblock.output.json.schema import Document, DocumentSchema
from seisblock.references import papers


@dataclass(frozen=True, kw_only=True)
class ModelDocument:
    """Keys of the parameters of a model's document beside those of its options.

    Parameters
    ----------
    values : callable
        ``values(response) -> mapping``: values of the further keys, and of options that a document gives in another form.
    parameters : mapping of str to type
        Types of the further keys.
    bodies : tuple of type
        Dataclasses whose options are keys, before those of the solver: of the body, or of the value of an excluded option.
    exclude : tuple of str
        Options that are no keys of their own.
    version : int
        See :class:`~seisblock.output.json.schema.DocumentSchema`.
    """

    values: Callable[[Response[Any]], Mapping[str, Any]]
    parameters: Mapping[str, Any] = field(default_factory=dict)
    bodies: tuple[type, ...] = ()
    exclude: tuple[str, ...] = ()
    version: int = 1


def _body_value(response: Response[Any]) -> Mapping[str, Any]:
    body = response.body
    return {"body": asdict(body) if is_dataclass(body) else {"value": body}}  # type: ignore[arg-type]


ANY_BODY = ModelDocument(
    parameters={"body": Annotated[dict[str, Any], Meta(description="Body of the first result; SI.")]},
    values=_body_value,
)
"""Document of a model that registers none."""


def model_document(name: str) -> ModelDocument:
    """Return the keys that a solver registers for its document."""
    return get_solver(name).presenter("document") or ANY_BODY


def solver_schema(
    name: str,
    *,
    parameters: Mapping[str, Any] | None = None,
    results: Mapping[str, Any] | None = None,
    extra: Mapping[str, Any] | None = None,
) -> DocumentSchema:
    """Return the document schema of a solver.

    Parameters
    ----------
    name : str
    parameters, results, extra : mapping of str to type
        Keys of studies, after those of the model: parameters, keys of each result, keys beside the results.

    Raises
    ------
    ParameterError
        If there is no solver of that name.
    """
    solver, model_entry = get_solver(name), model_document(name)
    title = name.title().replace("_", "")
    keys = {**model_entry.parameters, **(parameters or {})}
    return DocumentSchema(
        name,
        parameters_type(f"{title}Parameters", *model_entry.bodies, solver.options, extra=keys, exclude=model_entry.exclude),
        outcome_type(f"{title}Result", solver.outcome, extra=results),
        extra or {},
        version=model_entry.version,
    )


@cache
def plain_schema(name: str) -> DocumentSchema:
    """Return the document schema of a solver without studies."""
    return solver_schema(name)


def document(
    responses: Sequence[Response[Any]],
    schema: DocumentSchema | None = None,
    *,
    results: Sequence[Mapping[str, Any]] = (),
    extra: Mapping[str, Any] | None = None,
    **parameters: Any,
) -> Document:
    """Return the document of one run per direction.

    Parameters
    ----------
    responses : sequence of Response
    schema : DocumentSchema
        From :func:`solver_schema`; default: that without studies.
    results : sequence of mapping
        Values of the further keys of each result.
    extra : mapping
        Values of the keys beside the results.
    parameters
        Values of the further parameters.
    """
    first = responses[0]
    schema, model_entry = schema or plain_schema(first.model), model_document(first.model)
    objects = (first.body, *(getattr(first.options, option) for option in model_entry.exclude))
    sources = (*(value for value in objects if isinstance(value, model_entry.bodies)), first.options)
    return schema.document(
        to_parameters(schema.parameters, *sources, **{**model_entry.values(first), **parameters}),
        (
            to_outcome_entry(schema.result, response, **further)
            for response, further in zip(responses, results or [{}] * len(responses), strict=True)
        ),
        citations=[key for response in responses for key in response.citations] or papers(*get_solver(first.model).topics),
        warnings=[text for response in responses for text in response.warnings],
        **(extra or {}),
    )
