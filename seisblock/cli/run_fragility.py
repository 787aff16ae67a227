"""Fragility run: records, bodies, study and outputs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from seisblock.bodies.table import read_bodies
from seisblock.cli.bodies.body_spec import SIZES, make_body_spec
from seisblock.cli.console import info
from seisblock.cli.load_records import check_single_window, make_preparation, report_qc
from seisblock.cli.option_checks import reject_with, reject_without
from seisblock.cli.options import Source
from seisblock.cli.output import STDOUT, OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core.errors import OutputError, ParameterError
from seisblock.core.i18n import gettext, lazy_gettext
from seisblock.output.io.atomic import check_distinct_outputs, write_records, write_table, write_text
from seisblock.records import Record
from seisblock.records.synthetic.suite import DEFAULT_SUITE, parse_suite
from seisblock.report.exports.knet import write_knet
from seisblock.report.exports.openquake import nrml
from seisblock.report.exports.pelicun import pelicun_metadata, pelicun_rows
from seisblock.report.json.fragility import document
from seisblock.report.text import fragility as text_output
from seisblock.studies.batch.worst_azimuth import is_all_azimuths
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.fragility.results import FragilityStudy
from seisblock.studies.fragility.run import prepare_bodies, run_fragility
from seisblock.studies.fragility.suite import read_suite


def run_study(
    source: Source,
    output: OutputOptions,
    *,
    bodies: tuple[str, ...],
    solver: str,
    limits: tuple[str, ...],
    measures: tuple[str, ...],
    levels: tuple[float, ...] | None,
    compare: str | None,
    params: Mapping[str, Any],
) -> None:
    """Run the study and write its results."""
    check_single_window(source)
    _check_options(source, params, bodies=bodies)
    _check_exports(output, params)
    measure = intensity_measure(measures[0])
    size, _ = measure.display_unit()
    comparison = None if compare is None else _parse_curve(compare, size)
    options = {key: params[key] for key in ("mu", "restitution", "vertical", "gravity") if params[key] is not None}
    specs = list(read_bodies(bodies)) if bodies else [make_body_spec(params, solver)]
    if bodies and any(params[key] is not None for key in (*SIZES, "block")):
        raise ParameterError("--bodies and the sizes of one body exclude each other: give only one of them")
    components = tuple(name for name in source.component if name.lower() != "all")
    records, left_out, suite = _load_suite(source, params)
    report_qc(records, strict=source.strict)
    with progress("fragility") as advance:
        study = run_fragility(
            records,
            specs,
            solver,
            limits=limits,
            im=measures,
            method=params["method"],
            levels=None if levels is None else [level * size for level in levels],
            steps=params["steps"],
            perturb=params["perturb"] or 0,
            components=components,
            preparation=make_preparation(source, () if is_all_azimuths(components) else components),
            confidence=params["confidence"],
            bootstrap=params["bootstrap"],
            seed=params["seed"],
            progress=advance,
            **options,
        )
    placed_bodies = prepare_bodies(specs, solver, options)
    parameters = {**params, "suite": suite, "im": [intensity_measure(name).name for name in measures], "perturb": params["perturb"] or 0}

    _write_exports(study, params)

    write_results(
        document(study, placed_bodies, parameters, compare=comparison, notes=left_out),
        output,
        tables=lambda: text_output.tables(study, gal=output.gal, compare=comparison),
        csv=lambda: text_output.csv_columns(study),
        figure=figure_of("fragility:figure", study, gal=output.gal, compare=comparison),
    )


def _check_options(source: Source, params: Mapping[str, Any], *, bodies: tuple[str, ...]) -> None:
    """Raise an error for options without effect on these records, bodies or outputs."""
    if not source.record:
        reject_with(lazy_gettext("synthetic records"), ["format", "units", "dt", "station", "level", "strict"])
    if params["suite_out"] is None:
        reject_without("--suite-out", ["suite_format"])
    if params["nrml"] is None:
        reject_without("--nrml", ["nrml_shape"])
    if bodies:
        reject_with("--bodies", ["side"])


def _load_suite(source: Source, params: Mapping[str, Any]) -> tuple[list[Record], tuple[str, ...], str | None]:
    """Return the records, a message per unreadable file, and the name of the synthetic suite or None."""
    if source.record:
        for name, value in (("--suite", params["suite"]), ("--suite-out", params["suite_out"])):
            if value is not None:
                raise ParameterError("RECORD and {name} exclude each other: give only one of them", name=name)
        read_options = source.read_options(single_station=True)
        with progress("reading the records"):
            records, left_out = read_suite(source.record, read_options, strict=source.strict)
        return records, left_out, None
    suite: str = params["suite"] or DEFAULT_SUITE
    with progress("generating synthetic records"):
        synthetic = list(parse_suite(suite, seed=params["seed"]))
    if params["suite"] is None:
        info("no RECORD given: using {suite}", suite=suite)
    info("{count} synthetic records of one source, path and site: less variable than recorded motions", count=len(synthetic))
    if params["suite_out"] is not None:
        with progress("writing the records"):
            (write_knet if params["suite_format"] == "knet" else write_records)(params["suite_out"], synthetic)
        info("wrote {path}", path=params["suite_out"])
    return synthetic, (), suite


def _check_exports(output: OutputOptions, params: Mapping[str, Any]) -> None:
    """Raise an error, before any record is read, for export files that cannot be written."""
    rows, model = params["pelicun"], params["nrml"]
    for path, suffix in ((rows, ".csv"), (model, ".xml")):
        if path is not None and path.suffix.lower() != suffix:
            raise OutputError("{path}: the file name must end in {suffix}", path=path, suffix=suffix)
    metadata = None if rows is None else rows.with_suffix(".json")
    output_paths = (None if path == STDOUT else path for path in (output.csv, output.plot))
    check_distinct_outputs(rows, metadata, model, *output_paths)


def _write_exports(study: FragilityStudy, params: Mapping[str, Any]) -> None:
    if params["pelicun"] is not None:
        rows: Path = params["pelicun"]
        write_table(rows, *pelicun_rows(study))
        write_text(rows.with_suffix(".json"), pelicun_metadata(study))
        info("wrote {path}", path=rows)
        info("wrote {path}", path=rows.with_suffix(".json"))
    if params["nrml"] is not None:
        write_text(params["nrml"], nrml(study, shape=params["nrml_shape"]))
        with_curve = {curve.limit for curve in study.curves if curve.curve is not None}
        if params["nrml_shape"] == "logncdf" and (without_curve := sorted({curve.limit for curve in study.curves} - with_curve)):
            info("{path} omits {limits}: no body has a curve for them", path=params["nrml"], limits=without_curve)
        info("wrote {path}", path=params["nrml"])


def _parse_curve(text: str, size: float) -> Lognormal:
    """Return the curve of a median, in the displayed unit, and a beta."""
    try:
        median, beta = (float(part) for part in text.split(","))
    except ValueError:
        raise click.BadParameter(
            gettext("{value!r} is not a median and a beta, for example 50,0.4", value=text[:100]), param_hint="--compare"
        ) from None
    return Lognormal(median * size, beta)
