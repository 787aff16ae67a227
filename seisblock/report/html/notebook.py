"""Notebook display of values: numbers as tables, and a figure."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from seisblock.core._display import PlotMixin, item_repr
from seisblock.core.i18n import gettext, join_list
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.measures import RecordMeasures, ResponseSpectrum
from seisblock.output.figures.fonts import build_localized
from seisblock.output.figures.solver import response_figure
from seisblock.output.figures.svg import embed_figure
from seisblock.output.json.encode import to_builtins, to_json
from seisblock.output.json.units import split_unit
from seisblock.output.templating import render_page
from seisblock.output.text.solver import describe
from seisblock.output.text.tables import format_number
from seisblock.output.units_display import acceleration_unit, length_unit, velocity_unit
from seisblock.records import Motion, Record
from seisblock.report.figures.probability import share_colour
from seisblock.report.json.registry import response_document
from seisblock.report.text.assessment import headline, predictability_text
from seisblock.studies.assessment import Assessment
from seisblock.studies.fragility.results import FragilityStudy
from seisblock.studies.rocking.spectrum import RockingSpectrum
from seisblock.studies.solvers import solver_studies

if TYPE_CHECKING:
    from matplotlib.figure import Figure


SEPARATOR = " · "
MEASURE_KEYS = ("components", "jma_intensity", "jma_class")


def plot(value: Any) -> Figure:
    """Return the figure of a response, record, motion, spectrum or fragility study, in the language of the locale.

    Parameters
    ----------
    value : Response, Record, Motion, ResponseSpectrum, RockingSpectrum or FragilityStudy

    Raises
    ------
    ParameterError
        If the model has no figure.
    """
    figure = build_localized(lambda: _figure(value))
    # notebooks display a Figure only where pyplot has registered a formatter; pyplot is not imported here
    vars(figure)["_repr_png_"] = lambda: _png(figure)
    return figure


def _png(figure: Figure) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    return buffer.getvalue()


def json_text(response: Response[Any]) -> str:
    """Return the JSON document of a response, the text of the command's ``--json`` for one direction."""
    return to_json(response_document(response))


def html(value: Any) -> str:
    """Return the HTML of a value for a notebook: title, numbers, warnings, figure."""
    title, numbers, warnings = _summary(value)
    return render_page(
        "notebook.html",
        title,
        verdict=describe(value) if isinstance(value, Response) else predictability_text(value) if isinstance(value, Assessment) else "",
        note=gettext("Single run; assess(body, record) gives the overturning probability.") if _has_probability(value) else "",
        colour=share_colour(value.overturning_probability) if isinstance(value, Assessment) else "",
        tables=list(_tables(numbers)),
        warnings=[gettext(text) for text in warnings],
        picture=embed_figure(build_localized(lambda: _figure(value)), title) if isinstance(value, PlotMixin) else None,
    )


def _has_probability(value: Any) -> bool:
    """Return whether a value is a single run of a model with samples."""
    return isinstance(value, Response) and solver_studies(value.model).sample is not None


def _figure(value: Any) -> Figure:
    if isinstance(value, Response):
        return response_figure([value])
    from seisblock.report.figures import input_panels

    if isinstance(value, Record):
        return input_panels.record_figure(value)
    if isinstance(value, Motion):
        return input_panels.motion_figure(value)
    if isinstance(value, FragilityStudy):
        from seisblock.report.figures.fragility import figure

        return figure(value)
    return (
        input_panels.response_spectrum_figure(value) if isinstance(value, ResponseSpectrum) else input_panels.rocking_spectrum_figure(value)
    )


