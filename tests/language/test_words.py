"""A text is said once, in English, and told in the language of whoever reads it."""

import copy
import json
import pickle
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from click.testing import CliRunner

from seisblock import words
from seisblock.cli import main
from seisblock.cli.language import asked_in
from seisblock.cli.talk import in_this_language
from seisblock.errors import BodyError, OutputError, RecordNotFoundError, SeisblockError
from seisblock.present.directions import side
from seisblock.words import Said, language, noted, plain_text, said, speaking, tell

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
    monkeypatch.setattr(words, "LOCALES", tmp_path)
    words._catalogue.cache_clear()
    with speaking("ja"):
        yield folder
    words._catalogue.cache_clear()


@pytest.mark.parametrize(
    ("environment", "asked", "expected"),
    [
        ({"LANG": "ja_JP.UTF-8"}, None, "ja"),
        ({"LC_ALL": "en_US.UTF-8", "LANG": "ja_JP.UTF-8"}, None, "en"),
        ({"LC_MESSAGES": "ja_JP", "LANG": "C"}, None, "ja"),
        ({"LANG": "C.UTF-8"}, "ja", "ja"),
        ({"LANG": "ja_JP.UTF-8"}, "en", "en"),
        ({}, None, "en"),
    ],
)
def test_language(environment, asked, expected, monkeypatch):
    """The option prevails, then LC_ALL, LC_MESSAGES, LANG."""
    for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert language(asked) == expected
    with speaking(asked):
        assert language() == expected


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
def test_a_command_line_says_its_language_before_it_is_parsed(line, expected):
    """So that its errors are told in it; what click will refuse asks for nothing."""
    assert asked_in(line) == expected


def test_what_was_said_is_english_until_it_is_told(japanese):
    """The text is a string that documents, comparisons and copies treat like any other, and that goes on knowing its template."""
    text = said("{name} falls", name="A")
    assert text == "A falls" and json.dumps([text]) == '["A falls"]' and str(text) == "A falls"
    assert tell(text) == tell("{name} falls", name="A") == "Aは転倒"
    for twin in (copy.deepcopy(text), pickle.loads(pickle.dumps(text))):
        assert isinstance(twin, Said) and twin == text and tell(twin) == "Aは転倒"


def test_a_text_inside_a_text_is_told_along_with_it(japanese):
    """Values keep their format; texts that were said are translated, those that were not stay; lists are listed."""
    inner = said("{name} falls", name=noted("stone"))
    assert tell("{name}, after {time:.2f} s: {what}", name=("stone", tell("stone")), time=1.234, what=inner) == (
        "1.23 秒後 stone、墓石：stoneは転倒"
    )


def test_what_no_catalogue_holds_stays(japanese):
    """An unknown template is filled in all the same; braces without values are no fields; nothing is nothing."""
    assert tell("{name} stands", name="A") == "A stands" and tell("{x}") == "{x}" and tell("") == ""
    assert tell("not translated yet") == "not translated yet"


def test_compiled_and_written_catalogues_agree(japanese):
    """A tree without compiled catalogues speaks as an installation does; the newer of the two counts."""
    texts = ["{name} falls", "{name}, after {time:.2f} s: {what}", "stone", "not translated yet", "unknown", ""]
    written = [words._catalogue("ja")(text) for text in texts]
    with (japanese / "seisblock.po").open("rb") as source, (japanese / "seisblock.mo").open("wb") as target:
        write_mo(target, read_po(source))
    (japanese / "seisblock.po").unlink()
    words._catalogue.cache_clear()
    assert [words._catalogue("ja")(text) for text in texts] == written


def test_the_languages_bundled_are_read_alike_by_babel():
    """The small reader of written catalogues finds in ours what babel finds."""
    path = words.LOCALES / "ja" / "LC_MESSAGES" / "seisblock.po"
    with path.open("rb") as stream:
        expected = {m.id: m.string for m in read_po(stream) if m.id and m.string and isinstance(m.id, str)}
    assert dict(words._read(path)) == expected


