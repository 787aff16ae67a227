"""``seisblock rock``: rocking, overturning and margin of one block."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli.azimuth_sweep import azimuth_figure, sweep_motions
from seisblock.cli.bodies.options import azimuth_option, block_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.option_checks import reject_without
from seisblock.cli.options import Source, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.types import MU, Count
from seisblock.cli.write_results import write_results
from seisblock.core.errors import ComponentError, ParameterError
from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.core.limits import MAX_RUNS
from seisblock.models.rock.options import RockOptions

if TYPE_CHECKING:
    from seisblock.records import Motion, Record
    from seisblock.records._validation import Gain

DEFAULT_RUNS = 200
"""Default number of samples of body and motion with ``--margin``."""


@click.command(
    cls=Command,
    essential=("--width", "--height", "--inset", "--kind", "--block", "--restitution", "--vertical", "--margin", "--floor"),
    examples=(
        "seisblock rock --width 24cm --height 72cm",
        "seisblock rock record.csv --block gravestone --component EW --margin --plot rock.png",
    ),
)
@record_options
@block_options
@solver_options(RockOptions, "restitution", "linear", "vertical")
@azimuth_option
@option(
    "--mu",
    type=MU,
    section="Body",
    help="Static friction coefficient of the ground: reports whether rocking requires more. [default: not checked]",
)
@option("--margin", is_flag=True, help="Compute the scale factor to overturning, and the overturning probability at factor 1.")
@option("--margin-limit", type=float, default=3.0, show_default=True, help="Largest scale factor of the margin search.")
@option(
    "--perturb",
    type=Count(N_("samples"), MAX_RUNS),
    metavar="N",
    help="Overturning probability from N samples of body and motion.",
)
@option(
    "--spread",
    type=float,
    default=0.05,
    show_default=True,
    help="Half width of the samples, a share of size, slenderness, restitution and amplitude; the azimuth varies by 5 deg, a known "
    "inset by 10 %, an unknown inset within the range of the body's kind.",
)
@option("--seed", type=int, default=0, show_default=True, help="Seed of the samples.")
@solver_options(RockOptions, "gravity")
@output_options()
def rock(
    source: Source,
    output: OutputOptions,
    gravity: float,
    restitution: float | None,
    linear: bool,
    vertical: bool | None,
    azimuth: tuple[str, ...],
    mu: float | None,
    margin: bool,
    margin_limit: float,
    perturb: int | None,
    spread: float,
    seed: int,
    **body: Any,
) -> None:
    """Rocking and overturning of one rigid block about its two lower corners (Housner 1963).

    Each horizontal component is solved separately. Rotation is positive towards the component's positive direction. After the end of
    the record, the energy decides whether the block overturns. --component all-azimuths sweeps all azimuths in steps of 5 degrees and
    reports the worst. The dimensions of a scanned --block depend on the azimuth.
    """
    from seisblock.cli.bodies.block import choose_block
    from seisblock.cli.hints import rock_hint
    from seisblock.models.rock.outcome import friction_suffices
    from seisblock.models.rock.solve import solve_rock
    from seisblock.report.json.rock import document
    from seisblock.report.text import rock as text_output
    from seisblock.studies.model_comparison import compare_models
    from seisblock.studies.rocking.margin import find_margin, flag_near_flip
    from seisblock.studies.rocking.perturb import Spread
    from seisblock.studies.rocking.perturb import perturb as perturb_block

    if not margin:
        reject_without("--margin", ["margin_limit"])
        if perturb is None:
            reject_without(lazy_gettext("--perturb or --margin"), ["spread", "seed"])
    choice = choose_block({**body, "restitution": restitution, "gal": output.gal})
    info("body: {says}", says=choice.description)
    options = RockOptions(restitution=choice.restitution, linear=linear, vertical=vertical, gravity=gravity)
    source = with_azimuths(source, azimuth)
    if mu is not None and not 0.0 <= mu < float("inf"):
        raise ParameterError("the friction coefficient must be zero or positive, found {value}", value=mu)
    responses, extras = [], []
    for motion, directions in sweep_motions(source, _azimuth_study(choice.body, options)):
        require_vertical(motion, vertical)
        block = choice.block_for_motion(motion)
        responses.append(flag_near_flip(solve_rock(block, motion, **options.keywords())))
        extra: dict[str, Any] = {"agreement": compare_models(block, motion, options=options), **choice.block_key(block)}
        if directions:
            extra["directions"] = directions
        if mu is not None:
            extra["friction_suffices"] = friction_suffices(responses[-1].outcome, mu, gravity)
        if margin:
            with progress("margin {name}", name=motion.name) as advance:
                extra["margin"] = find_margin(block, motion, limit=margin_limit, progress=advance, options=options)
        if margin or perturb is not None:
            widths, runs = Spread(spread, spread, spread, spread), perturb or DEFAULT_RUNS
            with progress("samples {name}", name=motion.name) as advance:
                extra["perturbation"] = perturb_block(block, motion, runs, spread=widths, seed=seed, progress=advance, options=options)
        extras.append(extra)
    write_results(
        document(responses, responses[0].body, extras, margin_limit=margin_limit if margin else None, mu=mu),
        output,
        responses=responses,
        figure=azimuth_figure(responses, extras, gal=output.gal),
        tables=lambda: chain(
            text_output.tables(responses, extras, gal=output.gal, mu=mu),
            rock_hint(source, body, responses[0].body, mu, suffices=all(extra.get("friction_suffices", True) for extra in extras)),
        ),
    )


def _azimuth_study(body: Any, options: RockOptions) -> Callable[[Record], Sequence[Any]]:
    """Return a function that solves all azimuths of a record."""

    def look(record: Record) -> Sequence[Any]:
        from seisblock.studies.rocking.azimuths import rock_directions

        with progress("azimuths") as advance:
            return rock_directions(body, record, progress=advance, options=options)

    return look


def require_vertical(motion: Motion, vertical: Gain | None) -> None:
    """Raise an error for ``--vertical`` where the record has no vertical component."""
    if vertical and motion.record is not None and motion.record.vertical is None:
        raise ComponentError(
            "{source}: --vertical requires a vertical component; available: {codes}", source=motion.record.source, codes=motion.record.codes
        )


def with_azimuths(source: Source, azimuth: tuple[str, ...]) -> Source:
    """Return the record options with azimuths added to the components."""
    if not azimuth:
        return source
    names = tuple(part.strip() for text in azimuth for part in text.split(","))
    for name in names:
        try:
            float(name)
        except ValueError:
            raise click.BadParameter(
                gettext("{name!r} is not a number of degrees clockwise from north", name=name), param_hint="--azimuth"
            ) from None
    return replace(source, component=(*source.component, *names))
