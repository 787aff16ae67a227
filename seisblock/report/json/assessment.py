"""JSON entry of an assessment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Annotated, Any

from msgspec import Meta, Struct, UnsetType

from seisblock.core.results import Response
from seisblock.studies.assessment import Assessment, DirectionAssessment, ModelVerdict, assess_objects
from seisblock.studies.azimuth_probability import AzimuthAverage


class AssessmentEntry(Struct, frozen=True, kw_only=True, rename={"class_": "class"}):
    """Assessment of one object.

    Parameters
    ----------
    overturning_probability : float
        Share of the samples of object and shaking that overturn; model error not included.
    interval : two floats
        Clopper-Pearson, 95 %.
    runs : int
        Samples with a result.
    moved_probability : float
        Share that overturn or end away from their place.
    models : list of ModelVerdict
    least_factor, greatest_factor : float or None
        Range of the factors to overturning of the models.
    predictable_until_s : float or None
        Until when input changes of 2e-6 do not alter the run; null: to its end.
    direction : str
        Component or azimuth; of an object the one with the largest probability.
    class_ : str
        likely overturns, may overturn, moves or stays.
    """

    overturning_probability: float
    interval: tuple[float, float]
    runs: int
    moved_probability: float
    models: tuple[ModelVerdict, ...]
    least_factor: float | None
    greatest_factor: float | None
    predictable_until_s: float | None
    direction: str
    class_: str


class AzimuthAverageEntry(Struct, frozen=True, kw_only=True, rename={"class_": "class"}):
    """Assessment of a body of unknown orientation.

    Parameters
    ----------
    overturning_probability : float
        Mean over all azimuths.
    runs : int
        Samples with a result, of all azimuths together.
    class_ : str
        likely overturns, may overturn, moves or stays.
    """

    overturning_probability: float
    runs: int
    class_: str


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


def assessment_entry(assessment: Assessment) -> AssessmentEntry:
    """Return the entry of an assessment."""
    return AssessmentEntry(**{name: getattr(assessment, name) for name in AssessmentEntry.__struct_fields__})


def entry_keys(extra: Mapping[str, Any]) -> dict[str, Any]:
    """Return the further keys of a result, with the assessment as an entry and the values of its variant as keys."""
    keys = {name: value for name, value in extra.items() if name != "variant"}
    keys |= {VARIANT_NAMES[name]: value for name, value in extra.get("variant", {}).items()}
    if "assessment" in keys:
        part: DirectionAssessment = keys["assessment"]
        keys["assessment"] = assessment_entry(part.assessment)
    if "all_azimuths" in keys:
        average: AzimuthAverage = keys["all_azimuths"]
        keys["all_azimuths"] = AzimuthAverageEntry(**asdict(average))
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
