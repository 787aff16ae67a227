"""How rocking is told: a table with one column per component, and a sentence each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from seisblock.bodies.library import edges
from seisblock.present.text.tables import acceleration, acceleration_unit, line, number, record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.rock.outcome import RockOutcome
from seisblock.words import tell

Rockings = Sequence[Response[RockOutcome]]


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
                yield line(sentence)
        yield line()


def _table(responses: Rockings, *, gal: bool) -> Any:
    """Return the table of the outcomes."""
    outcomes = [response.outcome for response in responses]
    first, body = outcomes[0], responses[0].body
    title = tell(
        "{body}: alpha {alpha:.4f} rad, p {p:.3f} rad/s\nrestitution {restitution:.4f}, rocks above {threshold}",
        body=tell(body.name),
        alpha=first.slenderness_rad,
        p=first.frequency_parameter_rad_s,
        restitution=first.restitution,
        threshold=f"{acceleration(first.threshold_m_s2, gal=gal)} {acceleration_unit(gal=gal)}",
    ) + (f"\n{tell(worn)}" if (worn := edges(body)) else "")
    rows: list[tuple[str, list[Any]]] = [
        (f"PGA ({acceleration_unit(gal=gal)})", [acceleration(float(np.abs(r.motion.horizontal).max()), gal=gal) for r in responses]),
        (tell("rocking starts (s)"), [seconds(o.rocking_start_s) for o in outcomes]),
        (tell("largest lean (deg)"), [f"{math.degrees(o.max_rotation_rad):.3f}" for o in outcomes]),
        (tell("  over alpha"), [number(o.max_rotation_ratio) for o in outcomes]),
        (tell("  at (s)"), [seconds(o.max_rotation_s) for o in outcomes]),
        (tell("impacts"), [o.impacts for o in outcomes]),
        (tell("overturned"), [tell("to {side}", side=o.overturned_towards) if o.overturned else tell("no") for o in outcomes]),
        (tell("  alpha passed (s)"), [seconds(o.alpha_passed_s) for o in outcomes]),
        (tell("  lies down (s)"), [seconds(o.overturning_time_s) for o in outcomes]),
        (tell("friction needed"), [number(o.max_friction_demand) for o in outcomes]),
        (tell("  at (s)"), [seconds(o.max_friction_demand_s) for o in outcomes]),
        (tell("contact lost (s)"), [seconds(o.contact_lost_s) for o in outcomes]),
    ]
    return table(title, ["", *(r.motion.name or "x" for r in responses)], [[heading, *cells] for heading, cells in rows])


def sentences(response: Response[RockOutcome], extra: Mapping[str, Any]) -> Iterator[str]:
    """Yield the verdict, its fragility, its margins and its probability."""
    outcome, name = response.outcome, response.motion.name or "x"
    yield tell("{name}: {verdict}.", name=name, verdict=verdict(outcome))
    if "margin" in extra:
        yield from (f"  {told}" for told in _margin_lines(extra["margin"]))
    if "perturbation" in extra:
        found = extra["perturbation"]
        low, high = found.probability_interval
        yield "  " + tell(
            "overturns in {fallen} of {runs} perturbed runs: {share:.3f} (95 %: {low:.3f} to {high:.3f}).",
            fallen=found.overturned,
            runs=found.runs,
            share=found.probability,
            low=low,
            high=high,
        )


def verdict(outcome: RockOutcome) -> str:
    """Return what became of a block, and whether a small change would change it."""
    if not outcome.rocks:
        told = tell("stands still")
    elif not outcome.overturned:
        told = tell("rocks and stands: {way}", way=way_to_alpha(outcome.max_rotation_ratio))
    elif outcome.decided_after_record:
        told = tell("overturns to {side}, after the record's end", side=outcome.overturned_towards)
    else:
        told = tell("overturns to {side}", side=outcome.overturned_towards)
    return told + (tell("; a change of the record by less than 2 % changes this") if outcome.verdict_flips_within_2_percent else "")


def way_to_alpha(ratio: float) -> str:
    """Return how far a block leaned, in words."""
    if ratio < 0.01:
        return tell("it hardly moves, less than 1% of the way to alpha")
    return tell("{share:.0%} of the way to alpha", share=ratio)


def _margin_lines(margin: Any) -> Iterator[str]:
    """Yield the windows of factors in which the block overturns."""
    unsafe = [window for window in margin.windows if window.overturned]
    if not unsafe:
        yield tell("stands at every factor up to {limit:g} (looked at every {step:g}).", limit=margin.limit, step=margin.step)
        return
    shown = [tell("{first:.4f} to {last:.4f}", first=w.first, last=w.last) for w in unsafe[:8]] + ["..."] * (len(unsafe) > 8)
    yield tell(
        "overturns at factors {factors} (up to {limit:g}, looked at every {step:g}).", factors=shown, limit=margin.limit, step=margin.step
    )
    if margin.nearest_flip is not None:
        yield tell("the verdict changes next at a factor of {factor:.4f}.", factor=margin.nearest_flip)
