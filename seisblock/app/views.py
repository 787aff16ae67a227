"""Fragments of the page: forms, progress, results and errors, from the documents of the commands."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping
from dataclasses import fields
from datetime import datetime
from pathlib import Path
from typing import Any

from markupsafe import Markup

from seisblock.app import forms
from seisblock.app.jobs import Job, JobState
from seisblock.app.sessions import Tab
from seisblock.bodies.body_name import body_name
from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.friction import surface
from seisblock.core.i18n import LANGUAGES, N_, format_percent, format_share, gettext, join_list
from seisblock.core.units import parse_length
from seisblock.output.templating import make_environment
from seisblock.readers.discover import group_files
from seisblock.readers.options import ReadOptions
from seisblock.samples import DEFAULT_SAMPLE, REAL_SAMPLE, list_samples

TEMPLATES = Path(__file__).with_name("templates")

KINDS = ("record", "object", "film", "report", "survey", "collection", "secure", "event")
"""Kinds of jobs."""

SLOTS = ("record", "object", "survey", "collection", "event")
"""Kinds of jobs whose results a page shows again when it is reloaded."""

TABS = {"object": N_("One object"), "survey": N_("A survey"), "collection": N_("A collection"), "event": N_("An event")}
"""Tabs of the page."""

LANGUAGE_NAMES = {"en": "English", "ja": "日本語"}

LEVELS = {"likely overturns": "bad", "may overturn": "mild", "moves": "minor", "stays": "good"}
"""Colour of a result by class, see :data:`seisblock.studies.assessment.CLASSES`."""

DRAWING_HEIGHT_M, DRAWING_WIDTH_M = 2.2, 1.6
"""Part of the room that the drawing of an object shows, m."""

GAL = 100.0
"""gal in 1 m/s^2; also kine in 1 m/s and cm in 1 m."""


def render(template: str, **values: Any) -> str:
    """Return a fragment in the language of the locale."""
    return make_environment(TEMPLATES).get_template(template).render(**values)


def page(tab: Tab) -> str:
    """Return the page of a tab, with the results that it has."""
    return render(
        "page.html",
        tab=tab,
        tabs=TABS,
        languages={code: LANGUAGE_NAMES[code] for code in LANGUAGES},
        choices=_record_choices(tab),
        record_units=forms.RECORD_UNITS,
        slots={kind: _slot(tab, kind) for kind in SLOTS},
        default_record=DEFAULT_SAMPLE,
        intensities=forms.JMA_CHOICES,
        fields=_field_values(tab.form, keep_sizes=True),
        default_intensity=forms.DEFAULT_INTENSITY,
        record_scenario=forms.RECORD_SCENARIO,
        survey_sheet=forms.SURVEY_SHEET,
        bundled_cemetery=forms.BUNDLED_CEMETERY,
        event_sample=REAL_SAMPLE,
        solver_fields=forms.solver_fields(),
        period=forms.FLOOR_PERIOD_S,
    )


def _record_choices(tab: Tab) -> dict[str, Any]:
    """Return the choices of a ground motion that are no files, and the one in force."""
    from seisblock.records.analytic import is_analytic

    samples = [(sample.name, gettext(sample.description)) for sample in list_samples() if sample.kind == "record"]
    chosen = "" if tab.uploaded or not tab.record else tab.record[0]
    motion = chosen if is_analytic(chosen) else ""
    return {"samples": samples, "sample": "" if motion else chosen, "motion": motion, "intensities": forms.JMA_CHOICES}


def _slot(tab: Tab, kind: str) -> Markup:
    """Return the place of a job's result in a page that is loaded again."""
    text = render("slot.html", tab=tab, kind=kind, job=tab.jobs.get(kind), serial=tab.serials.get(kind), label=_intensity_label(tab))
    return Markup(text.strip())


