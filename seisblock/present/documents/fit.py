"""What ``seisblock fit`` answers: what is known of each parameter, how well it foretells, and each outcome."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from msgspec import Meta, Struct

from seisblock.bodies.block import Block
from seisblock.present.documents.bodies import BlockEntry, block_entry
from seisblock.present.documents.kind import Document, Kind, Result
from seisblock.references import CITED
from seisblock.studies.fit.axes import ALPHA, INSET, RESTITUTION, SCATTER
from seisblock.studies.fit.axes import P as FREQUENCY
from seisblock.studies.fit.fit import BlockFit
from seisblock.studies.fit.held_out import HeldOut
from seisblock.studies.fit.summary import TURNING_ALPHA, TURNING_P, Correlation
from seisblock.studies.fit.table import Outcomes

UNITS = {ALPHA: "rad", TURNING_ALPHA: "rad", FREQUENCY: "rad/s", TURNING_P: "rad/s"}
"""Units of parameters; the others are shares or ratios."""


class FixedEntry(Struct, frozen=True, kw_only=True):
    """What was not looked for; null where it was.

    Parameters
    ----------
    alpha_rad, p_rad_s : float or None
        Of sharp edges.
    restitution : float or None
        Null too where it is that of angular momentum.
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
    """What was chosen.

    Parameters
    ----------
    table : str
        The file of outcomes.
    outcome : str
        ``fell`` or ``moved``.
    free : list of str
        What was looked for.
    fixed : FixedEntry
    block : BlockEntry or None
        The drawing; null: a homogeneous rectangle.
    vertical : bool
        Whether the vertical component acts.
    gravity_m_s2 : float
    confidence : float
        Level of the intervals.
    runs, seed : int
        Versions of each block under each record, and the seed of what is drawn.
    prior : str
        What was thought before.
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
    """What is known of one parameter.

    Parameters
    ----------
    parameter : str
        ``alpha``, ``p`` (of sharp edges), ``restitution``, ``inset``; ``turning_alpha``, ``turning_p`` (as it turns, its edges worn);
        ``scatter``, the half width of the changes from run to run; ``lapse``, the share of the outcomes that follow no model.
    unit : str
        ``rad``, ``rad/s``, or ``1`` for shares and ratios.
    median : float
    interval, before : (float, float)
        Interval of the level asked for, and that before anything was seen.
    narrowed_ratio : float
        Width of the former over that of the latter.
    identified : bool
        Whether that is below one half: the outcomes tell much of it.
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
        Factor on the record, and how often the outcome counts.
    happened : bool
        Whether it fell, or moved.
    probability, held_out_probability : float, float or None
        That it happens, by all outcomes, and by those of other folds.
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


BESIDE = {
    "records_count": Annotated[int, Meta(description="Different records.")],
    "outcomes_count": Annotated[int, Meta(description="Outcomes.")],
    "happened_count": Annotated[int, Meta(description="Outcomes in which it fell, or moved.")],
    "blocks_count": Annotated[int, Meta(description="Blocks that were looked at closely.")],
    "effective_blocks": Annotated[float, Meta(description="How many equally good ones they amount to.")],
    "block": Annotated[BlockEntry, Meta(description="That of the medians.")],
    "restitution": Annotated[float | None, Meta(description="Of that block; null: that of angular momentum.")],
    "correlations": Annotated[tuple[Correlation, ...], Meta(description="How each two parameters go together.")],
    "held_out": Annotated[HeldOut | None, Meta(description="How well records are foretold without them; null with one record only.")],
    "outcomes": Annotated[list[OutcomeEntry], Meta(description="Each outcome, and how likely it was.")],
}
FIT = Kind("fit", FitParameters, FitResult, BESIDE)


def document(found: BlockFit, outcomes: Outcomes, block: Block | None, table: str, *, vertical: bool, gravity: float) -> Document:
    """Return the document of a fit."""
    names = (ALPHA, FREQUENCY, RESTITUTION, INSET, SCATTER)
    fixed = {key: found.fixed.get(name) for key, name in zip(FixedEntry.__struct_fields__, names, strict=True)}
    parameters = FitParameters(
        table=Path(table).name,
        outcome=found.experiment.kind,
        free=tuple(axis.name for axis in found.axes),
        fixed=FixedEntry(**fixed),
        block=None if block is None else block_entry(block),
        vertical=vertical,
        gravity_m_s2=gravity,
        confidence=found.level,
        runs=found.runs,
        seed=found.seed,
    )
    results = [
        FitResult(
            parameter=each.name,
            unit=UNITS.get(each.name, "1"),
            median=each.median,
            interval=each.interval,
            before=each.before,
            narrowed_ratio=each.narrowed,
            identified=each.identified,
        )
        for each in found.marginals
    ]
    return FIT.document(
        parameters,
        ((None, each) for each in results),
        citations=CITED["fit"],
        warnings=[*outcomes.notes, *found.warnings],
        records_count=found.experiment.records,
        outcomes_count=len(found.experiment.outcomes),
        happened_count=int(found.experiment.happened.sum()),
        blocks_count=found.blocks,
        effective_blocks=found.effective_blocks,
        block=block_entry(found.block),
        restitution=found.restitution,
        correlations=found.correlations,
        held_out=found.held_out,
        outcomes=list(_entries(found)),
    )


def _entries(found: BlockFit) -> list[OutcomeEntry]:
    """Return the outcomes, one by one."""
    without = [None] * len(found.probability) if found.probability_held_out is None else found.probability_held_out.tolist()
    return [
        OutcomeEntry(
            record=each.record,
            component=each.motion.name,
            scale=each.scale,
            weight=each.weight,
            happened=each.happened,
            probability=chance,
            held_out_probability=held,
            pga_m_s2=pga,
            pgv_m_s=pgv,
        )
        for each, chance, held, pga, pgv in zip(
            found.experiment.outcomes, found.probability.tolist(), without, found.pga_m_s2.tolist(), found.pgv_m_s.tolist(), strict=True
        )
    ]
