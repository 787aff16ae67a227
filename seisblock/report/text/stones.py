"""Result of each stone of a survey: sentence on the agreement, and the CSV of ``--stones``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.output.io.atomic import write_table
from seisblock.records import Record
from seisblock.studies.survey.assessment import CemeteryRate
from seisblock.studies.survey.stones import Contingency, StoneResult

AGREEMENT = N_(
    "Surveyed stones: {stones}; overturned as computed {both}, computed only {computed}, observed only {observed}, neither {neither} "
    "(agreement {share:.0%})."
)

COLUMNS = (
    "id",
    "width_m",
    "height_m",
    "height_over_width",
    "threshold_m_s2",
    "probability",
    "overturns",
    "observed",
    "agrees",
    "count",
)
"""Columns of each stone; yes and no are 1 and 0."""

RATE_COLUMNS, PLACE_COLUMNS = ("record", "component", "pga_m_s2", "frequency_hz"), ("place",)
"""Columns before those of a stone, by command."""


def agreement_text(contingency: Contingency) -> str:
    """Return the sentence on computed and observed outcomes."""
    return gettext(
        AGREEMENT,
        stones=contingency.stones,
        both=contingency.both,
        computed=contingency.computed_only,
        observed=contingency.observed_only,
        neither=contingency.neither,
        share=contingency.agreement,
    )


def write_stones(path: Path, header: Sequence[str], groups: Iterable[tuple[Sequence[Any], Sequence[StoneResult]]]) -> None:
    """Write a row for each stone as CSV with a byte order mark, by which Excel recognises UTF-8.

    Parameters
    ----------
    path : Path
    header : sequence of str
        Names of the columns common to the stones of a group.
    groups : iterable of (values, stones)
        Values of those columns, and the stones.
    """
    rows = ([*values, *_cells(stone)] for values, stones in groups for stone in stones)
    write_table(path, [*header, *COLUMNS], rows, bom=True)


def rate_groups(groups: Iterable[tuple[Record | None, Sequence[CemeteryRate]]]) -> Iterator[tuple[list[Any], Sequence[StoneResult]]]:
    """Yield the stones under both horizontals of each record, or under each given shaking."""
    for record, rates in groups:
        for rate in rates if record is None else rates[-1:]:
            name = "" if record is None else record.station or record.source
            yield [name, rate.component or "", rate.pga_m_s2, rate.equivalent_frequency_hz], rate.each_stone


def _cells(stone: StoneResult) -> list[Any]:
    outcomes = [None if value is None else int(value) for value in (stone.overturns, stone.observed, stone.agrees)]
    sizes = [round(stone.width_m, 6), round(stone.height_m, 6), round(stone.height_m / stone.width_m, 6)]
    return [stone.id, *sizes, stone.threshold_m_s2, round(stone.probability, 6), *outcomes, stone.count]
