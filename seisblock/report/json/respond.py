"""JSON document of ``seisblock respond``: the response, its probability and its azimuths."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, UnsetType

from seisblock.core.results import Response
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.output.json.bodies import BlockEntry
from seisblock.output.json.schema import Document
from seisblock.output.json.solver import document as solver_document
from seisblock.output.json.solver import solver_schema
from seisblock.report.json.assessment import ALL_AZIMUTHS_KEY, ASSESSMENT_KEY, OBJECT_KEY, VARIANT_KEYS, entry_keys, object_keys
from seisblock.studies.respond.azimuths import RespondAzimuth
from seisblock.studies.respond.probability import Probability

RESPOND = solver_schema(
    "respond",
    results={
        **VARIANT_KEYS,
        "block": Annotated[BlockEntry, Meta(description="Block in this direction, of a scan or towards an azimuth.")] | UnsetType,
        "assessment": ASSESSMENT_KEY | UnsetType,
        "probability": Annotated[Probability, Meta(description="Overturning probability; absent with --runs 0.")] | UnsetType,
        "all_azimuths": ALL_AZIMUTHS_KEY,
        "directions": Annotated[list[RespondAzimuth], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
    },
    extra={"object": OBJECT_KEY},
)


def document(responses: Sequence[Response[RespondOutcome]], extras: Sequence[Mapping[str, Any]]) -> Document:
    """Return the document of one run per direction, with probability and azimuth sweep."""
    return solver_document(responses, RESPOND, results=list(map(entry_keys, extras)), extra=object_keys(responses, extras))
