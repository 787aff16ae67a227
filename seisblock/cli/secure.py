"""``seisblock secure``: measures that make an object safe in a scenario."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli import shell_completion
from seisblock.cli.bodies.free_standing import free_standing_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info, warning
from seisblock.cli.option_checks import RECORD_OPTIONS, reject_with, reject_without
from seisblock.cli.options import Source, check_callback, output_options, scenario_record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.scenario import scenario_options
from seisblock.cli.scenario_records import load_hazard, load_scenario
from seisblock.cli.types import LENGTH, MU
from seisblock.core import checks
from seisblock.core.i18n import lazy_gettext
from seisblock.models.respond.options import RespondOptions

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from seisblock.bodies.table import BodySpec
    from seisblock.core.i18n import Message
    from seisblock.core.registry import SolverBody


@click.command(
    cls=Command,
    essential=(
        "--target",
        "--hazard",
        "--jma",
        "--pga",
        "--pgv",
        "--width",
        "--height",
        "--block",
        "--bodies",
        "--mu",
        "--restraint-height",
    ),
    examples=(
        "seisblock secure --jma 6+ --block bookcase --target 5%",
        "seisblock secure --pga 400 --pgv 40 --width 40cm --height 120cm --mass 80kg --mu 0.5 --target 5% --plot measures.png",
        "seisblock secure --hazard synthetic_hazard.csv --years 50 --block bookcase --target 2%",
    ),
)
@scenario_record_options
@scenario_options()
@option(
    "--hazard",
    type=click.Path(path_type=Path),
    metavar="FILE",
    shell_complete=shell_completion.complete_bundled("hazard"),
    section="Record",
    help="Instead of a scenario: hazard of the site in pga, pgv or sa(T), as for seisblock risk. Bundled: synthetic_hazard.csv.",
)
@option(
    "--years",
    type=float,
    default=50.0,
    show_default=True,
    callback=check_callback(checks.positive),
    section="Record",
    help="Period of the target probability with --hazard, years.",
)
@option("--target", type=MU, default=0.05, show_default=True, metavar="P", help="Largest overturning probability, 0 to 1.")
@option(
    "--restraint-height",
    type=LENGTH,
    help="Height of the restraint (strap, bracket) above the floor, m or with a unit. [default: that of the object]",
)
@option(
    "--bodies",
    metavar="FILE",
    section="Body",
    help="Table of objects, as for seisblock scenario, instead of sizes or --block; --object chooses one.",
)
@option("--object", "object_name", metavar="NAME", section="Body", help="Object of --bodies. [default: the only one]")
@free_standing_options
@solver_options(RespondOptions, "vertical")
@option("--seed", type=int, default=0, show_default=True, help="Seed of the synthetic records and of the samples of the object.")
@solver_options(RespondOptions, "settle_s", "gravity")
@output_options(histories=False, film=False, accelerations=False, excel=False)
def secure(
    source: Source,
    output: OutputOptions,
    hazard: Path | None,
    years: float,
    target: float,
    bodies: str | None,
    object_name: str | None,
    restraint_height: float | None,
    vertical: bool | None,
    seed: int,
    settle_s: float,
    gravity: float,
    **params: Any,
) -> None:
    """Measures that reduce the overturning probability of an object to a target: each one alone, verified by runs.

    Smallest width of the base, largest height, mass added at floor level, largest friction at which it slides, largest inset of feet, and
    the horizontal force of a restraint. The scenario is that of seisblock scenario: an intensity, or RECORD; with --hazard the target is
    the probability in --years. The object varies as in seisblock scenario; without any friction coefficient 0.2 to 0.7 is assumed.
    """
    from seisblock.bodies.table import read_body_list
    from seisblock.cli.bodies.body_spec import make_body_spec
    from seisblock.cli.progress import progress
    from seisblock.cli.write_results import figure_of, write_results
    from seisblock.core.errors import ParameterError
    from seisblock.report.json.secure import document
    from seisblock.report.text import secure as text_output
    from seisblock.studies.scenario.secure import find_measures, unresolved_target

    # before the records are generated
    checks.in_interval("the target probability", target, "(0, 1)")
    if restraint_height is not None:
        checks.positive("the height of the restraint", restraint_height, "m")
    intensity = {name: params.pop(name) for name in ("jma", "pga", "pgv", "frequency", "sa", "records")}
    common = {"vertical": vertical, "gravity": gravity, "settle_s": settle_s}
    if bodies is None:
        reject_without("--bodies", ["object_name"])
        body, is_drawn, body_notes = _choose_body([make_body_spec(params, "respond")], None, common)
    else:
        reject_with("--bodies", [name for name in params if name != "mu"])
        body, is_drawn, body_notes = _choose_body(read_body_list(bodies)[0], object_name, {**common, "mu": params["mu"]})
    for note in body_notes:
        info("{note}", note=note)
    frequencies = None
    if hazard is None:
        reject_without("--hazard", ["years"])
        motions = load_scenario(source, intensity, seed=seed)
    else:
        reject_with("--hazard", [*RECORD_OPTIONS, *intensity])
        if source.record:
            raise ParameterError("RECORD and --hazard exclude each other: give only one of them")
        motions, frequencies = load_hazard(hazard, years=years, target=target, seed=seed)
    for note in motions.notes:
        info("{note}", note=note)
    with progress("measures") as advance:
        result = find_measures(
            body,
            motions.records,
            target,
            frequencies=frequencies,
            restraint_height_m=restraint_height,
            is_scaled=motions.target is not None or frequencies is not None,
            has_mass=getattr(body.body, "mass", None) is not None,
            seed=seed,
            progress=advance,
        )
    notes = (*body_notes, *motions.notes)
    if (limit := unresolved_target(result)) is not None:
        text = "target too small for {runs} runs: even without an overturning the probability may be {limit:.1%} (95 % confidence)"
        notes = (*notes, lazy_gettext(text, runs=result.runs, limit=limit))
        warning("{note}", note=notes[-1])

    write_results(
        document(
            result,
            motions,
            body.options,
            mu=None if is_drawn else body.options.mu,
            seed=seed,
            hazard=None if hazard is None else hazard.name,
            notes=notes,
        ),
        output,
        tables=lambda: text_output.tables(result, motions.label),
        csv=lambda: text_output.csv_columns(result),
        bom=True,
        figure=figure_of("secure:figure", result, motions.label),
    )


def _choose_body(specs: Sequence[BodySpec], name: str | None, options: Mapping[str, Any]) -> tuple[SolverBody, bool, tuple[Message, ...]]:
    """Return an object of a table, by name where there are several, whether its friction is assumed, and notes on what was assumed."""
    from dataclasses import replace

    from seisblock.bodies.table import resolve_kinds
    from seisblock.core.errors import BodyError
    from seisblock.core.registry import SolverBody
    from seisblock.studies.scenario.assess import is_friction_unknown, scenario_bodies

    bodies, _ = scenario_bodies(specs, options)
    index = next((i for i, body in enumerate(bodies) if body.name == name or (name is None and len(bodies) == 1)), None)
    if index is None:
        names = [body.name for body in bodies]
        if name is None:
            raise BodyError("several objects: give --object with one of their names, {names}", names=names)
        raise BodyError("no object {name!r} in the table; names: {names}", name=name[:100], names=names)
    body = bodies[index]
    if not isinstance(body, SolverBody):
        raise BodyError("{name}: {why}", name=body.name, why=body.reason)
    # alone, for notes on this object only
    spec = replace(specs[index], name=body.name)
    (solver_body,), notes = scenario_bodies([spec], options)
    assert isinstance(solver_body, SolverBody)
    is_drawn = options.get("mu") is None and is_friction_unknown(resolve_kinds([spec])[0][0])
    return solver_body, is_drawn, notes
