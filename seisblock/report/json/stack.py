"""JSON documents of ``seisblock stack``: the response, its probability and the models of the top stone; and the criterion study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta, Struct, UnsetType

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.core.results import Response
from seisblock.criteria.gravestones import GravestoneFit, furukawa_fit, overturning_level
from seisblock.models.stack.outcome import StackOutcome
from seisblock.output.json.bodies import PileContactEntry, PileEntry, pile_contact_entry, pile_entry
from seisblock.output.json.schema import Document, DocumentSchema, Result
from seisblock.output.json.solver import document as solver_document
from seisblock.output.json.solver import solver_schema
from seisblock.records import Record
from seisblock.references import papers
from seisblock.report.json.assessment import ASSESSMENT_KEY, entry_keys
from seisblock.studies.gravestone_criterion import CriterionStudy, Threshold, study_frequencies
from seisblock.studies.model_comparison import ModelComparison, compare_pile_models
from seisblock.studies.respond.pile_probability import PileProbability

AGREEMENT_KEY = Annotated[ModelComparison | None, Meta(description="Results of models of the top stone; null if the stone is restrained.")]
PROBABILITY_KEY = Annotated[PileProbability, Meta(description="Probabilities of falling stones; absent with --runs 0.")] | UnsetType
STACK = solver_schema(
    "stack", results={"agreement": AGREEMENT_KEY, "assessment": ASSESSMENT_KEY | UnsetType, "probability": PROBABILITY_KEY}
)


def document(responses: Sequence[Response[StackOutcome]], extras: Sequence[Mapping[str, Any]]) -> Document:
    """Return the document of one run per direction, with model comparison and probability."""
    return solver_document(responses, STACK, results=list(map(entry_keys, extras)))


def response_document(response: Response[Any]) -> Document:
    """Return the document of one response."""
    return document([response], [{"agreement": compare_pile_models(response)}])


class StudyParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the criterion study.

    Parameters
    ----------
    law : str
        Of contact: rigid or springs.
    points : int
        Contact points along each side of a joint; 2: its edges.
    gravity_m_s2 : float
    criterion : bool
        True.
    grid : int
        Stride of the amplitudes and heights.
    contact : PileContactEntry or None
        Null for rigid contact.
    pile : PileEntry
    """

    law: str
    points: int
    gravity_m_s2: float
    criterion: bool
    grid: int
    contact: PileContactEntry | None
    pile: PileEntry


class LevelEntry(Struct, frozen=True, kw_only=True):
    """a(f) = PGA H/B at one frequency.

    Parameters
    ----------
    frequency_hz : float
    level_m_s2 : float or None
        Of the pile, eq. (7); null without overturning.
    rigid_block_m_s2 : float or None
        Of one rigid block on the outermost points.
    published_m_s2 : float
    """

    frequency_hz: float
    level_m_s2: float | None
    rigid_block_m_s2: float | None
    published_m_s2: float


class PublishedEntry(Struct, frozen=True, kw_only=True):
    """The paper's fit, and the number of its equation."""

    equation: str
    fit: GravestoneFit


class ScaledEntry(Struct, frozen=True, kw_only=True):
    """One scaled record and its thresholds."""

    record: str
    thresholds: tuple[Threshold, ...]


class StudyResult(Result, frozen=True, kw_only=True):
    """The criterion study.

    Parameters
    ----------
    thresholds : list of Threshold
    levels : list of LevelEntry
    fit : GravestoneFit or None
        Least squares of eq. (8); null with too few levels.
    published : PublishedEntry
    scaled_records : list of ScaledEntry
    """

    thresholds: tuple[Threshold, ...]
    levels: tuple[LevelEntry, ...]
    fit: GravestoneFit | None
    published: PublishedEntry
    scaled_records: tuple[ScaledEntry, ...]


STUDY = DocumentSchema("stack", StudyParameters, StudyResult, name="criterion", version=3)


def study_document(
    study: CriterionStudy,
    rigid: Mapping[float, float],
    record_thresholds: Mapping[str, tuple[Threshold, ...]],
    records: Sequence[Record],
    *,
    reinforced: bool,
    pile: Pile,
    law: str,
    contact: PileContact | None,
    points: int,
    gravity: float,
    grid: int,
) -> Document:
    """Return the document of the criterion study, with levels of one rigid block and thresholds of scaled records."""
    fit, equation = furukawa_fit(reinforced)
    result = StudyResult(
        thresholds=study.thresholds,
        levels=tuple(
            LevelEntry(
                frequency_hz=f,
                level_m_s2=study.levels.get(f),
                rigid_block_m_s2=rigid.get(f),
                published_m_s2=float(overturning_level(f, fit)),
            )
            for f in study_frequencies(study)
        ),
        fit=study.fit,
        published=PublishedEntry(equation=equation, fit=fit),
        scaled_records=tuple(ScaledEntry(record=name, thresholds=thresholds) for name, thresholds in record_thresholds.items()),
    )
    parameters = StudyParameters(
        law=law,
        points=points,
        gravity_m_s2=gravity,
        criterion=True,
        grid=grid,
        contact=None if contact is None else pile_contact_entry(contact),
        pile=pile_entry(pile),
    )
    return STUDY.document(parameters, [(None, result)], records=records, citations=papers("rigid pile" if contact is None else "pile"))
