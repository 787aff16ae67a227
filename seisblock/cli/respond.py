"""``seisblock respond``: full response of a free-standing object."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click

from seisblock.bodies.scan.body import ScannedBody
from seisblock.cli.azimuth_sweep import ranked_sweep, sweep_block, sweep_motions, write_assessed
from seisblock.cli.bodies.free_standing import FreeStandingChoice, choose_free_standing, free_standing_list_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.options import Source, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.sampling_options import pop_spreads, ranges_replaced, version_options
from seisblock.cli.variants import check_variants, describe_first, list_variants, variant_params, write_variants
from seisblock.core.errors import ParameterError
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rigid3d.options import Rigid3dOptions

if TYPE_CHECKING:
    from seisblock.core.results import Response
    from seisblock.studies.sampling import ParameterVariation

PLANAR_OPTIONS = ("mu_kinetic", "rocking_restitution")
"""Options that only the plane model has."""

VARIED_PARAMETERS = ("size", "inset", "mu", "restitution", "amplitude", "azimuth")


@click.command(
    cls=Command,
    essential=("--width", "--height", "--kind", "--block", "--mu", "--surface", "--floor", "--runs"),
    examples=(
        "seisblock respond --width 45cm --height 180cm --mu 0.3",
        "seisblock respond record.csv --block gravestone --component EW --plot respond.png",
        "seisblock respond --width 45cm --height 180cm --mu 0.2,0.3,0.5 --plot friction.png",
    ),
)
@record_options
@free_standing_list_options
@solver_options(RespondOptions, "vertical")
@version_options(*VARIED_PARAMETERS, runs=200)
@solver_options(RespondOptions, "settle_s", "gravity")
@option(
    "--three-d/--planar",
    default=None,
    help="Three dimensions under all components at once, as rigid3d, or the vertical plane of each component. [default: three dimensions "
    "for a scan, else planar]",
)
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
    three_d: bool | None,
    **params: Any,
) -> None:
    """Full response of a free-standing object: rest, sliding, rocking, slide-rocking, flight, overturning.

    Plane motion of one rigid body with Coulomb friction until it is at rest, with the vertical component where the record has one. Each
    horizontal component acts along the width; seisblock scenario turns the object by 90 degrees, too. The overturning probability is the
    share of samples of body and motion that overturn. Samples vary around the given values; edge wear and friction that are not given
    are drawn from the ranges of the object's kind. --component all-azimuths reports the worst azimuth; towards an azimuth in degrees
    the base is projected (width to north, --depth to east). A scanned --block is solved in three dimensions.
    """
    from seisblock.cli.progress import progress
    from seisblock.models.respond.solve import solve_respond
    from seisblock.report.json.respond import document
    from seisblock.report.text.respond import tables
    from seisblock.studies.azimuth_probability import average_azimuths
    from seisblock.studies.respond.probability import summarize
    from seisblock.studies.sampling import ParameterVariation, sample
    from seisblock.studies.solvers.respond import assess_respond

    variants = list_variants(params)
    variation = ParameterVariation(**pop_spreads(params, *VARIED_PARAMETERS))
    replaced = ranges_replaced()
    first = variant_params(params, variants[0])
    choice = choose_free_standing({**first, "gal": output.gal})
    if _has_three_dimensions(three_d, choice, first):
        if len(variants) > 1:
            raise ParameterError("three dimensions accept one width, height and friction: give one of each, or --planar")
        params = first
        in_space = Rigid3dOptions(mu=choice.mu, restitution=params["restitution"], vertical=vertical, gravity=gravity, settle_s=settle_s)
        _solve_in_space(source, output, params, choice, in_space, variation, runs=runs, moved=moved, seed=seed)
        return
    check_variants(source, output, variants)
    responses: list[Response[Any]] = []
    extras: list[dict[str, Any]] = []
    motions: list[Any] = []
    for variant in variants:
        values = variant_params(params, variant)
        choice = choose_free_standing({**values, "gal": output.gal})
        if not responses:
            info("{line}", line=describe_first(choice.description, variants))
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
        motions = motions or list(sweep_motions(source, ranked_sweep("respond", choice.body, options, runs, variation, seed, replaced)))
        for motion, directions in motions:
            block = sweep_block(choice, motion, directions)
            responses.append(solve_respond(block, motion, **options.keywords()))
            extra: dict[str, Any] = choice.block_key(block) | ({"variant": variant} if variant else {})
            if runs:
                median = block.without_ranges(*replaced)
                with progress("samples {name}", name=motion.name) as advance:
                    samples = sample("respond", median, motion, options, runs, variation, seed=seed, progress=advance)
                extra["probability"] = summarize(samples, median, moved)
                extra["assessment"] = assess_respond(block, motion, options, samples, moved_m=moved)
            if directions:
                extra |= {"directions": directions, **({"all_azimuths": average_azimuths(directions, runs)} if runs else {})}
            extras.append(extra)
    if len(variants) > 1:
        write_variants(document(responses, extras), output, responses, extras)
        return
    write_assessed(document(responses, extras), output, responses, extras, lambda: tables(responses, extras, gal=output.gal))


def _has_three_dimensions(three_d: bool | None, choice: FreeStandingChoice, params: Mapping[str, Any]) -> bool:
    """Return whether the run is in three dimensions: as asked, else for a scan with a hull, without options of the plane model alone."""
    if three_d is not None:
        return three_d
    is_planar = params["tenon"] or any(params[key] is not None for key in PLANAR_OPTIONS) or choice.mu_kinetic not in (None, choice.mu)
    return isinstance(choice.body, ScannedBody) and bool(choice.body.hull) and not is_planar


def _solve_in_space(
    source: Source,
    output: OutputOptions,
    params: Mapping[str, Any],
    choice: FreeStandingChoice,
    options: Rigid3dOptions,
    variation: ParameterVariation,
    **samples: Any,
) -> None:
    """Solve in three dimensions; reject options that only the plane model has."""
    from seisblock.cli.rigid3d import solve_in_space

    for key in PLANAR_OPTIONS:
        if params[key] is not None:
            raise ParameterError("{flag} has no effect with --three-d: omit it", flag="--" + key.replace("_", "-"))
    if params["tenon"]:
        raise ParameterError("{flag} has no effect with --three-d: omit it", flag="--tenon")
    solve_in_space(source, output, choice, options, variation, **samples)
