"""How the criteria card is told: one table per component, the simulated outcome on top."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.text import Text

from seisblock.criteria.card import ACCELERATION, Row, once_each
from seisblock.present.edges import edges
from seisblock.present.histories import write_by_record
from seisblock.present.scales import acceleration_unit, velocity_unit
from seisblock.present.text.agreement import agreement_line
from seisblock.present.text.respond import verdict as fate
from seisblock.present.text.rock import verdict
from seisblock.present.text.tables import answered, line, number, table
from seisblock.studies.criteria_card import Card
from seisblock.studies.standing.governing import Governing
from seisblock.words import noted, tell

HEADINGS = {"pga_pgv": "PGA/2πPGV", "fourier": "Fourier", "pulse_width": noted("pulse")}
"""The equivalent frequencies, as short as a column."""
MOST_DECIMALS = 6
"""Of a ratio that is all but 1, or 0."""

DEFINITIONS = {"pga_pgv": "PGA/(2π PGV)", "fourier": "Fourier", "pulse_width": noted("pulse width")}


def tables(cards: Sequence[Card], *, gal: bool) -> Iterator[Any]:
    """Yield the record's line, then per component the simulated outcome, the tables, and how far the models of it are apart."""
    for opening, part in answered(cards, lambda card: card.record, lambda card: _happens(card, gal=gal)):
        yield from opening
        for card in part:
            yield from _tables(card, gal=gal)
            if card.agreement is not None:
                yield line(agreement_line(card.component, card.agreement))
            yield line()


def _happens(card: Card, *, gal: bool) -> Iterator[Text]:
    """Yield what the simulation says, and what governs."""
    yield line(simulated(card))
    if card.governing is not None:
        yield line(whole(card, card.governing, gal=gal))


def simulated(card: Card) -> str:
    """Return the simulated outcome in words, and how many criteria say so, each counted once."""
    counted = once_each(card.rows)
    return tell(
        "{name}, simulated: {verdict}. {right} of {all} criteria agree.",
        name=card.component,
        verdict=verdict(card.outcome, card.component),
        right=sum(row.overturns == card.outcome.overturned for row in counted),
        all=len(counted),
    )


def whole(card: Card, found: Governing, *, gal: bool) -> str:
    """Return what the body does with all of its motions together, and how many criteria say so, each counted once."""
    counted = once_each(card.rows)
    outcome, mu = found.response.outcome, found.response.options["mu"]
    right = sum(row.overturns == outcome.overturned for row in counted)
    if found.friction_known:
        text = noted("With all motions and friction {mu:g} (respond): {verdict} {right} of {all} criteria agree.")
    else:
        text = noted("With all motions and feet that hold, friction {mu:.2f} (respond): {verdict} {right} of {all} criteria agree.")
    return tell(text, mu=mu, verdict=fate(found.response, gal=gal), right=right, all=len(counted))


def _tables(card: Card, *, gal: bool) -> Iterator[Any]:
    """Yield the criteria that ask for no frequency, then those that do, with a column per equivalent frequency."""
    m = card.measures
    shaking, speed = acceleration_unit(gal=gal), velocity_unit(gal=gal)
    title = tell(
        "{name}: {body} {width:g} x {height:g} m, PGA {pga}, PGV {pgv}",
        name=card.component,
        body=tell(card.block.name),
        width=card.block.width,
        height=card.block.height,
        pga=f"{m.pga_m_s2 / shaking.size:.4g} {shaking.name}",
        pgv=f"{m.pgv_m_s / speed.size:.4g} {speed.name}",
    ) + (f"\n{tell(worn)}" if (worn := edges(card.block, gal=gal)) else "")
    plain = [row for row in card.rows if row.frequency is None]
    cells = []
    for row in plain:
        size, unit = shaking if row.unit == ACCELERATION else speed
        shown = f"{number(row.threshold / size)} {unit}"
        cells.append([tell(row.criterion), _formula(row), shown, ratio(row), _verdict(row, card)])
    yield table(title, [tell("criterion"), tell("formula"), tell("falls above"), tell("ratio"), tell("says")], cells)

    asked = {row.frequency: row.frequency_hz for row in card.rows if row.frequency is not None}
    columns = [f"{tell(HEADINGS.get(key, key))}\n{hz:.2f} Hz" for key, hz in asked.items() if hz is not None]
    names = list(dict.fromkeys((row.criterion, _formula(row)) for row in card.rows if row.frequency is not None))
    found = {(row.criterion, row.frequency): row for row in card.rows}
    body = []
    for name, formula in names:
        row_cells = [tell(name), formula]
        for key in asked:
            match = found.get((name, key))
            row_cells.append("-" if match is None else f"{ratio(match)} {_verdict(match, card)}")
        body.append(row_cells)
    if body:
        caption = tell("ratio: demand over threshold. ! : not what the simulation says. Thresholds of the lower table: --csv, --json")
        yield table("", [tell("ratio at f ="), tell("formula"), *columns], body, caption=caption)


def ratio(row: Row) -> str:
    """Return demand over threshold, to as many digits as tell it apart from 1, just below which a criterion says stands, and from 0.

    Examples
    --------
    >>> demands = (0.00042, 0.0123, 0.31, 0.9996, 1.0, 1.004)
    >>> [ratio(Row("West", "eq. (1)", "m/s^2", None, None, 1.0, demand, demand > 1.0)) for demand in demands]
    ['0.0004', '0.01', '0.31', '0.9996', '1.00', '1.004']
    """
    found = row.demand / row.threshold
    decimals = next((n for n in range(2, MOST_DECIMALS) if round(found, n) not in (0.0, 1.0) or found in (0.0, 1.0)), MOST_DECIMALS)
    return f"{found:.{decimals}f}"


def _formula(row: Row) -> str:
    """Return where a criterion is printed, without the brackets of the citation."""
    return row.where.replace("[", "").replace("]_", "")


def _verdict(row: Row, card: Card) -> str:
    """Return what a criterion says, marked where the simulation says otherwise."""
    mark = " " if row.overturns == card.outcome.overturned else "!"
    return (tell("falls ") if row.overturns else tell("stands")) + mark


def write(path: Path, cards: Sequence[Card]) -> None:
    """Write all rows as CSV, SI; of several records the first column says which."""
    header = ["component", "criterion", "where", "unit", "frequency", "frequency_hz", "threshold", "demand", "overturns", "simulated"]
    write_by_record(path, header, cards, lambda card: card.record, _cells)


def _cells(card: Card) -> Iterator[list[Any]]:
    """Yield what is written of each criterion."""
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
