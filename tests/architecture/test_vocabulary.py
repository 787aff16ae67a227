"""Plain language: docstrings state facts, names are terms of the field, Japanese keeps its register."""

import ast
import re
from pathlib import Path

import pytest

import seisblock
from tests.catalogue import message_key, read_catalogue
from tests.trees import syntax_tree

PACKAGE = Path(seisblock.__file__).parent
ROOT = PACKAGE.parent
SOURCES = sorted(PACKAGE.rglob("*.py"))
TEST_SOURCES = sorted((ROOT / "tests").rglob("*.py"))
QUESTION = re.compile(r"(?:What|Where|How|Which|When|Whether|Why)\b")

BARE_WORDS = frozenset(
    [
        "found",
        "each",
        "told",
        "given",
        "whole",
        "held",
        "least",
        "shown",
        "asked",
        "made",
        "chosen",
        "kept",
        "own",
        "what",
        "known",
        "one",
        "other",
        "most",
        "named",
        "others",
        "some",
        "seen",
        "several",
        "written",
        "done",
        "turned",
        "wanted",
        "called",
        "mine",
        "both",
        "wrong",
        "drawn",
        "needed",
        "said",
        "answered",
        "meant",
        "noted",
        "gone",
        "taken",
        "judged",
        "spent",
        "lost",
        "here",
        "there",
        "where",
        "when",
        "who",
        "why",
        "which",
        "far",
        "near",
        "alone",
        "again",
        "many",
        "more",
        "much",
        "few",
        "every",
        "any",
        "dice",
        "spoken",
        "heard",
    ]
)
"""Participles, pronouns and adverbs that name nothing when they stand alone."""

MAX_BARE_NAMES = 0.008
"""Share of bound names; the codebases that serve as models have 0.0006 to 0.009."""

OLD_MODULES = [
    "words",
    "remarks",
    "showing",
    "contents",
    "ledger",
    "halt",
    "asked",
    "part",
    "seal",
    "talk",
    "manners",
    "meant",
    "offered",
    "idle",
    "emit",
    "doubts",
    "whereabouts",
    "given",
    "storey",
    "heap",
    "shelf",
    "gather",
    "cells",
    "naming",
    "moments",
    "decimals",
    "budget",
    "siblings",
    "places",
    "called",
    "roster",
    "sheet",
    "subjects",
    "spring_choice",
    "inset",
    "rocker",
    "setting",
    "settings",
    "aftermath",
    "tale",
    "stride",
    "lanes",
    "fates",
    "succession",
    "turning",
    "flat",
    "skid",
    "still",
    "following",
    "changes",
    "arguments",
    "contract",
    "apart",
    "meet",
    "remember",
    "lying",
    "strike",
    "floors",
    "books",
    "course",
    "sweeps",
    "agreement",
    "standing",
    "governing",
    "kept_lines",
    "followers",
    "notes",
    "proposal",
    "held_out",
    "plausible",
    "factors",
    "judgement",
    "faces",
    "page",
    "leftovers",
    "formulas",
    "rulers",
    "bars",
    "embed",
    "films",
    "onset",
    "falls",
    "elsewhere",
    "sweeping",
    "batching",
    "fragilities",
]

CONTACT_TERMS = ("separating axis", "warm start", "sleeping", "broad phase", "narrow phase", "manifold", "constraint")

USER_PHRASES = re.compile(
    r"\b(?:is|are) (?:told|said|asked|foretold)\b|\bwhoever\b|\bsomebody\b|\bnobody\b|without a word|\bplausible versions\b|\bas read\b"
    r"|out of sight|nothing for .* to do|of a careful reader"
)


def documented_nodes(sources=SOURCES):
    """Yield (place, docstring) of each module, class and function of the package, or of the tests."""
    for path in sources:
        for node in ast.walk(syntax_tree(path)):
            if isinstance(node, (ast.Module, ast.FunctionDef, ast.ClassDef)) and ast.get_docstring(node):
                yield f"{path.relative_to(ROOT).as_posix()}:{getattr(node, 'name', 'module')}", ast.get_docstring(node)


def bound_names(sources=SOURCES):
    """Yield every name that the package, or the tests, bind: variables, parameters, functions and classes."""
    for path in sources:
        for node in ast.walk(syntax_tree(path)):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                yield node.id
            elif isinstance(node, ast.arg):
                yield node.arg
            elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                yield node.name


@pytest.mark.parametrize("sources", [SOURCES, TEST_SOURCES], ids=["package", "tests"])
def test_docstrings_begin_with_a_fact(sources):
    """No first line of a docstring begins with an interrogative."""
    assert [place for place, text in documented_nodes(sources) if QUESTION.match(text)] == []


