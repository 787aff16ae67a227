"""Text report of ``seisblock respond``: verdict, probability, azimuths, and a table of the outcome."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.block import Block
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core.i18n import N_, format_share, gettext, lazy_gettext
from seisblock.core.results import Response
from seisblock.models.respond.describe import MIN_SLIP_M, Responses, describe, outcome_table
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.output.describe_wear import sampled_edges
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.tables import (
    DASH,
    details,
    format_seconds,
    format_share_interval,
    group_answers,
    styled_line,
    table,
    with_notes,
)
from seisblock.output.units_display import Unit, format_length, length_cell, length_unit
from seisblock.records.motion import requested_azimuth
from seisblock.report.text.assessment import assessment_lines, object_lines
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.respond.azimuths import RespondAzimuth, left_out_directions
from seisblock.studies.respond.probability import Probability

MIN_SURVIVORS = 20
"""Fewest surviving samples for which quantiles are reported."""


def tables(responses: Responses, extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Iterator[Any]:
    """Yield, per record, verdict and probability, a table with a column per component, and the notes."""
    pairs = zip(responses, extras, strict=True)
    for heading, part in group_answers(pairs, lambda pair: pair[0].motion.record, lambda pair: _summary(*pair, gal=gal), object_lines):
        yield from heading
        yield outcome_table([r for r, _ in part], gal=gal)
        yield from shaking_lines([r for r, _ in part], gal=gal)
        if any("probability" in extra for _, extra in part):
            yield styled_line(
                variation_text(*next((extra["probability"], pair.body) for pair, extra in part if "probability" in extra)), "dim"
            )
        directions = [extra["directions"] for _, extra in part if "directions" in extra]
        # a blank line only before something: the answer on one record fits a screen
        if directions or part[-1][0].motion.record is not responses[-1].motion.record:
            yield styled_line()
        for results in directions:
            yield details(_direction_table(results, gal=gal))


def _summary(response: Response[RespondOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Text]:
    yield from assessment_lines(extra, response.body)
    yield from base_lines(response, extra, gal=gal)
    yield styled_line(describe(response, gal=gal), "" if "assessment" in extra else "bold")
    if "probability" in extra:
        yield styled_line("  " + probability_sentence(extra["probability"], gal=gal))
    if "directions" in extra:
        yield styled_line("  " + direction_sentence(extra["directions"]))


def base_lines(response: Response[Any], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Text]:
    """Yield the width of the base of a block towards the azimuth; nothing along a recorded component."""
    if "block" in extra and (azimuth := requested_azimuth(response.motion)) is not None:
        text = N_("  base {width} wide towards azimuth {azimuth:g}°")
        yield styled_line(gettext(text, width=format_length(response.body.width, gal=gal), azimuth=azimuth))


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
    text = N_("single runs overturn in {fallen} of {all} azimuths; results for the worst azimuth.")
    if not any(result.moves for result in results):
        text = N_("no motion in any of {all} azimuths; results for the azimuth with the largest PGA.")
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
        "amplitude ±{amplitude}, azimuth ±{azimuth:g}°. In 490 shaking-table runs of two granite rocks, 3 % overturned where "
        "no computed sample did, and 2 % stood where all did.",
        sizes=lazy_gettext("width and height ±{share}", share=format_share(versions.size)),
        edges=sampled_edges(block, probability.ranges, versions.inset),
        friction=(ranges.friction_text if versions.mu else None) or lazy_gettext("friction ±{share}", share=format_share(versions.mu)),
        restitution=versions.restitution,
        amplitude=format_share(versions.amplitude),
        azimuth=versions.azimuth_deg,
    )
