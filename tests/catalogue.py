"""Catalogues of translations: extraction of messages from the source by babel, and update of the ``.po`` files.

``python -m tests.catalogue`` brings them up to date: new messages are added without a translation, removed ones dropped, and untranslated
ones listed.
"""

import ast
import builtins
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import click
from babel.messages.catalog import Catalog
from babel.messages.extract import extract_from_dir
from babel.messages.pofile import read_po, write_po

import seisblock
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.cli import COMMANDS, main
from seisblock.cli.help import paragraphs
from seisblock.core.i18n import LANGUAGES, LOCALE_DIR, Message
from seisblock.samples import list_samples, sample_directory
from seisblock.validation import cases

PACKAGE = Path(seisblock.__file__).parent
GETTEXT_FUNCTIONS = {"lazy_gettext", "gettext", "N_", "info", "warning", "always", "progress", "set_task", "error", "line_error", "qc_flag"}
CHECK_FUNCTIONS = {"finite", "positive", "non_negative", "in_interval", "fraction", "function", "float_array", "float_vector", "integer"}
"""Functions whose first argument is a message; so is that of the error classes of the package and of the checks of numbers."""

CLICK_MESSAGES = (
    "Error: {message}",
    "Usage:",
    "Try '{command} {option}' for help.",
    "Aborted!",
    "Invalid value for {param_hint}: {message}",
    "Invalid value: {message}",
    "Missing argument",
    "Missing command.",
    "Missing option",
    "Missing parameter",
    "No such command {name!r}.",
    "No such option {name!r}.",
    "Option {name!r} does not take a value.",
    "Show this message and exit.",
    "default: {default}",
    "required",
    "file",
    "directory",
    "path",
    "{name} {filename!r} does not exist.",
    "{name} {filename!r} is a directory.",
    "{name} {filename!r} is a file.",
    "{name} {filename!r} is not readable.",
    "{name} {filename!r} is not writable.",
    "{value!r} is not a valid {number_type}.",
    "{value!r} is not a valid boolean. Recognized values: {states}",
    "{value} is not in the range {range}.",
    "Choose from:\n\t{choices}",
    "Got unexpected extra argument ({args})",
    "Takes {nargs} values but 1 was given.",
    "Did you mean {possibility}?",
    "{value!r} is not {choice}.",
    "Option {name!r} requires an argument.",
)
"""Messages of click, which it passes to gettext; the singular where there are two forms."""

PLURALS = {
    "Got unexpected extra argument ({args})": "Got unexpected extra arguments ({args})",
    "Takes {nargs} values but 1 was given.": "Takes {nargs} values but {len} were given.",
    "Did you mean {possibility}?": "(Did you mean one of: {possibilities}?)",
    "{value!r} is not {choice}.": "{value!r} is not one of {choices}.",
    "Option {name!r} requires an argument.": "Option {name!r} requires {nargs} arguments.",
}
"""Plural forms of these messages."""

WIDTH = 120


def extract_messages(stream, keywords, comment_tags, options) -> Iterator[tuple[int, str, str, list[str]]]:
    """Yield the messages of a Python file as a method of babel, with nested calls, multi-line texts and texts assigned to a name before."""
    tree = ast.parse(stream.read())
    assignments = [node for node in ast.walk(tree) if isinstance(node, ast.Assign)]
    for node, argument in message_calls(tree):
        if isinstance(argument, ast.Name):
            values = [a.value for a in assignments if argument.id in (getattr(target, "id", "") for target in a.targets)]
            yield from ((node.lineno, "", text, []) for value in values for text in message_literals(value))
        yield from ((node.lineno, "", text, []) for text in message_literals(argument))


def message_calls(tree: ast.AST) -> Iterator[tuple[ast.Call, ast.expr]]:
    """Yield the calls that take a message, and the argument with it."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and node.args:
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if name in GETTEXT_FUNCTIONS | CHECK_FUNCTIONS or (name.endswith("Error") and not hasattr(builtins, name)):
                yield node, node.args[0]
            elif name == "map" and getattr(node.args[0], "id", "") in GETTEXT_FUNCTIONS:
                yield node, node.args[1]


def message_literals(node: ast.expr) -> Iterator[str]:
    """Yield the possible texts of an argument: a literal, both branches of a conditional, or the items of a tuple."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value:
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from message_literals(node.body)
        yield from message_literals(node.orelse)
    elif isinstance(node, (ast.Tuple, ast.BoolOp)):
        for part in node.elts if isinstance(node, ast.Tuple) else node.values:
            yield from message_literals(part)


