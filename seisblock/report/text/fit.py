"""Text report of a fit: fitted parameters, cross-validation scores and calibration."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from seisblock.core.i18n import N_, format_percent, gettext
from seisblock.output.text.tables import DASH, format_number, format_range, format_share_interval, styled_line, table
from seisblock.studies.fit.cross_validation import HeldOutScores
from seisblock.studies.fit.dataset import FELL, MOVED
from seisblock.studies.fit.fit import BlockFit
from seisblock.studies.fit.outcome_table import OutcomeTable
from seisblock.studies.fit.posterior_summary import PARAMETER_LABELS, TURNING_ALPHA, TURNING_P, Marginal
from seisblock.studies.fit.priors import ALPHA, INSET, LAPSE, RESTITUTION, SCATTER
from seisblock.studies.fit.priors import P as FREQUENCY

NAMES = {
    ALPHA: N_("alpha (rad)"),
    FREQUENCY: N_("p (rad/s)"),
    RESTITUTION: N_("restitution"),
    INSET: N_("inset per side"),
    TURNING_ALPHA: N_("alpha, worn (rad)"),
    TURNING_P: N_("p, worn (rad/s)"),
    SCATTER: N_("scatter"),
    LAPSE: N_("lapse rate"),
}
"""Parameter names in tables."""

SHORT = {
    ALPHA: N_("alpha {median} rad ({low} to {high})"),
    FREQUENCY: N_("p {median} rad/s ({low} to {high})"),
    RESTITUTION: N_("restitution {median} ({low} to {high})"),
    INSET: N_("inset {median} of the width ({low} to {high})"),
}
"""Parameters in sentences."""

MIN_CORRELATION = 0.5
"""Smallest correlation that is printed; the document contains all."""

MAX_MISPREDICTED = 5
"""Most outcomes listed as wrong predictions."""

_TOTALS = {
    FELL: N_("{table}: {outcomes} outcomes of {records} records, overturned in {happened}."),
    MOVED: N_("{table}: {outcomes} outcomes of {records} records, moved in {happened}."),
}
_HEADING = {FELL: N_("overturned"), MOVED: N_("moved")}


def verdict(fit: BlockFit) -> str:
    """Return a sentence on the fitted block and its prediction score."""
    parts = [gettext(SHORT[marginal.name], **_interval_texts(marginal)) for marginal in fit.marginals if marginal.name in SHORT]
    if fit.held_out is None:
        return gettext("fitted block: {parts}.", parts=parts) if parts else gettext("block with all parameters fixed.")
    right, brier = format_percent(fit.held_out.accuracy), f"{fit.held_out.brier:.2f}"
    if not parts:
        return gettext(
            "block with all parameters fixed: {right} of the outcomes predicted correctly, Brier score {brier}.", right=right, brier=brier
        )
    text = N_("fitted block: {parts}; {right} of the outcomes predicted correctly in cross-validation, Brier score {brier}.")
    return gettext(text, parts=parts, right=right, brier=brier)


def _interval_texts(marginal: Marginal) -> dict[str, str]:
    low, high = marginal.interval
    return {"median": _format_value(marginal, marginal.median), "low": _format_value(marginal, low), "high": _format_value(marginal, high)}


def _format_value(marginal: Marginal, value: float) -> str:
    """Return a parameter value: three decimals for shares and ratios, three digits for values with a unit."""
    return format_number(value, 3) if marginal.name in (ALPHA, FREQUENCY, TURNING_ALPHA, TURNING_P) else f"{value:.3f}"


def tables(fit: BlockFit, outcomes: OutcomeTable, name: str) -> Iterator[Any]:
    """Yield the verdict, the parameter table, the prediction scores and the wrong predictions."""
    experiment = fit.experiment
    yield styled_line(verdict(fit), "bold")
    counts = {"happened": int(experiment.happened.sum()), "outcomes": len(experiment.outcomes), "records": experiment.records}
    yield styled_line(gettext(_TOTALS[experiment.kind], table=name, **counts))
    header = [
        gettext("parameter"),
        gettext("median"),
        gettext("{level:g%} interval", level=fit.level),
        gettext("prior"),
        gettext("width ratio"),
    ]
    yield table("", header, [_row(marginal) for marginal in fit.marginals])
    strong = [pair for pair in fit.correlations if abs(pair.coefficient) > MIN_CORRELATION]
    for pair in sorted(strong, key=lambda pair: -abs(pair.coefficient)):
        text = N_("correlation of {first} and {second}: {coefficient:.2f}")
        yield styled_line(
            gettext(
                text,
                first=gettext(PARAMETER_LABELS[pair.first]),
                second=gettext(PARAMETER_LABELS[pair.second]),
                coefficient=pair.coefficient,
            ),
            "dim",
        )
    if fit.held_out is not None:
        yield from _prediction_tables(fit, fit.held_out, outcomes)
    yield styled_line(gettext("Options for rock, respond, fragility etc. with these medians: {options}", options=as_options(fit)))


def _row(marginal: Marginal) -> list[str]:
    texts = _interval_texts(marginal)
    low, high = (_format_value(marginal, end) for end in marginal.before)
    return [
        gettext(NAMES[marginal.name]),
        texts["median"],
        format_range(texts["low"], texts["high"]),
        format_range(low, high),
        format_percent(marginal.narrowed),
    ]


def _prediction_tables(fit: BlockFit, held_out: HeldOutScores, outcomes: OutcomeTable) -> Iterator[Any]:
    """Yield the cross-validation scores and the calibration table."""
    title = gettext("Cross-validation, {folds} folds of records", folds=held_out.folds)
    low, high = held_out.accuracy_interval
    rows = [
        [
            gettext("fitted block"),
            format_percent(held_out.accuracy),
            format_share_interval((low, high)),
            f"{held_out.brier:.3f}",
        ],
        [gettext("PGV threshold"), format_percent(held_out.threshold_accuracy), DASH, DASH],
        [gettext("overall rate"), format_percent(held_out.rate_accuracy), DASH, f"{held_out.rate_brier:.3f}"],
    ]
    yield table(title, [gettext("predictor"), gettext("correct"), gettext("95 % interval"), gettext("Brier score")], rows)
    steps = [
        [
            format_range(f"{step.low:g}", f"{step.high:g}"),
            step.outcomes,
            format_percent(step.mean_probability),
            format_percent(step.share),
            format_share_interval(step.share_interval),
        ]
        for step in held_out.calibration
    ]
    header = [
        gettext("probability"),
        gettext("outcomes"),
        gettext("predicted"),
        gettext(_HEADING[fit.experiment.kind]),
        gettext("95 % interval"),
    ]
    yield table(gettext("Calibration in cross-validation"), header, steps)
    mispredicted = _mispredicted(fit)
    if mispredicted.size:
        labels = [
            gettext("line {line} ({chance})", line=outcomes.lines[k], chance=format_percent(float(_held_out_probabilities(fit)[k])))
            for k in mispredicted[:MAX_MISPREDICTED]
        ]
        text = N_("wrong predictions: {count}, largest errors {named}")
        yield styled_line(gettext(text, count=int(mispredicted.size), named=labels))


def _held_out_probabilities(fit: BlockFit) -> Any:
    """Return the cross-validated probabilities, (n,)."""
    assert fit.probability_held_out is not None
    return fit.probability_held_out


def _mispredicted(fit: BlockFit) -> Any:
    """Return the indices of the wrong predictions, largest error first."""
    off = np.abs(_held_out_probabilities(fit) - fit.experiment.happened)
    order = np.argsort(-off)
    return order[off[order] >= 0.5]


def as_options(fit: BlockFit) -> str:
    """Return the command-line options of the block with the median parameters."""
    block = fit.block
    options = [f"--width {block.width:.4g} --height {block.height:.4g}"]
    if block.centroid_height is not None:
        options.append(f"--centroid-height {block.centroid_height:.4g}")
    if block.centroid_offset:
        options.append(f"--centroid-offset {block.centroid_offset:.4g}")
    if block.inset:
        options.append(f"--inset {block.inset / block.width:.3g}")
    if fit.restitution is not None:
        options.append(f"--restitution {fit.restitution:.3g}")
    return " ".join(options)


def csv_columns(fit: BlockFit, outcomes: OutcomeTable) -> tuple[list[str], list[list[Any]]]:
    """Return header and rows of ``--csv``: each outcome with its predicted probability, SI."""
    kind = fit.experiment.kind
    header = ["line", "record", "component", "scale", "weight", kind, "probability", "held_out_probability", "pga_m_s2", "pgv_m_s"]
    held_out = [None] * len(fit.probability) if fit.probability_held_out is None else fit.probability_held_out.tolist()
    rows = [
        [
            at,
            outcome.record,
            outcome.motion.name,
            outcome.scale,
            outcome.weight,
            int(outcome.happened),
            probability,
            held_out_probability,
            pga,
            pgv,
        ]
        for at, outcome, probability, held_out_probability, pga, pgv in zip(
            outcomes.lines,
            fit.experiment.outcomes,
            fit.probability.tolist(),
            held_out,
            fit.pga_m_s2.tolist(),
            fit.pgv_m_s.tolist(),
            strict=True,
        )
    ]
    return header, rows
