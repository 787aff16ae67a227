"""Items of [Fujino1978]_: table 1, figs. 4 and 7 to 17."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase, sliding_base
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.units import GAL, KINE
from seisblock.criteria.sliding import min_friction_to_hold, min_friction_to_stop
from seisblock.measures import ground_history
from seisblock.models.slide.solve import solve_slide
from seisblock.paper.item import Answer, Inputs, Item, ItemColumn, Panel, Paper, Series, Value
from seisblock.readers import read
from seisblock.records import Motion, Record, motion_of
from seisblock.studies.sliding import slide_study
from seisblock.validation.fujino import (
    FRICTION,
    PGA,
    RATIOS,
    SLOPES,
    G,
    critical_friction,
    el_centro,
    el_centro_baseline,
    sine,
    slip_curves,
    slope_criterion,
    slope_curve,
)

VERTICAL_PGA = 0.9768
"""Peak of the vertical motions of [Fujino1978]_ table 1, m/s^2."""

STAND_IN = "hanmer_springs_2016"
"""Bundled recording with a vertical component."""

SLIP_CM, FRICTION_LABEL = N_("max. sliding displacement (cm)"), N_("static friction coefficient μ (1)")

OWN = N_("own record or body")
BASELINE = N_("bundled El Centro 1940 NS, high-passed at 0.15 Hz, scaled to 245.27 gal (paper: own digitisation of three records)")
RAW = N_("bundled El Centro 1940 NS, scaled to 245.27 gal (paper: Hachinohe, El Centro and Taft)")
SUBSTITUTE = N_(
    "bundled Hanmer Springs 2016, horizontal scaled to 245.27 gal, vertical to 97.68 gal (the paper's vertical components are not bundled)"
)
COMPUTED = N_("formula of the paper")
EL_CENTRO, HANMER_SPRINGS = N_("El Centro 1940 NS"), N_("Hanmer Springs 2016, azimuth 10°")
"""Titles of panels."""


def _horizontal(inputs: Inputs, default: Motion) -> list[Motion]:
    """Return the user's motions, or the default."""
    if not inputs.records:
        return [default]
    return [
        motion_of(record, name)
        for record in inputs.records
        for name in inputs.component or [component.code for component in record.horizontals]
    ]


def _with_vertical(inputs: Inputs) -> list[Motion]:
    """Return motions with a vertical component: the user's as they are, or the substitute scaled to the peaks of table 1."""
    if inputs.records:
        motions = _horizontal(inputs, el_centro())
        if not all(np.any(motion.vertical) for motion in motions):
            raise ParameterError(
                "this item requires a record with a vertical component; {record} has none", record=inputs.records[0].source
            )
        return motions
    return [_scaled(read(STAND_IN))]


def _scaled(record: Record) -> Motion:
    """Return the first horizontal and the vertical component of a record at the paper's peaks."""
    code = record.horizontals[0].code
    motion = motion_of(record, code)
    horizontal, vertical = float(np.abs(motion.horizontal).max()), float(np.abs(motion.vertical).max())
    return Motion.from_arrays(
        motion.horizontal * PGA / horizontal, motion.dt, vertical=motion.vertical * VERTICAL_PGA / vertical, name=code
    )


def _source(inputs: Inputs, default: str) -> str:
    return OWN if inputs.records else default


def _title(inputs: Inputs, motion: Motion, default: str) -> str:
    """Return the title of a panel: the component of the user's record, or the bundled recording."""
    return motion.name if inputs.records else default


def _table_1(inputs: Inputs) -> Answer:
    """Return table 1: peaks of the motions beside the printed ones."""
    columns = (
        ItemColumn("motion", N_("motion")),
        ItemColumn("pga_m_s2", N_("PGA (gal)"), GAL),
        ItemColumn("pgv_m_s", N_("PGV (kine)"), KINE),
        ItemColumn("pgd_m", N_("PGD (cm)"), 0.01),
    )
    rows: list[tuple[Value, ...]] = []
    if not inputs.records:
        rows = [
            (N_("Hachinohe NS (printed)"), 2.4863, 0.3631, 0.1002),
            (N_("El Centro NS (printed)"), 2.4527, 0.2475, 0.0713),
            (N_("Taft N21E (printed)"), 2.4527, 0.2180, 0.0861),
        ]
    for motion in _horizontal(inputs, el_centro_baseline()):
        history = ground_history(motion.horizontal, motion.dt)
        peaks = (float(np.abs(part).max()) for part in (motion.horizontal, history.velocity, history.displacement))
        rows.append((motion.name if inputs.records else N_("El Centro NS"), *peaks))
    panels = tuple(
        Panel(N_("t (s)"), N_("z'' (gal)"), (Series("", motion.time, motion.horizontal / GAL),), title=_title(inputs, motion, EL_CENTRO))
        for motion in _horizontal(inputs, el_centro_baseline())
    )
    return Answer(columns, rows, panels, _source(inputs, BASELINE))


