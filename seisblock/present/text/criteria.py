"""How the criteria card is told: one table per component, the simulated outcome on top."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.text import Text

from seisblock.bodies.library import edges
from seisblock.criteria.card import ACCELERATION, Row
from seisblock.present.files import write_table
from seisblock.present.text.rock import way_to_alpha
from seisblock.present.text.tables import acceleration_unit, number, record_line, table
from seisblock.records import Record
from seisblock.studies.criteria_card import Card
from seisblock.units import GAL, KINE

HEADINGS = {"pga_pgv": "PGA/2πPGV", "fourier": "Fourier", "pulse_width": "pulse"}
"""The equivalent frequencies, as short as a column."""
DEFINITIONS = {"pga_pgv": "PGA/(2π PGV)", "fourier": "Fourier", "pulse_width": "pulse width"}


def tables(cards: Sequence[Card], *, gal: bool) -> Iterator[Any]:
    """Yield the record's line, then a table per component with the simulated outcome below."""
    last: Record | None = None
    for card in cards:
        if card.record is not last:
            last = card.record
            yield record_line(card.record)
        yield from _tables(card, gal=gal)
        yield Text(simulated(card))
        yield Text()


def simulated(card: Card) -> str:
    """Return the simulated outcome in words."""
    outcome = card.outcome
    if outcome.overturned:
        said = f"overturns to {outcome.overturned_towards}"
    elif outcome.rocks:
        said = f"rocks and stands: {way_to_alpha(outcome.max_rotation_ratio)}"
    else:
        said = "stands still"
    flag = "; a change of the record by less than 2 % changes this" if outcome.verdict_flips_within_2_percent else ""
    right = sum(row.overturns == outcome.overturned for row in card.rows)
    return f"{card.component}, simulated: {said}{flag}. {right} of {len(card.rows)} criteria agree."


def _tables(card: Card, *, gal: bool) -> Iterator[Any]:
    """Yield the criteria that ask for no frequency, then those that do, with a column per equivalent frequency."""
    m = card.measures
    units = (acceleration_unit(gal=gal), "kine" if gal else "m/s")
    factors = (GAL, KINE) if gal else (1.0, 1.0)
    title = f"{card.component}: {card.block.name} {card.block.width:g} x {card.block.height:g} m, " + (
        f"PGA {m.pga_m_s2 / factors[0]:.4g} {units[0]}, PGV {m.pgv_m_s / factors[1]:.4g} {units[1]}"
        + (f"\n{worn}" if (worn := edges(card.block)) else "")
    )
    plain = [row for row in card.rows if row.frequency is None]
    cells = []
    for row in plain:
        kind = 0 if row.unit == ACCELERATION else 1
        shown = f"{number(row.threshold / factors[kind])} {units[kind]}"
        cells.append([row.criterion, _formula(row), shown, f"{row.demand / row.threshold:.2f}", _verdict(row, card)])
    yield table(title, ["criterion", "formula", "falls above", "ratio", "says"], cells)

    asked = {row.frequency: row.frequency_hz for row in card.rows if row.frequency is not None}
    columns = [f"{HEADINGS.get(key, key)}\n{hz:.2f} Hz" for key, hz in asked.items() if hz is not None]
    names = list(dict.fromkeys((row.criterion, _formula(row)) for row in card.rows if row.frequency is not None))
    found = {(row.criterion, row.frequency): row for row in card.rows}
    body = []
    for name, formula in names:
        row_cells = [name, formula]
        for key in asked:
            match = found.get((name, key))
            row_cells.append("-" if match is None else f"{match.demand / match.threshold:.2f} {_verdict(match, card)}")
        body.append(row_cells)
    if body:
        caption = "ratio: demand over threshold. ! : not what the simulation says. Thresholds of the lower table: --csv, --json"
        yield table("", ["ratio at f =", "formula", *columns], body, caption=caption)


def _formula(row: Row) -> str:
    """Return where a criterion is printed, without the brackets of the citation."""
    return row.where.replace("[", "").replace("]_", "")


def _verdict(row: Row, card: Card) -> str:
    """Return what a criterion says, marked where the simulation says otherwise."""
    mark = " " if row.overturns == card.outcome.overturned else "!"
    return ("falls " if row.overturns else "stands") + mark


def write(path: Path, cards: Sequence[Card]) -> None:
    """Write all rows as CSV, SI."""
    header = ["component", "criterion", "where", "unit", "frequency", "frequency_hz", "threshold", "demand", "overturns", "simulated"]
    write_table(
        path,
        header,
        (
            [
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
            for card in cards
            for row in card.rows
        ),
    )
