"""Text report of ``seisblock rock``: verdict, table, model comparison, margins, probability and azimuths."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.core.results import Response
from seisblock.models.rock.describe import RockResponses, describe, outcome_table
from seisblock.models.rock.outcome import RockOutcome
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.tables import (
    Part,
    details,
    format_seconds,
    group_answers,
    styled_line,
    table,
    tilt_ratio_cell,
)
from seisblock.report.text.assessment import assessment_lines, object_lines
from seisblock.report.text.model_comparison import agreement_part, perturbation_lines
from seisblock.report.text.respond import base_lines, direction_sentence, fall_azimuth
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.rocking.margin import Margin

MAX_INTERVALS = 8
"""Most intervals of overturning listed."""


def tables(responses: RockResponses, extras: Sequence[Mapping[str, Any]], *, gal: bool, mu: float | None = None) -> Iterator[Any]:
    """Yield, per record, the verdicts, a table with a column per component, and margins and probabilities.

    Parameters
    ----------
    responses : sequence of Response
    extras : sequence of mapping
        Further results of each: ``assessment``, ``agreement``, ``margin``, ``perturbation``, ``directions``.
    gal : bool
    mu : float or None
        Available friction coefficient; None if not given.
    """
    pairs = zip(responses, extras, strict=True)
    for heading, part in group_answers(
        pairs,
        lambda pair: pair[0].motion.record,
        lambda pair: [*assessment_lines(pair[1], pair[0].body), *base_lines(*pair, gal=gal), styled_line(describe(pair[0], mu, gal=gal))],
        object_lines,
    ):
        yield from heading
        selected = [response for response, _ in part]
        full_table = outcome_table(selected, gal=gal)
        has_margin = any("margin" in extra for _, extra in part)
        yield Part((full_table,), (outcome_table(selected, gal=gal, empty_rows=False),)) if has_margin else full_table
        yield from shaking_lines([r for r, _ in part], gal=gal)
        for response, extra in part:
            yield from sentences(response, extra)
        directions = [extra["directions"] for _, extra in part if "directions" in extra]
        # a blank line only before something: the answer on one record fits a screen
        if directions or part[-1][0].motion.record is not responses[-1].motion.record:
            yield styled_line()
        for results in directions:
            yield details(_direction_table(results))


def _direction_table(results: Sequence[RockAzimuth]) -> Any:
    """Return the table of all azimuths, ascending; with the slenderness if it varies."""
    slenderness_varies = len({result.slenderness_rad for result in results}) > 1
    rows = [
        [
            f"{result.azimuth_deg:g}",
            *([f"{math.degrees(result.slenderness_rad):.2f}"] if slenderness_varies else []),
            tilt_ratio_cell(result.max_rotation_ratio, overturned=result.overturned_towards is not None),
            *_fall_cells(result),
        ]
        for result in sorted(results, key=lambda result: result.azimuth_deg)
    ]
    headings = (
        N_("azimuth (deg)"),
        *((N_("alpha (deg)"),) if slenderness_varies else ()),
        N_("tilt/alpha"),
        N_("overturns to (deg)"),
        N_("overturning time (s)"),
    )
    return table(gettext("All azimuths"), [gettext(heading) for heading in headings], rows)


def _fall_cells(result: RockAzimuth) -> tuple[str, str]:
    return fall_azimuth(result.azimuth_deg, result.overturned_towards), format_seconds(result.overturning_time_s)


def sentences(response: Response[RockOutcome], extra: Mapping[str, Any]) -> Iterator[Any]:
    """Yield model comparison, margins and overturning probability; their intervals and samples are details."""
    name = response.motion.name or "x"
    if "agreement" in extra:
        # the first line of an assessed direction has the range of the models
        part = agreement_part(name, extra["agreement"], is_short="margin" in extra)
        yield Part(part.full if isinstance(part, Part) else (part,)) if "assessment" in extra else part
    if "directions" in extra:
        yield styled_line(direction_sentence(extra["directions"]))
    answers = [_margin_lines(extra["margin"])] if "margin" in extra else []
    answers += [perturbation_lines(extra["perturbation"], response.body)] if "perturbation" in extra else []
    for texts in answers:
        first, *detail_texts = (styled_line(gettext("{name}: {text}", name=name, text=text)) for text in texts)
        yield first
        yield from map(details, detail_texts)


def _margin_lines(margin: Margin) -> Iterable[str]:
    """Yield the first factor with overturning, the share above, and the intervals of overturning."""
    if margin.first_fall is None or margin.falls_above_first is None:
        yield gettext("no overturning at scale factors up to {limit:g} (steps of {step:g}).", limit=margin.limit, step=margin.step)
        return
    yield gettext(
        "scale factor to overturning {first:.3g} (smallest of the factors up to {limit:g} in steps of {step:g}); of the larger "
        "factors {share:.0%} overturn the block.",
        first=margin.first_fall,
        step=margin.step,
        limit=margin.limit,
        share=margin.falls_above_first,
    )
    unsafe = [window for window in margin.windows if window.overturned]
    intervals = [gettext("{first:.4f} to {last:.4f}", first=w.first, last=w.last) for w in unsafe[:MAX_INTERVALS]]
    if len(unsafe) > MAX_INTERVALS:
        intervals.append(gettext("and {count} more intervals", count=len(unsafe) - MAX_INTERVALS))
    yield gettext("overturning at scale factors {factors}.", factors=intervals)
    if margin.nearest_flip is not None:
        yield gettext("the result changes at a scale factor of {factor:.4f} (the nearest to 1 found).", factor=margin.nearest_flip)
