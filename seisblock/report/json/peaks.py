"""JSON document of ``seisblock criteria`` and ``seisblock rock`` with peaks instead of a record."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from seisblock.core.i18n import Message
from seisblock.criteria.compare import CriterionResult
from seisblock.models.rock.options import RockOptions
from seisblock.output.json.bodies import BlockEntry, block_entry
from seisblock.output.json.schema import NOTES_KEY, Document, DocumentSchema, Result
from seisblock.references import find_citations, papers
from seisblock.studies.scenario.peaks import PeakAssessment, SuiteProbability


class PeakParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    block : BlockEntry
    pga_m_s2, pgv_m_s : float
        Given peaks.
    gravity_m_s2 : float
    seed : int or None
        Of the suite; null without runs.
    """

    block: BlockEntry
    pga_m_s2: float
    pgv_m_s: float
    gravity_m_s2: float
    seed: int | None


class PeakResult(Result, frozen=True, kw_only=True):
    """Result of one pair of peaks.

    Parameters
    ----------
    equivalent_frequency_hz : float
        PGA/(2 pi PGV).
    criteria : list of CriterionResult
        Threshold and demand in the unit of the row.
    suite : SuiteProbability or None
        Runs under records scaled to both peaks; null in criteria.
    """

    equivalent_frequency_hz: float
    criteria: tuple[CriterionResult, ...]
    suite: SuiteProbability | None


def peak_schema(command: str) -> DocumentSchema:
    """Return the document schema of a command with peaks instead of a record."""
    return DocumentSchema(command, PeakParameters, PeakResult, NOTES_KEY, name="peaks")


def document(
    result: PeakAssessment, schema: DocumentSchema, options: RockOptions, *, seed: int | None = None, notes: Sequence[Message] = ()
) -> Document:
    """Return the document of a block under the peaks of a motion."""
    cited = find_citations(row.where for row in result.rows)
    return schema.document(
        PeakParameters(
            block=block_entry(result.block),
            pga_m_s2=result.pga_m_s2,
            pgv_m_s=result.pgv_m_s,
            gravity_m_s2=options.gravity,
            seed=seed,
        ),
        [(None, PeakResult(equivalent_frequency_hz=result.frequency_hz, criteria=result.rows, suite=result.suite))],
        citations=[*cited, *(papers("rocking", "scenario", "synthetic records") if result.suite else ())],
        notes=[str(note) for note in notes],
    )