@pytest.mark.parametrize(("sources", "count"), [(SOURCES, 25_000), (TEST_SOURCES, 15_000)], ids=["package", "tests"])
def test_names_are_nouns_and_verbs(sources, count):
    """Participles, pronouns and adverbs alone are rare among bound names."""
    names = list(bound_names(sources))
    bare = [name for name in names if name.strip("_").lower() in BARE_WORDS]
    assert len(names) > count
    assert len(bare) / len(names) <= MAX_BARE_NAMES, sorted(set(bare))


def test_modules_have_standard_names():
    """None of the former module names is left."""
    stems = {path.stem for path in SOURCES}
    assert stems & set(OLD_MODULES) == set()


def test_contact_code_uses_the_terms_of_contact_dynamics():
    """A reader who searches for the standard terms finds the code."""
    text = " ".join(path.read_text(encoding="utf-8") for path in (PACKAGE / "models" / "stack").glob("*.py")).lower()
    text = re.sub(r"[-_]", " ", text)
    assert [term for term in CONTACT_TERMS if term not in text] == []


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"])
def test_pages_at_the_top_are_plain(name):
    """README, contributing page and changelog are free of the former phrases."""
    assert USER_PHRASES.findall((ROOT / name).read_text(encoding="utf-8")) == []


def test_user_texts_are_plain():
    """English messages and pages contain at most a handful of the former phrases."""
    messages = [message_key(message) for message in read_catalogue("ja") if message.id]
    pages = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs").rglob("*.md"))]
    phrases = [match[0] for text in (*messages, *pages) for match in USER_PHRASES.finditer(text)]
    assert len(phrases) <= 15, phrases


POLITE_END = re.compile(r"(?:です|ます|ません|でした|ました|でしょう|ください|ましょう)か?$")
"""End of a polite sentence."""

PLAIN_END = re.compile(r"(?:[うくぐすつぬぶむるただいず]|せよ)か?$")
"""End of a predicate in the plain register; noun phrases, values and quoted names end otherwise."""

BRACKETS = re.compile(r"（([^（）]*)）|\(([^()]*)\)|［([^［］]*)］|「([^「」]*)」")
"""A pair of brackets without another one inside."""


def japanese_sentences(text):
    """Return the sentences of a text that end with a full stop, those in brackets apart, with values replaced by an ellipsis."""
    plain, sentences = re.sub(r"\{[^}]*\}", "…", text), []
    while match := BRACKETS.search(plain):
        inside = next(group for group in match.groups() if group is not None)
        sentences += inside.split("。")[:-1]
        plain = plain[: match.start()] + plain[match.end() :]
    sentences += plain.split("。")[:-1]
    return [sentence.strip() for sentence in sentences if re.search(r"[\u3040-\u30ff\u4e00-\u9fff]", sentence)]


def is_polite(sentence):
    """Return whether a sentence ends in です・ます or is a noun phrase, that is, has no predicate in the plain register."""
    return bool(POLITE_END.search(sentence)) or not PLAIN_END.search(sentence)


def test_japanese_sentences_are_polite():
    """Sentences with a full stop end in です・ます, or are noun phrases that state a result."""
    plain = [
        (message_key(message), sentence)
        for message in read_catalogue("ja")
        if message.id
        for string in ([message.string] if isinstance(message.string, str) else message.string)
        for sentence in japanese_sentences(string)
        if not is_polite(sentence)
    ]
    assert plain == [], "\n".join(f"{key}: {sentence}" for key, sentence in plain[:40])


@pytest.mark.parametrize(
    ("text", "polite"),
    [
        ("ファイルを読み込めません。", True),
        ("もう一度指定してください。", True),
        ("{time:.2f} 秒に {side} へ転倒。", True),
        ("ロッキング（転倒しない）、{way}。", True),
        ("対応する形式：{known}。", True),
        ("滑動なし。", True),
        ("もう一度指定する。", False),
        ("ファイルを読み込めない（{why}）。", False),
        ("記録が短い。", False),
        ("ファイルは変更されていない。", False),
        ("2 回読み込んだ。", False),
        ("計算は収束せず。", False),
        ("値が負である。", False),
        ("無視する（--mu を使う。既定は 0.4）", False),
    ],
)
def test_register_rule_separates_polite_from_plain_sentences(text, polite):
    """The rule of the register sees both kinds, brackets and values at the end included."""
    (sentence,) = japanese_sentences(text)
    assert is_polite(sentence) == polite
    assert japanese_sentences("転倒確率 36 %") == []
