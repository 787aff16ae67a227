"""How uplift under a record is told: a table per component and a sentence."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.present.text.tables import answered, fixed, line, seconds, table
from seisblock.results import Response
from seisblock.solvers.uplift.fates import SMALL
from seisblock.solvers.uplift.outcome import UpliftOutcome
from seisblock.words import noted, strung, tell

Uplifts = Sequence[Response[UpliftOutcome]]

OUTSIDE = noted(
    "how far it lifts cannot be told: the block leans beyond {small:g} of its slenderness, where this model, without P-delta, fails."
)
"""What stands in the place of numbers that are none."""

PLACES = ("1 (+x,+y)", "2 (+x,-y)", "3 (-x,+y)", "4 (-x,-y)")
"""Names of the corners."""


def tables(responses: Uplifts, *, gal: bool) -> Iterator[Any]:
    """Yield the record, and for each component a table of the corners and what happened in words."""
    for opening, part in answered(responses, lambda each: each.motion.record, lambda each: [line(sentence(each))]):
        yield from opening
        yield from (shown for response in part for shown in _details(response))


def _details(response: Response[UpliftOutcome]) -> Iterator[Any]:
    """Yield the table of one component, and how its springs move."""
    outcome = response.outcome
    yield table(f"+x = {response.motion.name}", [tell("corner"), *PLACES], _rows(response))
    yield line(
        tell(
            "Natural frequencies {frequencies} Hz; at rest it sinks by {settlement:.2f} mm.",
            frequencies=[f"{f:.3g}" for f in outcome.natural_frequencies_hz],
            settlement=outcome.static_settlement_m * 1e3,
        )
    )
    yield line()


def _rows(response: Response[UpliftOutcome]) -> Iterator[list[str]]:
    """Yield what each corner did, a column per corner; where the model does not hold, the first uplift alone."""
    corners = response.outcome.corners
    static = response.body.static_corner_force(response.options["gravity_m_s2"])
    yield [tell("first uplift (s)"), *(seconds(c.first_uplift_s) for c in corners)]
    if not response.outcome.within_model:
        return
    yield [tell("in the air (s)"), *(seconds(c.uplift_duration_s) for c in corners)]
    yield [tell("longest in the air (s)"), *(seconds(c.longest_uplift_s) for c in corners)]
    yield [tell("highest position (mm)"), *(fixed(c.max_uplift_m * 1e3, 2) for c in corners)]
    yield [tell("... at (s)"), *(seconds(c.max_uplift_time_s) for c in corners)]
    yield [tell("largest force (kN)"), *(f"{c.max_contact_force_n / 1e3:.3f}" for c in corners)]
    yield [tell("... over static"), *(f"{c.max_contact_force_n / static:.2f}" for c in corners)]


def sentence(response: Response[UpliftOutcome]) -> str:
    """Return what happened in words."""
    outcome, name = response.outcome, response.motion.name
    if not outcome.uplifts and outcome.uplift_scale is None:
        return tell("{name}: no corner lifts.", name=name)
    if not outcome.uplifts:
        needed = outcome.uplift_scale
        return tell("{name}: no corner lifts; the motion would have to be {factor:.3g} times as strong.", name=name, factor=needed)
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
    shares = [tell("{share:.1%} on {corners}", share=share, corners=n) for n, share in outcome.share_on_corners.items() if share > 0.0]
    return first + tell(
        "; the highest uplift is {most:.2f} mm. Corners are in the air for {air:.3f} s in {changes} changes of contact ({shares} corners). "
        "{factor:.3g} times this motion just lifts one.",
        most=outcome.max_uplift_m * 1e3,
        air=outcome.uplift_duration_s,
        changes=outcome.contact_changes,
        shares=shares,
        factor=outcome.uplift_scale,
    )
