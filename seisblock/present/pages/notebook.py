"""What a value shows of itself in a notebook: its numbers as a table, and its figure."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from seisblock.measures import RecordMeasures, ResponseSpectrum
from seisblock.present.documents.units import unit_of
from seisblock.present.documents.write import plain
from seisblock.present.faces import figure_of, verdict_of
from seisblock.present.figures.embed import picture
from seisblock.present.figures.fonts import drawn
from seisblock.present.page import page
from seisblock.present.scales import acceleration_unit, length_unit, velocity_unit
from seisblock.present.text.tables import number
from seisblock.records import Motion, Record
from seisblock.results import Response
from seisblock.studies.fragility.answer import FragilityStudy
from seisblock.typing import FloatArray
from seisblock.words import listed, tell

if TYPE_CHECKING:
    from matplotlib.figure import Figure


SEPARATOR = " · "
MEASURED = ("components", "jma_intensity", "jma_class")


def plot(shown: Any) -> Figure:
    """Return the figure of a response, a record, a motion or a spectrum, in the language of the locale; a notebook shows it.

    Parameters
    ----------
    shown : Response, Record, Motion, ResponseSpectrum, RockingSpectrum or FragilityStudy

    Raises
    ------
    ParameterError
        If the model has no figure.
    """
    figure = drawn(lambda: _figure(shown))
    # a notebook asks what it shows for its picture; pyplot, which would teach it Figures, is not used here
    vars(figure)["_repr_png_"] = lambda: _png(figure)
    return figure


def _png(figure: Figure) -> bytes:
    """Return a figure as .png."""
    held = io.BytesIO()
    figure.savefig(held, format="png")
    return held.getvalue()


def html(shown: Any) -> str:
    """Return a value as a notebook shows it: what it is about, its numbers, its warnings, its figure."""
    title, numbers, warnings = _said(shown)
    return page(
        "notebook.html",
        title,
        verdict=verdict_of(shown) if isinstance(shown, Response) else "",
        tables=list(_tables(numbers)),
        warnings=[tell(text) for text in warnings],
        picture=None if isinstance(shown, RecordMeasures) else picture(drawn(lambda: _figure(shown)), title),
    )


def _figure(shown: Any) -> Figure:
    """Return the figure of a value."""
    if isinstance(shown, Response):
        return figure_of([shown])
    from seisblock.present.figures import inputs

    if isinstance(shown, Record):
        return inputs.record_figure(shown)
    if isinstance(shown, Motion):
        return inputs.motion_figure(shown)
    if isinstance(shown, FragilityStudy):
        from seisblock.present.figures.fragility import figure

        return figure(shown)
    return inputs.response_spectrum_figure(shown) if isinstance(shown, ResponseSpectrum) else inputs.rocking_spectrum_figure(shown)


def _said(shown: Any) -> tuple[str, dict[str, Any], Sequence[str]]:
    """Return the title of a value, its numbers under the names of keys, and its warnings."""
    if isinstance(shown, Response):
        parts = (shown.model, shown.motion.name, tell(str(getattr(shown.body, "name", ""))))
        return SEPARATOR.join(part for part in parts if part), plain(shown.outcome), shown.warnings
    if isinstance(shown, Record):
        numbers = {"samples": shown.samples, "dt_s": shown.dt, "format": shown.format}
        peaks = [{"component": part.code, "pga_m_s2": _peak(part.acceleration)} for part in shown.components]
        return shown.station or shown.source or tell("record"), {**numbers, "components": peaks}, [doubt.message for doubt in shown.doubts]
    if isinstance(shown, Motion):
        numbers = {"samples": shown.acceleration.shape[1], "dt_s": shown.dt, "start_s": shown.start_s, "pga_m_s2": _peak(shown.horizontal)}
        return SEPARATOR.join(part for part in (shown.record.station if shown.record else "", shown.name) if part), numbers, ()
    if isinstance(shown, RecordMeasures):
        return "JMA " + (shown.jma_class or "-"), {key: value for key, value in plain(shown).items() if key in MEASURED}, shown.warnings
    if isinstance(shown, ResponseSpectrum):
        highest = int(shown.sa_m_s2.argmax())
        return "Sₐ", {"damping": shown.damping, "sa_m_s2": float(shown.sa_m_s2[highest]), "period_s": float(shown.period_s[highest])}, ()
    if isinstance(shown, FragilityStudy):
        keys = ("body", "limit", "median", "unit", "beta", "records")
        curves = [{key: value for key, value in plain(curve).items() if key in keys} for curve in shown.curves]
        return shown.measure.label, {"solver": shown.solver, "method": shown.method, "curves": curves}, shown.notes
    return "2R, α", {"overturned": int(shown.overturned.sum()), "blocks": shown.overturned.size}, ()


def _peak(row: FloatArray) -> float:
    """Return the largest absolute value."""
    return float(np.abs(row).max())


def _tables(outcome: Mapping[str, Any]) -> Iterator[tuple[str, list[list[str]]]]:
    """Yield the numbers of an outcome, then a table with its name for each list of things in it."""
    flat = {key: value for key, value in outcome.items() if not isinstance(value, (Mapping, list)) or _is_short(value)}
    yield "", [_row(key, [value]) for key, value in flat.items()]
    for key, value in outcome.items():
        if isinstance(value, list) and value and all(isinstance(entry, Mapping) for entry in value):
            names = [name for name, one in value[0].items() if not isinstance(one, Mapping)]
            rows = [_row(name, [entry.get(name) for entry in value[:MOST_COLUMNS]]) for name in names]
            told = key.replace("_", " ")
            more = len(value) > MOST_COLUMNS
            yield tell("{things}: {shown} of {all}", things=told, shown=MOST_COLUMNS, all=len(value)) if more else told, rows


MOST_COLUMNS, MOST_ENTRIES = 8, 12
"""How many things of a list a table shows."""


def _is_short(value: Any) -> bool:
    """Whether a list of plain values fits a cell."""
    return isinstance(value, list) and len(value) <= MOST_ENTRIES and not any(isinstance(entry, (Mapping, list)) for entry in value)


def _row(key: str, values: Sequence[Any]) -> list[str]:
    """Return a key as words, and its values, in the unit in which people see them."""
    name, unit = unit_of(key)
    size, shown = _shown(unit, values) if key not in ENERGIES else (1.0, unit)
    words = name.replace("_", " ")
    heading = f"{words} ({_superscript(shown)})" if shown else words
    return [heading, *(_cell(_in_unit(value, size)) for value in values)]


ENERGIES = ("arias_m_s",)
"""What has the unit of a velocity and is none."""


def _shown(unit: str, values: Sequence[Any]) -> tuple[float, str]:
    """Return what one of the unit shown is worth, and its name; only accelerations, velocities and lengths have one of their own."""
    if unit == "m/s^2":
        return acceleration_unit(gal=True)
    if unit == "m/s":
        return velocity_unit(gal=True)
    if unit == "m":
        flat = [one for value in values for one in (value if isinstance(value, list) else [value])]
        return length_unit((one for one in flat if isinstance(one, float)), gal=True)
    return 1.0, unit


def _in_unit(value: Any, size: float) -> Any:
    """Return a value, or each of several, in a unit."""
    if isinstance(value, list):
        return [_in_unit(one, size) for one in value]
    return value / size if isinstance(value, float) and size != 1.0 else value


def _superscript(unit: str) -> str:
    """Return a unit with raised powers."""
    return unit.replace("^2", "²").replace("^3", "³")


def _cell(value: Any) -> str:
    """Return a value as text."""
    if isinstance(value, list):
        return listed(_cell(entry) for entry in value) or "-"
    return tell(value) if isinstance(value, str) and value else "-" if value in ("", None) else number(value)
