"""Items of [Furukawa2009]_: figs. 5 to 8, 10, 13 to 20, tables 3 to 6."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.units import GAL, KINE
from seisblock.criteria.gravestones import DOWELLED, PLAIN, GravestoneFit, overturning_level, overturning_ratio, predict
from seisblock.criteria.overturning import housner_acceleration, housner_acceleration_as_printed
from seisblock.criteria.pulses import half_sine_ratio
from seisblock.measures import Conventions, measure
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.paper.item import Answer, Inputs, Item, ItemColumn, Panel, Paper, Series, Value
from seisblock.readers import read
from seisblock.records import Record, motion_of
from seisblock.studies.gravestone_criterion import RATIOS
from seisblock.studies.report.models import body_models
from seisblock.studies.survey.overturning_rate import CURVE_PGA, FREQUENCIES, overturning_rate, rate_curve
from seisblock.studies.survey.station_table import SurveyedStation, read_stations
from seisblock.validation.furukawa import GRAVITY_GAL, LEVELS, RATIO, SURVEYS, TABLE_3, TABLE_4, TABLE_5

WIDTH = 0.242
"""Width of the sao in fig. 8, m."""

PGAS = np.linspace(100.0, 1300.0, 121)
"""Accelerations of the curves, gal."""

OWN = N_("own record or body")
FORMULA = N_("formula of the paper")
STONES = N_("aoyama.csv, reconstructed from table 6 (the survey is not printed)")
PRINTED = N_("values of the paper")
RECORDINGS = N_(
    "bundled El Centro 1940 and Hanmer Springs 2016 (paper: four records that may not be passed on), rigid block on worn edges instead of "
    "discrete elements"
)
PGA_LABEL, RATIO_LABEL, RATE_LABEL = N_("PGA (gal)"), "H/B (1)", N_("overturning rate (1)")


def _curves(fit: GravestoneFit, static: bool, inputs: Inputs) -> Answer:
    """Return figs. 5, 7 and 13: smallest H/B that overturns against PGA for six frequencies, fig. 7 with the static curve."""
    levels = {f: float(overturning_level(f, fit)) for f in FREQUENCIES}
    curve_pga = (200.0, 400.0, 600.0, 800.0, 1000.0)
    columns = (
        ItemColumn("frequency_hz", N_("frequency (Hz)")),
        ItemColumn("level_m_s2", N_("a(f) (gal)"), GAL),
        *(ItemColumn(f"ratio_at_{pga:.0f}_gal", lazy_gettext("H/B at {pga:.0f} gal", pga=pga)) for pga in curve_pga),
    )
    rows: list[tuple[Value, ...]] = [(f, level, *(level / (pga * GAL) for pga in curve_pga)) for f, level in levels.items()]
    series = [Series(f"{f:g} Hz", PGAS, level / (PGAS * GAL)) for f, level in levels.items()]
    if static:
        rows.append((N_("static, g B/H"), GRAVITY_GAL * GAL, *(GRAVITY_GAL / pga for pga in curve_pga)))
        series.append(Series(N_("static, eq. (2)"), PGAS, GRAVITY_GAL / PGAS, "dashed"))
    panel = Panel(PGA_LABEL, RATIO_LABEL, tuple(series), y_range=(0.0, 7.0))
    return Answer(columns, rows, (panel,), FORMULA if inputs.body is None else OWN)


def _figure_6(_: Inputs) -> Answer:
    """Return fig. 6: a(f) of eqs. (9) and (10)."""
    columns = (
        ItemColumn("frequency_hz", N_("frequency (Hz)")),
        ItemColumn("plain_m_s2", N_("a(f), eq. (9) (gal)"), GAL),
        ItemColumn("dowelled_m_s2", N_("a(f), eq. (10) (gal)"), GAL),
    )
    rows = [(f, float(overturning_level(f)), float(overturning_level(f, DOWELLED))) for f in FREQUENCIES]
    grid = np.linspace(0.0, 3.0, 121)
    series = (
        Series(N_("eq. (9)"), grid, overturning_level(grid) / GAL),
        Series(N_("eq. (10)"), grid, overturning_level(grid, DOWELLED) / GAL, "dashed"),
    )
    return Answer(columns, rows, (Panel(N_("frequency (Hz)"), N_("a(f) (gal)"), series),), FORMULA)


def _figure_8(inputs: Inputs) -> Answer:
    """Return fig. 8: Housner's criterion for the width of the sao beside eq. (9)."""
    width = WIDTH if inputs.body is None else body_models(inputs.body).block.width
    columns = (
        ItemColumn("frequency_hz", N_("frequency (Hz)")),
        ItemColumn("criterion_m_s2", N_("eq. (9) at H/B 2.6 (gal)"), GAL),
        ItemColumn("printed_m_s2", N_("eq. (6), printed second form (gal)"), GAL),
        ItemColumn("first_m_s2", N_("eq. (6), first form (gal)"), GAL),
        ItemColumn("exact_m_s2", N_("half sine, exact (gal)"), GAL),
    )
    rows: list[tuple[Value, ...]] = []
    heights = np.linspace(0.8, 7.0, 125) * width
    series = []
    for f in FREQUENCIES:
        block = Block(width, RATIO * width)
        exact = GRAVITY_GAL * GAL * block.slenderness * half_sine_ratio(2.0 * np.pi * f / block.frequency_parameter(GRAVITY_GAL * GAL))
        rows.append(
            (
                f,
                float(overturning_level(f)) / RATIO,
                housner_acceleration_as_printed(width, RATIO * width, f, GRAVITY_GAL * GAL),
                housner_acceleration(block.slenderness, block.frequency_parameter(GRAVITY_GAL * GAL), f, GRAVITY_GAL * GAL),
                exact,
            )
        )
        accelerations = [housner_acceleration_as_printed(width, height, f, GRAVITY_GAL * GAL) / GAL for height in heights]
        series.append(Series(f"{f:g} Hz", accelerations, heights / width))
    panel = Panel(PGA_LABEL, RATIO_LABEL, tuple(series), x_range=(0.0, 1300.0), y_range=(0.0, 7.0))
    return Answer(columns, rows, (panel,), FORMULA if inputs.body is None else OWN)


