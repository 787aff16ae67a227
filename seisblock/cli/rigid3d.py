"""``seisblock rigid3d``: response of one rigid body in three dimensions; also ``respond --three-d``."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import click

from seisblock.bodies.block import Block
from seisblock.bodies.convex import convex_body
from seisblock.bodies.scan.body import ScannedBody
from seisblock.cli.bodies.free_standing import FreeStandingChoice, choose_free_standing, surface_option
from seisblock.cli.bodies.options import block_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command
from seisblock.cli.console import info
from seisblock.cli.options import Source, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.sampling_options import pop_spreads, ranges_replaced, version_options
from seisblock.core.errors import BodyError
from seisblock.models.rigid3d.options import Rigid3dOptions

if TYPE_CHECKING:
    from seisblock.studies.sampling import ParameterVariation

VARIED_PARAMETERS = ("size", "inset", "mu", "restitution", "amplitude", "azimuth")

RUNS = 100
"""Default number of samples."""


@click.command(
    cls=Command,
    essential=("--width", "--height", "--depth", "--block", "--mu", "--surface", "--vertical", "--runs"),
    examples=(
        "seisblock rigid3d --width 24cm --height 72cm --depth 30cm --mu 0.5",
        "seisblock rigid3d record.csv --block boulder --mu 0.6 --component EW",
    ),
)
@record_options
@block_options
@surface_option
@solver_options(Rigid3dOptions, "mu", "restitution", "vertical", "across")
@version_options(*VARIED_PARAMETERS, runs=RUNS)
@solver_options(Rigid3dOptions, "settle_s", "gravity")
@output_options()
def rigid3d(source: Source, output: OutputOptions, **params: Any) -> None:
    """Response in three dimensions of one rigid body, a block or a scan: sliding, rocking, rolling, twist, flight, overturning.

    Rigid contact of the convex hull with Coulomb friction under all components of the record at once; --component gives the direction of
    the x axis, along which the width of a block lies. The run continues until the body is at rest. The hull of a scanned --block faces
    the azimuth of its file. The overturning probability is the share of samples of body and motion that overturn; those that stand give
    the spread of residual displacement and twist.
    """
    from seisblock.studies.sampling import ParameterVariation

    variation = ParameterVariation(**pop_spreads(params, *VARIED_PARAMETERS))
    choice = choose_free_standing({**params, "mu_kinetic": None, "gal": output.gal})
    names = ("restitution", "vertical", "across", "gravity", "settle_s")
    options = Rigid3dOptions(mu=choice.mu, **{name: params[name] for name in names})
    solve_in_space(source, output, choice, options, variation, **{name: params[name] for name in ("runs", "moved", "seed")})


def solve_in_space(
    source: Source,
    output: OutputOptions,
    choice: FreeStandingChoice,
    options: Rigid3dOptions,
    variation: ParameterVariation,
    *,
    runs: int,
    moved: float,
    seed: int,
) -> None:
    """Solve the records in three dimensions with samples, and write the results."""
    from seisblock.cli.azimuth_sweep import sweep_motions, write_assessed
    from seisblock.cli.progress import progress
    from seisblock.models.rigid3d.describe import contact_summary
    from seisblock.models.rigid3d.solve import solve_rigid3d
    from seisblock.report.json.rigid3d import document
    from seisblock.report.text.rigid3d import tables
    from seisblock.studies.azimuth_probability import sample_orientations
    from seisblock.studies.respond.azimuths import rigid3d_directions
    from seisblock.studies.respond.probability import summarize_spatial
    from seisblock.studies.sampling import sample
    from seisblock.studies.solvers.rigid3d import assess_rigid3d

    if choice.mu_kinetic not in (None, choice.mu):
        raise BodyError("three dimensions use one friction coefficient, and this body has a lower kinetic one: give --mu")
    info("body: {says}", says=choice.description)
    body = choice.body
    if isinstance(body, ScannedBody):
        info(contact_summary(convex_body(body), gal=output.gal))
    median = body.without_ranges(*ranges_replaced()) if isinstance(body, Block) else body
    responses, extras = [], []
    # the other components act, too: one direction of +x is the whole answer
    first_only = not source.component
    last_record = None
    for motion, directions in sweep_motions(source, partial(rigid3d_directions, median, options=options)):
        if first_only and motion.record is last_record:
            continue
        last_record = motion.record
        # in a sweep, +x of the scan itself has the azimuth
        shaken, rest = (convex_body(body), convex_body(median)) if directions and not isinstance(body, Block) else (body, median)
        response = solve_rigid3d(shaken, motion, **options.keywords())
        extra: dict[str, Any] = {}
        if runs:
            with progress("samples {name}", name=motion.name) as advance:
                samples = sample("rigid3d", rest, motion, options, runs, variation, seed=seed, progress=advance)
            extra["probability"] = summarize_spatial(samples, median, moved)
            extra["assessment"] = assess_rigid3d(response, samples, moved_m=moved)
            if directions and motion.record is not None:
                with progress("azimuths") as advance:
                    extra["all_azimuths"] = sample_orientations(
                        median, motion.record, options, runs, variation, moved_m=moved, seed=seed, progress=advance
                    )
        if directions:
            extra["directions"] = directions
        responses.append(response)
        extras.append(extra)
    write_assessed(document(responses, extras), output, responses, extras, lambda: tables(responses, extras, gal=output.gal))
