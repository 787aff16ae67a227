"""Keys of the document of sliding beside its options."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.output.json.solver import ModelDocument

DOCUMENT = ModelDocument(
    bodies=(SlidingBase,),
    parameters={
        "vertical_scale": Annotated[float, Meta(description="Factor on the vertical component, 0 if it does not act.")],
        "kappa": Annotated[float, Meta(description="Kinetic over static friction.")],
    },
    values=lambda response: {"mu_kinetic": response.body.kinetic, "kappa": response.body.kappa},
)
