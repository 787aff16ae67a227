"""On-disk cache of kernels: reuse by later processes, damaged, full and read-only folders, folders of other versions."""

import ast
import contextlib
import json
import logging
import os
import re
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

import seisblock
from seisblock import _jit
from seisblock._jit import cache
from seisblock.dynamics.ensemble import Observer
from seisblock.dynamics.model import Model
from tests.kernels import KERNEL_PACKAGES, SHAPE_KERNELS, all_kernels, compile_all
from tests.trees import syntax_tree

pytestmark = pytest.mark.slow

PACKAGE = Path(seisblock.__file__).parent

FIRST = (
    "import logging; logging.basicConfig(format='%(message)s'); logging.getLogger('seisblock.jit').setLevel(logging.INFO)\n"
    "import numpy as np; from seisblock.dynamics.polynomial import evaluate, first_crossing\n"
    "print(evaluate(np.array([1.0, 2.0]), 1, 0.5))\n"
)
"""Script that calls a kernel without callees."""

SCRIPT = f"{FIRST}print(first_crossing(np.array([1.0, -4.0]), 1, 1.0, np.zeros(2), np.zeros(2)))\n"
"""Script that calls this kernel and one with many callees."""

OUTPUT = ["2.0", "0.25"]
"""Results of the two kernels."""

COMPILING = "compiling kernels (first run only, up to 30 s)..."


def start(folder, script, **options):
    """Start a script with a cache folder."""
    environment = {**os.environ, "SEISBLOCK_CACHE_DIR": str(folder)}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.Popen([sys.executable, "-c", script], env=environment, text=True, **pipes, **options)


def checked(code, output, messages, script):
    """Return the messages of a script after checking its output."""
    assert (code, output.split()) == (0, OUTPUT[: script.count("print")]), messages
    return messages.splitlines()


def messages_of(process, script):
    """Return the messages of a process that runs a script."""
    output, messages = process.communicate()
    return checked(process.returncode, output, messages, script)


FORKS = """
import json, os, sys
import numba, numpy
numba.njit("f8(f8)")(lambda x: x)
for line in sys.stdin:
    script, folder, *outputs = json.loads(line)
    if not (child := os.fork()):
        os.environ["SEISBLOCK_CACHE_DIR"] = folder
        for number, path in enumerate(outputs, 1):
            os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT), number)
        exec(script, {})
        sys.stdout.flush()
        os._exit(0)
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
"""
"""Runs each script in a process of its own, which imports seisblock afresh; numba, which takes most of the time, is there."""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Function that runs a script with a cache folder and returns its messages after checking its output."""
    outputs = [tmp_path_factory.mktemp("outputs") / name for name in ("stdout", "stderr")]
    with subprocess.Popen([sys.executable, "-c", FORKS], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as forks:

        def run_script(folder, script=SCRIPT):
            for path in outputs:
                path.unlink(missing_ok=True)
            print(json.dumps([script, *map(str, (folder, *outputs))]), file=forks.stdin, flush=True)
            code = int(forks.stdout.readline())
            return checked(code, *(path.read_text("utf-8") for path in outputs), script)

        yield run_script
        forks.stdin.close()


@pytest.fixture(scope="module")
def filled(tmp_path_factory, run):
    """Cache folder with the kernels of the script."""
    folder = tmp_path_factory.mktemp("kernels")
    assert run(folder) == [COMPILING]
    return folder


@pytest.fixture
def folder(filled, tmp_path):
    """Copy of the filled folder."""
    return Path(shutil.copytree(filled, tmp_path / "kernels"))


def cached_files(folder):
    """Return the content of numba's files by their names."""
    return {path.name: path.read_bytes() for path in folder.rglob("*.nb[ci]")}


def test_cache_holds_only_the_kernels_that_python_calls(filled):
    """The ten callees of :func:`first_crossing` have no files of their own."""
    assert sorted({name.split("-")[0] for name in cached_files(filled)}) == ["polynomial.evaluate", "polynomial.first_crossing"]
    assert [path for path in filled.rglob("*") if path.name.startswith("tmp")] == []


