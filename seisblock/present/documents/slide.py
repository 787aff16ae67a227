"""What ``seisblock slide`` answers: one run per direction, or a study."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated, Any

from msgspec import UNSET, Meta, Struct, UnsetType

from seisblock.present.documents.entry import COMPONENT, entry_of, entry_type, outcome_of
from seisblock.present.documents.kind import Document, Kind, Result
from seisblock.records import Record
from seisblock.references import papers
from seisblock.results import Response
from seisblock.solvers.slide.solve import SlideOutcome
from seisblock.studies.sliding import SlidePoint

Several = tuple[float, ...]

SCALE = "vertical_scale"
"""Key of the factor on the vertical component."""


class SlideParameters(Struct, frozen=True, kw_only=True):
    """What was chosen.

    Parameters
    ----------
    mu, mu_kinetic, kappa : float
        Static and kinetic friction, and the kinetic over the static.
    vertical_scale : float
        Factor on the vertical component, 0 where it does not act.
    slope_deg, slope_length_m : float
        Angle of the base, and the distance to its foot; null without an end.
    one_way : bool
    gravity_m_s2 : float
    """

    mu: float
    mu_kinetic: float
    kappa: float
    vertical_scale: float
    slope_deg: float
    slope_length_m: float | None
    one_way: bool
    gravity_m_s2: float


class SlideStudyParameters(Struct, frozen=True, kw_only=True):
    """What was combined; null: what the others give.

    Parameters
    ----------
    mu, mu_kinetic, kappa : list of float
        Static and kinetic friction, and the kinetic over the static.
    vertical_scale : list of float
        Factors on the vertical component, 0 where it does not act.
    slope_deg, slope_length_m : list of float, float
        Angles of the base, and the distance to its foot; null without an end.
    one_way : bool
    gravity_m_s2 : float
    """

    mu: Several
    mu_kinetic: Several | None
    kappa: Several | None
    vertical_scale: Several
    slope_deg: Several
    slope_length_m: float | None
    one_way: bool
    gravity_m_s2: float


SLIDE_RESULT = entry_type("SlideResult", SlideOutcome, before=COMPONENT)
SLIDE_POINT = entry_type("SlidePointResult", SlidePoint, renamed={"vertical": SCALE})
AZIMUTHS: dict[str, Any] = {
    "azimuths": Annotated[list[SLIDE_POINT], Meta(description="Every direction of a sweep.")] | UnsetType  # type: ignore[valid-type]
}
SLIDE = Kind("slide", SlideParameters, SLIDE_RESULT, AZIMUTHS)
STUDY = Kind("slide", SlideStudyParameters, SLIDE_POINT, name="study")


def document(responses: Sequence[Response[SlideOutcome]], sweep: Sequence[SlidePoint] = ()) -> Document:
    """Return the document of one run per direction, and of the sweep that found the worst."""
    return SLIDE.document(
        SlideParameters(**_scaled(responses[0].options)),
        (outcome_of(SLIDE_RESULT, response) for response in responses),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
        azimuths=[point_entry(point) for point in sweep] or UNSET,
    )


def study_document(parameters: Mapping[str, Any], points: Iterable[tuple[Record, SlidePoint]], warnings: Sequence[str]) -> Document:
    """Return the document of a study, point by point."""
    found = ((record, point_entry(point)) for record, point in points)
    return STUDY.document(SlideStudyParameters(**_scaled(parameters)), found, citations=papers("sliding"), warnings=warnings)


def point_entry(point: SlidePoint) -> Result:
    """Return one point of a study."""
    return entry_of(SLIDE_POINT, point, vertical_scale=point.vertical)


def _scaled(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return options with the factor on the vertical component under its key."""
    return {SCALE if key == "vertical" else key: value for key, value in options.items()}
