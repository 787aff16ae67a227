"""How a slide is told: a table per record, and the three panels of [Fujino1978]_ figs. 8, 11 and 12."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from seisblock.present.tables import NOTHING, record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.slide import SLIDING, SlideOutcome
from seisblock.studies.sliding import SlidePoint
from seisblock.typing import FloatArray

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Slides = Sequence[Response[SlideOutcome]]

COLUMNS = ("", "slips", "from (s)", "to (s)", "max (mm)", "residual (mm)", "final (mm)")
COLOURS = {SLIDING[0]: "#f4d9c6", SLIDING[1]: "#d5dcef", "flight": "#cfe3d4"}


def millimetres(value: float | None) -> str:
    """Return a length in millimetres, to the hundredth."""
    # adding zero after rounding turns -0.0 into 0.0
    return NOTHING if value is None else f"{round(value * 1e3, 2) + 0.0:.2f}"


def tables(responses: Slides, sweep: Sequence[SlidePoint] = ()) -> Iterator[Any]:
    """Yield, for each record, its line and one row per direction; then the sweep of directions when there was one."""
    records = list({id(r.motion.record): r.motion.record for r in responses}.values())
    for record in records:
        if record is not None:
            yield record_line(record)
        mine = [response for response in responses if response.motion.record is record]
        yield table(
            f"Sliding, {setting(mine[0])}", COLUMNS, [_row(response) for response in mine],
            caption=f"relative to the base, + in the component's positive direction{', downhill' if _slopes(mine[0]) else ''}; "
            "residual: at the record's last sample, final: once at rest on still ground",
        )  # fmt: skip
        for response in mine:
            yield Text(sentence(response))
    if sweep:
        yield Text()
        rows = [[point.component, millimetres(point.max_slip_m), millimetres(point.residual_slip_m)] for point in sweep]
        yield table("All azimuths", ("azimuth (deg)", "max (mm)", "residual (mm)"), rows)


def setting(response: Response[SlideOutcome]) -> str:
    """Say which base an object slid on."""
    base, options = response.body, response.options
    told = f"mu {base.mu:g}, kinetic {base.mu_kinetic:g}"
    if base.slope_deg:
        told += f", slope {base.slope_deg:g} deg"
        told += f" for {base.slope_length:g} m, then level" if base.slope_length else ""
    if base.one_way:
        told += ", one way"
    if options["vertical_scale"]:
        told += f", vertical motion x {options['vertical_scale']:g}"
    return told


def sentence(response: Response[SlideOutcome]) -> str:
    """Say what happened."""
    outcome, name = response.outcome, response.motion.name
    if not outcome.slips:
        return f"{name}: static friction holds throughout."
    told = f"{name}: slides up to {millimetres(outcome.max_slip_m)} mm along a path of {millimetres(outcome.path_m)} mm"
    if outcome.fell_off_slope:
        told += ", past the foot of the slope"
    if outcome.lifted_off:
        told += "; it loses contact with the base on the way"
    return told + "."


def _slopes(response: Response[SlideOutcome]) -> bool:
    """Whether the base slopes down towards the component's positive direction."""
    return bool(response.body.slope_deg > 0.0)


def _row(response: Response[SlideOutcome]) -> list[Any]:
    """Return the row of one direction."""
    outcome = response.outcome
    return [
        response.motion.name, outcome.slip_count, seconds(outcome.slip_start_s), seconds(outcome.slip_end_s),
        millimetres(outcome.max_slip_m), millimetres(outcome.residual_slip_m), millimetres(outcome.final_slip_m),
    ]  # fmt: skip


def figure(responses: Slides) -> Figure:
    """Return the figure: a column per direction; acceleration with the friction band, both velocities, relative displacement."""
    from seisblock.present import canvas

    columns = len(responses)
    made, axes = canvas.new_figure(3, columns=columns, width=4.5 + 4.0 * columns, sharex="col", height=7.0)
    for index, response in enumerate(responses):
        _column([axes[row * columns + index] for row in range(3)], response)
    return made


def _column(panels: Sequence[Any], response: Response[SlideOutcome]) -> None:
    """Draw one direction's three panels."""
    from seisblock.present import canvas

    time, phases = response.time, response.phases
    top, middle, bottom = panels
    lower, upper = response["lower_limit"], response["upper_limit"]
    canvas.curve(top, time, response["ground_acceleration"], color=canvas.INPUT)
    for index, limit in enumerate((lower, upper)):
        name = None if index else "limits of static friction"
        canvas.curve(top, time, limit, color=canvas.THRESHOLD, linestyle=(0, (6, 2, 1, 2)), label=name)
    block = response["ground_velocity"] + response["relative_velocity"]
    canvas.curve(middle, time, response["ground_velocity"], color=canvas.INPUT, label="base")
    canvas.curve(middle, time, block, color=canvas.ACCENT, label="object")
    canvas.curve(bottom, time, response["relative_displacement"] * 1e3, color=canvas.ACCENT)
    canvas.shade(middle, phases, COLOURS, names=True)
    canvas.shade(bottom, phases, COLOURS)
    bottom.axhline(0.0, color=canvas.INPUT, linewidth=0.6)
    for panel, text in zip(panels, ("z'' (m/s²)", "velocity (m/s)", "x − z (mm)"), strict=True):
        canvas.label(panel, y=text)
        canvas.legend(panel)
    canvas.label(bottom, x="t (s)")
    top.set_title(f"{response.motion.name}: {setting(response)}", fontsize=9, loc="left")
    moving = _moving(time, phases)
    if moving is not None:
        bottom.set_xlim(*moving)


def _moving(time: FloatArray, phases: Sequence[Any]) -> tuple[float, float] | None:
    """Return the stretch of time that holds all sliding, with a margin, or None when nothing slides."""
    sliding = [phase for phase in phases if phase.name in COLOURS]
    if not sliding:
        return None
    first, last = sliding[0].start_s, sliding[-1].end_s
    margin = max(0.1 * (last - first), 0.5)
    return float(np.maximum(first - margin, time[0])), float(np.minimum(last + margin, time[-1]))
