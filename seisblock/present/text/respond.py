"""How the fate of a free-standing object is told: what happened, how sure that is, then the numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.block import Block
from seisblock.bodies.ranges import Ranges
from seisblock.present.directions import moved, side
from seisblock.present.edges import sampled_edges
from seisblock.present.scales import Unit, acceleration_unit, length_cell, length_unit, told_length
from seisblock.present.text.onset import ROCKS, SLIDES, grip, onset
from seisblock.present.text.tables import NOTHING, answered, line, number, seconds, side_by_side, table
from seisblock.results import Response
from seisblock.solvers.respond.outcome import RespondOutcome
from seisblock.solvers.respond.tale import HOPS_ON
from seisblock.studies.runs import left_out_versions
from seisblock.studies.standing.azimuths import AzimuthFate, left_out_directions
from seisblock.studies.standing.probability import Probability
from seisblock.words import listed, noted, roughly, said, strung, tell

Responds = Sequence[Response[RespondOutcome]]

STIRS_M = 5e-4
"""A body that ends and passes nearer than this to where it stood has not moved, in words."""

FEWEST = 20
"""Quantiles of fewer versions are not told."""


def tables(responses: Responds, extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Iterator[Any]:
    """Yield, per record, its line, what happened and how sure it is, a table with a column per component, and the notes."""
    both = zip(responses, extras, strict=True)
    for opening, part in answered(both, lambda each: each[0].motion.record, lambda each: _happened(*each, gal=gal)):
        yield from opening
        yield _table([r for r, _ in part], gal=gal)
        if any("probability" in extra for _, extra in part):
            yield line(varied(*next((extra["probability"], each.body) for each, extra in part if "probability" in extra)), "dim")
        yield line()
        for _, extra in part:
            if "directions" in extra:
                yield _directions(extra["directions"], gal=gal)


def _happened(response: Response[RespondOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Text]:
    """Yield what happened, and how sure that is."""
    yield line(verdict(response, gal=gal), "bold")
    if "probability" in extra:
        yield line("  " + share(extra["probability"], gal=gal))
    if "directions" in extra:
        yield line("  " + around(extra["directions"]))


def verdict(response: Response[RespondOutcome], *, gal: bool = True) -> str:
    """Return what happened, in words."""
    outcome, name = response.outcome, response.motion.name
    if outcome.overturned:
        at = outcome.overturning_time_s
        assert at is not None
        slid = tell(", having slid {path}", path=told_length(outcome.slip_path_m, gal=gal)) if outcome.slip_path_m >= STIRS_M else ""
        towards = side(name, outcome.overturned_towards)
        if at > response.motion.time[-1]:
            words = tell("overturns to {towards} at {time:.2f} s, after the record{slid}", towards=towards, time=at, slid=slid)
        else:
            words = tell("overturns to {towards} at {time:.2f} s{slid}", towards=towards, time=at, slid=slid)
    elif outcome.outcome == "rests":
        ratio, mu = min(response.body.arms) / response.body.centre, grip(response.options)
        first = SLIDES if mu <= ratio else ROCKS
        shares = tuple(min(mu, arm / response.body.centre) for arm in response.body.arms)
        gravity, vertical = response.options["gravity_m_s2"], response.options["vertical"]
        moves = onset(first, (shares[0], shares[1]), response.motion, gravity=gravity, vertical=vertical, gal=gal)
        words = tell("{verdict}; {onset}", verdict=tell("stands still"), onset=moves)
    elif outcome.outcome == HOPS_ON:
        words = tell("no answer: given up at {time:.2f} s after {impacts} impacts", time=outcome.end_s, impacts=outcome.impacts)
    else:
        words = listed(_stays(response, gal=gal))
    flag = tell("; a change of the input by a millionth changes this") if outcome.sensitive else ""
    return tell("{name}: {words}{flag}.", name=name or "x", words=words, flag=flag)


def _stays(response: Response[RespondOutcome], *, gal: bool) -> Iterator[str]:
    """Yield what a body did that has moved and not fallen."""
    outcome, name = response.outcome, response.motion.name
    time = outcome.time_in_mode_s
    rocks = bool(time["rock"] or time["slide_rock"])
    unit = length_unit([outcome.slip_path_m, outcome.final_displacement_m], gal=gal)
    if rocks:
        yield tell("rocks to {share} of the way to alpha", share=roughly(outcome.max_rotation_ratio))
    if outcome.slip_path_m >= STIRS_M:
        yield tell("slides {path} in all", path=told_length(outcome.slip_path_m, unit))
    elif outcome.slip_path_m > 0.0 and not rocks:
        yield tell("slides less than half a millimetre")
    if outcome.flights and time["flight"] >= 1e-3:
        yield tell("leaves the ground for {time:.2f} s", time=time["flight"])
    if not rocks:
        yield tell("never rocks")
    end = outcome.final_displacement_m
    if not outcome.settled:
        yield tell("moves on")
    elif abs(end) >= STIRS_M:
        yield tell("comes to rest {moved}", moved=moved(told_length(abs(end), unit), name, end))
    else:
        yield tell("comes to rest where it stood")


def share(found: Probability, *, gal: bool = True) -> str:
    """Return how many versions fall and move, as a sentence; never as if it were the object's own probability."""
    fallen = round(found.overturned * found.runs)
    low, high = found.interval
    if fallen == 0:
        falls = tell("none of {runs} plausible versions falls", runs=found.runs)
    elif fallen == found.runs:
        falls = tell("all {runs} plausible versions fall", runs=found.runs)
    else:
        one = noted("1 of {runs} plausible versions falls, {share} ({low} to {high})")
        more = noted("{fallen} of {runs} plausible versions fall, {share} ({low} to {high})")
        falls = tell(
            one if fallen == 1 else more,
            fallen=fallen,
            runs=found.runs,
            share=roughly(found.overturned),
            low=roughly(low),
            high=roughly(high),
        )
    far = told_length(found.moved_m, gal=gal)
    if found.moved in (0.0, 1.0):
        moves = tell("all move more than {far}", far=far) if found.moved else tell("none moves more than {far}", far=far)
    else:
        moves = tell("{share} move more than {far}", share=roughly(found.moved), far=far)
    middle = ""
    if found.moved > 0.0 and found.runs - fallen >= FEWEST:
        ends = [found.final_displacement_m[name] for name in ("q05", "q95")]
        least, most = (signed(end, length_unit(ends, gal=gal)) for end in ends)
        if least == most == "0":
            middle = tell("; nine in ten of those that stand end where they stood")
        else:
            middle = tell("; nine in ten of those that stand end between {low} and {high}", low=least, high=most)
    whole = tell("{falls}; {moves}{middle}.", falls=falls, moves=moves, middle=middle)
    left_out = left_out_versions(found.no_answer, found.runs)
    return whole if left_out is None else strung([whole, f"{tell(left_out)}."])


