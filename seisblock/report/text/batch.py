"""Text report of a batch: event counts by body and reasons of failed rows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from seisblock.core.i18n import N_, format_share, gettext
from seisblock.report.text.tables import styled_line, table
from seisblock.studies.batch.tally import Tally

MAX_BODIES = 20
"""Most bodies in the table; the file contains all."""

MAX_REASONS = 5
"""Most reasons listed for rows without a result."""

_EVENT_COUNT_TEXTS = {
    "respond": N_("overturned in {happened} of {answers} cases"),
    "rock": N_("overturned in {happened} of {answers} cases"),
    "slide": N_("slid in {happened} of {answers} cases"),
    "jump": N_("jumped in {happened} of {answers} cases"),
    "uplift": N_("uplift in {happened} of {answers} cases"),
    "stack": N_("at least one stone fell in {happened} of {answers} cases"),
}
_EVENT_HEADINGS = {
    "respond": N_("overturned"),
    "rock": N_("overturned"),
    "slide": N_("slid"),
    "jump": N_("jumped"),
    "uplift": N_("uplift"),
    "stack": N_("stone fell"),
}


def tables(tally: Tally, messages: Mapping[str, str]) -> Iterator[Any]:
    """Yield the total count, the count of each body and the reasons of the rows without a result.

    Parameters
    ----------
    tally : Tally
    messages : mapping of str to str
        Translatable messages by their English text.
    """
    solver = tally.model.name
    total = gettext(_EVENT_COUNT_TEXTS[solver], happened=tally.event_count, answers=tally.answers)
    yield styled_line(
        gettext("{whole} (bodies: {bodies}, records: {records})", whole=total, bodies=len(tally.bodies), records=tally.records), "bold"
    )
    bodies = tally.sorted_counts()
    if bodies and tally.answers:
        header = [gettext("body"), gettext("total"), gettext(_EVENT_HEADINGS[solver]), gettext("share"), gettext("no result")]
        rows = [
            [gettext(c.body), c.answers, c.events, format_share(c.events / c.answers) if c.answers else None, c.failures]
            for c in bodies[:MAX_BODIES]
        ]
        caption = gettext("{count} more bodies in the file", count=len(bodies) - MAX_BODIES) if len(bodies) > MAX_BODIES else ""
        yield table("", header, rows, caption=caption)
    if tally.failures:
        yield styled_line(gettext("rows without a result: {count}", count=tally.failures), "yellow")
        reasons = sorted(tally.reasons.items(), key=lambda pair: -pair[1])
        # without a result no file is written: list all reasons here
        max_reasons = MAX_REASONS if tally.answers else len(reasons)
        for reason, count in reasons[:max_reasons]:
            yield styled_line(f"  {count} x {gettext(messages.get(reason, reason))}")
        if len(reasons) > max_reasons:
            yield styled_line("  " + gettext("{count} other reasons in the file", count=len(reasons) - max_reasons))