def test_a_process_loads_only_the_kernels_that_python_calls(folder):
    """Machine code of a kernel holds that of its callees."""
    script = (
        f"{SCRIPT}import gc; from seisblock._jit import LazyKernel\n"
        "print(*sorted(k.__name__ for k in gc.get_objects() if isinstance(k, LazyKernel) and k._compiled is not None))"
    )
    environment = {**os.environ, "SEISBLOCK_CACHE_DIR": str(folder)}
    process = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True)
    assert process.stdout.splitlines() == [*OUTPUT, "evaluate first_crossing"]


def test_a_second_process_loads_kernels_without_a_message(run, folder):
    before = cached_files(folder)
    assert len(before) == 4
    assert run(folder) == []
    assert cached_files(folder) == before


def test_kernels_that_another_command_did_not_need_are_announced(run, folder):
    (path,) = folder.rglob("polynomial.first_crossing*.nbi")
    shutil.rmtree(path.parents[1])
    assert run(folder) == [COMPILING]
    assert run(folder) == []


def test_processes_that_compile_at_the_same_time_leave_a_sound_cache(run, tmp_path):
    """Each kernel's folder is renamed into place when it is complete."""
    processes = [start(tmp_path, FIRST) for _ in range(3)]
    for process in processes:
        with process:
            assert messages_of(process, FIRST) in ([], [COMPILING])
    assert len(cached_files(tmp_path)) == 2
    assert [path.name for path in tmp_path.rglob("tmp*")] == []
    assert run(tmp_path, FIRST) == []


def test_kernels_of_changed_files_are_compiled_without_a_warning(run, folder):
    """Numba compiles again where the modification time of a source file has changed; here its stamp is replaced."""
    script = f"from numba.core import caching; caching._SourceFileBackedLocatorMixin.get_source_stamp = lambda self: 'other'\n{FIRST}"
    before = cached_files(folder)
    assert run(folder, script) == []
    assert cached_files(folder) != before
    assert run(folder, script) == []


