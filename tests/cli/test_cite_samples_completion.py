"""Papers of an answer, bundled files, and shell completion."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

import seisblock
from seisblock.cli import COMMANDS, main
from seisblock.references import REFERENCES, cited_commands, command_papers
from seisblock.samples import list_samples, sample_directory

OF_THE_PROGRAM = {"app", "validate", "paper", "cite", "samples", "completion", "report", "schema", "fetch"}
"""Commands whose answers rest on no paper of their own; those of a case or an item are in its document."""


def run(*words):
    """Run a command line in this process."""
    return CliRunner().invoke(main, [str(word) for word in words])


def test_cite_knows_every_solver_command():
    """`cite` knows every command but those of the program itself, and every key exists."""
    assert set(COMMANDS) - OF_THE_PROGRAM <= set(cited_commands())
    assert {key for name in cited_commands() for key in command_papers(name)} <= set(REFERENCES)


def test_cite_prints_text_bibtex_and_json():
    """Text names the paper and the program; BibTeX has balanced entries, one for every reference when no command is named."""
    assert "Explanation of jumping behavior" in " ".join(run("cite", "jump").stdout.split())
    entries = run("cite", "--bibtex").stdout
    assert entries.count("\n@") + 1 == len(REFERENCES) + 1
    assert entries.count("{") == entries.count("}")
    assert all(f"{{{key}," in entries for key in REFERENCES)
    names = [name for authors in re.findall(r"author = \{(.*)\},", entries) for name in authors.split(" and ")]
    assert [name for name in names if not re.fullmatch(r"[^,]+, [^,]+|\{.+\}|others", name)] == []
    assert [entry["key"] for entry in json.loads(run("cite", "jump", "--json").stdout)["results"]] == ["Sugimoto2017", "seisblock"]
    assert run("cite", "cook").exit_code == 2


def test_samples_lists_licence_origin_and_pga():
    """Every bundled file stands there with its licence, its origin and its PGA; in the document with SI and its digest."""
    text = run("samples").stdout
    assert "PGA NS 934, EW 962, UD 531 gal" in text and "NOT a recording" in text
    listed = json.loads(run("samples", "--json").stdout)["results"]
    assert [entry["name"] for entry in listed] == [sample.name for sample in list_samples()]
    for entry in listed:
        assert entry["licence"] and entry["origin"] and entry["name"] in text
    assert listed[0]["pga_m_s2"]["NS"] == pytest.approx(9.3398)


def test_samples_copy_is_identical_with_notice(tmp_path):
    """A directory gets all; it is made when missing, and a second copy changes nothing."""
    directory = tmp_path / "new" / "records"
    assert run("samples", "--copy", directory).exit_code == 0
    for sample in list_samples():
        assert hashlib.sha256((directory / sample.name).read_bytes()).hexdigest() == sample.sha256
    assert "MIT License" in (directory / "seisblock-samples-NOTICE.txt").read_text()
    repeat = run("samples", "--copy", directory)
    assert repeat.exit_code == 0 and "already" in repeat.stderr


def test_samples_copy_name_copies_sample_or_set(tmp_path, monkeypatch):
    """`--copy NAME` copies that sample, the whole set when the name is a stem."""
    monkeypatch.chdir(tmp_path)
    assert run("samples", "--copy", "synthetic_knet").exit_code == 0
    assert {path.name for path in tmp_path.glob("synthetic*")} == {f"synthetic_knet.{end}" for end in ("NS", "EW", "UD", "knt.tar.gz")}


def test_samples_copy_refuses_to_overwrite_without_option(tmp_path):
    """A file of other content is refused before anything is written; --overwrite replaces it."""
    computed = tmp_path / "synthetic_jma.csv"
    computed.write_text("my own")
    refused = run("samples", "--copy", tmp_path)
    assert refused.exit_code == 3 and "--overwrite" in refused.stderr
    assert computed.read_text() == "my own" and list(tmp_path.iterdir()) == [computed]
    assert run("samples", "--copy", tmp_path, "--overwrite").exit_code == 0
    assert computed.read_bytes() == (sample_directory() / "synthetic_jma.csv").read_bytes()
    assert run("samples", "--copy", computed).exit_code == 3
    assert run("samples", "nosuch").exit_code == 3


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_prints_script_per_shell(shell):
    """The script of each shell calls the program; its place is named on stderr."""
    answer = run("completion", shell)
    assert answer.exit_code == 0 and "_SEISBLOCK_COMPLETE" in answer.stdout
    assert "seisblock completion" in answer.stderr


def test_shell_completes_commands_options_and_samples():
    """The script completes names of commands, options, samples and files."""

    def complete(words, index):
        environment = {**os.environ, "_SEISBLOCK_COMPLETE": "bash_complete", "COMP_WORDS": words, "COMP_CWORD": str(index)}
        return subprocess.run([sys.executable, "-m", "seisblock"], env=environment, capture_output=True, text=True, check=False).stdout

    assert complete("seisblock rock --component ", 3).split() == ["plain,NS", "plain,EW", "plain,UD", "plain,all", "plain,all-azimuths"]
    assert complete("seisblock rock --component = N", 4).split() == ["plain,NS"]
    assert complete("seisblock ju", 1).split() == ["plain,jump"]
    assert "plain,--side" in complete("seisblock jump --si", 2).split()
    offered = complete("seisblock jump syn", 2).split()
    assert "plain,synthetic_jma.csv" in offered and "file,syn" in offered


BASH = shutil.which("bash")


@pytest.mark.skipif(BASH is None, reason="no bash")
@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (("measure", "synth"), ["synthetic_jma.csv", "synthetic_mine.csv"]),
        (("rock", "--block", "gr"), ["gravestone", "granite.toml"]),
        (("stack", "--without", "mi"), ["mizubachi"]),
        (("rock", "--component", "=", "U"), ["UD"]),
    ],
    ids=" ".join,
)
def test_bash_completes_names_and_files(words, offered, tmp_path):
    """The script run by bash offers bundled names beside files."""
    for name in ("synthetic_mine.csv", "granite.toml"):
        (tmp_path / name).touch()
    program, folder = tmp_path / "bin" / "seisblock", tmp_path / "bin"
    folder.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m seisblock "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    typed = " ".join(f"'{word}'" for word in ("seisblock", *words))
    lines = (
        run("completion", "bash").stdout,
        "compopt() { :; }",  # which bash allows while the tabulator is pressed only
        f"COMP_WORDS=({typed}); COMP_CWORD={len(words)}; _seisblock_completion seisblock",
        'printf "%s\\n" "${COMPREPLY[@]}"',
    )
    home = os.pathsep.join(filter(None, (str(Path(seisblock.__file__).parents[1]), os.environ.get("PYTHONPATH"))))
    environment = {**os.environ, "PATH": f"{folder}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": home}
    result = subprocess.run(
        [BASH, "--norc", "-c", "\n".join(lines)], env=environment, cwd=tmp_path, capture_output=True, text=True, check=True, timeout=600
    )
    assert set(offered) <= set(result.stdout.split()), result.stderr
