"""``seisblock jump``: jump of a two-layer block."""

from __future__ import annotations

from itertools import chain
from typing import Any

import click

from seisblock.cli.bodies.options import landing_option, side_option, two_layer_option
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.load_records import load_records, selected_motions
from seisblock.cli.option_checks import reject_with, reject_without
from seisblock.cli.options import Source, check_callback, gravity_option, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import LENGTH, LENGTHS, MASSES, MU
from seisblock.cli.write_results import write_results
from seisblock.core import checks
from seisblock.core.i18n import gettext, lazy_gettext

DEFAULT_BLOCK = "chozusha"


@click.command(
    cls=Command,
    examples=("seisblock jump", "seisblock jump record.csv --component EW --drop 0.3 --tenon 2cm --plot jump.png"),
)
@record_options
@two_layer_option(f"Bundled body or TOML file. [default: {DEFAULT_BLOCK}]")
@side_option("Side of the block in plan along the motion.")
@option("--width", type=LENGTH, section="Body", help="Width B along the motion, m or with a unit; needs --heights and --masses.")
@option(
    "--depth",
    type=LENGTH,
    callback=check_callback(checks.positive),
    section="Body",
    help="Width across the motion, m; without effect on plane motion. [default: --width]",
)
@option("--heights", type=LENGTHS, metavar="H1,H2", section="Body", help="Heights of the upper and the lower layer, m or with units.")
@option("--masses", type=MASSES, metavar="M1,M2", section="Body", help="Masses of the upper and the lower layer, kg or with units.")
@option(
    "--mu", type=MU, section="Body", help="Static friction coefficient of the foot that landed. [default: the body's own, else required]"
)
@option("--mu-kinetic", type=MU, section="Body", help="Kinetic friction coefficient. [default: the body's own, else as --mu]")
@option(
    "--restitution-x",
    type=float,
    section="Body",
    help="Ratio of horizontal velocities at the impact, 0 to 1. [default: the body's own, else 0.95]",
)
@option(
    "--restitution-y",
    type=float,
    section="Body",
    help="Ratio of vertical velocities at the impact, 0 to 1. [default: the body's own, else 0.85]",
)
@option(
    "--drop", type=LENGTH, section="Body", default=0.0, help="Height of the floor above the landing ground, m or with a unit. [default: 0]"
)
@option(
    "--spin",
    default="momentum",
    show_default=True,
    metavar="momentum|printed|ratio=Q",
    help="Angular velocity after the impact: conserved angular momentum, eq. (7a) as printed, or theta'2/theta'1 = Q.",
)
@option(
    "--direction",
    type=SuggestingChoice(["+", "-", "both"]),
    default="both",
    show_default=True,
    help="Sign of the ground acceleration that can start a chain of motion.",
)
@landing_option("Landing impulse of the foot: unlimited friction (paper), or limited by friction with further sliding (friction).")
@option("--first", is_flag=True, help="Compute only the first chain of motion in each --window, as in the paper. [default: all]")
@option("--repeat", is_flag=True, hidden=True, help="All chains of motion; the default since 0.2.0.")
@option(
    "--tenon",
    type=LENGTH,
    callback=check_callback(checks.positive),
    section="Body",
    help="Length of the tenons, m or with a unit: reports whether they leave the mortises.",
)
@gravity_option
@output_options()
def jump(source: Source, output: OutputOptions, repeat: bool, tenon: float | None, **params: Any) -> None:
    """Rocking, impact, jump, landing and slide-rocking of a two-layer block (Sugimoto et al. 2017).

    Each horizontal component is solved separately, as a sequence of chains of motion; a motion under way at the end of the record
    continues on still ground. --window limits the start of rocking, not the ground motion. Tilt is positive towards the component's
    positive direction; displacements of the centroid are relative to the ground.
    """
    from seisblock.cli.bodies.two_layer import two_layer_choice
    from seisblock.cli.hints import jump_hint
    from seisblock.models.jump.solve import solve_jump
    from seisblock.report.json.jump import document
    from seisblock.report.text import jump as text_output

    if repeat and params["first"]:
        raise click.UsageError(gettext("--first and --repeat (the default) exclude each other: give only one of them"))
    if params["width"] is None:
        reject_without("--width", ["depth"])
    else:
        reject_with("--width", ["side"])
    choice = two_layer_choice(params, default=DEFAULT_BLOCK)
    info("body: {name}; {says}", name=lazy_gettext(choice.block.name), says=choice.description)
    options = {key: params[key] for key in ("drop", "spin", "direction", "landing", "first", "gravity")}
    responses = [
        solve_jump(choice.block, motion, contact=choice.contact, windows=source.window, **options)
        for record in load_records(source, keep_whole=True)
        for motion in selected_motions(record, source)
    ]
    write_results(
        document(responses, choice.block, tenon=tenon),
        output,
        responses=responses,
        tables=lambda: chain(
            text_output.tables(responses, gal=output.gal, tenon=tenon),
            jump_hint(source, params, DEFAULT_BLOCK, choice.block, choice.contact, tenon),
        ),
    )
