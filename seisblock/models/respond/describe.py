"""Text of the full response: verdict, and a table of the outcome."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import N_, format_share, gettext, join_list
from seisblock.core.results import Response
from seisblock.models.respond.names import OutcomeName
from seisblock.models.respond.options import effective_friction
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.output.directions import direction_label, with_direction
from seisblock.output.text.section import SEVERE, Section
from seisblock.output.text.tables import (
    format_number,
    format_seconds,
    impacts_cell,
    side_by_side,
    tilt_ratio_cell,
)
from seisblock.output.text.threshold import ROCKS, SLIDES, threshold_text
from seisblock.output.units_display import Unit, acceleration_unit, format_length, length_cell, length_unit

Responses = Sequence[Response[RespondOutcome]]

OUTCOME_TEXTS: dict[str, str] = {OutcomeName.STILL_BOUNCING: N_("no result")}
"""Texts of the outcomes whose names in JSON are not read as such."""

MIN_SLIP_M = 5e-4
"""Displacements below this are reported as zero, m."""


def describe(response: Response[RespondOutcome], *, gal: bool = True, name: str = "") -> str:
    """Return the outcome in a sentence.

    Parameters
    ----------
    response : Response
    gal : bool
    name : str
        Begin of the sentence; by default the component.
    """
    return gettext("{name}: {verdict}.", name=name or response.motion.name or "x", verdict=outcome_text(response, gal=gal))


def outcome_text(response: Response[RespondOutcome], *, gal: bool = True) -> str:
    """Return the outcome without component and full stop."""
    outcome, name = response.outcome, response.motion.name
    if outcome.overturned:
        at = outcome.overturning_time_s
        assert at is not None
        slid = (
            gettext(", after sliding {path}", path=format_length(outcome.slip_path_m, gal=gal)) if outcome.slip_path_m >= MIN_SLIP_M else ""
        )
        towards = direction_label(name, outcome.overturned_towards)
        if at > response.motion.time[-1]:
            words = gettext(
                "overturns to {towards} at {time:.2f} s, after the end of the record{slid}", towards=towards, time=at, slid=slid
            )
        else:
            words = gettext("overturns to {towards} at {time:.2f} s{slid}", towards=towards, time=at, slid=slid)
    elif outcome.outcome == OutcomeName.RESTS:
        ratio, mu = min(response.body.arms) / response.body.centre, effective_friction(response.options)
        template = SLIDES if mu <= ratio else ROCKS
        shares = tuple(min(mu, arm / response.body.centre) for arm in response.body.arms)
        gravity, vertical = response.options.gravity, response.options.vertical
        onset_text = threshold_text(template, (shares[0], shares[1]), response.motion, gravity=gravity, vertical=vertical, gal=gal)
        words = gettext("{verdict}; {onset}", verdict=gettext("remains at rest"), onset=onset_text)
    elif outcome.outcome == OutcomeName.STILL_BOUNCING:
        words = gettext("no result: analysis stopped at {time:.2f} s after {impacts} impacts", time=outcome.end_s, impacts=outcome.impacts)
    else:
        words = gettext("{motion}; {end}", motion=join_list(_motion_parts(response, gal=gal)), end=_final_text(response, gal=gal))
    flag = gettext("; sensitive: an input change of 2e-6 alters the result") if outcome.sensitive else ""
    return words + flag


def _motion_parts(response: Response[RespondOutcome], *, gal: bool) -> Iterator[str]:
    """Yield the kinds of motion of a body that did not overturn, with their size."""
    outcome = response.outcome
    time = outcome.time_in_mode_s
    rocks = bool(time["rock"] or time["slide_rock"])
    if rocks:
        yield rocking_text(outcome.max_rotation_ratio)
    if outcome.slip_path_m >= MIN_SLIP_M:
        yield gettext("slides {path} in total", path=format_length(outcome.slip_path_m, _length_unit(outcome, gal=gal)))
    elif outcome.slip_path_m > 0.0 and not rocks:
        yield gettext("slides less than 0.5 mm")
    if outcome.flights and time["flight"] >= 1e-3:
        yield gettext("in flight for {time:.2f} s", time=time["flight"])
    if not rocks:
        yield gettext("no rocking")


def rocking_text(ratio: float) -> str:
    """Return the extent of rocking without overturning; `ratio` is the peak tilt over the overturning angle."""
    if ratio < 0.01:
        return gettext("rocks slightly (peak tilt less than 1 % of the overturning angle)")
    return gettext("rocks (peak tilt {share} of the overturning angle)", share=format_share(ratio))


def _final_text(response: Response[RespondOutcome], *, gal: bool) -> str:
    """Return the residual displacement of a body that did not overturn."""
    outcome, name = response.outcome, response.motion.name
    displacement = outcome.final_displacement_m
    if not outcome.settled:
        return gettext("still moving at the end of the analysis")
    if abs(displacement) < MIN_SLIP_M:
        return gettext("no residual displacement")
    length = format_length(abs(displacement), _length_unit(outcome, gal=gal))
    return gettext("residual displacement {moved}", moved=with_direction(length, name, displacement))


def _length_unit(outcome: RespondOutcome, *, gal: bool) -> Unit:
    """Return the common unit of slip path and residual displacement."""
    return length_unit([outcome.slip_path_m, outcome.final_displacement_m], gal=gal)


def outcome_table(responses: Responses, *, gal: bool) -> Any:
    """Return the table of the outcome, a column per direction."""
    block, options, outcomes = responses[0].body, responses[0].options, [response.outcome for response in responses]
    varies = any(response.body != block for response in responses)
    ratio = min(block.arms) / block.centre
    friction, level = effective_friction(options), acceleration_unit(gal=gal)
    onset = min(friction, ratio) * options.gravity / level.size
    unit = length_unit((length for o in outcomes for length in (o.max_displacement_m, o.slip_path_m)), gal=gal)
    values = {"name": gettext(body_name(block.name)), "mu": options.mu, "kinetic": options.mu_kinetic}
    frictions = N_("{name}: mu {mu:g}, kinetic {kinetic:g}")
    title = N_("{name}: b/h {ratio:.3f}, mu {mu:g}, kinetic {kinetic:g}; {first} first, above {onset}")
    if options.tenon:
        values["tenon"] = format_length(options.tenon, gal=gal)
        frictions = N_("{name}: tenons {tenon}; out of the mortises: mu {mu:g}, kinetic {kinetic:g}")
        title = N_(
            "{name}: b/h {ratio:.3f}, tenons {tenon}; out of the mortises: mu {mu:g}, kinetic {kinetic:g}; {first} first, above {onset}"
        )
    if not varies:
        first = gettext("slides") if friction <= ratio else gettext("rocks")
        values |= {"ratio": ratio, "first": first, "onset": f"{onset:.{0 if gal else 2}f} {level.name}"}
    mode_times = [o.time_in_mode_s for o in outcomes]
    rows: list[tuple[str, list[Any]]] = [
        *([(gettext("b/h"), [f"{min(r.body.arms) / r.body.centre:.3f}" for r in responses])] if varies else []),
        (gettext("outcome"), [gettext(OUTCOME_TEXTS.get(o.outcome, o.outcome)) for o in outcomes]),
        (gettext("peak tilt (deg)"), [f"{math.degrees(o.max_rotation_rad):.3f}" for o in outcomes]),
        (gettext("  over alpha"), [tilt_ratio_cell(o.max_rotation_ratio, overturned=o.overturned) for o in outcomes]),
        (gettext("residual ({unit})", unit=unit.name), [length_cell(o.final_displacement_m, unit) for o in outcomes]),
        (gettext("max. displacement ({unit})", unit=unit.name), [length_cell(o.max_displacement_m, unit) for o in outcomes]),
        (gettext("slip path ({unit})", unit=unit.name), [length_cell(o.slip_path_m, unit) for o in outcomes]),
        (gettext("flights, impacts"), [f"{o.flights}, {impacts_cell(o.impacts, o.max_rotation_ratio)}" for o in outcomes]),
        (gettext("  slide, rock (s)"), [f"{format_seconds(s['slide'])}, {format_seconds(s['rock'])}" for s in mode_times]),
        (gettext("  slide-rock, flight (s)"), [f"{format_seconds(s['slide_rock'])}, {format_seconds(s['flight'])}" for s in mode_times]),
        (
            gettext("friction, impact losses (J)"),
            [f"{format_number(o.energy_friction_j)}, {format_number(o.energy_impacts_j)}" for o in outcomes],
        ),
    ]
    heading = gettext(frictions if varies else title, **values)
    return side_by_side(heading, ["", *(r.motion.name or "x" for r in responses)], [[row_name, *cells] for row_name, cells in rows])


def _severity(outcome: RespondOutcome) -> float:
    """Return the severity of a response; of two that overturn, the earlier one is worse."""
    if outcome.overturned:
        assert outcome.overturning_time_s is not None
        return SEVERE + 1.0 + 1.0 / (1.0 + outcome.overturning_time_s)
    return min(max(outcome.max_rotation_ratio, outcome.slip_path_m), SEVERE - 0.1)


SECTION = Section(
    title=N_("Full response"),
    severity=_severity,
    verdict=describe,
    sentences=lambda response: iter([describe(response)]),
)
