"""How the fate of a free-standing object is told: what happened, how sure that is, then the numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.block import Block
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core.i18n import N_, format_share, gettext, join_list, join_sentences, lazy_gettext
from seisblock.core.results import Response
from seisblock.models.respond.describe import ENDLESS_HOPS
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.report.describe_wear import sampled_edges
from seisblock.report.directions import direction_label, with_direction
from seisblock.report.text.tables import DASH, format_number, format_seconds, group_answers, side_by_side, styled_line, table
from seisblock.report.text.threshold import ROCKS, SLIDES, effective_friction, threshold_text
from seisblock.report.units_display import Unit, acceleration_unit, format_length, length_cell, length_unit
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.respond.azimuths import RespondAzimuth, left_out_directions
from seisblock.studies.respond.probability import Probability

Responses = Sequence[Response[RespondOutcome]]

MIN_SLIP_M = 5e-4
"""A body that ends and passes nearer than this to where it stood has not moved, in words."""

MIN_SURVIVORS = 20
"""Quantiles of fewer versions are not told."""


def tables(responses: Responses, extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Iterator[Any]:
    """Yield, per record, its line, what happened and how sure it is, a table with a column per component, and the notes."""
    pairs = zip(responses, extras, strict=True)
    for heading, part in group_answers(pairs, lambda pair: pair[0].motion.record, lambda pair: _summary(*pair, gal=gal)):
        yield from heading
        yield _outcome_table([r for r, _ in part], gal=gal)
        if any("probability" in extra for _, extra in part):
            yield styled_line(
                variation_text(*next((extra["probability"], pair.body) for pair, extra in part if "probability" in extra)), "dim"
            )
        yield styled_line()
        for _, extra in part:
            if "directions" in extra:
                yield _direction_table(extra["directions"], gal=gal)


def _summary(response: Response[RespondOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Text]:
    """Yield what happened, and how sure that is."""
    yield styled_line(verdict(response, gal=gal), "bold")
    if "probability" in extra:
        yield styled_line("  " + probability_sentence(extra["probability"], gal=gal))
    if "directions" in extra:
        yield styled_line("  " + direction_sentence(extra["directions"]))


def verdict(response: Response[RespondOutcome], *, gal: bool = True) -> str:
    """Return what happened, in words."""
    outcome, name = response.outcome, response.motion.name
    if outcome.overturned:
        at = outcome.overturning_time_s
        assert at is not None
        slid = (
            gettext(", having slid {path}", path=format_length(outcome.slip_path_m, gal=gal)) if outcome.slip_path_m >= MIN_SLIP_M else ""
        )
        towards = direction_label(name, outcome.overturned_towards)
        if at > response.motion.time[-1]:
            words = gettext("overturns to {towards} at {time:.2f} s, after the record{slid}", towards=towards, time=at, slid=slid)
        else:
            words = gettext("overturns to {towards} at {time:.2f} s{slid}", towards=towards, time=at, slid=slid)
    elif outcome.outcome == "rests":
        ratio, mu = min(response.body.arms) / response.body.centre, effective_friction(response.options)
        template = SLIDES if mu <= ratio else ROCKS
        shares = tuple(min(mu, arm / response.body.centre) for arm in response.body.arms)
        gravity, vertical = response.options["gravity_m_s2"], response.options["vertical"]
        onset_text = threshold_text(template, (shares[0], shares[1]), response.motion, gravity=gravity, vertical=vertical, gal=gal)
        words = gettext("{verdict}; {onset}", verdict=gettext("stands still"), onset=onset_text)
    elif outcome.outcome == ENDLESS_HOPS:
        words = gettext("no answer: given up at {time:.2f} s after {impacts} impacts", time=outcome.end_s, impacts=outcome.impacts)
    else:
        words = join_list(_motion_parts(response, gal=gal))
    flag = gettext("; a change of the input by a millionth changes this") if outcome.sensitive else ""
    return gettext("{name}: {words}{flag}.", name=name or "x", words=words, flag=flag)


def _motion_parts(response: Response[RespondOutcome], *, gal: bool) -> Iterator[str]:
    """Yield what a body did that has moved and not fallen."""
    outcome, name = response.outcome, response.motion.name
    time = outcome.time_in_mode_s
    rocks = bool(time["rock"] or time["slide_rock"])
    unit = length_unit([outcome.slip_path_m, outcome.final_displacement_m], gal=gal)
    if rocks:
        yield gettext("rocks to {share} of the way to alpha", share=format_share(outcome.max_rotation_ratio))
    if outcome.slip_path_m >= MIN_SLIP_M:
        yield gettext("slides {path} in all", path=format_length(outcome.slip_path_m, unit))
    elif outcome.slip_path_m > 0.0 and not rocks:
        yield gettext("slides less than half a millimetre")
    if outcome.flights and time["flight"] >= 1e-3:
        yield gettext("leaves the ground for {time:.2f} s", time=time["flight"])
    if not rocks:
        yield gettext("never rocks")
    end = outcome.final_displacement_m
    if not outcome.settled:
        yield gettext("moves on")
    elif abs(end) >= MIN_SLIP_M:
        yield gettext("comes to rest {moved}", moved=with_direction(format_length(abs(end), unit), name, end))
    else:
        yield gettext("comes to rest where it stood")


def probability_sentence(probability: Probability, *, gal: bool = True) -> str:
    """Return how many versions fall and move, as a sentence; never as if it were the object's own probability."""
    fall_count = round(probability.overturned * probability.runs)
    low, high = probability.interval
    if fall_count == 0:
        falls = gettext("none of {runs} plausible versions falls", runs=probability.runs)
    elif fall_count == probability.runs:
        falls = gettext("all {runs} plausible versions fall", runs=probability.runs)
    else:
        singular = N_("1 of {runs} plausible versions falls, {share} ({low} to {high})")
        plural = N_("{fallen} of {runs} plausible versions fall, {share} ({low} to {high})")
        falls = gettext(
            singular if fall_count == 1 else plural,
            fallen=fall_count,
            runs=probability.runs,
            share=format_share(probability.overturned),
            low=format_share(low),
            high=format_share(high),
        )
    length = format_length(probability.moved_m, gal=gal)
    if probability.moved in (0.0, 1.0):
        moves = gettext("all move more than {far}", far=length) if probability.moved else gettext("none moves more than {far}", far=length)
    else:
        moves = gettext("{share} move more than {far}", share=format_share(probability.moved), far=length)
    middle = ""
    if probability.moved > 0.0 and probability.runs - fall_count >= MIN_SURVIVORS:
        ends = [probability.final_displacement_m[name] for name in ("q05", "q95")]
        lower, upper = (format_signed(end, length_unit(ends, gal=gal)) for end in ends)
        if lower == upper == "0":
            middle = gettext("; nine in ten of those that stand end where they stood")
        else:
            middle = gettext("; nine in ten of those that stand end between {low} and {high}", low=lower, high=upper)
    whole = gettext("{falls}; {moves}{middle}.", falls=falls, moves=moves, middle=middle)
    left_out = left_out_versions(probability.no_answer, probability.runs)
    return whole if left_out is None else join_sentences([whole, f"{gettext(left_out)}."])