def _records(inputs: Inputs) -> list[tuple[str, Record, str]]:
    """Return name, record and component of the records of fig. 10 and table 3."""
    if not inputs.records:
        return [(N_("El Centro"), read("elcentro_1940_ns"), "NS"), (N_("Hanmer Springs"), read("hanmer_springs_2016"), "10")]
    return [
        (f"{record.station or Path(record.source).name} {name}".strip(), record, name)
        for record in inputs.records
        for name in inputs.component or [component.code for component in record.horizontals]
    ]


def _figure_10(inputs: Inputs) -> Answer:
    """Return fig. 10: smallest H/B that overturns under scaled records beside eq. (9)."""
    width = WIDTH if inputs.body is None else body_models(inputs.body).block.width
    columns = (
        ItemColumn("record", N_("record")),
        ItemColumn("frequency_hz", N_("equivalent frequency (Hz)")),
        ItemColumn("pga_m_s2", N_("PGA (gal)"), GAL),
        ItemColumn("ratio", N_("smallest H/B that overturns")),
        ItemColumn("criterion", N_("eq. (9) at this frequency")),
    )
    rows: list[tuple[Value, ...]] = []
    series = [Series(f"{f:g} Hz", PGAS, float(overturning_level(f)) / (PGAS * GAL), "dotted") for f in FREQUENCIES]
    options = RockOptions(gravity=GRAVITY_GAL * GAL, vertical=False)
    blocks = [(ratio, Block(width, ratio * width).with_wear(0.1)) for ratio in RATIOS]
    for name, record, component in _records(inputs):
        motion = motion_of(record, component)
        frequency = _frequencies(record, component)[0]
        peak = float(np.abs(motion.horizontal).max())
        points: list[tuple[float, float]] = []
        for pga in np.arange(100.0, 1001.0, 100.0):
            scaled = motion.horizontal * (pga * GAL / peak)
            scaled_motion = type(motion).from_arrays(scaled, motion.dt)
            ratio = next((r for r, block in blocks if rock_verdict(block, scaled_motion, options=options).overturned), None)
            rows.append((name, frequency, pga * GAL, ratio, None if frequency is None else float(overturning_ratio(pga * GAL, frequency))))
            if ratio is not None:
                points.append((float(pga), ratio))
        series.append(Series(name, [x for x, _ in points], [y for _, y in points], "points"))
    panel = Panel(PGA_LABEL, RATIO_LABEL, tuple(series), y_range=(0.0, 7.0))
    return Answer(columns, rows, (panel,), RECORDINGS if not inputs.records else OWN)


