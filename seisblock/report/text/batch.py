"""Text report of a batch: event counts by body and reasons of failed rows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from seisblock.core.i18n import N_, format_share, gettext
from seisblock.output.text.tables import styled_line, table
from seisblock.studies.batch.tally import Tally

MAX_BODIES = 20
"""Most bodies in the table; the file contains all."""

MAX_REASONS = 5
"""Most reasons listed for rows without a result."""

_EVENT_COUNT_TEXTS: dict[str, str] = {
    "overturned": N_("overturned in {happened} of {answers} cases"),
    "slips": N_("slid in {happened} of {answers} cases"),
    "outcome": N_("jumped in {happened} of {answers} cases"),
    "uplifts": N_("uplift in {happened} of {answers} cases"),
    "overturned_any": N_("at least one stone fell in {happened} of {answers} cases"),
}
_EVENT_HEADINGS: dict[str, str] = {
    "overturned": N_("overturned"),
    "slips": N_("slid"),
    "outcome": N_("jumped"),
    "uplifts": N_("uplift"),
    "overturned_any": N_("stone fell"),
}


def tables(tally: Tally, messages: Mapping[str, str]) -> Iterator[Any]:
    """Yield the total count, the count of each body and the reasons of the rows without a result.

    Parameters
    ----------
    tally : Tally
    messages : mapping of str to str
        Translatable messages by their English text.
    """
    event = tally.solver.event
    answers, happened, objects, objects_happened = map(
        tally.total, ("answers_count", "happened_count", "objects_count", "objects_happened_count")
    )
    total = gettext(_EVENT_COUNT_TEXTS.get(event, N_("event in {happened} of {answers} cases")), happened=happened, answers=answers)
    if objects < answers:
        total = gettext(
            "{event}: {happened} of {objects} objects under at least one component; {total}",
            event=gettext(_EVENT_HEADINGS.get(event, N_("event"))),
            happened=objects_happened,
            objects=objects,
            total=total,
        )
    if answers:
        yield styled_line(
            gettext("{whole} (bodies: {bodies}, records: {records})", whole=total, bodies=len(tally.bodies), records=tally.records), "bold"
        )
    bodies = tally.sorted_counts()
    if bodies and answers:
        header = [
            gettext("body"),
            gettext("objects"),
            gettext(_EVENT_HEADINGS.get(event, N_("event"))),
            gettext("share"),
            gettext("no result"),
        ]
        rows = [
            [
                gettext(c.body),
                c.objects_count,
                c.objects_happened_count,
                format_share(c.objects_happened_count / c.objects_count) if c.objects_count else None,
                c.failures_count,
            ]
            for c in bodies[:MAX_BODIES]
        ]
        caption = gettext("{count} more bodies in the file", count=len(bodies) - MAX_BODIES) if len(bodies) > MAX_BODIES else ""
        yield table("", header, rows, caption=caption)
    if tally.failures:
        yield styled_line(gettext("rows without a result: {count}", count=tally.failures), "yellow")
        reasons = sorted(tally.reasons.items(), key=lambda pair: -pair[1])
        # without a result no file is written: list all reasons here
        max_reasons = MAX_REASONS if answers else len(reasons)
        for reason, count in reasons[:max_reasons]:
            yield styled_line(f"  {count} x {gettext(messages.get(reason, reason))}")
        if len(reasons) > max_reasons:
            yield styled_line("  " + gettext("{count} other reasons in the file", count=len(reasons) - max_reasons))
