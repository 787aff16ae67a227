"""JSON document of ``seisblock jump``."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import Annotated, Any

from msgspec import Meta

from seisblock.core.results import Response
from seisblock.models.jump.solve import JumpOutcome, leaves_mortise
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document
from seisblock.output.json.solver import document as solver_document
from seisblock.output.json.solver import solver_schema

PRINTED_OUTCOME = entry_type("PrintedJump", JumpOutcome)
JUMP = solver_schema(
    "jump",
    results={
        "side": Annotated[str | None, Meta(description="Side of the body along the motion, null for a body given by its sizes.")],
        "drop_m": Annotated[float, Meta(description="Height of the floor above the landing ground.")],
        "restitution_y": Annotated[float, Meta(description="Ratio of vertical velocities at the impact.")],
        "leaves_mortise": Annotated[bool | None, Meta(description="Whether the tenons leave their mortises; null without tenons.")],
        "as_printed": Annotated[PRINTED_OUTCOME | None, Meta(description="Outcome of the paper's own scheme, with --as-printed.")],
    },
)


def document(responses: Sequence[Response[JumpOutcome]], *, printed: Sequence[Response[JumpOutcome]] = ()) -> Document:
    """Return the document of one run per combination and direction, with the runs of the paper's own scheme.

    Parameters
    ----------
    responses : sequence of Response
    printed : sequence of Response
        One per response, or none.
    """
    keys = [
        {
            "side": response.body.side,
            "drop_m": response.options.drop,
            "restitution_y": response.options.contact.restitution_y,
            "leaves_mortise": leaves_mortise(response),
            "as_printed": None if paper is None else to_entry(PRINTED_OUTCOME, paper.outcome),
        }
        for response, paper in zip_longest(responses, printed)
    ]
    return solver_document(responses, JUMP, results=keys)


def response_document(response: Response[Any]) -> Document:
    """Return the document of one response."""
    return document([response])