def signed(value_m: float, unit: Unit) -> str:
    """Return a length with its sign; what has not moved has none."""
    if abs(value_m) < STIRS_M:
        return "0"
    return f"{'+' * (value_m > 0.0)}{told_length(value_m, unit)}"


def around(found: Sequence[Any]) -> str:
    """Return in how many directions it falls."""
    fallen = sum(each.overturned for each in found)
    answered = sum(not each.gave_up for each in found)
    worst = tell("falls in {fallen} of {all} directions; this is the worst.", fallen=fallen, all=answered)
    return strung([worst, *(f"{tell(text)}." for text in left_out_directions(found))])


def _directions(found: Sequence[AzimuthFate], *, gal: bool) -> Any:
    """Return the table of all directions, in their order."""
    rows = []
    unit = length_unit((each.max_displacement_m for each in found), gal=gal)
    for each in sorted(found, key=lambda each: each.azimuth_deg):
        fell = falls_to(each.azimuth_deg, each.overturned_towards)
        far = [length_cell(value, unit) for value in (each.max_displacement_m, each.final_displacement_m)]
        rows.append([f"{each.azimuth_deg:g}", f"{math.degrees(each.max_rotation_rad):.3f}", *far, fell, seconds(each.end_s)])
    headings = (
        noted("azimuth (deg)"), noted("lean (deg)"), noted("furthest ({unit})"), noted("ends at ({unit})"), noted("falls to (deg)"),
        noted("end (s)"),
    )  # fmt: skip
    return table(tell("All azimuths"), [tell(heading, unit=unit.name) for heading in headings], rows)


