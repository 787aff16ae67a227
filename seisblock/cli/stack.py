"""``seisblock stack``: response of a pile of stones in three dimensions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from seisblock.cli import shell_completion
from seisblock.cli.bodies.options import inset_option
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.load_records import load_records, selected_motions
from seisblock.cli.option_checks import given_flags
from seisblock.cli.options import Source, criterion_record_options, output_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.sampling_options import pop_spreads, version_options
from seisblock.cli.types import MU, ContactType, OutputFile
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.models.stack.options import EDGES, GRID, RIGID, SPRINGS, StackOptions

if TYPE_CHECKING:
    from seisblock.bodies.edge_wear import EdgeWear
    from seisblock.bodies.pile.pile import Pile
    from seisblock.records import Motion

DEFAULT_PILE = "wagata"

VARIED_PARAMETERS = ("size", "inset", "mu", "amplitude", "azimuth")
"""Parameters that vary between the samples of a pile."""

PILE_RUNS = 20
"""Default number of samples, each of which costs as much as the run itself."""

MAX_SAMPLED_WORK, SPRINGS_WORK = 9000.0, 6.0
"""Largest square of the number of stones times seconds of the record up to which a pile has samples by default: five stones for six minutes
take five seconds; and factor on it with springs."""

MAX_GRID = 29
"""Coarsest grid of the criterion study: one height is left."""


@click.command(
    cls=Command,
    essential=("--stones", "--reinforced", "--inset", "--mu", "--restitution", "--law", "--vertical", "--criterion", "--runs"),
    examples=(
        "seisblock stack --stones wagata.toml --reinforced",
        "seisblock stack record.csv --stones lantern.toml --plot stack.png --animate stack.gif",
        "seisblock stack --component NS --scale 0.5 --runs 20",
        "seisblock stack --criterion --grid 4 --contact edges --resume study.jsonl --plot criterion.png",
    ),
)
@criterion_record_options
@option(
    "--stones",
    metavar="NAME|FILE",
    shell_complete=shell_completion.complete_bodies("pile"),
    default=DEFAULT_PILE,
    show_default=True,
    section="Body",
    help="TOML file of the pile, or bundled pile: wagata, lantern, column.",
)
@option("--reinforced", is_flag=True, section="Body", help="Insert the dowels that the file defines.")
@option(
    "--without",
    multiple=True,
    metavar="STONE",
    shell_complete=shell_completion.complete_stones,
    section="Body",
    help="Stone to omit; may be repeated.",
)
@option(
    "--fix",
    multiple=True,
    metavar="STONE",
    shell_complete=shell_completion.complete_stones,
    section="Body",
    help="Stone fixed to the ground; may be repeated.",
)
@inset_option(
    "Inset of worn edges from each side of the base of every stone: share of the width (0.1, 10%), or m with a unit (1cm); "
    "--contact edges. [default: value of the file, or 0]"
)
@option("--mu", type=MU, help="Static friction coefficient of every joint. [default: value of the file; wagata 0.438]")
@solver_options(StackOptions, "mu_kinetic", "restitution")
@option(
    "--contact",
    type=ContactType(),
    metavar="edges|grid=N",
    help="Contact points of a joint: edges of the bases, or grid=N for N x N points (Furukawa2009: 5); a grid reduces the "
    "effective width of a stone. [default: edges; --criterion: grid=5]",
)
@solver_options(StackOptions, "law")
@option("--young", type=float, metavar="PA", help="Young's modulus of the stones, Pa. [default: contact of Furukawa2009 table 2]")
@option("--joint-stiffness", type=float, metavar="N/M3", help="Stiffness of a joint per area, N/m^3. [default: from --young]")
@option("--damping", type=float, help="Damping ratio of a stone on its joint, with --young or --joint-stiffness. [default: 1]")
@solver_options(StackOptions, "vertical", "across", "step")
@option(
    "--criterion",
    is_flag=True,
    help="Criterion study of Furukawa2009 section 3(3): sines, and each RECORD scaled; takes long.",
)
@option(
    "--grid",
    type=click.IntRange(1, MAX_GRID),
    default=1,
    show_default=True,
    help="--criterion: compute every N-th amplitude and height.",
)
@option(
    "--resume",
    type=OutputFile(),
    metavar="FILE",
    help="--criterion: file of finished sines, from which an interrupted study continues.",
)
@version_options(*VARIED_PARAMETERS, runs=PILE_RUNS)
@solver_options(StackOptions, "gravity")
@output_options()
def stack(
    source: Source,
    output: OutputOptions,
    stones: str,
    reinforced: bool,
    without: tuple[str, ...],
    fix: tuple[str, ...],
    inset: EdgeWear | None,
    mu: float | None,
    criterion: bool,
    grid: int,
    resume: Path | None,
    **params: Any,
) -> None:
    """Response of a pile of stones in three dimensions: displacement, separation and fall of each stone (Furukawa et al. 2009).

    Both horizontal components and the vertical one act together; +x of the pile is the component's positive direction, without
    --component that of the first component of the record. Slips are relative to the stone below, m. The response of a pile is chaotic:
    --runs 100 gives the probability of falling of each stone over samples of pile and motion; by default there are none where the square
    of the number of stones times seconds exceeds 9000, or 1500 with springs.
    """
    from seisblock.bodies.pile.contact import PileContact
    from seisblock.core.errors import ParameterError

    if params["young"] is not None and params["joint_stiffness"] is not None:
        raise ParameterError("--young and --joint-stiffness exclude each other: give only one of them")
    law, young, stiffness, damping = (params.pop(name) for name in ("law", "young", "joint_stiffness", "damping"))
    params["points"] = params.pop("contact") or (GRID if criterion else EDGES)
    springs = law == SPRINGS or (law is None and (criterion or young is not None or stiffness is not None))
    if not springs and not (young is None and stiffness is None):
        raise ParameterError("--young and --joint-stiffness have no effect with --law rigid: omit them, or give --law springs")
    if damping is not None and young is None and stiffness is None:
        raise ParameterError("--damping requires --young or --joint-stiffness")
    contact = PileContact(young=young, stiffness=stiffness, damping_ratio=1.0 if damping is None else damping) if springs else None
    body = _load_pile(stones, reinforced, mu, without, fix)
    body = body if inset is None else body.with_wear(inset)
    info(
        "pile: {name}, {count} stones, mu {mu:g}{dowels}",
        name=lazy_gettext(body.name),
        count=len(body.stones),
        mu=body.mu,
        dowels=lazy_gettext(", with dowels") if body.dowels else "",
    )
    widths = pop_spreads(params, *VARIED_PARAMETERS)
    if criterion:
        if given_flags(["runs"]) and params["runs"]:
            raise ParameterError("--runs has no effect with --criterion: omit it")
        if not (params["mu_kinetic"] is None and params["restitution"] is None):
            raise ParameterError("--mu-kinetic and --restitution have no effect with --criterion: omit them")
        if not (params["step"] is None and params["vertical"] is None and params["across"]):
            raise ParameterError(
                "--step, --vertical and --across have no effect with --criterion, which sets its time step and applies all "
                "components: omit them"
            )
        _run_study(source, output, body, contact, grid, resume, points=params["points"], gravity=params["gravity"], reinforced=reinforced)
        return
    if grid != 1 or resume is not None:
        raise ParameterError("--grid and --resume require --criterion")
    _run_records(source, output, body, contact, widths, params)


def _load_pile(stones: str, reinforced: bool, mu: float | None, removed: tuple[str, ...], fix: tuple[str, ...]) -> Pile:
    """Return the pile described by the options."""
    from dataclasses import replace

    from seisblock.bodies.pile.toml import load_pile
    from seisblock.core.errors import BodyError

    body = load_pile(stones, reinforced=reinforced, mu=mu)
    for name in removed:
        if name not in body.names:
            raise BodyError(
                "--without: the pile {pile} has no stone {name!r}; stones: {names}", name=name, pile=body.name, names=list(body.names)
            )
    body = body.without(*removed) if removed else body
    return replace(body, fixed=(*body.fixed, *fix)) if fix else body


def _run_records(source: Source, output: OutputOptions, body: Pile, contact: Any, widths: dict[str, float], params: dict[str, Any]) -> None:
    """Solve the pile under each record."""
    from dataclasses import replace

    from seisblock.cli.azimuth_sweep import write_assessed
    from seisblock.cli.progress import progress
    from seisblock.core.errors import ParameterError
    from seisblock.models.stack.solve import solve_stack
    from seisblock.readers._memory import trim_heap
    from seisblock.report.json.stack import document
    from seisblock.report.text.stack import tables
    from seisblock.studies.model_comparison import compare_pile_models
    from seisblock.studies.respond.pile_probability import summarize
    from seisblock.studies.sampling import ParameterVariation, sample
    from seisblock.studies.solvers.stack import assess_pile

    variation = ParameterVariation(**widths)
    inset_given = click.get_current_context().get_parameter_source("vary_inset") is not ParameterSource.DEFAULT
    if inset_given and variation.inset and params["points"] != EDGES:
        raise ParameterError("--vary-inset has no effect with --contact grid={points}: omit one of them", points=params["points"])
    runs, seed, moved = (params.pop(name) for name in ("runs", "seed", "moved"))
    options = StackOptions(contact=contact, **params)
    is_requested = bool(given_flags(["runs", "moved", "seed", *(f"vary_{name}" for name in VARIED_PARAMETERS)]))
    responses, extras = [], []
    for record in load_records(source):
        directions = list(selected_motions(record, source))
        # all components act in every run: without --component one direction suffices
        for motion in directions if source.component else directions[:1]:
            name = f"{record.station} {motion.name}".strip()
            with progress(name) as advance:
                responses.append(solve_stack(body, motion, **replace(options, progress=advance).keywords()))
            trim_heap()  # memory freed by the compiler is needed for long records
            extra: dict[str, Any] = {}
            count = runs if is_requested or _is_quick(body, motion, options) else 0
            if runs and not count:
                text = N_(
                    "no samples by default of {stones} stones over {seconds:.0f} s: give --runs {runs} for the probability of falling"
                )
                info(text, stones=len(body.stones), seconds=motion.samples * motion.dt, runs=runs)
            if count:
                with progress("samples {name}", name=name) as advance:
                    samples = sample("stack", body, motion, options, count, variation, seed=seed, progress=advance)
                extra["probability"] = summarize(samples, motion.azimuth_deg, moved)
                extra["assessment"] = assess_pile(responses[-1], samples, moved_m=moved)
                extra["agreement"] = extra["assessment"].comparison
            else:
                extra["agreement"] = compare_pile_models(responses[-1])
            extras.append(extra)
    write_assessed(document(responses, extras), output, responses, extras, lambda: tables(responses, extras, gal=output.gal))


def _is_quick(body: Pile, motion: Motion, options: StackOptions) -> bool:
    """Return whether the samples of a pile take seconds: those of one stone, or of few stones."""
    work = len(body.stones) ** 2 * motion.samples * motion.dt * (1.0 if options.contact is None else SPRINGS_WORK)
    return len(body.stones) == 1 or work <= MAX_SAMPLED_WORK


def _run_study(
    source: Source,
    output: OutputOptions,
    body: Pile,
    contact: Any,
    grid: int,
    resume: Path | None,
    *,
    points: int,
    gravity: float,
    reinforced: bool,
) -> None:
    from seisblock.cli.progress import progress
    from seisblock.report.json.stack import study_document
    from seisblock.report.text import stack_criterion as text_output
    from seisblock.studies.gravestone_criterion import PGAS, RATIOS, criterion_study, record_thresholds, rigid_levels

    common: dict[str, Any] = {
        "pgas": PGAS[::-1][::grid][::-1],
        "ratios": RATIOS[::grid],
        "law": RIGID if contact is None else SPRINGS,
        "points": points,
        "contact": contact,
        "gravity": gravity,
    }
    with progress("sines") as advance:
        study = criterion_study(body, **common, resume=resume, progress=advance)
    records = load_records(source) if source.record else []
    record_levels = {}
    for record in records:
        for motion in selected_motions(record, source):
            with progress(f"{record.station} {motion.name}".strip()) as advance:
                record_levels[f"{record.station} {motion.name}".strip()] = record_thresholds(body, motion, **common, progress=advance)
    rigid = rigid_levels(study, body, points=points, gravity=gravity)
    study_options: dict[str, Any] = {
        "pile": body,
        "law": common["law"],
        "contact": contact,
        "points": points,
        "gravity": gravity,
        "grid": grid,
    }
    write_results(
        study_document(study, rigid, record_levels, records, reinforced=reinforced, **study_options),
        output,
        tables=lambda: text_output.tables(study, rigid, record_levels, reinforced=reinforced, gal=output.gal),
        csv=lambda: text_output.csv_columns(study, record_levels),
        figure=figure_of("stack_criterion:figure", study, rigid, record_levels, reinforced=reinforced, gal=output.gal),
    )
