"""How rocking is told: a table with one column per component, a sentence each, and the figure."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from seisblock.present.tables import acceleration, acceleration_unit, number, record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.rock_outcome import RockOutcome
from seisblock.units import GAL

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Rockings = Sequence[Response[RockOutcome]]

COLOURS = {"rocks to +x": "#f4d9c6", "rocks to -x": "#d5dcef", "beyond +alpha": "#e6b39a", "beyond -alpha": "#a9b6dd"}


def tables(responses: Rockings, extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Iterator[Any]:
    """Yield, per record, its line, a table with a column per component, and what it comes to in words."""
    records = list({id(r.motion.record): r.motion.record for r in responses}.values())
    for record in records:
        part = [(r, e) for r, e in zip(responses, extras, strict=True) if r.motion.record is record]
        if record is not None:
            yield record_line(record)
        yield _table([r for r, _ in part], gal=gal)
        for response, extra in part:
            for sentence in sentences(response, extra):
                yield Text(sentence)
        yield Text()


def _table(responses: Rockings, *, gal: bool) -> Any:
    """Return the table of the outcomes."""
    outcomes = [response.outcome for response in responses]
    first, body = outcomes[0], responses[0].body
    threshold = f"{acceleration(first.threshold_m_s2, gal=gal)} {acceleration_unit(gal=gal)}"
    title = (
        f"{body.name}: alpha {first.slenderness_rad:.4f} rad, p {first.frequency_parameter_rad_s:.3f} rad/s\n"
        f"restitution {first.restitution:.4f}, rocks above {threshold}"
    )
    rows: list[tuple[str, list[Any]]] = [
        ("PGA (" + acceleration_unit(gal=gal) + ")", [acceleration(float(np.abs(r.motion.horizontal).max()), gal=gal) for r in responses]),
        ("rocking starts (s)", [seconds(o.rocking_start_s) for o in outcomes]),
        ("largest lean (deg)", [f"{math.degrees(o.max_rotation_rad):.3f}" for o in outcomes]),
        ("  over alpha", [number(o.max_rotation_ratio) for o in outcomes]),
        ("  at (s)", [seconds(o.max_rotation_s) for o in outcomes]),
        ("impacts", [o.impacts for o in outcomes]),
        ("overturned", [f"to {o.overturned_towards}" if o.overturned else "no" for o in outcomes]),
        ("  alpha passed (s)", [seconds(o.alpha_passed_s) for o in outcomes]),
        ("  lies down (s)", [seconds(o.overturning_time_s) for o in outcomes]),
        ("friction needed", [number(o.max_friction_demand) for o in outcomes]),
        ("  at (s)", [seconds(o.max_friction_demand_s) for o in outcomes]),
        ("contact lost (s)", [seconds(o.contact_lost_s) for o in outcomes]),
    ]
    return table(title, ["", *(r.motion.name or "x" for r in responses)], [[heading, *cells] for heading, cells in rows])


def sentences(response: Response[RockOutcome], extra: Mapping[str, Any]) -> Iterator[str]:
    """Yield the verdict, its fragility, its margins and its probability."""
    outcome, name = response.outcome, response.motion.name or "x"
    if not outcome.rocks:
        verdict = "stands still"
    elif not outcome.overturned:
        verdict = f"rocks and stands: {way_to_alpha(outcome.max_rotation_ratio)}"
    else:
        late = ", after the record's end" if outcome.decided_after_record else ""
        verdict = f"overturns to {outcome.overturned_towards}{late}"
    flag = "; a change of the record by less than 2 % changes this" if outcome.verdict_flips_within_2_percent else ""
    yield f"{name}: {verdict}{flag}."
    if "margin" in extra:
        yield from (f"  {line}" for line in _margin_lines(extra["margin"]))
    if "perturbation" in extra:
        found = extra["perturbation"]
        low, high = found.probability_interval
        yield f"  overturns in {found.overturned} of {found.runs} perturbed runs: {found.probability:.3f} (95 %: {low:.3f} to {high:.3f})."


def way_to_alpha(ratio: float) -> str:
    """Return how far a block leaned, in words."""
    return f"{ratio:.0%} of the way to alpha" if ratio >= 0.01 else "it hardly moves, less than 1% of the way to alpha"


def _margin_lines(margin: Any) -> Iterator[str]:
    """Yield the windows of factors in which the block overturns."""
    unsafe = [window for window in margin.windows if window.overturned]
    if not unsafe:
        yield f"stands at every factor up to {margin.limit:g} (looked at every {margin.step:g})."
        return
    shown = ", ".join(f"{w.first:.4f} to {w.last:.4f}" for w in unsafe[:8]) + (", ..." if len(unsafe) > 8 else "")
    yield f"overturns at factors {shown} (up to {margin.limit:g}, looked at every {margin.step:g})."
    if margin.nearest_flip is not None:
        yield f"the verdict changes next at a factor of {margin.nearest_flip:.4f}."


def figure(responses: Rockings, *, gal: bool = True) -> Figure:
    """Return the figure: per component acceleration with its band, lean over alpha with impacts and phases, and the phase plane."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from seisblock.present import canvas

    n = len(responses)
    made = Figure(figsize=(10.5, 0.5 + 3.4 * n), dpi=110, layout="constrained")
    FigureCanvasAgg(made)
    grid = made.add_gridspec(2 * n, 2, width_ratios=(2.6, 1.0))
    for index, response in enumerate(responses):
        above = made.add_subplot(grid[2 * index, 0])
        below = made.add_subplot(grid[2 * index + 1, 0], sharex=above)
        plane = made.add_subplot(grid[2 * index : 2 * index + 2, 1])
        for axis in (above, below, plane):
            canvas.dress(axis)
        draw_ground(above, response, gal=gal)
        draw_lean(below, response)
        _draw_plane(plane, response)
        above.set_xlim(*stretch(response))
    return made


