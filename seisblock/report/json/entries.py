"""Document entries generated from dataclasses: one key per field, plus extra keys."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Annotated, Any, get_type_hints

import msgspec
from msgspec import Meta

from seisblock.core.results import Response
from seisblock.report.json.schema import Result, is_optional

COMPONENT_KEY = {"component": Annotated[str, Meta(description="Direction of the record that is +x: a code, or an azimuth in degrees.")]}
"""First key of results of one direction."""


def entry_type(
    name: str,
    source: type,
    *,
    leading: Mapping[str, Any] | None = None,
    extra: Mapping[str, Any] | None = None,
    aliases: Mapping[str, str] | None = None,
    exclude: tuple[str, ...] = (),
) -> type[Result]:
    """Return a struct type with a key for each field of a dataclass.

    Parameters
    ----------
    name : str
        Of the type, in the schema.
    source : dataclass
    leading, extra : mapping of str to type
        Keys before and after those of the fields; a type that may be ``UNSET`` is left out of the document when it is.
    aliases : mapping of str to str
        Keys of fields that go by another name in documents.
    exclude : tuple of str
        Fields that are no keys.
    """
    hints = get_type_hints(source, include_extras=True)
    own_fields = {(aliases or {}).get(field.name, field.name): hints[field.name] for field in fields(source) if field.name not in exclude}
    declared: list[Any] = [
        (key, kind, msgspec.UNSET) if is_optional(kind) else (key, kind)
        for key, kind in {**(leading or {}), **own_fields, **(extra or {})}.items()
    ]
    result_type: Any = msgspec.defstruct(name, declared, bases=(Result,), frozen=True, kw_only=True, namespace={"__doc__": source.__doc__})
    return result_type  # type: ignore[no-any-return]


def to_entry(kind: type[Result], source: Any, **extra: Any) -> Result:
    """Return an entry with the fields of a dataclass and extra keys."""
    keys = {field.name for field in fields(source)} & set(kind.__struct_fields__)
    return kind(**{key: getattr(source, key) for key in keys} | extra)


def to_outcome_entry(kind: type[Result], response: Response[Any], **extra: Any) -> tuple[Any, Result]:
    """Return the record of a response and its outcome as an entry with the component first."""
    return response.motion.record, to_entry(kind, response.outcome, component=response.motion.name, **extra)
