"""JSON document of ``seisblock rigid3d`` and ``respond --three-d``: the response, its probability with displacement and twist."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, UnsetType

from seisblock.core.results import Response
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.output.json.schema import Document
from seisblock.output.json.solver import document as solver_document
from seisblock.output.json.solver import solver_schema
from seisblock.report.json.assessment import ALL_AZIMUTHS_KEY, ASSESSMENT_KEY, AssessmentEntry, assessment_entry, entry_keys
from seisblock.studies.assessment import Assessment
from seisblock.studies.respond.azimuths import Rigid3dAzimuth
from seisblock.studies.respond.probability import SpatialProbability

RIGID3D = solver_schema(
    "rigid3d",
    results={
        "assessment": ASSESSMENT_KEY | UnsetType,
        "probability": Annotated[SpatialProbability, Meta(description="Overturning probability; absent with --runs 0.")] | UnsetType,
        "all_azimuths": ALL_AZIMUTHS_KEY,
        "directions": Annotated[list[Rigid3dAzimuth], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
    },
    extra={
        "object": Annotated[
            AssessmentEntry | list[AssessmentEntry],
            Meta(description="Assessment under all components, of several directions of +x the worst; with several records a list."),
        ]
        | UnsetType
    },
)


def document(responses: Sequence[Response[Rigid3dOutcome]], extras: Sequence[Mapping[str, Any]]) -> Document:
    """Return the document of one run per direction of +x, with probability."""
    by_record: dict[int, list[Assessment]] = {}
    for response, extra in zip(responses, extras, strict=True):
        if "assessment" in extra:
            by_record.setdefault(id(response.motion.record), []).append(extra["assessment"].assessment)
    entries = [
        assessment_entry(max(group, key=lambda result: (result.overturning_probability, result.moved_probability)))
        for group in by_record.values()
    ]
    extra = {"object": entries[0] if len(entries) == 1 else entries} if entries else {}
    return solver_document(responses, RIGID3D, results=list(map(entry_keys, extras)), extra=extra)
