"""Document entries generated from dataclasses: one key per field, plus extra keys."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Annotated, Any, get_type_hints

import msgspec
from msgspec import Meta, Struct

from seisblock.core.options import document_key, option_fields, plain_help
from seisblock.core.results import Response
from seisblock.measures.shaking import BodyShaking, response_shaking
from seisblock.output.json.schema import Result, is_optional

COMPONENT_KEY = {"component": Annotated[str, Meta(description="Direction of the record that is +x: a code, or an azimuth in degrees.")]}
"""First key of results of one direction."""

SHAKING_KEY = Annotated[BodyShaking, Meta(description="Shaking of the motion, and the time above the threshold of the body.")]
"""Type of the key ``shaking`` of results of one direction."""


def entry_type(
    name: str,
    source: type,
    *,
    leading: Mapping[str, Any] | None = None,
    extra: Mapping[str, Any] | None = None,
    aliases: Mapping[str, str] | None = None,
    exclude: tuple[str, ...] = (),
    bases: tuple[type[Struct], ...] = (Result,),
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
    bases : tuple of type
        Empty for an entry inside a result.
    """
    hints = get_type_hints(source, include_extras=True)
    own_fields = {(aliases or {}).get(field.name, field.name): hints[field.name] for field in fields(source) if field.name not in exclude}
    declared: list[Any] = [
        (key, kind, msgspec.UNSET) if is_optional(kind) else (key, kind)
        for key, kind in {**(leading or {}), **own_fields, **(extra or {})}.items()
    ]
    result_type: Any = msgspec.defstruct(name, declared, bases=bases, frozen=True, kw_only=True, namespace={"__doc__": source.__doc__})
    return result_type  # type: ignore[no-any-return]


def outcome_type(name: str, outcome: type, *, extra: Mapping[str, Any] | None = None) -> type[Result]:
    """Return the struct type of a result of one direction: component, fields of the outcome, extra keys, shaking.

    Parameters
    ----------
    name : str
        Of the type, in the schema.
    outcome : dataclass
    extra : mapping of str to type
        As in :func:`entry_type`.
    """
    return entry_type(name, outcome, leading=COMPONENT_KEY, extra={**(extra or {}), "shaking": SHAKING_KEY})


def parameters_type(name: str, *kinds: type, extra: Mapping[str, Any] | None = None, exclude: tuple[str, ...] = ()) -> type[Struct]:
    """Return the struct type of the parameters of a command: one key per option of its body and its solver, then the extra keys.

    Parameters
    ----------
    name : str
        Of the type, in the schema.
    kinds : type
        Dataclasses of options.
    extra : mapping of str to type
        Keys after those of the options, or in place of one of the same name.
    exclude : tuple of str
        Options that are no keys.
    """
    keys: dict[str, Any] = {}
    for kind in kinds:
        hints = get_type_hints(kind)
        for field, spec, _ in option_fields(kind):
            if field not in exclude:
                shape = spec.document or hints[field]
                keys[document_key(field, spec)] = Annotated[shape, Meta(description=plain_help(spec.help))]
    result_type: Any = msgspec.defstruct(
        name, list((keys | dict(extra or {})).items()), frozen=True, kw_only=True, namespace={"__doc__": "Parameters of the command."}
    )
    return result_type  # type: ignore[no-any-return]


def to_parameters(kind: type[Struct], /, *sources: Any, **extra: Any) -> Struct:
    """Return the parameters of a command from objects with options and extra keys, which take precedence."""
    values: dict[str, Any] = {}
    for source in sources:
        for field, spec, _ in option_fields(type(source)):
            value = getattr(source, field)
            values[document_key(field, spec)] = spec.document(value) if spec.document and value is not None else value
    return kind(**{key: value for key, value in (values | extra).items() if key in kind.__struct_fields__})


def to_entry(kind: type[Result], source: Any, **extra: Any) -> Result:
    """Return an entry with the fields of a dataclass and extra keys."""
    keys = {field.name for field in fields(source)} & set(kind.__struct_fields__)
    return kind(**{key: getattr(source, key) for key in keys} | extra)


def to_outcome_entry(kind: type[Result], response: Response[Any], **extra: Any) -> tuple[Any, Result]:
    """Return the record of a response and its outcome as an entry with the component first and the shaking of its motion."""
    extra["shaking"] = response_shaking(response)
    return response.motion.record, to_entry(kind, response.outcome, component=response.motion.name, **extra)
