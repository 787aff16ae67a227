"""JSON document of ``seisblock fit``: parameters, prediction scores and outcomes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from msgspec import Meta, Struct

from seisblock.bodies.block import Block
from seisblock.output.json.bodies import BlockEntry, block_entry
from seisblock.output.json.schema import Document, DocumentSchema, Result, fill
from seisblock.references import command_papers
from seisblock.studies.fit.cross_validation import HeldOutScores
from seisblock.studies.fit.fit import BlockFit
from seisblock.studies.fit.outcome_table import OutcomeTable
from seisblock.studies.fit.posterior_summary import TURNING_ALPHA, TURNING_P, Correlation
from seisblock.studies.fit.priors import ALPHA, INSET, RESTITUTION, SCATTER
from seisblock.studies.fit.priors import P as FREQUENCY

UNITS = {ALPHA: "rad", TURNING_ALPHA: "rad", FREQUENCY: "rad/s", TURNING_P: "rad/s"}
"""Units of parameters; the others are shares or ratios."""


class FixedEntry(Struct, frozen=True, kw_only=True):
    """Parameters held fixed; null for fitted ones.

    Parameters
    ----------
    alpha_rad, p_rad_s : float or None
        Of sharp edges.
    restitution : float or None
        Also null if derived from angular momentum.
    inset : float or None
        Share of the width per side.
    scatter : float or None
        Half width of the changes from run to run, a share.
    """

    alpha_rad: float | None
    p_rad_s: float | None
    restitution: float | None
    inset: float | None
    scatter: float | None


class FitParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    table : str
        The file of outcomes.
    outcome : str
        ``fell`` or ``moved``.
    free : list of str
        Fitted parameters.
    fixed : FixedEntry
    block : BlockEntry or None
        Nominal block; null: a homogeneous rectangle.
    vertical : bool
        Whether the vertical component acts.
    gravity_m_s2 : float
    confidence : float
        Level of the intervals.
    runs, seed : int
        Samples of each block under each record, and the random seed.
    prior : str
        Prior distributions.
    """

    table: str
    outcome: str
    free: tuple[str, ...]
    fixed: FixedEntry
    block: BlockEntry | None
    vertical: bool
    gravity_m_s2: float
    confidence: float
    runs: int
    seed: int
    prior: str = "even between the bounds of each parameter, p and scatter in their logarithms; lapse: 9 (1 - lapse)^8"


class FitResult(Result, frozen=True, kw_only=True):
    """Posterior of one parameter.

    Parameters
    ----------
    parameter : str
        ``alpha``, ``p`` (of sharp edges), ``restitution``, ``inset``; ``turning_alpha``, ``turning_p`` (with worn edges);
        ``scatter``, the half width of the changes from run to run; ``lapse``, the share of the outcomes that follow no model.
    unit : str
        ``rad``, ``rad/s``, or ``1`` for shares and ratios.
    median : float
    interval, before : (float, float)
        Posterior and prior interval of the requested level.
    narrowed_ratio : float
        Posterior over prior width.
    identified : bool
        True if below one half.
    """

    parameter: str
    unit: str
    median: float
    interval: tuple[float, float]
    before: tuple[float, float]
    narrowed_ratio: float
    identified: bool


class OutcomeEntry(Struct, frozen=True, kw_only=True):
    """One outcome.

    Parameters
    ----------
    record, component : str
    scale, weight : float
        Scale factor of the record, and multiplicity of the outcome.
    happened : bool
        Whether the block overturned, or moved.
    probability, held_out_probability : float, float or None
        Predicted from all outcomes, and from the other folds.
    pga_m_s2, pgv_m_s : float
        Peaks of the ground.
    """

    record: str
    component: str
    scale: float
    weight: float
    happened: bool
    probability: float
    held_out_probability: float | None
    pga_m_s2: float
    pgv_m_s: float


EXTRA_KEYS = {
    "records_count": Annotated[int, Meta(description="Number of different records.")],
    "outcomes_count": Annotated[int, Meta(description="Number of outcomes.")],
    "happened_count": Annotated[int, Meta(description="Number of outcomes with overturning, or motion.")],
    "blocks_count": Annotated[int, Meta(description="Number of importance samples.")],
    "effective_blocks": Annotated[float, Meta(description="Effective sample size.")],
    "block": Annotated[BlockEntry, Meta(description="Block with the median parameters.")],
    "restitution": Annotated[float | None, Meta(description="Restitution of that block; null: from angular momentum.")],
    "correlations": Annotated[tuple[Correlation, ...], Meta(description="Correlations of the parameters.")],
    "held_out": Annotated[HeldOutScores | None, Meta(description="Cross-validation scores; null with one record only.")],
    "outcomes": Annotated[list[OutcomeEntry], Meta(description="Outcomes with predicted probabilities.")],
}
FIT = DocumentSchema("fit", FitParameters, FitResult, EXTRA_KEYS)


def document(fit: BlockFit, outcomes: OutcomeTable, block: Block | None, table: str, *, vertical: bool, gravity: float) -> Document:
    """Return the document of a fit."""
    names = (ALPHA, FREQUENCY, RESTITUTION, INSET, SCATTER)
    fixed = {key: fit.fixed.get(name) for key, name in zip(FixedEntry.__struct_fields__, names, strict=True)}
    parameters = fill(
        FitParameters,
        fit,
        table=Path(table).name,
        outcome=fit.experiment.kind,
        free=tuple(axis.name for axis in fit.axes),
        fixed=FixedEntry(**fixed),
        block=None if block is None else block_entry(block),
        vertical=vertical,
        gravity_m_s2=gravity,
        confidence=fit.level,
    )
    results = [
        fill(FitResult, marginal, parameter=marginal.name, unit=UNITS.get(marginal.name, "1"), narrowed_ratio=marginal.narrowed)
        for marginal in fit.marginals
    ]
    return FIT.document(
        parameters,
        ((None, marginal) for marginal in results),
        citations=command_papers("fit"),
        warnings=[*outcomes.notes, *fit.warnings],
        records_count=fit.experiment.records,
        outcomes_count=len(fit.experiment.outcomes),
        happened_count=int(fit.experiment.happened.sum()),
        blocks_count=fit.blocks,
        effective_blocks=fit.effective_blocks,
        block=block_entry(fit.block),
        restitution=fit.restitution,
        correlations=fit.correlations,
        held_out=fit.held_out,
        outcomes=list(_outcome_entries(fit)),
    )


def _outcome_entries(fit: BlockFit) -> list[OutcomeEntry]:
    held_out = [None] * len(fit.probability) if fit.probability_held_out is None else fit.probability_held_out.tolist()
    return [
        fill(
            OutcomeEntry,
            outcome,
            component=outcome.motion.name,
            probability=probability,
            held_out_probability=held_out_probability,
            pga_m_s2=pga,
            pgv_m_s=pgv,
        )
        for outcome, probability, held_out_probability, pga, pgv in zip(
            fit.experiment.outcomes, fit.probability.tolist(), held_out, fit.pga_m_s2.tolist(), fit.pgv_m_s.tolist(), strict=True
        )
    ]
