"""What ``seisblock rock`` answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, Struct, UnsetType

from seisblock.bodies.block import Block, Restitution
from seisblock.present.documents.bodies import BlockEntry, block_entry
from seisblock.present.documents.entry import COMPONENT, entry_type, outcome_of
from seisblock.present.documents.kind import Document, Kind
from seisblock.results import Response
from seisblock.solvers.rock.outcome import RockOutcome
from seisblock.studies.agreement import Agreement
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.rocking.margin import Margin
from seisblock.studies.rocking.perturb import Perturbation


class RockParameters(Struct, frozen=True, kw_only=True):
    """What was chosen.

    Parameters
    ----------
    restitution : float, two of them, or None
        Ratio of angular velocities at an impact, onto the right and onto the left corner; null: from the angular momentum.
    linear, vertical : bool
        Whether the equation is linear, and whether the vertical component acts.
    gravity_m_s2 : float
    block : BlockEntry
        That of the first result.
    margin_limit : float or None
        Largest factor of the search for margins; null without one.
    mu : float or None
        The friction there is; null where nobody said.
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
    before=COMPONENT,
    beside={
        "block": Annotated[BlockEntry, Meta(description="Of a scan: the block that it is in this direction.")] | UnsetType,
        "agreement": Annotated[Agreement, Meta(description="What other models of the same block say.")] | UnsetType,
        "friction_suffices": Annotated[bool, Meta(description="With --mu: whether it lets the block do this.")] | UnsetType,
        "margin": Annotated[Margin, Meta(description="With --margin.")] | UnsetType,
        "directions": Annotated[list[RockAzimuth], Meta(description="With --component all-azimuths, the worst first.")] | UnsetType,
        "perturbation": Annotated[Perturbation, Meta(description="With --perturb, or --margin.")] | UnsetType,
    },
)
ROCK = Kind("rock", RockParameters, ROCK_RESULT)


def document(
    responses: Sequence[Response[RockOutcome]],
    block: Block,
    extras: Sequence[Mapping[str, Any]],
    *,
    margin_limit: float | None = None,
    mu: float | None = None,
) -> Document:
    """Return the document of one run per direction, and of the margin and the perturbation that were looked for around each."""
    options = responses[0].options
    return ROCK.document(
        RockParameters(**{**options, "vertical": bool(options["vertical"])}, block=block_entry(block), margin_limit=margin_limit, mu=mu),
        (outcome_of(ROCK_RESULT, response, **extra) for response, extra in zip(responses, extras, strict=True)),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
    )
