"""Everything this package can say about one record and some bodies, for a report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase
from seisblock.bodies.subjects import Subject
from seisblock.criteria.card import Row, overturning_card
from seisblock.measures import ComponentMeasures, Conventions, RecordMeasures, measure
from seisblock.records import Motion, Record, motion_of
from seisblock.references import cited_in
from seisblock.results import Response
from seisblock.solvers.jump.solve import solve_jump
from seisblock.solvers.rock.solve import solve_rock
from seisblock.solvers.slide.solve import solve_slide
from seisblock.solvers.uplift.solve import solve_uplift
from seisblock.studies.rocking.margin import Margin, find_margin, flagged
from seisblock.studies.standing.governing import Governing, governing
from seisblock.studies.standing.probability import RUNS
from seisblock.typing import Progress
from seisblock.units import STANDARD_GRAVITY


@dataclass(frozen=True, eq=False)
class Effect:
    """What one model says of one body under one component.

    Parameters
    ----------
    kind : "respond", "rock", "slide", "jump" or "uplift"
        The first is the governing one, the others are idealised.
    response : Response
    onset : float or None
        Factor on the record at which it begins: to rock, to slide, to lift. None where the record does not tell.
    margin : Margin or None
        For rocking: the factors at which the verdict changes.
    governing : Governing or None
        For the governing answer: how sure it is, and whether the friction was known.
    """

    kind: str
    response: Response[Any]
    onset: float | None
    margin: Margin | None = None
    governing: Governing | None = None


@dataclass(frozen=True, eq=False)
class BodyAssessment:
    """All effects on one body, and its criteria card for each component."""

    subject: Subject
    effects: tuple[Effect, ...]
    cards: dict[str, tuple[Row, ...]]


@dataclass(frozen=True, eq=False)
class Assessment:
    """One record and what it does to some bodies."""

    record: Record
    measures: RecordMeasures
    bodies: tuple[BodyAssessment, ...]
    gravity: float

    @property
    def warnings(self) -> tuple[str, ...]:
        """Everything that was warned of, once."""
        found = [*self.measures.warnings, *(text for body in self.bodies for effect in body.effects for text in effect.response.warnings)]
        return tuple(dict.fromkeys(found))

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the papers relied on."""
        found = [*self.measures.citations, *(key for body in self.bodies for effect in body.effects for key in effect.response.citations)]
        cards = cited_in(row.where for body in self.bodies for rows in body.cards.values() for row in rows)
        return tuple(dict.fromkeys([*found, *cards]))


def assess(
    record: Record,
    subjects: Sequence[Subject],
    *,
    components: Sequence[str] | None = None,
    drop: float = 0.0,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
) -> Assessment:
    """Apply every model that a body allows to every horizontal component.

    Parameters
    ----------
    record : Record
    subjects : sequence of Subject
    components : sequence of str
        Horizontal components or azimuths; all horizontals when left out.
    drop : float, m
        Height of the floor above the ground, for the jump.
    gravity : float, m/s^2
    progress : callable
        Told the number of bodies and components done and the number in all.
    """
    names = tuple(components or (component.code for component in record.horizontals))
    rules = Conventions(gravity_m_s2=gravity)
    measured = measure(record, tuple(dict.fromkeys((*names, *record.codes))), conventions=rules)
    by_name = {found.component: found for found in measured.components}
    motions = [motion_of(record, name) for name in names]
    bodies, done, total = [], 0, len(subjects) * len(motions)
    for each in subjects:
        effects: list[Effect] = []
        cards = {}
        for name, motion in zip(names, motions, strict=True):
            effects += _effects(each, motion, drop, gravity)
            cards[motion.name] = _card(each, by_name[name], gravity)
            done += 1
            if progress is not None:
                progress(done, total)
        bodies.append(BodyAssessment(each, tuple(effects), cards))
    return Assessment(record, measured, tuple(bodies), gravity)


def _effects(each: Subject, motion: Motion, drop: float, gravity: float) -> Iterator[Effect]:
    """Yield what every model says of one body under one component."""
    peak = float(np.abs(motion.horizontal).max())
    found = governing(each.block, motion, mu=each.mu, mu_kinetic=each.mu_kinetic, gravity=gravity, runs=RUNS)
    yield Effect("respond", found.response, None, governing=found)
    rock = flagged(solve_rock(each.block, motion, restitution=each.restitution, gravity=gravity))
    margin = find_margin(each.block, motion, restitution=each.restitution, gravity=gravity)
    yield Effect("rock", rock, _ratio(rock.outcome.threshold_m_s2, peak), margin)
    if each.mu is not None:
        slid = solve_slide(SlidingBase(each.mu, each.mu_kinetic), motion, gravity=gravity)
        yield Effect("slide", slid, _ratio(each.mu * gravity, peak))
    if each.layers is not None and each.contact is not None:
        jump = solve_jump(each.layers, motion, contact=each.contact, drop=drop, gravity=gravity)
        yield Effect("jump", jump, _ratio(jump.outcome.rocking_threshold_m_s2, peak))
    if each.springs is not None:
        lift = solve_uplift(motion=motion, body=each.springs, gravity=gravity)
        yield Effect("uplift", lift, lift.outcome.uplift_scale)


def _ratio(threshold: float, peak: float) -> float | None:
    """Return the factor on a record at which its peak reaches a threshold."""
    return threshold / peak if peak > 0.0 else None


def _card(each: Subject, found: ComponentMeasures, gravity: float) -> tuple[Row, ...]:
    """Return the criteria of overturning for one body and one component."""
    return overturning_card(each.block, found.pga_m_s2, found.pgv_m_s, asdict(found.equivalent_frequency_hz), gravity)
