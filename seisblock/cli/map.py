"""``seisblock map``: an earthquake's stations, and what it did to what stands there."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from seisblock.cli import offered
from seisblock.cli.bodies.standing import choose_standing, standing_options
from seisblock.cli.command import Command, option
from seisblock.cli.idle import refuse_beside, refuse_without
from seisblock.cli.meant import OneOf
from seisblock.cli.options import Source, gravity_option, output_options, real_record_options
from seisblock.cli.output import Output
from seisblock.cli.talk import say, warn
from seisblock.cli.types import Count
from seisblock.words import noted, said, tell

if TYPE_CHECKING:
    from seisblock.studies.stations.effects import WhatStands

SOLVERS = ("respond", "rock", "slide", "jump", "uplift")
SIZES = ("block", "width", "height")
"""Options of which any names a body."""

OF_A_BODY = (
    *("depth", "mass", "centroid_height", "centroid_offset", "centroid_inertia", "inset", "side", "mu", "mu_kinetic", "surface"),
    *("restitution", "rocking_restitution", "tenon", "frequency_vertical", "vertical", "runs", "seed"),
)
"""Options that say more of a body, or of how it is followed."""

RUNS = 50
"""Plausible versions behind a probability, where nothing else is asked for."""


@click.command(
    cls=Command,
    examples=(
        "seisblock map hanmer_springs_2016 --block gravestone --mu 0.5 --geojson stations.geojson",
        "seisblock map hanmer_springs_2016 --cemetery aoyama.csv --csv stations.csv",
        "seisblock map hanmer_springs_2016 --solver slide --mu 0.1",
    ),
)
@real_record_options
@option(
    "--cemetery",
    metavar="FILE|NAME",
    shell_complete=offered.cemeteries,
    section="Body",
    help="CSV of gravestones that stand at every station, instead of a body: which share falls. Bundled: aoyama.csv.",
)
@option(
    "--survey",
    type=click.Path(path_type=Path),
    metavar="FILE",
    section="Body",
    help="CSV of surveyed cemeteries (place, latitude, longitude, stones, fallen): what their stones say beside the stations around "
    "them. Stones are as those of --cemetery. [default: aoyama.csv]",
)
@standing_options
@option(
    "--frequency-vertical",
    type=float,
    metavar="HZ",
    section="Body",
    help="--solver uplift: natural frequency of the vertical motion on the springs, Hz.",
)
@option("--solver", type=OneOf(SOLVERS), help="Which model follows the body. [default: respond]")
@option("--vertical/--no-vertical", default=None, help="Whether the vertical component acts. [default: as with the solver's own command]")
@option(
    "--runs",
    type=Count(noted("versions"), "SEISBLOCK_RUNS", least=0),
    help="Plausible versions behind a body's probability at each station; 0 for none. [default: 50; none but of respond and rock]",
)
@option("--seed", type=int, default=0, show_default=True, help="Seed of the versions.")
@option("--workers", type=click.IntRange(1, 1024), metavar="N", help="Threads on this machine. [default: as many as there are cores]")
@gravity_option
@option(
    "--geojson", type=click.Path(path_type=Path), metavar="FILE", section="Output", help="Write the stations as points for maps (RFC 7946)."
)
@option(
    "--html", type=click.Path(path_type=Path), metavar="FILE", section="Output", help="Write the map as one page that needs no network."
)
@output_options(histories=False, film=False)
def map(  # noqa: A001 - the command's name
    source: Source,
    output: Output,
    gravity: float,
    cemetery: str | None,
    survey: Path | None,
    solver: str | None,
    vertical: bool | None,
    runs: int | None,
    seed: int,
    workers: int | None,
    geojson: Path | None,
    html: Path | None,
    **given: Any,
) -> None:
    """Map an earthquake: what each station measured, and what that does to a body or a cemetery, the worst first.

    RECORD may be a bundle, a folder, a pattern or a list (@records.txt) of one earthquake; of KiK-net stations the surface is taken unless
    --level says otherwise. A body is followed in every direction (jump and uplift: along each horizontal component), a cemetery judged in
    every direction; the worst counts. What cannot be read is named, the others are answered; a station without coordinates is listed, and
    on no map.
    """
    from seisblock.bodies.cemetery.table import read_cemetery
    from seisblock.cli.emit import emit
    from seisblock.cli.inputs import preparation_of, refuse_windows
    from seisblock.cli.progress import progress
    from seisblock.errors import RecordError
    from seisblock.present.documents.map import document
    from seisblock.present.files import refuse_collisions
    from seisblock.present.suffixes import check_text
    from seisblock.present.text import map as shown
    from seisblock.readers import REAL_SAMPLE
    from seisblock.readers.dispatch import Options
    from seisblock.studies.stations.survey import survey_stations
    from seisblock.studies.stations.surveys import judge_surveys, read_surveys

    refuse_windows(source)
    if source.component and source.target_pga is None:
        raise click.UsageError(tell("map looks in every direction: --component only says of what --target-pga is the peak"))
    refuse_collisions(*(path for path in (geojson, html) if path is not None))
    for path, form in ((geojson, "GeoJSON"), (html, "HTML")):
        if path is not None:
            check_text(path, form)
    surveyed = None if survey is None else read_surveys(survey)
    subject = _subject(cemetery, given, solver, vertical=vertical, runs=runs, seed=seed, gravity=gravity)
    if not source.record:
        say("no RECORD given: using the bundled sample {name}", name=REAL_SAMPLE)
    reading = Options(source.format, source.units, source.dt, None if source.station == "all" else source.station, source.level)
    with progress("stations") as advance:
        found = survey_stations(
            source.record or (REAL_SAMPLE,),
            subject,
            preparation=preparation_of(source, source.component),
            reading=reading,
            strict=source.strict,
            workers=workers,
            progress=advance,
        )
    if all(answer.failure is not None and answer.pga_m_s2 is None for answer in found.answers):
        raise RecordError("no station has an answer: {why}", why=found.answers[0].failure)
    if output.plot is not None and not found.mapped:
        raise RecordError("of no station it is known where it is: there is nothing to map")
    surveys = () if surveyed is None else judge_surveys(surveyed, found, read_cemetery(cemetery or "aoyama.csv"))
    if geojson is not None:
        from seisblock.present.exports.geojson import write_geojson

        write_geojson(geojson, found, surveys)
        say("wrote {path}", path=geojson)
    if html is not None:
        from seisblock.present.files import write_text
        from seisblock.present.pages.map import map_page

        with progress("drawing"):
            write_text(html, map_page(found, subject, gal=output.gal, surveys=surveys))
        say("wrote {path}", path=html)

    def table(path: Path) -> None:
        from seisblock.present.files import write_table
        from seisblock.studies.stations.row import row_of

        rows = [row_of(answer) for answer in found.answers]
        write_table(path, list(rows[0]), (list(row.values()) for row in rows))

    def figure() -> Any:
        from seisblock.present.figures.stations import figure as drawn

        return drawn(found, subject, gal=output.gal, surveys=surveys)

    def tables() -> Iterator[Any]:
        yield from shown.tables(found, subject, gal=output.gal)
        if surveys:
            yield from shown.survey_tables(surveys)

    told = document(found, subject, surveys, upstairs=source.floor is not None)
    emit(told, output, tables=tables, csv=table, figure=figure)


def _subject(
    cemetery: str | None, given: dict[str, Any], solver: str | None, *, vertical: bool | None, runs: int | None, seed: int, gravity: float
) -> WhatStands | None:
    """Return what stands at each station: a cemetery, a body, or nothing."""
    from seisblock.studies.stations.effects import StandingBody, StandingStones

    named = solver is not None or any(given.get(name) is not None for name in SIZES)
    if cemetery is not None:
        if named:
            raise click.UsageError(tell("give either --cemetery or a body, not both"))
        refuse_beside("--cemetery", [*OF_A_BODY, "gravity"])
        from seisblock.bodies.cemetery.table import read_cemetery

        return StandingStones(read_cemetery(cemetery))
    if not named:
        refuse_without(said("--block, --width and --height, or --solver"), [*OF_A_BODY, "gravity"])
        return None
    if solver not in (None, "respond"):
        return _followed(solver, given, vertical=vertical, runs=runs, seed=seed, gravity=gravity)
    if given["frequency_vertical"] is not None:
        raise click.UsageError(tell("--frequency-vertical is of --solver uplift: leave it out"))
    chosen = choose_standing(given)
    say("body: {says}", says=chosen.says)
    options = {"mu": chosen.mu, "mu_kinetic": chosen.mu_kinetic, "gravity": gravity}
    options |= {name: given[name] for name in ("restitution", "rocking_restitution", "tenon")}
    return StandingBody(chosen.body, options, vertical, RUNS if runs is None else runs, seed)


def _followed(solver: str, given: dict[str, Any], *, vertical: bool | None, runs: int | None, seed: int, gravity: float) -> WhatStands:
    """Return a body that another solver than ``respond`` follows; what that solver does not have is refused by name."""
    from dataclasses import replace

    from seisblock.cli.bodies.listed import OWN, listed_body
    from seisblock.studies.batch.models import batch_model
    from seisblock.studies.batch.run import unheard
    from seisblock.studies.stations.effects import StandingBody

    context = click.get_current_context()
    told = [name for name in OWN if context.get_parameter_source(name) is not ParameterSource.DEFAULT]
    model = batch_model(solver)
    of_body = {name: given[name] for name in ("surface", "frequency_vertical") if given[name] is not None}
    acts = {} if vertical is None else {"vertical": vertical}
    model.refuse_unknown({**{name: given[name] for name in (*told, *of_body) if name not in model.columns}, **acts})
    listed = listed_body({**given, **{name: None for name in OWN if name not in told}}, solver)
    listed = replace(listed, told={**listed.told, **of_body})
    options = {name: given[name] for name in told if name not in of_body}
    placed = model.place(listed, {**options, "gravity": gravity})
    for note in unheard(model, [listed]):
        warn(note)
    say("body: {says}", says=placed.name)
    most = RUNS if model.chance is not None else 0
    return StandingBody(placed.body, placed.options, vertical, most if runs is None else runs, seed, solver=solver, called=placed.name)
