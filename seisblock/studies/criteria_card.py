"""Every criterion of overturning beside the simulated outcome, for one direction of a record."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from seisblock.bodies.block import Block
from seisblock.criteria.card import Row, overturning_card
from seisblock.measures import Conventions
from seisblock.measures.summary import ComponentPeaks, component_peaks
from seisblock.records import Component, Motion, Record
from seisblock.solvers.rock.outcome import RockOutcome
from seisblock.solvers.rock.solve import solve_rock
from seisblock.studies.agreement import Agreement, agreement
from seisblock.studies.rocking.margin import flagged
from seisblock.studies.standing.governing import Governing, governing


@dataclass(frozen=True)
class Card:
    """The criteria of one component beside its simulated outcome.

    Parameters
    ----------
    record : Record
    component : str
    block : Block
    measures : ComponentPeaks
        What the criteria were given.
    rows : tuple of Row
    outcome : RockOutcome
    velocity_highpass_hz : float or None
        Filter behind the PGV.
    warnings : tuple of str
    agreement : Agreement or None
        What a few of them, each counted once, and rocking blocks say, and how far apart they are; None where nobody asked.
    governing : Governing or None
        What the body does with all of its motions together; None where nobody asked.
    """

    record: Record
    component: str
    block: Block
    measures: ComponentPeaks
    rows: tuple[Row, ...]
    outcome: RockOutcome
    velocity_highpass_hz: float | None
    warnings: tuple[str, ...] = ()
    agreement: Agreement | None = None
    governing: Governing | None = None


def criteria_card(
    record: Record,
    motion: Motion,
    block: Block,
    *,
    gravity: float,
    mu: float | None = None,
    mu_kinetic: float | None = None,
    **options: Any,
) -> Card:
    """Return the criteria and the simulated outcome of one component.

    Parameters
    ----------
    record : Record
    motion : Motion
        Of that record, towards a component or an azimuth.
    block : Block
    gravity : float, m/s^2
    mu, mu_kinetic : float or None, 1
        Friction; None where nothing is known of it: feet that hold.
    options
        ``restitution``, ``linear``, ``vertical`` of :func:`~seisblock.solvers.rock.solve.solve_rock`.
    """
    rules = Conventions(gravity_m_s2=gravity)
    measured = component_peaks(Component(motion.name, motion.horizontal), motion.dt, rules, motion.start_s)
    response = flagged(solve_rock(block, motion, gravity=gravity, **options))
    rows = overturning_card(block, measured.pga_m_s2, measured.pgv_m_s, asdict(measured.equivalent_frequency_hz), gravity)
    said = agreement(block, motion, gravity=gravity, **options)
    whole = governing(block, motion, mu=mu, mu_kinetic=mu_kinetic, gravity=gravity)
    return Card(record, motion.name, block, measured, rows, response.outcome, rules.velocity_highpass_hz, response.warnings, said, whole)