def object_fields(tab: Tab, form: Mapping[str, str]) -> str:
    """Return the fields of the object that was chosen; one by its sizes keeps those that were typed."""
    return render("object_fields.html", tab=tab, fields=_field_values(form))


def _field_values(form: Mapping[str, str], *, keep_sizes: bool = False) -> dict[str, Any]:
    """Return the fields of an object: choices with drawings, and its sizes, those of a bundled one unless they are kept."""
    choice = form.get("object", "")
    bodies, chosen = forms.body_options(), None if keep_sizes else forms.find_body(choice)
    width, height = (form.get("width", ""), form.get("height", "")) if chosen is None else forms.size_texts(chosen)
    return {
        "choice": choice or forms.OWN_SIZES + "block",
        "kinds": {forms.OWN_SIZES + kind: label for kind, label in forms.KIND_LABELS.items()},
        "file": forms.FILE,
        "bodies": bodies,
        "drawings": [(body, _drawing(body)) for body in bodies if body.width_m is not None],
        "width": width,
        "height": height,
        "mu": forms.number_text(chosen.mu) if chosen else form.get("mu", ""),
        "surfaces": forms.surface_labels(),
        "surface": form.get("surface", "") if keep_sizes else "",
        "scan_units": forms.SCAN_UNITS,
        "scan_axes": forms.SCAN_AXES,
    }


def _drawing(body: forms.BodyOption) -> dict[str, float]:
    """Return the rectangle of a body in a drawing to scale, in per cent of its height."""
    assert body.width_m is not None and body.height_m is not None
    scale = 100.0 / max(DRAWING_HEIGHT_M, body.height_m, body.width_m * DRAWING_HEIGHT_M / DRAWING_WIDTH_M)
    width, height = body.width_m * scale, body.height_m * scale
    room = 100.0 * DRAWING_WIDTH_M / DRAWING_HEIGHT_M
    return {
        "x": round(0.5 * (room - width), 2),
        "y": round(100.0 - height, 2),
        "width": round(width, 2),
        "height": round(height, 2),
        "room": round(room, 2),
    }


def error(text: str, tab: Tab | None = None) -> str:
    """Return the region of errors; with a tab, an empty input of its record, too."""
    region = render("error.html", error=text)
    return region if tab is None else region + render("record_input.html", tab=tab, oob=True)


def error_page(text: str) -> str:
    """Return a page with one error, for a link that opens in a window of its own."""
    return render("error_page.html", error=text)


def job_started(tab: Tab, kind: str) -> str:
    """Return the place of a job's result while it runs, and an empty region of errors."""
    choices = _record_choices(tab) if kind == "record" else None
    return render("job.html", tab=tab, kind=kind, job=tab.jobs[kind], serial=tab.serials[kind], text="", share=None, choices=choices)


def progress(tab: Tab, kind: str, job: Job) -> str:
    """Return the progress of a job."""
    text, share = job.progress
    if job.state is JobState.WAITING:
        text = gettext("waiting for another computation")
    return render("progress.html", tab=tab, kind=kind, serial=tab.serials[kind], text=text or gettext("computing"), share=share)


def cancelled(tab: Tab, kind: str) -> str:
    """Return the place of a job's result after its cancellation."""
    return render("cancelled.html", tab=tab, kind=kind)


def ended(tab: Tab, kind: str, job: Job) -> str:
    """Return the result of a job, or its error."""
    if job.state is JobState.FAILED:
        return render("failed.html", tab=tab, kind=kind, error=job.error)
    if job.state is JobState.CANCELLED:
        return cancelled(tab, kind)
    return VIEWS[kind](tab, job)


