"""How a fit is told: what block it is and how well it foretells, its parameters, and where probabilities go wrong."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from seisblock.present.text.tables import NOTHING, line, number, table
from seisblock.studies.fit.axes import ALPHA, INSET, LAPSE, RESTITUTION, SCATTER
from seisblock.studies.fit.axes import P as FREQUENCY
from seisblock.studies.fit.experiment import FELL, MOVED
from seisblock.studies.fit.fit import BlockFit
from seisblock.studies.fit.held_out import HeldOut
from seisblock.studies.fit.summary import TURNING_ALPHA, TURNING_P, WORDS, Marginal
from seisblock.studies.fit.table import Outcomes
from seisblock.words import noted, percent, tell

NAMES = {
    ALPHA: noted("alpha (rad)"),
    FREQUENCY: noted("p (rad/s)"),
    RESTITUTION: noted("restitution"),
    INSET: noted("inset per side"),
    TURNING_ALPHA: noted("alpha, turning (rad)"),
    TURNING_P: noted("p, turning (rad/s)"),
    SCATTER: noted("scatter"),
    LAPSE: noted("lapses"),
}
"""Parameters as a table calls them."""

SHORT = {
    ALPHA: noted("alpha {median} rad ({low} to {high})"),
    FREQUENCY: noted("p {median} rad/s ({low} to {high})"),
    RESTITUTION: noted("restitution {median} ({low} to {high})"),
    INSET: noted("inset {median} of the width ({low} to {high})"),
}
"""Parameters as a sentence names them."""

WORTH_SAYING = 0.5
"""Correlations below this are left to the document."""

MOST_WRONG = 5
"""Outcomes that are named of those foretold wrongly."""

_WHOLE = {
    FELL: noted("{table}: it fell in {happened} of {outcomes} outcomes, {records} records."),
    MOVED: noted("{table}: it moved in {happened} of {outcomes} outcomes, {records} records."),
}
_HEADING = {FELL: noted("fell"), MOVED: noted("moved")}


def verdict(found: BlockFit) -> str:
    """Return which block it is, and how well it foretells, in a sentence."""
    parts = [tell(SHORT[each.name], **_numbers(each)) for each in found.marginals if each.name in SHORT]
    if found.held_out is None:
        return tell("a block of {parts}.", parts=parts) if parts else tell("the block as it is given.")
    right, brier = percent(found.held_out.accuracy), f"{found.held_out.brier:.2f}"
    if not parts:
        return tell("the block as it is given foretells {right} of the records, Brier score {brier}.", right=right, brier=brier)
    text = noted("a block of {parts}: foretells {right} of the outcomes of records held out, Brier score {brier}.")
    return tell(text, parts=parts, right=right, brier=brier)


def _numbers(each: Marginal) -> dict[str, str]:
    """Return a median and its interval as texts."""
    low, high = each.interval
    return {"median": _told(each, each.median), "low": _told(each, low), "high": _told(each, high)}


def _told(each: Marginal, value: float) -> str:
    """Return a value of a parameter: shares and ratios with three decimals, what has a unit with three digits."""
    return number(value, 3) if each.name in (ALPHA, FREQUENCY, TURNING_ALPHA, TURNING_P) else f"{value:.3f}"


def tables(found: BlockFit, outcomes: Outcomes, name: str) -> Iterator[Any]:
    """Yield the verdict, the parameters, how well outcomes are foretold, and which are not."""
    experiment = found.experiment
    yield line(verdict(found), "bold")
    counts = {"happened": int(experiment.happened.sum()), "outcomes": len(experiment.outcomes), "records": experiment.records}
    yield line(tell(_WHOLE[experiment.kind], table=name, **counts))
    heads = [tell("parameter"), tell("median"), tell("{level:g%} interval", level=found.level), tell("before"), tell("narrowed to")]
    yield table("", heads, [_row(each) for each in found.marginals])
    strong = [pair for pair in found.correlations if abs(pair.coefficient) > WORTH_SAYING]
    for pair in sorted(strong, key=lambda pair: -abs(pair.coefficient)):
        text = noted("{first} and {second} go together, correlation {coefficient:.2f}")
        yield line(tell(text, first=tell(WORDS[pair.first]), second=tell(WORDS[pair.second]), coefficient=pair.coefficient), "dim")
    if found.held_out is not None:
        yield from _foretold(found, found.held_out, outcomes)
    yield line(tell("The block of these medians, for rock, respond, fragility and others: {options}", options=as_options(found)))


def _row(each: Marginal) -> list[str]:
    """Return the row of one parameter."""
    told = _numbers(each)
    low, high = (_told(each, end) for end in each.before)
    return [tell(NAMES[each.name]), told["median"], f"{told['low']} - {told['high']}", f"{low} - {high}", percent(each.narrowed)]


def _foretold(found: BlockFit, held: HeldOut, outcomes: Outcomes) -> Iterator[Any]:
    """Yield how well outcomes are foretold without their records."""
    title = tell("each of {folds} parts of the records foretold by the others", folds=held.folds)
    low, high = held.accuracy_interval
    rows = [
        [tell("this block"), percent(held.accuracy), f"{percent(low)} - {percent(high)}", f"{held.brier:.3f}"],
        [tell("above one peak velocity"), percent(held.threshold_accuracy), NOTHING, NOTHING],
        [tell("always the share of the others"), percent(held.rate_accuracy), NOTHING, f"{held.rate_brier:.3f}"],
    ]
    yield table(title, [tell("foretold by"), tell("right"), tell("95 % interval"), tell("Brier score")], rows)
    steps = [
        [
            f"{step.low:g} - {step.high:g}",
            step.outcomes,
            percent(step.mean_probability),
            percent(step.share),
            f"{percent(step.share_interval[0])} - {percent(step.share_interval[1])}",
        ]
        for step in held.calibration
    ]
    heads = [tell("probability"), tell("outcomes"), tell("foretold"), tell(_HEADING[found.experiment.kind]), tell("95 % interval")]
    yield table(tell("calibration, records held out"), heads, steps)
    wrong = _wrong(found)
    if wrong.size:
        named = [
            tell("line {line} ({chance})", line=outcomes.lines[k], chance=percent(float(_chances(found)[k]))) for k in wrong[:MOST_WRONG]
        ]
        text = noted("foretold wrongly: {count}, the worst {named}")
        yield line(tell(text, count=int(wrong.size), named=named))


def _chances(found: BlockFit) -> Any:
    """Return the probabilities without each record."""
    assert found.probability_held_out is not None
    return found.probability_held_out


def _wrong(found: BlockFit) -> Any:
    """Return the outcomes that were foretold wrongly, the worst first."""
    off = np.abs(_chances(found) - found.experiment.happened)
    order = np.argsort(-off)
    return order[off[order] >= 0.5]


def as_options(found: BlockFit) -> str:
    """Return the options that describe the block of the medians to other commands."""
    block = found.block
    options = [f"--width {block.width:.4g} --height {block.height:.4g}"]
    if block.centroid_height is not None:
        options.append(f"--centroid-height {block.centroid_height:.4g}")
    if block.centroid_offset:
        options.append(f"--centroid-offset {block.centroid_offset:.4g}")
    if block.inset:
        options.append(f"--inset {block.inset / block.width:.3g}")
    if found.restitution is not None:
        options.append(f"--restitution {found.restitution:.3g}")
    return " ".join(options)


def columns(found: BlockFit, outcomes: Outcomes) -> tuple[list[str], list[list[Any]]]:
    """Return the header and the rows of ``--csv``: each outcome and how likely it was, SI."""
    kind = found.experiment.kind
    header = ["line", "record", "component", "scale", "weight", kind, "probability", "held_out_probability", "pga_m_s2", "pgv_m_s"]
    held = [None] * len(found.probability) if found.probability_held_out is None else found.probability_held_out.tolist()
    rows = [
        [at, each.record, each.motion.name, each.scale, each.weight, int(each.happened), chance, without, pga, pgv]
        for at, each, chance, without, pga, pgv in zip(
            outcomes.lines,
            found.experiment.outcomes,
            found.probability.tolist(),
            held,
            found.pga_m_s2.tolist(),
            found.pgv_m_s.tolist(),
            strict=True,
        )
    ]
    return header, rows
