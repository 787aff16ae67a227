"""``seisblock uplift``: does a block on corner springs lift off, under a record or under harmonic shaking."""

from __future__ import annotations

from typing import Any

import click

from seisblock.cli.command import Command, option
from seisblock.cli.emit import emit
from seisblock.cli.idle import RECORD_OPTIONS, refuse_beside
from seisblock.cli.inputs import load, motions
from seisblock.cli.meant import OneOf
from seisblock.cli.options import Source, gravity_option, output_options, record_options
from seisblock.cli.output import Output
from seisblock.cli.talk import say
from seisblock.cli.types import FLOATS, LENGTH, MASS
from seisblock.errors import ParameterError

SHAKING = ("alpha", "gamma", "phi", "rho")
RATIOS = (*SHAKING, "beta", "damping")
MEASURED = ("width", "depth", "height", "stiffness")
SIZES = (*MEASURED, "mass", "frequency_vertical")
"""Names of the options that go together."""


def _ratios(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[tuple[float, ...], bool] | None:
    """Return the frequency ratios, and whether they were given as a range."""
    return None if value is None else (FLOATS.convert(value, param, ctx), ":" in value)


@click.command(
    cls=Command,
    examples=(
        "seisblock uplift --width 1.2 --height 3 --frequency-vertical 8 --plot uplift.png",
        "seisblock uplift --harmonic --alpha 1 --damping 0.02,0.05,0.1 --plot regions.png",
        "seisblock uplift --figure 11 --corner 4 --plot fig11.png",
    ),
)
@record_options
@option("--width", type=LENGTH, section="Body", help="Side a of the base along the motion, m or with a unit.")
@option("--depth", type=LENGTH, section="Body", help="Side b of the base across it, m or with a unit. [default: --width]")
@option("--height", type=LENGTH, section="Body", help="Height H, m or with a unit; the centre of gravity is at half of it.")
@option("--mass", type=MASS, section="Body", help="Mass, kg or with a unit. [default: 1000 kg, which only scales forces]")
@option("--stiffness", type=FLOATS, metavar="KX,KY,KZ", section="Body", help="Stiffness of the springs at each corner, N/m; needs --mass.")
@option(
    "--frequency-vertical",
    type=float,
    metavar="HZ",
    section="Body",
    help="omega_V / 2 pi on the springs, Hz; instead of --stiffness. [default: 1 with --harmonic, else required]",
)
@option("--beta", type=FLOATS, section="Body", help="Horizontal over vertical frequency, 1. [default: 0.707, the paper's]")
@option(
    "--damping",
    type=FLOATS,
    section="Body",
    help="Damping ratio: zeta of each corner dashpot, with --harmonic h of each mode. [default: 0.05]",
)
@option("--alpha", type=FLOATS, section="Body", help="With --harmonic: height over depth H/b, 1, instead of sizes. [default: 1]")
@option("--gamma", type=FLOATS, section="Body", help="With --harmonic: width over depth a/b, 1. [default: 1]")
@option("--harmonic", is_flag=True, help="Steady state under harmonic shaking: no record; lists of parameters are combined.")
@option("--phi", type=FLOATS, help="With --harmonic: azimuth of the shaking from x to y, degrees. [default: 0]")
@option("--rho", type=FLOATS, help="With --harmonic: angle of the shaking from the vertical, degrees. [default: 90]")
@option(
    "--frequency-ratio",
    callback=_ratios,
    metavar="LIST|A:B:STEP",
    help="With --harmonic: evaluate exactly at these theta/omega_1; a range also bounds the search for minima. [default: 0.01:6:0.01]",
)
@option("--corner", type=click.IntRange(1, 4), help="With --harmonic: this corner alone; the paper's is 4. [default: the first to lift]")
@option(
    "--figure",
    type=OneOf(["3", "4", "6", "7", "8", "9", "10", "11"]),
    help="The parameters of this figure of the paper; implies --harmonic, other options prevail.",
)
@gravity_option
@output_options()
def uplift(source: Source, output: Output, gravity: float, harmonic: bool, figure: str | None, **given: Any) -> None:
    """Uplift of a rigid block on springs at its four corners (Okumura et al. 1987).

    With a record: three-component motion, corners that hold only while compressed; first uplift, which corner, how high and how
    long. Corners are 1 (+x, +y), 2 (+x, -y), 3 (-x, +y), 4 (-x, -y), with +x the component's positive direction. With --harmonic:
    natural modes and the least A/g that lifts a corner, against the frequency.
    """
    if harmonic or figure:
        _harmonic(source, output, int(figure) if figure else None, given)
        return
    from seisblock.bodies.spring_choice import spring_block
    from seisblock.present.documents.uplift import document
    from seisblock.present.text import uplift as shown
    from seisblock.solvers.uplift.solve import solve_uplift

    only = [_flag(name) for name in (*SHAKING, "frequency_ratio", "corner") if given.pop(name) is not None]
    if only:
        raise ParameterError("{only} speak of harmonic shaking: add --harmonic, or leave them out", only=only)
    body = spring_block(**{name: _single(name, value) for name, value in given.items()})
    responses = [solve_uplift(body, motion, gravity=gravity) for record in load(source) for motion in motions(record, source)]
    emit(
        document(responses, body),
        output,
        responses=responses,
        tables=lambda: shown.tables(responses, gal=output.gal),
    )


def _harmonic(source: Source, output: Output, figure: int | None, given: dict[str, Any]) -> None:
    """Answer for harmonic shaking."""
    from seisblock.cli.progress import progress
    from seisblock.present.documents.uplift import harmonic_document
    from seisblock.present.text import uplift_harmonic as shown
    from seisblock.studies.uplift_regions import DEFAULT_RATIOS, harmonic_blocks, uplift_regions

    if source.record:
        raise ParameterError(
            "--harmonic shakes with a sine: leave the record {record} out, or leave --harmonic out", record=source.record[0]
        )
    refuse_beside("--harmonic" if figure is None else "--figure", [*RECORD_OPTIONS, "gravity"])
    ratios, is_range = given["frequency_ratio"] or (DEFAULT_RATIOS, False)
    between = (min(ratios), max(ratios)) if is_range else None
    if given["frequency_vertical"] is None and given["stiffness"] is None:
        given["frequency_vertical"] = 1.0
        say("no --frequency-vertical given: natural frequencies are those for omega_V / 2 pi = 1 Hz; ratios need none")
    sizes = {name: given[name] for name in SIZES} if any(given[name] is not None for name in MEASURED) else None
    blocks = harmonic_blocks(
        {name: given[name] for name in RATIOS},
        sizes=sizes,
        figure=figure,
        frequency_vertical=given["frequency_vertical"] or 1.0,
        **({} if given["mass"] is None else {"mass": given["mass"]}),
    )
    with progress("uplift regions") as advance:
        regions = uplift_regions(blocks, ratios, corner=given["corner"], between=between, progress=advance)
    emit(
        harmonic_document(regions),
        output,
        tables=lambda: shown.tables(regions, every=given["frequency_ratio"] is not None),
        csv=lambda path: shown.write(path, regions),
        figure=lambda: _draw(regions, figure),
    )


def _draw(regions: Any, figure: int | None) -> Any:
    """Return the figure of harmonic regions; matplotlib is loaded only for it."""
    from seisblock.present.figures.uplift_harmonic import harmonic_figure

    return harmonic_figure(regions, figure)


def _single(name: str, value: Any) -> Any:
    """Return the one number of an option that takes a list only with --harmonic."""
    if name not in RATIOS or value is None:
        return value
    if len(value) != 1:
        raise ParameterError(
            "{name} takes one number with a record, found {count}: lists go with --harmonic", name=_flag(name), count=len(value)
        )
    return value[0]


def _flag(name: str) -> str:
    """Return how an option is written."""
    return "--" + name.replace("_", "-")
