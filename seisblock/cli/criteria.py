"""``seisblock criteria``: every closed-form criterion of overturning beside the simulated truth."""

from __future__ import annotations

from typing import Any

import click

from seisblock.cli.bodies.options import block_options, rocking_options
from seisblock.cli.command import Command, option
from seisblock.cli.idle import refuse_without
from seisblock.cli.options import Source, gravity_option, output_options, record_options
from seisblock.cli.output import Output
from seisblock.cli.rock import along, need_vertical
from seisblock.cli.talk import say
from seisblock.cli.types import MU


@click.command(
    cls=Command,
    examples=("seisblock criteria --width 24cm --height 72cm", "seisblock criteria record.csv --block gravestone --json"),
)
@record_options
@block_options
@rocking_options
@option(
    "--mu",
    type=MU,
    section="Body",
    help="Static friction under the block, 1, for what it does with all of its motions. [default: the body's own, else feet that hold]",
)
@option("--mu-kinetic", type=MU, section="Body", help="Kinetic friction, 1. [default: the body's own, else as --mu]")
@gravity_option
@output_options(histories=False, film=False)
def criteria(
    source: Source,
    output: Output,
    gravity: float,
    restitution: float | None,
    linear: bool,
    vertical: bool,
    azimuth: tuple[str, ...],
    mu: float | None,
    mu_kinetic: float | None,
    **body: Any,
) -> None:
    """Every closed-form criterion of overturning beside the simulated outcome, for each component.

    A block overturns, says a criterion, when the demand (the record's PGA or PGV) exceeds its threshold. Those that want a
    frequency are given the record's equivalent frequency in each of its three definitions. Beside them stands what the block does when
    it may slide and fly, too, under all components, as respond tells it.
    """
    from seisblock.bodies.library import friction_of
    from seisblock.bodies.toml import read_table
    from seisblock.cli.bodies.block import choose_block
    from seisblock.cli.emit import emit
    from seisblock.cli.inputs import components, load
    from seisblock.present.documents.criteria import document
    from seisblock.present.text import criteria as shown
    from seisblock.records import motion_of
    from seisblock.studies.criteria_card import criteria_card

    chosen = choose_block({**body, "restitution": restitution, "gal": output.gal})
    say("body: {says}", says=chosen.says)
    source = along(source, azimuth)
    if mu is None and body.get("block"):
        mu, own = friction_of(read_table(body["block"]), body["block"])
        mu_kinetic = own if mu_kinetic is None else mu_kinetic
    if mu is None:
        refuse_without("--mu", ["mu_kinetic"])
    options: dict[str, Any] = {"restitution": chosen.restitution, "linear": linear, "vertical": vertical}
    cards = []
    for record in load(source):
        for name in components(record, source):
            motion = motion_of(record, name)
            need_vertical(motion, vertical)
            cards.append(criteria_card(record, motion, chosen.along(motion), gravity=gravity, mu=mu, mu_kinetic=mu_kinetic, **options))
    emit(
        document(cards, options, gravity=gravity),
        output,
        tables=lambda: shown.tables(cards, gal=output.gal),
        csv=lambda path: shown.write(path, cards),
        figure=lambda: _draw(cards, gal=output.gal),
    )


def _draw(cards: Any, *, gal: bool) -> Any:
    """Return the figure of the cards; matplotlib is loaded only for it."""
    from seisblock.present.figures.criteria import figure

    return figure(cards, gal=gal)
