"""Keys of the document of uplift beside its options."""

from __future__ import annotations

from seisblock.output.json.bodies import SpringBlockEntry, spring_block_entry
from seisblock.output.json.solver import ModelDocument

DOCUMENT = ModelDocument(
    parameters={"block": SpringBlockEntry},
    values=lambda response: {"block": spring_block_entry(response.body)},
)
