"""How a parameter study of sliding is told: pivot tables, and the figures 7, 9, 10, 15 and 16 of [Fujino1978]_."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from seisblock.present.slide import millimetres
from seisblock.present.tables import NOTHING, record_line, table
from seisblock.records import Record
from seisblock.studies.sliding import SlidePoint

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Points = Sequence[SlidePoint]

SYMBOLS = {"mu": "μ", "kappa": "κ", "mu_kinetic": "μ kinetic", "slope_deg": "θ (deg)", "vertical_scale": "γ"}
MOST_ROWS, MOST_COLUMNS = 60, 8
PLANE = 8
"""A study of slope and friction with at least so many values of each is drawn as fig. 16."""

SLIP_LABEL = "largest slip (m)"

LEAST_SHADE = 1e-4
"""Slip, m, below which the plane stays white."""


@dataclass(frozen=True)
class Layout:
    """Which parameter runs along x, which makes the curves, and which are left for titles."""

    x: str
    curves: tuple[str, ...]

    @classmethod
    def of(cls, points: Points) -> Layout:
        """Put the parameter with most values on x; of equals, the one that the paper's figures have there."""
        kinetic = "kappa" if len({p.kappa for p in points}) <= len({p.mu_kinetic for p in points}) else "mu_kinetic"
        counts = {name: len({getattr(p, name) for p in points}) for name in ("mu", "slope_deg", "vertical_scale", kinetic)}
        x = max(counts, key=lambda name: counts[name])
        return cls(x, tuple(name for name, count in counts.items() if name != x and count > 1))

    def name(self, point: SlidePoint) -> str:
        """Return the name of the curve on which a point lies."""
        return ", ".join(f"{SYMBOLS[key].split(' (')[0]} {getattr(point, key):g}" for key in self.curves)


def tables(records: Sequence[Record], studies: Sequence[Points]) -> Iterator[Any]:
    """Yield, for each record and direction, the largest slip and, with vertical motion, the ratio beta as in [Fujino1978]_ fig. 9."""
    for record, points in zip(records, studies, strict=True):
        yield record_line(record)
        layout = Layout.of(points)
        for title, part in _parts(points, layout):
            yield _pivot(f"{title}: largest slip (mm)", part, layout, lambda point: millimetres(point.max_slip_m))
            if any(point.beta is not None for point in part):
                yield _pivot(
                    f"{title}: beta, largest slip with vertical motion over that without", part, layout,
                    lambda point: NOTHING if point.beta is None else f"{point.beta:.3f}",
                )  # fmt: skip


def _parts(points: Points, layout: Layout) -> list[tuple[str, Points]]:
    """Return the points of each direction; the worst directions of a sweep are one part."""
    names = list(dict.fromkeys(point.component for point in points))
    per_direction = len({tuple(getattr(p, key) for key in (layout.x, *layout.curves)) for p in points})
    if len(points) == per_direction and len(names) > 1:
        return [("worst direction", points)]
    return [(name, [point for point in points if point.component == name]) for name in names]


def _pivot(title: str, points: Points, layout: Layout, cell: Callable[[SlidePoint], str]) -> Any:
    """Return one table: x runs down, the curves stand side by side; long ones are thinned."""
    xs = list(dict.fromkeys(getattr(point, layout.x) for point in points))
    names = list(dict.fromkeys(layout.name(point) for point in points))
    values = {(getattr(point, layout.x), layout.name(point)): cell(point) for point in points}
    rows, columns = _thinned(xs, MOST_ROWS), _thinned(names, MOST_COLUMNS)
    left_out = len(rows) < len(xs) or len(columns) < len(names)
    return table(
        title, (SYMBOLS[layout.x], *(name or "slip" for name in columns)),
        [[f"{x:g}", *(values.get((x, name), NOTHING) for name in columns)] for x in rows],
        caption=f"{len(rows)} of {len(xs)} rows, {len(columns)} of {len(names)} columns; --csv and --json hold all" if left_out else "",
    )  # fmt: skip


def _thinned(values: Sequence[Any], most: int) -> list[Any]:
    """Return at most so many values, evenly chosen, with the first and the last."""
    if len(values) <= most:
        return list(values)
    return [values[index] for index in np.unique(np.linspace(0, len(values) - 1, most).round().astype(int))]


def figure(records: Sequence[Record], studies: Sequence[Points], *, slope_length: float | None, gravity: float) -> Figure:
    """Return the figure of the study: slip (or beta) against the parameter with most values, one curve per value of the others.

    A study of both slope and friction is drawn as the plane of [Fujino1978]_ fig. 16, with the criteria (14) and (15).
    """
    from seisblock.present import canvas

    parts = [
        (record, title, part)
        for record, points in zip(records, studies, strict=True) for title, part in _parts(points, Layout.of(points))
    ]  # fmt: skip
    made, axes = canvas.new_figure(1, columns=len(parts), width=2.0 + 4.5 * len(parts), height=4.6, sharey=True)
    for axis, (record, title, part) in zip(axes, parts, strict=True):
        if all(len({getattr(point, name) for point in part}) >= PLANE for name in ("mu", "slope_deg")):
            _plane(axis, part)
            _criteria(axis, part, record, gravity)
        else:
            _curves(axis, part, slope_length)
        axis.set_title(title, fontsize=9, loc="left")
    if axes[0].get_ylabel() == SLIP_LABEL:
        axes[0].set_ylim(bottom=0.0)
    return made