def format_signed(value_m: float, unit: Unit) -> str:
    """Return a length with its sign; what has not moved has none."""
    if abs(value_m) < MIN_SLIP_M:
        return "0"
    return f"{'+' * (value_m > 0.0)}{format_length(value_m, unit)}"


def direction_sentence(results: Sequence[Any]) -> str:
    """Return in how many directions it falls."""
    fall_count = sum(result.overturned for result in results)
    answered = sum(not result.gave_up for result in results)
    worst = gettext("falls in {fallen} of {all} directions; this is the worst.", fallen=fall_count, all=answered)
    return join_sentences([worst, *(f"{gettext(text)}." for text in left_out_directions(results))])


def _direction_table(results: Sequence[RespondAzimuth], *, gal: bool) -> Any:
    """Return the table of all directions, in their order."""
    rows = []
    unit = length_unit((result.max_displacement_m for result in results), gal=gal)
    for result in sorted(results, key=lambda result: result.azimuth_deg):
        fall_cell = fall_azimuth(result.azimuth_deg, result.overturned_towards)
        lengths = [length_cell(value, unit) for value in (result.max_displacement_m, result.final_displacement_m)]
        rows.append(
            [f"{result.azimuth_deg:g}", f"{math.degrees(result.max_rotation_rad):.3f}", *lengths, fall_cell, format_seconds(result.end_s)]
        )
    headings = (
        N_("azimuth (deg)"), N_("lean (deg)"), N_("furthest ({unit})"), N_("ends at ({unit})"), N_("falls to (deg)"),
        N_("end (s)"),
    )  # fmt: skip
    return table(gettext("All azimuths"), [gettext(heading, unit=unit.name) for heading in headings], rows)


