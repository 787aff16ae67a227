"""The README's commands print what it says they print, and its Python lines run."""

import doctest
import re
import shlex
from pathlib import Path

import pytest
from click.testing import CliRunner

from seisblock.cli import main

README = Path(__file__).parents[1] / "README.md"
CONSOLE = re.findall(r"```console\n(.*?)```", README.read_text(encoding="utf-8"), re.S)


def sessions():
    """Yield each command of the README with the output that it shows."""
    for block in CONSOLE:
        for part in re.split(r"^\$ ", block, flags=re.M)[1:]:
            command, _, output = part.partition("\n")
            yield command, output


@pytest.mark.parametrize(("command", "shown"), list(sessions()))
def test_console(command, shown, tmp_path, monkeypatch):
    """What a reader sees is what the README shows, at 80 columns."""
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.chdir(tmp_path)
    program, *arguments = shlex.split(command)
    assert program == "seisblock"
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 0, result.stderr
    printed = "\n".join(line.rstrip() for line in result.stdout.splitlines()).strip()
    assert printed == "\n".join(line.rstrip() for line in shown.splitlines()).strip()


def test_library():
    """The Python session is a doctest."""
    outcome = doctest.testfile(str(README), module_relative=False, encoding="utf-8")
    assert outcome.attempted > 3
    assert outcome.failed == 0
