"""Keys of the document of the full response beside its options."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from seisblock.output.json.bodies import BlockEntry, block_entry
from seisblock.output.json.solver import ModelDocument

DOCUMENT = ModelDocument(
    parameters={"block": Annotated[BlockEntry, Meta(description="Block of the first result.")]},
    values=lambda response: {"block": block_entry(response.body)},
    exclude=("sensitivity",),
    version=2,
)
