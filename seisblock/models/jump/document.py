"""Keys of the document of the jump beside its options."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from seisblock.bodies.two_layer import Contact
from seisblock.output.json.bodies import TwoLayerEntry, two_layer_entry
from seisblock.output.json.solver import ModelDocument

DOCUMENT = ModelDocument(
    bodies=(Contact,),
    parameters={
        "block": TwoLayerEntry,
        "tenon_m": Annotated[float | None, Meta(description="Length of the tenons; null without tenons.")],
    },
    values=lambda response: {
        "mu_kinetic": response.options.contact.kinetic,
        "block": two_layer_entry(response.body),
        "tenon_m": response.options.tenon or None,
    },
    exclude=("contact",),
    version=2,
)
