"""JSON entry of an assessment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, UnsetType

from seisblock.core.results import Response
from seisblock.output.json.entries import entry_type
from seisblock.output.json.schema import fill
from seisblock.studies.assessment import Assessment, DirectionAssessment, assess_objects
from seisblock.studies.azimuth_probability import AzimuthAverage

CLASS = {"class_": "class"}
"""Key of the class of an object."""

AssessmentEntry: Any = entry_type("AssessmentEntry", Assessment, aliases=CLASS, bases=())
AzimuthAverageEntry: Any = entry_type("AzimuthAverageEntry", AzimuthAverage, aliases=CLASS, bases=())

ALL_AZIMUTHS_KEY = (
    Annotated[AzimuthAverageEntry, Meta(description="With --component all-azimuths and samples: unknown orientation.")] | UnsetType
)
"""Type of the key ``all_azimuths`` of results of a sweep."""

ASSESSMENT_KEY = Annotated[AssessmentEntry, Meta(description="Probability, models, predictability and class; absent without samples.")]
"""Type of the key ``assessment`` of results of one direction; absent without samples."""

OBJECT_KEY = (
    Annotated[
        AssessmentEntry | list[AssessmentEntry | None],
        Meta(description="Assessment under any of several horizontals of the record; a list with several records, bodies or variants."),
    ]
    | UnsetType
)
"""Type of the key ``object`` of a document."""


VARIANT_NAMES = {"width": "width_m", "height": "height_m", "mu": "mu"}
"""Keys of the options that accept a list."""

VARIANT_KEYS = {
    "width_m": Annotated[float, Meta(description="With several widths.")] | UnsetType,
    "height_m": Annotated[float, Meta(description="With several heights.")] | UnsetType,
    "mu": Annotated[float, Meta(description="With several friction coefficients.")] | UnsetType,
}
"""Keys of results that differ between variants."""


def assessment_entry(assessment: Assessment) -> Any:
    """Return the entry of an assessment."""
    return fill(AssessmentEntry, assessment, **{"class": assessment.class_})


def entry_keys(extra: Mapping[str, Any]) -> dict[str, Any]:
    """Return the further keys of a result, with the assessment as an entry and the values of its variant as keys."""
    keys = {name: value for name, value in extra.items() if name != "variant"}
    keys |= {VARIANT_NAMES[name]: value for name, value in extra.get("variant", {}).items()}
    if "assessment" in keys:
        part: DirectionAssessment = keys["assessment"]
        keys["assessment"] = assessment_entry(part.assessment)
    if "all_azimuths" in keys:
        average: AzimuthAverage = keys["all_azimuths"]
        keys["all_azimuths"] = fill(AzimuthAverageEntry, average, **{"class": average.class_})
    return keys


def object_keys(responses: Sequence[Response[Any]], extras: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return the key ``object`` of a document, empty without a record of several horizontals.

    Parameters
    ----------
    responses : sequence of Response
    extras : sequence of mapping
        Further results of each; ``assessment`` among them with samples.
    """
    parts = [
        ((id(response.motion.record), *extra.get("variant", {}).values()), extra.get("assessment"))
        for response, extra in zip(responses, extras, strict=True)
    ]
    entries = [None if item is None else assessment_entry(item) for item in assess_objects(parts)]
    return {"object": entries[0] if len(entries) == 1 else entries} if any(entries) else {}
