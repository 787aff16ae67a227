"""Registry of document kinds and their JSON Schemas."""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import re
from collections.abc import Iterator
from typing import Any

import msgspec

from seisblock.core.errors import ParameterError
from seisblock.core.registry import get_solver, solver_names
from seisblock.core.results import Response
from seisblock.output.json.schema import Document, DocumentSchema
from seisblock.output.json.solver import document as document_of
from seisblock.output.json.solver import plain_schema
from seisblock.output.json.units import split_unit

STUDY_DOCUMENTS = (
    "measure", "criteria", "spectrum", "overturn-rate", "infer", "body", "batch", "map", "fragility", "risk", "fit", "paper", "scenario",
    "secure", "report", "validate", "cite", "samples", "fetch",
)  # fmt: skip
"""Commands with a document, apart from those of the solvers."""

CITATION_COMMANDS = ("cite", "samples")
"""Commands whose documents are defined in :mod:`seisblock.report.json.citations`."""


def document_commands() -> tuple[str, ...]:
    """Return the commands with a document: solvers, then studies and tools."""
    return (*solver_names(), *STUDY_DOCUMENTS)


OTHER_DOCUMENTS = {"respond": ("rigid3d",)}
"""Commands that may answer with the document of another one: ``respond`` in three dimensions."""

JSON_SCHEMA_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def document_schemas(command: str) -> list[DocumentSchema]:
    """Return the document schemas of a command.

    Raises
    ------
    ParameterError
        If it answers with none.
    """
    if command not in document_commands():
        raise ParameterError("{command!r} has no JSON document; available: {known}", command=command, known=list(document_commands()))
    module_name = f"{__package__}.{'citations' if command in CITATION_COMMANDS else command.replace('-', '_')}"
    if not importlib.util.find_spec(module_name):
        return [plain_schema(command)]
    schemas = vars(importlib.import_module(module_name)).values()
    return [schema for schema in schemas if isinstance(schema, DocumentSchema) and schema.command == command]


def response_document(response: Response[Any]) -> Document:
    """Return the JSON document of one response, with the keys that studies add for its model."""
    get_solver(response.model)  # an unknown model has no document
    module_name = f"{__package__}.{response.model}"
    module = importlib.import_module(module_name) if importlib.util.find_spec(module_name) else None
    make_document = getattr(module, "response_document", None)
    return make_document(response) if make_document else document_of([response], document_schemas(response.model)[0])


def json_schema(command: str) -> dict[str, Any]:
    """Return the JSON Schema of the documents of a command.

    Keys, units and descriptions are generated from the types of the documents. Keys that are not required may be absent.

    Raises
    ------
    ParameterError
        If the command answers with no document.
    """
    kinds = [kind for name in (command, *OTHER_DOCUMENTS.get(command, ())) for kind in document_schemas(name)]
    references, definitions = msgspec.json.schema_components([kind.type for kind in kinds])
    for definition in definitions.values():
        _add_descriptions(definition)
    root = dict(references[0]) if len(kinds) == 1 else {"anyOf": list(references)}
    return {"$schema": JSON_SCHEMA_DIALECT, "title": kinds[0].schema, **root, "$defs": definitions}


def _add_descriptions(definition: dict[str, Any]) -> None:
    """Add description and unit to each key; keys with a default are always written."""
    summary, docs = _parse_docstring(definition.get("description", ""))
    definition.pop("description", None)
    if summary:
        definition["description"] = summary
    for key, shape in definition.get("properties", {}).items():
        if "default" in shape:
            del shape["default"]
            definition["required"].append(key)
        unit = split_unit(key)[1]
        if unit:
            shape["unit"] = unit
        if key in docs and "description" not in shape:
            shape["description"] = docs[key]
    if "required" in definition:
        definition["required"].sort(key=list(definition["properties"]).index)


def _parse_docstring(docstring: str) -> tuple[str, dict[str, str]]:
    """Return the summary of a numpydoc docstring and its parameter descriptions."""
    # Python 3.13 and later strip the indentation when they compile, earlier ones do not
    text = re.sub(r":\w+:`~?(?:[\w.]+\.)?(\w+)`", r"\1", inspect.cleandoc(docstring).replace("]_", "]"))
    summary, _, body = text.partition("\n")
    section = re.split(r"\n\s*\w+\n\s*-{3,}\n", body.partition("Parameters\n")[2].lstrip(" -\n"))[0]
    return summary.strip(), dict(_parameter_docs(section))


def _parameter_docs(section: str) -> Iterator[tuple[str, str]]:
    """Yield each name of a Parameters section with its description."""
    for names, text in re.findall(r"^(\w[\w, ]*?)(?: : .*)?\n((?: {4,}.*\n?)*)", section.rstrip() + "\n", re.MULTILINE):
        for name in names.split(", "):
            if text.strip():
                yield name, " ".join(text.split())
