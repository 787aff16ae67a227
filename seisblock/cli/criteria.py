"""``seisblock criteria``: closed-form overturning criteria compared with the simulated outcome."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import click

from seisblock.cli.bodies.options import azimuth_option, block_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.option_checks import reject_without
from seisblock.cli.options import Source, output_options, peak_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.rock import require_vertical, with_azimuths
from seisblock.cli.types import MU
from seisblock.models.rock.options import RockOptions


@click.command(
    cls=Command,
    essential=("--width", "--height", "--inset", "--kind", "--block", "--mu", "--vertical", "--pga", "--pgv", "--frequency"),
    examples=(
        "seisblock criteria --width 24cm --height 72cm",
        "seisblock criteria record.csv --block gravestone --json",
        "seisblock criteria --pga 400 --pgv 40 --width 24cm --height 72cm",
    ),
)
@record_options
@peak_options
@block_options
@solver_options(RockOptions, "restitution", "linear", "vertical")
@azimuth_option
@option(
    "--mu",
    type=MU,
    section="Body",
    help="Static friction coefficient under the block for the simulated outcome. [default: value of the body, else no sliding]",
)
@option("--mu-kinetic", type=MU, section="Body", help="Kinetic friction coefficient. [default: value of the body, else as --mu]")
@solver_options(RockOptions, "gravity")
@output_options(histories=False, film=False)
def criteria(
    source: Source,
    output: OutputOptions,
    gravity: float,
    restitution: float | None,
    linear: bool,
    vertical: bool | None,
    azimuth: tuple[str, ...],
    mu: float | None,
    mu_kinetic: float | None,
    **body: Any,
) -> None:
    """All closed-form overturning criteria compared with the simulated outcome, for each component.

    A criterion predicts overturning when the demand (PGA or PGV of the record) exceeds its threshold. Criteria that need a frequency
    take the equivalent frequency of the record in each of its three definitions. The simulated outcome is that of respond: sliding,
    rocking and flight under all components. --pga with --pgv or --frequency gives the closed forms without a record.
    """
    from seisblock.bodies.factory import table_friction
    from seisblock.bodies.toml import read_body_toml
    from seisblock.cli.bodies.block import choose_block
    from seisblock.cli.load_records import load_records, selected_components
    from seisblock.cli.peaks import parse_peaks, write_peaks
    from seisblock.cli.write_results import figure_of, write_results
    from seisblock.records import motion_of
    from seisblock.records._validation import vertical_acts
    from seisblock.report.json.criteria import CRITERIA_PEAKS, document
    from seisblock.report.json.peaks import document as peak_document
    from seisblock.report.text import criteria as text_output
    from seisblock.studies.criteria_comparison import compare_criteria
    from seisblock.studies.scenario.peaks import assess_peaks

    peaks = parse_peaks(source, body, ["azimuth", "restitution", "linear", "vertical", "mu", "mu_kinetic"])
    choice = choose_block({**body, "restitution": restitution, "gal": output.gal})
    info("body: {says}", says=choice.description)
    if peaks is not None:
        options = RockOptions(gravity=gravity)
        result = assess_peaks(choice.block, *peaks, options=options)
        write_peaks(result, peak_document(result, CRITERIA_PEAKS, options), output)
        return
    source = with_azimuths(source, azimuth)
    if mu is None and body.get("block"):
        mu, kinetic_default = table_friction(read_body_toml(body["block"]), body["block"])
        mu_kinetic = kinetic_default if mu_kinetic is None else mu_kinetic
    if mu is None:
        reject_without("--mu", ["mu_kinetic"])
    options = RockOptions(restitution=choice.restitution, linear=linear, vertical=vertical, gravity=gravity)
    cards, motions = [], []
    for record in load_records(source):
        for name in selected_components(record, source):
            motion = motion_of(record, name)
            require_vertical(motion, vertical)
            motions.append(motion)
            block = choice.block_for_motion(motion)
            cards.append(compare_criteria(record, motion, block, mu=mu, mu_kinetic=mu_kinetic, options=options))
    write_results(
        document(cards, replace(options, vertical=vertical_acts(motions, vertical))),
        output,
        tables=lambda: text_output.tables(cards, gal=output.gal),
        csv=lambda: text_output.csv_columns(cards),
        figure=figure_of("criteria:figure", cards, gal=output.gal),
    )
