"""``seisblock slide``: sliding displacement on a level or sloping base."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli.azimuth_sweep import is_azimuth_sweep
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.load_records import load_records, selected_motions
from seisblock.cli.option_checks import reject_with
from seisblock.cli.options import Source, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.types import ANGLES, FLOATS, LENGTH, MUS
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core.i18n import gettext, lazy_gettext
from seisblock.models.slide.options import SlideOptions

if TYPE_CHECKING:
    from seisblock.records import Motion, Record

AZIMUTH_STEP = 5


def _require_mu(ctx: click.Context, param: click.Parameter, value: Any) -> Any:
    """Raise an error with an explanation of ``--mu`` where it is missing."""
    if value is None and not ctx.resilient_parsing:
        raise click.UsageError(
            gettext(
                "friction required: give --mu (static coefficient), for example --mu 0.2; a list 0.1,0.2 or a range 0.05:0.20:0.005 "
                "runs a parameter study"
            ),
            ctx,
        )
    return value


@click.command(
    cls=Command,
    essential=("--mu", "--kappa", "--slope", "--one-way", "--vertical", "--target-pga"),
    examples=(
        "seisblock slide --mu 0.2",
        "seisblock slide record.csv --mu 0.3 --kappa 0.5 --csv slide.csv --plot slide.png",
        "seisblock slide --mu 0.05:0.20:0.005 --kappa 0.333,0.5,0.75,1 --plot study.png",
    ),
)
@record_options
@option(
    "--mu",
    type=MUS,
    callback=_require_mu,
    metavar="MU",
    section="Body",
    help="Static friction coefficient; a list or a range first:last:step runs a parameter study, as do --mu-kinetic, --kappa, --slope "
    "and --vertical-scale.  [required]",
)
@option("--mu-kinetic", type=MUS, metavar="MU", section="Body", help="Kinetic friction coefficient. [default: as --mu]")
@option("--kappa", type=FLOATS, metavar="RATIO", section="Body", help="Ratio of kinetic to static friction, instead of --mu-kinetic.")
@option(
    "--slope",
    type=ANGLES,
    default="0",
    metavar="DEG",
    section="Body",
    help="Slope of the base, degrees; the component's positive direction is downhill. [default: 0]",
)
@option(
    "--slope-length",
    type=LENGTH,
    metavar="M",
    section="Body",
    help="Distance to the foot of the slope, m or with a unit; level ground beyond. [default: infinite slope]",
)
@option(
    "--one-way", is_flag=True, section="Body", help="Slide only downhill (on level ground: in the positive direction), as Newmark assumed."
)
@solver_options(SlideOptions, "vertical")
@option(
    "--vertical-scale",
    type=FLOATS,
    metavar="GAMMA",
    help="Scale factor on the vertical component; implies --vertical. A parameter study with either option adds beta, the ratio of "
    "the maximum displacements with and without vertical motion. [default: 1]",
)
@solver_options(SlideOptions, "gravity")
@output_options()
def slide(
    source: Source,
    output: OutputOptions,
    mu: tuple[float, ...],
    mu_kinetic: tuple[float, ...] | None,
    kappa: tuple[float, ...] | None,
    slope: tuple[float, ...],
    slope_length: float | None,
    one_way: bool,
    vertical: bool | None,
    vertical_scale: tuple[float, ...] | None,
    gravity: float,
) -> None:
    """Sliding displacement of an object on a level or sloping base (Fujino et al. 1978).

    Displacements are relative to the base, along it, positive in the component's positive direction. Each horizontal component is
    solved separately; --component all-azimuths sweeps the azimuths in steps of 5 degrees and reports the worst.
    """
    if vertical is False:
        reject_with("--no-vertical", ["vertical_scale"])
    scales = vertical_scale or (None if vertical is None else (float(vertical),))
    parameters = {
        "mu": mu,
        "mu_kinetic": mu_kinetic,
        "kappa": kappa,
        "vertical": scales,
        "slope_deg": slope,
    }
    fixed = {"slope_length": slope_length, "one_way": one_way, "gravity": gravity}
    sweeps = is_azimuth_sweep(source)
    is_study = any(values is not None and len(values) > 1 for values in parameters.values())
    records = load_records(replace(source, component=()) if sweeps else source)
    # sliding that depends on the direction requires the full circle
    end = 360 if one_way or any(slope) else 180
    directions = [str(azimuth) for azimuth in range(0, end, AZIMUTH_STEP)] if sweeps else None
    if is_study:
        _run_study(records, source, output, directions, parameters, fixed)
    else:
        single = {name: values[0] for name, values in parameters.items() if values is not None}
        _run_single(records, source, output, directions, single, fixed)


def _run_single(
    records: list[Record],
    source: Source,
    output: OutputOptions,
    directions: list[str] | None,
    single: dict[str, float],
    fixed: dict[str, Any],
) -> None:
    """Solve one set of parameters for each direction or for the worst azimuth."""
    from seisblock.bodies.sliding_base import sliding_base
    from seisblock.cli.hints import slide_hint
    from seisblock.models.slide.describe import tables
    from seisblock.models.slide.solve import solve_slide
    from seisblock.records import motion_of
    from seisblock.report.json.slide import document
    from seisblock.report.text.slide_study import azimuth_table
    from seisblock.studies.sliding import slide_study, worst_directions

    base_options = {name: value for name, value in single.items() if name != "vertical"}
    base = sliding_base(**base_options, slope_length=fixed["slope_length"], one_way=fixed["one_way"])
    vertical = single.get("vertical")
    responses, sweep = [], []
    for record in records:
        if directions is None:
            selected = list(_motions(record, source, None))
        else:
            points = slide_study(motions=_motions(record, source, directions), **single, **fixed)  # type: ignore[arg-type]
            sweep += points
            worst_azimuth = worst_directions(points)[0].component
            info("largest slip of {count} azimuths: azimuth {azimuth}°", count=len(directions), azimuth=worst_azimuth)
            selected = [motion_of(record, worst_azimuth)]
        responses += [solve_slide(base, motion, vertical=vertical, gravity=fixed["gravity"]) for motion in selected]
    write_results(
        document(responses, sweep),
        output,
        responses=responses,
        tables=lambda: chain(
            tables(responses, gal=output.gal),
            azimuth_table(sweep, gal=output.gal),
            slide_hint(source, base.mu, single.get("mu_kinetic"), slips=not base.slope_deg and any(r.outcome.slips for r in responses)),
        ),
    )


def _run_study(
    records: list[Record],
    source: Source,
    output: OutputOptions,
    directions: list[str] | None,
    choice: dict[str, Any],
    fixed: dict[str, Any],
) -> None:
    """Solve all combinations of parameters."""
    from seisblock.report.json.slide import study_document
    from seisblock.report.text import slide_study as text_output
    from seisblock.studies.sliding import slide_study, worst_directions

    points = []
    for record in records:
        with progress("sliding") as advance:
            record_points = slide_study(motions=_motions(record, source, directions), **choice, **fixed, progress=advance)
        points.append(record_points if directions is None else worst_directions(record_points))
    pairs = [(record, point) for record, record_points in zip(records, points, strict=True) for point in record_points]
    omitted_count = sum(not point.holds_at_rest for record_points in points for point in record_points)
    warnings = (
        [
            lazy_gettext(
                "{count} combinations omitted: friction does not hold the object at rest, or kinetic exceeds static friction",
                count=omitted_count,
            )
        ]
        if omitted_count
        else []
    )
    parameters = {
        **{name: values for name, values in choice.items() if name != "vertical"},
        "vertical_scale": tuple(dict.fromkeys(point.vertical for _, point in pairs)),
        "slope_length_m": fixed["slope_length"],
        "one_way": fixed["one_way"],
        "gravity_m_s2": fixed["gravity"],
    }
    write_results(
        study_document(parameters, pairs, warnings),
        output,
        tables=lambda: text_output.tables(records, points, gal=output.gal),
        csv=lambda: text_output.study_csv(records, points),
        figure=figure_of(
            "slide_study:figure", records, points, slope_length=fixed["slope_length"], gravity=fixed["gravity"], gal=output.gal
        ),
    )


def _motions(record: Record, source: Source, directions: list[str] | None) -> Iterator[Motion]:
    """Yield the motions of the azimuths or of the selected components."""
    from seisblock.records import motion_of

    if directions is None:
        yield from selected_motions(record, source)
    else:
        for name in directions:
            yield motion_of(record, name)