def record_summary(tab: Tab, job: Job) -> str:
    """Return station, earthquake, peaks, checks and waveform of a record."""
    from seisblock.measures.intensity import jma_class

    document = job.document
    record = document["record"]
    checks = [gettext(CHECK_LABELS.get(word, word)) for word in record["checks"]["proved"]] if record else []
    assumed = [gettext(CHECK_LABELS.get(word, word)) for word in record["checks"]["assumed"]] if record else []
    intensity = next((row["jma_intensity"] for row in document["results"] if row.get("jma_intensity") is not None), None)
    return render(
        "record.html",
        tab=tab,
        name=record["station"] or record["source"],
        facts=[
            (gettext("files of the record"), join_list(forms.split_arguments(tab.record)[0])),
            (gettext("station"), " ".join(text for text in (record["station"], record["station_name"]) if text)),
            (gettext("begin"), record["local_start"] or record["start"] or ""),
            (gettext("earthquake"), _earthquake(record)),
            (
                gettext("length"),
                gettext("{duration:.4g} s, {samples} samples", duration=record["dt_s"] * record["samples"], samples=record["samples"]),
            ),
            (gettext("JMA intensity"), "" if intensity is None else f"{intensity:.2f} ({gettext(jma_class(intensity))})"),
            (gettext("proved"), join_list(checks)),
            (gettext("assumed"), join_list(assumed)),
        ],
        peaks=[(row["component"], f"{GAL * row['pga_m_s2']:.4g}", f"{GAL * row['pgv_m_s']:.4g}") for row in document["results"]],
        notes=job.notes,
    )


CHECK_LABELS = {"count": N_("sample count")}
"""Labels of checks whose bare word stands for other counts, too."""


def _earthquake(record: Mapping[str, Any]) -> str:
    from seisblock.output.text.record_info import describe_earthquake
    from seisblock.records.site import Earthquake, format_clock_time

    if not record["earthquake"]:
        return ""
    values = {key: value for key, value in record["earthquake"].items() if key != "origin_time"}
    origin = record["earthquake"]["origin_time"]
    # in the clock of the beginning of the record
    clock = (record["local_start"] or "UTC").split()[-1]
    time = format_clock_time(datetime.fromisoformat(origin), clock) if origin else ""
    return describe_earthquake(Earthquake(None, **values), time, record["epicentral_distance_km"])


def intensity_summary(tab: Tab) -> str:
    """Return the description of a ground motion given by its intensity."""
    return render("intensity.html", tab=tab, label=_intensity_label(tab), choices=_record_choices(tab))


def _intensity_label(tab: Tab) -> str:
    return gettext(forms.JMA_CHOICES.get(tab.intensity, tab.intensity))


def object_result(tab: Tab, job: Job) -> str:
    """Return probability, sentence, models, figure and links of one object."""
    document = job.document
    is_scenario = job.arguments[0] == "scenario"
    result = _scenario_values(document, _table_rows(job)[0]) if is_scenario else _respond_values(document)
    return render(
        "object.html",
        tab=tab,
        serial=tab.serials["object"],
        **result,
        notes=job.notes,
        has_film=not is_scenario,
        unreported="" if is_scenario else join_list(forms.options_without_report(job.arguments)),
        command=job.command,
        python="" if is_scenario else python_lines(job.arguments),
    )


NO_PROBABILITY: dict[str, Any] = {"probability": None, "text": "", "level": "minor", "rows": (), "models": ()}
"""Values of the result of an object without samples, in one direction or of one model."""


def _respond_values(document: Mapping[str, Any]) -> dict[str, Any]:
    from seisblock.output.text.tables import format_share_interval
    from seisblock.report.text.assessment import headline, name_pile, object_headline

    rows = [row["assessment"] for row in document["results"] if "assessment" in row]
    if not rows:
        return NO_PROBABILITY | {"verdict": gettext("no samples: no probability")}
    # several horizontals: the object falls under either of them
    assessed = document.get("object", rows[0])
    text = (object_headline if "object" in document else headline)(_assessment(assessed))
    return {
        "probability": assessed["overturning_probability"],
        "text": format_percent(assessed["overturning_probability"], "g"),
        # a scan has no block
        "verdict": name_pile(text, document["parameters"].get("block", {}).get("stone_count", 1)),
        "level": LEVELS[assessed["class"]],
        "rows": [
            (
                row["direction"],
                format_percent(row["overturning_probability"], "g"),
                format_share_interval(row["interval"]),
                format_percent(row["moved_probability"], "g"),
                gettext(row["class"]),
            )
            for row in rows
        ],
        "models": [
            (
                gettext(model["name"]),
                gettext("overturns") if model["overturns"] else gettext("stands"),
                "" if model["factor_to_overturn"] is None else f"{model['factor_to_overturn']:.2f}",
            )
            for model in assessed["models"]
        ],
    }


