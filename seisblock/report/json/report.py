"""JSON document of ``seisblock report``: one result per body and direction, and each body as an object."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

from msgspec import Struct

from seisblock.core.registry import get_solver
from seisblock.measures.shaking import BodyShaking, response_shaking
from seisblock.output.json.bodies import BlockEntry, block_entry
from seisblock.output.json.schema import Document, DocumentSchema, Result
from seisblock.report.json.assessment import OBJECT_KEY, AssessmentEntry, assessment_entry
from seisblock.studies.report.responses import BodyResponses, ModelResponse, ReportData


class ReportParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    bodies : list of str
        Names, in the order of ``object``.
    gravity_m_s2 : float
    """

    bodies: tuple[str, ...]
    gravity_m_s2: float


class ReportModel(Struct, frozen=True, kw_only=True):
    """Result of one model; ``seisblock MODEL`` gives the whole of it.

    Parameters
    ----------
    model : str
    happened : bool
        Whether the event of the model occurred: overturning, sliding, jump, uplift.
    overturned : bool or None
        Null for a model without overturning.
    displacement_m : float or None
        Null for a model without displacement.
    onset_factor : float or None
        Factor on the record at which rocking, sliding or uplift starts.
    shaking : BodyShaking
    """

    model: str
    happened: bool
    overturned: bool | None
    displacement_m: float | None
    onset_factor: float | None
    shaking: BodyShaking


class ReportResult(Result, frozen=True, kw_only=True):
    """One body in one direction.

    Parameters
    ----------
    body : str
    component : str
        Direction of the record that is +x.
    block : BlockEntry
    mu, mu_kinetic : float
        Friction of the full response.
    friction_known : bool
        False if unknown; a friction almost without sliding is then assumed.
    assessment : AssessmentEntry
    models : list of ReportModel
        The full response first, then the idealised models.
    """

    body: str
    component: str
    block: BlockEntry
    mu: float
    mu_kinetic: float
    friction_known: bool
    assessment: AssessmentEntry
    models: tuple[ReportModel, ...]


REPORT = DocumentSchema("report", ReportParameters, ReportResult, {"object": OBJECT_KEY})


def document(data: ReportData) -> Document:
    """Return the document of a report.

    Parameters
    ----------
    data : ReportData
    """
    objects = [assessment_entry(body.assessment) for body in data.bodies]
    return REPORT.document(
        ReportParameters(bodies=tuple(str(body.subject.name) for body in data.bodies), gravity_m_s2=data.gravity),
        [(data.record, entry) for body in data.bodies for entry in _body_entries(body)],
        citations=data.citations,
        warnings=data.warnings,
        object=objects[0] if len(objects) == 1 else objects,
    )


def _body_entries(body: BodyResponses) -> Iterator[ReportResult]:
    """Yield the result of each direction of a body."""
    for name in dict.fromkeys(effect.response.motion.name for effect in body.effects):
        effects = [effect for effect in body.effects if effect.response.motion.name == name]
        full = next(effect for effect in effects if effect.assessment is not None)
        assert full.assessment is not None
        options = full.response.options
        yield ReportResult(
            body=str(body.subject.name),
            component=name,
            block=block_entry(body.subject.block),
            mu=options.mu,
            mu_kinetic=options.mu if options.mu_kinetic is None else options.mu_kinetic,
            friction_known=full.friction_known,
            assessment=assessment_entry(full.assessment.assessment),
            models=tuple(map(_model_entry, effects)),
        )


def _model_entry(effect: ModelResponse) -> ReportModel:
    solver, outcome = get_solver(effect.response.model), effect.response.outcome
    values = {field.name: getattr(outcome, field.name) for field in fields(outcome)}
    return ReportModel(
        model=solver.name,
        happened=solver.event_occurred(values),
        overturned=solver.overturns(values),
        displacement_m=None if solver.displacement is None else values[solver.displacement],
        onset_factor=effect.onset,
        shaking=response_shaking(effect.response),
    )
