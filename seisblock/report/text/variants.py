"""Text report of several widths, heights or friction coefficients: a column for each combination."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.output.io.history_csv import CsvTable
from seisblock.output.text.tables import DASH, format_share_interval, record_line, side_by_side, styled_line, tilt_ratio_cell
from seisblock.output.units_display import Unit, length_cell, length_unit
from seisblock.report.json.assessment import VARIANT_NAMES
from seisblock.studies.assessment import Assessment, assess_object

Extras = Sequence[Mapping[str, Any]]


def variant_label(variant: Mapping[str, float], *, gal: bool) -> str:
    """Return the values of a variant, lengths in cm or m.

    Examples
    --------
    >>> variant_label({"width": 0.45, "mu": 0.3}, gal=True)
    'B 45 cm, mu 0.3'
    """
    symbols = {"width": "B", "height": "H"}
    unit = Unit(0.01, "cm") if gal else Unit(1.0, "m")
    return ", ".join(
        gettext("mu {mu:g}", mu=value) if name == "mu" else f"{symbols[name]} {value / unit.size:.4g} {unit.name}"
        for name, value in variant.items()
    )


def assess_variant(extras: Extras) -> Assessment | None:
    """Return the assessment of one variant under all directions of a record; None without samples."""
    parts = [extra["assessment"] for extra in extras if "assessment" in extra]
    if not parts:
        return None
    return parts[0].assessment if len(parts) == 1 else assess_object(parts)


def group_variants(responses: Sequence[Response[Any]], extras: Extras) -> list[list[list[tuple[Response[Any], Mapping[str, Any]]]]]:
    """Return the results by record, then by variant, each a list of directions."""
    groups: dict[int, dict[tuple[float, ...], list[tuple[Response[Any], Mapping[str, Any]]]]] = {}
    for response, extra in zip(responses, extras, strict=True):
        by_variant = groups.setdefault(id(response.motion.record), {})
        by_variant.setdefault(tuple(extra["variant"].values()), []).append((response, extra))
    return [list(by_variant.values()) for by_variant in groups.values()]


def tables(responses: Sequence[Response[Any]], extras: Extras, *, gal: bool) -> Iterator[Any]:
    """Yield, per record, a table with a column per variant: the object first, then its directions."""
    for columns in group_variants(responses, extras):
        record = columns[0][0][0].motion.record
        if record is not None:
            yield record_line(record)
        names = [variant_label(column[0][1]["variant"], gal=gal).replace(", ", "\n") for column in columns]
        rows: list[list[str]] = []
        objects = [assess_variant([extra for _, extra in column]) for column in columns]
        if any(objects):
            rows += _assessment_rows(objects)
        shifts = [getattr(response.outcome, "final_displacement_m", None) for column in columns for response, _ in column]
        unit = length_unit(shifts, gal=gal)
        for index, (first, _) in enumerate(columns[0]):
            parts = [column[index] for column in columns]
            outcomes = [response.outcome for response, _ in parts]
            if first.motion.name:
                rows.append([first.motion.name, *[""] * len(parts)])
            if any(objects) and len(columns[0]) > 1:
                shares = [extra["assessment"].assessment.overturning_probability for _, extra in parts]
                rows.append([gettext("  overturns (%)"), *(f"{100.0 * share:.0f}" for share in shares)])
            rows.append(
                [
                    gettext("  tilt over overturning angle"),
                    *(tilt_ratio_cell(o.max_rotation_ratio, overturned=o.overturned) for o in outcomes),
                ]
            )
            if hasattr(outcomes[0], "final_displacement_m"):
                cells = [DASH if o.overturned else length_cell(o.final_displacement_m, unit) for o in outcomes]
                rows.append([gettext("  residual ({unit})", unit=unit.name), *cells])
            if "friction_suffices" in parts[0][1]:
                cells = [gettext("yes") if extra["friction_suffices"] else gettext("no") for _, extra in parts]
                rows.append([gettext("  friction suffices"), *cells])
        yield side_by_side("", ["", *names], rows)
        if any(objects):
            yield styled_line(
                gettext("Parameter variation only (model error not included); tilt and residual displacement: single run"), "dim"
            )


def _assessment_rows(objects: Sequence[Assessment | None]) -> list[list[str]]:
    """Return class, probabilities and interval of each variant."""
    assessed = [item for item in objects if item is not None]
    return [
        [gettext("class"), *(gettext(item.class_) for item in assessed)],
        [gettext("overturns (%)"), *(f"{100.0 * item.overturning_probability:.0f}" for item in assessed)],
        ["  95 %", *(format_share_interval(item.interval) for item in assessed)],
        [gettext("moves (%)"), *(f"{100.0 * item.moved_probability:.0f}" for item in assessed)],
    ]


def csv_columns(responses: Sequence[Response[Any]], extras: Extras) -> CsvTable:
    """Return one row per record, variant and direction, SI."""
    varied = list(extras[0]["variant"])
    shaken = [
        "overturned",
        "max_rotation_ratio",
        *(["final_displacement_m"] if hasattr(responses[0].outcome, "final_displacement_m") else []),
    ]
    assessed = ["overturning_probability", "moved_probability", "class"] if "assessment" in extras[0] else []
    header = ["record", "component", *(VARIANT_NAMES[name] for name in varied), *shaken, *assessed]
    rows = []
    for response, extra in zip(responses, extras, strict=True):
        record = response.motion.record
        row = ["" if record is None else record.station or record.source, response.motion.name, *extra["variant"].values()]
        row += [getattr(response.outcome, name) for name in shaken]
        if assessed:
            part = extra["assessment"].assessment
            row += [part.overturning_probability, part.moved_probability, part.class_]
        rows.append(row)
    return header, rows
