"""Messages are English templates, translated where they are shown."""

import copy
import json
import pickle
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.cli.console import bind_locale
from seisblock.cli.locale import requested_locale
from seisblock.core import i18n
from seisblock.core.errors import BodyError, OutputError, RecordNotFoundError, SeisblockError
from seisblock.core.i18n import N_, Message, escape_control, get_locale, gettext, join_clauses, lazy_gettext, use_locale
from seisblock.output.directions import direction_label

PO = """
msgid ""
msgstr "Language: ja\\n"

#. a comment
msgid "{name} falls"
msgstr "{name}は転倒"

msgid "{name}, after {time:.2f} s: "
"{what}"
msgstr ""
"{time:.2f} 秒後 "
"{name}：{what}"

msgid "stone"
msgstr "墓石"

msgid "{n} stone"
msgid_plural "{n} stones"
msgstr[0] "{n} 個"

msgid "not translated yet"
msgstr ""
"""


@pytest.fixture
def japanese(tmp_path, monkeypatch):
    """A catalogue of its own, as it is written."""
    folder = tmp_path / "ja" / "LC_MESSAGES"
    folder.mkdir(parents=True)
    (folder / "seisblock.po").write_text(PO, encoding="utf-8")
    monkeypatch.setattr(i18n, "LOCALE_DIR", tmp_path)
    i18n._load_catalogue.cache_clear()
    with use_locale("ja"):
        yield folder
    i18n._load_catalogue.cache_clear()


@pytest.mark.parametrize(
    ("environment", "option", "expected"),
    [
        ({"LANG": "ja_JP.UTF-8"}, None, "ja"),
        ({"LC_ALL": "en_US.UTF-8", "LANG": "ja_JP.UTF-8"}, None, "en"),
        ({"LC_MESSAGES": "ja_JP", "LANG": "C"}, None, "ja"),
        ({"LANG": "C.UTF-8"}, "ja", "ja"),
        ({"LANG": "ja_JP.UTF-8"}, "en", "en"),
        ({}, None, "en"),
    ],
)
def test_locale_option_precedes_environment(environment, option, expected, monkeypatch):
    """The option prevails, then LC_ALL, LC_MESSAGES, LANG."""
    for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert get_locale(option) == expected
    with use_locale(option):
        assert get_locale() == expected


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ([], None),
        (["slide"], None),
        (["--lang", "ja"], "ja"),
        (["slide", "--lang=ja"], "ja"),
        (["slide", "--lang"], None),
        (["--lang", "xx"], None),
    ],
)
def test_lang_option_is_read_before_parsing(line, expected):
    """The language is set before errors; click's own errors need no setting."""
    assert requested_locale(line) == expected


def test_message_is_english_until_translated(japanese):
    """The text is a string that documents, comparisons and copies treat like any other, and that goes on knowing its template."""
    text = lazy_gettext("{name} falls", name="A")
    assert text == "A falls" and json.dumps([text]) == '["A falls"]' and str(text) == "A falls"
    assert gettext(text) == gettext("{name} falls", name="A") == "Aは転倒"
    for twin in (copy.deepcopy(text), pickle.loads(pickle.dumps(text))):
        assert isinstance(twin, Message) and twin == text and gettext(twin) == "Aは転倒"


def test_nested_messages_are_translated(japanese):
    """Values keep their format; messages among them are translated, other texts are not; lists are joined."""
    inner = lazy_gettext("{name} falls", name=N_("stone"))
    assert gettext("{name}, after {time:.2f} s: {what}", name=("stone", gettext("stone")), time=1.234, what=inner) == (
        "1.23 秒後 stone、墓石：stoneは転倒"
    )


def test_unknown_message_stays_english(japanese):
    """An unknown template is filled in all the same; braces without values are no fields; nothing is nothing."""
    assert gettext("{name} stands", name="A") == "A stands" and gettext("{x}") == "{x}" and gettext("") == ""
    assert gettext("not translated yet") == "not translated yet"


def test_compiled_and_source_catalogues_agree(japanese):
    """A tree without compiled catalogues uses the ``.po`` files; the newer of the two applies."""
    texts = ["{name} falls", "{name}, after {time:.2f} s: {what}", "stone", "not translated yet", "unknown", ""]
    items = [i18n._load_catalogue("ja")(text) for text in texts]
    with (japanese / "seisblock.po").open("rb") as source, (japanese / "seisblock.mo").open("wb") as target:
        write_mo(target, read_po(source))
    (japanese / "seisblock.po").unlink()
    i18n._load_catalogue.cache_clear()
    assert [i18n._load_catalogue("ja")(text) for text in texts] == items


def test_catalogue_reader_equals_babel():
    """The small reader of written catalogues finds in ours what babel finds."""
    path = i18n.LOCALE_DIR / "ja" / "LC_MESSAGES" / "seisblock.po"
    with path.open("rb") as stream:
        expected = {m.id: m.string for m in read_po(stream) if m.id and m.string and isinstance(m.id, str)}
    assert dict(i18n._read_po(path)) == expected


