"""``seisblock rock``: rocking, overturning and margin of one block."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli.azimuth_sweep import ranked_sweep, sweep_block, sweep_motions, write_assessed
from seisblock.cli.bodies.options import azimuth_option, block_list_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.option_checks import reject_without
from seisblock.cli.options import Source, output_options, peak_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.types import MUS, Count
from seisblock.cli.variants import check_variants, describe_first, list_variants, variant_params, write_variants
from seisblock.core.errors import ComponentError, ParameterError
from seisblock.core.i18n import N_, gettext
from seisblock.core.limits import MAX_RUNS
from seisblock.models.rock.options import RockOptions

if TYPE_CHECKING:
    from seisblock.bodies.block import Block
    from seisblock.core.results import Response
    from seisblock.records import Motion
    from seisblock.records._validation import Gain


@click.command(
    cls=Command,
    essential=(
        "--width",
        "--height",
        "--inset",
        "--kind",
        "--block",
        "--restitution",
        "--vertical",
        "--margin",
        "--floor",
        "--pga",
        "--pgv",
        "--frequency",
    ),
    examples=(
        "seisblock rock --width 24cm --height 72cm",
        "seisblock rock record.csv --block gravestone --component EW --margin --plot rock.png",
        "seisblock rock --pga 400 --pgv 40 --block gravestone",
    ),
)
@record_options
@peak_options
@block_list_options
@solver_options(RockOptions, "restitution", "linear", "vertical")
@azimuth_option
@option(
    "--mu",
    type=MUS,
    section="Body",
    help="Static friction coefficient of the ground; number, list or range: reports whether rocking requires more. [default: not checked]",
)
@option("--margin", is_flag=True, help="Scale factor to overturning, and overturning probability at factor 1.")
@option("--margin-limit", type=float, default=3.0, show_default=True, help="Largest scale factor of the margin search.")
@option(
    "--perturb",
    type=Count(N_("samples"), MAX_RUNS),
    metavar="N",
    help="Samples of body and motion for the overturning probability, with its details. [default: 200]",
)
@option(
    "--spread",
    type=float,
    help="Half width of the samples, a share of width, height, restitution and amplitude; the azimuth varies by 10 deg, a known "
    "inset by 10 %, an unknown inset within the range of the body's kind. [default: sizes 0.05, restitution and amplitude 0.1]",
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
    mu: tuple[float, ...] | None,
    margin: bool,
    margin_limit: float,
    perturb: int | None,
    spread: float | None,
    seed: int,
    **body: Any,
) -> None:
    """Rocking and overturning of one rigid block about its two lower corners (Housner 1963).

    Each horizontal component acts along the width; seisblock scenario turns the object by 90 degrees, too. Rotation is positive towards
    the component's positive direction. After the end of the record, the energy decides whether the block overturns. --component
    all-azimuths sweeps all azimuths in steps of 5 degrees and reports the worst. Towards an azimuth in degrees a block stands with its
    width to north and its --depth to east, and its base is projected. The dimensions of a scanned --block depend on the azimuth, too.
    --pga with --pgv or --frequency answers without a record: closed forms, and runs under a suite of synthetic and recorded motions
    scaled to both.
    """
    from seisblock.cli.bodies.block import choose_block
    from seisblock.cli.hints import rock_hint
    from seisblock.cli.peaks import parse_peaks
    from seisblock.models.rock.outcome import friction_suffices
    from seisblock.models.rock.solve import solve_rock
    from seisblock.report.json.rock import document
    from seisblock.report.text.rock import tables
    from seisblock.studies.azimuth_probability import average_azimuths
    from seisblock.studies.model_comparison import compare_models
    from seisblock.studies.rocking.margin import find_margin, flag_near_flip
    from seisblock.studies.rocking.perturb import summarize
    from seisblock.studies.sampling import RUNS, ParameterVariation, sample
    from seisblock.studies.solvers.rock import assess_rock

    if not margin:
        reject_without("--margin", ["margin_limit"])
    peaks = parse_peaks(source, body, ["azimuth", "mu", "margin", "perturb", "spread"])
    body["mu"] = mu
    variants = list_variants(body)
    if peaks is not None and len(variants) > 1:
        raise ParameterError("--pga accepts one width and height: give one of each")
    check_variants(source, output, variants)
    source = with_azimuths(source, azimuth)
    if mu is not None and not all(0.0 <= value < float("inf") for value in mu):
        raise ParameterError("the friction coefficient must be zero or positive, found {value}", value=min(mu))
    variation = ParameterVariation() if spread is None else ParameterVariation(size=spread, restitution=spread, amplitude=spread)
    responses: list[Response[Any]] = []
    extras: list[dict[str, Any]] = []
    motions: list[Any] = []
    for variant in variants:
        values = variant_params(body, variant)
        friction = values["mu"]
        choice = choose_block({**values, "restitution": restitution, "gal": output.gal})
        if not responses:
            info("{line}", line=describe_first(choice.description, variants))
        options = RockOptions(restitution=choice.restitution, linear=linear, vertical=vertical, gravity=gravity)
        if peaks is not None:
            _rock_under_suite(choice.block, peaks, options, seed, output)
            return
        runs = RUNS if perturb is None else perturb
        motions = motions or list(sweep_motions(source, ranked_sweep("rock", choice.body, options, runs, variation, seed)))
        for motion, directions in motions:
            require_vertical(motion, vertical)
            block = sweep_block(choice, motion, directions)
            responses.append(flag_near_flip(solve_rock(block, motion, **options.keywords())))
            comparison = compare_models(block, motion, options=options)
            extra: dict[str, Any] = {"agreement": comparison, **choice.block_key(block), **({"variant": variant} if variant else {})}
            if directions:
                extra |= {"directions": directions, "all_azimuths": average_azimuths(directions, runs)}
            if friction is not None:
                extra["friction_suffices"] = friction_suffices(responses[-1].outcome, friction, gravity)
            if margin:
                with progress("margin {name}", name=motion.name) as advance:
                    extra["margin"] = find_margin(block, motion, limit=margin_limit, progress=advance, options=options)
            with progress("samples {name}", name=motion.name) as advance:
                samples = sample("rock", block, motion, options, runs, variation, seed=seed, progress=advance)
            extra["assessment"] = assess_rock(block, motion, options, samples, comparison=comparison)
            if margin or perturb is not None:
                extra["perturbation"] = summarize(samples, block)
            extras.append(extra)
    if len(variants) > 1:
        write_variants(document(responses, extras, margin_limit=margin_limit if margin else None), output, responses, extras)
        return
    write_assessed(
        document(responses, extras, margin_limit=margin_limit if margin else None, mu=friction),
        output,
        responses,
        extras,
        lambda: chain(
            tables(responses, extras, gal=output.gal, mu=friction),
            rock_hint(
                source,
                values,
                choice.block if values.get("block") is None else responses[0].body,
                friction,
                suffices=all(extra.get("friction_suffices", True) for extra in extras),
            ),
        ),
    )


def _rock_under_suite(block: Block, peaks: tuple[float, float], options: RockOptions, seed: int, output: OutputOptions) -> None:
    """Solve a block under a suite scaled to PGA and PGV, m/s^2 and m/s, and write the result."""
    from seisblock.cli.peaks import write_peaks
    from seisblock.report.json.peaks import document
    from seisblock.report.json.rock import ROCK_PEAKS
    from seisblock.studies.scenario.motions import ScenarioTarget, scenario_suite
    from seisblock.studies.scenario.peaks import assess_peaks

    with progress("generating the records"):
        records, notes = scenario_suite(ScenarioTarget(pga_m_s2=peaks[0], pgv_m_s=peaks[1]), seed=seed)
    for note in notes:
        info("{note}", note=note)
    with progress("records") as advance:
        result = assess_peaks(block, *peaks, records=records, options=options, seed=seed, progress=advance)
    write_peaks(result, document(result, ROCK_PEAKS, options, seed=seed, notes=notes), output)


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