def source_messages() -> dict[str, str]:
    """Return every message of the package with its first occurrence."""
    messages: dict[str, str] = {}
    methods = [("**.py", extract_messages), ("**/templates/**.html", "jinja2")]
    # babel's own filter leaves out a folder whose name begins with _
    extracted = extract_from_dir(
        PACKAGE, methods, keywords={"gettext": None}, directory_filter=lambda folder: Path(folder).name != "__pycache__"
    )
    for name, _, text, _, _ in extracted:
        if isinstance(text, str) and re.search(r"\w", text):
            messages.setdefault(text, name)
    return messages


def help_messages() -> dict[str, str]:
    """Return every text of ``--help`` with its command: summary lines and paragraphs of commands, arguments and options."""
    messages: dict[str, str] = {}
    context = click.Context(main)
    for name in ("", *COMMANDS):
        command = main.get_command(context, name) if name else main
        texts = [*paragraphs(command.help or ""), *((COMMANDS[name],) if name else ())]
        helps = (getattr(parameter, "help", None) for parameter in command.params)
        texts += [text for text in helps if text and not isinstance(text, Message)]  # templates are among the texts of the source
        messages |= {text: f"help of seisblock {name}".strip() for text in texts if text and text not in messages}
    return messages


def sample_messages() -> dict[str, str]:
    """Return names, descriptions, terms and origins of the bundled files, and names of their parts."""
    messages = {text: sample.name for sample in list_samples() for text in (sample.description, sample.licence, sample.origin)}
    for path in sorted(sample_directory().glob("*.toml")):
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        parts = [table, *table.get("stone", ()), *table.get("stones", ())]
        messages |= {part["name"]: path.name for part in parts if "name" in part}
    cemeteries = [sample.name for sample in list_samples() if sample.kind == "cemetery"]
    messages |= {read_cemetery(name).notes[0]: name for name in cemeteries}
    return messages | dict.fromkeys((sample.kind for sample in list_samples()), "MANIFEST.toml")


def validation_messages() -> dict[str, str]:
    """Return quantities and notes of the validation cases."""
    return {text: f"validation of {case.paper}" for case in cases() for text in (case.quantity, case.note) if text}


def all_messages() -> dict[str, str]:
    """Return every message of a catalogue with its first occurrence."""
    return dict.fromkeys(CLICK_MESSAGES, "click") | validation_messages() | source_messages() | help_messages() | sample_messages()


def catalogue_path(language: str) -> Path:
    """Return the file of a catalogue."""
    return LOCALE_DIR / language / "LC_MESSAGES" / "seisblock.po"


def read_catalogue(language: str) -> Catalog:
    """Return the catalogue of a language."""
    with catalogue_path(language).open("rb") as stream:
        return read_po(stream, locale=language)


def refresh(language: str) -> list[str]:
    """Bring a catalogue up to date; return the messages without a translation."""
    old, path = read_catalogue(language), catalogue_path(language)
    fresh = Catalog(locale=language, project="seisblock", charset="utf-8", fuzzy=False, header_comment=old.header_comment)
    for text, place in sorted(all_messages().items(), key=lambda pair: (pair[1], pair[0])):
        entry = old.get(text)
        fresh.add((text, PLURALS[text]) if text in PLURALS else text, entry.string if entry else "", auto_comments=[place])
    with path.open("wb") as stream:
        write_po(stream, fresh, width=WIDTH, omit_header=False, ignore_obsolete=True)
    text = re.sub(
        r'^"(POT-Creation-Date|PO-Revision-Date|Generated-By|Last-Translator|Language-Team|Report-Msgid-Bugs-To).*\n',
        "",
        path.read_text(encoding="utf-8"),
        flags=re.MULTILINE,
    )
    path.write_text(text, encoding="utf-8")
    return [message_key(message) for message in fresh if message.id and not any(message.string)]


def message_key(message) -> str:
    """Return the singular of a message."""
    return message.id if isinstance(message.id, str) else message.id[0]


if __name__ == "__main__":
    for language in LANGUAGES[1:]:
        untranslated = refresh(language)
        print(f"{language}: {len(untranslated)} texts without a translation", *untranslated, sep="\n  ")