def _frequencies(record: Record, component: str) -> tuple[float | None, float | None, float | None]:
    """Return the equivalent frequencies of methods 1 to 3, Hz ([Furukawa2009]_ section 3(5)e)."""
    values = measure(record, (component,), conventions=Conventions()).components[0].equivalent_frequency_hz
    return values.pga_pgv, values.fourier, values.pulse_width


def _table_3(inputs: Inputs) -> Answer:
    """Return table 3: equivalent frequencies by three methods."""
    columns = (
        ItemColumn("record", N_("record")),
        ItemColumn("pga_pgv_hz", N_("1: PGA/(2π PGV) (Hz)")),
        ItemColumn("fourier_hz", N_("2: Fourier (Hz)")),
        ItemColumn("pulse_hz", N_("3: pulse width (Hz)")),
    )
    rows: list[tuple[Value, ...]] = []
    if not inputs.records:
        rows = [(lazy_gettext("{name} (printed)", name=lazy_gettext(name)), *values) for name, values in TABLE_3.items()]
    rows += [(name, *_frequencies(record, component)) for name, record, component in _records(inputs)]
    series = tuple(
        Series(columns[i].heading, range(1, len(rows) + 1), [float(row[i] or np.nan) for row in rows], "points")  # type: ignore[arg-type]
        for i in (1, 2, 3)
    )
    panel = Panel(
        N_("record"), N_("equivalent frequency (Hz)"), series, ticks=tuple((i + 1.0, _name(row[0])) for i, row in enumerate(rows))
    )
    return Answer(
        columns,
        rows,
        (panel,),
        OWN if inputs.records else N_("printed values; the four records may not be passed on: two bundled ones below"),
    )


def _name(value: Value) -> str:
    """Return the name in a cell, to be translated later."""
    return value if isinstance(value, str) else str(value)


def _cell_name(direction: Value, level: Value) -> str:
    """Return direction and intensity of a row of tables 4 and 5, to be translated later."""
    return lazy_gettext("{direction} {level}", direction=_name(direction), level=lazy_gettext(_name(level)))


def _table_4(_: Inputs) -> Answer:
    """Return table 4: peaks of the shaking table and their equivalent frequency, printed and computed."""
    columns = (
        ItemColumn("direction", N_("direction")),
        ItemColumn("level", N_("JMA intensity")),
        ItemColumn("pga_m_s2", N_("PGA (gal)"), GAL),
        ItemColumn("pgv_m_s", N_("PGV (kine)"), KINE),
        ItemColumn("printed_hz", N_("frequency printed (Hz)")),
        ItemColumn("frequency_hz", N_("PGA/(2π PGV) (Hz)")),
    )
    rows = [
        (direction, level, pga * GAL, pgv * KINE, f, pga / (2.0 * np.pi * pgv))
        for direction, (peaks, speeds, printed) in TABLE_4.items()
        for level, pga, pgv, f in zip(LEVELS, peaks, speeds, printed, strict=True)
    ]
    series = (
        Series(N_("printed"), range(len(rows)), [row[4] for row in rows], "points"),
        Series(N_("computed"), range(len(rows)), [row[5] for row in rows], "bars"),
    )
    panel = Panel(
        N_("direction and intensity"),
        N_("frequency (Hz)"),
        series,
        ticks=tuple((float(i), _cell_name(row[0], row[1])) for i, row in enumerate(rows)),
    )
    return Answer(columns, rows, (panel,), PRINTED)


VERDICTS = {"stands": N_("stable"), "on the line": N_("borderline"), "overturns": N_("overturns")}
CODES = (N_("stable"), N_("borderline"), N_("overturns"))


