"""Overturning criteria compared with the simulated outcome, for one direction of a record."""

from __future__ import annotations

from dataclasses import asdict, dataclass

from seisblock.bodies.block import Block
from seisblock.criteria.compare import CriterionResult, overturning_card
from seisblock.measures import Conventions
from seisblock.measures.shaking import BodyShaking, response_shaking
from seisblock.measures.summary import ComponentPeaks, MotionPeaks, component_peaks, conventions_of
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.outcome import RockOutcome
from seisblock.models.rock.solve import solve_rock
from seisblock.records import Component, Motion, Record
from seisblock.studies.model_comparison import ModelComparison, compare_models
from seisblock.studies.respond.best_estimate import BestEstimate, best_estimate
from seisblock.studies.rocking.margin import flag_near_flip


@dataclass(frozen=True)
class CriteriaComparison:
    """Criteria of one component and its simulated outcome.

    Parameters
    ----------
    record : Record
    component : str
    block : Block
    measures : ComponentPeaks
        Arguments of the criteria.
    rows : tuple of CriterionResult
    outcome : RockOutcome
    shaking : BodyShaking
        Of the component, for the rocking block.
    velocity_highpass_hz : float or None
        Filter of the PGV.
    warnings : tuple of str
    agreement : ModelComparison or None
        Comparison of independent models, and the spread of their scale factors; None if not computed.
    governing : BestEstimate or None
        Response by the full model; None if not computed.
    """

    record: Record
    component: str
    block: Block
    measures: ComponentPeaks
    rows: tuple[CriterionResult, ...]
    outcome: RockOutcome
    shaking: BodyShaking
    velocity_highpass_hz: float | None
    warnings: tuple[str, ...] = ()
    agreement: ModelComparison | None = None
    governing: BestEstimate | None = None


def compare_criteria(
    record: Record,
    motion: Motion,
    block: Block,
    *,
    mu: float | None = None,
    mu_kinetic: float | None = None,
    options: RockOptions = RockOptions(),
) -> CriteriaComparison:
    """Return the criteria and the simulated outcome of one component.

    Parameters
    ----------
    record : Record
    motion : Motion
        Of that record, towards a component or an azimuth.
    block : Block
    mu, mu_kinetic : float or None, 1
        Friction; None if unknown: the no-slip friction is used.
    options : RockOptions
    """
    gravity = options.gravity
    conventions = conventions_of(record, Conventions(gravity_m_s2=gravity))
    peaks = component_peaks(Component(motion.name, motion.horizontal), motion.dt, conventions, motion.start_s)
    response = flag_near_flip(solve_rock(block, motion, **options.keywords()))
    rows = overturning_card(block, peaks.pga_m_s2, peaks.pgv_m_s, asdict(peaks.equivalent_frequency_hz), gravity)
    comparison = compare_models(block, motion, options=options)
    estimate = best_estimate(block, motion, mu=mu, mu_kinetic=mu_kinetic, vertical=options.vertical, gravity=gravity)
    return CriteriaComparison(
        record,
        motion.name,
        block,
        peaks,
        rows,
        response.outcome,
        response_shaking(response, peaks=MotionPeaks(peaks.pga_m_s2, peaks.pgv_m_s, peaks.equivalent_frequency_hz.pga_pgv)),
        conventions.velocity_highpass_hz,
        response.warnings,
        comparison,
        estimate,
    )
