"""The catalogues of translations: what the source says, gathered by babel, beside what they hold.

``python tests/catalogue.py`` brings them up to date: it adds what is new, without a translation, drops what is no longer said, and lists
what waits for a translator.
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
from seisblock.core.i18n import LANGUAGES, LOCALE_DIR
from seisblock.samples import list_samples, sample_directory
from seisblock.validation import cases

PACKAGE = Path(seisblock.__file__).parent
GETTEXT_FUNCTIONS = {"lazy_gettext", "gettext", "N_", "info", "warning", "always", "progress", "set_task", "error", "line_error", "qc_flag"}
CHECK_FUNCTIONS = {"finite", "positive", "non_negative", "in_interval", "fraction", "function", "float_array", "float_vector", "integer"}
"""Functions whose first argument is a text for people; so is that of every error of ours, and of every check of a number."""

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
"""What click says to users of ours; it asks gettext, by the first of two forms where it counts."""

PLURALS = {
    "Got unexpected extra argument ({args})": "Got unexpected extra arguments ({args})",
    "Takes {nargs} values but 1 was given.": "Takes {nargs} values but {len} were given.",
    "Did you mean {possibility}?": "(Did you mean one of: {possibilities}?)",
    "{value!r} is not {choice}.": "{value!r} is not one of {choices}.",
    "Option {name!r} requires an argument.": "Option {name!r} requires {nargs} arguments.",
}
"""The second."""

WIDTH = 120


def extract_messages(stream, keywords, comment_tags, options) -> Iterator[tuple[int, str, str, list[str]]]:
    """Yield what a Python file says, as a method of babel's: calls inside calls, texts over several lines or put in a name before."""
    tree = ast.parse(stream.read())
    named = [node for node in ast.walk(tree) if isinstance(node, ast.Assign)]
    for node, argument in message_calls(tree):
        if isinstance(argument, ast.Name):
            put = [each.value for each in named if argument.id in (getattr(target, "id", "") for target in each.targets)]
            yield from ((node.lineno, "", text, []) for value in put for text in message_literals(value))
        yield from ((node.lineno, "", text, []) for text in message_literals(argument))


def message_calls(tree: ast.AST) -> Iterator[tuple[ast.Call, ast.expr]]:
    """Yield the calls that say something, and what they say."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and node.args:
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if name in GETTEXT_FUNCTIONS | CHECK_FUNCTIONS or (name.endswith("Error") and not hasattr(builtins, name)):
                yield node, node.args[0]
            elif name == "map" and getattr(node.args[0], "id", "") in GETTEXT_FUNCTIONS:
                yield node, node.args[1]


def message_literals(node: ast.expr) -> Iterator[str]:
    """Yield the texts that an argument may be: one, either branch of a choice, or the members of a row."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value:
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from message_literals(node.body)
        yield from message_literals(node.orelse)
    elif isinstance(node, (ast.Tuple, ast.BoolOp)):
        for part in node.elts if isinstance(node, ast.Tuple) else node.values:
            yield from message_literals(part)


def source_messages() -> dict[str, str]:
    """Return every text of the package: template and the place where it stands first."""
    found: dict[str, str] = {}
    methods = [("**.py", extract_messages), ("**/templates/**.html", "jinja2")]
    # babel's own filter leaves out a folder whose name begins with _
    found_in = extract_from_dir(
        PACKAGE, methods, keywords={"gettext": None}, directory_filter=lambda folder: Path(folder).name != "__pycache__"
    )
    for name, _, text, _, _ in found_in:
        if isinstance(text, str) and re.search(r"\w", text):
            found.setdefault(text, name)
    return found


def help_messages() -> dict[str, str]:
    """Return every text of ``--help``: lines and paragraphs of commands, of their arguments and of their options."""
    found: dict[str, str] = {}
    context = click.Context(main)
    for name in ("", *COMMANDS):
        command = main.get_command(context, name) if name else main
        texts = [*paragraphs(command.help or ""), *((COMMANDS[name],) if name else ())]
        texts += [each.help for each in command.params if getattr(each, "help", None)]
        found |= {text: f"help of seisblock {name}".strip() for text in texts if text and text not in found}
    return found


def sample_messages() -> dict[str, str]:
    """Return what the bundled files call themselves and their parts, and how the list of samples describes them."""
    found = {sample.description: sample.name for sample in list_samples()}
    for path in sorted(sample_directory().glob("*.toml")):
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        parts = [table, *table.get("stone", ()), *table.get("stones", ())]
        found |= {part["name"]: path.name for part in parts if "name" in part}
    cemeteries = [sample.name for sample in list_samples() if sample.kind == "cemetery"]
    found |= {read_cemetery(name).notes[0]: name for name in cemeteries}
    return found | dict.fromkeys((sample.kind for sample in list_samples()), "MANIFEST.toml")


def validation_messages() -> dict[str, str]:
    """Return what the cases of validation compare, and the notes on them."""
    return {text: f"validation of {case.paper}" for case in cases() for text in (case.quantity, case.note) if text}


def all_messages() -> dict[str, str]:
    """Return every text that a catalogue holds: template and the place where it stands first."""
    return dict.fromkeys(CLICK_MESSAGES, "click") | validation_messages() | source_messages() | help_messages() | sample_messages()


def catalogue_path(language: str) -> Path:
    """Return the file of a catalogue."""
    return LOCALE_DIR / language / "LC_MESSAGES" / "seisblock.po"


def read_catalogue(language: str) -> Catalog:
    """Return a catalogue as it is written."""
    with catalogue_path(language).open("rb") as stream:
        return read_po(stream, locale=language)


def refresh(language: str) -> list[str]:
    """Bring a catalogue up to date; return what has no translation."""
    held, path = read_catalogue(language), catalogue_path(language)
    fresh = Catalog(locale=language, project="seisblock", charset="utf-8", fuzzy=False, header_comment=held.header_comment)
    for text, place in sorted(all_messages().items(), key=lambda pair: (pair[1], pair[0])):
        known = held.get(text)
        fresh.add((text, PLURALS[text]) if text in PLURALS else text, known.string if known else "", auto_comments=[place])
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
    for spoken in LANGUAGES[1:]:
        waiting = refresh(spoken)
        print(f"{spoken}: {len(waiting)} texts without a translation", *waiting, sep="\n  ")
