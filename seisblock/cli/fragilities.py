"""How ``seisblock fragility`` goes about it: records, bodies, the study, and where its answer goes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from seisblock.bodies.roster import read_bodies
from seisblock.cli.bodies.listed import SIZES, listed_body
from seisblock.cli.emit import emit
from seisblock.cli.idle import refuse_beside, refuse_without
from seisblock.cli.inputs import preparation_of, refuse_windows, tell_doubts
from seisblock.cli.options import Source
from seisblock.cli.output import STDOUT, Output
from seisblock.cli.progress import progress
from seisblock.cli.talk import say
from seisblock.errors import OutputError, ParameterError
from seisblock.present.documents.fragility import document
from seisblock.present.exports.knet import write_knet
from seisblock.present.exports.openquake import nrml
from seisblock.present.exports.pelicun import pelicun_metadata, pelicun_rows
from seisblock.present.files import refuse_collisions, write_records, write_table, write_text
from seisblock.present.text import fragility as shown
from seisblock.readers.dispatch import Options
from seisblock.records import Record
from seisblock.records.synthetic.suite import DEFAULT_SUITE, named_suite
from seisblock.studies.batch.azimuths import around
from seisblock.studies.fragility.answer import FragilityStudy
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.fragility.run import bodies_of, run_fragility
from seisblock.studies.fragility.suite import read_suite
from seisblock.words import said, tell


def run(
    source: Source,
    output: Output,
    *,
    bodies: tuple[str, ...],
    solver: str,
    limits: tuple[str, ...],
    measures: tuple[str, ...],
    levels: tuple[float, ...] | None,
    compare: str | None,
    asked: Mapping[str, Any],
) -> None:
    """Run the study, and say what it comes to."""
    refuse_windows(source)
    _refuse_idle(source, asked, bodies=bodies)
    _check_exports(output, asked)
    measure = intensity_measure(measures[0])
    size, _ = measure.shown()
    other = None if compare is None else _curve(compare, size)
    options = {key: asked[key] for key in ("mu", "restitution", "vertical", "gravity") if asked[key] is not None}
    listed = list(read_bodies(bodies)) if bodies else [listed_body(asked, solver)]
    if bodies and any(asked[key] is not None for key in (*SIZES, "block")):
        raise ParameterError("give --bodies, or the sizes of one body, not both")
    components = tuple(name for name in source.component if name.lower() != "all")
    records, left_out, suite = _records(source, asked)
    tell_doubts(records, strict=source.strict)
    with progress("fragility") as advance:
        study = run_fragility(
            records,
            listed,
            solver,
            limits=limits,
            im=measures,
            method=asked["method"],
            levels=None if levels is None else [level * size for level in levels],
            steps=asked["steps"],
            perturb=asked["perturb"] or 0,
            components=components,
            preparation=preparation_of(source, () if around(components) else components),
            confidence=asked["confidence"],
            bootstrap=asked["bootstrap"],
            seed=asked["seed"],
            progress=advance,
            **options,
        )
    stand = bodies_of(listed, solver, options)
    chosen = {**asked, "suite": suite, "im": [intensity_measure(name).name for name in measures], "perturb": asked["perturb"] or 0}

    _export(study, asked)

    def figure() -> Any:
        from seisblock.present.figures.fragility import figure as drawn

        return drawn(study, gal=output.gal, compare=other)

    emit(
        document(study, stand, chosen, compare=other, notes=left_out),
        output,
        tables=lambda: shown.tables(study, gal=output.gal, compare=other),
        csv=lambda path: write_table(path, *shown.columns(study)),
        figure=figure,
    )


def _refuse_idle(source: Source, asked: Mapping[str, Any], *, bodies: tuple[str, ...]) -> None:
    """Refuse what says nothing of these records and bodies, or of files that are not written."""
    if not source.record:
        refuse_beside(said("synthetic records"), ["format", "units", "dt", "station", "level", "strict"])
    if asked["suite_out"] is None:
        refuse_without("--suite-out", ["suite_format"])
    if asked["nrml"] is None:
        refuse_without("--nrml", ["nrml_shape"])
    if bodies:
        refuse_beside("--bodies", ["side"])


def _records(source: Source, asked: Mapping[str, Any]) -> tuple[list[Record], tuple[str, ...], str | None]:
    """Return the records, a sentence for each file that could not be read, and the synthetic suite that they are, if they are one."""
    if source.record:
        for name, given in (("--suite", asked["suite"]), ("--suite-out", asked["suite_out"])):
            if given is not None:
                raise ParameterError("give either RECORD or {name}, not both", name=name)
        reading = Options(source.format, source.units, source.dt, None if source.station == "all" else source.station, source.level)
        with progress("reading the records"):
            records, left_out = read_suite(source.record, reading, strict=source.strict)
        return records, left_out, None
    suite: str = asked["suite"] or DEFAULT_SUITE
    with progress("making synthetic records"):
        made = list(named_suite(suite, seed=asked["seed"]))
    if asked["suite"] is None:
        say("no RECORD given: using {suite}", suite=suite)
    say("{count} synthetic records, no recordings: of one source, path and site, they differ less than records do", count=len(made))
    if asked["suite_out"] is not None:
        with progress("writing the records"):
            (write_knet if asked["suite_format"] == "knet" else write_records)(asked["suite_out"], made)
        say("wrote {path}", path=asked["suite_out"])
    return made, (), suite


def _check_exports(output: Output, asked: Mapping[str, Any]) -> None:
    """Refuse, before anything is read, files for other programs that cannot be written."""
    rows, model = asked["pelicun"], asked["nrml"]
    for path, suffix in ((rows, ".csv"), (model, ".xml")):
        if path is not None and path.suffix.lower() != suffix:
            raise OutputError("{path}: the name must end in {suffix}", path=path, suffix=suffix)
    beside = None if rows is None else rows.with_suffix(".json")
    own = (None if path == STDOUT else path for path in (output.csv, output.plot))
    refuse_collisions(rows, beside, model, *own)


def _export(study: FragilityStudy, asked: Mapping[str, Any]) -> None:
    """Write the files for other programs."""
    if asked["pelicun"] is not None:
        rows: Path = asked["pelicun"]
        write_table(rows, *pelicun_rows(study))
        write_text(rows.with_suffix(".json"), pelicun_metadata(study))
        say("wrote {path}", path=rows)
        say("wrote {path}", path=rows.with_suffix(".json"))
    if asked["nrml"] is not None:
        write_text(asked["nrml"], nrml(study, shape=asked["nrml_shape"]))
        drawn = {curve.limit for curve in study.curves if curve.curve is not None}
        if asked["nrml_shape"] == "logncdf" and (bare := sorted({curve.limit for curve in study.curves} - drawn)):
            say("{path} leaves out {limits}, of which no body has a curve", path=asked["nrml"], limits=bare)
        say("wrote {path}", path=asked["nrml"])


def _curve(text: str, size: float) -> Lognormal:
    """Return the curve that a median, in the unit shown, and a beta describe."""
    try:
        median, beta = (float(part) for part in text.split(","))
    except ValueError:
        raise click.BadParameter(
            tell("{value!r} is not a median and a beta such as 50,0.4", value=text[:100]), param_hint="--compare"
        ) from None
    return Lognormal(median * size, beta)
