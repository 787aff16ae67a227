"""How uplift under a record is told: a table per component and a sentence."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.present.scales import length_cell, length_unit, told_length
from seisblock.present.text.onset import times
from seisblock.present.text.tables import answered, line, seconds, table
from seisblock.results import Response
from seisblock.solvers.uplift.fates import SMALL
from seisblock.solvers.uplift.outcome import UpliftOutcome
from seisblock.words import noted, strung, tell

Uplifts = Sequence[Response[UpliftOutcome]]

OUTSIDE = noted(
    "how far it lifts cannot be told: the block leans beyond {small:g} of its slenderness, where this model, without P-delta, fails."
)
"""What stands in the place of numbers that are none."""

TOLD = 5e-4
"""A smaller share of the time would be written as 0.0 %."""

PLACES = ("1 (+x,+y)", "2 (+x,-y)", "3 (-x,+y)", "4 (-x,-y)")
"""Names of the corners."""


def tables(responses: Uplifts, *, gal: bool) -> Iterator[Any]:
    """Yield the record, and for each component a table of the corners and what happened in words."""
    for opening, part in answered(responses, lambda each: each.motion.record, lambda each: [line(sentence(each, gal=gal))]):
        yield from opening
        yield from (shown for response in part for shown in _details(response, gal=gal))


def _details(response: Response[UpliftOutcome], *, gal: bool) -> Iterator[Any]:
    """Yield the table of one component, and how its springs move."""
    outcome = response.outcome
    yield table(f"+x = {response.motion.name}", [tell("corner"), *PLACES], _rows(response, gal=gal))
    yield line(
        tell(
            "Natural frequencies {frequencies} Hz; at rest it sinks by {settlement}.",
            frequencies=[f"{f:.3g}" for f in outcome.natural_frequencies_hz],
            settlement=told_length(outcome.static_settlement_m, gal=gal),
        )
    )
    yield line()


def _rows(response: Response[UpliftOutcome], *, gal: bool) -> Iterator[list[str]]:
    """Yield what each corner did, a column per corner; where the model does not hold, the first uplift alone."""
    corners = response.outcome.corners
    static = response.body.static_corner_force(response.options["gravity_m_s2"])
    yield [tell("first uplift (s)"), *(seconds(c.first_uplift_s) for c in corners)]
    if not response.outcome.within_model:
        return
    yield [tell("in the air (s)"), *(seconds(c.uplift_duration_s) for c in corners)]
    yield [tell("longest in the air (s)"), *(seconds(c.longest_uplift_s) for c in corners)]
    unit = length_unit((c.max_uplift_m for c in corners), gal=gal)
    yield [tell("highest position ({unit})", unit=unit.name), *(length_cell(c.max_uplift_m, unit) for c in corners)]
    yield [tell("... at (s)"), *(seconds(c.max_uplift_time_s) for c in corners)]
    yield [tell("largest force (kN)"), *(f"{c.max_contact_force_n / 1e3:.3f}" for c in corners)]
    yield [tell("... over static"), *(f"{c.max_contact_force_n / static:.2f}" for c in corners)]


def sentence(response: Response[UpliftOutcome], *, gal: bool = True) -> str:
    """Return what happened in words."""
    outcome, name = response.outcome, response.motion.name
    if not outcome.uplifts:
        if outcome.uplift_scale is None:
            return tell("{name}: no corner lifts.", name=name)
        needed = times(outcome.uplift_scale)
        return tell("{name}: no corner lifts; the motion would have to be {factor} times as strong.", name=name, factor=needed)
    corners = outcome.first_corners
    if len(corners) > 1:
        numbers = tell(" and ").join(map(str, corners))
        first = tell("{name}: corners {corners} lift first, at {time:.3f} s", name=name, corners=numbers, time=outcome.first_uplift_s)
    else:
        first = tell("{name}: corner {corner} lifts first, at {time:.3f} s", name=name, corner=corners[0], time=outcome.first_uplift_s)
    if not outcome.within_model:
        told = tell(OUTSIDE, small=SMALL)
        scaled = tell("{factor:.3g} times this motion just lifts one.", factor=outcome.uplift_scale)
        return strung([tell("{first}; {second}", first=first, second=told), scaled])
    shares = [tell("{share:.1%} on {corners}", share=share, corners=n) for n, share in outcome.share_on_corners.items() if share >= TOLD]
    return first + tell(
        "; the highest uplift is {most}. Corners are in the air for {air:.3f} s in {changes} changes of contact ({shares} corners). "
        "{factor:.3g} times this motion just lifts one.",
        most=told_length(outcome.max_uplift_m, gal=gal),
        air=outcome.uplift_duration_s,
        changes=outcome.contact_changes,
        shares=shares,
        factor=outcome.uplift_scale,
    )
