"""Scalar outcome fields that become table columns."""

from __future__ import annotations

import types
from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from typing import Any, Union, get_args, get_origin, get_type_hints

_SCALARS = (bool, int, float, str)

OPTIONAL_FIELDS = ("verdict_flips_within_2_percent", "flips_at_factor")
"""Outcome fields computed on request only (40 additional runs); not columns."""


@cache
def scalar_fields(outcome: type) -> Mapping[str, type]:
    """Return the scalar fields of an outcome with their types.

    Examples
    --------
    >>> from seisblock.models.slide.solve import SlideOutcome
    >>> scalar_fields(SlideOutcome)["slip_count"]
    <class 'int'>
    """
    hints = get_type_hints(outcome)
    kinds = {field.name: _scalar_type(hints[field.name]) for field in fields(outcome) if field.name not in OPTIONAL_FIELDS}
    return {name: kind for name, kind in kinds.items() if kind is not None}


def _scalar_type(hint: Any) -> type | None:
    """Return the scalar type of an annotation, optional or not; None for other types."""
    kinds = [kind for kind in get_args(hint) if kind is not type(None)] if get_origin(hint) in (Union, types.UnionType) else [hint]
    return kinds[0] if len(kinds) == 1 and kinds[0] in _SCALARS else None
