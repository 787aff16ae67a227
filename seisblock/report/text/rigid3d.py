"""Text report of ``seisblock rigid3d`` and ``respond --three-d``: verdict, probability, displacement and twist."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.block import Block
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core.i18n import N_, format_share, gettext, lazy_gettext
from seisblock.core.results import Response
from seisblock.models.rigid3d.describe import clean_angle, describe, outcome_table
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.output.describe_wear import sampled_edges
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.tables import DASH, details, format_share_interval, group_answers, styled_line, table, with_notes
from seisblock.output.units_display import format_length, length_cell, length_unit
from seisblock.report.text.assessment import assessment_lines
from seisblock.report.text.respond import MIN_SURVIVORS, direction_sentence
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.respond.azimuths import Rigid3dAzimuth
from seisblock.studies.respond.probability import SpatialProbability


def tables(responses: Sequence[Response[Rigid3dOutcome]], extras: Sequence[Mapping[str, Any]], *, gal: bool = True) -> Iterator[Any]:
    """Yield, per record, verdict and probability, a table row per direction of +x, and the notes."""
    for heading, part in group_answers(
        zip(responses, extras, strict=True),
        lambda pair: pair[0].motion.record,
        lambda pair: _summary(*pair, gal=gal),
    ):
        yield from heading
        yield outcome_table([response for response, _ in part], gal=gal)
        yield from shaking_lines([response for response, _ in part], gal=gal)
        sampled = next(((extra["probability"], response.body) for response, extra in part if "probability" in extra), None)
        if sampled is not None:
            yield styled_line(variation_text(*sampled), "dim")
        for results in [extra["directions"] for _, extra in part if "directions" in extra]:
            yield details(_direction_table(results, gal=gal))
        if part[-1][0].motion.record is not responses[-1].motion.record:
            yield styled_line()


def _summary(response: Response[Rigid3dOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Text]:
    yield from assessment_lines(extra)
    yield styled_line(describe(response, gal=gal), "" if "assessment" in extra else "bold")
    if "probability" in extra:
        yield styled_line("  " + probability_sentence(extra["probability"], gal=gal))
    if "directions" in extra:
        yield styled_line("  " + direction_sentence(extra["directions"]))


def _direction_table(results: Sequence[Rigid3dAzimuth], *, gal: bool) -> Any:
    """Return the table of all azimuths of +x, ascending."""
    unit = length_unit((result.max_displacement_m for result in results), gal=gal)
    rows = [
        [
            f"{result.azimuth_deg:g}",
            f"{math.degrees(result.max_tilt_rad):.3f}",
            f"{result.twist_deg:.1f}",
            *(length_cell(value, unit) for value in (result.max_displacement_m, result.final_displacement_m)),
            DASH if result.fell_azimuth_deg is None else f"{result.fell_azimuth_deg:.0f}",
        ]
        for result in sorted(results, key=lambda result: result.azimuth_deg)
    ]
    headings = (
        N_("azimuth (deg)"), N_("tilt (deg)"), N_("twist (deg)"), N_("max. ({unit})"), N_("residual ({unit})"), N_("overturns to (deg)"),
    )  # fmt: skip
    return table(gettext("All azimuths"), [gettext(heading, unit=unit.name) for heading in headings], rows)


def probability_sentence(probability: SpatialProbability, *, gal: bool = True) -> str:
    """Return overturning probability with its confidence interval, and displacement and twist of the samples that stand."""
    sentence = gettext(
        "Overturning probability {share} (95 % CI {interval}, {runs} samples); overturning or residual displacement above {far}: {moved}",
        share=format_share(probability.overturned),
        interval=format_share_interval(probability.interval),
        runs=probability.runs,
        far=format_length(probability.moved_m, gal=gal),
        moved=format_share(probability.moved),
    )
    if probability.runs - round(probability.overturned * probability.runs) >= MIN_SURVIVORS:
        place, twist = probability.final_displacement_m, probability.abs_twist_deg
        unit = length_unit([place["q95"]], gal=gal)
        sentence = gettext(
            "{falls}; without overturning, residual displacement {middle} (median) and {far} (95 %), twist {twist:.2g}° and {most:.2g}°",
            falls=sentence,
            middle=format_length(place["q50"], unit),
            far=format_length(place["q95"], unit),
            twist=clean_angle(twist["q50"]),
            most=clean_angle(twist["q95"]),
        )
    left_out = left_out_versions(probability.no_answer, probability.runs)
    return with_notes(gettext("{result}.", result=sentence), [] if left_out is None else [gettext("{note}.", note=left_out)])


def variation_text(probability: SpatialProbability, body: Any) -> str:
    """Return the varied parameters."""
    versions, ranges = probability.versions, probability.ranges or ParameterRanges()
    parts = [lazy_gettext("plan and height ±{share}", share=format_share(versions.size))]
    if isinstance(body, Block):
        parts.append(sampled_edges(body, probability.ranges, versions.inset))
    parts.append((ranges.friction_text if versions.mu else None) or lazy_gettext("friction ±{share}", share=format_share(versions.mu)))
    return gettext(
        "Parameter variation only (model error not included): {parts}, restitution up to +{restitution:g}, amplitude ±{amplitude}, "
        "azimuth ±{azimuth:g}°.",
        parts=parts,
        restitution=versions.restitution,
        amplitude=format_share(versions.amplitude),
        azimuth=versions.azimuth_deg,
    )
