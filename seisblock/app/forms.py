"""Values of the forms as arguments of commands; fields of solver options come from the dataclasses of the registry."""

from __future__ import annotations

import csv
import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from seisblock.bodies.friction import SURFACES, pair_name, surface
from seisblock.bodies.kinds import KINDS
from seisblock.bodies.scan.mesh import SUFFIXES
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.core.options import OptionField, option_fields, plain_help
from seisblock.models.respond.options import RespondOptions

OWN_SIZES = "sizes:"
"""Prefix of the choice of an object by its sizes, before its kind."""

FILE = "file"
"""Choice of an object by an uploaded file."""

KIND_LABELS = {
    "block": N_("own sizes: rectangular block"),
    "furniture": N_("own sizes: furniture"),
    "statue": N_("own sizes: statue"),
    "gravestone": N_("own sizes: gravestone"),
}
"""Choices of an object by its sizes."""

JMA_CHOICES = {"5-": N_("5 lower"), "5+": N_("5 upper"), "6-": N_("6 lower"), "6+": N_("6 upper"), "7": "7"}
"""Classes of the JMA intensity of a scenario."""

DEFAULT_INTENSITY = "6+"
"""Scenario of a collection for which none is chosen."""

RECORD_SCENARIO, SURVEY_SHEET, BUNDLED_CEMETERY = "record", "survey", "aoyama.csv"
"""Choices: the record of the first tab as scenario; the sheet of the survey, or the bundled one, at each station of an event."""

UNKNOWN_FRICTION = 0.4
"""Friction of an object for which none is given, as in :data:`seisblock.studies.scenario.assess.UNKNOWN_FRICTION`."""

SCENARIO_TABLE = "object.csv"
"""Table of an object, for a scenario."""

SCENARIO_COLUMNS = {"--block": "body", "--width": "width", "--height": "height", "--kind": "kind", "--mu": "mu", "--surface": "surface"}
SCENARIO_COLUMNS |= {f"--{name.replace('_', '-')}": name for name in ("mu_kinetic", "restitution", "rocking_restitution", "tenon")}
"""Columns of a table of objects by the options of ``respond``."""

SCENARIO_FLAGS = ("--vertical", "--no-vertical", "--gravity")
"""Other options of ``respond`` that ``scenario`` has, too."""

RECORD_FIELDS = {"station": "--station", "units": "--units", "dt": "--dt"}
"""Fields of a record's form with their options."""

REPORT_FLAGS = (*RECORD_FIELDS.values(), "--kind", "--mu", "--mu-kinetic", "--floor", "--gravity")
"""Options of a response that its report has, too."""

BODY_FLAGS = ("--width", "--height", "--block", "--surface")
"""Options of a response that are the body, or its friction, of its report."""

RECORD_UNITS = ("gal", "m/s2", "g")

COVERED = ("mu", "initial", "further_points", "sensitivity")
"""Fields of the options that the form shows elsewhere or not at all."""

FLOOR_PERIOD_S = 0.5
"""Period of a building for which none is given, s."""

SCAN_UNITS, SCAN_AXES = ("m", "cm", "mm", "in", "ft"), ("z", "y", "x", "-z", "-y", "-x")
"""Units and upward axes of a scan, of which a mesh file says nothing; the first of each is the default of the command."""

