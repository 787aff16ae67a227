"""On-disk cache of kernels: numba's files and their digests, one folder per kernel, below a folder named after the sources."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import logging
import os
import re
import shutil
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from seisblock.core.errors import os_error_text
from seisblock.core.i18n import N_, lazy_gettext

logger = logging.getLogger("seisblock.jit")
logger.addHandler(logging.NullHandler())
_log_once = functools.cache(logger.log)

KEEP_S = 30 * 86400.0
"""Time since the last use, s, after which the cache folder of another version is removed, unless it is the newest one."""

_CONSTANT = re.compile(r"\b[A-Z][A-Z\d_]*\b")
_config_lock = threading.RLock()
_read_only = False


def kernel_sources() -> dict[Path, str]:
    """Return the files that define kernels, and those from which these import constants, with their texts."""
    package = Path(__file__).parents[1]
    paths = [path for folder in ("_jit", "dynamics", "measures", "models", "records") for path in (package / folder).rglob("*.py")]
    texts = {path: path.read_text("utf-8") for path in paths}
    sources = {path: text for path, text in texts.items() if path.parent.name == "_jit" or "\nfrom seisblock._jit import" in text}
    pending = list(sources.values())
    while pending:
        for statement in pending.pop().split("\nfrom seisblock.")[1:]:
            module, _, names = statement.partition(" import ")
            if _CONSTANT.search(names.split(")" if names.startswith("(") else "\n", 1)[0]):
                base = package.joinpath(*module.split("."))
                path = base / "__init__.py" if base.is_dir() else base.with_suffix(".py")
                if path not in sources:
                    sources[path] = texts.get(path) or path.read_text("utf-8")
                    pending.append(sources[path])
    return sources


@functools.cache
def cache_directory() -> Path:
    """Return the cache folder of these sources, since numba does not notice that a kernel in another file has changed."""
    import numba

    # with the paths, which numba's cache keys contain: two installations cannot share entries
    sources = "".join(f"{path}{text}" for path, text in sorted(kernel_sources().items()))
    name = hashlib.sha256(f"{sys.version}{numba.__version__}{sources}".encode()).hexdigest()[:16]
    if os.environ.get("SEISBLOCK_CACHE_DIR"):
        return Path(os.environ["SEISBLOCK_CACHE_DIR"]) / name
    import platformdirs

    return platformdirs.user_cache_path("seisblock", appauthor=False) / name


def load_or_compile(compile_kernel: Callable[..., Any], function: Any, variant: str = "") -> Any:
    """Return the numba dispatcher of a function, from the cache as far as that works; `compile_kernel` takes the keyword ``cache``."""
    global _read_only
    name = f"{function.__module__}.{function.__qualname__}-{function.__code__.co_firstlineno}{variant}"
    entry = cache_directory() / hashlib.sha256(name.encode()).hexdigest()[:16]
    place = str(entry.parent)
    if os.access(entry, os.W_OK):  # numba does not load from read-only folders
        try:
            return _load(compile_kernel, entry)
        except (OSError, ValueError, RuntimeError):
            text = lazy_gettext("kernel cache {place}: damaged file; the affected kernels are compiled again", place=place)
            _log_once(logging.WARNING, text)
            shutil.rmtree(entry, ignore_errors=True)
    if not _read_only:
        try:
            return _compile_and_save(compile_kernel, entry)
        except (OSError, RuntimeError) as error:
            why = os_error_text(error) if isinstance(error, OSError) else str(error)
            text = lazy_gettext(
                "cannot write the kernel cache {place} ({why}): kernels are compiled in every run; "
                "set SEISBLOCK_CACHE_DIR to a writable folder",
                place=place,
                why=why,
            )
            _log_once(logging.WARNING, text)
            _read_only = True
    return compile_kernel(cache=False)


def _load(compile_kernel: Callable[..., Any], entry: Path) -> Any:
    """Load a kernel; raise ValueError if a file has changed, since its machine code must not be executed."""
    if (entry / "SHA256SUMS").read_text("ascii") != _digests(entry):
        raise ValueError("checksum mismatch")
    os.utime(entry.parent)  # time of last use
    with _numba_cache_dir(entry):
        compiled = compile_kernel(cache=True)
    if compiled.stats.cache_misses:  # numba has added the machine code of another processor
        (entry / "SHA256SUMS").write_text(_digests(entry), "ascii")
    return compiled


def _compile_and_save(compile_kernel: Callable[..., Any], entry: Path) -> Any:
    """Compile a kernel into a temporary folder, which becomes that of the kernel once it is complete."""
    if not entry.parent.exists():
        entry.parent.mkdir(parents=True, exist_ok=True)
        _remove_old(entry.parent)
    with tempfile.TemporaryDirectory(dir=entry.parent) as temporary:
        with _config_lock:  # threads that compile at the same time print one message
            _log_once(logging.INFO, lazy_gettext("compiling kernels (first run only, up to 30 s)..."))
        logger.debug("compiling %s", entry, extra={"task": N_("compiling kernels")})
        folder = Path(temporary) / entry.name
        with _numba_cache_dir(folder):
            compiled = compile_kernel(cache=True)
        logger.debug("compiled %s", entry, extra={"task": N_("computing")})
        (folder / "SHA256SUMS").write_text(_digests(folder), "ascii")
        with contextlib.suppress(OSError):  # another process was faster
            folder.rename(entry)
    return compiled


def _digests(entry: Path) -> str:
    """Return the digests of the files of a kernel, in the format of ``sha256sum``."""
    files = sorted(entry.glob("*/*.nb[ci]"))
    return "".join(f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.relative_to(entry).as_posix()}\n" for file in files)


def _remove_old(folder: Path) -> None:
    """Remove cache folders of other versions that have not been used for :data:`KEEP_S`, all but the newest."""
    with contextlib.suppress(OSError):
        others = [path for path in folder.parent.iterdir() if path != folder and re.fullmatch("[0-9a-f]{16}", path.name)]
        for path in sorted(others, key=lambda other: other.stat().st_mtime)[:-1]:
            if time.time() - path.stat().st_mtime > KEEP_S and next(path.rglob("*.nbi"), None):
                shutil.rmtree(path, ignore_errors=True)


@contextlib.contextmanager
def _numba_cache_dir(folder: Path) -> Iterator[None]:
    """Point numba's cache at a folder inside the block; the settings are global, and the user's own kernels need theirs."""
    from numba import config

    settings = {"CACHE_DIR": str(folder), "CACHE_LOCATOR_CLASSES": "UserProvidedCacheLocator"}
    with _config_lock, contextlib.ExitStack() as stack:
        for name, value in settings.items():
            stack.callback(setattr, config, name, getattr(config, name, ""))
            setattr(config, name, value)
        yield
