"""``seisblock respond``: what a free-standing object does, whichever comes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli.bodies.standing import choose_standing, standing_options
from seisblock.cli.command import Command, option
from seisblock.cli.emit import emit
from seisblock.cli.options import Source, gravity_option, output_options, record_options
from seisblock.cli.output import Output
from seisblock.cli.sweeping import drawing, swept
from seisblock.cli.talk import say
from seisblock.cli.versions import ranges_replaced, version_options, widths_of

if TYPE_CHECKING:
    from seisblock.records import Record
    from seisblock.studies.standing.azimuths import AzimuthFate

VARIED = ("size", "inset", "mu", "restitution", "amplitude", "azimuth")


@click.command(
    cls=Command,
    examples=(
        "seisblock respond --width 45cm --height 180cm --mu 0.3",
        "seisblock respond record.csv --block gravestone --component EW --plot respond.png",
    ),
)
@record_options
@standing_options
@option(
    "--vertical/--no-vertical",
    default=None,
    help="Whether the vertical component acts. [default: where the record has one]",
)
@version_options(*VARIED, runs=200)
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
    **given: Any,
) -> None:
    """Tell what a free-standing object does: rests, slides, rocks, slides while rocking, flies, falls, whichever comes.

    Plane motion of one rigid body with Coulomb friction, each horizontal component by itself, the vertical acting where the record has
    it. After the record's end the object is followed until it rests. Beside the verdict stands the share of plausible
    versions of the object and the shaking that fall: they vary around what is given, and edges and friction that nobody has measured lie in
    the ranges of the object's kind, unless --vary-inset or --vary-mu is given. --component all-azimuths looks in every direction and
    answers for the worst. A scanned --block is another block in each direction.
    """
    from seisblock.cli.progress import progress
    from seisblock.present.documents.respond import document
    from seisblock.present.text import respond as shown
    from seisblock.solvers.respond.solve import solve_respond
    from seisblock.studies.standing.probability import Versions, respond_probability

    widths = widths_of(given, *VARIED)
    replaced = ranges_replaced()
    chosen = choose_standing({**given, "gal": output.gal})
    say("body: {says}", says=chosen.says)
    options: dict[str, Any] = {
        "mu": chosen.mu,
        "mu_kinetic": chosen.mu_kinetic,
        **{name: given[name] for name in ("restitution", "rocking_restitution", "tenon")},
        "gravity": gravity,
        "settle_s": settle,
    }
    responses, extras = [], []
    for motion, directions in swept(source, _all_around(chosen.body, vertical, options)):
        block = chosen.along(motion)
        responses.append(solve_respond(block, motion, vertical=vertical, **options))
        extra: dict[str, Any] = chosen.entry_of(block)
        if runs:
            same = {**options, "vertical": vertical, "runs": runs, "moved_m": moved, "seed": seed}
            with progress("versions {name}", name=motion.name) as advance:
                extra["probability"] = respond_probability(
                    block.known(*replaced), motion, versions=Versions(**widths), progress=advance, **same
                )
        if directions:
            extra["directions"] = directions
        extras.append(extra)
    emit(
        document(responses, responses[0].body, extras),
        output,
        responses=responses,
        figure=drawing(responses, extras, gal=output.gal),
        tables=lambda: shown.tables(responses, extras, gal=output.gal),
    )


def _all_around(body: Any, vertical: bool | None, options: dict[str, Any]) -> Callable[[Record], Sequence[AzimuthFate]]:
    """Return what looks in every direction of a record."""

    def look(record: Record) -> Sequence[AzimuthFate]:
        from seisblock.studies.standing.azimuths import respond_directions

        return respond_directions(body, record, vertical=vertical, **options)

    return look
