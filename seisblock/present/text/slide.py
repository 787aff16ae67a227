"""How a slide is told: a table per record, and a sentence per component."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.present.directions import moved
from seisblock.present.scales import Unit, length_cell, length_unit, told_length, told_size
from seisblock.present.text.onset import SLIDES, onset
from seisblock.present.text.tables import answered, line, seconds, table
from seisblock.results import Response
from seisblock.solvers.slide.solve import SlideOutcome
from seisblock.studies.sliding import SlidePoint
from seisblock.words import listed, noted, tell

Slides = Sequence[Response[SlideOutcome]]


COLUMNS = tuple(map(noted, ("slips", "from (s)", "to (s)", "max ({unit})", "residual ({unit})", "final ({unit})")))

RESIDUAL = noted("residual: at the record's last sample, final: once at rest on still ground")
"""What two of the columns are."""


def tables(responses: Slides, sweep: Sequence[SlidePoint] = (), *, gal: bool = True) -> Iterator[Any]:
    """Yield, for each record, its line and one row per direction; then the sweep of directions when there was one."""
    for opening, mine in answered(responses, lambda each: each.motion.record, lambda each: [line(sentence(each, gal=gal))]):
        yield from opening
        unit = length_unit((length for response in mine for length in _lengths(response)), gal=gal)
        yield table(
            tell("Sliding, {setting}", setting=setting(mine[0])),
            ["", *(tell(heading, unit=unit.name) for heading in COLUMNS)],
            [_row(response, unit) for response in mine],
            caption=tell("{first}; {second}", first=_axis(mine[0]), second=tell(RESIDUAL)),
        )
    if sweep:
        yield line()
        unit = length_unit((point.max_slip_m for point in sweep), gal=gal)
        rows = [[point.component, length_cell(point.max_slip_m, unit), length_cell(point.residual_slip_m, unit)] for point in sweep]
        headings = noted("azimuth (deg)"), noted("max ({unit})"), noted("residual ({unit})")
        yield table(tell("All azimuths"), [tell(heading, unit=unit.name) for heading in headings], rows)


def setting(response: Response[SlideOutcome]) -> str:
    """Say which base an object slid on."""
    base, options = response.body, response.options
    parts = [tell("mu {mu:g}, kinetic {kinetic:g}", mu=base.mu, kinetic=base.kinetic)]
    if base.slope_deg and base.slope_length:
        parts.append(tell("slope {slope:g} deg for {length:g} m, then level", slope=base.slope_deg, length=base.slope_length))
    elif base.slope_deg:
        parts.append(tell("slope {slope:g} deg", slope=base.slope_deg))
    if base.one_way:
        parts.append(tell("one way"))
    if options["vertical"]:
        parts.append(tell("vertical motion x {factor:g}", factor=options["vertical"]))
    return listed(parts)


def _lengths(response: Response[SlideOutcome]) -> tuple[float | None, ...]:
    """Return the displacements of one direction that the table shows, m."""
    outcome = response.outcome
    return outcome.max_slip_m, outcome.residual_slip_m, outcome.final_slip_m


def sentence(response: Response[SlideOutcome], *, gal: bool = True) -> str:
    """Say what happened."""
    outcome, name = response.outcome, response.motion.name
    if not outcome.slips:
        base, options = response.body, response.options
        if base.slope_deg:
            return tell("{name}: stays where it is, static friction holds throughout.", name=name)
        gravity, vertical = options["gravity_m_s2"], options["vertical"]
        moves = onset(
            SLIDES, (base.mu, math.inf if base.one_way else base.mu), response.motion, gravity=gravity, vertical=vertical, gal=gal
        )
        return tell("{name}: stays where it is; {onset}.", name=name, onset=moves)
    unit = length_unit([outcome.max_slip_m, outcome.path_m], gal=gal)
    words = {"name": name, "most": told_size(outcome.max_slip_m, unit), "path": told_size(outcome.path_m, unit)}
    if told_size(outcome.path_m, gal=gal) != told_length(outcome.path_m, gal=gal):
        told = tell("{name}: slides {path} in all", name=name, path=told_size(outcome.path_m, gal=gal))
    elif outcome.final_slip_m is None:
        told = tell("{name}: slides up to {most}, over a path of {path}, and does not come to rest", **words)
    elif outcome.final_slip_m != outcome.residual_slip_m:
        final = moved(told_size(outcome.final_slip_m, unit), name, outcome.final_slip_m)
        told = tell(
            "{name}: slides up to {most}, over a path of {path}, while the record lasts, and comes to rest {final} from where it stood",
            final=final,
            **words,
        )
    else:
        final = moved(told_size(outcome.final_slip_m, unit), name, outcome.final_slip_m)
        told = tell("{name}: slides up to {most}, and ends {final} from where it stood, after a path of {path}", final=final, **words)
    if outcome.fell_off_slope:
        told += tell(", past the foot of the slope")
    if outcome.lifted_off:
        told += tell("; it loses contact with the base on the way")
    return tell("{sentence}.", sentence=told)


def _axis(response: Response[SlideOutcome]) -> str:
    """Return what the sign of a displacement means."""
    if response.body.slope_deg > 0.0:
        return tell("relative to the base, + in the component's positive direction, downhill")
    return tell("relative to the base, + in the component's positive direction")


def _row(response: Response[SlideOutcome], unit: Unit) -> list[Any]:
    """Return the row of one direction."""
    outcome = response.outcome
    return [
        response.motion.name,
        outcome.slip_count,
        seconds(outcome.slip_start_s),
        seconds(outcome.slip_end_s),
        *(length_cell(length, unit) for length in _lengths(response)),
    ]
