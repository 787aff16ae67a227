"""JSON documents of ``seisblock cite`` and ``seisblock samples``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from msgspec import Meta, Struct

from seisblock.core.units import GAL
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.references.reference import Reference
from seisblock.samples import Sample, sample_directory


class CiteParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    command : str or None
        Command of the references; null: all references.
    """

    command: str | None


class SamplesParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    copied_to : str or None
        Directory of the copies.
    """

    copied_to: str | None


class SampleResult(Result, frozen=True, kw_only=True):
    """One bundled file.

    Parameters
    ----------
    name, kind, description, origin, licence, sha256 : str
    pga_m_s2 : dict
        PGA of each component; empty for files other than records.
    path : str
    """

    name: str
    kind: str
    description: str
    origin: str
    licence: str
    sha256: str
    pga_m_s2: dict[str, float]
    path: str


REFERENCE_RESULT = entry_type(
    "ReferenceResult",
    Reference,
    extra={
        "text": Annotated[str, Meta(description="One line of a bibliography.")],
        "bibtex": Annotated[str, Meta(description="A BibTeX entry.")],
    },
)
CITE = DocumentSchema("cite", CiteParameters, REFERENCE_RESULT)
SAMPLES = DocumentSchema("samples", SamplesParameters, SampleResult)


def cite_document(command: str | None, references: Sequence[Reference], keys: Sequence[str]) -> Document:
    """Return the document of references."""
    entries = ((None, to_entry(REFERENCE_RESULT, reference, text=reference.text(), bibtex=reference.bibtex())) for reference in references)
    return CITE.document(CiteParameters(command=command), entries, citations=keys)


def samples_document(samples: Sequence[Sample], copied_to: Path | None) -> Document:
    """Return the document of bundled files."""
    entries = (
        (
            None,
            fill(
                SampleResult,
                sample,
                pga_m_s2={code: round(value * GAL, 9) for code, value in sample.pga_gal.items()},
                path=str(sample_directory() / sample.name),
            ),
        )
        for sample in samples
    )
    return SAMPLES.document(SamplesParameters(copied_to=None if copied_to is None else str(copied_to)), entries)
