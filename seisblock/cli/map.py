"""``seisblock map``: table and map of an earthquake's stations."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from seisblock.cli.bodies.free_standing import choose_free_standing, free_standing_options
from seisblock.cli.bodies.options import cemetery_option
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, option
from seisblock.cli.console import info, note_default_record, warning
from seisblock.cli.option_checks import reject_with, reject_without
from seisblock.cli.options import Source, output_options, real_record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import Count, OutputFile
from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.core.limits import MAX_RUNS
from seisblock.core.registry import solver_names

if TYPE_CHECKING:
    from seisblock.output.io.history_csv import CsvTable
    from seisblock.studies.map.station_response import StationModel
SIZES = ("block", "width", "height")
"""Options that select a body."""

BODY_OPTIONS = (
    *("depth", "mass", "centroid_height", "centroid_offset", "centroid_inertia", "inset", "side", "mu", "mu_kinetic", "surface"),
    *("restitution", "rocking_restitution", "tenon", "frequency_vertical", "vertical", "runs", "seed"),
)
"""Further options of the body and the solver."""

SOLVERS = tuple(name for name in solver_names() if name != "stack")
"""Solvers of a body at a station: all but that of piles; a registration is imported with its model only."""

DEFAULT_RUNS = 50
"""Default number of samples for an overturning probability."""


@click.command(
    cls=Command,
    essential=("--block", "--width", "--height", "--mu", "--cemetery", "--solver", "--runs", "--html"),
    examples=(
        "seisblock map hanmer_springs_2016 --block gravestone --mu 0.5 --geojson stations.geojson",
        "seisblock map hanmer_springs_2016 --cemetery aoyama.csv --csv stations.csv",
        "seisblock map hanmer_springs_2016 --solver slide --mu 0.1",
    ),
)
@real_record_options
@cemetery_option("CSV of gravestones at every station, instead of a body; gives the overturning rate. Bundled: aoyama.csv.")
@option(
    "--survey",
    type=click.Path(path_type=Path),
    metavar="FILE",
    section="Body",
    help="CSV of surveyed cemeteries (place, latitude, longitude, stones, fallen): estimated motion compared with the stations "
    "around. Stones as in --cemetery. [default: aoyama.csv]",
)
@free_standing_options
@option(
    "--frequency-vertical",
    type=float,
    metavar="HZ",
    section="Body",
    help="--solver uplift: natural frequency of the vertical motion on the springs, Hz.",
)
@option("--solver", type=SuggestingChoice(SOLVERS), help="Model that computes the response. [default: respond]")
@option("--vertical/--no-vertical", default=None, help="Apply or omit the vertical component. [default: applied where the record has one]")
@option(
    "--runs",
    type=Count(N_("samples"), MAX_RUNS, minimum=0),
    help="Samples for the overturning probability of a body at each station; 0 for none. [default: 50; respond and rock only]",
)
@option("--seed", type=int, default=0, show_default=True, help="Seed of the samples.")
@option("--workers", type=click.IntRange(1, 1024), metavar="N", help="Number of threads. [default: number of cores]")
@gravity_option
@option("--geojson", type=OutputFile("GeoJSON"), metavar="FILE", section="Output", help="Write the stations as GeoJSON points (RFC 7946).")
@option("--html", type=OutputFile("HTML"), metavar="FILE", section="Output", help="Write the map as one self-contained HTML page.")
@output_options(histories=False, film=False)
def map(  # noqa: A001 - the command's name
    source: Source,
    output: OutputOptions,
    cemetery: str | None,
    survey: Path | None,
    workers: int | None,
    geojson: Path | None,
    html: Path | None,
    **params: Any,
) -> None:
    """Table and map of an earthquake's stations: measured motion and response of a body or a cemetery, largest first.

    RECORD may be an archive, a folder, a pattern or a list (@records.txt) of one earthquake; of KiK-net stations the surface sensor
    is used unless --level is given. A body is solved in all azimuths (jump and uplift: along each horizontal component), the worst
    azimuth counts; a stone of a cemetery counts if either horizontal component overturns it. Files that cannot be read are listed. A
    station without coordinates appears in the table but not on the map.
    """
    from seisblock.bodies.cemetery.table import read_cemetery
    from seisblock.cli.load_records import check_single_window, make_preparation
    from seisblock.cli.progress import progress
    from seisblock.cli.write_results import figure_of, write_page, write_results
    from seisblock.core.errors import ParameterError, RecordError
    from seisblock.output.io.atomic import check_distinct_outputs
    from seisblock.records.analytic import is_analytic
    from seisblock.report.json.map import document
    from seisblock.report.text import map as text_output
    from seisblock.samples import REAL_SAMPLE
    from seisblock.studies.map.stations import survey_stations
    from seisblock.studies.map.surveyed_places import compare_surveys, read_surveys

    check_single_window(source)
    for name in source.record:
        if is_analytic(name):
            raise ParameterError("{motion} is an analytic motion without a place: give records of stations", motion=name)
    if source.component and source.target_pga is None:
        raise click.UsageError(gettext("--component has no effect on map except with --target-pga: all azimuths are computed"))
    check_distinct_outputs(*(path for path in (geojson, html) if path is not None))
    surveyed_places = None if survey is None else read_surveys(survey)
    model = _station_model(cemetery, **params)
    if not source.record:
        note_default_record(REAL_SAMPLE, synthetic=False)
    read_options = source.read_options(single_station=True)
    with progress("stations") as advance:
        stations = survey_stations(
            source.record or (REAL_SAMPLE,),
            model,
            preparation=make_preparation(source, source.component),
            read_options=read_options,
            strict=source.strict,
            workers=workers,
            progress=advance,
        )
    for text in text_output.preparation_texts(stations.preparation):
        info("{note}", note=text)
    if all(answer.failure is not None and answer.pga_m_s2 is None for answer in stations.answers):
        raise RecordError("no station could be computed: {why}", why=stations.answers[0].failure)
    if output.plot is not None and not stations.mapped:
        raise RecordError("no station has coordinates: a map cannot be drawn")
    surveys = () if surveyed_places is None else compare_surveys(surveyed_places, stations, read_cemetery(cemetery or "aoyama.csv"))
    if geojson is not None:
        from seisblock.report.exports.geojson import write_geojson

        write_geojson(geojson, stations, surveys)
        info("wrote {path}", path=geojson)
    if html is not None:
        from seisblock.report.html.map import map_page

        write_page(html, lambda: map_page(stations, model, gal=output.gal, surveys=surveys))

    def csv() -> CsvTable:
        from seisblock.studies.map.station_row import station_row

        rows = [station_row(answer) for answer in stations.answers]
        return list(rows[0]), (list(row.values()) for row in rows)

    def tables() -> Iterator[Any]:
        yield from text_output.tables(stations, model, gal=output.gal)
        if surveys:
            yield from text_output.survey_tables(surveys)

    result = document(stations, model, surveys, has_floor_motion=source.floor is not None)
    write_results(
        result, output, tables=tables, csv=csv, figure=figure_of("stations:figure", stations, model, gal=output.gal, surveys=surveys)
    )


def _station_model(cemetery: str | None, *, solver: str | None, runs: int | None, seed: int, **params: Any) -> StationModel | None:
    """Return the model at each station: cemetery, body or None."""
    from seisblock.models.respond.options import RespondOptions
    from seisblock.studies.map.station_response import StationBody, StationCemetery

    has_body = solver is not None or any(params.get(name) is not None for name in SIZES)
    if cemetery is not None:
        if has_body:
            raise click.UsageError(gettext("--cemetery and a body exclude each other: give only one of them"))
        reject_with("--cemetery", [*BODY_OPTIONS, "gravity"])
        from seisblock.bodies.cemetery.table import read_cemetery

        return StationCemetery(read_cemetery(cemetery))
    if not has_body:
        reject_without(lazy_gettext("--block, --width and --height, or --solver"), [*BODY_OPTIONS, "gravity"])
        return None
    if solver not in (None, "respond"):
        return _station_body(solver, params, runs=runs, seed=seed)
    if params["frequency_vertical"] is not None:
        raise click.UsageError(gettext("--frequency-vertical requires --solver uplift: omit it"))
    choice = choose_free_standing(params)
    info("body: {says}", says=choice.description)
    options: dict[str, Any] = {"mu": choice.mu, "mu_kinetic": choice.mu_kinetic}
    options |= {name: params[name] for name in ("restitution", "rocking_restitution", "tenon", "vertical", "gravity")}
    return StationBody(choice.body, RespondOptions(**options), DEFAULT_RUNS if runs is None else runs, seed)


def _station_body(solver: str, params: dict[str, Any], *, runs: int | None, seed: int) -> StationModel:
    """Return a body for a solver other than ``respond``; options that the solver lacks raise an error."""
    from dataclasses import replace

    from seisblock.cli.bodies.body_spec import OWN_OPTIONS, make_body_spec
    from seisblock.core.registry import get_solver
    from seisblock.studies.batch.run import ignored_column_notes
    from seisblock.studies.map.station_response import StationBody
    from seisblock.studies.solvers import solver_studies

    context = click.get_current_context()
    given_names = [name for name in OWN_OPTIONS if context.get_parameter_source(name) is not ParameterSource.DEFAULT]
    model = get_solver(solver)
    body_values = {name: params[name] for name in ("surface", "frequency_vertical") if params[name] is not None}
    vertical_option = {} if params["vertical"] is None else {"vertical": params["vertical"]}
    model.check_options({**{name: params[name] for name in (*given_names, *body_values) if name not in model.columns}, **vertical_option})
    spec = make_body_spec({**params, **{name: None for name in OWN_OPTIONS if name not in given_names}}, solver)
    spec = replace(spec, parameters={**spec.parameters, **body_values})
    options = {name: params[name] for name in given_names if name not in body_values}
    placement = model.build_body(spec, {**options, **vertical_option, "gravity": params["gravity"]})
    for note in ignored_column_notes(model, [spec]):
        warning(note)
    info("body: {says}", says=placement.name)
    default_runs = DEFAULT_RUNS if solver_studies(solver).samples_in_rows else 0
    return StationBody(
        placement.body,
        placement.options,
        default_runs if runs is None else runs,
        seed,
        solver=solver,
        label=placement.name,
    )
