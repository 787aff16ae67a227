"""``seisblock criteria``: every closed-form criterion of overturning beside the simulated truth."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli.bodies.options import block_options, rocking_options
from seisblock.cli.command import Command
from seisblock.cli.options import Output, Source, gravity_option, output_options, record_options
from seisblock.cli.rock import along, need_vertical
from seisblock.cli.talk import say

if TYPE_CHECKING:
    from seisblock.present.text.criteria import Card


@click.command(
    cls=Command,
    examples=("seisblock criteria --width 24cm --height 72cm", "seisblock criteria record.csv --block gravestone --json"),
)
@record_options
@block_options
@rocking_options
@gravity_option
@output_options
def criteria(
    source: Source,
    output: Output,
    gravity: float,
    restitution: float | None,
    linear: bool,
    vertical: bool,
    azimuth: tuple[str, ...],
    **body: Any,
) -> None:
    """Every closed-form criterion of overturning beside the simulated outcome, for each component.

    A block overturns, says a criterion, when the demand (the record's PGA or PGV) exceeds its threshold. Those that want a
    frequency are given the record's equivalent frequency in each of its three definitions.
    """
    from seisblock.bodies.library import described
    from seisblock.cli.bodies.block import choose_block
    from seisblock.cli.emit import emit
    from seisblock.cli.inputs import components, load
    from seisblock.present.document import Answer
    from seisblock.present.text import criteria as shown

    chosen = choose_block({**body, "restitution": restitution})
    say(f"body: {chosen.says}")
    source = along(source, azimuth)
    options: dict[str, Any] = {"restitution": chosen.restitution, "linear": linear, "vertical": vertical, "gravity": gravity}
    records = load(source)
    cards = [_card(record, name, chosen.block, options) for record in records for name in components(record, source)]
    results = [
        {
            **({"record_index": records.index(card.record)} if len(records) > 1 else {}),
            "component": card.component,
            "pga_m_s2": card.measures.pga_m_s2,
            "pgv_m_s": card.measures.pgv_m_s,
            "equivalent_frequency_hz": card.measures.equivalent_frequency_hz,
            "criteria": [asdict(row) for row in card.rows],
            "simulated": asdict(card.outcome),
        }
        for card in cards
    ]
    given = {("gravity_m_s2" if key == "gravity" else key): value for key, value in options.items()}
    parameters = {**given, "block": described(chosen.block), "velocity_highpass_hz": cards[0].velocity_highpass_hz}
    citations = ["Furukawa2009", "Housner1963", "Zhang2001", "Ishiyama1982", "Tsutsui"]
    warnings = list(dict.fromkeys(text for card in cards for text in card.warnings))
    emit(
        Answer("criteria", parameters, results, records, citations, warnings),
        output,
        tables=lambda: shown.tables(cards, gal=output.gal),
        csv=lambda path: shown.write(path, cards),
        figure=lambda: _draw(cards, gal=output.gal),
    )


def _card(record: Any, component: str, block: Any, options: dict[str, Any]) -> Card:
    """Return the criteria and the simulated outcome of one component."""
    from seisblock.criteria.card import overturning_card
    from seisblock.measures import Conventions, measure
    from seisblock.present.text.criteria import Card
    from seisblock.records import motion_of
    from seisblock.solvers.rock.solve import solve_rock
    from seisblock.studies.rocking.margin import flagged

    rules = Conventions(gravity_m_s2=options["gravity"])
    measured = measure(record, (component,), conventions=rules).components[0]
    motion = motion_of(record, component)
    need_vertical(motion, options["vertical"])
    response = flagged(solve_rock(block, motion, **options))
    frequencies = asdict(measured.equivalent_frequency_hz)
    rows = overturning_card(block, measured.pga_m_s2, measured.pgv_m_s, frequencies, options["gravity"])
    return Card(record, component, block, measured, rows, response.outcome, rules.velocity_highpass_hz, response.warnings)


def _draw(cards: Any, *, gal: bool) -> Any:
    """Return the figure of the cards; matplotlib is loaded only for it."""
    from seisblock.present.figures.criteria import figure

    return figure(cards, gal=gal)
