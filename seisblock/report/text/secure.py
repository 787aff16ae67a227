"""Text report of the measures that make an object safe."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from seisblock.bodies.body_name import body_name
from seisblock.bodies.friction import pair_name
from seisblock.core.i18n import N_, format_percent, format_share, gettext, join_clauses, join_list
from seisblock.output.text.tables import DASH, format_number, styled_line, table
from seisblock.report.text.assessment import name_pile
from seisblock.studies.scenario.secure import BASE_MASS, FRICTION, HEIGHT, INSET, RESTRAINT, WIDTH, Measure, Security, with_reason

MAX_PAIRS = 3
"""Largest number of pairs of surfaces in a note."""

LABELS = {
    WIDTH: N_("minimum base width"),
    HEIGHT: N_("maximum height"),
    BASE_MASS: N_("ballast at floor level"),
    FRICTION: N_("maximum friction"),
    INSET: N_("maximum inset of feet"),
    RESTRAINT: N_("horizontal restraint force"),
}
"""Name of each measure."""


def measure_value(measure: Measure) -> str:
    """Return the value of a measure with its unit."""
    if measure.value is None:
        return DASH
    if measure.measure in (WIDTH, HEIGHT, INSET):
        return f"{100.0 * measure.value:.1f} cm"
    if measure.measure == FRICTION:
        return f"{measure.value:.2f}"
    if measure.unit == "kg":
        return f"{measure.value:.0f} kg"
    if measure.measure == BASE_MASS:
        return gettext("{value} times its mass", value=_multiple(measure.value))
    return _force(measure.value, measure.unit)


def _force(value: float, unit: str) -> str:
    """Return a force with its unit, or as a multiple of the weight."""
    return f"{value:.0f} N" if unit == "N" else gettext("{value} times its weight", value=_multiple(value))


def _multiple(value: float | None) -> str:
    """Return a multiple to three digits, zero without decimals."""
    return format_number(value, 3) if value else "0"


def measure_note(measure: Measure) -> str:
    """Return what else is known about a measure."""
    if measure.value is None:
        return gettext(with_reason(measure).reason or "")
    if measure.measure == RESTRAINT and measure.value > 0.0:
        moment = (
            f"{measure.moment:.0f} N m" if measure.unit == "N" else gettext("{value} m times its weight", value=_multiple(measure.moment))
        )
        notes = [gettext("at {height:.2f} m; moment at the edge {moment}", height=measure.height_m, moment=moment)]
        if measure.foot_slip_probability and measure.foot_force is not None:
            share, force = format_share(measure.foot_slip_probability), _force(measure.foot_force, measure.unit)
            notes.append(gettext("stop at the foot also required, {force}: it slides in {share}", share=share, force=force))
        return join_clauses(notes)
    notes = [text] if (text := _search_end(measure)) else []
    if measure.displacement_m is not None and measure.displacement_m >= 0.01:
        notes.append(gettext("shifts by up to {shift:.0f} cm", shift=100.0 * measure.displacement_m))
    if measure.materials:
        notes.append(join_list(map(pair_name, measure.materials[:MAX_PAIRS])))
    return join_clauses(notes)


def _search_end(measure: Measure) -> str:
    """Return a note for a value at the end of the search, where less of the measure may suffice; empty elsewhere."""
    values = [value for value, _ in measure.curve]
    ends = {
        WIDTH: (min, N_("narrowest base searched")),
        HEIGHT: (max, N_("greatest height searched")),
        FRICTION: (max, N_("largest friction searched")),
        INSET: (max, N_("largest inset searched")),
    }
    if measure.measure not in ends or not values:
        return ""
    end, text = ends[measure.measure]
    return gettext(text) if measure.value == end(values) else ""


def verdict(result: Security, label: str) -> str:
    """Return the probability without a measure and the target."""
    text = N_("{body}, {scenario}: overturning probability {now}, target {target}")
    if result.overturning_probability <= result.target_probability:
        text = N_("{body}, {scenario}: overturning probability {now}, target {target}: no measure required")
    sentence = gettext(
        text,
        body=body_name(result.body),
        scenario=gettext(label),
        now=format_share(result.overturning_probability),
        target=format_percent(result.target_probability, ".3g"),
    )
    return name_pile(sentence, result.stone_count)


def tables(result: Security, label: str) -> Iterator[Any]:
    """Yield the verdict and the table of measures."""
    yield styled_line(verdict(result, label), "bold")
    header = [gettext("measure (alone)"), gettext("value"), gettext("overturning probability"), gettext("note")]
    rows = [
        [
            gettext(LABELS[measure.measure]),
            measure_value(measure),
            DASH if measure.overturning_probability is None else format_share(measure.overturning_probability),
            measure_note(measure),
        ]
        for measure in result.measures
    ]
    caption = gettext(
        "{runs} runs of each value; restraint: rigid, without slack, from equilibrium of the object at rest on the floor, peak value "
        "without safety factor; model error not included",
        runs=result.runs,
    )
    yield table("", header, rows, caption=caption)


def csv_columns(result: Security) -> tuple[list[str], list[list[Any]]]:
    """Return header and rows of ``--csv``: the values of the search."""
    header = ["measure", "unit", "value", "overturning_probability", "chosen"]
    rows = [
        [measure.measure, measure.unit, value, share, value == measure.value]
        for measure in result.measures
        for value, share in measure.curve
    ]
    return header, rows