def _curves(axis: Any, points: Points, slope_length: float | None) -> None:
    """Draw curves as in [Fujino1978]_ fig. 7 (slip), figs. 9 and 10 (beta), fig. 15 (slip on a slope)."""
    from seisblock.present import canvas

    layout = Layout.of(points)
    ratio = any(point.beta is not None for point in points)
    names = list(dict.fromkeys(layout.name(point) for point in points))
    for index, name in enumerate(names):
        mine = sorted((point for point in points if layout.name(point) == name), key=lambda point: float(getattr(point, layout.x)))
        x = [getattr(point, layout.x) for point in mine]
        y = [_value(point, ratio) for point in mine]
        share = index / max(len(names) - 1, 1)
        colour = canvas.ACCENT if len(names) == 1 else _shade(share)
        marker = "os^Dvx"[index % 6] if len(x) <= 60 else ""
        axis.plot(x, y, color=colour, linewidth=1.1, marker=marker, markersize=3.5, label=name or None)
    if ratio:
        axis.axhline(1.0, color=canvas.INPUT, linewidth=0.7)
    if slope_length is not None and not ratio:
        axis.axhline(slope_length, color=canvas.THRESHOLD, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)), label="foot of the slope")
    canvas.label(axis, x=SYMBOLS[layout.x], y="β (1)" if ratio else SLIP_LABEL)
    canvas.legend(axis, loc="best", bbox_to_anchor=None, borderaxespad=0.5, ncols=1 if len(names) < 6 else 2)


def _value(point: SlidePoint, ratio: bool) -> float:
    """Return what is drawn of a point."""
    value = point.beta if ratio else point.max_slip_m
    return np.nan if value is None else value


def _shade(share: float) -> Any:
    """Return a colour between the accents that also differs in grey."""
    from matplotlib import colormaps

    return colormaps["plasma"](0.85 * share)


def _plane(axis: Any, points: Points) -> None:
    """Shade the plane of slope and friction by the largest slip."""
    from matplotlib.colors import LogNorm

    slopes = sorted({point.slope_deg for point in points})
    frictions = sorted({point.mu for point in points})
    slip = np.full((len(frictions), len(slopes)), np.nan)
    for point in points:
        if point.max_slip_m is not None:
            slip[frictions.index(point.mu), slopes.index(point.slope_deg)] = max(point.max_slip_m, LEAST_SHADE)
    norm = LogNorm(LEAST_SHADE, max(float(np.nanmax(slip)), 100.0 * LEAST_SHADE))
    mesh = axis.pcolormesh(slopes, frictions, slip, norm=norm, cmap="Greys", shading="nearest")
    bar = axis.figure.colorbar(mesh, ax=axis, pad=0.02)
    bar.set_label(SLIP_LABEL, fontsize=9)
    bar.ax.tick_params(labelsize=8)


def _criteria(axis: Any, points: Points, record: Record, gravity: float) -> None:
    """Draw what friction holds at rest, what stops a slide, eq. (14), and what starts one in this record, eq. (15)."""
    from seisblock.criteria.sliding import friction_that_holds, friction_that_stops
    from seisblock.present import canvas
    from seisblock.records import motion_of

    angles = np.array([point.slope_deg for point in points])
    frictions = [point.mu for point in points]
    dense = np.linspace(angles.min(), angles.max(), 100)
    axis.plot(dense, np.tan(np.radians(np.abs(dense))), color=canvas.INPUT, linewidth=0.9, label="holds at rest: tan θ")
    for kappa in sorted({point.kappa for point in points if point.kappa > 0.0})[:3]:
        stops = [friction_that_stops(abs(angle), kappa) for angle in dense]
        axis.plot(dense, stops, color=canvas.ACCENT, linewidth=1.1, label=f"(14): tan θ / κ, κ {kappa:g}")
    motion = motion_of(record, points[0].component)
    for scale, style in zip(list(dict.fromkeys(point.vertical_scale for point in points))[:2], ("-", "--"), strict=False):
        starts = [friction_that_holds(angle, motion.horizontal / gravity, scale * motion.vertical / gravity).max() for angle in dense]
        axis.plot(dense, starts, style, color=canvas.SECOND, linewidth=1.1, label="(15): this record" + (f", γ {scale:g}" if scale else ""))
    axis.set_ylim(min(frictions), max(frictions))
    canvas.label(axis, x=SYMBOLS["slope_deg"], y=SYMBOLS["mu"])
    canvas.legend(axis, ncols=3)
