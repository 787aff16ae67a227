"""Which records come with the package, and where they lie."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from seisblock.core.errors import RecordNotFoundError

DEFAULT_SAMPLE = "synthetic_jma.csv"
"""The sample that commands use when no record is named: no bundled recording is strong enough to let what they are about happen."""

REAL_SAMPLE = "hanmer_springs_2016.V1A.gz"
"""The sample that stands for none where a recording shows more: what it is, where it was made, and of what earthquake."""

MANIFEST = "MANIFEST.toml"


@dataclass(frozen=True)
class Sample:
    """One bundled file, as MANIFEST.toml describes it.

    Parameters
    ----------
    name : str
        File name.
    description, origin, licence : str
        What it is, where it comes from, on what terms.
    sha256 : str
        Digest of its bytes.
    kind : str
        ``record``, or ``body``, ``cemetery``, ``outcomes`` and ``hazard`` for what is no record.
    pga_gal : dict of str to float
        Largest absolute acceleration of each component, for K-NET after its mean is removed, gal; empty when the file is no record.
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
    """Return the directory of the bundled records: inside the installed package, or beside it in a source tree."""
    package = Path(__file__).resolve().parent
    for directory in (package / "sample_records", package.parent / "sample_records"):
        if (directory / MANIFEST).is_file():
            return directory
    raise RecordNotFoundError("the bundled sample records are missing from this installation: install seisblock again")


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
        Its file name, or the name up to the first dot (``synthetic_jma``).

    Raises
    ------
    RecordNotFoundError
        If there is no such sample; the message lists those there are.

    Examples
    --------
    >>> sample_path("aoyama").name
    'aoyama.csv'
    """
    path = find_sample(name)
    if path is None:
        raise RecordNotFoundError(
            "no bundled sample is called {name!r}; there are {known}", name=name, known=[s.name for s in list_samples()]
        )
    return path


def resolve_file_or_sample(path: Path, kind: str) -> Path | None:
    """Return a path that exists, else the bundled file of a kind that its name alone means, or None."""
    if path.exists():
        return path
    sample = find_sample(str(path)) if path.parent == Path() else None
    return sample if sample is not None and sample.name in sample_names(kind) else None


def sample_names(kind: str) -> list[str]:
    """Return the names of the bundled files of a kind."""
    return [sample.name for sample in list_samples() if sample.kind == kind]


def find_sample(name: str) -> Path | None:
    """Return the path of the sample of that file name or stem, or None."""
    key = name.lower()
    samples = {sample.name.lower(): sample.name for sample in reversed(list_samples())}
    stems = {spelling.split(".")[0]: full for spelling, full in samples.items()}
    filename = samples.get(key) or stems.get(key)
    return None if filename is None else sample_directory() / filename
