"""A command that takes more than a second shows a progress line on a terminal, and removes it."""

import os
import pty
import re
import subprocess
import sys
import time

import numpy as np
import pytest

from seisblock import Motion, solve_slide
from seisblock.cli.progress import Task
from seisblock.dynamics.cancellation import progress_scope
from tests.brief_record import brief_record

COMMANDS = """
import shlex, sys
from seisblock.cli import main
shown = sys.modules["seisblock.cli.progress"]
shown.SHOW_DELAY_S, shown.REFRESH_DELAY_S, shown.TICK_S = 0.0, 0.0, 0.001
for line in sys.argv[1:]:
    try:
        main(shlex.split(line))
    except SystemExit as end:
        assert not end.code, line
    print("END OF", line, file=sys.stderr, flush=True)
"""
"""Commands whose user has no patience, one after the other: what would be shown after a second is shown at once."""

LONG_MOTION = """
import importlib
import numpy as np
from seisblock import Motion, solve_slide
shown = importlib.import_module("seisblock.cli.progress")
shown.SHOW_DELAY_S, shown.REFRESH_DELAY_S, shown.TICK_S = 0.0, 0.0, 0.001
motion = Motion.from_arrays(3.0 * np.sin(0.1 * np.arange(1e6)), 0.01)
with shown.progress("working"):
    solve_slide(0.2, motion)
"""

WORKS = {
    "working": "measure record.csv",
    "computing": "slide record.csv --mu 0.2 --plot slide.png",
    "reading record.csv": "measure record.csv",
    "margin": "rock record.csv --block gravestone --margin",
    "samples": "respond record.csv --block gravestone --runs 100",
    "drawing": "slide record.csv --mu 0.2 --plot slide.png",
    "writing slide.csv": "slide record.csv --mu 0.2 --csv slide.csv",
}
"""Text of a progress line, and a command that shows it."""

QUIET = f"{WORKS['drawing']} --quiet"


def on_a_terminal(script, words, cwd, **variables):
    """Return what a script writes on a terminal that is its stderr."""
    leader, follower = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100", "NO_COLOR": "1", "LC_ALL": "C.UTF-8", **variables}
    command = [sys.executable, "-c", script, *words]
    with subprocess.Popen(command, cwd=cwd, stdout=subprocess.DEVNULL, stderr=follower, env=environment) as process:
        os.close(follower)
        text = b""
        while piece := read(leader):
            text += piece
    os.close(leader)
    assert process.returncode == 0, text
    return text.decode()


def off_a_terminal(script, words, cwd):
    """Return what a script writes where its stderr is a pipe."""
    return subprocess.run([sys.executable, "-c", script, *words], cwd=cwd, capture_output=True, text=True, check=True).stderr


def by_command(text):
    """Return what commands wrote, by the line that was typed."""
    pieces = re.split(r"END OF ([^\r\n]*)\r?\n", text)
    return dict(zip(pieces[1::2], pieces[:-1:2], strict=True))


@pytest.fixture(scope="module")
def command_output(tmp_path_factory):
    """Output of each command on a terminal and elsewhere, after compilation."""
    workshop = tmp_path_factory.mktemp("workshop")
    (workshop / "record.csv").write_bytes(brief_record())
    lines = list(dict.fromkeys(WORKS.values()))
    off = off_a_terminal(COMMANDS, lines, workshop)
    if "compiling kernels" in off:
        off = off_a_terminal(COMMANDS, lines, workshop)
    return by_command(off), by_command(on_a_terminal(COMMANDS, [*lines, QUIET], workshop))


def read(terminal):
    """Return the text on a terminal, empty at its end."""
    try:
        return os.read(terminal, 65536)
    except OSError:
        return b""


def remaining_lines(text):
    """Return the lines that stand on a terminal in the end: a carriage return, one line up and clear to the end are all that bars use."""
    lines, row = [""], 0
    for piece in re.split(r"(\r?\n|\r|\x1b\[\??\d*[A-Za-z])", text):
        if piece.endswith("\n"):
            row += 1
            lines += [""] * (row == len(lines))
        elif piece == "\x1b[1A":
            row -= 1
        elif piece in ("\r", "\x1b[2K"):
            lines[row] = "" if piece == "\x1b[2K" else lines[row]
        elif piece and not piece.startswith("\x1b"):
            lines[row] = piece
    return [line for line in lines if line]


@pytest.mark.slow
def test_kernel_compilation_shows_progress(tmp_path):
    """Kernels that are compiled, which takes longest, say so for as long as it takes."""
    command_output = on_a_terminal(
        "from seisblock.cli import main; main()", ["slide", "--mu", "0.2"], tmp_path, SEISBLOCK_CACHE_DIR=str(tmp_path)
    )
    assert re.search("compiling kernels[^\n]*━", command_output)
    assert remaining_lines(command_output)[-1] == "compiling kernels (first run only, up to 30 s)..."


@pytest.mark.slow
@pytest.mark.parametrize("work", WORKS)
def test_long_steps_show_progress_and_clear_it(work, command_output):
    """Reading, computing, drawing and writing have a progress line; at the end only the messages remain."""
    off, on = (place[WORKS[work]] for place in command_output)
    assert re.search(rf"{work}[^\n]*━", on)
    assert "━" not in off
    assert remaining_lines(on) == off.splitlines()


@pytest.mark.slow
def test_quiet_shows_no_progress(command_output):
    """--quiet leaves a terminal empty."""
    assert command_output[1][QUIET] == ""


@pytest.mark.slow
def test_long_motion_shows_share_completed(tmp_path):
    """The line shows the completed share of the integration."""
    text = on_a_terminal(LONG_MOTION, [], tmp_path)
    shares = [int(share) for share in re.findall(r"solving[^\r]*?(\d+) ?%", text)]
    assert len(set(shares)) > 2
    assert remaining_lines(text) == []


def test_reported_samples_increase_to_the_last():
    """The engine reports progress piece by piece, and starts again where it needs larger event tables."""
    motion, text = Motion.from_arrays(3.0 * np.sin(0.1 * np.arange(300_000)), 0.01), []
    with progress_scope(lambda result, total: text.append((result, total))):
        solve_slide(0.2, motion)
    assert {total for _, total in text} == {motion.samples - 1}
    assert text[-1] == (motion.samples - 1, motion.samples - 1)
    assert np.diff([completed for completed, _ in text]).max() < motion.samples / 3


def test_rate_is_that_of_the_last_seconds(monkeypatch):
    """A pile that collapses after 20 s is solved more slowly by a factor of 100; a count that starts again has its own rate."""
    now = 100.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    task, completed = Task("solving", started=now), 0.0
    for tick in range(500):
        now += 0.1
        completed += 100.0 if tick < 200 else 1.0
        task.advance(int(completed), 100_000)
    assert task.count_text() == "20300/100000, 10 per s"
    task.advance(0, 100_000)
    for completed in range(0, 100, 5):
        now += 0.1
        task.advance(completed + 5, 100_000)
    assert task.count_text() == "100/100000, 50 per s"
