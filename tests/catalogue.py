"""The catalogues of translations: what the source says, gathered by babel, beside what they hold.

``python tests/catalogue.py`` brings them up to date: it adds what is new, without a translation, drops what is no longer said, and lists
what waits for a translator.
"""

import ast
import inspect
import io
import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import click
from babel.messages.catalog import Catalog
from babel.messages.extract import extract, extract_from_dir
from babel.messages.pofile import read_po, write_po

import seisblock
from seisblock.cli import COMMANDS, main
from seisblock.cli.help import paragraphs
from seisblock.samples import list_samples, sample_directory
from seisblock.words import LANGUAGES, LOCALES

PACKAGE = Path(seisblock.__file__).parent
SAYING = {"said", "tell", "noted", "say", "warn", "progress", "UsageError", "BadParameter", "fail"}
CHECKS = {"finite", "positive", "not_negative", "within", "fraction"}
"""Functions whose first argument is a text for people; so is that of every error, and of every check of a number."""

WIDTH = 120


def texts_of(stream, keywords, comment_tags, options) -> Iterator[tuple[int, str, str, list[str]]]:
    """Yield what a Python file says, as a method of babel's: calls inside calls, and texts over several lines."""
    for node in ast.walk(ast.parse(stream.read())):
        if isinstance(node, ast.Call) and node.args:
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if name in SAYING | CHECKS or name.endswith("Error"):
                yield from ((node.lineno, "", text, []) for text in _constants(node.args[0]))
            elif name == "map" and getattr(node.args[0], "id", "") in SAYING:
                yield from ((node.lineno, "", text, []) for text in _constants(node.args[1]))


def _constants(node: ast.expr) -> Iterator[str]:
    """Yield the texts that an argument may be: one, either branch of a choice, or the members of a row."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from _constants(node.body)
        yield from _constants(node.orelse)
    elif isinstance(node, ast.Tuple):
        for part in node.elts:
            yield from _constants(part)


def said_in_source() -> dict[str, str]:
    """Return every text of the package: template and the place where it stands first."""
    found: dict[str, str] = {}
    methods = [("**.py", texts_of), ("**/templates/**.html", "jinja2")]
    for name, _, text, _, _ in extract_from_dir(PACKAGE, methods, keywords={"tell": None}):
        if isinstance(text, str) and re.search(r"\w", text):
            found.setdefault(text, name)
    return found


def said_in_help() -> dict[str, str]:
    """Return every text of ``--help``: lines and paragraphs of commands and of their options."""
    found: dict[str, str] = {}
    context = click.Context(main)
    for name in ("", *COMMANDS):
        command = main.get_command(context, name) if name else main
        texts = [*paragraphs(command.help or ""), *(COMMANDS[name][1:] if name else ())]
        texts += [option.help for option in command.params if isinstance(option, click.Option)]
        found |= {text: f"help of seisblock {name}".strip() for text in texts if text and text not in found}
    return found


def said_in_samples() -> dict[str, str]:
    """Return what the bundled files call themselves and their parts, and how the list of samples describes them."""
    found = {sample.description: sample.name for sample in list_samples()}
    for path in sorted(sample_directory().glob("*.toml")):
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        parts = [table, *table.get("stone", ()), *table.get("stones", ())]
        found |= {part["name"]: path.name for part in parts if "name" in part}
    return found | dict.fromkeys((sample.kind for sample in list_samples()), "MANIFEST.toml")


def said_by_click() -> set[str]:
    """Return the texts that click itself may say."""
    found: set[str] = set()
    for module in ("core", "exceptions", "formatting", "decorators", "types", "parser"):
        source = inspect.getsource(sys.modules[f"click.{module}"]).encode()
        for _, text, _, _ in extract("python", io.BytesIO(source), keywords={"_": None, "ngettext": (1, 2)}):
            found.add(text if isinstance(text, str) else text[0])
    return found


def path_of(language: str) -> Path:
    """Return the file of a catalogue."""
    return LOCALES / language / "LC_MESSAGES" / "seisblock.po"


def catalogue(language: str) -> Catalog:
    """Return a catalogue as it is written."""
    with path_of(language).open("rb") as stream:
        return read_po(stream, locale=language)


def refresh(language: str) -> list[str]:
    """Bring a catalogue up to date; return what has no translation."""
    held, path = catalogue(language), path_of(language)
    fresh = Catalog(locale=language, project="seisblock", charset="utf-8", fuzzy=False, header_comment=held.header_comment)
    clicks = said_by_click()
    kept = [message for message in held if message.id and _key(message) in clicks]
    for text, place in sorted((said_in_source() | said_in_help() | said_in_samples()).items(), key=lambda pair: (pair[1], pair[0])):
        known = held.get(text)
        fresh.add(text, known.string if known else "", auto_comments=[place])
    for message in kept:
        fresh.add(message.id, message.string, auto_comments=["click"])
    with path.open("wb") as stream:
        write_po(stream, fresh, width=WIDTH, omit_header=False, ignore_obsolete=True)
    text = re.sub(
        r'^"(POT-Creation-Date|PO-Revision-Date|Generated-By|Last-Translator|Language-Team|Report-Msgid-Bugs-To).*\n',
        "",
        path.read_text(encoding="utf-8"),
        flags=re.MULTILINE,
    )
    path.write_text(text, encoding="utf-8")
    return [message.id for message in fresh if message.id and not message.string]


def _key(message) -> str:
    """Return the singular of a message."""
    return message.id if isinstance(message.id, str) else message.id[0]


if __name__ == "__main__":
    for spoken in LANGUAGES[1:]:
        waiting = refresh(spoken)
        print(f"{spoken}: {len(waiting)} texts without a translation", *waiting, sep="\n  ")