def _assessment(row: Mapping[str, Any]) -> Any:
    from seisblock.studies.assessment import Assessment

    return Assessment(
        row["overturning_probability"], tuple(row["interval"]), row["runs"], row["moved_probability"], (), row["least_factor"],
        row["greatest_factor"], row["predictable_until_s"], row["direction"], row["class"],
    )  # fmt: skip


def _scenario_values(document: Mapping[str, Any], texts: Mapping[str, str]) -> dict[str, Any]:
    from seisblock.output.text.tables import format_share_interval
    from seisblock.report.text.assessment import share_text

    row = document["results"][0]
    if row["failure"]:
        return NO_PROBABILITY | {"verdict": texts["reason"]}
    share = format_percent(row["overturning_probability"], ".3g")
    verdict = gettext(
        "{verdict} ({share}; 95 % interval {interval})",
        verdict=gettext(row["class"]),
        share=share_text(row["class"], share),
        interval=format_share_interval(row["interval"]),
    )
    values = {"probability": row["overturning_probability"], "text": share, "verdict": verdict, "level": LEVELS[row["class"]]}
    return NO_PROBABILITY | values


def python_lines(arguments: tuple[str, ...]) -> str:
    """Return the lines of Python that give the probability of a command ``respond``; empty where its options have none.

    A bundled body without a friction of the user is left out: the command samples around the friction of its file, `assess` around the
    middle of the prior of its kind.
    """
    records, options = forms.split_arguments(arguments[1:])
    if not options.keys() <= PYTHON_OPTIONS or not {"--mu", "--surface"} & options.keys() or (body := _python_body(options)) is None:
        return ""
    if len(records) > 1 and len(list(group_files(records, ReadOptions()))) > 1:
        return ""
    source = list(records) if len(records) > 1 else records[0] if records else DEFAULT_SAMPLE
    reading = "".join(f", {name}={value}" for name, flag in forms.RECORD_FIELDS.items() if (value := _python_value(options, flag)))
    friction = surface(options["--surface"]) if "--surface" in options else None
    values = {
        "mu": options.get("--mu") if friction is None else f"{friction.mu:g}",
        "mu_kinetic": options.get("--mu-kinetic") or (None if friction is None else f"{friction.mu_kinetic:g}"),
        "vertical": {"--vertical": "True", "--no-vertical": "False"}.get(next((flag for flag in options if "vertical" in flag), "")),
        "gravity": options.get("--gravity"),
    }
    keywords = ", ".join(f"{name}={value}" for name, value in values.items() if value is not None)
    lines = [
        "import seisblock",
        "",
        f"record = seisblock.records.Preparation().apply(seisblock.read({source!r}{reading}))  # without the offset of an instrument",
        *body,
        f"print(seisblock.assess(body, record, {keywords}).overturning_probability)",
    ]
    return "\n".join(lines)


def _python_body(options: Mapping[str, str]) -> list[str] | None:
    """Return the lines of Python that make a body; None for an uploaded file, and for a scan, which the command solves in space."""
    if "--block" in options:
        body = forms.find_body(options["--block"])
        return None if body is None or body.width_m is None else [f"body = seisblock.load_block({body.name!r})"]
    if not {"--width", "--height"} <= options.keys():
        return None
    sizes = ", ".join(f"{parse_length(options[flag]):g}" for flag in ("--width", "--height"))
    kind = [f"body = seisblock.bodies.kinds.of_kind(body, {options['--kind']!r})"] if "--kind" in options else []
    return [f"body = seisblock.Block({sizes})", *kind]


