"""Keys of the document of a pile beside its options."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from msgspec import Meta

from seisblock.bodies.pile.contact import PileContact
from seisblock.core.results import Response
from seisblock.models.stack.joint_geometry import EffectiveBase, effective_base
from seisblock.models.stack.options import SPRINGS
from seisblock.models.stack.outcome import StackOutcome
from seisblock.output.json.bodies import PileContactEntry, PileEntry, pile_contact_entry, pile_entry
from seisblock.output.json.solver import ModelDocument


def _values(response: Response[StackOutcome]) -> Mapping[str, Any]:
    """Return the values of the pile; null for rigid contact, the default springs where these replaced it as it created energy."""
    options, pile = response.options, response.body
    contact = PileContact() if options.contact is None and options.law == SPRINGS else options.contact
    return {
        "mu": pile.mu,
        "mu_kinetic": pile.friction()[1],
        "base": effective_base(response),
        "contact": None if contact is None else pile_contact_entry(contact),
        "pile": pile_entry(pile),
    }


DOCUMENT = ModelDocument(
    parameters={
        "mu": Annotated[float, Meta(description="Default static friction of the joints.")],
        "base": Annotated[EffectiveBase, Meta(description="Effective base of the top stone.")],
        "contact": Annotated[PileContactEntry | None, Meta(description="Null for rigid contact.")],
        "pile": PileEntry,
    },
    values=_values,
    exclude=("contact", "stop_at_fall", "tilts"),
    version=3,
)
