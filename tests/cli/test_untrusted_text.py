"""A text from a file is data: it commands no terminal, marks up no table, begins no formula and fills no screen (FINDINGS R15, R16)."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from tests.lengths import all_but_slow
from tests.readers.files import KNET_CSV

pytestmark = pytest.mark.usefixtures("computed_once")

NASTY = "\x1b[31mred\x07 \x9b1m\u202e [bold]loud[/bold] [/] $x_{\\frac$ <script>alert(1)</script> {0} {name} %s "
COMMANDING = "\x1b\x07\x9b\u202e"
"""What a terminal obeys: escapes, the bell, an escape of one byte, letters from right to left."""
LONG = "long " * 4000
COMMANDS = {
    "measure": [],
    "slide": ["--mu", "0.2"],
    "rock": ["--block", "stone.toml"],
    "respond": ["--block", "stone.toml", "--mu", "0.4", "--runs", "2"],
    "jump": [],
    "uplift": ["--width", "1", "--height", "3", "--frequency-vertical", "8"],
    "stack": ["--stones", "pile.toml", "--contact", "grid=3"],
    "criteria": ["--block", "stone.toml"],
    "spectrum": ["--steps", "2"],
    "overturn-rate": ["--cemetery", "aoyama.csv"],
    "infer": ["--slid", "5cm", "--mu", "0.2"],
}


def quoted(text):
    """Return a text as TOML and JSON write it."""
    return json.dumps(text)


@pytest.fixture
def record(tmp_path, monkeypatch):
    """A CSV of NIED whose station and path are nasty, and a body and a pile of such names."""
    monkeypatch.chdir(tmp_path)
    t = np.arange(200) * 0.01
    rows = [a * np.sin(12 * t) * np.exp(-(((t - 1.0) / 0.4) ** 2)) for a in (300.0, 500.0, 100.0)]
    header = KNET_CSV.split("2019/01/02 17:47:27.00")[0].replace("FKS005", NASTY + LONG).replace("#60", "#2")
    times = (f"2019/01/02 17:47:{27 + s:05.2f},{s:.2f}" for s in t)
    body = "".join(f"{time},{x:.3f},{y:.3f},{z:.3f}\n" for time, x, y, z in zip(times, *rows, strict=True))
    path = tmp_path / "a\x1b[31m [bold] $x_{$.csv"
    path.write_bytes((header + body).encode())
    (tmp_path / "stone.toml").write_text(f'kind = "block"\nname = {quoted(NASTY)}\nwidth = "24cm"\nheight = "63cm"\nmu = 0.4\n')
    stones = "".join(f"[[stone]]\nname = {quoted(NASTY + str(i))}\nwidth = {0.5 - 0.1 * i}\ndepth = 0.4\nheight = 0.2\n" for i in range(2))
    (tmp_path / "pile.toml").write_text(f'kind = "pile"\nname = {quoted(NASTY)}\n{stones}')
    return path.name


@pytest.mark.parametrize("language", ["en", "ja"])
@pytest.mark.parametrize("command", COMMANDS)
def test_terminal_output_strips_control_characters(command, language, record):
    """No control character reaches the terminal; brackets, dollars and braces are printed as they are."""
    result = CliRunner().invoke(main, [command, record, *COMMANDS[command], "--lang", language])
    assert result.exception is None, (result.exception, result.stderr)
    output = result.stdout + result.stderr
    assert not set(COMMANDING) & set(output)
    assert all(len(line) < 2000 for line in output.splitlines())
    assert "\\x1b[31mred\\x07 \\x9b1m\\u202e [bold]loud[/bold] [/] $x_{" in " ".join(output.split())
    assert output.count("long") < 400


@pytest.mark.parametrize("command", COMMANDS)
def test_json_round_trips_text(command, record):
    """JSON escapes it, and gives it back."""
    result = CliRunner().invoke(main, [command, record, *COMMANDS[command], "--json", "--quiet"])
    assert result.exception is None, result.exception
    assert not set(COMMANDING) & set(result.stdout + result.stderr)
    output = json.loads(result.stdout)
    output = output["record"][0] if isinstance(output["record"], list) else output["record"]
    assert output["source"] == record


DRAWING = ("measure", "slide", "rock", "jump", "uplift", "respond", "stack", "criteria", "spectrum")
"""Commands that draw a record."""


@pytest.mark.parametrize("command", all_but_slow(DRAWING, {"slide", "rock", "respond", "criteria"}))
def test_figure_text_is_not_mathematics(command, record, tmp_path):
    """A dollar begins no formula: the figure is drawn, and its title is the text."""
    result = CliRunner().invoke(main, [command, record, *COMMANDS[command], "--plot", "out.svg", "--title", NASTY, "--quiet"])
    assert result.exception is None, result.exception
    assert (tmp_path / "out.svg").stat().st_size > 1000
    assert not set(COMMANDING) & set(result.stderr) and "Glyph" not in result.stderr


@pytest.mark.slow
def test_report_escapes_text(record, tmp_path):
    """No tag of a header is a tag of the page."""
    result = CliRunner().invoke(main, ["report", record, "--body", "stone.toml", "-o", "out.html", "--quiet"])
    assert result.exception is None, result.exception
    page = (tmp_path / "out.html").read_text(encoding="utf-8")
    assert not set(COMMANDING) & set(page)
    assert "<script>alert(1)" not in page and "&lt;script&gt;alert(1)" in page
