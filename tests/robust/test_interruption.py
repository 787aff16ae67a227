"""Ctrl-C ends a long run at once, though compiled code and threads hear no signal."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.cli.cite import cite
from seisblock.cli.process import graceful_exit
from seisblock.core._signals import defer_interrupt
from tests.lengths import all_but_slow

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="reads what a process has spent from /proc")

AT_ONCE = 0.5
"""Processor time, s, that may pass between the signal and the end of the run; of the processor, so that a busy machine does not count."""

WELL_UNDER_WAY = 0.5
"""Processor time, s, that the run itself has had before it is interrupted."""

COMMANDS = {
    "a pile on 25 x 25 points": ["stack", "--contact", "grid=25", "--law", "springs"],
    "a pile in fine steps": ["stack", "--step", "2e-6"],
    "a criterion study": ["stack", "--criterion"],
    "versions of a stone": ["rock", "--block", "gravestone", "--perturb", "100000"],
    "versions of a body": ["respond", "--block", "gravestone", "--runs", "100000"],
    "a map of modes": ["spectrum", "--kind", "modes", "--steps", "300"],
    "a scan of factors": ["infer", "--slid", "5cm", "--mu", "0.2", "--steps", "100000"],
    "a study of sliding": ["slide", "--mu", "0.02:0.5:0.0005", "--kappa", "0.1:1.0:0.005"],
}

SETTING_OUT = """
import os, sys, time
import numpy as np
os.sched_setaffinity(0, [min(os.sched_getaffinity(0))])
"""
"""One core, so that one worker is to be stopped and processor time is time."""

COMPILING = """
from seisblock.models.respond.model import RESPOND
print("go", flush=True)
try:
    RESPOND.pointers
except KeyboardInterrupt:
    print(time.process_time(), flush=True)
    sys.exit(130)
"""
"""Compiles for many seconds, for the kernels are nowhere yet."""

COMMAND = """
import contextlib, io
from seisblock.cli import main
brief = {"stack": ["--window", "26:27"], "rock": ["--block", "gravestone"], "respond": ["--block", "gravestone", "--runs", "2"],
         "slide": ["--mu", "0.2,0.3"], "spectrum": ["--kind", "modes", "--steps", "2"],
         "infer": ["--slid", "5cm", "--mu", "0.2", "--steps", "3"]}
with contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit):
    main([sys.argv[1], *brief[sys.argv[1]], "--quiet"])
print("go", flush=True)
try:
    main(sys.argv[1:])
finally:
    print(time.process_time(), flush=True)
"""

LIBRARY = """
from seisblock import Motion, SpringBlock, solve_uplift
rng = np.random.default_rng(0)
motion = Motion.from_arrays(3.0 * rng.normal(size=3_000_000), 0.01)
block = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707)
solve_uplift(block, Motion.from_arrays(np.zeros(3), 0.01))
print("go", flush=True)
try:
    solve_uplift(block, motion)
except KeyboardInterrupt:
    print(time.process_time(), flush=True)
    sys.exit(130)
"""


def processor_time(pid):
    """Return the processor time of a process, s."""
    user, system = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def interrupt_script(script, words, cwd):
    """Start a script, interrupt it when it is well under way; return exit code, stderr and the processor time that it took to end."""
    pipe = subprocess.PIPE
    command = [sys.executable, "-c", SETTING_OUT + script, *words]
    with subprocess.Popen(command, cwd=cwd, stdout=pipe, stderr=pipe, text=True, start_new_session=True) as process:
        assert process.stdout.readline() == "go\n", process.stderr.read()
        began = processor_time(process.pid)
        while processor_time(process.pid) < began + WELL_UNDER_WAY:
            assert process.poll() is None, process.stderr.read()
            time.sleep(0.02)
        at = processor_time(process.pid)
        process.send_signal(signal.SIGINT)
        try:
            out, message = process.communicate(timeout=600)
        finally:
            process.kill()
        return process.returncode, message.strip(), float(out.split()[-1]) - at


def best_of_four(script, words, cwd, text):
    """Interrupt a script, and again where a busy machine may have slowed its end; return the shortest processor time, s."""
    minimum = float("inf")
    for _ in range(4):
        code, message, took = interrupt_script(script, words, cwd)
        assert (code, message) == (130, text)
        minimum = min(minimum, took)
        if minimum < AT_ONCE:
            break
    return minimum


@pytest.mark.parametrize("names", all_but_slow(COMMANDS, {"a study of sliding"}))
def test_sigint_ends_command_at_once(names, tmp_path):
    """In the middle of a run that would take minutes: exit 130, one line, no traceback, in half a second."""
    assert (
        best_of_four(COMMAND, [*COMMANDS[names], "--quiet"], tmp_path, "seisblock: interrupted; no partially written file remains")
        < AT_ONCE
    )


def test_sigint_during_compilation_is_not_lost(tmp_path, monkeypatch):
    """Finalizers of the compiler swallow exceptions; Ctrl-C ends the run at the next kernel all the same."""
    monkeypatch.setenv("SEISBLOCK_CACHE_DIR", str(tmp_path / "kernels"))
    assert interrupt_script(COMPILING, [], tmp_path)[0] == 130


@pytest.mark.slow
def test_sigint_ends_library_call_at_once(tmp_path):
    """A solver called from Python raises KeyboardInterrupt in the middle of eight hours of record."""
    assert best_of_four(LIBRARY, [], tmp_path, "") < AT_ONCE


SWALLOWING = """
import sys, time
from seisblock.cli import main
import seisblock.readers

