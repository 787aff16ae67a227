"""Text report of ``seisblock stack``: outcome of each stone, probabilities, and the model comparison of the top stone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.text import Text

from seisblock.bodies.pile.edge_wear import worn_share
from seisblock.bodies.pile.pile import Pile
from seisblock.core.i18n import N_, Message, format_share, gettext, lazy_gettext
from seisblock.core.results import Response
from seisblock.models.stack.describe import StackResponses, base_text, describe, stone_table
from seisblock.models.stack.outcome import StackOutcome
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.tables import (
    DASH,
    details,
    format_fixed,
    format_range,
    format_share_interval,
    group_answers,
    styled_line,
    table,
)
from seisblock.output.units_display import format_length
from seisblock.report.text.assessment import assessment_lines
from seisblock.report.text.model_comparison import agreement_line
from seisblock.studies.model_comparison import ModelComparison
from seisblock.studies.respond.pile_probability import PileProbability, StoneProbability

MIN_CONCENTRATION = 0.3
"""Smallest resultant length (``StoneProbability.fell_alike_ratio``) for which a mean direction is printed."""


def tables(responses: StackResponses, extras: Sequence[Mapping[str, Any]], *, gal: bool = True) -> Iterator[Any]:
    """Yield falls and their probability, a row per stone, and the model comparison of the top stone."""
    pairs, has_components = zip(responses, extras, strict=True), len(responses) > 1
    for heading, part in group_answers(
        pairs, lambda pair: pair[0].motion.record, lambda pair: _summary(*pair, with_name=has_components, gal=gal)
    ):
        yield from heading
        yield from (block for pair in part for block in _details(*pair, gal=gal))


def _summary(response: Response[StackOutcome], extra: Mapping[str, Any], *, with_name: bool, gal: bool) -> Iterator[Text]:
    text = describe(response)
    yield from assessment_lines(extra)
    yield styled_line(gettext("{name}: {text}", name=response.motion.name or "x", text=text) if with_name else text)
    if "probability" in extra:
        yield styled_line("  " + probability_sentence(extra["probability"], gal=gal))


def _details(response: Response[StackOutcome], extra: Mapping[str, Any], *, gal: bool) -> Iterator[Any]:
    """Yield the table of one run, the contact model, the varied parameters and the model comparison of the top stone."""
    agreement: ModelComparison | None = extra["agreement"]
    yield stone_table(response, gal=gal)
    if "probability" in extra:
        yield from _version_tables(extra["probability"], response.body, gal=gal)
    yield details(styled_line(base_text(response)))
    if agreement is not None:
        top = gettext("{stone}, {name}", stone=gettext(response.body.names[-1]), name=response.motion.name)
        line = styled_line(agreement_line(top, agreement))
        yield details(line) if "assessment" in extra else line
    yield from shaking_lines([response], gal=gal)
    yield styled_line()


def _version_tables(probability: PileProbability, pile: Pile, *, gal: bool) -> Iterator[Any]:
    """Yield the share of samples in which each stone falls and moves, and the varied parameters."""
    columns = [gettext("stone"), gettext("falls (%)"), gettext("95 % interval"), gettext("falls to (deg)"), gettext("moves (%)")]
    length = format_length(probability.moved_m, gal=gal)
    title = N_("{runs} samples; moves: residual displacement above {far}, or falls")
    if any(chance.overturned > 0.0 and _mean_direction(chance) is None for chance in probability.stones):
        title = N_('{runs} samples; moves: residual displacement above {far}, or falls; "-": falls in scattered directions')
    yield table(gettext(title, runs=probability.runs, far=length), columns, map(_chance_row, reversed(probability.stones)))
    yield styled_line(variation_text(probability, pile), "dim")


def _mean_direction(chance: StoneProbability) -> float | None:
    """Return the mean fall direction of a stone, degrees, from +x if north is unknown; None for scattered directions."""
    if chance.fell_alike_ratio is None or chance.fell_alike_ratio < MIN_CONCENTRATION:
        return None
    return chance.fell_towards_deg if chance.fell_azimuth_deg is None else chance.fell_azimuth_deg


def _chance_row(chance: StoneProbability) -> list[str]:
    """Return the row of one stone."""
    mean = _mean_direction(chance)
    low, high = (format_fixed(100.0 * end, 0) for end in chance.interval)
    share, moved_share = format_fixed(100.0 * chance.overturned, 1), format_fixed(100.0 * chance.moved, 1)
    return [
        gettext(chance.name),
        share,
        format_range(low, high),
        DASH if mean is None else format_fixed(round(mean) % 360, 0),
        moved_share,
    ]


def probability_sentence(probability: PileProbability, *, gal: bool = True) -> str:
    """Return the probability of a fall with its confidence interval, and the share of samples with displaced stones."""
    falls = gettext(
        "Probability of a fall {share} (95 % CI {interval}, {runs} samples)",
        share=format_share(probability.overturned),
        interval=format_share_interval(probability.interval),
        runs=probability.runs,
    )
    length = format_length(probability.moved_m, gal=gal)
    moves = gettext("fall or residual displacement above {far}: {share}", far=length, share=format_share(probability.moved))
    if not probability.left_out_count:
        return gettext("{falls}; {moves}.", falls=falls, moves=moves)
    return gettext(
        "{falls}; {moves}; {count} of {asked} samples omitted (energy created numerically).",
        falls=falls,
        moves=moves,
        count=probability.left_out_count,
        asked=probability.runs + probability.left_out_count,
    )


def variation_text(probability: PileProbability, pile: Pile) -> str:
    """Return the varied parameters."""
    versions = probability.versions
    size = lazy_gettext("size ±{share}", share=format_share(versions.size))
    return gettext(
        "Parameter variation only (model error not included): {shape}, friction of each joint ±{mu}, amplitude ±{amplitude}, "
        "azimuth ±{azimuth:g}°.",
        shape=lazy_gettext("{parts}", parts=[size, _wear_text(pile, versions.inset)] if versions.inset else [size]),
        mu=format_share(versions.mu),
        amplitude=format_share(versions.amplitude),
        azimuth=versions.azimuth_deg,
    )


def _wear_text(pile: Pile, tolerance: float) -> Message:
    if not any(worn_share(stone) for stone in pile.stones):
        return lazy_gettext("sharp edges")
    return lazy_gettext("edge wear ±{share}", share=format_share(tolerance))
