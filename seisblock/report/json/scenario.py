"""JSON document of ``seisblock scenario``: objects, worst first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import NOTES_KEY, Document, DocumentSchema
from seisblock.records import Record
from seisblock.references import command_papers
from seisblock.studies.scenario.assess import ObjectRisk
from seisblock.studies.scenario.motions import ScenarioTarget

if TYPE_CHECKING:
    from seisblock.core.i18n import Message


class ScenarioParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    jma_intensity : float or None
    pga_m_s2, pgv_m_s, sa_m_s2, period_s : float or None
        Intensity to which the records are scaled; null for records as they are.
    records : int
    suite : bool
        True if the records are those of the program.
    mu : float or None
        Friction of objects for which none is given; null: 0.2 to 0.7.
    vertical : bool or None
        Null: the vertical component acts where a record has one.
    gravity_m_s2 : float
    seed : int
    """

    jma_intensity: float | None
    pga_m_s2: float | None
    pgv_m_s: float | None
    sa_m_s2: float | None
    period_s: float | None
    records: int
    suite: bool
    mu: float | None
    vertical: bool | None
    gravity_m_s2: float
    seed: int


def scenario_parameters(
    target: ScenarioTarget | None, records: Sequence[Record], values: Mapping[str, Any], *, suite: bool
) -> ScenarioParameters:
    """Return the parameters of a scenario."""
    used = target or None
    return ScenarioParameters(
        jma_intensity=used and used.jma,
        pga_m_s2=used and used.pga_m_s2,
        pgv_m_s=used and used.pgv_m_s,
        sa_m_s2=used and used.sa_m_s2,
        period_s=used and used.period_s,
        records=len(records),
        suite=suite,
        **values,
    )


SCENARIO_RESULT = entry_type("ScenarioResult", ObjectRisk, aliases={"class_name": "class"})
SCENARIO = DocumentSchema("scenario", ScenarioParameters, SCENARIO_RESULT, NOTES_KEY)


def document(results: Sequence[ObjectRisk], motions: Any, values: Mapping[str, Any], *, notes: Sequence[Message] = ()) -> Document:
    """Return the document of a scenario.

    Parameters
    ----------
    results : sequence of ObjectRisk
    motions : ScenarioMotions
        Records with their intensity.
    values : mapping
        Further parameters.
    notes : sequence of Message
    """
    return SCENARIO.document(
        scenario_parameters(motions.target, motions.records, values, suite=motions.is_suite),
        [(None, to_entry(SCENARIO_RESULT, result, **{"class": result.class_name})) for result in results],
        records=() if motions.is_suite else motions.records,
        citations=command_papers("scenario"),
        notes=[str(note) for note in notes],
    )
