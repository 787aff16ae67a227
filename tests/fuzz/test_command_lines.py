"""Random command lines give a result, or one sentence and an exit code; no traceback, no endless run."""

from __future__ import annotations

import contextlib
import itertools
import json
import signal
import socket
import sys

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import COMMANDS, main
from tests.fuzz.command_lines import ALWAYS, COMMONLY, SLOW, line, write_files
from tests.readers.files import knet

VALUES = 8
SLOWEST_S = 10.0
"""Processor time, so that a busy machine does not count; a report, which draws a dozen figures, and a study of a pile, which runs for each
height and frequency, take some seconds themselves."""

LONGER_S = {"report": 40.0, "stack": 60.0, "fit": 40.0, "secure": 60.0, "scenario": 30.0}
CODES = {0, 2, 3, 4}
"""Answered; click's; bad input; a solver that gave up (DESIGN: errors)."""

LONGEST_LINE = 1500
OUTPUTS = {"--csv", "--plot", "--animate", "--html", "-o", "--out", "--geojson", "--pelicun", "--nrml"}

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not hasattr(signal, "SIGPROF"), reason="a run that does not end is ended by an alarm")]


class TooSlow(BaseException):
    """A line that took longer than anybody waits."""


@contextlib.contextmanager
def in_time(command):
    """End the block when it takes too long."""

    def ring(number, frame):
        raise TooSlow

    before = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, LONGER_S.get(command, SLOWEST_S))
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def complaint(words, result):
    """Return the fault in the way a command ended, empty without one."""
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        return f"raised {result.exception!r}"
    if result.exit_code not in CODES:
        return f"exit code {result.exit_code}"
    if "Traceback" in result.stderr or "\x1b" in result.stdout + result.stderr:
        return "a traceback or an escape on the terminal"
    if result.exit_code and not result.stderr.strip():
        return f"exit code {result.exit_code} without a word"
    if any(len(text) > LONGEST_LINE for text in result.stderr.splitlines()):
        return "a line longer than a screen"
    if result.exit_code == 0 and "--json" in words and result.stdout.startswith("{"):
        json.loads(result.stdout, parse_constant=lambda name: pytest.fail(f"{name} in the document of {words}"))
    return ""


def changed_inputs(words, full):
    """Return the files that are not what they were, though they were no output alone; what was written is put back."""
    changed = [path for path, data in full.items() if path.read_bytes() != data]
    for path in changed:
        path.write_bytes(full[path])
    previous = {path.name: {before for before, after in itertools.pairwise(words) if after == path.name} for path in changed}
    return [name for name, options in previous.items() if not options <= OUTPUTS or len(options) != 1]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Files that the lines name, in a directory of their own; the page of ``app`` is not served, and ``fetch`` finds no network."""

    def offline(host, *rest, **options):
        raise socket.gaierror(socket.EAI_NONAME, "no network")

    monkeypatch.setattr(socket, "getaddrinfo", offline)
    monkeypatch.setattr("seisblock.readers.fdsn.FIRST_PAUSE_S", 0.0)
    monkeypatch.setattr("seisblock.app.server.serve", lambda listener, *rest: listener.close())
    monkeypatch.chdir(tmp_path)
    write_files(tmp_path, knet(duration="2"))
    return tmp_path


@pytest.mark.parametrize("command", COMMANDS)
def test_random_command_line_gives_answer_or_one_error(command, seeds, folder):
    """Whatever stands on it."""
    runner = CliRunner()
    codes = set()
    full = {path: path.read_bytes() for path in folder.iterdir()}
    if command not in SLOW:  # kernels may have to be compiled first
        runner.invoke(main, [command, *ALWAYS.get(command, ()), *COMMONLY.get(command, ()), "small.csv"])
    for seed in seeds(2 if command in SLOW else VALUES):
        rng = np.random.default_rng([seed, *command.encode()])
        words = line(command, rng)
        with in_time(command):
            result = runner.invoke(main, words, input="1,2\n")
        codes.add(result.exit_code)
        assert complaint(words, result) == "", (seed, words, result.output[-500:])
        assert changed_inputs(words, full) == [], (seed, words)
    assert codes <= CODES
    assert sys.stdout is not None