def falls_to(azimuth: float, towards: str | None) -> str:
    """Return the azimuth to which a body falls whose +x points to one, nothing where it stands.

    Examples
    --------
    >>> falls_to(40.0, "-x"), falls_to(40.0, None)
    ('220', '-')
    """
    return NOTHING if towards is None else f"{(azimuth + (180.0 if towards == '-x' else 0.0)) % 360.0:g}"


def varied(found: Probability, block: Block) -> str:
    """Return what was varied, and what the share is worth."""
    by, known = found.versions, found.ranges or Ranges()
    return tell(
        "of this model's scatter alone: {sizes}, {edges}, {friction}, restitution ±{restitution:g}, amplitude ±{amplitude}, "
        "direction ±{azimuth:g} degrees; in runs of two granite rocks on shaking tables 3 % fell where none of 20 versions did, and 2 % "
        "stood where all fell",
        sizes=said("width and height ±{share}", share=roughly(by.size)),
        edges=sampled_edges(block, found.ranges, by.inset),
        friction=(known.friction if by.mu else None) or said("friction ±{share}", share=roughly(by.mu)),
        restitution=by.restitution,
        amplitude=roughly(by.amplitude),
        azimuth=by.azimuth_deg,
    )


def _table(responses: Responds, *, gal: bool) -> Any:
    """Return the numbers, a column per component."""
    block, options, outcomes = responses[0].body, responses[0].options, [response.outcome for response in responses]
    own = any(response.body != block for response in responses)
    ratio = min(block.arms) / block.centre
    held, level = grip(options), acceleration_unit(gal=gal)
    onset = min(held, ratio) * options["gravity_m_s2"] / level.size
    unit = length_unit((far for o in outcomes for far in (o.max_displacement_m, o.slip_path_m)), gal=gal)
    given = {"name": tell(block.name), "mu": options["mu"], "kinetic": options["mu_kinetic"]}
    frictions = noted("{name}: mu {mu:g}, kinetic {kinetic:g}")
    title = noted("{name}: b/h {ratio:.3f}, mu {mu:g}, kinetic {kinetic:g}; {first} first, above {onset}")
    if options["tenon_m"]:
        given["tenon"] = told_length(options["tenon_m"], gal=gal)
        frictions = noted("{name}: tenons {tenon}; once left, mu {mu:g}, kinetic {kinetic:g}")
        title = noted("{name}: b/h {ratio:.3f}, tenons {tenon}; once left, mu {mu:g}, kinetic {kinetic:g}; {first} first, above {onset}")
    if not own:
        first = tell("slides") if held <= ratio else tell("rocks")
        given |= {"ratio": ratio, "first": first, "onset": f"{onset:.{0 if gal else 2}f} {level.name}"}
    spent = [o.time_in_mode_s for o in outcomes]
    rows: list[tuple[str, list[Any]]] = [
        *([(tell("b/h"), [f"{min(r.body.arms) / r.body.centre:.3f}" for r in responses])] if own else []),
        (tell("outcome"), [tell(o.outcome) for o in outcomes]),
        (tell("largest lean (deg)"), [f"{math.degrees(o.max_rotation_rad):.3f}" for o in outcomes]),
        (tell("  over alpha"), [number(o.max_rotation_ratio) for o in outcomes]),
        (tell("ends at ({unit})", unit=unit.name), [length_cell(o.final_displacement_m, unit) for o in outcomes]),
        (tell("furthest from start ({unit})", unit=unit.name), [length_cell(o.max_displacement_m, unit) for o in outcomes]),
        (tell("slip path ({unit})", unit=unit.name), [length_cell(o.slip_path_m, unit) for o in outcomes]),
        (tell("flights, impacts"), [f"{o.flights}, {o.impacts}" for o in outcomes]),
        (tell("  slides, rocks (s)"), [f"{seconds(s['slide'])}, {seconds(s['rock'])}" for s in spent]),
        (tell("  both, in flight (s)"), [f"{seconds(s['slide_rock'])}, {seconds(s['flight'])}" for s in spent]),
        (tell("lost to friction, impacts (J)"), [f"{number(o.energy_friction_j)}, {number(o.energy_impacts_j)}" for o in outcomes]),
    ]
    heading = tell(frictions if own else title, **given)
    return side_by_side(heading, ["", *(r.motion.name or "x" for r in responses)], [[called, *cells] for called, cells in rows])