class Finalized:
    def __del__(self):
        print("go", flush=True)
        time.sleep(3600.0)

def read_all(*args, **options):
    Finalized()
    time.sleep(3600.0)

seisblock.readers.read_all = read_all
main()
"""
"""A Ctrl-C swallowed by a finalizer does not stop the run; the next one does."""


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_swallowed_interrupt_is_raised_again(number, code, tmp_path):
    """A signal that was lost in a finalizer ends the run all the same, and without a traceback."""
    pipe = subprocess.PIPE
    command = [sys.executable, "-c", SWALLOWING, "measure", "--quiet"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=pipe, stderr=pipe, text=True, start_new_session=True) as process:
        assert process.stdout.readline() == "go\n"
        time.sleep(0.3)  # a signal that comes just before a sleep begins waits for its end: of that, no program is master
        process.send_signal(number)
        try:
            _, message = process.communicate(timeout=600)
        finally:
            process.kill()
    assert process.returncode == code
    assert ("no partially written file remains" in message) == (number == signal.SIGINT)


FIGURE = """
import atexit, os, sys, time
atexit.register(lambda: time.sleep(3600.0))
from seisblock.cli import main
print("go", flush=True)
main()
"""
"""Whose libraries take their time to be taken apart."""


def test_interrupted_program_skips_teardown(tmp_path):
    """Freeing what matplotlib and numba hold took most of the time between Ctrl-C and the prompt."""
    pipe = subprocess.PIPE
    command = [sys.executable, "-c", FIGURE, "stack", "--contact", "grid=25", "--law", "springs", "--quiet"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=pipe, stderr=pipe, text=True, start_new_session=True) as process:
        assert process.stdout.readline() == "go\n"
        began = processor_time(process.pid)
        while processor_time(process.pid) < began + WELL_UNDER_WAY:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        try:
            _, message = process.communicate(timeout=600)
        finally:
            process.kill()
    assert process.returncode == 130 and message.strip().endswith("seisblock: interrupted; no partially written file remains")


class Wrapping:
    """A descriptor: what Python raises for an exception in it while a class is made is a RuntimeError."""

    def __set_name__(self, owner, name):
        """Hear Ctrl-C here, as any import may."""
        signal.raise_signal(signal.SIGINT)


def make_a_class():
    """Turn the interrupt into another error."""
    type("Made", (), {"attribute": Wrapping()})


def suppress_interrupt():
    """Go on without something that was imported on trial."""
    with contextlib.suppress(BaseException):
        signal.raise_signal(signal.SIGINT)


@pytest.mark.parametrize("become", [make_a_class, suppress_interrupt])
def test_wrapped_interrupt_leaves_block_as_keyboard_interrupt(become):
    """Wrapped by an import or swallowed by a library, Ctrl-C leaves the block as itself, and the next block knows nothing of it."""
    with pytest.raises(KeyboardInterrupt), defer_interrupt(), defer_interrupt():
        become()
    with defer_interrupt():
        pass
    with pytest.raises(ValueError, match="mine"), defer_interrupt():
        raise ValueError("mine")


@pytest.mark.parametrize(("number", "code", "message"), [(signal.SIGINT, 130, "interrupted"), (signal.SIGTERM, 143, "")])
def test_sigint_during_import_gives_no_traceback(number, code, message, monkeypatch):
    """No traceback of a RuntimeError while matplotlib is being imported."""
    monkeypatch.setattr(signal, "raise_signal", lambda _, send=signal.raise_signal: send(number))
    monkeypatch.setattr(cite, "callback", lambda **_: make_a_class())
    result = CliRunner().invoke(main, ["cite"])
    assert result.exit_code == code
    assert message in result.stderr and "Traceback" not in result.stderr


def test_sigint_during_parsing_exits_130(monkeypatch):
    """Click's own end of it is "Aborted!" and exit 1."""
    monkeypatch.setattr(main, "parse_args", lambda *_: signal.raise_signal(signal.SIGINT))
    result = CliRunner().invoke(main, ["cite"])
    assert result.exit_code == 130 and "interrupted; no partially written file remains" in result.stderr and "Abort" not in result.stderr


def test_sigint_before_command_exits_130_silently(tmp_path):
    """Ctrl-C while the program itself is imported: exit 130 in silence."""
    script = (
        "import signal, sys\nfrom seisblock.__main__ import run\n"
        "class Finder:\n    def find_spec(self, name, *rest):\n"
        "        if name == 'seisblock.cli':\n            signal.raise_signal(signal.SIGINT)\n"
        "sys.meta_path.insert(0, Finder())\nrun()\n"
    )
    result = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (result.returncode, result.stdout, result.stderr) == (130, "", "")


def test_interrupt_in_callback_is_reported_once(monkeypatch):
    """A repeated interruption in a finalizer prints no line; any other exception does."""
    collected = []
    monkeypatch.setattr(sys, "unraisablehook", lambda missing: collected.append(missing.exc_type))

    class Swallowing:
        def __init__(self, error):
            self.error = error

        def __del__(self):
            raise self.error

    with graceful_exit():
        Swallowing(KeyboardInterrupt())
        Swallowing(ValueError())
    assert collected == [ValueError]
    Swallowing(KeyboardInterrupt())
    assert collected == [ValueError, KeyboardInterrupt]