def test_errors_are_translatable_and_picklable(japanese):
    """The message is English in a traceback, translated by the command line, and survives pickling."""
    error = RecordNotFoundError("{name} falls", name="A")
    assert isinstance(error, FileNotFoundError) and str(error) == "A falls" and gettext(error.message) == "Aは転倒"
    assert gettext(pickle.loads(pickle.dumps(error)).message) == "Aは転倒"
    outer = BodyError("{name}, after {time:.2f} s: {what}", name="B", time=2.0, what=error.message)
    assert gettext(outer.message) == "2.00 秒後 B：Aは転倒" and str(outer) == "B, after 2.00 s: A falls"
    assert str(OutputError("a {brace} of a file name")) == "a {brace} of a file name"
    assert all(issubclass(kind, SeisblockError) for kind in (BodyError, OutputError))


def test_messages_escape_control_characters():
    """R16: control characters in names and headers are spelt out, wherever such a text is filled in; letters of all scripts stay."""
    hostile = "KMM\x1b]0;owned\x07\x9b31m\r"
    assert escape_control(hostile) == "KMM\\x1b]0;owned\\x07\\x9b31m\\r"
    assert escape_control("熊本 μ ² é") == "熊本 μ ² é" and escape_control("two\nlines") == "two\nlines"
    assert lazy_gettext("{name}: {names}", name=hostile, names=[hostile]).isprintable()
    assert str(BodyError("{name}", name=hostile)).isprintable()


def test_command_line_errors_escape_control_characters():
    """A name with escapes in it comes back spelt out."""
    answer = CliRunner().invoke(main, ["measure", "no\x1b[31mfile"])
    assert answer.exit_code == 3 and "\x1b" not in answer.stderr and "\\x1b[31m" in answer.stderr


def test_english_locale_loads_no_catalogue():
    """The start costs nothing: gettext's catalogues are opened when another language is spoken."""
    i18n._load_catalogue.cache_clear()
    with use_locale("en"):
        gettext("{name} falls", name="A")
    assert i18n._load_catalogue.cache_info().currsize == 0


def test_use_locale_is_restored_after_block_and_command():
    """A command line in Japanese leaves nothing behind, not even in click's own words."""
    import gettext
    import os

    before = (get_locale(), gettext.textdomain(), os.environ.get("LANGUAGE"))
    assert CliRunner().invoke(main, ["--lang", "ja", "--help"]).exit_code == 0
    assert (get_locale(), gettext.textdomain(), os.environ.get("LANGUAGE")) == before
    english = CliRunner().invoke(main, ["slide", "--help"]).stdout
    assert "Show this message and exit." in english


def test_catalogue_path_exists():
    """The file that translators edit."""
    assert Path(i18n.LOCALE_DIR, "ja", "LC_MESSAGES", "seisblock.po").is_file()


@pytest.mark.parametrize(
    ("direction", "sentence"),
    [("30", "25.90 秒に方位 30° 側へ転倒"), ("EW", "25.90 秒に +EW 側へ転倒")],
)
def test_japanese_spacing_beside_latin_letters(direction, sentence):
    """The same template takes an azimuth, whose name is Japanese, without a blank before it, and a component with one."""
    with use_locale("ja"):
        assert gettext("overturns to {side} at {time:.2f} s", side=direction_label(direction, 1.0), time=25.9) == sentence
        assert gettext("{path} to {towards}", path="石", towards=direction_label(direction, 1.0)).startswith("石（")
        assert gettext("{a} {b}", a="益城", b="宮園") == "益城 宮園", "blanks of a name, and between two values, stay"


@pytest.mark.parametrize(
    ("text", "values", "sentence"),
    [
        ("  slide-rock, flight (s)", {}, "  滑動ロッキング、空中 (s)"),
        ("uplift {time:.2f} s", {"time": 35.46}, "浮き上がり 35.46 秒間"),
        ("uplift {time:.2f} s (first)", {"time": 35.46}, "浮き上がり 35.46 秒間（最初）"),
    ],
)
def test_japanese_translations_corrected_earlier(text, values, sentence):
    """Sliding while it rocks is not part of the flight; how long a corner is in the air is not when it lifts."""
    with use_locale("ja"):
        assert gettext(text, **values) == sentence


@pytest.mark.parametrize(("lang", "text"), [("en", "scaled by 0.2; window 1:2 s extracted"), ("ja", "0.2 倍、時間範囲 1:2 秒を切り出し")])
def test_join_clauses_uses_the_separator_of_the_language(lang, text):
    """The steps of a processing history have no semicolon in Japanese."""
    with use_locale(lang):
        assert join_clauses(text.replace("; ", "、").split("、")) == text


def test_threads_use_locale_of_command():
    """Kernels are compiled in threads that know nothing of ``--lang``."""
    with use_locale("ja"):
        text = bind_locale()
    with ThreadPoolExecutor(1) as pool:
        assert pool.submit(text, lazy_gettext("no motion")).result() == "静止"
