"""``seisblock uplift``: uplift of a block on corner springs under a record or harmonic motion."""

from __future__ import annotations

from typing import Any

import click

from seisblock.cli.bodies.options import block_option
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.load_records import iter_motions
from seisblock.cli.option_checks import RECORD_OPTIONS, reject_with
from seisblock.cli.options import Source, harmonic_record_options, output_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import ANGLES, FLOATS, LENGTH, MASS
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core.errors import ParameterError
from seisblock.models.uplift.options import UpliftOptions

SHAKING = ("alpha", "gamma", "phi", "rho")
RATIOS = (*SHAKING, "beta", "damping")
DIMENSIONS = ("width", "depth", "height", "stiffness")
SIZES = (*DIMENSIONS, "mass", "frequency_vertical")
"""Groups of option names."""

DEFAULT_BODY = "machine"
"""Body without sizes."""


def _parse_ratios(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[tuple[float, ...], bool] | None:
    """Return the frequency ratios and whether they were given as a range."""
    return None if value is None else (FLOATS.convert(value, param, ctx), ":" in value)


@click.command(
    cls=Command,
    essential=(
        "--body",
        "--width",
        "--depth",
        "--height",
        "--frequency-vertical",
        "--damping",
        "--harmonic",
        "--alpha",
        "--figure",
        "--vertical",
    ),
    examples=(
        "seisblock uplift record.csv",
        "seisblock uplift --width 1.2 --height 3 --frequency-vertical 8 --plot uplift.png",
        "seisblock uplift --harmonic --alpha 1 --damping 0.02,0.05,0.1 --plot regions.png",
        "seisblock uplift --figure 11 --corner 4 --plot fig11.png",
    ),
)
@harmonic_record_options
@block_option(
    "Bundled body on springs or TOML file; sizes and other options replace its values. [default: machine, without sizes]",
    "springs",
    name="body",
)
@option("--width", type=LENGTH, section="Body", help="Side a of the base along the motion, m or with a unit.")
@option("--depth", type=LENGTH, section="Body", help="Side b of the base across the motion, m or with a unit. [default: --width]")
@option("--height", type=LENGTH, section="Body", help="Height H, m or with a unit; centre of gravity at half of it.")
@option("--mass", type=MASS, section="Body", help="Mass, kg or with a unit. [default: 1000 kg, which only scales forces]")
@option("--stiffness", type=FLOATS, metavar="KX,KY,KZ", section="Body", help="Stiffness of the springs at each corner, N/m; needs --mass.")
@option(
    "--frequency-vertical",
    type=float,
    metavar="HZ",
    section="Body",
    help="Vertical frequency omega_V / 2 pi on the springs, Hz; instead of --stiffness. [default: 1 with --harmonic, else required]",
)
@option("--beta", type=FLOATS, section="Body", help="Ratio of horizontal to vertical frequency. [default: 0.707, as in the paper]")
@option(
    "--damping",
    type=FLOATS,
    section="Body",
    help="Damping ratio: zeta of each corner dashpot, with --harmonic h of each mode. [default: 0.05]",
)
@option("--alpha", type=FLOATS, section="Body", help="With --harmonic: ratio H/b of height to depth, instead of sizes. [default: 1]")
@option("--gamma", type=FLOATS, section="Body", help="With --harmonic: ratio a/b of width to depth. [default: 1]")
@option("--harmonic", is_flag=True, help="Steady state under harmonic motion, without a record; lists of parameters are combined.")
@option("--phi", type=ANGLES, help="With --harmonic: azimuth of the motion from x to y, degrees. [default: 0]")
@option("--rho", type=FLOATS, help="With --harmonic: angle of the motion from the vertical, degrees. [default: 90]")
@option(
    "--frequency-ratio",
    callback=_parse_ratios,
    metavar="LIST|A:B:STEP",
    help="With --harmonic: ratios theta/omega_1 to evaluate; a range also bounds the search for minima. [default: 0.01:6:0.01]",
)
@option("--corner", type=click.IntRange(1, 4), help="With --harmonic: corner to evaluate; the paper has 4. [default: first to lift]")
@option(
    "--figure",
    type=SuggestingChoice(["3", "4", "6", "7", "8", "9", "10", "11"]),
    help="Parameters of this figure of the paper; implies --harmonic; other options override them.",
)
@solver_options(UpliftOptions, "gravity")
@output_options()
def uplift(
    source: Source, output: OutputOptions, gravity: float, harmonic: bool, figure: str | None, body: str | None, **params: Any
) -> None:
    """Uplift of a rigid block on springs at its four corners (Okumura et al. 1987).

    With a record: three-component motion, corner springs without tension; time of first uplift, corner, height and duration. Corners
    are 1 (+x, +y), 2 (+x, -y), 3 (-x, +y), 4 (-x, -y), with +x the component's positive direction. With --harmonic: natural modes and
    the smallest A/g that lifts a corner, against frequency.
    """
    if harmonic or figure:
        reject_with("--harmonic" if figure is None else "--figure", ["body"])
        _run_harmonic(source, output, int(figure) if figure else None, params)
        return
    from seisblock.bodies.spring_factory import load_springs, spring_block
    from seisblock.models.uplift.describe import tables
    from seisblock.models.uplift.solve import solve_uplift
    from seisblock.output.json.solver import document

    harmonic_flags = [_option_flag(name) for name in (*SHAKING, "frequency_ratio", "corner") if params.pop(name) is not None]
    if harmonic_flags:
        raise ParameterError("{only} requires --harmonic: add --harmonic, or omit {only}", only=harmonic_flags)
    values = {name: _single_value(name, value) for name, value in params.items()}
    if body is None and all(params[name] is None for name in ("width", "height", "stiffness")):
        body = DEFAULT_BODY
        info("no body given: using the bundled {name}", name=body)
    springs = spring_block(**values) if body is None else load_springs(body, **values)
    responses = [solve_uplift(springs, motion, gravity=gravity) for motion in iter_motions(source)]
    write_results(
        document(responses),
        output,
        responses=responses,
        tables=lambda: tables(responses, gal=output.gal),
    )


def _run_harmonic(source: Source, output: OutputOptions, figure: int | None, params: dict[str, Any]) -> None:
    """Run ``--harmonic``."""
    from seisblock.cli.progress import progress
    from seisblock.report.json.uplift import harmonic_document
    from seisblock.report.text import uplift_harmonic as text_output
    from seisblock.studies.uplift_regions import DEFAULT_RATIOS, harmonic_blocks, uplift_regions

    if source.record:
        raise ParameterError("RECORD {record} has no effect with --harmonic: omit one of them", record=source.record[0])
    reject_with("--harmonic" if figure is None else "--figure", [*RECORD_OPTIONS, "gravity"])
    ratios, is_range = params["frequency_ratio"] or (DEFAULT_RATIOS, False)
    search_range = (min(ratios), max(ratios)) if is_range else None
    if params["frequency_vertical"] is None and params["stiffness"] is None:
        params["frequency_vertical"] = 1.0
        info("no --frequency-vertical given: natural frequencies are for omega_V / 2 pi = 1 Hz; ratios do not depend on it")
    sizes = {name: params[name] for name in SIZES} if any(params[name] is not None for name in DIMENSIONS) else None
    blocks = harmonic_blocks(
        {name: params[name] for name in RATIOS},
        sizes=sizes,
        figure=figure,
        frequency_vertical=params["frequency_vertical"] or 1.0,
        **({} if params["mass"] is None else {"mass": params["mass"]}),
    )
    with progress("uplift regions") as advance:
        regions = uplift_regions(blocks, ratios, corner=params["corner"], between=search_range, progress=advance)
    write_results(
        harmonic_document(regions),
        output,
        tables=lambda: text_output.tables(regions, all_rows=params["frequency_ratio"] is not None),
        csv=lambda: text_output.csv_columns(regions),
        figure=figure_of("uplift_harmonic:harmonic_figure", regions, figure),
    )


def _single_value(name: str, value: Any) -> Any:
    """Return the single number of an option that accepts lists only with ``--harmonic``."""
    if name not in RATIOS or value is None:
        return value
    if len(value) != 1:
        raise ParameterError(
            "{name} accepts one number with a record, found {count}: lists require --harmonic", name=_option_flag(name), count=len(value)
        )
    return value[0]


def _option_flag(name: str) -> str:
    return "--" + name.replace("_", "-")