def _python_value(options: Mapping[str, str], flag: str) -> str:
    return "" if flag not in options else options[flag] if flag == "--dt" else repr(options[flag])


PYTHON_OPTIONS = frozenset(
    ("--width", "--height", "--kind", "--block", "--mu", "--mu-kinetic", "--surface", "--vertical", "--no-vertical", "--gravity")
) | frozenset(forms.RECORD_FIELDS.values())
"""Options of ``respond`` that :func:`seisblock.assess` has, too."""


def film(tab: Tab, job: Job) -> str:
    """Return the film player."""
    del job
    return render("film_slot.html", tab=tab, serial=tab.serials["film"])


def cemetery_facts(cemetery: Cemetery) -> tuple[tuple[str, int, int], ...]:
    """Return what was recognised of a sheet of gravestones: name of a column, rows with a value, all rows."""
    stones = cemetery.stones
    counts = {
        N_("height over width"): len(stones),
        N_("width"): sum(stone.width is not None for stone in stones),
        N_("overturning observed"): sum(stone.fallen is not None for stone in stones),
        N_("reinforced"): sum(stone.reinforced for stone in stones),
        N_("azimuth"): sum(stone.azimuth_deg is not None for stone in stones),
    }
    return tuple((name, count, len(stones)) for name, count in counts.items() if count)


def survey_result(tab: Tab, job: Job) -> str:
    """Return shaking or rate, table of stones and contingency of a survey."""
    document = job.document
    is_estimate = job.arguments[0] == "infer"
    result = document["results"][0] if is_estimate else document["results"][-1]
    source = result if is_estimate else document
    stones, contingency = source["each_stone"], source["contingency"]
    return render(
        "survey.html",
        tab=tab,
        name=tab.sheets["survey"],
        columns=[(gettext(name), gettext("{count} of {rows} rows", count=count, rows=rows)) for name, count, rows in tab.columns],
        facts=_shaking_facts(result) if is_estimate else _rate_facts(result),
        agreement="" if not contingency else _agreement(contingency),
        contingency=contingency,
        stones=[
            (
                stone["id"],
                "" if stone["width_m"] is None else f"{GAL * stone['width_m']:.3g}",
                "" if stone["height_m"] is None else f"{GAL * stone['height_m']:.3g}",
                _outcome(stone["overturns"]),
                "" if stone["probability"] is None else format_share(stone["probability"]),
                _outcome(stone["observed"]),
                "" if stone["agrees"] is None else gettext("agrees") if stone["agrees"] else gettext("differs"),
            )
            for stone in stones
        ],
        notes=job.notes,
        command=job.command,
    )


def _outcome(overturned: bool | None) -> str:
    return "" if overturned is None else gettext("overturned") if overturned else gettext("remains standing")


def _shaking_facts(result: Mapping[str, Any]) -> list[tuple[str, str]]:
    from seisblock.measures.intensity import reported_intensity

    names = list(dict.fromkeys(gettext(name) for name in result["jma_classes"] if name))
    classes = gettext("{low} to {high}", low=names[0], high=names[1]) if len(names) == 2 else "".join(names)
    intensity = result["jma_intensity"]
    return [
        (gettext("overturning rate"), _rate_text(result["fallen"], result["fallen"] + result["standing"])),
        ("PGA", _with_interval(result["pga_m_s2"], result["pga_interval_m_s2"], "gal")),
        ("PGV", _with_interval(result["pgv_m_s"], result["pgv_interval_m_s"], "kine")),
        (gettext("JMA intensity"), classes if intensity is None else f"{reported_intensity(intensity):.1f} ({classes})"),
        (gettext("class by the surveyors' rule"), gettext(result["jma_class_by_rule"] or "")),
    ]


