"""``seisblock scenario``: objects that fall or move in a scenario earthquake, worst first."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from seisblock.cli.bodies.options import bodies_option
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, Decorator, add_options, option
from seisblock.cli.console import info
from seisblock.cli.options import Source, output_options, peak_option, scenario_record_options
from seisblock.cli.output import STDOUT, OutputOptions
from seisblock.cli.scenario_records import load_scenario
from seisblock.cli.types import JMA, MU, Count, OutputFile
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_VALUES


def scenario_options() -> Decorator:
    """Return the options of the intensity of a scenario."""
    return add_options(
        option(
            "--jma", type=JMA, metavar="5-|5+|6-|6+|7|NUMBER", section="Record", help="JMA intensity; 6+ is 6.25, the middle of 6 upper."
        ),
        peak_option("--pga", "GAL", "PGA of the larger horizontal component, gal."),
        peak_option("--pgv", "KINE", "PGV of the larger horizontal component, kine; alone or with --pga."),
        peak_option("--frequency", "HZ", "Equivalent frequency PGA/(2 pi PGV), Hz, with --pga instead of --pgv."),
        option(
            "--sa", metavar="T=GAL", section="Record", help="Spectral acceleration (5 %) of the larger horizontal at period T, s: 0.5=600."
        ),
        option(
            "--records",
            type=Count(N_("records"), MAX_VALUES, minimum=10),
            metavar="N",
            section="Record",
            help="Number of records, synthetic and bundled, scaled to the intensity. [default: 40; without RECORD]",
        ),
    )


@click.command(
    cls=Command,
    essential=("--jma", "--pga", "--pgv", "--sa", "--bodies", "--mu", "--floor", "--html", "--xlsx"),
    examples=(
        "seisblock scenario --jma 6+ --bodies bookcase --bodies refrigerator --bodies statue",
        "seisblock scenario --pga 400 --pgv 40 --bodies display_case --bodies statue --html objects.html",
        "seisblock scenario synthetic_jma.csv --bodies bookcase --floor T=0.5",
    ),
)
@scenario_record_options
@scenario_options()
@bodies_option(
    "Table of objects (.csv, .xlsx: name, width, depth, height, mass, mu, kind; headings also in Japanese), file of one body, or "
    "bundled body; may be repeated. The column kind may hold a bundled name such as bookcase."
)
@option(
    "--mu",
    type=MU,
    section="Body",
    metavar="MU",
    help="Static friction coefficient of objects for which none is given. [default: 0.2 to 0.7]",
)
@option("--vertical/--no-vertical", default=None, help="Apply or omit the vertical component. [default: applied where the record has one]")
@option("--seed", type=int, default=0, show_default=True, help="Seed of the synthetic records and of the samples of the objects.")
@gravity_option
@option(
    "--html",
    type=OutputFile("HTML"),
    metavar="FILE",
    section="Output",
    help="Write a page with a card for each object, English and Japanese.",
)
@option(
    "--xlsx",
    type=OutputFile(),
    metavar="FILE",
    section="Output",
    help="Write the table with its advice as an Excel workbook, headings in the language of --lang.",
)
@output_options(histories=False, film=False, accelerations=False, excel=False)
def scenario(
    source: Source,
    output: OutputOptions,
    bodies: tuple[str, ...],
    mu: float | None,
    vertical: bool | None,
    seed: int,
    gravity: float,
    html: Path | None,
    xlsx: Path | None,
    **intensity: Any,
) -> None:
    """Scenario earthquake: probability of each object to move and to overturn, worst first, with advice.

    Each record shakes each object twice, with its width along one horizontal component and along the other; sizes, edges, friction and
    restitution vary from run to run. An object falls if either horizontal component overturns it. Without RECORD a suite of synthetic and
    recorded motions is scaled to the intensity; RECORD together with an intensity is scaled to it.
    """
    from seisblock.bodies.table import read_body_list
    from seisblock.cli.progress import progress
    from seisblock.cli.write_results import figure_of, write_page, write_results
    from seisblock.output.io.atomic import check_distinct_outputs
    from seisblock.output.io.workbook import check_workbook, write_workbook
    from seisblock.report.json.scenario import document
    from seisblock.report.text import scenario as text_output
    from seisblock.studies.scenario.assess import assess_scenario, scenario_bodies

    check_distinct_outputs(*(path for path in (html, xlsx, output.plot, output.csv) if path is not None and path != STDOUT))
    if xlsx is not None:
        check_workbook(xlsx)
    specs, list_notes = read_body_list(bodies)
    objects, friction_notes = scenario_bodies(specs, {"mu": mu, "vertical": vertical, "gravity": gravity})
    notes = (*list_notes, *friction_notes)
    motions = load_scenario(source, intensity, seed=seed)
    for note in (*motions.notes, *notes):
        info("{note}", note=note)
    with progress("scenario") as advance:
        results = assess_scenario(objects, motions.records, is_scaled=motions.target is not None, seed=seed, progress=advance)
    if html is not None:
        from seisblock.report.html.scenario import scenario_page

        write_page(html, lambda: scenario_page(results, motions.label, (*motions.notes, *notes)))
    if xlsx is not None:
        write_workbook(xlsx, *text_output.sheet_rows(results))
        info("wrote {path}", path=xlsx)

    write_results(
        document(results, motions, {"mu": mu, "vertical": vertical, "seed": seed, "gravity_m_s2": gravity}, notes=(*motions.notes, *notes)),
        output,
        tables=lambda: text_output.tables(results, motions.label),
        csv=lambda: text_output.csv_columns(results),
        bom=True,
        figure=figure_of("scenario:figure", results, motions.label),
    )
