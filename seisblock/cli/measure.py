"""``seisblock measure``: intensity measures of a record."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from seisblock.cli.bodies.options import block_option, side_option
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.option_checks import reject_without
from seisblock.cli.options import Source, output_options, real_record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import LENGTH
from seisblock.core.errors import InputError
from seisblock.core.i18n import gettext, lazy_gettext
from seisblock.core.units import parse_acceleration

if TYPE_CHECKING:
    from seisblock.measures.duration import Side


THRESHOLD_SIDES: dict[str, Side] = {"+": "positive", "-": "negative", "both": "both"}
"""Side of the threshold for each value of ``--direction``."""


def _parse_acceleration(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    """Parse an acceleration with its unit."""
    if value is None:
        return None
    try:
        return parse_acceleration(value, quantity=lazy_gettext("the threshold"))
    except InputError as error:
        raise click.BadParameter(gettext(error.message), ctx, param) from error


def _check_corner(ctx: click.Context, param: click.Parameter, value: float) -> float | None:
    """Return the corner frequency, None for 0; raise an error for negative values."""
    if not 0.0 <= value < float("inf"):
        raise click.BadParameter(gettext("must be 0 (none) or a positive frequency in Hz, found {value}", value=value), ctx, param)
    return value or None


@click.command(
    cls=Command,
    essential=("--highpass", "--window", "--units"),
    examples=("seisblock measure", "seisblock measure record.csv --width 24cm --height 72cm --plot record.png"),
)
@real_record_options
@option(
    "--threshold",
    callback=_parse_acceleration,
    metavar="A",
    help="Threshold of the durations, with unit: 245gal, 2.45m/s2 or 0.25g. [default: 0.1g]",
)
@option("--width", type=LENGTH, section="Body", help="Width B of a block, m or with a unit (24cm, 8sun); threshold g B/H.")
@option("--height", type=LENGTH, section="Body", help="Height H of the block, m or with a unit.")
@block_option("Bundled two-layer block, or TOML file; its rocking threshold is used.", "two-layer")
@side_option("Side of --block in plan along the motion.")
@option(
    "--direction",
    type=SuggestingChoice(THRESHOLD_SIDES),
    default="both",
    show_default=True,
    help="Sign of the acceleration that counts for the durations.",
)
@option(
    "--velocity-highpass",
    type=float,
    default=0.05,
    show_default=True,
    callback=_check_corner,
    metavar="HZ",
    help="Corner of the zero-phase high-pass for PGV and PGD, Hz; 0 for none.",
)
@gravity_option
@output_options(film=False)
def measure(
    source: Source,
    output: OutputOptions,
    gravity: float,
    direction: str,
    velocity_highpass: float | None,
    **threshold: Any,
) -> None:
    """Intensity measures of a record: peak values, spectral intensities, equivalent frequencies, durations, JMA intensity.

    A duration is the time during which the acceleration exceeds a threshold: a given value, or the rocking threshold of a block. JMA
    intensity requires all three components. Times count from the first sample of the record.
    """
    from seisblock.cli.load_records import load_records, selected_components
    from seisblock.cli.write_results import write_results
    from seisblock.measures import Conventions
    from seisblock.measures import measure as compute_measures
    from seisblock.measures.summary import conventions_of
    from seisblock.output.units_display import acceleration_unit
    from seisblock.report.json.measure import document
    from seisblock.report.text import measure as text_output

    if threshold["block"] is None:
        reject_without("--block", ["side"])
    rules = Conventions(velocity_highpass_hz=velocity_highpass, threshold_side=THRESHOLD_SIDES[direction], gravity_m_s2=gravity)
    level, origin = _threshold(gravity=gravity, **threshold)
    records = load_records(source, vertical_counts=True, use_recording=True)
    answers = []
    with progress("records") as advance:
        for record in records:
            components = selected_components(record, source, vertical_counts=True)
            answers.append(compute_measures(record, components, threshold=level, conventions=rules))
            advance(len(answers), len(records))
    rules = conventions_of(records[0], rules)
    answer = document(records, answers, rules, threshold=level, threshold_from=origin)

    def figure() -> Any:
        from seisblock.report.figures.measure import measure_figure

        if len(records) > 1:
            raise InputError("--plot requires one record, found {count}: run the command for each record", count=len(records))
        return measure_figure(records[0], answers[0], gal=output.gal)

    size, unit = acceleration_unit(gal=output.gal)
    info("threshold of the durations: {level:.4g} {unit} ({origin})", level=level / size, unit=unit, origin=origin)
    write_results(
        answer,
        output,
        tables=lambda: text_output.tables(records, answers, gal=output.gal),
        csv=lambda: text_output.history_table(records, answers),
        figure=figure,
    )


def _threshold(
    *, threshold: float | None, width: float | None, height: float | None, block: str | None, side: str, gravity: float
) -> tuple[float, str]:
    """Return the threshold, m/s^2, and its origin."""
    sizes = width is not None or height is not None
    if (threshold is not None) + sizes + (block is not None) > 1:
        raise click.UsageError(gettext("--threshold, --width with --height, and --block exclude each other: give only one of them"))
    if block is not None:
        from seisblock.bodies.toml import read_body_toml
        from seisblock.bodies.two_layer import two_layer_from_table

        body = two_layer_from_table(read_body_toml(block), side)
        return body.rocking_threshold(gravity), lazy_gettext("rocking threshold of {name}", name=lazy_gettext(body.name))
    if sizes:
        from seisblock.measures import block_threshold

        if width is None or height is None:
            raise click.UsageError(gettext("the rocking threshold g B/H requires both --width and --height"))
        return block_threshold(width, height, gravity=gravity), lazy_gettext(
            "g B/H of a block {width:g} m wide and {height:g} m high", width=width, height=height
        )
    if threshold is not None:
        return threshold, lazy_gettext("given")
    from seisblock.measures.summary import DEFAULT_THRESHOLD

    return DEFAULT_THRESHOLD, lazy_gettext("default, 0.1 g")