def _rate_text(fallen: int, stones: int) -> str:
    return gettext("{share} ({fallen} of {stones})", share=format_percent(fallen / stones), fallen=fallen, stones=stones)


def _with_interval(value: float | None, interval: tuple[float | None, float | None], unit: str) -> str:
    """Return an estimate with its 90 % interval, each end of which may be open."""
    from seisblock.output.text.tables import DASH, format_number

    low, high = (DASH if end is None else format_number(GAL * end, 3) for end in interval)
    bounds = gettext("90 % interval {low} to {high}", low=low, high=high)
    return bounds if value is None else f"{format_number(GAL * value, 3)} {unit} ({bounds})"


def _rate_facts(result: Mapping[str, Any]) -> list[tuple[str, str]]:
    low, high = map(format_percent, result["rate_interval"])
    bounds = gettext("95 % interval {low} to {high}", low=low, high=high)
    return [(gettext("overturning rate"), f"{_rate_text(result['fallen'], result['stones'])}; {bounds}")]


def _agreement(contingency: Mapping[str, int]) -> str:
    from seisblock.report.text.stones import agreement_text
    from seisblock.studies.survey.stones import Contingency

    return agreement_text(Contingency(**contingency))


def collection_result(tab: Tab, job: Job) -> str:
    """Return the objects of a collection, worst first, each with its advice."""
    from seisblock.output.text.tables import format_share_interval

    rows = [
        {
            "name": row["body"],
            "level": LEVELS.get(row["class"], "minor"),
            "class": gettext(row["class"] or N_("no result")),
            "overturns": "" if row["overturning_probability"] is None else format_share(row["overturning_probability"]),
            "interval": "" if row["interval"] is None else format_share_interval(row["interval"]),
            "moves": "" if row["moved_probability"] is None else format_share(row["moved_probability"]),
            "advice": texts["reason"] or texts["advice"],
            "has_measures": row["class"] in ("likely overturns", "may overturn"),
        }
        for row, texts in zip(job.document["results"], _table_rows(job), strict=True)
    ]
    return render("collection.html", tab=tab, rows=rows, notes=job.notes, command=job.command)


def _table_rows(job: Job) -> list[dict[str, str]]:
    """Return the rows of the CSV table of a command; its texts are in the language of the job, those of the document in English."""
    with (job.folder / job.outputs["--csv"]).open(encoding="utf-8-sig", newline="") as stream:
        return list(csv.DictReader(stream))


def secure_result(tab: Tab, job: Job) -> str:
    """Return the measures that make an object safe."""
    from seisblock.report.text.secure import LABELS, measure_note, measure_value
    from seisblock.studies.scenario.secure import Measure

    result = job.document["results"][0]
    names = {field.name for field in fields(Measure)}
    measures = [Measure(**{key: value for key, value in row.items() if key in names}) for row in result["measures"]]
    rows = [
        (
            gettext(LABELS[measure.measure]),
            measure_value(measure),
            "" if measure.overturning_probability is None else format_share(measure.overturning_probability),
            measure_note(measure),
        )
        for measure in measures
    ]
    heading = gettext(
        "{body}: overturning probability {now}, target {target}",
        body=body_name(result["body"]),
        now=format_share(result["overturning_probability"]),
        target=format_share(result["target_probability"]),
    )
    return render("secure.html", tab=tab, heading=heading, rows=rows, command=job.command)


def event_result(tab: Tab, job: Job) -> str:
    """Return the map of an event."""
    count = len(job.document["results"])
    return render("event.html", tab=tab, count=count, notes=job.notes, command=job.command)


VIEWS: Mapping[str, Callable[[Tab, Job], str]] = {
    "record": record_summary,
    "object": object_result,
    "film": film,
    "survey": survey_result,
    "collection": collection_result,
    "secure": secure_result,
    "event": event_result,
}
"""View of each kind of job that is shown in the page."""
