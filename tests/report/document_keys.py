"""The keys of every document as lines of text, and how they are written down: ``python -m tests.report.document_keys``."""

import sys
from pathlib import Path

from seisblock.report.json.registry import document_commands, document_schemas, json_schema

STORED = Path(__file__).with_name("keys")


def lines(command):
    """Return the name of a command's schema, then each key with its type; ``?`` marks one that may be missing."""
    schema = json_schema(command)
    roots = schema.get("anyOf", [schema])
    kinds = {}
    for root in roots:
        for path, kind in _walk({"$ref": root["$ref"]}, schema["$defs"], root["$ref"].rpartition("/")[2]):
            kinds.setdefault(path, []).append(kind)
    return [document_schemas(command)[0].schema, *(f"{path} {'|'.join(dict.fromkeys(item))}" for path, item in kinds.items())]


def _walk(shape, definitions, path):
    """Yield each path at and below one, with its type."""
    if "$ref" in shape:
        shape = definitions[shape["$ref"].rpartition("/")[2]]
    if "anyOf" in shape:
        # msgspec says null first or last, as its version likes
        for entry in sorted(shape["anyOf"], key=lambda item: item.get("type") == "null"):
            yield from _walk(entry, definitions, path)
        return
    kind = shape.get("type", "enum" if "enum" in shape else "anything")
    if kind == "array":
        items = [shape["items"]] if "items" in shape and shape["items"] is not False else shape.get("prefixItems", [])
        for entry in items:
            yield from _walk(entry, definitions, path + "[]")
    elif kind == "object":
        for key, entry in shape.get("properties", {}).items():
            optional = "" if key in shape.get("required", ()) else "?"
            yield from _walk(entry, definitions, f"{path}.{key}{optional}")
        if isinstance(shape.get("additionalProperties"), dict):
            yield from _walk(shape["additionalProperties"], definitions, path + "{}")
    else:
        yield path, kind


def stored_lines(command):
    """Return the lines written down; none when the command is new."""
    path = STORED / f"{command}.txt"
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


def missing_lines(command):
    """Return the lines written down that hold no longer, unless the version was stepped."""
    before, now = stored_lines(command), lines(command)
    return [] if not before or before[0] != now[0] else [line for line in before if line not in now]


def refresh():
    """Write the keys of every command down; refuse where one went or changed without a step of the version."""
    for command in document_commands():
        if missing_lines(command):
            sys.exit(
                f"{command}: raise the `version` of its DocumentSchema first; these went or changed: {'; '.join(missing_lines(command))}"
            )
        text = "\n".join(lines(command)) + "\n"
        STORED.mkdir(exist_ok=True)
        (STORED / f"{command}.txt").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    refresh()
