"""JSON document of ``seisblock rock``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, Struct, UnsetType

from seisblock.bodies.block import Block, Restitution
from seisblock.core.results import Response
from seisblock.models.rock.outcome import RockOutcome
from seisblock.report.json.bodies import BlockEntry, block_entry
from seisblock.report.json.entries import COMPONENT_KEY, entry_type, to_outcome_entry
from seisblock.report.json.schema import Document, DocumentSchema
from seisblock.studies.model_comparison import ModelComparison
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.rocking.margin import Margin
from seisblock.studies.rocking.perturb import Perturbation


class RockParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    restitution : float, two of them, or None
        Ratio of angular velocities at an impact, onto the right and onto the left corner; null: from the angular momentum.
    linear, vertical : bool
        Whether the equation is linear, and whether the vertical component acts.
    gravity_m_s2 : float
    block : BlockEntry
        Block of the first result.
    margin_limit : float or None
        Largest factor of the search for margins; null without one.
    mu : float or None
        Available friction; null if not given.
    """

    restitution: Restitution
    linear: bool
    vertical: bool
    gravity_m_s2: float
    block: BlockEntry
    margin_limit: float | None
    mu: float | None


ROCK_RESULT = entry_type(
    "RockResult",
    RockOutcome,
    leading=COMPONENT_KEY,
    extra={
        "block": Annotated[BlockEntry, Meta(description="Equivalent block of a scan in this direction.")] | UnsetType,
        "agreement": Annotated[ModelComparison, Meta(description="Results of other models of the same block.")] | UnsetType,
        "friction_suffices": Annotated[bool, Meta(description="With --mu: whether the friction suffices for the motion.")] | UnsetType,
        "margin": Annotated[Margin, Meta(description="With --margin.")] | UnsetType,
        "directions": Annotated[list[RockAzimuth], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
        "perturbation": Annotated[Perturbation, Meta(description="With --perturb, or --margin.")] | UnsetType,
    },
)
ROCK = DocumentSchema("rock", RockParameters, ROCK_RESULT)


def document(
    responses: Sequence[Response[RockOutcome]],
    block: Block,
    extras: Sequence[Mapping[str, Any]],
    *,
    margin_limit: float | None = None,
    mu: float | None = None,
) -> Document:
    """Return the document of one run per direction, with margin and perturbation."""
    options = responses[0].options
    return ROCK.document(
        RockParameters(**{**options, "vertical": bool(options["vertical"])}, block=block_entry(block), margin_limit=margin_limit, mu=mu),
        (to_outcome_entry(ROCK_RESULT, response, **extra) for response, extra in zip(responses, extras, strict=True)),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
    )
