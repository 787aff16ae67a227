"""Text report of the full response: verdict, probability, and a table of the outcome."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.block import Block
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core.i18n import N_, format_share, gettext, join_list, lazy_gettext
from seisblock.core.results import Response
from seisblock.models.respond.describe import ENDLESS_HOPS, STILL_MOVING
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.report.describe_wear import sampled_edges
from seisblock.report.directions import direction_label, with_direction
from seisblock.report.text.shaking import shaking_lines
from seisblock.report.text.tables import (
    DASH,
    details,
    format_number,
    format_seconds,
    format_share_interval,
    group_answers,
    side_by_side,
    styled_line,
    table,
    tilt_ratio_cell,
    with_notes,
)
from seisblock.report.text.threshold import ROCKS, SLIDES, effective_friction, threshold_text
from seisblock.report.units_display import Unit, acceleration_unit, format_length, length_cell, length_unit
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.respond.azimuths import RespondAzimuth, left_out_directions
from seisblock.studies.respond.probability import Probability

Responses = Sequence[Response[RespondOutcome]]

OUTCOME_TEXTS = {STILL_MOVING: N_("still moving"), ENDLESS_HOPS: N_("no result")}
"""Texts of the outcomes whose names in JSON are not read as such."""

MIN_SLIP_M = 5e-4
"""Displacements below this are reported as zero, m."""

MIN_SURVIVORS = 20
"""Fewest surviving samples for which quantiles are reported."""


def tables(responses: Responses, extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Iterator[Any]:
    """Yield, per record, verdict and probability, a table with a column per component, and the notes."""
    pairs = zip(responses, extras, strict=True)
    for heading, part in group_answers(pairs, lambda pair: pair[0].motion.record, lambda pair: _summary(*pair, gal=gal)):
        yield from heading
        yield _outcome_table([r for r, _ in part], gal=gal)
        yield from shaking_lines([r for r, _ in part], gal=gal)
        if any("probability" in extra for _, extra in part):
            yield styled_line(
                variation_text(*next((extra["probability"], pair.body) for pair, extra in part if "probability" in extra)), "dim"
            )
        yield styled_line()
        for _, extra in part:
            if "directions" in extra:
                yield details(_direction_table(extra["directions"], gal=gal))


def _summary(response: Response[RespondOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Text]:
    yield styled_line(describe(response, gal=gal), "bold")
    if "probability" in extra:
        yield styled_line("  " + probability_sentence(extra["probability"], gal=gal))
    if "directions" in extra:
        yield styled_line("  " + direction_sentence(extra["directions"]))


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
    elif outcome.outcome == "rests":
        ratio, mu = min(response.body.arms) / response.body.centre, effective_friction(response.options)
        template = SLIDES if mu <= ratio else ROCKS
        shares = tuple(min(mu, arm / response.body.centre) for arm in response.body.arms)
        gravity, vertical = response.options.gravity, response.options.vertical
        onset_text = threshold_text(template, (shares[0], shares[1]), response.motion, gravity=gravity, vertical=vertical, gal=gal)
        words = gettext("{verdict}; {onset}", verdict=gettext("remains at rest"), onset=onset_text)
    elif outcome.outcome == ENDLESS_HOPS:
        words = gettext("no result: analysis stopped at {time:.2f} s after {impacts} impacts", time=outcome.end_s, impacts=outcome.impacts)
    else:
        words = gettext("{motion}; {end}", motion=join_list(_motion_parts(response, gal=gal)), end=_final_text(response, gal=gal))
    flag = gettext("; sensitive: an input change of 1e-6 alters the result") if outcome.sensitive else ""
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


def probability_sentence(probability: Probability, *, gal: bool = True) -> str:
    """Return overturning probability with its confidence interval, share of displaced samples, and displacement of the survivors."""
    falls = gettext(
        "Overturning probability {share} (95 % CI {interval}, {runs} samples)",
        share=format_share(probability.overturned),
        interval=format_share_interval(probability.interval),
        runs=probability.runs,
    )
    moves = gettext(
        "overturning or residual displacement above {far}: {share}",
        far=format_length(probability.moved_m, gal=gal),
        share=format_share(probability.moved),
    )
    middle = ""
    survivors = probability.runs - round(probability.overturned * probability.runs)
    if probability.moved > 0.0 and survivors >= MIN_SURVIVORS:
        ends = [probability.final_displacement_m[name] for name in ("q05", "q95")]
        lower, upper = (format_signed(end, length_unit(ends, gal=gal)) for end in ends)
        if lower == upper == "0":
            middle = gettext("; no residual displacement in 90 % of the samples without overturning")
        else:
            middle = gettext("; residual displacement of 90 % of the samples without overturning {low} to {high}", low=lower, high=upper)
    sentence = gettext("{falls}; {moves}{middle}.", falls=falls, moves=moves, middle=middle)
    left_out = left_out_versions(probability.no_answer, probability.runs)
    return with_notes(sentence, [] if left_out is None else [gettext("{note}.", note=left_out)])


def format_signed(value_m: float, unit: Unit) -> str:
    """Return a signed length; 0 below :data:`MIN_SLIP_M`."""
    if abs(value_m) < MIN_SLIP_M:
        return "0"
    return f"{'+' * (value_m > 0.0)}{format_length(value_m, unit)}"


def direction_sentence(results: Sequence[Any]) -> str:
    """Return the number of directions in which a body overturns, and those without a result."""
    fall_count = sum(result.overturned for result in results)
    solved_count = sum(not result.gave_up for result in results)
    text = N_("overturns in {fallen} of {all} azimuths; results for the worst azimuth.")
    notes = [gettext("{note}.", note=left_out) for left_out in left_out_directions(results)]
    return with_notes(gettext(text, fallen=fall_count, all=solved_count), notes)


def _direction_table(results: Sequence[RespondAzimuth], *, gal: bool) -> Any:
    """Return the table of all azimuths, ascending."""
    rows = []
    unit = length_unit((result.max_displacement_m for result in results), gal=gal)
    for result in sorted(results, key=lambda result: result.azimuth_deg):
        fall_cell = fall_azimuth(result.azimuth_deg, result.overturned_towards)
        lengths = [length_cell(value, unit) for value in (result.max_displacement_m, result.final_displacement_m)]
        rows.append(
            [f"{result.azimuth_deg:g}", f"{math.degrees(result.max_rotation_rad):.3f}", *lengths, fall_cell, format_seconds(result.end_s)]
        )
    headings = (
        N_("azimuth (deg)"), N_("tilt (deg)"), N_("max. ({unit})"), N_("residual ({unit})"), N_("overturns to (deg)"),
        N_("end (s)"),
    )  # fmt: skip
    return table(gettext("All azimuths"), [gettext(heading, unit=unit.name) for heading in headings], rows)


def fall_azimuth(azimuth: float, towards: str | None) -> str:
    """Return the azimuth of fall of a body whose +x points to `azimuth`; a dash without overturning.

    Examples
    --------
    >>> fall_azimuth(40.0, "-x"), fall_azimuth(40.0, None)
    ('220', '-')
    """
    return DASH if towards is None else f"{(azimuth + (180.0 if towards == '-x' else 0.0)) % 360.0:g}"


def variation_text(probability: Probability, block: Block) -> str:
    """Return the varied parameters and the validation of the probability."""
    versions, ranges = probability.versions, probability.ranges or ParameterRanges()
    return gettext(
        "Parameter variation only (model error not included): {sizes}, {edges}, {friction}, restitution ±{restitution:g}, "
        "amplitude ±{amplitude}, azimuth ±{azimuth:g} degrees. In 490 shaking-table runs of two granite rocks, 3 % of those "
        "predicted 0/20 did overturn and 2 % of those predicted 20/20 did not.",
        sizes=lazy_gettext("width and height ±{share}", share=format_share(versions.size)),
        edges=sampled_edges(block, probability.ranges, versions.inset),
        friction=(ranges.friction_text if versions.mu else None) or lazy_gettext("friction ±{share}", share=format_share(versions.mu)),
        restitution=versions.restitution,
        amplitude=format_share(versions.amplitude),
        azimuth=versions.azimuth_deg,
    )


def _outcome_table(responses: Responses, *, gal: bool) -> Any:
    block, options, outcomes = responses[0].body, responses[0].options, [response.outcome for response in responses]
    varies = any(response.body != block for response in responses)
    ratio = min(block.arms) / block.centre
    friction, level = effective_friction(options), acceleration_unit(gal=gal)
    onset = min(friction, ratio) * options.gravity / level.size
    unit = length_unit((length for o in outcomes for length in (o.max_displacement_m, o.slip_path_m)), gal=gal)
    values = {"name": gettext(block.name), "mu": options.mu, "kinetic": options.mu_kinetic}
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
        (gettext("flights, impacts"), [f"{o.flights}, {o.impacts}" for o in outcomes]),
        (gettext("  slide, rock (s)"), [f"{format_seconds(s['slide'])}, {format_seconds(s['rock'])}" for s in mode_times]),
        (gettext("  slide-rock, flight (s)"), [f"{format_seconds(s['slide_rock'])}, {format_seconds(s['flight'])}" for s in mode_times]),
        (
            gettext("friction, impact losses (J)"),
            [f"{format_number(o.energy_friction_j)}, {format_number(o.energy_impacts_j)}" for o in outcomes],
        ),
    ]
    heading = gettext(frictions if varies else title, **values)
    return side_by_side(heading, ["", *(r.motion.name or "x" for r in responses)], [[row_name, *cells] for row_name, cells in rows])