def _summary(item: Any) -> tuple[str, dict[str, Any], Sequence[str]]:
    """Return title, numbers by JSON key, and warnings of a value."""
    if isinstance(item, Response):
        parts = (item.model, item.motion.name, gettext(str(getattr(item.body, "name", ""))))
        return SEPARATOR.join(part for part in parts if part), to_builtins(item.outcome), item.warnings
    if isinstance(item, Record):
        numbers = {"samples": item.samples, "dt_s": item.dt, "format": item.format}
        peaks = [{"component": part.code, "pga_m_s2": _peak(part.acceleration)} for part in item.components]
        return item.station or item.source or gettext("record"), {**numbers, "components": peaks}, [flag.message for flag in item.doubts]
    if isinstance(item, Motion):
        numbers = {"samples": item.acceleration.shape[1], "dt_s": item.dt, "start_s": item.start_s, "pga_m_s2": _peak(item.horizontal)}
        return SEPARATOR.join(part for part in (item.record.station if item.record else "", item.name) if part), numbers, ()
    if isinstance(item, RecordMeasures):
        return (
            "JMA " + (item.jma_class or "-"),
            {key: value for key, value in to_builtins(item).items() if key in MEASURE_KEYS},
            item.warnings,
        )
    if isinstance(item, ResponseSpectrum):
        highest = int(item.sa_m_s2.argmax())
        return "Sₐ", {"damping": item.damping, "sa_m_s2": float(item.sa_m_s2[highest]), "period_s": float(item.period_s[highest])}, ()
    if isinstance(item, FragilityStudy):
        keys = ("body", "limit", "median", "unit", "beta", "records")
        curves = [{key: value for key, value in to_builtins(curve).items() if key in keys} for curve in item.curves]
        return item.measure.label, {"solver": item.solver, "method": item.method, "curves": curves}, item.notes
    if isinstance(item, Assessment):
        return headline(item), {key.rstrip("_"): number for key, number in to_builtins(item).items()}, ()
    if isinstance(item, RockingSpectrum):
        return "2R, α", {"overturned": int(item.overturned.sum()), "blocks": item.overturned.size}, ()
    return type(item).__name__, {part.name: _plain(getattr(item, part.name)) for part in fields(item) if part.repr}, ()


def _plain(value: Any) -> Any:
    """Return a field of any value for a table: numbers and texts as they are, everything else in short."""
    return value if value is None or isinstance(value, (bool, int, float, str)) else item_repr(value)


def _peak(row: FloatArray) -> float:
    return float(np.abs(row).max())


def _tables(outcome: Mapping[str, Any]) -> Iterator[tuple[str, list[list[str]]]]:
    """Yield the scalar values of an outcome as a table, then one named table per list of mappings."""
    flat = {key: value for key, value in outcome.items() if not isinstance(value, (Mapping, list)) or _fits_cell(value)}
    yield "", [_row(key, [value]) for key, value in flat.items()]
    for key, value in outcome.items():
        if isinstance(value, list) and value and all(isinstance(entry, Mapping) for entry in value):
            names = [
                name
                for name in dict.fromkeys(name for entry in value for name in entry)
                if not any(isinstance(entry.get(name), Mapping) for entry in value)
            ]
            rows = [_row(name, [entry.get(name) for entry in value[:MAX_COLUMNS]]) for name in names]
            table_name = key.replace("_", " ")
            is_truncated = len(value) > MAX_COLUMNS
            yield (
                gettext("{things} ({shown} of {all})", things=table_name, shown=MAX_COLUMNS, all=len(value))
                if is_truncated
                else table_name,
                rows,
            )


MAX_COLUMNS, MAX_ENTRIES = 8, 12
"""Columns of a table, and entries of a cell, at most."""


def _fits_cell(value: Any) -> bool:
    """Return True if a value is a list of plain values short enough for a cell."""
    return isinstance(value, list) and len(value) <= MAX_ENTRIES and not any(isinstance(entry, (Mapping, list)) for entry in value)


def _row(key: str, values: Sequence[Any]) -> list[str]:
    """Return a table row: heading with display unit from a JSON key, and its values in that unit."""
    name, unit = split_unit(key)
    size, unit_name = _display_unit(unit, values) if key not in ENERGIES else (1.0, unit)
    words = name.replace("_", " ")
    heading = f"{words} ({_superscript(unit_name)})" if unit_name else words
    return [heading, *(_cell(_in_unit(value, size)) for value in values)]


ENERGIES = ("arias_m_s",)
"""Keys with the unit of a velocity that are not velocities, kept in m/s."""


def _display_unit(unit: str, values: Sequence[Any]) -> tuple[float, str]:
    """Return size in SI and name of the display unit; only accelerations, velocities and lengths are converted."""
    if unit == "m/s^2":
        return acceleration_unit(gal=True)
    if unit == "m/s":
        return velocity_unit(gal=True)
    if unit == "m":
        flat = [item for value in values for item in (value if isinstance(value, list) else [value])]
        return length_unit((item for item in flat if isinstance(item, float)), gal=True)
    return 1.0, unit


def _in_unit(value: Any, size: float) -> Any:
    """Return a value, or nested lists of values, divided by the size of a unit."""
    if isinstance(value, list):
        return [_in_unit(item, size) for item in value]
    return value / size if isinstance(value, float) and size != 1.0 else value


def _superscript(unit: str) -> str:
    """Return a unit with superscript exponents."""
    return unit.replace("^2", "²").replace("^3", "³")


def _cell(value: Any) -> str:
    if isinstance(value, list):
        return join_list(_cell(entry) for entry in value) or "-"
    return gettext(value) if isinstance(value, str) and value else "-" if value in ("", None) else format_number(value)