_NUMBER = re.compile(r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?")


@dataclass(frozen=True)
class BodyOption:
    """Bundled body with its sizes, drawn to scale; None where it has none of its own (a scan, a pile)."""

    name: str
    label: str
    kind: str
    width_m: float | None = None
    height_m: float | None = None
    mu: float | None = None


@cache
def body_options() -> tuple[BodyOption, ...]:
    """Return the bundled bodies."""
    from seisblock.bodies.block import Block
    from seisblock.bodies.body_name import body_name
    from seisblock.bodies.factory import load_block, table_friction
    from seisblock.bodies.toml import read_body_toml
    from seisblock.samples import sample_names

    options = []
    for name in (file.removesuffix(".toml") for file in sample_names("body")):
        table, option = read_body_toml(name), BodyOption(name, body_name(name.replace("_", " ")), _kind_of(name))
        if table["kind"] != "scan":
            body = load_block(name)
            assert isinstance(body, Block)
            mu = table_friction(table, name)[0] if "mu" in table else None
            option = replace(option, label=body_name(body.name), width_m=body.width, height_m=body.height, mu=mu)
        options.append(option)
    return tuple(options)


def _kind_of(name: str) -> str:
    return name if name in KINDS else "statue" if name in ("lantern", "chozusha", "column", "boulder") else "furniture"


def find_body(name: str) -> BodyOption | None:
    """Return a bundled body by name."""
    return next((body for body in body_options() if body.name == name), None)


@dataclass(frozen=True)
class FormField:
    """Field of a form, from the metadata of an option."""

    name: str
    label: str
    unit: str
    flag: str
    is_switch: bool
    placeholder: str


def solver_fields() -> list[FormField]:
    """Return the fields of the options of ``respond``, as their dataclass declares them, in the language of the locale."""
    return [
        _form_field(name, spec, field.default) for name, spec, field in option_fields(RespondOptions) if name not in COVERED and spec.flag
    ]


def _form_field(name: str, spec: OptionField, default: Any) -> FormField:
    default_text = "" if default is MISSING or default is None else f"{default:g}" if isinstance(default, float) else str(default)
    return FormField(
        name, plain_help(gettext(spec.help)).rstrip("."), "" if spec.unit == "1" else spec.unit, spec.flag, "/" in spec.flag, default_text
    )


def solver_arguments(form: Mapping[str, str]) -> list[str]:
    """Return the arguments of the solver's options that were filled in."""
    arguments = []
    for field in solver_fields():
        value = form.get(f"option-{field.name}", "").strip()
        if field.is_switch:
            yes, no = field.flag.split("/")
            arguments += [{"yes": yes, "no": no}[value]] if value in ("yes", "no") else []
        elif value:
            arguments += [field.flag, value]
    return arguments


def length_text(text: str) -> str:
    """Return a length as an option's value; a bare number is in centimetres.

    Examples
    --------
    >>> length_text("45"), length_text(" 1.8 m"), length_text("8sun")
    ('45cm', '1.8 m', '8sun')
    """
    text = plain_text(text)
    return f"{text}cm" if _NUMBER.fullmatch(text) else text


def plain_text(text: str) -> str:
    """Return what was typed without blanks around it, and with half-width letters and digits.

    Examples
    --------
    >>> plain_text(" ０．３"), plain_text("ｓｉｎｅ：３００ｇａｌ＠１．５Ｈｚ"), plain_text("0。5")
    ('0.3', 'sine:300gal@1.5Hz', '0.5')
    """
    return unicodedata.normalize("NFKC", text).replace("\N{IDEOGRAPHIC FULL STOP}", ".").strip()


def _scan_file(form: Mapping[str, str], files: tuple[str, ...]) -> str | None:
    """Return the scan of an object; None where a body's file was uploaded with it, or another object was chosen."""
    if form.get("object", "").strip() != FILE or any(_suffix(name) == ".toml" for name in files):
        return None
    return next((name for name in files if _suffix(name) in SUFFIXES), None)


def _suffix(name: str) -> str:
    return Path(name).suffix.lower()


def _scan_body(scan: str) -> str:
    return f"{Path(scan).stem}.toml"


def scan_arguments(form: Mapping[str, str], files: tuple[str, ...]) -> tuple[str, ...]:
    """Return the command that makes a body of an uploaded scan; empty for other objects."""
    scan = _scan_file(form, files)
    if scan is None:
        return ()
    unit, axis = (form.get(key, "").strip() or choices[0] for key, choices in (("scan-unit", SCAN_UNITS), ("scan-up", SCAN_AXES)))
    options = (*(("--unit", unit) if unit != SCAN_UNITS[0] else ()), *(("--up", axis) if axis != SCAN_AXES[0] else ()))
    return ("body", scan, *options, "--out", _scan_body(scan))


def body_arguments(form: Mapping[str, str], files: tuple[str, ...] = ()) -> list[str]:
    """Return the arguments of an object: its sizes and kind, a bundled body, or an uploaded file.

    A bundled body whose sizes the user changed becomes a body of its kind by sizes.

    Raises
    ------
    ParameterError
        If a file was chosen and none uploaded, or an object by its sizes lacks a size or friction.
    """
    choice, width, height = (form.get(key, "").strip() for key in ("object", "width", "height"))
    mu, surface = form.get("mu", "").strip(), form.get("surface", "").strip()
    friction = [*(["--mu", mu] if mu else []), *(["--surface", surface] if surface else [])]
    if choice == FILE:
        if not files:
            raise ParameterError("no file of an object: choose one, or another object")
        scan = _scan_file(form, files)
        body_file = next((name for name in files if _suffix(name) == ".toml"), files[0])
        return ["--block", body_file if scan is None else _scan_body(scan), *friction]
    body = find_body(choice)
    if body is not None and (width, height) == size_texts(body):
        return ["--block", body.name, *(friction if surface or mu != number_text(body.mu) else [])]
    if not (width and height):
        raise ParameterError("size of the object required: fill in its width and height, or choose a bundled object")
    if not friction:
        raise ParameterError("friction required: fill in the friction coefficient, or choose a pair of materials")
    kind = body.kind if body is not None else choice.removeprefix(OWN_SIZES) or "block"
    return ["--width", length_text(width), "--height", length_text(height), *([] if kind == "block" else ["--kind", kind]), *friction]


def size_texts(body: BodyOption) -> tuple[str, str]:
    """Return width and height of a bundled body as the form shows them, cm."""
    return tuple(number_text(None if size is None else 100.0 * size) for size in (body.width_m, body.height_m))  # type: ignore[return-value]


def number_text(value: float | None) -> str:
    """Return a number for a field of a form, empty for None."""
    return "" if value is None else f"{value:.6g}"


def floor_arguments(form: Mapping[str, str]) -> list[str]:
    """Return the argument of the floor motion; none at the height of the ground."""
    height = form.get("floor", "0").strip() or "0"
    if not _NUMBER.fullmatch(height) or float(height) == 0.0:
        return []
    period = form.get("period", "").strip() or f"{FLOOR_PERIOD_S:g}"
    return ["--floor", f"T={period},height={height}"]


def surface_labels() -> dict[str, str]:
    """Return the pairs of surfaces with their friction coefficients, in the language of the locale."""
    return {pair: f"{pair_name(pair)} (μ {surface.mu:g})" for pair, surface in SURFACES.items()}


def scenario_object(arguments: Sequence[str], folder: Path) -> tuple[str, ...]:
    """Return the arguments of an object in a scenario from those of ``respond``; its values are written to a table in the folder.

    Raises
    ------
    ParameterError
        If a scenario has no such option.
    """
    _, options = split_arguments(tuple(arguments))
    row = {column: options[flag] for flag, column in SCENARIO_COLUMNS.items() if flag in options}
    others = {flag: value for flag, value in options.items() if flag not in SCENARIO_COLUMNS}
    if unknown := [flag for flag in others if flag not in SCENARIO_FLAGS]:
        raise ParameterError("{flags} has no effect with {what}: omit one of them", flags=unknown, what=lazy_gettext("JMA intensity"))
    line = tuple(text for item in others.items() for text in item if text)
    if row.keys() == {"body"}:
        return ("--bodies", row["body"], *line)
    name = Path(row["body"]).stem if "body" in row else gettext("object")
    with (folder / SCENARIO_TABLE).open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream).writerows([("name", *row), (name, *row.values())])
    return ("--bodies", SCENARIO_TABLE, *line)