def _table_5(_: Inputs) -> Answer:
    """Return table 5: verdicts of eqs. (9) and (10) on the stone of the shaking table."""
    columns = (
        ItemColumn("stone", N_("stone")),
        ItemColumn("direction", N_("direction")),
        ItemColumn("level", N_("JMA intensity")),
        ItemColumn("threshold", N_("smallest H/B that overturns")),
        ItemColumn("printed", N_("printed")),
        ItemColumn("computed", N_("computed")),
        ItemColumn("corrected", N_("with p = 1362.9 gal")),
    )
    one_digit = GravestoneFit(13.629, DOWELLED.q_hz, DOWELLED.r)
    rows: list[tuple[Value, ...]] = []
    for direction, verdicts in TABLE_5.items():
        peaks, _speeds, frequencies = TABLE_4[direction]
        for stone, fit, second_fit, row in ((N_("plain"), PLAIN, PLAIN, verdicts[0]), (N_("dowelled"), DOWELLED, one_digit, verdicts[1])):
            for level, pga, f, code in zip(LEVELS, peaks, frequencies, row, strict=True):
                thresholds = [float(overturning_ratio(pga * GAL, f, kind)) for kind in (fit, second_fit)]
                rows.append((stone, direction, level, thresholds[0], CODES[int(code)], *(VERDICTS[predict(RATIO, t)] for t in thresholds)))
    series = tuple(
        Series(
            stone, [i for i, row in enumerate(rows) if row[0] == stone], [float(row[3] or 0.0) for row in rows if row[0] == stone], "bars"
        )
        for stone in (N_("plain"), N_("dowelled"))
    )
    ticks = tuple((float(i), _cell_name(row[1], row[2])) for i, row in enumerate(rows))
    panel = Panel(N_("direction and intensity"), RATIO_LABEL, series, levels=((RATIO, N_("stone, H/B 2.6")),), ticks=ticks)
    return Answer(columns, rows, (panel,), PRINTED)


def _cemetery(inputs: Inputs) -> Cemetery:
    return read_cemetery(inputs.body or "aoyama.csv")


def _source(inputs: Inputs) -> str:
    return STONES if inputs.body is None else OWN


def _ratios(cumulative: bool, inputs: Inputs) -> Answer:
    """Return figs. 14 and 15: histogram and cumulative distribution of H/B."""
    ratios = np.sort(_cemetery(inputs).ratios)
    edges = np.arange(np.floor(ratios[0]), np.ceil(ratios[-1]) + 0.01, 0.25)
    counts, _ = np.histogram(ratios, edges)
    shares = [float((ratios <= edge).mean()) for edge in edges[1:]]
    columns = (ItemColumn("up_to", N_("H/B up to")), ItemColumn("stones", N_("stones")), ItemColumn("cumulative", N_("cumulative share")))
    rows = [(float(edge), int(count), share) for edge, count, share in zip(edges[1:], counts, shares, strict=True)]
    if cumulative:
        panel = Panel(RATIO_LABEL, N_("cumulative share (1)"), (Series("", ratios, np.arange(1, ratios.size + 1) / ratios.size, "steps"),))
    else:
        panel = Panel(RATIO_LABEL, N_("stones"), (Series("", edges[:-1] + 0.125, counts, "bars"),))
    return Answer(columns, rows, (panel,), _source(inputs))


def _rates(reinforced: bool, with_surveys: bool, inputs: Inputs) -> Answer:
    """Return figs. 16 to 19: overturning rate against PGA for six frequencies, figs. 18 and 19 with the surveyed rates."""
    stones = _cemetery(inputs).with_dowels() if reinforced else _cemetery(inputs)
    points = rate_curve(stones, CURVE_PGA, FREQUENCIES)
    table_pga = [pga for pga in CURVE_PGA if pga % 2.0 == 0.0]
    columns = (
        ItemColumn("frequency_hz", N_("frequency (Hz)")),
        *(ItemColumn(f"rate_at_{pga / GAL:.0f}_gal", lazy_gettext("rate at {pga:.0f} gal", pga=pga / GAL)) for pga in table_pga),
    )
    rows: list[tuple[Value, ...]] = []
    series = []
    for f in FREQUENCIES:
        curve = {point.pga_m_s2: point.rate for point in points if point.frequency_hz == f}
        rows.append((f, *(curve[pga] for pga in table_pga)))
        series.append(Series(f"{f:g} Hz", [pga / GAL for pga in curve], list(curve.values())))
    if with_surveys:
        stations = _stations(inputs)
        for station in stations:
            text = lazy_gettext("{name} ({f:.2f} Hz)", name=lazy_gettext(station.name), f=station.frequency_hz)
            series.append(Series(text, [station.pga_m_s2 / GAL], [station.rate], "points"))
        columns, rows = _survey_table(inputs)
    panel = Panel(PGA_LABEL, RATE_LABEL, tuple(series), y_range=(0.0, 1.05))
    return Answer(columns, rows, (panel,), _source(inputs))


def _stations(inputs: Inputs) -> Sequence[SurveyedStation]:
    """Return the stations of table 6, or those of the user's file."""
    if inputs.stations is not None:
        return read_stations(inputs.stations)
    return [SurveyedStation(s.name, s.pga, s.printed_frequency_hz, s.rate) for s in SURVEYS]