EVENTS = N_("slip start"), N_("reversal"), N_("stop"), N_("lift-off"), N_("landing")
"""Names of the events in fig. 4."""


def _figure_4(inputs: Inputs) -> Answer:
    """Return fig. 4: displacement, velocity and acceleration of ground and body under a sine."""
    columns = (
        ItemColumn("event", N_("event")),
        ItemColumn("time_s", N_("t (s)")),
        ItemColumn("slip_m", N_("sliding displacement (cm)"), 0.01),
    )
    rows: list[tuple[Value, ...]] = []
    panels: list[Panel] = []
    motions = _horizontal(inputs, sine(60.0))
    for motion in motions:
        response = solve_slide(SlidingBase(0.2, 0.175), motion, vertical=False, gravity=G)
        rows += [(event.name, event.time_s, float(event.after[0])) for event in response.events]
        time = response.time
        # the sine starts with the velocity of the displacement 60 sin 2t cm; a record starts from rest
        start = 0.0 if inputs.records else 1.2
        ground_a = np.interp(time, motion.time, motion.horizontal)
        steps = np.diff(time, prepend=time[0])
        ground_v = start + np.cumsum(0.5 * (ground_a + np.concatenate([ground_a[:1], ground_a[:-1]])) * steps)
        ground_d = np.cumsum(0.5 * (ground_v + np.concatenate([ground_v[:1], ground_v[:-1]])) * steps)
        for label, size, ground, relative in (
            (N_("displacement (cm)"), 0.01, ground_d, response["displacement"]),
            (N_("velocity (kine)"), KINE, ground_v, response["velocity"]),
            (N_("acceleration (gal)"), GAL, ground_a, response["acceleration"]),
        ):
            series = (Series(N_("ground"), time, ground / size, "dotted"), Series(N_("body"), time, (ground + relative) / size))
            panels.append(Panel(N_("t (s)"), label, series, title=_title(inputs, motion, "")))
    source = N_("ground displacement 60 sin 2t cm (60 gal as printed would not slide), μ 0.2 and 0.175")
    return Answer(columns, rows, tuple(panels), _source(inputs, source))


def _figure_7(inputs: Inputs) -> Answer:
    """Return fig. 7: largest displacement against friction for four ratios of kinetic to static friction."""
    motions = _horizontal(inputs, el_centro_baseline())
    columns = (
        ItemColumn("component", N_("component")),
        ItemColumn("mu", "μ"),
        *(ItemColumn(f"slip_kappa_{ratio:g}_m".replace(".", "_"), f"κ {ratio:g} (cm)", 0.01) for ratio in RATIOS),
    )
    rows: list[tuple[Value, ...]] = []
    panels = []
    for motion in motions:
        slips = slip_curves(motion)
        rows += [(motion.name, float(mu), *map(float, row)) for mu, row in zip(FRICTION, slips, strict=True)]
        series = tuple(Series(f"κ = {ratio:g}", FRICTION, 100.0 * slips[:, i]) for i, ratio in enumerate(RATIOS))
        panels.append(Panel(FRICTION_LABEL, SLIP_CM, series, title=_title(inputs, motion, EL_CENTRO)))
    return Answer(columns, rows, tuple(panels), _source(inputs, BASELINE))


HISTORY_COLUMNS = (
    ItemColumn("component", N_("component")),
    ItemColumn("mu", "μ"),
    ItemColumn("kappa", "κ"),
    ItemColumn("max_slip_m", N_("max. displacement (cm)"), 0.01),
    ItemColumn("final_slip_m", N_("final displacement (cm)"), 0.01),
)


