"""``seisblock jump``: does a two-layer block jump, when and how far."""

from __future__ import annotations

from itertools import chain
from typing import Any

import click

from seisblock import checks
from seisblock.cli.bodies.options import landing_option, side_option, two_layer_option
from seisblock.cli.command import Command, option
from seisblock.cli.emit import emit
from seisblock.cli.idle import refuse_beside, refuse_without
from seisblock.cli.inputs import load, motions
from seisblock.cli.meant import OneOf
from seisblock.cli.options import Source, checked, gravity_option, output_options, record_options
from seisblock.cli.output import Output
from seisblock.cli.talk import say
from seisblock.cli.types import LENGTH, LENGTHS, MASSES, MU
from seisblock.words import said, tell

DEFAULT_BLOCK = "chozusha"


@click.command(
    cls=Command,
    examples=("seisblock jump", "seisblock jump record.csv --component EW --drop 0.3 --tenon 2cm --plot jump.png"),
)
@record_options
@two_layer_option(f"Bundled body or TOML file. [default: {DEFAULT_BLOCK}]")
@side_option("Which side of the block in plan lies along the motion.")
@option("--width", type=LENGTH, section="Body", help="Width B along the motion, m or with a unit; then give --heights, --masses.")
@option(
    "--depth",
    type=LENGTH,
    callback=checked(checks.positive),
    section="Body",
    help="Width across the motion, m; changes nothing in the plane. [default: --width]",
)
@option("--heights", type=LENGTHS, metavar="H1,H2", section="Body", help="Heights of the upper and the lower layer, m or with units.")
@option("--masses", type=MASSES, metavar="M1,M2", section="Body", help="Masses of the upper and the lower layer, kg or with units.")
@option("--mu", type=MU, help="Static friction of the landed foot, 1. [default: the body's own, else required]")
@option("--mu-kinetic", type=MU, help="Kinetic friction, 1. [default: the body's own, else as --mu]")
@option("--restitution-x", type=float, help="Ratio of horizontal velocities at the impact, 0 to 1. [default: the body's own, else 0.95]")
@option("--restitution-y", type=float, help="Ratio of vertical velocities at the impact, 0 to 1. [default: the body's own, else 0.85]")
@option("--drop", type=LENGTH, default=0.0, help="Height of the floor above the ground on which it lands, m or with a unit. [default: 0]")
@option(
    "--spin",
    default="momentum",
    show_default=True,
    metavar="momentum|printed|ratio=Q",
    help="Spin after the impact: angular momentum, eq. (7a) as printed, or theta'2/theta'1 = Q.",
)
@option(
    "--direction",
    type=OneOf(["+", "-", "both"]),
    default="both",
    show_default=True,
    help="Sign of the ground acceleration that may start a chain.",
)
@landing_option("How a foot that lands is stopped: at once, whatever friction that takes, or by what friction can bear; it then slips on.")
@option("--first", is_flag=True, help="Follow the first chain of motion only, in each --window, as the paper does. [default: all]")
@option("--repeat", is_flag=True, hidden=True, help="All chains; since 0.2.0 the default.")
@option(
    "--tenon",
    type=LENGTH,
    callback=checked(checks.positive),
    section="Output",
    help="Depth of the tenon's hole: say whether the foot left it, m or with a unit.",
)
@gravity_option
@output_options()
def jump(source: Source, output: Output, repeat: bool, tenon: float | None, **asked: Any) -> None:
    """Rocking, impact, jump, landing and rocking-sliding of a two-layer block (Sugimoto et al. 2017).

    Each horizontal component is solved by itself, chain of motion after chain; what moves when the record ends comes to rest on still
    ground. --window limits when rocking may start, not the motion. Tilt is positive when the block leans to the component's positive
    direction, displacements of the centroid are relative to the ground.
    """
    from seisblock.cli.bodies.two_layer import two_layer_choice
    from seisblock.cli.elsewhere import after_jump
    from seisblock.present.documents.jump import document
    from seisblock.present.text import jump as shown
    from seisblock.solvers.jump.solve import solve_jump

    if repeat and asked["first"]:
        raise click.UsageError(tell("give either --first or --repeat, which is the default"))
    if asked["width"] is None:
        refuse_without("--width", ["depth"])
    else:
        refuse_beside("--width", ["side"])
    chosen = two_layer_choice(asked, default=DEFAULT_BLOCK)
    say("body: {name}; {says}", name=said(chosen.block.name), says=chosen.says)
    options = {key: asked[key] for key in ("drop", "spin", "direction", "landing", "first", "gravity")}
    responses = [
        solve_jump(chosen.block, motion, contact=chosen.contact, windows=source.window, **options)
        for record in load(source, whole=True)
        for motion in motions(record, source)
    ]
    emit(
        document(responses, chosen.block, tenon=tenon),
        output,
        responses=responses,
        tables=lambda: chain(
            shown.tables(responses, gal=output.gal, tenon=tenon),
            after_jump(source, asked, DEFAULT_BLOCK, chosen.block, chosen.contact, tenon),
        ),
    )