def _survey_table(inputs: Inputs) -> tuple[tuple[ItemColumn, ...], list[tuple[Value, ...]]]:
    """Return columns and rows of table 6: surveyed rates beside the rates of both curves."""
    columns = [
        ItemColumn("station", N_("station")),
        ItemColumn("pga_m_s2", N_("PGA (gal)"), GAL),
        ItemColumn("frequency_hz", N_("frequency (Hz)")),
        ItemColumn("surveyed", N_("surveyed rate")),
        ItemColumn("plain", N_("computed, plain")),
        ItemColumn("dowelled", N_("computed, dowelled")),
    ]
    stones = _cemetery(inputs)
    dowelled = stones.with_dowels()
    rows: list[tuple[Value, ...]] = []
    for station in _stations(inputs):
        rates = (overturning_rate(kind, station.pga_m_s2, station.frequency_hz).rate for kind in (stones, dowelled))
        rows.append((station.name, station.pga_m_s2, station.frequency_hz, station.rate, *rates))
    if inputs.stations is None and inputs.body is None:
        columns += [ItemColumn("plain_printed", N_("printed, plain")), ItemColumn("dowelled_printed", N_("printed, dowelled"))]
        printed = {survey.name: (survey.estimate, survey.estimate_reinforced) for survey in SURVEYS} | {"Sakaiminato": (0.05, 0.0)}
        rows = [(*row, *printed[str(row[0])]) for row in rows]
    return tuple(columns), rows


def _scatter(inputs: Inputs) -> Answer:
    """Return fig. 20 and table 6: surveyed against computed rates."""
    columns, rows = _survey_table(inputs)
    series = [Series(N_("equal"), [0.0, 1.0], [0.0, 1.0], "dotted")]
    series += [Series(_name(row[0]), [float(row[4] or 0.0)], [float(row[3] or 0.0)], "points") for row in rows]
    panel = Panel(
        N_("computed rate, plain stones (1)"),
        N_("surveyed rate (1)"),
        tuple(series),
        x_range=(-0.02, 1.05),
        y_range=(-0.02, 1.05),
        equal=True,
    )
    return Answer(columns, rows, (panel,), _source(inputs))


RATES = ("body", "stations")

PAPER = Paper(
    "[Furukawa2009]_",
    "furukawa furukawa_rocking furukawa_field furukawa_pile furukawa_dowel",
    (
        Item("fig5", N_("Criterion for plain gravestones"), partial(_curves, PLAIN, False), (), ("eq. (9)", "eq. (8)")),
        Item("fig6", N_("Level a(f) of the criterion"), _figure_6),
        Item("fig7", N_("Criterion compared with the static one"), partial(_curves, PLAIN, True), (), ("section 3(4)a",)),
        Item("fig8", N_("Housner's criterion for the width of the sao"), _figure_8, ("body",)),
        Item("fig10", N_("Smallest H/B that overturns under records"), _figure_10, ("record", "body")),
        Item("fig13", N_("Criterion for dowelled gravestones"), partial(_curves, DOWELLED, False), (), ("eq. (10)",)),
        Item("fig14", N_("Histogram of H/B in the cemetery"), partial(_ratios, False), ("body",)),
        Item("fig15", N_("Cumulative distribution of H/B in the cemetery"), partial(_ratios, True), ("body",)),
        Item("fig16", N_("Overturning rate of plain gravestones"), partial(_rates, False, False), ("body",), ("table 6",)),
        Item("fig17", N_("Overturning rate of dowelled gravestones"), partial(_rates, True, False), ("body",), ("table 6",)),
        Item("fig18", N_("Computed and surveyed rates, plain gravestones"), partial(_rates, False, True), RATES, ("table 6",)),
        Item("fig19", N_("Computed and surveyed rates, dowelled gravestones"), partial(_rates, True, True), RATES, ("table 6",)),
        Item("fig20", N_("Surveyed against computed rates"), _scatter, RATES, ("table 6",)),
        Item("table3", N_("Equivalent frequency by three methods"), _table_3, ("record",), ("section 3(5)e",)),
        Item("table4", N_("Peaks and frequencies of the shaking table"), _table_4),
        Item("table5", N_("Verdicts on the stone of the shaking table"), _table_5),
        Item("table6", N_("Surveyed and estimated overturning rates"), _scatter, RATES),
    ),
)
"""Items of the paper."""