def report_arguments(line: tuple[str, ...]) -> tuple[str, ...]:
    """Return the command line of the report of a response: record, body, kind, friction and floor."""
    records, options = split_arguments(line[1:])
    body = options.get("--block") or f"{options['--width']}x{options['--height']}"
    pair = surface(options["--surface"]) if "--surface" in options else None
    body_flags = {flag: options[flag] for flag in REPORT_FLAGS if flag in options}
    if pair is not None:
        body_flags = {"--mu": f"{pair.mu:g}", "--mu-kinetic": f"{pair.mu_kinetic:g}", **body_flags}
    return ("report", *records, "--body", body, *(text for item in body_flags.items() for text in item))


def options_without_report(line: tuple[str, ...]) -> list[str]:
    """Return the options of a response that a report does not have.

    Examples
    --------
    >>> options_without_report(("respond", "a.csv", "--width", "45cm", "--mu", "0.3", "--restitution", "0.1", "--no-vertical"))
    ['--restitution 0.1', '--no-vertical']
    """
    _, options = split_arguments(line[1:])
    return [f"{flag} {value}".strip() for flag, value in options.items() if flag not in (*REPORT_FLAGS, *BODY_FLAGS)]


def split_arguments(arguments: tuple[str, ...]) -> tuple[tuple[str, ...], dict[str, str]]:
    """Return the arguments before the first option, and the options with their values (a switch has none)."""
    start = next((number for number, text in enumerate(arguments) if text.startswith("--")), len(arguments))
    options: dict[str, str] = {}
    flag = ""
    for text in arguments[start:]:
        if text.startswith("--"):
            flag = text
            options[flag] = ""
        else:
            options[flag] = text
    return arguments[:start], options