def test_errors_remember_what_they_said(japanese):
    """The message is English for a traceback, told by the command line, and survives the way to another process."""
    error = RecordNotFoundError("{name} falls", name="A")
    assert isinstance(error, FileNotFoundError) and str(error) == "A falls" and tell(error.said) == "Aは転倒"
    assert tell(pickle.loads(pickle.dumps(error)).said) == "Aは転倒"
    outer = BodyError("{name}, after {time:.2f} s: {what}", name="B", time=2.0, what=error.said)
    assert tell(outer.said) == "2.00 秒後 B：Aは転倒" and str(outer) == "B, after 2.00 s: A falls"
    assert str(OutputError("a {brace} of a file name")) == "a {brace} of a file name"
    assert all(issubclass(kind, SeisblockError) for kind in (BodyError, OutputError))


def test_texts_of_files_cannot_command_a_terminal():
    """R16: control characters in names and headers are spelt out, wherever such a text is filled in; letters of all scripts stay."""
    hostile = "KMM\x1b]0;owned\x07\x9b31m\r"
    assert plain_text(hostile) == "KMM\\x1b]0;owned\\x07\\x9b31m\\r"
    assert plain_text("熊本 μ ² é") == "熊本 μ ² é" and plain_text("two\nlines") == "two\nlines"
    assert said("{name}: {names}", name=hostile, names=[hostile]).isprintable()
    assert str(BodyError("{name}", name=hostile)).isprintable()


def test_errors_of_a_command_line_are_harmless_on_a_terminal():
    """A name with escapes in it comes back spelt out."""
    answer = CliRunner().invoke(main, ["measure", "no\x1b[31mfile"])
    assert answer.exit_code == 3 and "\x1b" not in answer.stderr and "\\x1b[31m" in answer.stderr


def test_english_loads_no_catalogue():
    """The start costs nothing: gettext's catalogues are opened when another language is spoken."""
    words._catalogue.cache_clear()
    with speaking("en"):
        tell("{name} falls", name="A")
    assert words._catalogue.cache_info().currsize == 0


def test_the_language_ends_with_its_block_and_its_command():
    """A command line in Japanese leaves nothing behind, not even in click's own words."""
    import gettext
    import os

    before = (language(), gettext.textdomain(), os.environ.get("LANGUAGE"))
    assert CliRunner().invoke(main, ["--lang", "ja", "--help"]).exit_code == 0
    assert (language(), gettext.textdomain(), os.environ.get("LANGUAGE")) == before
    english = CliRunner().invoke(main, ["slide", "--help"]).stdout
    assert "Show this message and exit." in english


def test_the_catalogue_is_where_the_package_says():
    """The file that translators edit."""
    assert Path(words.LOCALES, "ja", "LC_MESSAGES", "seisblock.po").is_file()


@pytest.mark.parametrize(
    ("direction", "sentence"),
    [("30", "25.90 秒に方位 30° 側へ転倒"), ("EW", "25.90 秒に +EW 側へ転倒")],
)
def test_a_blank_parts_japanese_from_latin_letters_only(direction, sentence):
    """The same template takes an azimuth, whose name is Japanese, without a blank before it, and a component with one."""
    with speaking("ja"):
        assert tell("overturns to {side} at {time:.2f} s", side=side(direction, 1.0), time=25.9) == sentence
        assert tell("{path} to {towards}", path="石", towards=side(direction, 1.0)).endswith("へ石")
        assert tell("{a} {b}", a="益城", b="宮園") == "益城 宮園", "blanks of a name, and between two values, stay"


@pytest.mark.parametrize(
    ("text", "values", "sentence"),
    [
        ("  both, in flight (s)", {}, "  両方同時、跳躍 (s)"),
        ("{time:.2f} s in the air", {"time": 35.46}, "合計 35.46 秒間浮く"),
        ("{time:.2f} s in the air, the first", {"time": 35.46}, "最初に浮く、合計 35.46 秒間"),
    ],
)
def test_what_was_once_said_wrongly_in_japanese(text, values, sentence):
    """Sliding while it rocks is not part of the flight; how long a corner is in the air is not when it lifts."""
    with speaking("ja"):
        assert tell(text, **values) == sentence


def test_what_another_thread_says_is_in_the_language_of_the_command():
    """Kernels are compiled in threads that know nothing of ``--lang``."""
    with speaking("ja"):
        told = in_this_language()
    with ThreadPoolExecutor(1) as pool:
        assert pool.submit(told, said("stands still")).result() == "動かない"
