"""Items of [Tsutsui]_: figs. 2 to 4, table 1."""

from __future__ import annotations

import numpy as np

from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.units import GAL, KINE
from seisblock.criteria.gravestones import overturning_level
from seisblock.criteria.overturning import tsutsui_sine_velocity, tsutsui_velocity
from seisblock.paper.item import Answer, Inputs, Item, ItemColumn, Panel, Paper, Series, Value
from seisblock.studies.report.models import body_models
from seisblock.studies.survey.overturning_rate import FREQUENCIES
from seisblock.validation.tsutsui import GRAVITY, TABLE_1, WIDTHS, exact_step, printed_velocity

RATIO = 4.0
"""h/b of figs. 2 to 4."""

DURATIONS = np.linspace(0.02, 2.0, 100)
"""Durations of the acceleration, s."""


def _sizes(inputs: Inputs) -> list[tuple[float, float]]:
    """Return width and height of the blocks, m: those of the paper, or the user's."""
    if inputs.body is None:
        return [(width, RATIO * width) for width in WIDTHS]
    block = body_models(inputs.body).block
    return [(block.width, block.height)]


def _source(inputs: Inputs) -> str:
    return N_("blocks of the paper: lambda 1/4, widths 1, 2.5 and 5 m") if inputs.body is None else N_("own record or body")


def _limits(inputs: Inputs) -> Answer:
    """Return fig. 2 and 3: acceleration, and velocity, that overturn against the duration."""
    columns = (
        ItemColumn("width_m", N_("b (m)")),
        ItemColumn("lambda", N_("b/h")),
        ItemColumn("velocity_m_s", N_("velocity by eq. (2) (kine)"), KINE),
        ItemColumn("velocity_eq4_m_s", N_("velocity by eq. (4) (kine)"), KINE),
        ItemColumn("exact_m_s", N_("exact velocity step (kine)"), KINE),
        ItemColumn("threshold_m_s2", N_("threshold of rocking (gal)"), GAL),
        ItemColumn("longest_s", N_("duration at the threshold (s)")),
    )
    rows: list[tuple[Value, ...]] = []
    for width, height in _sizes(inputs):
        velocity, threshold = tsutsui_velocity(width, height, GRAVITY), GRAVITY * width / height
        slower = tsutsui_velocity(width, height, GRAVITY, cosine=True)
        rows.append((width, width / height, velocity, slower, exact_step(width, height), threshold, velocity / threshold))
    return Answer(columns, rows, source=_source(inputs))


def _figure_2(inputs: Inputs) -> Answer:
    """Return fig. 2: acceleration against duration, no line below lambda g."""
    answer, series = _limits(inputs), []
    for row in answer.rows:
        width, velocity, threshold = (float(row[index] or 0.0) for index in (0, 2, 5))
        time = DURATIONS[velocity / threshold >= DURATIONS]
        series.append(Series(lazy_gettext("b = {width:g} m", width=width), time, velocity / time / GAL))
    levels = tuple(dict.fromkeys((round(float(row[5] or 0.0) / GAL, 9), "λg") for row in answer.rows))
    panel = Panel(N_("duration (s)"), N_("acceleration (gal)"), tuple(series), y_range=(0.0, 1000.0), levels=levels)
    return Answer(answer.columns, answer.rows, (panel,), answer.source)


def _figure_3(inputs: Inputs) -> Answer:
    """Return fig. 3: velocity against duration, with the line of the threshold."""
    answer, series = _limits(inputs), []
    for row in answer.rows:
        width, velocity, longest = (float(row[index] or 0.0) for index in (0, 2, 6))
        series.append(Series(lazy_gettext("b = {width:g} m", width=width), [0.0, longest], [velocity / KINE] * 2))
    longest, threshold = max(float(row[6] or 0.0) for row in answer.rows), float(answer.rows[0][5] or 0.0)
    series.append(Series(N_("λg times duration"), [0.0, longest], [0.0, threshold * longest / KINE], "dashed"))
    return Answer(answer.columns, answer.rows, (Panel(N_("duration (s)"), N_("velocity (kine)"), tuple(series)),), answer.source)


def _figure_4(inputs: Inputs) -> Answer:
    """Return fig. 4: acceleration of the criterion of [Furukawa2009]_ times the period, against the period."""
    ratio = RATIO if inputs.body is None else _sizes(inputs)[0][1] / _sizes(inputs)[0][0]
    columns = (
        ItemColumn("frequency_hz", N_("frequency (Hz)")),
        ItemColumn("period_s", N_("period (s)")),
        ItemColumn("acceleration_m_s2", N_("acceleration by eq. (9) (gal)"), GAL),
        ItemColumn("product_m_s", N_("acceleration times period (kine)"), KINE),
    )
    rows = [(f, 1.0 / f, float(overturning_level(f)) / ratio, float(overturning_level(f)) / ratio / f) for f in reversed(FREQUENCIES)]
    period = np.linspace(1.0 / 3.0, 2.0, 100)
    curve = overturning_level(1.0 / period) / ratio * period / KINE
    points = Series(N_("frequencies of the criterion"), [row[1] for row in rows], [row[3] / KINE for row in rows], "points")
    panel = Panel(N_("period (s)"), N_("acceleration times period (kine)"), (Series(N_("eq. (9)"), period, curve), points))
    return Answer(
        columns, rows, (panel,), N_("eq. (9) of Furukawa et al. (2009) at b/h = 1/4") if inputs.body is None else N_("own record or body")
    )


def _table_1(_: Inputs) -> Answer:
    """Return table 1: velocities by eqs. (3) and (4) beside the printed ones."""
    columns = (
        ItemColumn("height_over_width", N_("h/b")),
        ItemColumn("acceleration_m_s2", N_("acceleration (gal)"), GAL),
        ItemColumn("frequency_hz", N_("frequency (Hz)")),
        ItemColumn("v1_printed_m_s", N_("v1 printed (kine)"), KINE),
        ItemColumn("v1_m_s", N_("v1 by eq. (3) (kine)"), KINE),
        ItemColumn("v2_printed_m_s", N_("v2 printed (kine)"), KINE),
        ItemColumn("v2_m_s", N_("v2 by eq. (4) (kine)"), KINE),
    )
    rows = [(ratio, a, f, v1, tsutsui_sine_velocity(a, f), v2, printed_velocity(ratio)) for ratio, a, f, v1, v2 in TABLE_1]
    ratios = [row[0] for row in rows]
    series = tuple(
        Series(heading, ratios, [row[index] / KINE for row in rows], kind)  # type: ignore[arg-type]
        for heading, index, kind in (
            ("v1", 4, "line"),
            (N_("v1 printed"), 3, "points"),
            ("v2", 6, "dashed"),
            (N_("v2 printed"), 5, "points"),
        )
    )
    return Answer(columns, rows, (Panel("h/b", N_("velocity (kine)"), series),), N_("values of the paper"))


PAPER = Paper(
    "[Tsutsui]_",
    "tsutsui",
    (
        Item("fig2", N_("Acceleration that overturns against its duration"), _figure_2, ("body",), ("eq. (2)",)),
        Item("fig3", N_("Velocity that overturns against the duration of the acceleration"), _figure_3, ("body",), ("eq. (2)", "eq. (4)")),
        Item("fig4", N_("Criterion for gravestones as acceleration times period"), _figure_4, ("body",)),
        Item("table1", N_("Overturning velocities of three blocks"), _table_1),
    ),
)
"""Items of the paper."""
