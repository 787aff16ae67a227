"""``seisblock respond``: what a free-standing object does, whichever comes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli.azimuth_sweep import azimuth_figure, sweep_motions
from seisblock.cli.bodies.free_standing import choose_free_standing, free_standing_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.options import Source, gravity_option, output_options, record_options
from seisblock.cli.output import Output
from seisblock.cli.versions import pop_spreads, ranges_replaced, version_options
from seisblock.cli.write_results import write_results

if TYPE_CHECKING:
    from seisblock.records import Record
    from seisblock.studies.respond.azimuths import RespondAzimuth

VARIED_PARAMETERS = ("size", "inset", "mu", "restitution", "amplitude", "azimuth")


@click.command(
    cls=Command,
    examples=(
        "seisblock respond --width 45cm --height 180cm --mu 0.3",
        "seisblock respond record.csv --block gravestone --component EW --plot respond.png",
    ),
)
@record_options
@free_standing_options
@option(
    "--vertical/--no-vertical",
    default=None,
    help="Whether the vertical component acts. [default: where the record has one]",
)
@version_options(*VARIED_PARAMETERS, runs=200)
@option("--settle", type=float, default=60.0, show_default=True, metavar="S", help="How long it is followed after the record, s.")
@gravity_option
@output_options()
def respond(
    source: Source,
    output: Output,
    gravity: float,
    vertical: bool | None,
    runs: int,
    moved: float,
    seed: int,
    settle: float,
    **params: Any,
) -> None:
    """Tell what a free-standing object does: rests, slides, rocks, slides while rocking, flies, falls, whichever comes.

    Plane motion of one rigid body with Coulomb friction, each horizontal component by itself, the vertical acting where the record has
    it. After the record's end the object is followed until it rests. Beside the verdict stands the share of plausible
    versions of the object and the shaking that fall: they vary around what is given, and edges and friction that nobody has measured lie in
    the ranges of the object's kind, unless --vary-inset or --vary-mu is given. --component all-azimuths looks in every direction and
    answers for the worst. A scanned --block is another block in each direction.
    """
    from seisblock.cli.progress import progress
    from seisblock.models.respond.solve import solve_respond
    from seisblock.report.json.respond import document
    from seisblock.report.text import respond as shown
    from seisblock.studies.respond.probability import ParameterVariation, respond_probability

    widths = pop_spreads(params, *VARIED_PARAMETERS)
    replaced = ranges_replaced()
    choice = choose_free_standing({**params, "gal": output.gal})
    info("body: {says}", says=choice.description)
    options: dict[str, Any] = {
        "mu": choice.mu,
        "mu_kinetic": choice.mu_kinetic,
        **{name: params[name] for name in ("restitution", "rocking_restitution", "tenon")},
        "gravity": gravity,
        "settle_s": settle,
    }
    responses, extras = [], []
    for motion, directions in sweep_motions(source, _azimuth_study(choice.body, vertical, options)):
        block = choice.block_for_motion(motion)
        responses.append(solve_respond(block, motion, vertical=vertical, **options))
        extra: dict[str, Any] = choice.block_key(block)
        if runs:
            study_options = {**options, "vertical": vertical, "runs": runs, "moved_m": moved, "seed": seed}
            with progress("versions {name}", name=motion.name) as advance:
                extra["probability"] = respond_probability(
                    block.without_ranges(*replaced), motion, versions=ParameterVariation(**widths), progress=advance, **study_options
                )
        if directions:
            extra["directions"] = directions
        extras.append(extra)
    write_results(
        document(responses, responses[0].body, extras),
        output,
        responses=responses,
        figure=azimuth_figure(responses, extras, gal=output.gal),
        tables=lambda: shown.tables(responses, extras, gal=output.gal),
    )


def _azimuth_study(body: Any, vertical: bool | None, options: dict[str, Any]) -> Callable[[Record], Sequence[RespondAzimuth]]:
    """Return what looks in every direction of a record."""

    def look(record: Record) -> Sequence[RespondAzimuth]:
        from seisblock.studies.respond.azimuths import respond_directions

        return respond_directions(body, record, vertical=vertical, **options)

    return look