def _histories(
    frictions: tuple[float, ...], ratios: tuple[float, ...], gain: float, inputs: Inputs, motions: Sequence[Motion], default: str
) -> Answer:
    """Return histories of the sliding displacement for pairs of friction and ratio (figs. 8, 11, 12)."""
    rows: list[tuple[Value, ...]] = []
    panels = []
    for motion in motions:
        series = []
        times: list[float] = []
        for mu, kappa in ((mu, kappa) for mu in frictions for kappa in ratios):
            response = solve_slide(sliding_base(mu, kappa=kappa), motion, vertical=gain, gravity=G)
            outcome = response.outcome
            rows.append((motion.name, mu, kappa, outcome.max_slip_m, outcome.final_slip_m))
            times += [event.time_s for event in response.events]
            series.append(Series(f"μ = {mu:g}, κ = {kappa:g}", response.time, 100.0 * response["displacement"]))
        x_range = (min(times) - 2.0, max(times) + 2.0) if times else None
        panels.append(
            Panel(N_("t (s)"), N_("sliding displacement (cm)"), tuple(series), title=_title(inputs, motion, default), x_range=x_range)
        )
    return Answer(HISTORY_COLUMNS, rows, tuple(panels), _source(inputs, BASELINE if default == EL_CENTRO else SUBSTITUTE))


def _figure_8(inputs: Inputs) -> Answer:
    """Return fig. 8: histories without vertical motion, mu 0.08 and 0.04."""
    return _histories((0.08,), (0.5,), 0.0, inputs, _horizontal(inputs, el_centro_baseline()), EL_CENTRO)


def _figure_11(inputs: Inputs) -> Answer:
    """Return fig. 11: histories for ratios of friction in small steps."""
    return _histories((0.1,), (0.333, 0.4, 0.45, 0.5), 1.0, inputs, _with_vertical(inputs), HANMER_SPRINGS)


def _figure_12(inputs: Inputs) -> Answer:
    """Return fig. 12: histories for two frictions with the threefold vertical motion."""
    return _histories((0.11, 0.115), (0.333,), 3.0, inputs, _with_vertical(inputs), HANMER_SPRINGS)


def _figure_9(inputs: Inputs) -> Answer:
    """Return fig. 9: ratio beta of the displacements with and without vertical motion against friction."""
    columns = (
        ItemColumn("component", N_("component")),
        ItemColumn("mu", "μ"),
        *(
            ItemColumn(f"beta_kappa_{k:g}_gain_{gain:g}".replace(".", "_"), f"β κ {k:g} γ {gain:g}")
            for k in (0.5, 0.333)
            for gain in (1.0, 3.0)
        ),
    )
    rows: list[tuple[Value, ...]] = []
    panels = []
    motions = _with_vertical(inputs)
    for motion in motions:
        points = slide_study(FRICTION.tolist(), motion, kappa=(0.5, 0.333), vertical=(1.0, 3.0), gravity=G)
        betas = [points[4 * i : 4 * i + 4] for i in range(FRICTION.size)]
        rows += [(motion.name, float(mu), *(point.beta for point in row)) for mu, row in zip(FRICTION, betas, strict=True)]
        series = tuple(
            Series(
                f"κ = {row.kappa:.3g}, γ = {row.vertical:g}",
                FRICTION,
                [math.nan if r[i].beta is None else r[i].beta or 0.0 for r in betas],
                "points",
            )
            for i, row in enumerate(betas[0])
        )
        panels.append(Panel(FRICTION_LABEL, "β (1)", series, title=_title(inputs, motion, HANMER_SPRINGS), levels=((1.0, ""),)))
    return Answer(columns, rows, tuple(panels), _source(inputs, SUBSTITUTE))


def _figure_10(inputs: Inputs) -> Answer:
    """Return fig. 10: ratio beta against the factor on the vertical motion."""
    gains = np.arange(0.0, 5.01, 0.25)
    columns = (
        ItemColumn("component", N_("component")),
        ItemColumn("gain", N_("factor γ on the vertical motion")),
        *(ItemColumn(f"beta_mu_{mu:g}".replace(".", "_"), f"β μ {mu:g}") for mu in (0.08, 0.11, 0.15)),
    )
    rows: list[tuple[Value, ...]] = []
    panels = []
    for motion in _with_vertical(inputs):
        points = slide_study((0.08, 0.11, 0.15), motion, kappa=0.5, vertical=gains.tolist(), gravity=G)
        curves = [points[i * gains.size : (i + 1) * gains.size] for i in range(3)]
        rows += [(motion.name, float(gain), *(curve[i].beta for curve in curves)) for i, gain in enumerate(gains)]
        series = tuple(
            Series(f"μ = {curve[0].mu:g}", gains, [math.nan if point.beta is None else point.beta for point in curve]) for curve in curves
        )
        panels.append(
            Panel(
                N_("factor γ on the vertical motion (1)"),
                "β (1)",
                series,
                title=_title(inputs, motion, HANMER_SPRINGS),
                levels=((1.0, ""),),
            )
        )
    return Answer(columns, rows, tuple(panels), _source(inputs, SUBSTITUTE))


