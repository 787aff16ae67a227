"""JSON document of ``seisblock jump``."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.results import Response
from seisblock.models.jump.solve import JumpOutcome
from seisblock.report.json.bodies import TwoLayerEntry, two_layer_entry
from seisblock.report.json.entries import COMPONENT_KEY, entry_type, to_outcome_entry
from seisblock.report.json.schema import Document, DocumentSchema


class JumpParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    mu, mu_kinetic : float
        Friction of the landed foot.
    restitution_x, restitution_y : float
        Ratios of velocities at the impact.
    drop_m : float
        Height of the floor above the ground.
    spin, direction, landing : str
        Rule of the spin after the impact, sign of the acceleration that starts a chain, rule of the landing.
    first : bool
        Whether only the first chain of motion is simulated.
    windows_s : list of pairs
        Time windows of the start of a chain; empty: the entire record.
    gravity_m_s2 : float
    block : TwoLayerEntry
    tenon_m : float or None
        Depth of the tenon's hole.
    """

    mu: float
    mu_kinetic: float
    restitution_x: float
    restitution_y: float
    drop_m: float
    spin: str
    direction: str
    landing: str
    first: bool
    windows_s: tuple[tuple[float | None, float | None], ...]
    gravity_m_s2: float
    block: TwoLayerEntry
    tenon_m: float | None


JUMP_RESULT = entry_type("JumpResult", JumpOutcome, leading=COMPONENT_KEY)
JUMP = DocumentSchema("jump", JumpParameters, JUMP_RESULT)


def document(responses: Sequence[Response[JumpOutcome]], block: TwoLayerBlock, *, tenon: float | None) -> Document:
    """Return the document of one run per direction."""
    return JUMP.document(
        JumpParameters(**responses[0].options, block=two_layer_entry(block), tenon_m=tenon),
        (to_outcome_entry(JUMP_RESULT, response) for response in responses),
        citations=[key for response in responses for key in response.citations],
        warnings=[text for response in responses for text in response.warnings],
    )
