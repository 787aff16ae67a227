"""Bundled sample files: records, bodies, cemeteries, hazard curves and test results."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from seisblock.core._display import DisplayMixin
from seisblock.core.errors import RecordNotFoundError

DEFAULT_SAMPLE = "synthetic_jma.csv"
"""Default record of the commands. It is synthetic, because the bundled recordings are too weak to overturn common bodies."""

REAL_SAMPLE = "hanmer_springs_2016.V1A.gz"
"""Default record of commands that need station and earthquake metadata."""

MANIFEST = "MANIFEST.toml"


@dataclass(frozen=True, repr=False)
class Sample(DisplayMixin):
    """Bundled file with its entry in MANIFEST.toml.

    Parameters
    ----------
    name : str
        File name.
    description, origin, licence : str
        Content, source and terms of use.
    sha256 : str
        SHA-256 digest of the file.
    kind : str
        ``record``, ``body``, ``scan``, ``cemetery``, ``motions``, ``outcomes`` or ``hazard``.
    pga_gal : dict of str to float
        Peak absolute acceleration of each component, gal (K-NET: after removal of the mean); empty for other kinds.
    """

    name: str
    description: str
    origin: str
    licence: str
    sha256: str
    kind: str
    pga_gal: dict[str, float]


@cache
def sample_directory() -> Path:
    """Return the folder of the bundled files: inside the installed package, or beside it in a source tree."""
    package = Path(__file__).resolve().parent
    for directory in (package / "sample_records", package.parent / "sample_records"):
        if (directory / MANIFEST).is_file():
            return directory
    raise RecordNotFoundError("the bundled sample files are missing from this installation: reinstall seisblock")


@cache
def list_samples() -> tuple[Sample, ...]:
    """Return the bundled samples, in the order of MANIFEST.toml.

    Examples
    --------
    >>> "synthetic_jma.csv" in [sample.name for sample in list_samples()]
    True
    """
    document = tomllib.loads((sample_directory() / MANIFEST).read_text(encoding="utf-8"))
    return tuple(
        Sample(
            name=entry["name"],
            description=entry.get("description", ""),
            origin=entry.get("origin", ""),
            licence=entry.get("licence", ""),
            sha256=entry.get("sha256", ""),
            kind=entry.get("kind", "record"),
            pga_gal=dict(entry.get("pga_gal", {})),
        )
        for entry in document["sample"]
    )


def sample_path(name: str = DEFAULT_SAMPLE) -> Path:
    """Return the path of a bundled sample.

    Parameters
    ----------
    name : str
        File name, or the part of it before the first dot (``synthetic_jma``).

    Returns
    -------
    Path

    Raises
    ------
    RecordNotFoundError
        If the sample does not exist; the message lists the available ones.

    Examples
    --------
    >>> from seisblock.samples import sample_path
    >>> sample_path("aoyama").name
    'aoyama.csv'
    """
    path = find_sample(name)
    if path is None:
        raise RecordNotFoundError("unknown sample {name!r}: expected one of {known}", name=name, known=[s.name for s in list_samples()])
    return path


def resolve_file_or_sample(path: Path, kind: str) -> Path | None:
    """Return the path if it exists, else the path of the bundled file of that name and kind, or None."""
    if path.exists():
        return path
    sample = find_sample(str(path)) if path.parent == Path() else None
    return sample if sample is not None and sample.name in sample_names(kind) else None


def sample_names(kind: str) -> list[str]:
    """Return the names of the bundled files of a kind."""
    return [sample.name for sample in list_samples() if sample.kind == kind]


def find_sample(name: str) -> Path | None:
    """Return the path of a sample by file name or stem (case-insensitive), or None."""
    key = name.lower()
    samples = {sample.name.lower(): sample.name for sample in reversed(list_samples())}
    stems = {spelling.split(".")[0]: full for spelling, full in samples.items()}
    filename = samples.get(key) or stems.get(key)
    return None if filename is None else sample_directory() / filename


__all__ = ["DEFAULT_SAMPLE", "REAL_SAMPLE", "Sample", "list_samples", "sample_path"]
