"""Writing a file so that an interruption never harms one that is there."""

from __future__ import annotations

import contextlib
import csv
import io
import os
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from seisblock.errors import OutputError
from seisblock.results import Response


@contextlib.contextmanager
def replacing(path: Path | str) -> Iterator[Path]:
    """Give a temporary name beside `path`, and move it there when the block ends well.

    Raises
    ------
    OutputError
        If the directory does not exist or cannot be written.
    """
    target = Path(path)
    if target.is_dir():
        raise OutputError(f"{target} is a directory: give a file name")
    if not target.parent.exists():
        raise OutputError(f"cannot write {target}: there is no directory {target.parent}")
    try:
        handle, name = tempfile.mkstemp(prefix=f".{target.stem}-", suffix=target.suffix, dir=target.parent)
    except OSError as error:
        raise OutputError(f"cannot write {target}: {error.strerror}") from error
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
        temporary.chmod(mode)
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


def _umask() -> int:
    """Return the process's file mode mask."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write_text(path: Path | str, text: str) -> None:
    """Write a text file in UTF-8, whole or not at all."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_table(path: Path | str, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write rows as CSV; floats keep all their digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    write_text(path, text.getvalue())


def write_histories(path: Path | str, responses: Sequence[Response[Any]]) -> None:
    """Write the time histories of responses, one below the other, with the component in the first column and the phase in the last.

    Rows stand at the samples and at both limits of every event; floats keep all their digits.
    """
    if not responses:
        raise OutputError(f"cannot write {path}: there is no time history to write")
    blocks = [response.to_columns() for response in responses]
    names = list(dict.fromkeys(name for block in blocks for name in block))
    rows: list[list[Any]] = []
    for response, block in zip(responses, blocks, strict=True):
        columns = [block[name].tolist() if name in block else [""] * response.time.size for name in names]
        phases = np.array([phase.name for phase in response.phases] or [""])[response.phase_of_row()].tolist()
        rows.extend([response.motion.name, *values] for values in zip(*columns, phases, strict=True))
    write_table(path, ["component", *names, "phase"], rows)
