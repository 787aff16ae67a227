"""How rocking is told: a table with one column per component, and a sentence each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from rich.text import Text

from seisblock.bodies.library import edges
from seisblock.present.text.tables import acceleration, acceleration_unit, number, record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.rock.outcome import RockOutcome

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
                yield Text(sentence)
        yield Text()


def _table(responses: Rockings, *, gal: bool) -> Any:
    """Return the table of the outcomes."""
    outcomes = [response.outcome for response in responses]
    first, body = outcomes[0], responses[0].body
    threshold = f"{acceleration(first.threshold_m_s2, gal=gal)} {acceleration_unit(gal=gal)}"
    title = (
        f"{body.name}: alpha {first.slenderness_rad:.4f} rad, p {first.frequency_parameter_rad_s:.3f} rad/s\n"
        f"restitution {first.restitution:.4f}, rocks above {threshold}" + (f"\n{worn}" if (worn := edges(body)) else "")
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
