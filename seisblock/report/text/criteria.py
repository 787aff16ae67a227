"""Text report of the criteria comparison: simulated outcome and one table per component."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import N_, gettext
from seisblock.criteria.compare import ACCELERATION, CriterionResult, count_agreeing
from seisblock.models.respond.describe import outcome_text
from seisblock.models.rock.describe import verdict
from seisblock.output.describe_wear import describe_edges
from seisblock.output.io.history_csv import CsvTable, table_by_record
from seisblock.output.text.shaking import shaking_text
from seisblock.output.text.tables import DASH, Part, format_number, format_range, group_answers, side_by_side, styled_line, table
from seisblock.output.units_display import acceleration_unit, velocity_unit
from seisblock.report.text.model_comparison import agreement_line, spread_line
from seisblock.studies.criteria_comparison import CriteriaComparison
from seisblock.studies.respond.best_estimate import BestEstimate

HEADINGS = {"pga_pgv": "PGA/2πPGV", "fourier": N_("Fourier"), "pulse_width": N_("pulse")}
"""Short column headings of the equivalent frequencies."""
MAX_DECIMALS = 6
"""Most decimals of a ratio close to 1 or 0."""

DEFINITIONS = {"pga_pgv": "PGA/(2π PGV)", "fourier": N_("Fourier"), "pulse_width": N_("pulse width")}


def tables(cards: Sequence[CriteriaComparison], *, gal: bool) -> Iterator[Any]:
    """Yield the record, then per component the simulated outcome, the tables of criteria and the model comparison; in short one table."""
    for heading, part in group_answers(cards, lambda card: card.record, lambda card: _summary(card, gal=gal)):
        yield from heading
        full = tuple(block for card in part for block in _details(card, gal=gal))
        yield Part(full, tuple(_ratios(part)))


def _details(card: CriteriaComparison, *, gal: bool) -> Iterator[Any]:
    """Yield the tables of one component and the model comparison."""
    yield from _tables(card, gal=gal)
    if card.agreement is not None:
        yield styled_line(agreement_line(card.component, card.agreement))
    yield styled_line(shaking_text(card.component, card.shaking, gal=gal), "dim")
    yield styled_line()


def _ratios(cards: Sequence[CriteriaComparison]) -> Iterator[Any]:
    """Yield the ratio of each criterion, a column per component, and the spread of the models."""
    names = dict.fromkeys(row.criterion for card in cards for row in card.rows)
    title = gettext("Demand over threshold; yes: overturning predicted; !: differs from simulation")
    rows = [[gettext(name), *(_range_cell([row for row in card.rows if row.criterion == name], card) for card in cards)] for name in names]
    yield side_by_side(title, [gettext("criterion"), *(card.component for card in cards)], rows)
    for card in cards:
        if card.agreement is not None:
            yield styled_line(spread_line(card.component, card.agreement))


def _range_cell(rows: Sequence[CriterionResult], card: CriteriaComparison) -> str:
    """Return the range of ratios over the equivalent frequencies and the prediction, marked "!" where one differs from the simulation."""
    if not rows:
        return DASH
    by_ratio = sorted(rows, key=lambda row: row.demand / row.threshold)
    low, high = format_ratio(by_ratio[0]), format_ratio(by_ratio[-1])
    predictions = dict.fromkeys(gettext("yes") if row.overturns else gettext("no") for row in by_ratio)
    mark = " " if all(row.overturns == card.outcome.overturned for row in rows) else "!"
    return f"{low if low == high else format_range(low, high)} {'/'.join(predictions)}{mark}"


def _summary(card: CriteriaComparison, *, gal: bool) -> Iterator[Text]:
    yield styled_line(simulated_text(card))
    if card.governing is not None:
        yield styled_line(respond_text(card, card.governing, gal=gal))


def simulated_text(card: CriteriaComparison) -> str:
    """Return the simulated outcome and the number of criteria that agree, each counted once."""
    right, count = count_agreeing(card.rows, card.outcome.overturned)
    text = "{name}, simulation: {verdict}. {right} of {all} criteria agree."
    return gettext(text, name=card.component, verdict=verdict(card.outcome, card.component), right=right, all=count)


def respond_text(card: CriteriaComparison, best_estimate: BestEstimate, *, gal: bool) -> str:
    """Return the outcome of the full response and the number of criteria that agree, each counted once."""
    mu = best_estimate.response.options.mu
    right, count = count_agreeing(card.rows, best_estimate.response.outcome.overturned)
    if best_estimate.friction_known:
        text = N_("{name}, full response (respond, friction {mu:g}): {verdict}. {right} of {all} criteria agree.")
    else:
        text = N_("{name}, full response (respond, assumed friction {mu:.2f}): {verdict}. {right} of {all} criteria agree.")
    return gettext(text, name=card.component, mu=mu, verdict=outcome_text(best_estimate.response, gal=gal), right=right, all=count)


def _tables(card: CriteriaComparison, *, gal: bool) -> Iterator[Any]:
    """Yield the criteria without a frequency, then those with one, a column per equivalent frequency."""
    m = card.measures
    shaking, speed = acceleration_unit(gal=gal), velocity_unit(gal=gal)
    title = gettext(
        "{name}: {body} {width:g} x {height:g} m, PGA {pga}, PGV {pgv}",
        name=card.component,
        body=gettext(body_name(card.block.name)),
        width=card.block.width,
        height=card.block.height,
        pga=f"{m.pga_m_s2 / shaking.size:.4g} {shaking.name}",
        pgv=f"{m.pgv_m_s / speed.size:.4g} {speed.name}",
    ) + (f"\n{gettext(wear_text)}" if (wear_text := describe_edges(card.block, gal=gal)) else "")
    frequency_free = [row for row in card.rows if row.frequency is None]
    cells = []
    for row in frequency_free:
        size, unit = shaking if row.unit == ACCELERATION else speed
        threshold_text = f"{format_number(row.threshold / size)} {unit}"
        cells.append([gettext(row.criterion), formula_text(row), threshold_text, _ratio_cell(row, card)])
    yield table(title, [gettext("criterion"), gettext("formula"), gettext("threshold"), gettext("ratio")], cells)

    frequencies = {row.frequency: row.frequency_hz for row in card.rows if row.frequency is not None}
    columns = [f"{gettext(HEADINGS.get(key, key))}\n{hz:.2f} Hz" for key, hz in frequencies.items() if hz is not None]
    names = list(dict.fromkeys((row.criterion, formula_text(row)) for row in card.rows if row.frequency is not None))
    rows_by_key = {(row.criterion, row.frequency): row for row in card.rows}
    body = []
    for name, formula in names:
        row_cells = [gettext(name), formula]
        for key in frequencies:
            match = rows_by_key.get((name, key))
            row_cells.append("-" if match is None else _ratio_cell(match, card))
        body.append(row_cells)
    if body:
        caption = gettext(
            "ratio: demand over threshold; yes: overturning predicted; !: differs from the simulation. The thresholds of the lower table "
            "are in --csv and --json"
        )
        yield table("", [gettext("ratio at f ="), gettext("formula"), *columns], body, caption=caption)


def format_ratio(row: CriterionResult) -> str:
    """Return demand over threshold, with enough decimals to distinguish the value from 0 and 1.

    Examples
    --------
    >>> demands = (0.00042, 0.0123, 0.31, 0.9996, 1.0, 1.004)
    >>> [format_ratio(CriterionResult("West", "eq. (1)", "m/s^2", None, None, 1.0, demand, demand > 1.0)) for demand in demands]
    ['0.0004', '0.01', '0.31', '0.9996', '1.00', '1.004']
    """
    value = row.demand / row.threshold
    decimals = next((n for n in range(2, MAX_DECIMALS) if round(value, n) not in (0.0, 1.0) or value in (0.0, 1.0)), MAX_DECIMALS)
    return f"{value:.{decimals}f}"


def formula_text(row: CriterionResult) -> str:
    """Return the source of a criterion without citation brackets."""
    return row.where.replace("[", "").replace("]_", "")


def _ratio_cell(row: CriterionResult, card: CriteriaComparison) -> str:
    """Return ratio and prediction of a criterion, marked "!" where it differs from the simulation."""
    mark = " " if row.overturns == card.outcome.overturned else "!"
    return f"{format_ratio(row)} {gettext('yes') if row.overturns else gettext('no')}{mark}"


def csv_columns(cards: Sequence[CriteriaComparison]) -> CsvTable:
    """Return all rows, SI; for several records the first column is the record index."""
    header = ["component", "criterion", "where", "unit", "frequency", "frequency_hz", "threshold", "demand", "overturns", "simulated"]
    return table_by_record(header, cards, lambda card: card.record, _csv_rows)


def _csv_rows(card: CriteriaComparison) -> Iterator[list[Any]]:
    for row in card.rows:
        yield [
            card.component,
            row.criterion,
            row.where,
            row.unit,
            row.frequency or "",
            "" if row.frequency_hz is None else row.frequency_hz,
            row.threshold,
            row.demand,
            row.overturns,
            card.outcome.overturned,
        ]
