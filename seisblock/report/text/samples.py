"""List of the bundled files with their terms of use, and copies of them."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.padding import Padding

from seisblock.core.errors import OutputError, RecordNotFoundError, os_error_text
from seisblock.core.i18n import gettext
from seisblock.output.io.atomic import atomic_write
from seisblock.output.text.tables import styled_line
from seisblock.samples import Sample, list_samples, sample_directory

NOTICE, COPIED_NOTICE = "NOTICE", "seisblock-samples-NOTICE.txt"
"""File with the terms of third-party files, and its name beside copies."""


def select_samples(names: Sequence[str]) -> list[Sample]:
    """Return the samples with these file names or stems; all without a name.

    Raises
    ------
    RecordNotFoundError
        If there is no such sample; the message lists those there are.
    """
    samples = list_samples()
    selection: dict[str, Sample] = {}
    for name in names:
        lower_name = name.lower()
        hits = [s for s in samples if s.name.lower() == lower_name] or [s for s in samples if s.name.lower().split(".")[0] == lower_name]
        if not hits:
            raise RecordNotFoundError("no bundled sample {name!r}; available: {known}", name=name, known=[s.name for s in samples])
        selection.update({sample.name: sample for sample in hits})
    return list(selection.values()) if names else list(samples)


def sample_lines(samples: Sequence[Sample]) -> Iterator[Any]:
    """Yield name, kind and peaks, with description, terms and origin; a repeated origin once."""
    last_origin = ""
    for sample in samples:
        peaks = ", ".join(f"{code} {value:.0f}" for code, value in sample.pga_gal.items())
        heading = styled_line(sample.name, "bold").append(f"  {gettext(sample.kind)}", style="not bold dim")
        yield heading.append(f"  PGA {peaks} gal" if peaks else "", style="not bold")
        origin = gettext("origin: as above") if sample.origin == last_origin else gettext("origin: {origin}", origin=gettext(sample.origin))
        last_origin = sample.origin
        yield Padding(styled_line(gettext(sample.description)), (0, 0, 0, 2))
        yield Padding(styled_line(f"{gettext('licence: {licence}', licence=gettext(sample.licence))}\n{origin}", "dim"), (0, 0, 1, 2))


def copy_samples(samples: Sequence[Sample], directory: Path, *, overwrite: bool = False) -> list[Path]:
    """Copy samples and their notice of terms to a folder; return the files written.

    A file that is there already with the same content stays; another content is refused before anything is written.

    Raises
    ------
    OutputError
        If the directory is a file, or a file of another content is in the way and `overwrite` is not set.
    """
    if directory.exists() and not directory.is_dir():
        raise OutputError("cannot copy to {directory}: it is a file; give a folder", directory=directory)
    names = [*((sample.name, sample.name) for sample in samples), (NOTICE, COPIED_NOTICE)]
    pairs = [(sample_directory() / name, directory / target_name) for name, target_name in names]
    copies = [(source, target) for source, target in pairs if not _has_same_content(source, target)]
    blocked = [target.name for _, target in copies if target.exists()]
    if blocked and not overwrite:
        raise OutputError(
            "{directory} already contains a different {blocked}; choose another folder or give --overwrite",
            directory=directory,
            blocked=blocked,
        )
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError("cannot create the folder {directory}: {reason}", directory=directory, reason=os_error_text(error)) from error
    for source, target in copies:
        with atomic_write(target) as temporary:
            temporary.write_bytes(source.read_bytes())
    return [target for _, target in copies]


def _has_same_content(source: Path, target: Path) -> bool:
    return target.is_file() and hashlib.sha256(target.read_bytes()).digest() == hashlib.sha256(source.read_bytes()).digest()