DAMAGE = {
    "empty": lambda data: b"",
    "half": lambda data: data[: len(data) // 2],
    "last byte": lambda data: data[:-1],
    "inside": lambda data: data[: len(data) // 2] + bytes(300) + data[len(data) // 2 + 300 :],
    "one bit": lambda data: data[: len(data) // 2] + bytes([data[len(data) // 2] ^ 1]) + data[len(data) // 2 + 1 :],
}
"""Damage of files; one bit of the machine code is noticed by the digest only."""


@pytest.mark.parametrize(
    ("name", "damage", "script"),
    [
        ("*.nbc", "one bit", SCRIPT),
        *(
            (name, damage, FIRST)
            for name, damages in {
                "*.nbc": ("empty", "half", "last byte", "inside"),
                "*.nbi": ("empty", "one bit"),
                "SHA256SUMS": ("empty", "half", "one bit"),
            }.items()
            for damage in damages
        ),
    ],
)
def test_a_damaged_kernel_is_compiled_again_with_one_warning(run, folder, name, damage, script):
    """Altered machine code would be executed."""
    for path in folder.rglob(name):
        path.write_bytes(DAMAGE[damage](path.read_bytes()))
    messages = run(folder, script)
    assert "damaged file; the affected kernels are compiled again" in messages[0] and str(folder) in messages[0]
    assert messages[1:] == [COMPILING]
    assert run(folder, script) == []


def test_a_full_disk_has_one_warning_and_no_other_effect(tmp_path):
    with start(tmp_path / "kernels", FIRST, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))) as process:
        messages = messages_of(process, FIRST)
    assert messages[0] == COMPILING
    assert len(messages) == 2 and "set SEISBLOCK_CACHE_DIR to a writable folder" in messages[1] and os.strerror(27) in messages[1]


@pytest.mark.parametrize("place", ["file", "file/below"])
def test_a_folder_that_cannot_be_created_has_one_warning_and_no_other_effect(run, tmp_path, place):
    (tmp_path / "file").touch()
    messages = run(tmp_path / place, FIRST)
    assert len(messages) == 1 and "set SEISBLOCK_CACHE_DIR to a writable folder" in messages[0]
    assert list(tmp_path.iterdir()) == [tmp_path / "file"]


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_read_only_folder_has_one_warning_and_is_left_unchanged(run, folder):
    before = cached_files(folder)
    for path in [folder, *folder.rglob("*")]:
        path.chmod(0o555 if path.is_dir() else 0o444)
    try:
        messages = run(folder)
    finally:
        for path in [folder, *folder.rglob("*")]:
            path.chmod(0o755 if path.is_dir() else 0o644)
    assert len(messages) == 1 and "set SEISBLOCK_CACHE_DIR to a writable folder" in messages[0]
    assert cached_files(folder) == before


def test_the_library_is_silent_without_a_logging_configuration(run, folder):
    for path in folder.rglob("*.nbc"):
        path.write_bytes(b"")
    script = FIRST.split("\n", 1)[1]
    assert run(folder, script) == []


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
"""Two threads that set numba's cache folder at the same time; each waits half a second for the other one."""


def test_two_threads_write_to_their_own_folders():
    process = subprocess.run([sys.executable, "-c", RACE], capture_output=True, text=True, check=True)
    assert process.stdout.split() == ["one", "two", "True"]


# folders of other versions


@pytest.fixture
def versions(tmp_path, monkeypatch):
    """Function that creates cache folders by their days since the last use; a kernel is then compiled into a new one."""
    names = {}

    def create(*days, content="dynamics_0/polynomial.evaluate-1.py311.nbi"):
        for number, age in enumerate(days):
            folder = tmp_path / f"{number:016x}"
            (folder / content).parent.mkdir(parents=True)
            (folder / content).touch()
            moment = time.time() - 86400.0 * age
            os.utime(folder, (moment, moment))
            names[folder] = age
        new = tmp_path / ("f" * 16)
        monkeypatch.setattr(cache, "cache_directory", lambda: new)
        monkeypatch.setattr(cache, "_numba_cache_dir", lambda folder: folder.mkdir(parents=True) or contextlib.nullcontext())
        cache.load_or_compile(lambda cache: "compiled", test_old_folders_are_removed_when_a_new_one_is_created)
        assert new.is_dir()
        return [age for folder, age in names.items() if folder.exists()]

    return create


def test_old_folders_are_removed_when_a_new_one_is_created(versions):
    assert versions(31, 400, 29, 0.1) == [29, 0.1]


def test_newest_of_the_old_folders_is_kept_whatever_its_age(versions):
    """Of two versions used in turn none is compiled again."""
    assert versions(400, 31) == [31]


def test_folders_that_hold_no_kernels_are_not_removed(versions):
    assert versions(400, 300, 200, content="letters/home.txt") == [400, 300, 200]


def test_use_of_a_folder_renews_its_time_of_last_use(run, folder):
    (version,) = folder.iterdir()
    os.utime(version, (0.0, 0.0))
    run(folder, FIRST)
    assert time.time() - version.stat().st_mtime < 600.0


# files that the name of the folder depends on


@pytest.mark.skipif(not _jit.ENABLED, reason="kernels are not compiled")
def test_listed_packages_hold_every_kernel():
    """A model that is not listed would be compiled within the first test that runs it."""
    listed = {id(kernel) for name in KERNEL_PACKAGES for kernel in all_kernels(name)}
    assert [kernel._function.__name__ for kernel in all_kernels("seisblock") if id(kernel) not in listed] == []


@pytest.mark.skipif(not _jit.ENABLED, reason="kernels are not compiled")
def test_kernels_passed_by_pointer_are_compiled_as_such(monkeypatch):
    """The workers of a whole run compiled them as functions of Python, which no test calls, and once more within a test."""
    functions, pointers = [], []
    monkeypatch.setattr(_jit.LazyKernel, "compiled", property(lambda kernel: functions.append(kernel)))
    monkeypatch.setattr(Model, "pointers", property(lambda model: pointers.extend((model.series, model.reset, model.skip))))
    monkeypatch.setattr(Observer, "pointer", property(lambda observer: pointers.append(observer.observe)))
    compile_all()
    assert len(pointers) > 15 and len(functions) > 10
    assert not {id(kernel) for kernel in functions} & {id(kernel) for kernel in (*pointers, *SHAPE_KERNELS)}


@pytest.mark.skipif(not _jit.ENABLED, reason="kernels are not compiled")
def test_cache_key_covers_every_file_from_which_a_kernel_takes_a_name():
    """Kernels, constants and named tuples; numba itself notices changes in the kernel's own file only."""
    sources, origins = cache.kernel_sources(), {}
    for kernel in (kernel for name in KERNEL_PACKAGES for kernel in all_kernels(name)):
        path = Path(kernel._function.__code__.co_filename)
        if path not in origins:
            nodes = [node for node in syntax_tree(path).body if isinstance(node, ast.ImportFrom) and node.module.startswith("seisblock")]
            origins[path] = {alias.asname or alias.name: node.module for node in nodes for alias in node.names}
        assert path in sources
        for name in kernel._function.__code__.co_names:
            if name in origins[path]:
                base = PACKAGE.parent.joinpath(*origins[path][name].split("."))
                assert {base.with_suffix(".py"), base / "__init__.py"} & sources.keys(), f"{path.name}: {name}"
    assert len(origins) > 40


def test_cache_key_covers_less_than_half_of_the_files_of_the_folders_with_kernels():
    """Figures, films and documents may change without compiling anything again."""
    folders, sources = ("dynamics", "measures", "models", "records"), cache.kernel_sources()
    assert 2 * len(sources) < sum(1 for folder in folders for _ in (PACKAGE / folder).rglob("*.py"))
    rest = [path for name in ("plot", "animate", "document", "describe") for path in (PACKAGE / "models").rglob(f"{name}.py")]
    assert len(rest) > 20
    assert not sources.keys() & set(rest)


def test_kernels_are_defined_in_the_folders_that_the_cache_key_searches():
    pattern = re.compile(r"from seisblock\._jit import|from seisblock import .*_jit")
    folders = {path.relative_to(PACKAGE).parts[0] for path in PACKAGE.rglob("*.py") if pattern.search(path.read_text("utf-8"))}
    assert folders == {"_jit", "dynamics", "measures", "models", "records"}


def test_a_changed_constant_changes_the_cache_folder(monkeypatch):
    sources = cache.kernel_sources()
    names = []
    for text in ("CHATTERING = 1", "CHATTERING = 2"):
        cache.cache_directory.cache_clear()
        monkeypatch.setattr(cache, "kernel_sources", lambda text=text: sources | {PACKAGE / "core" / "status.py": text})
        names.append(cache.cache_directory().name)
    cache.cache_directory.cache_clear()
    assert PACKAGE / "core" / "status.py" in sources
    assert len(set(names)) == 2


def test_messages_of_the_logger_reach_a_handler(tmp_path, monkeypatch, caplog):
    """Library users configure the logger ``seisblock.jit``."""
    monkeypatch.setattr(cache, "cache_directory", lambda: tmp_path / "file" / "below")
    monkeypatch.setattr(cache, "_read_only", False)
    (tmp_path / "file").touch()
    with caplog.at_level(logging.INFO, "seisblock.jit"):
        assert cache.load_or_compile(lambda cache: cache, start) is False
    assert [record.levelname for record in caplog.records] == ["WARNING"]
    assert "cannot write the kernel cache" in caplog.text
