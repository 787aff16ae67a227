"""JSON documents of ``seisblock slide``: one run per direction, or a parameter study."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated, Any

from msgspec import UNSET, Meta, Struct, UnsetType

from seisblock.core.results import Response
from seisblock.models.slide.solve import SlideOutcome
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema, Result
from seisblock.output.json.solver import document as solver_document
from seisblock.output.json.solver import solver_schema
from seisblock.records import Record
from seisblock.references import papers
from seisblock.studies.sliding import SlidePoint

FloatTuple = tuple[float, ...]


class SlideStudyParameters(Struct, frozen=True, kw_only=True):
    """Values of the parameter study; null where derived from the others.

    Parameters
    ----------
    mu, mu_kinetic, kappa : list of float
        Static and kinetic friction, and the kinetic over the static.
    vertical_scale : list of float
        Factors on the vertical component, 0 if it does not act.
    slope_deg, slope_length_m : list of float, float
        Angles of the base, and the distance to its foot; null without an end.
    one_way : bool
    gravity_m_s2 : float
    """

    mu: FloatTuple
    mu_kinetic: FloatTuple | None
    kappa: FloatTuple | None
    vertical_scale: FloatTuple
    slope_deg: FloatTuple
    slope_length_m: float | None
    one_way: bool
    gravity_m_s2: float


SLIDE_POINT = entry_type("SlidePointResult", SlidePoint, aliases={"vertical": "vertical_scale"})
AZIMUTHS_KEY: dict[str, Any] = {
    "azimuths": Annotated[list[SLIDE_POINT], Meta(description="All directions of a sweep.")] | UnsetType  # type: ignore[valid-type]
}
SLIDE = solver_schema("slide", extra=AZIMUTHS_KEY)
STUDY = DocumentSchema("slide", SlideStudyParameters, SLIDE_POINT, name="study")


def document(responses: Sequence[Response[SlideOutcome]], sweep: Sequence[SlidePoint] = ()) -> Document:
    """Return the document of one run per direction, and of the azimuth sweep."""
    return solver_document(responses, SLIDE, extra={"azimuths": [point_entry(point) for point in sweep] or UNSET})


def study_document(parameters: Mapping[str, Any], points: Iterable[tuple[Record, SlidePoint]], warnings: Sequence[str]) -> Document:
    """Return the document of a parameter study, point by point."""
    entries = ((record, point_entry(point)) for record, point in points)
    return STUDY.document(SlideStudyParameters(**parameters), entries, citations=papers("sliding"), warnings=warnings)


def point_entry(point: SlidePoint) -> Result:
    """Return the entry of one point of a study."""
    return to_entry(SLIDE_POINT, point, vertical_scale=point.vertical)