def _sketch(with_flat: bool, _: Inputs) -> Answer:
    """Return figs. 13 and 14: body on a slope with its axes, and the slope of 1 m with level ground beyond."""
    angle = math.radians(20.0)
    c, s = math.cos(angle), math.sin(angle)
    columns = (ItemColumn("quantity", N_("quantity")), ItemColumn("value", N_("value")))
    if with_flat:
        slope = Series(N_("slope of 1 m, level ground beyond"), [0.0, c, 2.0 * c], [s, 0.0, 0.0])
        corners = [(0.15 * c, s - 0.15 * s), (0.15 * c + 0.12 * c, s - 0.27 * s)]
        rows: list[tuple[Value, ...]] = [(N_("length of the slope (m)"), 1.0)]
    else:
        slope = Series(N_("slope θ"), [0.0, c], [s, 0.0])
        corners = [(0.4 * c, s - 0.4 * s), (0.55 * c, s - 0.55 * s)]
        rows = [(N_("slope of the sketch (deg)"), 20.0)]
    (x0, y0), (x1, y1) = corners
    height = 0.12
    box_x, box_y = [x0, x1, x1 + height * s, x0 + height * s, x0], [y0, y1, y1 + height * c, y0 + height * c, y0]
    series = [slope, Series(N_("body"), box_x, box_y)]
    if not with_flat:
        cx, cy = sum(box_x[:4]) / 4, sum(box_y[:4]) / 4
        series += [
            Series(N_("x', z' along the slope"), [cx, cx + 0.3 * c], [cy, cy - 0.3 * s], "dashed"),
            Series(N_("y' normal to it"), [cx, cx + 0.3 * s], [cy, cy + 0.3 * c], "dotted"),
        ]
    return Answer(columns, rows, (Panel("x (m)", "y (m)", tuple(series), equal=True),), N_("sketch"))


def _figure_15(inputs: Inputs) -> Answer:
    """Return fig. 15: displacement against the slope, 1 m long with level ground beyond."""
    frictions = (0.2, 0.3, 0.4, 0.5, 0.6)
    columns = (
        ItemColumn("component", N_("component")),
        ItemColumn("mu", "μ"),
        ItemColumn("slope_deg", N_("slope (deg)")),
        ItemColumn("final_slip_m", N_("final displacement (m)")),
        ItemColumn("past_foot", N_("past the foot")),
    )
    rows: list[tuple[Value, ...]] = []
    panels = []
    for motion in _horizontal(inputs, el_centro()):
        series = []
        for mu in frictions:
            points = slope_curve(motion, mu)
            rows += [(motion.name, mu, p.slope_deg, p.final_slip_m, p.fell_off_slope) for p in points if p.slope_deg % 1.0 == 0.0]
            series.append(
                Series(
                    f"μ = {mu:g}", [p.slope_deg for p in points], [math.nan if p.final_slip_m is None else p.final_slip_m for p in points]
                )
            )
        levels = ((1.0, N_("foot of the slope")),)
        panels.append(
            Panel(
                N_("slope (deg)"),
                N_("final displacement (m)"),
                tuple(series),
                title=_title(inputs, motion, EL_CENTRO),
                x_range=(0.0, float(SLOPES[-1])),
                levels=levels,
            )
        )
    return Answer(columns, rows, tuple(panels), _source(inputs, RAW))


