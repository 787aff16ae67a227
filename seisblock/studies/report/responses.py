"""Responses of some bodies under one record by every applicable model, for a report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.factory import block_for_motion
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.i18n import lazy_gettext
from seisblock.core.results import Response
from seisblock.core.typing import Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.criteria.compare import CriterionResult, overturning_card
from seisblock.measures import ComponentMeasures, Conventions, RecordMeasures, measure
from seisblock.models.jump.solve import solve_jump
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.solve import solve_rock
from seisblock.models.slide.solve import solve_slide
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records import Motion, Record, motion_of
from seisblock.references import find_citations
from seisblock.studies.assessment import Assessment, DirectionAssessment, assess_direction, assess_object
from seisblock.studies.report.models import BodyModels
from seisblock.studies.respond.best_estimate import best_estimate
from seisblock.studies.respond.probability import Probability, summarize
from seisblock.studies.rocking.margin import Margin, find_margin, flag_near_flip
from seisblock.studies.sampling import RUNS


@dataclass(frozen=True, eq=False)
class ModelResponse:
    """Response of one body under one component by one model.

    Parameters
    ----------
    response : Response
        Of the full model, ``respond``, or of an idealised one.
    onset : float or None
        Factor on the record at which rocking, sliding or uplift starts; None if undefined.
    margin : Margin or None
        Of rocking: the factors at which the verdict changes.
    probability : Probability or None
        Of the full model.
    assessment : DirectionAssessment or None
        Of the full model.
    friction_known : bool
        False if the friction is assumed.
    """

    response: Response[Any]
    onset: float | None
    margin: Margin | None = None
    probability: Probability | None = None
    assessment: DirectionAssessment | None = None
    friction_known: bool = True

    @property
    def kind(self) -> str:
        """Name of the solver."""
        return self.response.model


@dataclass(frozen=True, eq=False)
class BodyResponses:
    """Responses of one body, and its criteria for each component."""

    subject: BodyModels
    effects: tuple[ModelResponse, ...]
    cards: dict[str, tuple[CriterionResult, ...]]

    @property
    def assessment(self) -> Assessment:
        """Assessment of the body under any of the directions."""
        return assess_object([effect.assessment for effect in self.effects if effect.assessment is not None])


@dataclass(frozen=True, eq=False)
class ReportData:
    """A record, its measures, and the responses of some bodies."""

    record: Record
    measures: RecordMeasures
    bodies: tuple[BodyResponses, ...]
    gravity: float

    @property
    def warnings(self) -> tuple[str, ...]:
        """All warnings, without duplicates; those of one of several bodies begin with its name."""
        messages = list(self.measures.warnings)
        for body in self.bodies:
            texts = [text for effect in body.effects for text in effect.response.warnings]
            messages += (
                [lazy_gettext("{name}: {what}", name=lazy_gettext(body.subject.name), what=text) for text in texts]
                if len(self.bodies) > 1
                else texts
            )
        return tuple(dict.fromkeys(messages))

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the cited papers."""
        keys = [*self.measures.citations, *(key for body in self.bodies for effect in body.effects for key in effect.response.citations)]
        cards = find_citations(row.where for body in self.bodies for rows in body.cards.values() for row in rows)
        return tuple(dict.fromkeys([*keys, *cards]))


def collect_responses(
    record: Record,
    subjects: Sequence[BodyModels],
    *,
    components: Sequence[str] | None = None,
    drop: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
) -> ReportData:
    """Apply every model that a body allows to every horizontal component.

    Parameters
    ----------
    record : Record
    subjects : sequence of BodyModels
    components : sequence of str
        Horizontal components or azimuths; default: all horizontals.
    drop : float, m
        Height of the floor above the ground, for the jump; default: that of the body.
    gravity : float, m/s^2
    progress : callable
        Called with the number of finished bodies and components and the total.
    """
    names = tuple(components or (component.code for component in record.horizontals))
    conventions = Conventions(gravity_m_s2=gravity)
    record_measures = measure(record, tuple(dict.fromkeys((*names, *record.codes))), conventions=conventions)
    by_name = {component_measures.component: component_measures for component_measures in record_measures.components}
    motions = [motion_of(record, name) for name in names]
    bodies, done_count, total = [], 0, len(subjects) * len(motions)
    for subject in subjects:
        effects: list[ModelResponse] = []
        cards = {}
        for name, motion in zip(names, motions, strict=True):
            aligned = replace(subject, block=block_for_motion(subject.block, motion))
            effects += _model_responses(aligned, motion, drop, gravity)
            cards[motion.name] = _criteria_rows(aligned, by_name[name], gravity)
            done_count += 1
            if progress is not None:
                progress(done_count, total)
        bodies.append(BodyResponses(subject, tuple(effects), cards))
    return ReportData(record, record_measures, tuple(bodies), gravity)


def _model_responses(subject: BodyModels, motion: Motion, drop: float | None, gravity: float) -> Iterator[ModelResponse]:
    """Yield the response of one body under one component by every model."""
    peak = float(np.abs(motion.horizontal).max())
    estimate = best_estimate(subject.block, motion, mu=subject.mu, mu_kinetic=subject.mu_kinetic, gravity=gravity)
    part = assess_direction("respond", subject.block, motion, estimate.response.options, RUNS)
    probability = summarize(part.samples, subject.block)
    yield ModelResponse(estimate.response, None, None, probability, part, estimate.friction_known)
    rock = flag_near_flip(solve_rock(subject.block, motion, restitution=subject.restitution, gravity=gravity))
    margin = find_margin(subject.block, motion, options=RockOptions(restitution=subject.restitution, gravity=gravity))
    yield ModelResponse(rock, _ratio(rock.outcome.threshold_m_s2, peak), margin)
    if subject.mu is not None:
        slide = solve_slide(SlidingBase(subject.mu, subject.mu_kinetic), motion, gravity=gravity)
        yield ModelResponse(slide, _ratio(subject.mu * gravity, peak))
    if subject.layers is not None and subject.contact is not None:
        base: dict[str, Any] = {**subject.base, **({} if drop is None else {"drop": drop})}
        jump = solve_jump(subject.layers, motion, contact=subject.contact, **base, gravity=gravity)
        yield ModelResponse(jump, _ratio(jump.outcome.rocking_threshold_m_s2, peak))
    if subject.springs is not None:
        lift = solve_uplift(subject.springs, motion, gravity=gravity)
        yield ModelResponse(lift, lift.outcome.uplift_scale)


def _ratio(threshold: float, peak: float) -> float | None:
    """Return the factor on a record at which its peak reaches a threshold."""
    return threshold / peak if peak > 0.0 else None


def _criteria_rows(subject: BodyModels, measures: ComponentMeasures, gravity: float) -> tuple[CriterionResult, ...]:
    return overturning_card(subject.block, measures.pga_m_s2, measures.pgv_m_s, asdict(measures.equivalent_frequency_hz), gravity)
