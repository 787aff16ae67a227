"""Catalogues hold every text and nothing else; translations have the same fields."""

import ast
import re
from string import Formatter

import pytest

from seisblock.core.i18n import LANGUAGES, format_percent, gettext, lazy_gettext
from tests.catalogue import CHECK_FUNCTIONS, PACKAGE, PLURALS, all_messages, message_calls, message_key, message_literals, read_catalogue
from tests.trees import syntax_tree

TYPED = "10%"
"""What one types, where a blank would make two words of it."""

SOURCES = sorted(PACKAGE.rglob("*.py"))


@pytest.fixture(scope="module")
def every_text():
    """Every text that the source, the help, the samples and click say, and where it stands first."""
    return all_messages()


@pytest.fixture(scope="module", params=LANGUAGES[1:])
def entries(request):
    """A catalogue, by what it translates."""
    return {message_key(message): message for message in read_catalogue(request.param) if message.id}


def fields_of(text):
    """Return the fields of a template with their conversions and formats."""
    return {(name, conversion, form) for _, name, form, conversion in Formatter().parse(text) if name is not None}


def is_glued(argument):
    """Return whether a message is concatenated at its call."""
    texts = (node for node in ast.walk(argument) if isinstance(node, ast.Constant) and isinstance(node.value, str))
    return isinstance(argument, ast.JoinedStr) or (isinstance(argument, ast.BinOp) and any(texts))


def test_percentages_have_one_form(every_text, entries):
    """Templates and translations have a blank before the sign, or leave it to the format; no f-string writes its own."""
    items = [*every_text, *(str(message.string) for message in entries.values())]
    assert not [text for text in items if re.search(r"[\d}][%％]", text.replace(TYPED, "").replace("%}", "}"))]
    specs = (node for path in SOURCES for node in ast.walk(syntax_tree(path)) if isinstance(node, ast.FormattedValue))
    assert not [
        ast.unparse(node) for node in specs if node.format_spec is not None and ast.unparse(node.format_spec).rstrip("'\"").endswith("%")
    ]
    assert (gettext("{share:.0%}", share=0.043), format_percent(0.043, ".1"), format_percent(0.05, "g")) == ("4 %", "4.3 %", "5 %")


def test_every_message_is_translated(every_text, entries):
    """Missing, empty and fuzzy entries count alike: ``python -m tests.catalogue`` adds new ones."""
    missing = [
        f"{place}: {text}"
        for text, place in every_text.items()
        if text not in entries or not any(entries[text].string) or entries[text].fuzzy
    ]
    assert not missing, "\n".join(missing)


def test_catalogue_has_no_obsolete_entry(every_text, entries):
    """The catalogue holds no message that the source no longer has."""
    stale = set(entries) - set(every_text)
    assert not stale, "\n".join(sorted(stale))


def test_translations_keep_fields_and_formats(entries):
    """Fields, their conversions and their formats are those of the template: a number keeps its digits in every language."""
    for key, message in entries.items():
        strings = [message.string] if isinstance(message.string, str) else message.string
        for string in strings:
            assert fields_of(string) in (fields_of(key), fields_of(PLURALS.get(key, key))), key


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_messages_are_literal_templates_with_values(path):
    """Messages are literals, not assembled sentences, and each field has a value."""
    for call, argument in message_calls(syntax_tree(path)):
        place = f"{path.relative_to(PACKAGE)}, line {call.lineno}"
        assert not is_glued(argument), f"{place}: {ast.unparse(argument)} cannot be translated"
        function = getattr(call.func, "attr", getattr(call.func, "id", ""))
        mapping = {keyword.arg for keyword in call.keywords}
        if None in mapping or function in CHECK_FUNCTIONS | {"map", "N_"} or not mapping:
            continue
        expected = [{name for name, _, _ in fields_of(text)} for text in message_literals(argument)]
        assert all(fields <= mapping for fields in expected), f"{place}: a field without a value"
        assert not expected or mapping == set().union(*expected), f"{place}: a value without a field"


def test_message_rules_detect_violations():
    """A sentence glued together, a choice, a row and a nested text are found in a source."""
    source = """
text = "put {first} in a name"
lazy_gettext(text, first=lazy_gettext("and {second}", second=1))
raise BodyError("either" if x else "or")
map(gettext, ("this", "that"))
gettext(f"glued {name}")
warning("glued " + name)
progress(done + 1, every)
"""
    result = list(message_calls(ast.parse(source)))
    assert {text for _, argument in result for text in message_literals(argument)} == {"and {second}", "either", "or", "this", "that"}
    assert [ast.unparse(argument) for _, argument in result if is_glued(argument)] == ["f'glued {name}'", "'glued ' + name"]
    assert fields_of("{a!r} and {b:.2f}") == {("a", "r", ""), ("b", None, ".2f")}
    assert lazy_gettext(lazy_gettext("{a}", a=1)).template == "{a}"
