"""Shared by all tests: English locale, terminal of 80 columns, validation cases computed once in a session."""

import contextlib
import dataclasses
import functools
import gc
import json
import os
import signal
import time
from pathlib import Path

import hypothesis
import pytest

import seisblock
from seisblock import _jit
from seisblock.__main__ import GC_THRESHOLD
from seisblock.validation.case import Case, CaseResult
from tests.computed_once import computing_once
from tests.kernels import compile_all
from tests.lengths import short_studies

os.environ.setdefault("COLUMNS", "80")
os.environ["NO_COLOR"] = "1"
# commands that tests start run this very source, wherever they are started: another one would compile its own kernels
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (str(Path(seisblock.__file__).parent.parent), os.environ.get("PYTHONPATH"))))
for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
    os.environ.pop(name, None)

if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    # a job that a shell runs in the background ignores Ctrl-C, and so would every command that a test interrupts
    signal.signal(signal.SIGINT, signal.default_int_handler)

# the same examples in every run of continuous integration; fresh ones at a developer's desk
# without a deadline, as the first example loads kernels
hypothesis.settings.register_profile("desk", deadline=None)
hypothesis.settings.register_profile("ci", derandomize=True, deadline=None)
hypothesis.settings.load_profile("ci" if os.environ.get("CI") else "desk")


# as in the program: at the default threshold garbage collections take a sixth of the run time
gc.set_threshold(GC_THRESHOLD)


def pytest_collection_finish():
    """Leave imported modules and collected tests out of every later garbage collection."""
    gc.collect()
    gc.freeze()


def pytest_addoption(parser):
    """Set the duration of fuzzing: short in continuous integration, long on request."""
    parser.addoption("--fuzz", type=int, default=1, help="how many times its usual length the fuzz is (default 1: about a minute in all)")
    parser.addoption("--fuzz-from", type=int, default=0, help="the seed of its first accident (default 0)")


def pytest_configure(config):
    """Exclude tests marked slow from a run of the whole suite; ``-m slow`` and named files run them.

    How tests are shared out among workers is said where there are workers alone: benchmarks are not measured beside it.
    """
    if config.option.numprocesses is None:
        config.option.dist = "no"
    if config.args_source is pytest.Config.ArgsSource.TESTPATHS and not config.option.markexpr:
        config.option.markexpr = "not slow"


WHOLE_RUN = 1000
"""Number of tests above which all kernels are compiled first."""

MOST_S = 300.0
"""Time limit of a worker's wait for the others, s."""


@functools.cache
def cases_by_key() -> dict[str, list[Case]]:
    """Return the cases of the papers by their keys."""
    from seisblock.validation import cases

    mapping: dict[str, list[Case]] = {}
    for case in cases():
        mapping.setdefault(case.key, []).append(case)
    return mapping


@pytest.fixture(scope="session", autouse=True)
def compiled(request, tmp_path_factory):
    """Let the workers of a whole run compile each kernel once: each its share, before the first test, into the cache that all read.

    Otherwise each would compile what its tests need, at the same time as the others.
    """
    worker, count = os.environ.get("PYTEST_XDIST_WORKER", ""), int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
    if count == 1 or not _jit.ENABLED or len(request.session.items) < WHOLE_RUN:
        return
    compile_all(share=int(worker.removeprefix("gw")), of=count)
    meeting = tmp_path_factory.getbasetemp().parent
    (meeting / f"compiled.{worker}").touch()
    until = time.monotonic() + MOST_S
    while len(list(meeting.glob("compiled.*"))) < count and time.monotonic() < until:
        time.sleep(0.1)


@pytest.fixture(scope="session", autouse=True)
def evidence(tmp_path_factory):
    """Let each validation case be computed by the first test that runs it, in whatever process; later runs find what it computed.

    The papers' tests, the command and its examples all run every case. Cases that a test makes up are computed each time.
    """
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base) / "evidence"
    folder.mkdir(exist_ok=True)
    run = Case.run

    def run_once(case: Case) -> CaseResult:
        if not any(case is reference for reference in cases_by_key().get(case.key, ())):
            return run(case)
        remaining = folder / f"{case.key}.json"
        with contextlib.suppress(FileNotFoundError):
            expected, computed = json.loads(remaining.read_text(encoding="ascii"))
            return dataclasses.replace(run(dataclasses.replace(case, expected=expected, compute=lambda: computed)), case=case)
        result = run(case)
        fresh = folder / f"{case.key}.{os.getpid()}"
        fresh.write_text(json.dumps([result.expected, result.computed]), encoding="ascii")
        fresh.replace(remaining)
        return result

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Case, "run", run_once)
        yield folder


@pytest.fixture(scope="module")
def computed_once():
    """Compute what the tests of a file repeat once, such as the studies of a command in both languages."""
    with computing_once():
        yield


@pytest.fixture
def few_runs():
    """Take few records and few runs of each for `secure` and `scenario`, and few blocks for `fit`."""
    with short_studies():
        yield