def record_options(form: Mapping[str, str]) -> tuple[str, ...]:
    """Return the options of a record whose files do not state its unit or sampling interval, or hold several stations."""
    values = {flag: form.get(name, "").strip() for name, flag in RECORD_FIELDS.items()}
    return tuple(text for flag, value in values.items() if value for text in (flag, value))


def scenario_arguments(form: Mapping[str, str], record: tuple[str, ...]) -> tuple[str, ...]:
    """Return the arguments of a scenario: a JMA intensity, a PGA with or without a PGV, or the record of the first tab.

    Raises
    ------
    ParameterError
        If the record was chosen and there is none.
    """
    choice, pga, pgv = (form.get(key, "").strip() for key in ("scenario", "pga", "pgv"))
    floor = floor_arguments(form)
    if choice == RECORD_SCENARIO:
        if not record:
            raise ParameterError("no record in the first tab: choose one there, or a JMA intensity here")
        return (*record, *floor)
    if pga or pgv:
        return (*(("--pga", pga) if pga else ()), *(("--pgv", pgv) if pgv else ()), *floor)
    return ("--jma", choice or DEFAULT_INTENSITY, *floor)


def event_arguments(form: Mapping[str, str], survey: str | None) -> tuple[str, ...]:
    """Return the arguments of what stands at each station: a cemetery, or an object with its friction.

    Raises
    ------
    ParameterError
        If the sheet of the survey was chosen and there is none.
    """
    choice, mu = form.get("event-object", "").strip(), form.get("event-mu", "").strip()
    if choice == SURVEY_SHEET:
        if survey is None:
            raise ParameterError("no sheet in the tab of the survey: drop one there, or choose another object here")
        return ("--cemetery", survey)
    if choice == BUNDLED_CEMETERY:
        return ("--cemetery", BUNDLED_CEMETERY)
    body = find_body(choice) or find_body("gravestone")
    assert body is not None
    return ("--block", body.name, *(("--mu", mu or f"{UNKNOWN_FRICTION:g}") if mu or body.mu is None else ()))
