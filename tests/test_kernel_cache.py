"""Compiled kernels are kept for the next process; a folder that is damaged, full or closed costs time and nothing else."""

import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.lengths import all_but_slow

ONE = (
    "import sys; from seisblock import _jit; _jit.on_message = lambda text: print(text, file=sys.stderr)\n"
    "import numpy as np; from seisblock.dynamics.polynomial import evaluate, first_crossing\n"
    "print(evaluate(np.array([1.0, 2.0]), 1, 0.5))\n"
)
"""Calls one kernel of the polynomials, which calls no other."""

SCRIPT = f"{ONE}print(first_crossing(np.array([1.0, -4.0]), 1, 1.0, np.zeros(2), np.zeros(2)))\n"
"""Calls that and another one, which calls many."""

ANSWER = {ONE: ["2.0"], SCRIPT: ["2.0", "0.25"]}


def run_script(folder, script=SCRIPT, **options):
    """Run a script with a cache folder; return what it says beside its answer, which is right."""
    done = subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, "SEISBLOCK_CACHE_DIR": str(folder)},
        capture_output=True,
        text=True,
        check=False,
        **options,
    )
    assert (done.returncode, done.stdout.split()) == (0, ANSWER[script]), done.stderr
    return done.stderr.splitlines()


@pytest.fixture(scope="module")
def compiled_folder(tmp_path_factory):
    """A folder with the kernels compiled."""
    folder = tmp_path_factory.mktemp("kernels")
    assert run_script(folder) == ["compiling kernels (first run only, up to 30 s)..."]
    return folder


@pytest.fixture
def folder(compiled_folder, tmp_path):
    """A copy of it to spoil."""
    return Path(shutil.copytree(compiled_folder, tmp_path / "kernels"))


def kernel_files(folder):
    """Return what is kept of each kernel, by name."""
    return {path.name: path.read_bytes() for path in folder.rglob("*.nb[ci]")}


def test_cache_keeps_entry_kernels_only(compiled_folder):
    """Of the ten that :func:`first_crossing` calls nothing is compiled or written but what it holds itself."""
    assert sorted({name.split("-")[0] for name in kernel_files(compiled_folder)}) == ["polynomial.evaluate", "polynomial.first_crossing"]


@pytest.mark.slow
def test_process_loads_entry_kernels_only(folder):
    """Machine code of a kernel holds that of the kernels it calls: with everything in the cache, two of them are made."""
    counted = (
        f"{SCRIPT}import gc; from seisblock._jit.lazy import LazyKernel\n"
        "print(*sorted(k.__name__ for k in gc.get_objects() if isinstance(k, LazyKernel) and k._compiled is not None))"
    )
    environment = {**os.environ, "SEISBLOCK_CACHE_DIR": str(folder)}
    done = subprocess.run([sys.executable, "-c", counted], env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == [*ANSWER[SCRIPT], "evaluate first_crossing"]


def test_second_process_compiles_nothing(folder):
    """What one process compiled the next one finds, in silence, and leaves as it is."""
    before = kernel_files(folder)
    assert len(before) == 4
    assert run_script(folder) == []
    assert kernel_files(folder) == before


def test_missing_kernels_are_announced_once(folder):
    """A folder that holds some kernels is no reason to compile the others in silence; it is said once."""
    for path in folder.rglob("polynomial.first_crossing*"):
        path.unlink()
    assert run_script(folder) == ["compiling kernels (first run only, up to 30 s)..."]
    assert run_script(folder) == []


SPOILT = {
    "empty": lambda data: b"",
    "half": lambda data: data[: len(data) // 2],
    "last byte": lambda data: data[:-1],
    "inside": lambda data: data[: len(data) // 2] + bytes(300) + data[len(data) // 2 + 300 :],
}


@pytest.mark.parametrize(
    ("spoil", "script"),
    [
        pytest.param("empty", ONE, marks=pytest.mark.slow),
        pytest.param("half", ONE, marks=pytest.mark.slow),
        pytest.param("last byte", ONE, marks=pytest.mark.slow),
        ("inside", SCRIPT),
    ],
    ids=SPOILT,
)
@pytest.mark.parametrize("suffix", ["nbc", pytest.param("nbi", marks=pytest.mark.slow)])
def test_damaged_cache_file_is_recompiled(folder, suffix, spoil, script):
    """Files that lost bytes, or changed some, which would be run: the answer stands, one line says so, the next run finds them whole."""
    for path in folder.rglob(f"*.{suffix}"):
        path.write_bytes(SPOILT[spoil](path.read_bytes()))
    said = run_script(folder, script)
    assert len(said) == 1 and "damaged file; the affected kernels are compiled again" in said[0] and str(folder) in said[0]
    assert run_script(folder, script) == []


def test_full_disk_compiles_for_this_run(tmp_path):
    """Nothing can be written: the kernels are compiled for this run, and one line names the folder and why."""
    said = run_script(tmp_path / "kernels", ONE, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0)))
    assert said[0] == "compiling kernels (first run only, up to 30 s)..."
    assert len(said) == 2 and "compiled again" in said[1] and os.strerror(27) in said[1]


@pytest.mark.parametrize("where", all_but_slow(["file", "file/below"], {"file/below"}))
def test_unusable_cache_folder_compiles_for_this_run(tmp_path, where):
    """A file stands where the folder should be: compiled for this run, and one line says how to name another."""
    (tmp_path / "file").touch()
    said = run_script(tmp_path / where, ONE)
    assert len(said) == 1 and "set SEISBLOCK_CACHE_DIR to a writable folder" in said[0]
    assert list(tmp_path.iterdir()) == [tmp_path / "file"]


@pytest.mark.skipif(os.geteuid() == 0, reason="to root nothing is read-only")
def test_read_only_cache_folder_compiles_for_this_run(folder):
    """A folder of somebody else's is left alone."""
    for path in [folder, *folder.rglob("*")]:
        path.chmod(0o555 if path.is_dir() else 0o444)
    try:
        said = run_script(folder)
    finally:
        for path in [folder, *folder.rglob("*")]:
            path.chmod(0o755 if path.is_dir() else 0o644)
    assert len(said) == 1 and "set SEISBLOCK_CACHE_DIR to a writable folder" in said[0]


RACE = """
import contextlib, threading
from pathlib import Path
import numba
from seisblock._jit.cache import _numba_cache_dir
both, seen = threading.Barrier(2, timeout=0.5), {}

def meet():
    with contextlib.suppress(threading.BrokenBarrierError):
        both.wait()

def keep(name):
    with _numba_cache_dir(Path(name)):
        meet()
        seen[name] = numba.config.CACHE_DIR
        meet()

before = numba.config.CACHE_DIR
threads = [threading.Thread(target=keep, args=(name,)) for name in ("one", "two")]
[thread.start() for thread in threads]
[thread.join() for thread in threads]
print(seen["one"], seen["two"], numba.config.CACHE_DIR == before)
"""
"""Two threads that want to be inside at the same time: each waits half a second for the other one."""


def test_threads_use_separate_cache_folders():
    """Kernels of one thread were kept beside the sources, or in the working directory, when another one had just finished."""
    done = subprocess.run([sys.executable, "-c", RACE], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["one", "two", "True"]
