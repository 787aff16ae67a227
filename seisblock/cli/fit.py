"""``seisblock fit``: block parameters from observed overturning."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import click

from seisblock.cli import shell_completion
from seisblock.cli.bodies.options import block_options
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, argument, option
from seisblock.cli.options import Source, output_options, preparation_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.types import ANGLE, Count
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, gettext
from seisblock.core.limits import MAX_RUNS, MAX_VALUES

SIZES = ("width", "height", "depth", "mass", "centroid_height", "centroid_offset", "centroid_inertia", "block")
"""Options that describe a body."""


def _names(ctx: click.Context, param: click.Parameter, value: tuple[str, ...]) -> tuple[str, ...] | None:
    """Split repeated and comma-separated names; None without the option."""
    names = tuple(part.strip() for text in value for part in text.split(",") if part.strip())
    if value and not names:
        raise click.BadParameter(gettext("the list is empty: name the parameters to estimate, or none"), ctx, param)
    return () if names == ("none",) else names or None


def _bounds(ctx: click.Context, param: click.Parameter, value: tuple[str, ...]) -> dict[str, tuple[float, float]]:
    """Parse repeated ``NAME=LOW:HIGH``."""
    bounds = {}
    for text in value:
        name, _, ends = text.partition("=")
        try:
            low, high = (float(end) for end in ends.split(":"))
        except ValueError:
            low = high = math.nan
        if not (name.strip() and math.isfinite(low) and math.isfinite(high)):
            raise click.BadParameter(gettext("{text!r} is not NAME=LOW:HIGH, for example alpha=0.1:0.5", text=text), ctx, param)
        bounds[name.strip()] = low, high
    return bounds


@click.command(
    cls=Command,
    essential=("--outcome", "--free", "--bounds", "--width", "--height", "--block", "--folds"),
    examples=(
        "seisblock fit shaken_block.csv --free alpha,p --plot fit.png",
        "seisblock fit shaken_block.csv --width 26cm --height 90cm --free inset --scatter 0.05",
    ),
)
@argument(
    "outcomes",
    metavar="OUTCOMES",
    section="Record",
    shell_complete=shell_completion.complete_bundled("outcomes"),
    help="Table (.csv): record, a file in the same folder; fell or moved, 0 or 1; optional weight, component, scale. Bundled: "
    "shaken_block.csv.",
)
@preparation_options
@option(
    "--outcome",
    type=click.Choice(["fell", "moved"]),
    help="Column of outcomes, where the table has fell and moved. [default: fell]",
)
@option(
    "--free",
    multiple=True,
    callback=_names,
    metavar="NAME[,NAME...]",
    help="Parameters to estimate: alpha, p, restitution, inset; or none. [default: those not given: alpha and p, or the inset of a "
    "body; and the restitution]",
)
@block_options
@option(
    "--azimuth",
    type=ANGLE,
    metavar="DEG",
    section="Body",
    help="Azimuth of the shaking for a scanned --block, degrees clockwise from north.",
)
@option(
    "--restitution",
    type=float,
    metavar="E",
    section="Body",
    help="Fixed coefficient of restitution: ratio of angular velocities after and before an impact, 0 to 1. [default: 1 - 1.5 "
    "sin^2(alpha)]",
)
@option(
    "--bounds",
    multiple=True,
    callback=_bounds,
    metavar="NAME=LOW:HIGH",
    help="Bounds of alpha, rad, p, rad/s, and the ratios restitution, inset and scatter; may be repeated. [default: alpha=0.03:1, "
    "p=1:25, restitution=0.3:0.99, inset=0:0.45, scatter=0.01:0.2]",
)
@option(
    "--scatter",
    type=float,
    metavar="SHARE",
    help="Half width of the variation between runs, a share of size, slenderness, restitution and amplitude. [default: estimated]",
)
@option("--lapse", type=float, metavar="SHARE", help="Lapse rate: share of outcomes independent of the model. [default: estimated]")
@option("--vertical/--no-vertical", default=None, help="Apply or omit the vertical component. [default: applied where the record has one]")
@option(
    "--folds",
    type=Count(N_("folds"), MAX_VALUES, minimum=2),
    metavar="K",
    help="Folds of the cross-validation. [default: 5]",
)
@option("--confidence", type=float, default=0.9, show_default=True, help="Confidence level of the intervals, 0 to 1.")
@option(
    "--runs",
    type=Count(N_("samples"), MAX_RUNS),
    default=16,
    show_default=True,
    help="Samples of each block under each record, fewer where blocks agree: 1, 2, 4, 8, 16, 32 or 64.",
)
@option("--seed", type=int, default=0, show_default=True, help="Seed of the random numbers.")
@gravity_option
@output_options(histories=False, film=False)
def fit(outcomes: str, source: Source, output: OutputOptions, **params: Any) -> None:
    """Parameters of a rigid block that explain under which records an object overturned or remained standing.

    Estimates slenderness alpha, frequency parameter p, restitution and edge wear (see --free) with their credible intervals.
    Cross-validation shows how well the fitted block predicts records that were left out.
    """
    from seisblock.cli.progress import progress
    from seisblock.records._validation import vertical_acts
    from seisblock.report.json.fit import document
    from seisblock.report.text import fit as text_output
    from seisblock.studies.fit.fit import fit_block

    observed = _read_outcomes(outcomes, source, params.pop("outcome"))
    block, inset, restitution = _choose_body(params)
    options = {key: params[key] for key in ("free", "bounds", "scatter", "lapse", "vertical", "folds", "runs", "seed", "gravity")}
    with progress("solving records") as advance:
        result = fit_block(
            observed,
            kind=observed.kind,
            block=block,
            inset=inset,
            restitution=restitution,
            level=params["confidence"],
            progress=advance,
            **options,
        )
    acts = vertical_acts((observation.motion for observation in observed), options["vertical"])
    answer = document(result, observed, block, outcomes, vertical=acts, gravity=options["gravity"])

    write_results(
        answer,
        output,
        tables=lambda: text_output.tables(result, observed, Path(outcomes).name),
        figure=figure_of("fit:fit_figure", result, Path(outcomes).name, gal=output.gal),
        csv=lambda: text_output.csv_columns(result, observed),
    )


def _read_outcomes(outcomes: str, source: Source, kind: str | None) -> Any:
    from seisblock.cli.load_records import check_single_window, make_preparation
    from seisblock.cli.progress import progress
    from seisblock.studies.fit.outcome_table import read_outcomes

    check_single_window(source)
    if len(source.component) > 1:
        raise ParameterError(
            "the shaking is one component, found {names}: name the others in a column `component`", names=list(source.component)
        )
    with progress("reading {names}", names=[Path(outcomes).name]) as advance:
        return read_outcomes(
            outcomes,
            kind=kind,
            component=source.component[0] if source.component else None,
            preparation=make_preparation(source, source.component),
            read_options=source.read_options(),
            strict=source.strict,
            progress=advance,
        )


def _choose_body(params: dict[str, Any]) -> tuple[Any, Any, float | None]:
    """Return block, inset and restitution of the options or the body's file; None where not given."""
    from seisblock.cli.bodies.block import choose_block
    from seisblock.cli.console import info

    if all(params[key] is None for key in SIZES):
        return None, params["inset"], params["restitution"]
    free = params["free"] or ()
    choice = choose_block(params)
    info("body: {says}", says=choice.description)
    # a restitution from the body's file is only a default here: it may still be estimated
    block = choice.block if params["azimuth"] is None else choice.towards(params["azimuth"])
    return block, params["inset"], params["restitution"] if "restitution" in free else choice.restitution
