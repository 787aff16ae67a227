"""``seisblock respond``: full response of a free-standing object."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli.azimuth_sweep import azimuth_figure, sweep_motions
from seisblock.cli.bodies.free_standing import choose_free_standing, free_standing_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command
from seisblock.cli.console import info
from seisblock.cli.options import Source, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.sampling_options import pop_spreads, ranges_replaced, version_options
from seisblock.cli.write_results import write_results
from seisblock.models.respond.options import RespondOptions

if TYPE_CHECKING:
    from seisblock.records import Record
    from seisblock.studies.respond.azimuths import RespondAzimuth

VARIED_PARAMETERS = ("size", "inset", "mu", "restitution", "amplitude", "azimuth")


@click.command(
    cls=Command,
    essential=("--width", "--height", "--kind", "--block", "--mu", "--surface", "--floor", "--vertical", "--runs"),
    examples=(
        "seisblock respond --width 45cm --height 180cm --mu 0.3",
        "seisblock respond record.csv --block gravestone --component EW --plot respond.png",
    ),
)
@record_options
@free_standing_options
@solver_options(RespondOptions, "vertical")
@version_options(*VARIED_PARAMETERS, runs=200)
@solver_options(RespondOptions, "settle_s", "gravity")
@output_options()
def respond(
    source: Source,
    output: OutputOptions,
    gravity: float,
    vertical: bool | None,
    runs: int,
    moved: float,
    seed: int,
    settle_s: float,
    **params: Any,
) -> None:
    """Full response of a free-standing object: rest, sliding, rocking, slide-rocking, flight, overturning.

    Plane motion of one rigid body with Coulomb friction; each horizontal component is solved separately, with the vertical component
    where the record has one, until the object is at rest. The overturning probability is the share of samples of body and motion that
    overturn. Samples vary around the given values; edge wear and friction that are not given are drawn from the ranges of the
    object's kind (see --vary-inset, --vary-mu). --component all-azimuths sweeps all azimuths and reports the worst. The
    dimensions of a scanned --block depend on the azimuth.
    """
    from seisblock.cli.progress import progress
    from seisblock.models.respond.solve import solve_respond
    from seisblock.report.json.respond import document
    from seisblock.report.text import respond as text_output
    from seisblock.studies.respond.probability import ParameterVariation, respond_probability

    widths = pop_spreads(params, *VARIED_PARAMETERS)
    replaced = ranges_replaced()
    choice = choose_free_standing({**params, "gal": output.gal})
    info("body: {says}", says=choice.description)
    options = RespondOptions(
        mu=choice.mu,
        mu_kinetic=choice.mu_kinetic,
        restitution=params["restitution"],
        rocking_restitution=params["rocking_restitution"],
        tenon=params["tenon"],
        vertical=vertical,
        gravity=gravity,
        settle_s=settle_s,
    )
    responses, extras = [], []
    for motion, directions in sweep_motions(source, _azimuth_study(choice.body, options)):
        block = choice.block_for_motion(motion)
        responses.append(solve_respond(block, motion, **options.keywords()))
        extra: dict[str, Any] = choice.block_key(block)
        if runs:
            with progress("samples {name}", name=motion.name) as advance:
                extra["probability"] = respond_probability(
                    block.without_ranges(*replaced),
                    motion,
                    options,
                    runs=runs,
                    moved_m=moved,
                    versions=ParameterVariation(**widths),
                    seed=seed,
                    progress=advance,
                )
        if directions:
            extra["directions"] = directions
        extras.append(extra)
    write_results(
        document(responses, responses[0].body, extras),
        output,
        responses=responses,
        figure=azimuth_figure(responses, extras, gal=output.gal),
        tables=lambda: text_output.tables(responses, extras, gal=output.gal),
    )


def _azimuth_study(body: Any, options: RespondOptions) -> Callable[[Record], Sequence[RespondAzimuth]]:
    """Return a function that solves all azimuths of a record."""

    def look(record: Record) -> Sequence[RespondAzimuth]:
        from seisblock.studies.respond.azimuths import respond_directions

        return respond_directions(body, record, options)

    return look