def stretch(response: Response[RockOutcome]) -> tuple[float, float]:
    """Return the stretch of time worth drawing."""
    start = response.outcome.rocking_start_s
    first, last = float(response.time[0]), float(response.time[-1])
    if start is None:
        return first, last
    moving = [phase for phase in response.phases if phase.name != "rest"]
    margin = 0.05 * (moving[-1].end_s - start) + 0.2
    return max(first, start - margin), min(last, moving[-1].end_s + margin)


def draw_ground(axis: Any, response: Response[RockOutcome], *, gal: bool) -> None:
    """Draw the ground acceleration over the band within which the block rests."""
    from seisblock.present import canvas

    unit, name = (GAL, "gal") if gal else (1.0, "m/s²")
    outcome, options = response.outcome, response.options
    weight = 1.0 + response["vertical_acceleration"] / options["gravity_m_s2"]
    right, left = (
        arm / response.body.centre if not options["linear"] else alpha
        for arm, alpha in zip(response.body.arms, response.body.slendernesses, strict=True)
    )
    g = options["gravity_m_s2"] / unit
    band = f"rests within ± {'(g + a_v)' if options['vertical'] else 'g'} tan α"
    axis.fill_between(response.time, -g * right * weight, g * left * weight, color="0.92", linewidth=0, label=band)
    if not options["vertical"]:
        canvas.threshold(axis, [-g * right, g * left])
    canvas.curve(axis, response.time, response["ground_acceleration"] / unit, color=canvas.INPUT)
    canvas.label(axis, y=f"a ({name})")
    canvas.legend(axis)
    e = f"e {outcome.restitution:.3f}" + ("; a 2 % change flips the verdict" if outcome.verdict_flips_within_2_percent else "")
    axis.set_title(f"{response.motion.name}  {response.body.name}: α {outcome.slenderness_rad:.3f} rad, {e}", fontsize=9, loc="left")


def draw_lean(axis: Any, response: Response[RockOutcome]) -> None:
    """Draw the lean over alpha with its phases and impacts."""
    from seisblock.present import canvas

    ratio = response["rotation"] / response.outcome.slenderness_rad
    canvas.shade(axis, _merged(response), COLOURS)
    canvas.curve(axis, response.time, ratio, color=canvas.ACCENT)
    canvas.threshold(axis, [-1.0, 1.0])
    reach = float(np.abs(ratio).max())
    limit = 1.6 if reach > 1.6 else max(1.15 * reach, 1e-3) if reach < 0.8 else 1.2
    limit = max(limit, 1.15 * min(reach, 1.4))
    axis.set_ylim(-limit, limit)
    impacts = [event.time_s for event in response.events if event.name == "impact"]
    axis.plot(impacts, np.full(len(impacts), -0.95 * limit), "|", color="0.2", markersize=5, markeredgewidth=0.6, label="impacts")
    if response.outcome.overturned:
        when = response.outcome.alpha_passed_s
        if when is not None and when <= response.time[-1]:
            axis.axvline(when, color=canvas.ACCENT, linewidth=0.8, linestyle=":", label="α passed for good")
    canvas.label(axis, "t (s)", "θ/α")
    canvas.legend(axis)


def _merged(response: Response[RockOutcome]) -> list[Any]:
    """Return the phases long enough to be seen, so that dying hops do not become thousands of bands."""
    shortest = (response.time[-1] - response.time[0]) / 2000
    return [phase for phase in response.phases if phase.duration_s > shortest]


def _draw_plane(axis: Any, response: Response[RockOutcome]) -> None:
    """Draw the phase plane: angular velocity over p against lean over alpha, with the separatrices of free rocking."""
    from seisblock.present import canvas

    outcome = response.outcome
    alpha, p = outcome.slenderness_rad, outcome.frequency_parameter_rad_s
    lean, rate = response["rotation"] / alpha, response["angular_velocity"] / (p * alpha)
    u = np.linspace(0.0, 2.0, 60)
    edge = np.abs(1 - u) if response.options["linear"] else 2 * np.abs(np.sin(alpha * (1 - u) / 2)) / alpha
    for sign in (1, -1):
        inward = np.where(u < 1, edge, -edge)
        label = "edge of falling, unshaken" if sign > 0 else None
        axis.plot(sign * u, sign * inward, color="0.3", linewidth=0.8, linestyle=(0, (4, 2)), label=label)
    axis.plot(lean, rate, color=canvas.ACCENT, linewidth=0.7)
    reach = min(max(float(np.abs(lean).max()) * 1.1, 0.2), 1.8)
    high = max(float(np.abs(rate[np.abs(lean) <= reach]).max()) * 1.1, 0.2)
    axis.set_xlim(-reach, reach)
    axis.set_ylim(-high, high)
    canvas.label(axis, "θ/α", "θ'/(p α)")
    canvas.legend(axis)