def _figure_16(inputs: Inputs) -> Answer:
    """Return fig. 16: critical friction against the slope, simulated and by eqs. (14) and (15)."""
    slopes = np.arange(4.0, 41.0, 4.0)
    columns = (
        ItemColumn("component", N_("component")),
        ItemColumn("slope_deg", N_("slope (deg)")),
        ItemColumn("simulated", N_("critical μ, simulated")),
        ItemColumn("criterion", N_("smaller of eqs. (14), (15)")),
        ItemColumn("eq_14", N_("eq. (14)")),
        ItemColumn("eq_15", N_("eq. (15)")),
    )
    rows: list[tuple[Value, ...]] = []
    panels = []
    for motion in _horizontal(inputs, el_centro()):
        critical = [critical_friction(motion, slope) for slope in slopes]
        stops = [min_friction_to_stop(slope, 0.5) for slope in slopes]
        holds = [float(min_friction_to_hold(slope, motion.horizontal / G).max()) for slope in slopes]
        rows += [
            (motion.name, float(t), mu, slope_criterion(motion, t), stop, hold)
            for t, mu, stop, hold in zip(slopes, critical, stops, holds, strict=True)
        ]
        series = (
            Series(N_("simulated, sliding beyond 2 m"), slopes, critical, "points"),
            Series(N_("eq. (14)"), slopes, stops, "dotted"),
            Series(N_("eq. (15)"), slopes, holds),
        )
        panels.append(Panel(N_("slope (deg)"), FRICTION_LABEL, series, title=_title(inputs, motion, EL_CENTRO), y_range=(0.0, 1.6)))
    return Answer(columns, rows, tuple(panels), _source(inputs, RAW))


def _figure_17(_: Inputs) -> Answer:
    """Return fig. 17: eq. (15) for accelerations and ratios of vertical to horizontal acceleration."""
    slopes = np.arange(0.0, 41.0, 1.0)
    settings = ((0.2, 0.0), (0.2, 1.0), (0.2, -1.0), (0.4, 0.0), (0.4, 0.5), (0.4, -0.5), (0.4, 1.0), (0.4, -1.0))
    # alpha is negative towards the slope's foot as in the paper's example of Hachinohe
    curves = [[float(min_friction_to_hold(t, -alpha, -alpha * mu)) for t in slopes] for alpha, mu in settings]
    columns = (
        ItemColumn("slope_deg", N_("slope (deg)")),
        *(ItemColumn(f"alpha_{a:g}_mu_{m:g}".replace(".", "_").replace("-", "minus_"), f"α {a:g}, μ {m:g}") for a, m in settings),
    )
    rows = [(float(t), *(curve[i] for curve in curves)) for i, t in enumerate(slopes) if t % 5.0 == 0.0]
    kinds = ("line", "dashed", "dotted", "line", "dashed", "dotted", "dashed", "dotted")
    series = tuple(
        Series(f"α = {a:g}, μ = {m:g}", slopes, curve, kind)  # type: ignore[arg-type]
        for (a, m), curve, kind in zip(settings, curves, kinds, strict=True)
    )
    panel = Panel(N_("slope (deg)"), N_("critical static friction coefficient (1)"), series)
    return Answer(columns, rows, (panel,), COMPUTED)


PAPER = Paper(
    "[Fujino1978]_",
    "fujino",
    (
        Item("table1", N_("Peaks of the ground motions"), _table_1, ("record",)),
        Item("fig4", N_("Sliding under a sine"), _figure_4, ("record",), ("section 2.2.2",)),
        Item("fig7", N_("Largest sliding displacement against friction"), _figure_7, ("record",)),
        Item("fig8", N_("Histories of the sliding displacement"), _figure_8, ("record",)),
        Item("fig9", N_("Effect of vertical motion against friction"), _figure_9, ("record",)),
        Item("fig10", N_("Effect of the size of the vertical motion"), _figure_10, ("record",)),
        Item("fig11", N_("Histories for ratios of kinetic to static friction"), _figure_11, ("record",)),
        Item("fig12", N_("Histories for two neighbouring friction coefficients"), _figure_12, ("record",)),
        Item("fig13", N_("Body on a slope: axes"), partial(_sketch, False), (), ("eqs. (9), (10)",)),
        Item("fig14", N_("Slope of 1 m with level ground beyond"), partial(_sketch, True)),
        Item("fig15", N_("Displacement on a slope"), _figure_15, ("record",)),
        Item("fig16", N_("Critical friction on a slope"), _figure_16, ("record",), ("eq. (14)", "eq. (15)")),
        Item("fig17", N_("Effect of vertical motion on the critical friction"), _figure_17, (), ("eq. (15)",)),
    ),
)
"""Items of the paper."""
