"""How a slide is told: a table per record, and a sentence per component."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.present.directions import moved
from seisblock.present.text.tables import NOTHING, answered, fixed, line, seconds, table
from seisblock.results import Response
from seisblock.solvers.slide.solve import SlideOutcome
from seisblock.studies.sliding import SlidePoint
from seisblock.words import listed, noted, tell

Slides = Sequence[Response[SlideOutcome]]


COLUMNS = ("", *map(noted, ("slips", "from (s)", "to (s)", "max (mm)", "residual (mm)", "final (mm)")))

RESIDUAL = noted("residual: at the record's last sample, final: once at rest on still ground")
"""What two of the columns are."""


def millimetres(value: float | None) -> str:
    """Return a length in millimetres, to the hundredth."""
    return NOTHING if value is None else fixed(value * 1e3, 2)


def tables(responses: Slides, sweep: Sequence[SlidePoint] = ()) -> Iterator[Any]:
    """Yield, for each record, its line and one row per direction; then the sweep of directions when there was one."""
    for opening, mine in answered(responses, lambda response: response.motion.record, lambda response: [line(sentence(response))]):
        yield from opening
        yield table(
            tell("Sliding, {setting}", setting=setting(mine[0])),
            [tell(heading) for heading in COLUMNS],
            [_row(response) for response in mine],
            caption=tell("{first}; {second}", first=_axis(mine[0]), second=tell(RESIDUAL)),
        )
    if sweep:
        yield line()
        rows = [[point.component, millimetres(point.max_slip_m), millimetres(point.residual_slip_m)] for point in sweep]
        yield table(tell("All azimuths"), (tell("azimuth (deg)"), tell("max (mm)"), tell("residual (mm)")), rows)


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


def sentence(response: Response[SlideOutcome]) -> str:
    """Say what happened."""
    outcome, name = response.outcome, response.motion.name
    if not outcome.slips:
        return tell("{name}: stays where it is, static friction holds throughout.", name=name)
    words = {"name": name, "most": millimetres(outcome.max_slip_m), "path": millimetres(outcome.path_m)}
    if outcome.final_slip_m is None:
        told = tell("{name}: slides up to {most} mm, over a path of {path} mm, and does not come to rest", **words)
    elif outcome.final_slip_m != outcome.residual_slip_m:
        final = moved(f"{millimetres(abs(outcome.final_slip_m))} mm", name, outcome.final_slip_m)
        told = tell(
            "{name}: slides up to {most} mm, over a path of {path} mm, while the record lasts, and comes to rest {final} from where it "
            "stood",
            final=final,
            **words,
        )
    else:
        final = moved(f"{millimetres(abs(outcome.final_slip_m))} mm", name, outcome.final_slip_m)
        told = tell("{name}: slides up to {most} mm, and ends {final} from where it stood, after a path of {path} mm", final=final, **words)
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
