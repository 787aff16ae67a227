"""JSON document of ``seisblock rock``: the response, and the studies of the block."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, UnsetType

from seisblock.core.results import Response
from seisblock.models.rock.outcome import RockOutcome
from seisblock.output.json.bodies import BlockEntry
from seisblock.output.json.schema import Document
from seisblock.output.json.solver import document as solver_document
from seisblock.output.json.solver import solver_schema
from seisblock.report.json.assessment import ALL_AZIMUTHS_KEY, ASSESSMENT_KEY, OBJECT_KEY, VARIANT_KEYS, entry_keys, object_keys
from seisblock.report.json.peaks import peak_schema
from seisblock.studies.model_comparison import ModelComparison
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.rocking.margin import Margin, flag_near_flip
from seisblock.studies.rocking.perturb import Perturbation
from seisblock.studies.sampling import sample
from seisblock.studies.solvers.rock import assess_rock

ROCK = solver_schema(
    "rock",
    parameters={
        "margin_limit": Annotated[float | None, Meta(description="Largest factor of the search for margins; null without one.")],
        "mu": Annotated[float | None, Meta(description="Available friction; null if not given.")],
    },
    results={
        **VARIANT_KEYS,
        "block": Annotated[BlockEntry, Meta(description="Block in this direction, of a scan or towards an azimuth.")] | UnsetType,
        "agreement": Annotated[ModelComparison, Meta(description="Results of other models of the same block.")] | UnsetType,
        "assessment": ASSESSMENT_KEY | UnsetType,
        "friction_suffices": Annotated[bool, Meta(description="With --mu: whether the friction suffices for the motion.")] | UnsetType,
        "margin": Annotated[Margin, Meta(description="With --margin.")] | UnsetType,
        "all_azimuths": ALL_AZIMUTHS_KEY,
        "directions": Annotated[list[RockAzimuth], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
        "perturbation": Annotated[Perturbation, Meta(description="With --perturb, or --margin.")] | UnsetType,
    },
    extra={"object": OBJECT_KEY},
)
ROCK_PEAKS = peak_schema("rock")


def document(
    responses: Sequence[Response[RockOutcome]],
    extras: Sequence[Mapping[str, Any]],
    *,
    margin_limit: float | None = None,
    mu: float | None = None,
) -> Document:
    """Return the document of one run per direction, with margin and perturbation."""
    return solver_document(
        responses,
        ROCK,
        results=list(map(entry_keys, extras)),
        extra=object_keys(responses, extras),
        margin_limit=margin_limit,
        mu=mu,
    )


def response_document(response: Response[Any]) -> Document:
    """Return the document of one response."""
    block, motion, options = response.body, response.motion, response.options
    assessment = assess_rock(block, motion, options, sample("rock", block, motion, options))
    return document([flag_near_flip(response)], [{"agreement": assessment.comparison, "assessment": assessment}])
