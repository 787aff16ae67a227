"""How uplift under a record is told: a table per component and a sentence."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rich.text import Text

from seisblock.present.text.tables import record_line, seconds, table
from seisblock.results import Response
from seisblock.solvers.uplift.solve import UpliftOutcome

Uplifts = Sequence[Response[UpliftOutcome]]

PLACES = ("1 (+x,+y)", "2 (+x,-y)", "3 (-x,+y)", "4 (-x,-y)")
"""Names of the corners."""


def tables(responses: Uplifts, *, gal: bool) -> Iterator[Any]:
    """Yield the record, and for each component a table of the corners and what happened in words."""
    seen: set[int] = set()
    for response in responses:
        record = response.motion.record
        if record is not None and id(record) not in seen:
            seen.add(id(record))
            yield record_line(record)
        outcome = response.outcome
        frequencies = ", ".join(f"{f:.3g}" for f in outcome.natural_frequencies_hz)
        yield table(f"+x = {response.motion.name}", ["corner", *PLACES], _rows(response))
        yield Text(f"Natural frequencies {frequencies} Hz; at rest it sinks by {outcome.static_settlement_m * 1e3:.2f} mm.")
        yield Text(sentence(response))
        yield Text()


def _rows(response: Response[UpliftOutcome]) -> Iterator[list[str]]:
    """Yield what each corner did, a column per corner."""
    corners = response.outcome.corners
    static = response.body.static_corner_force(response.options["gravity_m_s2"])
    yield ["first uplift (s)", *(seconds(c.first_uplift_s) for c in corners)]
    yield ["in the air (s)", *(seconds(c.uplift_duration_s) for c in corners)]
    yield ["longest in the air (s)", *(seconds(c.longest_uplift_s) for c in corners)]
    yield ["highest position (mm)", *(f"{c.max_uplift_m * 1e3:.2f}" for c in corners)]
    yield ["... at (s)", *(seconds(c.max_uplift_time_s) for c in corners)]
    yield ["largest force (kN)", *(f"{c.max_contact_force_n / 1e3:.3f}" for c in corners)]
    yield ["... over static", *(f"{c.max_contact_force_n / static:.2f}" for c in corners)]


def sentence(response: Response[UpliftOutcome]) -> str:
    """Return what happened in words."""
    outcome = response.outcome
    if not outcome.uplifts:
        needed = "" if outcome.uplift_scale is None else f"; the motion would have to be {outcome.uplift_scale:.3g} times as strong"
        return f"{response.motion.name}: no corner lifts{needed}."
    shares = ", ".join(f"{share:.1%} on {n}" for n, share in outcome.share_on_corners.items() if share > 0.0)
    several = len(outcome.first_corners) > 1
    first = f"corner{'s' if several else ''} {' and '.join(map(str, outcome.first_corners))} lift{'' if several else 's'} first"
    return (
        f"{response.motion.name}: {first}, at {outcome.first_uplift_s:.3f} s; the highest uplift is "
        f"{outcome.max_uplift_m * 1e3:.2f} mm. Corners are in the air for {outcome.uplift_duration_s:.3f} s in "
        f"{outcome.contact_changes} changes of contact ({shares} corners). {outcome.uplift_scale:.3g} times this motion just lifts one."
    )