def fall_azimuth(azimuth: float, towards: str | None) -> str:
    """Return the azimuth to which a body falls whose +x points to one, nothing where it stands.

    Examples
    --------
    >>> fall_azimuth(40.0, "-x"), fall_azimuth(40.0, None)
    ('220', '-')
    """
    return DASH if towards is None else f"{(azimuth + (180.0 if towards == '-x' else 0.0)) % 360.0:g}"


def variation_text(probability: Probability, block: Block) -> str:
    """Return what was varied, and what the share is worth."""
    versions, ranges = probability.versions, probability.ranges or ParameterRanges()
    return gettext(
        "of this model's scatter alone: {sizes}, {edges}, {friction}, restitution ±{restitution:g}, amplitude ±{amplitude}, "
        "direction ±{azimuth:g} degrees; in runs of two granite rocks on shaking tables 3 % fell where none of 20 versions did, and 2 % "
        "stood where all fell",
        sizes=lazy_gettext("width and height ±{share}", share=format_share(versions.size)),
        edges=sampled_edges(block, probability.ranges, versions.inset),
        friction=(ranges.friction_text if versions.mu else None) or lazy_gettext("friction ±{share}", share=format_share(versions.mu)),
        restitution=versions.restitution,
        amplitude=format_share(versions.amplitude),
        azimuth=versions.azimuth_deg,
    )


def _outcome_table(responses: Responses, *, gal: bool) -> Any:
    """Return the numbers, a column per component."""
    block, options, outcomes = responses[0].body, responses[0].options, [response.outcome for response in responses]
    varies = any(response.body != block for response in responses)
    ratio = min(block.arms) / block.centre
    friction, level = effective_friction(options), acceleration_unit(gal=gal)
    onset = min(friction, ratio) * options["gravity_m_s2"] / level.size
    unit = length_unit((length for o in outcomes for length in (o.max_displacement_m, o.slip_path_m)), gal=gal)
    values = {"name": gettext(block.name), "mu": options["mu"], "kinetic": options["mu_kinetic"]}
    frictions = N_("{name}: mu {mu:g}, kinetic {kinetic:g}")
    title = N_("{name}: b/h {ratio:.3f}, mu {mu:g}, kinetic {kinetic:g}; {first} first, above {onset}")
    if options["tenon_m"]:
        values["tenon"] = format_length(options["tenon_m"], gal=gal)
        frictions = N_("{name}: tenons {tenon}; once left, mu {mu:g}, kinetic {kinetic:g}")
        title = N_("{name}: b/h {ratio:.3f}, tenons {tenon}; once left, mu {mu:g}, kinetic {kinetic:g}; {first} first, above {onset}")
    if not varies:
        first = gettext("slides") if friction <= ratio else gettext("rocks")
        values |= {"ratio": ratio, "first": first, "onset": f"{onset:.{0 if gal else 2}f} {level.name}"}
    mode_times = [o.time_in_mode_s for o in outcomes]
    rows: list[tuple[str, list[Any]]] = [
        *([(gettext("b/h"), [f"{min(r.body.arms) / r.body.centre:.3f}" for r in responses])] if varies else []),
        (gettext("outcome"), [gettext(o.outcome) for o in outcomes]),
        (gettext("largest lean (deg)"), [f"{math.degrees(o.max_rotation_rad):.3f}" for o in outcomes]),
        (gettext("  over alpha"), [format_number(o.max_rotation_ratio) for o in outcomes]),
        (gettext("ends at ({unit})", unit=unit.name), [length_cell(o.final_displacement_m, unit) for o in outcomes]),
        (gettext("furthest from start ({unit})", unit=unit.name), [length_cell(o.max_displacement_m, unit) for o in outcomes]),
        (gettext("slip path ({unit})", unit=unit.name), [length_cell(o.slip_path_m, unit) for o in outcomes]),
        (gettext("flights, impacts"), [f"{o.flights}, {o.impacts}" for o in outcomes]),
        (gettext("  slides, rocks (s)"), [f"{format_seconds(s['slide'])}, {format_seconds(s['rock'])}" for s in mode_times]),
        (gettext("  both, in flight (s)"), [f"{format_seconds(s['slide_rock'])}, {format_seconds(s['flight'])}" for s in mode_times]),
        (
            gettext("lost to friction, impacts (J)"),
            [f"{format_number(o.energy_friction_j)}, {format_number(o.energy_impacts_j)}" for o in outcomes],
        ),
    ]
    heading = gettext(frictions if varies else title, **values)
    return side_by_side(heading, ["", *(r.motion.name or "x" for r in responses)], [[row_name, *cells] for row_name, cells in rows])
