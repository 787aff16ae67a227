"""``--options FILE``: options of a command from a TOML file."""

import json

import pytest
from click.testing import CliRunner

from seisblock.cli import main

LINE = ["--width", "45cm", "--height", "1.8", "--mu", "0.3", "--no-vertical", "--runs", "0", "--component", "NS", "--window", "20:35"]
FILE = """
width = "45cm"
height = 1.8
mu = 0.3
no-vertical = true
runs = 0
component = ["NS"]
window = "20:35"
"""


def run(*words):
    """Return the result of a command line of ``respond``."""
    return CliRunner().invoke(main, ["respond", *map(str, words), "--json", "--quiet"])


@pytest.fixture
def file(tmp_path):
    """Return a file of options."""
    path = tmp_path / "試験.toml"
    path.write_text(FILE, encoding="utf-8")
    return path


def test_options_of_a_file_equal_those_of_the_line(file):
    """The document is the same; an option of the line replaces that of the file."""
    assert run("--options", file).stdout == run(*LINE).stdout != ""
    replaced = json.loads(run("--options", file, "--mu", "0.1", "--component", "EW").stdout)
    assert (replaced["parameters"]["mu"], [result["component"] for result in replaced["results"]]) == (0.1, ["EW"])


def test_table_of_the_command_is_read_from_a_common_file(tmp_path):
    """A file with a table per command serves several commands."""
    path = tmp_path / "common.toml"
    path.write_text("[respond]\n" + FILE + "[rock]\nwidth = 1\n", encoding="utf-8")
    assert run("--options", path).stdout == run(*LINE).stdout


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("widht = 3", "respond has no option --widht; did you mean width?"),
        ("width = ", "Invalid value"),
        ("width = 'wide'", "wide"),
        ("mu = true", "wrong.toml: --mu requires a value, found true"),
        ("no-vertical = 'no'", '--no-vertical requires true or false, found "no"'),
        ("details = 1", "--details requires true or false, found 1"),
        ("runs = 20.5", "'20.5' is not a valid integer."),
        ("help = true", "respond has no option --help"),
    ],
)
def test_file_with_an_error_is_refused_in_one_sentence(tmp_path, text, message):
    """Exit code 2, no traceback."""
    path = tmp_path / "wrong.toml"
    path.write_text(text, encoding="utf-8")
    result = run("--options", path)
    assert result.exit_code == 2
    assert message in " ".join(result.stderr.split())


def test_missing_file_of_options_is_named(tmp_path):
    """Exit code 2 with the path."""
    result = run("--options", tmp_path / "none.toml")
    assert result.exit_code == 2
    assert "none.toml" in result.stderr
