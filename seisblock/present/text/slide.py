"""How a slide is told: a table per record, and a sentence per component."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rich.text import Text

from seisblock.present.text.tables import NOTHING, record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.slide.solve import SlideOutcome
from seisblock.studies.sliding import SlidePoint

Slides = Sequence[Response[SlideOutcome]]


COLUMNS = ("", "slips", "from (s)", "to (s)", "max (mm)", "residual (mm)", "final (mm)")


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
            f"Sliding, {setting(mine[0])}",
            COLUMNS,
            [_row(response) for response in mine],
            caption=f"relative to the base, + in the component's positive direction{', downhill' if _slopes(mine[0]) else ''}; "
            "residual: at the record's last sample, final: once at rest on still ground",
        )
        for response in mine:
            yield Text(sentence(response))
    if sweep:
        yield Text()
        rows = [[point.component, millimetres(point.max_slip_m), millimetres(point.residual_slip_m)] for point in sweep]
        yield table("All azimuths", ("azimuth (deg)", "max (mm)", "residual (mm)"), rows)


def setting(response: Response[SlideOutcome]) -> str:
    """Say which base an object slid on."""
    base, options = response.body, response.options
    told = f"mu {base.mu:g}, kinetic {base.kinetic:g}"
    if base.slope_deg:
        told += f", slope {base.slope_deg:g} deg"
        told += f" for {base.slope_length:g} m, then level" if base.slope_length else ""
    if base.one_way:
        told += ", one way"
    if options["vertical"]:
        told += f", vertical motion x {options['vertical']:g}"
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
        response.motion.name,
        outcome.slip_count,
        seconds(outcome.slip_start_s),
        seconds(outcome.slip_end_s),
        millimetres(outcome.max_slip_m),
        millimetres(outcome.residual_slip_m),
        millimetres(outcome.final_slip_m),
    ]
